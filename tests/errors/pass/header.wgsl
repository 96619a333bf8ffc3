//! kind: imge
//! axs: x
//! axes: z
//! clear: a
//! skip: mode == none
//! skip: mode == nothing
