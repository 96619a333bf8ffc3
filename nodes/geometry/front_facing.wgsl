//! label: Front Facing
//! category: geometry
//! synonyms: backfacing, is front face, two sided, face sign, double sided
//! inline
//! Whether the camera sees the front of the surface; link it to Choose to give the back another look.

/// front (bool; = @front_facing; hidden): What the rasterizer says.
/// -> front_facing (bool): True where the outer side of the surface is seen.
fn front_facing(front: bool) -> bool {
    return front;
}
