//! A procedural sky.

use glam::DVec3;

/// A smooth sky: a gradient from the horizon up to the zenith, a ground below, and a glow around the sun. There is no
/// sun disc: a disc smaller than a texel would flicker in reflections, and light with a shadow is a directional light.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    /// Radiance straight up, linear.
    pub zenith: [f64; 3],
    /// Radiance at the horizon, linear.
    pub horizon: [f64; 3],
    /// Radiance straight down, linear.
    pub ground: [f64; 3],
    /// Towards the sun, any length.
    pub sun_direction: [f64; 3],
    /// Radiance that the glow adds where the sun is, linear; black for none.
    pub sun_glow: [f64; 3],
    /// Factor on everything, at least 0.
    pub intensity: f64,
}

impl Default for Sky {
    fn default() -> Self {
        Self {
            zenith: [0.14, 0.3, 0.68],
            horizon: [0.72, 0.78, 0.85],
            ground: [0.24, 0.22, 0.2],
            sun_direction: [0.5, 0.6, 0.4],
            sun_glow: [1.6, 1.25, 0.8],
            intensity: 1.0,
        }
    }
}

impl Sky {
    /// Radiance from a unit direction, linear.
    ///
    /// Above the horizon the colour moves to the zenith's as 1 - (1 - y)^3: most of the change is near the horizon, as
    /// in air. Below, it moves to the ground's over the first fifth of the way down, smoothly. The glow is the sum of
    /// a wide and a narrow power of the cosine to the sun (weights 1/4 and 3/4 of `sun_glow`, exponents 8 and 96).
    pub fn radiance(&self, direction: DVec3) -> DVec3 {
        let [zenith, horizon, ground, glow] =
            [self.zenith, self.horizon, self.ground, self.sun_glow].map(DVec3::from_array);
        let height = direction.y.clamp(-1.0, 1.0);
        let air = if height >= 0.0 {
            horizon.lerp(zenith, 1.0 - (1.0 - height).powi(3))
        } else {
            let t = (-height * 5.0).min(1.0);
            horizon.lerp(ground, t * t * (3.0 - 2.0 * t))
        };
        let sun = DVec3::from_array(self.sun_direction).normalize_or(DVec3::Y);
        let cosine = direction.dot(sun).max(0.0);
        let above = (height * 10.0 + 1.0).clamp(0.0, 1.0);
        let halo = 0.25 * cosine.powi(8) + 0.75 * cosine.powi(96);
        (air + glow * (halo * above)) * self.intensity
    }
}
