//! Where the members of the parameter block lie: WGSL's uniform address space rules, in the order given.

use crate::semantic::Shape;

/// Alignment and size of a member.
pub(crate) fn extent(shape: &Shape) -> (u32, u32) {
    match shape {
        Shape::F32(2) => (8, 8),
        Shape::F32(3) => (16, 12),
        Shape::F32(4) => (16, 16),
        Shape::Matrix(2) => (8, 16),
        Shape::Matrix(n) => (16, 16 * u32::from(*n)),
        _ => (4, 4),
    }
}

/// The offset of each member, and the size of the block as a multiple of 16. Every `group` members make a structure,
/// which begins at a multiple of 16.
pub(crate) fn offsets<'a>(shapes: impl Iterator<Item = &'a Shape>, group: usize) -> (Vec<u32>, u32) {
    let mut end = 0_u32;
    let mut offsets = Vec::new();
    for (index, shape) in shapes.enumerate() {
        let (align, size) = extent(shape);
        let start = end.next_multiple_of(if index % group == 0 { 16 } else { align });
        offsets.push(start);
        end = start + size;
    }
    (offsets, end.next_multiple_of(16))
}
