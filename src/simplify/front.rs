//! What nothing beats: points that no other undercuts in both cost and error.

/// Indices of the points (cost, error) that no other point undercuts or equals in both, from the dearest to the cheapest.
/// Errors rise strictly along it, and costs fall strictly. Of equal points the first stays.
pub fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<usize> =
        (0..points.len()).filter(|i| points[*i].0.is_finite() && points[*i].1.is_finite()).collect();
    // By error, then by cost: whatever is cheaper than all before it is on the front.
    order.sort_by(|a, b| points[*a].1.total_cmp(&points[*b].1).then(points[*a].0.total_cmp(&points[*b].0)));
    let mut cheapest = f64::INFINITY;
    order.retain(|i| {
        let on = points[*i].0 < cheapest;
        cheapest = cheapest.min(points[*i].0);
        on
    });
    order
}

/// At most `most` of the points of a front, which runs from the dearest to the cheapest: its ends stay, and between them
/// what makes steps of like size. Taken out is, again and again, what saves least over the one before it.
pub fn thinned(points: &[(f64, f64)], front: &[usize], most: usize) -> Vec<usize> {
    let mut kept = front.to_vec();
    while kept.len() > most.max(1) {
        if kept.len() == 2 {
            // One may stay: the dearest, which is what everything is measured against.
            kept.pop();
            continue;
        }
        let saving = |i: &usize| points[kept[*i - 1]].0 - points[kept[*i]].0;
        let least = (1..kept.len() - 1).min_by(|a, b| saving(a).total_cmp(&saving(b)));
        match least {
            Some(least) => drop(kept.remove(least)),
            None => break,
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_nothing_beats_is_on_the_front() {
        let points =
            [(10.0, 0.0), (8.0, 0.1), (9.0, 0.2), (5.0, 0.3), (5.0, 0.2), (5.0, 0.2), (f64::NAN, 0.0), (1.0, 0.9)];
        assert_eq!(front(&points), [0, 1, 4, 7]);
        assert_eq!(front(&[]), [0usize; 0]);
    }

    #[test]
    fn ends_stay_and_small_steps_go() {
        let points = [(10.0, 0.0), (9.5, 0.1), (6.0, 0.2), (5.5, 0.3), (1.0, 0.9)];
        let all = front(&points);
        assert_eq!(thinned(&points, &all, 5), all);
        assert_eq!(thinned(&points, &all, 3), [0, 2, 4]);
        assert_eq!(thinned(&points, &all, 2), [0, 4]);
        assert_eq!(thinned(&points, &all, 1), [0]);
    }
}
