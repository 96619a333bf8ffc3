//! label: Angle
//! category: math
//! synonyms: degrees, constant angle, rotation, radians
//! inline
//! An angle to set by hand, in degrees, and to use in several places.

/// angle (angle; = 90; in deg): The angle.
/// -> angle (angle): The same angle.
fn angle_value(angle: f32) -> f32 {
    return angle;
}
