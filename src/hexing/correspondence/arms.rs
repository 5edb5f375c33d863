//! Which edges at a node the curves at a corner leave along: in the same cyclic order.

/// Assigns `arms` arms, in cyclic order, to some of `spokes` spokes, in cyclic order, so that the sum of their values is
/// greatest. `value` is that of an arm on a spoke, and `None` where it may not take it; `between` that of so many quads between
/// an arm and the next. `None` if nothing is allowed; the spoke of each arm otherwise.
///
/// By dynamic programming, once for each spoke that the first arm may take.
pub(super) fn assign_arms(
    arms: usize,
    spokes: usize,
    value: impl Fn(usize, usize) -> Option<f64>,
    between: impl Fn(usize, usize) -> f64,
) -> Option<(f64, Vec<usize>)> {
    if arms == 0 {
        return Some((0.0, Vec::new()));
    }
    if arms > spokes {
        return None;
    }
    let values: Vec<Option<f64>> = (0..arms * spokes).map(|k| value(k / spokes, k % spokes)).collect();
    let mut best: Option<(f64, Vec<usize>)> = None;
    for turn in 0..spokes {
        let turned = |arm: usize, spoke: usize| values[arm * spokes + (spoke + turn) % spokes];
        let Some((sum, places)) = from_first(arms, spokes, turned, &between) else { continue };
        if best.as_ref().is_none_or(|(most, _)| sum > *most) {
            best = Some((sum, places.into_iter().map(|s| (s + turn) % spokes).collect()));
        }
    }
    best
}

/// The same where the first arm takes the first spoke.
fn from_first(
    arms: usize,
    spokes: usize,
    value: impl Fn(usize, usize) -> Option<f64>,
    between: impl Fn(usize, usize) -> f64,
) -> Option<(f64, Vec<usize>)> {
    let none = f64::NEG_INFINITY;
    // The most that the arms up to each get where it takes a spoke, and the spoke of the one before.
    let mut most = vec![(none, 0); arms * spokes];
    most[0].0 = value(0, 0)?;
    for arm in 1..arms {
        for spoke in arm..spokes {
            let Some(value) = value(arm, spoke) else { continue };
            for before in arm - 1..spoke {
                let sum = most[(arm - 1) * spokes + before].0 + between(arm - 1, spoke - before) + value;
                if sum > most[arm * spokes + spoke].0 {
                    most[arm * spokes + spoke] = (sum, before);
                }
            }
        }
    }
    let whole = |spoke: usize| most[(arms - 1) * spokes + spoke].0 + between(arms - 1, spokes - spoke);
    let mut last = (arms - 1..spokes).max_by(|&a, &b| whole(a).total_cmp(&whole(b)).then(b.cmp(&a)))?;
    let sum = whole(last);
    if sum == none {
        return None;
    }
    let mut places = vec![0; arms];
    for arm in (0..arms).rev() {
        places[arm] = last;
        last = most[arm * spokes + last].1;
    }
    Some((sum, places))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// All ways to give the arms spokes in cyclic order, the first arm's first.
    fn ways(arms: usize, spokes: usize) -> Vec<Vec<usize>> {
        let mut ways: Vec<Vec<usize>> = (0..spokes).map(|first| vec![first]).collect();
        for left in (0..arms - 1).rev() {
            let go_on = |way: Vec<usize>| {
                let last = way[way.len() - 1] + 1;
                let most = way[0] + spokes - left;
                (last..most).map(move |next| way.iter().copied().chain([next]).collect())
            };
            ways = ways.into_iter().flat_map(go_on).collect();
        }
        ways
    }

    proptest! {
        #[test]
        fn no_way_is_worth_more(
            arms in 1usize..5,
            more in 0usize..4,
            values in prop::collection::vec(prop::option::weighted(0.8, -2i32..3), 32),
            quads in prop::collection::vec(-2i32..3, 36),
        ) {
            let spokes = arms + more;
            let value = |arm: usize, spoke: usize| values[8 * arm + spoke].map(f64::from);
            let between = |arm: usize, count: usize| f64::from(quads[9 * arm + count]);
            let worth = |way: &[usize]| -> Option<f64> {
                let of_arm = |k: usize| {
                    let next = way.get(k + 1).copied().unwrap_or(way[0] + spokes);
                    Some(value(k, way[k] % spokes)? + between(k, next - way[k]))
                };
                (0..arms).map(of_arm).sum()
            };
            let most = ways(arms, spokes).iter().filter_map(|way| worth(way)).reduce(f64::max);
            let found = assign_arms(arms, spokes, value, between);
            prop_assert_eq!(found.as_ref().map(|(sum, _)| *sum), most);
            if let Some((sum, mut places)) = found {
                for k in 1..arms {
                    places[k] += if places[k] < places[0] { spokes } else { 0 };
                    prop_assert!(places[k - 1] < places[k] && places[k] < places[0] + spokes);
                }
                prop_assert_eq!(worth(&places), Some(sum));
            }
        }
    }
}
