//! kind: compute
//! target: rg32float | rg16float
//! clear: 0
//! repeat: tripling
