//! Least-cost assignment of links to ports, and whether it is the only one.

/// Cost of a pairing that is not possible.
pub(crate) const NEVER: u64 = u64::MAX / 1024;

/// For each row the column that it takes, such that the sum of `cost[row][column]` is least and no column is taken
/// twice; none if some row must stay without. There must not be more rows than columns. Hungarian method, O(rows^2
/// columns).
pub(crate) fn assign(cost: &[Vec<u64>]) -> Option<(u64, Vec<usize>)> {
    let rows = cost.len();
    let columns = cost.first().map_or(0, Vec::len);
    if rows > columns {
        return None;
    }
    if let [row] = cost {
        let (column, least) = row.iter().copied().enumerate().min_by_key(|(_, c)| *c)?;
        return (least < NEVER).then(|| (least, vec![column]));
    }
    let at = |r: usize, c: usize| i128::from(cost[r - 1][c - 1]);
    let (mut row_price, mut column_price) = (vec![0_i128; rows + 1], vec![0_i128; columns + 1]);
    let (mut taken_by, mut way) = (vec![0; columns + 1], vec![0; columns + 1]);
    for row in 1..=rows {
        taken_by[0] = row;
        let mut column = 0;
        let mut least = vec![i128::MAX; columns + 1];
        let mut used = vec![false; columns + 1];
        while taken_by[column] != 0 {
            used[column] = true;
            let current = taken_by[column];
            let (mut delta, mut next) = (i128::MAX, 0);
            for c in 1..=columns {
                if used[c] {
                    continue;
                }
                let slack = at(current, c) - row_price[current] - column_price[c];
                if slack < least[c] {
                    (least[c], way[c]) = (slack, column);
                }
                if least[c] < delta {
                    (delta, next) = (least[c], c);
                }
            }
            for c in 0..=columns {
                if used[c] {
                    row_price[taken_by[c]] += delta;
                    column_price[c] -= delta;
                } else {
                    least[c] -= delta;
                }
            }
            column = next;
        }
        while column != 0 {
            let before = way[column];
            taken_by[column] = taken_by[before];
            column = before;
        }
    }
    let mut chosen = vec![0; rows];
    for c in 1..=columns {
        if taken_by[c] != 0 {
            chosen[taken_by[c] - 1] = c - 1;
        }
    }
    let total = chosen.iter().enumerate().map(|(r, &c)| cost[r][c]).fold(0_u64, u64::saturating_add);
    (total < NEVER).then_some((total, chosen))
}

/// A row that could take another column at no greater total cost, with that column.
pub(crate) fn alternative(cost: &[Vec<u64>], total: u64, chosen: &[usize]) -> Option<(usize, usize)> {
    if let ([row], [column]) = (cost, chosen) {
        return row.iter().enumerate().position(|(c, price)| c != *column && *price == total).map(|other| (0, other));
    }
    for (row, &column) in chosen.iter().enumerate() {
        let mut without = cost.to_vec();
        without[row][column] = NEVER;
        if let Some((other, columns)) = assign(&without)
            && other == total
        {
            return Some((row, columns[row]));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every assignment, tried one by one.
    fn exhaustive(cost: &[Vec<u64>]) -> (u64, usize) {
        fn go(cost: &[Vec<u64>], row: usize, taken: &mut Vec<bool>, sum: u64, best: &mut (u64, usize)) {
            if row == cost.len() {
                match sum.cmp(&best.0) {
                    std::cmp::Ordering::Less => *best = (sum, 1),
                    std::cmp::Ordering::Equal => best.1 += 1,
                    std::cmp::Ordering::Greater => {}
                }
                return;
            }
            for c in 0..taken.len() {
                if !taken[c] && cost[row][c] < NEVER {
                    taken[c] = true;
                    go(cost, row + 1, taken, sum + cost[row][c], best);
                    taken[c] = false;
                }
            }
        }
        let mut best = (NEVER, 0);
        go(cost, 0, &mut vec![false; cost.first().map_or(0, Vec::len)], 0, &mut best);
        best
    }

    proptest::proptest! {
        #[test]
        fn agrees_with_trying_everything(
            rows in 1_usize..5, extra in 0_usize..3, seed in proptest::collection::vec(0_u64..6, 40),
        ) {
            let columns = rows + extra;
            let cost: Vec<Vec<u64>> = (0..rows)
                .map(|r| (0..columns).map(|c| match seed[(r * columns + c) % 40] { 5 => NEVER, x => x }).collect())
                .collect();
            let (least, count) = exhaustive(&cost);
            match assign(&cost) {
                Some((total, chosen)) => {
                    proptest::prop_assert_eq!(total, least);
                    proptest::prop_assert_eq!(alternative(&cost, total, &chosen).is_some(), count > 1);
                }
                None => proptest::prop_assert_eq!(least, NEVER),
            }
        }
    }
}
