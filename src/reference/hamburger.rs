//! Moment shadow maps (Peters and Klein 2015) over planes: the least shadow that four moments allow, by orthogonal
//! polynomials.

/// Visibility at most, from the moments 1 to 4 of depth and the receiver's depth, on any scale of depth: 1 minus the least
/// share in front of the receiver. Among distributions with these moments it belongs to the one with the fewest depths
/// that has one at the receiver. Those depths are where the kernel polynomial K(x, t) = sum of p_k(x) p_k(t), k to 2, of the
/// orthonormal polynomials vanishes, and 1 / K(x, x) is the share of each (Christoffel numbers).
pub fn hamburger(moments: [f64; 4], receiver: f64) -> f64 {
    let [m1, m2, m3, m4] = moments;
    // p1 = (x - m1) / s, p2 = (x^2 - a x - b) / n.
    let s2 = m2 - m1 * m1;
    let a = (m3 - m1 * m2) / s2;
    let b = m2 - a * m1;
    let n2 = m4 - m2 * m2 - a * (m3 - m1 * m2);
    let kernel = |x: f64, y: f64| {
        let p2 = |z: f64| z * z - a * z - b;
        1.0 + (x - m1) * (y - m1) / s2 + p2(x) * p2(y) / n2
    };
    // K(x, t) as a polynomial in x.
    let high = (receiver * receiver - a * receiver - b) / n2;
    let middle = (receiver - m1) / s2 - a * high;
    let low = 1.0 - m1 * (receiver - m1) / s2 - b * high;
    let root = (middle * middle - 4.0 * high * low).max(0.0).sqrt();
    let q = -0.5 * (middle + middle.signum() * root);
    let depths = [q / high, low / q];
    let shadow: f64 = depths.iter().filter(|z| z.is_finite() && **z < receiver).map(|z| kernel(*z, *z).recip()).sum();
    (1.0 - shadow).clamp(0.0, 1.0)
}

/// Moments 1 to 4 of depths and their shares, with depth stretched to [-1, 1], and a part of them replaced by `wide`
/// moments, 0, w, 0 and w.
pub fn signed_moments(distribution: &[(f64, f64)], bias: f64, wide: f64) -> [f64; 4] {
    [1, 2, 3, 4].map(|power| {
        let own: f64 = distribution.iter().map(|(z, share)| share * (2.0 * z - 1.0).powi(power)).sum();
        let other = if power % 2 == 0 { wide } else { 0.0 };
        own + bias * (other - own)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn visibility(distribution: &[(f64, f64)], receiver: f64, bias: f64) -> f64 {
        hamburger(signed_moments(distribution, bias, 0.375), 2.0 * receiver - 1.0)
    }

    /// Four moments tell two occluders and a receiver apart.
    #[test]
    fn two_occluders_are_exact() {
        for (near, share_near, share_far) in [(0.1, 0.2, 0.3), (0.4, 0.5, 0.1), (0.35, 0.05, 0.9)] {
            let seen = [(near, share_near), (0.5, share_far), (0.8, 1.0 - share_near - share_far)];
            let lit = visibility(&seen, 0.8, 0.0);
            assert!((lit - seen[2].1).abs() < 1e-8, "{lit} {seen:?}");
        }
    }

    /// An occluder, the receiver and what lies behind it: exact as well.
    #[test]
    fn receiver_edges_are_exact() {
        let lit = visibility(&[(0.2, 0.4), (0.5, 0.4), (0.7, 0.2)], 0.5, 0.0);
        assert!((lit - 0.6).abs() < 1e-8, "{lit}");
    }

    /// With fewer depths the moments need a bias; its error is small.
    #[test]
    fn one_occluder_needs_a_bias() {
        for share in [0.0, 0.2, 0.7] {
            let lit = visibility(&[(0.3, share), (0.7, 1.0 - share)], 0.7, 1e-7);
            assert!((lit - (1.0 - share)).abs() < 2e-3, "{share}: {lit}");
        }
    }

    /// The bound is on the lit side, for any number of occluders.
    #[test]
    fn never_darker_than_the_truth() {
        let mut worst = 0.0_f64;
        for i in 1..9 {
            for j in 1..9 {
                let shares = [0.1 * f64::from(i), 0.1 * f64::from(j), 0.35];
                let total: f64 = shares.iter().sum::<f64>() + 0.25;
                let seen =
                    [(0.1, shares[0] / total), (0.3, shares[1] / total), (0.6, shares[2] / total), (0.9, 0.25 / total)];
                let off = visibility(&seen, 0.9, 0.0) - 0.25 / total;
                assert!(off > -1e-9, "{off}");
                worst = worst.max(off);
            }
        }
        // Law T15: the error of three depths is small mostly, but not nothing.
        assert!(worst > 0.005, "three occluders bleed: {worst}");
    }
}
