//! Which edges at a node the curves at a corner leave along: in the same cyclic order.

/// Assigns `arms` arms, in cyclic order, to some of `spokes` spokes, in cyclic order, so that the sum of their values is
/// greatest. `value` is `None` where an arm may not take a spoke. `None` if nothing is allowed; the spoke of each arm
/// otherwise.
///
/// By dynamic programming, once for each spoke that the first arm may take.
pub(super) fn assign_arms(
    arms: usize,
    spokes: usize,
    value: impl Fn(usize, usize) -> Option<f64>,
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
        let Some(first) = turned(0, 0) else { continue };
        let Some((rest, places)) = ascending(arms - 1, spokes - 1, |a, s| turned(a + 1, s + 1)) else {
            continue;
        };
        if best.as_ref().is_none_or(|(most, _)| first + rest > *most) {
            let others = places.into_iter().map(|s| (s + 1 + turn) % spokes);
            best = Some((first + rest, [turn].into_iter().chain(others).collect()));
        }
    }
    best
}

/// The same without a cycle: the spokes ascend.
fn ascending(
    arms: usize,
    spokes: usize,
    value: impl Fn(usize, usize) -> Option<f64>,
) -> Option<(f64, Vec<usize>)> {
    let none = f64::NEG_INFINITY;
    // The most that the first arms can get from the first spokes.
    let mut most = vec![vec![none; spokes + 1]; arms + 1];
    most[0].fill(0.0);
    for arm in 0..arms {
        for spoke in arm..spokes {
            let taken = value(arm, spoke).map_or(none, |v| most[arm][spoke] + v);
            most[arm + 1][spoke + 1] = taken.max(most[arm + 1][spoke]);
        }
    }
    if most[arms][spokes] == none {
        return None;
    }
    let mut places = vec![0; arms];
    let mut end = spokes;
    for arm in (0..arms).rev() {
        while most[arm + 1][end - 1] == most[arm + 1][end] {
            end -= 1;
        }
        end -= 1;
        places[arm] = end;
    }
    Some((most[arms][spokes], places))
}
