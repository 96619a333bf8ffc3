//! shadetree: weaves abstract shade trees into WGSL.
