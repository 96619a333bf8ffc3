//! kind: compute
//! reads: lamp
