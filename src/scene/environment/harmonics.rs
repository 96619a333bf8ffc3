//! Irradiance from an environment by spherical harmonics (Ramamoorthi and Hanrahan 2001).

use std::f64::consts::PI;

use glam::{DVec3, DVec4, Vec4};

use super::Level;

/// The basis constants of the nine real spherical harmonics up to degree 2, in the order of [`polynomials`].
fn constants() -> [f64; 9] {
    let linear = (3.0 / (4.0 * PI)).sqrt();
    let mixed = (15.0 / (4.0 * PI)).sqrt();
    let zonal = (5.0 / (16.0 * PI)).sqrt();
    [(1.0 / (4.0 * PI)).sqrt(), linear, linear, linear, mixed, mixed, zonal, mixed, mixed / 2.0]
}

/// Their polynomials: 1, y, z, x, xy, yz, 3z^2-1, xz, x^2-y^2.
fn polynomials(n: DVec3) -> [f64; 9] {
    let (x, y, z) = (n.x, n.y, n.z);
    [1.0, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y]
}

/// Factor of each under convolution with the clamped cosine: pi, 2pi/3 and pi/4 for degrees 0, 1 and 2.
fn cosine_lobe(index: usize) -> f64 {
    match index {
        0 => PI,
        1..=3 => 2.0 * PI / 3.0,
        _ => PI / 4.0,
    }
}

/// The coefficients c such that irradiance(n) = sum of `c[i] * polynomial[i](n)`, W/m^2 for radiance in W/(m^2 sr).
///
/// With `L = sum of l[i] k[i] p[i]`, `l[i] = integral of L k[i] p[i]`, a cosine lobe turns each `l[i]` into
/// `A[i] l[i]`, so `c[i] = A[i] k[i]^2 * integral of L p[i]`. Exact for environments without detail above degree 2; the cosine lobe
/// keeps so little of higher degrees that the error of others is a few percent of the brightest direction.
pub fn irradiance(level: &Level) -> [Vec4; 9] {
    let mut sums = [DVec3::ZERO; 9];
    for (direction, angle, radiance) in level.texels() {
        for (sum, p) in sums.iter_mut().zip(polynomials(direction)) {
            *sum += radiance * (p * angle);
        }
    }
    let constants = constants();
    std::array::from_fn(|i| {
        let c: DVec4 = (sums[i] * (cosine_lobe(i) * constants[i] * constants[i])).extend(0.0);
        c.as_vec4()
    })
}

/// The irradiance on a surface with the unit normal `n`.
#[cfg(test)]
pub(super) fn evaluate(coefficients: &[Vec4; 9], n: DVec3) -> DVec3 {
    coefficients.iter().zip(polynomials(n)).map(|(c, p)| c.truncate().as_dvec3() * p).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::environment::Sky;

    fn normals() -> impl Iterator<Item = DVec3> {
        (0..40).map(|i| {
            let z = 1.0 - 2.0 * (f64::from(i) + 0.5) / 40.0;
            let (s, c) = (f64::from(i) * 2.4).sin_cos();
            DVec3::new(c * (1.0 - z * z).sqrt(), s * (1.0 - z * z).sqrt(), z)
        })
    }

    #[test]
    fn constant_radiance_gives_pi_times_it() {
        let level = Level::from_fn(256, 128, |_| DVec3::new(0.5, 1.0, 2.0));
        let c = irradiance(&level);
        for n in normals() {
            let e = evaluate(&c, n);
            assert!((e - DVec3::new(0.5, 1.0, 2.0) * PI).length() < 1e-3, "{n} {e}");
        }
    }

    /// Integral of radiance times cosine over the hemisphere, by the midpoint rule about the normal.
    fn hemisphere(radiance: impl Fn(DVec3) -> DVec3, n: DVec3) -> DVec3 {
        let (t, b) = n.any_orthonormal_pair();
        let (rings, steps) = (200, 200);
        let mut sum = DVec3::ZERO;
        for ring in 0..rings {
            // Equal parts of sin^2 weigh every sample alike: the cosine and the solid angle are in the spacing.
            let s2 = (f64::from(ring) + 0.5) / f64::from(rings);
            for step in 0..steps {
                let (sin, cos) = (2.0 * PI * (f64::from(step) + 0.5) / f64::from(steps)).sin_cos();
                sum += radiance((t * cos + b * sin) * s2.sqrt() + n * (1.0 - s2).sqrt());
            }
        }
        sum * (PI / f64::from(rings * steps))
    }

    #[test]
    fn a_band_limited_sky_agrees_with_the_hemisphere_integral() {
        let sky = |d: DVec3| {
            let p = polynomials(d);
            let red = 2.0 + 0.3 * p[1] - 0.2 * p[4] + 0.1 * p[6];
            let green = 1.5 + 0.4 * p[2] + 0.3 * p[5] - 0.2 * p[8];
            DVec3::new(red, green, 1.0 - 0.5 * p[3] + 0.25 * p[7])
        };
        let c = irradiance(&Level::from_fn(256, 128, sky));
        for n in normals() {
            let (got, want) = (evaluate(&c, n), hemisphere(sky, n));
            assert!((got - want).abs().max_element() < 1e-3, "{n}: {got} for {want}");
        }
    }

    #[test]
    fn the_default_sky_is_within_a_few_percent() {
        let sky = Sky::default();
        let c = irradiance(&Level::from_fn(256, 128, |d| sky.radiance(d)));
        for n in normals() {
            let (got, want) = (evaluate(&c, n), hemisphere(|d| sky.radiance(d), n));
            assert!((got - want).abs().max_element() < 0.08 * want.max_element().max(1.0), "{n}: {got} for {want}");
        }
    }
}
