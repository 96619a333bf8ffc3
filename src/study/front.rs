//! Which points no other point beats, and who wins within a budget.

/// The places of the points that no other beats, by rising x: none lies at most as far along both axes and nearer along one.
/// Of equal points the first counts. Points with a coordinate that is no number are never among them.
pub fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<usize> =
        (0..points.len()).filter(|i| points[*i].0.is_finite() && points[*i].1.is_finite()).collect();
    order.sort_by(|a, b| {
        let ((ax, ay), (bx, by)) = (points[*a], points[*b]);
        ax.total_cmp(&bx).then(ay.total_cmp(&by)).then(a.cmp(b))
    });
    let mut least = f64::INFINITY;
    order.retain(|i| {
        let better = points[*i].1 < least;
        least = least.min(points[*i].1);
        better
    });
    order
}

/// The place of the point with the least y among those with at most this x: the last of the front that fits.
pub fn best_within(points: &[(f64, f64)], front: &[usize], x: f64) -> Option<usize> {
    front.iter().copied().rfind(|i| points[*i].0 <= x)
}

/// The place of the point with the least x among those with at most this y.
pub fn cheapest_within(points: &[(f64, f64)], front: &[usize], y: f64) -> Option<usize> {
    front.iter().copied().find(|i| points[*i].1 <= y)
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: [(f64, f64); 8] = [
        (2.0, 5.0), // beaten by (2, 3)
        (1.0, 9.0),
        (2.0, 3.0),
        (4.0, 3.0), // beaten: as far, and dearer
        (5.0, 1.0),
        (5.0, 1.0), // the same again
        (9.0, 4.0),
        (f64::NAN, 0.0),
    ];

    #[test]
    fn the_front_is_what_nothing_beats() {
        assert_eq!(front(&POINTS), [1, 2, 4]);
        assert_eq!(front(&[]), [] as [usize; 0]);
        // Whatever is not on it is beaten, or equal to one that is.
        let on = front(&POINTS);
        for (x, y) in POINTS.iter().filter(|p| p.0.is_finite()) {
            assert!(on.iter().any(|i| POINTS[*i].0 <= *x && POINTS[*i].1 <= *y));
        }
    }

    #[test]
    fn budgets_have_winners() {
        let on = front(&POINTS);
        let best = |x| best_within(&POINTS, &on, x);
        assert_eq!((best(0.5), best(1.0), best(4.9), best(100.0)), (None, Some(1), Some(2), Some(4)));
        let cheap = |y| cheapest_within(&POINTS, &on, y);
        assert_eq!((cheap(0.5), cheap(1.0), cheap(4.0), cheap(9.0)), (None, Some(4), Some(2), Some(1)));
    }
}
