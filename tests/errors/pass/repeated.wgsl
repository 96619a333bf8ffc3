//! kind: geometry
//! target: depth32float
//! repeat: doubling
//! otherwise: blur
