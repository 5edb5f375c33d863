use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::AtomicUsize;

use super::*;
use crate::{Silent, Stage};

/// Runs `check` without threads to share the work, and with several.
fn on_pools(check: impl Fn() + Sync) {
    for threads in [1, 2, 3] {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool").install(&check);
    }
}

/// Counts that end at blocks, beside them, and in many of them.
const COUNTS: [usize; 8] = [0, 1, 2, 63, 64, 65, 4096 * 64, 4096 * 65 + 1];

#[test]
fn loops_keep_the_order_of_the_numbers() {
    on_pools(|| {
        for count in COUNTS {
            let thrice: Vec<usize> = (0..count).map(|k| 3 * k).collect();
            assert_eq!(collect(count, |k| 3 * k), thrice);
            assert_eq!(try_collect(count, &Silent, |k| 3 * k), Ok(thrice.clone()));
            let mut grown = vec![7];
            grow(&mut grown, count, |before, k| before[0] * k);
            assert!(grown[1..].iter().enumerate().all(|(k, &n)| n == 7 * k) && grown.len() == count + 1);
            let every_third: Vec<u32> = (0..count as u32).step_by(3).collect();
            assert_eq!(filter(count, |k| k.is_multiple_of(3)), every_third);
            let mut twice = vec![0; count];
            for_each_mut(&mut twice, |k, n| *n = 2 * k);
            extend_from_slice(&mut twice, &thrice);
            assert!((0..count).all(|k| twice[k] == 2 * k && twice[count + k] == 3 * k));
            assert_eq!(any(count, |k| k + 1 == count), count > 0);
            assert_eq!(greatest(count, |k| k as f64), count.saturating_sub(1) as f64);
        }
    });
}

#[test]
fn arrays_are_appended_one_behind_the_other() {
    on_pools(|| {
        for count in COUNTS {
            let mut all = vec![9];
            assert_eq!(try_extend_arrays(&mut all, count, &Silent, |k| [k, 2 * k, 3 * k]), Ok(()));
            assert_eq!(all.len(), 1 + 3 * count);
            assert!((0..3 * count).all(|n| all[1 + n] == (n % 3 + 1) * (n / 3)));
        }
    });
}

#[test]
fn growing_moves_the_items_and_keeps_them() {
    on_pools(|| {
        let life = Arc::new(());
        let mut all: Vec<(usize, Arc<()>)> = collect(100_000, |k| (k, life.clone()));
        let room = all.capacity() - all.len();
        assert_eq!(try_reserve(&mut all, room + 1, &StopsAfter(3, AtomicUsize::new(0))), Err(Cancelled));
        assert_eq!(try_reserve(&mut all, room + 1, &Silent), Ok(()));
        assert!(all.capacity() > 100_000 + room && all.iter().enumerate().all(|(k, item)| item.0 == k));
        assert_eq!((all.len(), Arc::strong_count(&life)), (100_000, 100_001));
    });
}

#[test]
fn values_are_scattered_to_ascending_places() {
    on_pools(|| {
        for count in COUNTS {
            let mut items = vec![usize::MAX; 3 * count + 1];
            assert_eq!(try_scatter(&mut items, count, &Silent, |k| 3 * k + 1, |k| 10 * k), Ok(()));
            let wanted = |n: usize| if n % 3 == 1 { n / 3 * 10 } else { usize::MAX };
            assert!(items.iter().enumerate().all(|(n, &item)| item == wanted(n)));
        }
        let descending = |k: usize| 999 - k;
        let scatter = || try_scatter(&mut [0; 1000], 1000, &Silent, descending, |k| k);
        assert!(catch_unwind(AssertUnwindSafe(scatter)).is_err(), "places that do not ascend");
    });
}

#[test]
fn flags_stand_where_something_marks() {
    on_pools(|| {
        for count in COUNTS {
            let mut marked = flags(count + 1, count.div_ceil(2), |k| [2 * k, 2 * k]);
            assert!(marked.iter().enumerate().all(|(k, &is)| is == (k < count && k % 2 == 0)));
            raise(&mut marked, 1, |_| [count]);
            assert!(marked[count]);
        }
    });
}

#[test]
fn what_is_gathered_is_in_order_whatever_each_number_adds() {
    on_pools(|| {
        for count in COUNTS {
            let text =
                |k: usize, found: &mut Vec<String>| found.extend((0..k % 3).map(|n| format!("{k}.{n}")));
            let mut wanted = Vec::new();
            (0..count).for_each(|k| text(k, &mut wanted));
            assert!(gather(count, text) == wanted);
            assert!(try_gather(count, &Silent, text) == Ok(wanted));
        }
    });
}

#[test]
fn blocks_are_the_same_for_any_number_of_threads() {
    on_pools(|| {
        let sums: Vec<(usize, usize)> = blocks(10, 4, |block| (block.start, block.sum()));
        assert_eq!(sums, [(0, 6), (4, 22), (8, 17)]);
        assert_eq!(blocks(0, 4, |block| block.len()), [0; 0]);
    });
}

#[test]
fn each_block_gets_something_of_its_own_to_work_with() {
    on_pools(|| {
        let numbers = collect_with(1000, Vec::new, |seen: &mut Vec<usize>, k| {
            let follows = seen.last().is_none_or(|&last| last + 1 == k);
            seen.push(k);
            (k, follows)
        });
        assert!(numbers.iter().enumerate().all(|(k, &(n, follows))| n == k && follows));
    });
}

#[test]
fn flags_are_raised_while_results_are_collected() {
    on_pools(|| {
        for count in COUNTS {
            let mut flags = vec![false; 2 * count + 1];
            flags[0] = true;
            let doubled = collect_raising(
                &mut flags,
                count,
                || (),
                |(), k, flags| {
                    if !k.is_multiple_of(3) {
                        flags.raise(2 * k);
                    }
                    2 * k
                },
            );
            assert!(doubled.into_iter().eq((0..count).map(|k| 2 * k)));
            let wanted =
                |n: usize| n == 0 || n < 2 * count && n.is_multiple_of(2) && !(n / 2).is_multiple_of(3);
            assert!(flags.into_iter().eq((0..=2 * count).map(wanted)));
        }
    });
}

#[test]
fn both_sides_of_a_join_give_their_results() {
    on_pools(|| {
        let (a, (b, c)) = join(|| vec![1], || join(|| "two", || 3));
        assert_eq!((a, b, c), (vec![1], "two", 3));
    });
}

#[test]
fn sorting_merges_any_number_of_runs() {
    on_pools(|| {
        for count in [0, 5, 16384, 16385, 40000, 16384 * 3, 16384 * 5 + 7] {
            let scrambled = |k: usize| (k as u32).wrapping_mul(2_654_435_761) % 50_000;
            let mut items: Vec<u32> = (0..count).map(scrambled).collect();
            let mut wanted = items.clone();
            wanted.sort_unstable();
            sort(&mut items);
            assert!(items == wanted, "{count}");
        }
    });
}

/// Says stop after some questions.
struct StopsAfter(usize, AtomicUsize);

impl Monitor for StopsAfter {
    fn progress(&self, _: Stage, _: f64) {}
    fn cancelled(&self) -> bool {
        self.1.fetch_add(1, Relaxed) >= self.0
    }
}

#[test]
fn what_is_stopped_appends_nothing_and_soon_ends() {
    on_pools(|| {
        let (stop, made) = (StopsAfter(2, AtomicUsize::new(0)), AtomicUsize::new(0));
        let mut all = vec![1, 2];
        let result = try_extend(&mut all, 64_000, &stop, |k| made.fetch_add(1, Relaxed) + k);
        assert_eq!((result, all), (Err(Cancelled), vec![1, 2]));
        assert_eq!(made.into_inner(), 2000, "the blocks that were allowed, and no others");
        let stop = StopsAfter(0, AtomicUsize::new(0));
        assert_eq!(try_for_each_mut(&mut [1, 2], &stop, |_, n| *n = 9), Err(Cancelled));
        assert_eq!(try_blocks(10, 1, &stop, |block| block.len()), Err(Cancelled));
    });
}

#[test]
fn a_panic_leaves_no_half_made_items() {
    on_pools(|| {
        let life = Arc::new(());
        let mut all = vec![life.clone()];
        let make = |k: usize| if k == 999 { panic!("at {k}") } else { life.clone() };
        let caught = catch_unwind(AssertUnwindSafe(|| extend(&mut all, 1000, make)));
        assert!(caught.is_err() && all.len() == 1);
        let caught = catch_unwind(AssertUnwindSafe(|| filter_map(1000, |k| Some(make(k)))));
        assert!(caught.is_err());
    });
}

#[test]
fn parts_are_moved_and_dropped_once() {
    on_pools(|| {
        let life = Arc::new(());
        let all = gather(1000, |k, found| found.extend(std::iter::repeat_n(life.clone(), k % 4)));
        assert_eq!((all.len(), Arc::strong_count(&life)), (1500, 1501));
        drop(all);
        assert_eq!(Arc::strong_count(&life), 1);
    });
}

#[test]
fn shares_are_all_numbers_in_order() {
    on_pools(|| {
        for (count, len) in [(0, 0), (0, 100_000), (1, 100_000), (2, 100_000), (100, 100), (100, 100_000)] {
            let shares = shares(count, len);
            let expected = if len < 1000 { 1 } else { thread_count().min(count.max(1)) };
            assert_eq!(shares.len(), expected);
            assert!(shares.into_iter().flatten().eq(0..count));
        }
    });
}

/// As a stable sort does by `total_cmp`, whatever the numbers.
#[test]
fn the_greatest_come_first_and_equal_ones_in_their_order() {
    let numbers = [
        1.0,
        -2.0,
        0.0,
        f64::INFINITY,
        -0.0,
        1.0,
        -1e-300,
        f64::NAN,
        -2.0,
        f64::NEG_INFINITY,
        5e-324,
        -f64::NAN,
    ];
    let mut expected: Vec<usize> = (0..numbers.len()).collect();
    expected.sort_by(|&a, &b| numbers[b].total_cmp(&numbers[a]));
    assert_eq!(greatest_first(numbers.into_iter()).collect::<Vec<_>>(), expected);
    let mut items: Vec<usize> = (0..numbers.len()).collect();
    put_greatest_first(&mut items, |&k| numbers[k]);
    assert_eq!(items, expected);
    // Two of each number, the second of them with the lesser owner.
    let twice = (0..).zip(numbers.into_iter().chain(numbers));
    let mut owned: Vec<(f64, u32)> = twice.map(|(k, number)| (number, 100 - k)).collect();
    let mut in_order = owned.clone();
    in_order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    put_least_first(&mut owned);
    let exact = |items: &[(f64, u32)]| items.iter().map(|&(x, of)| (x.to_bits(), of)).collect::<Vec<_>>();
    assert_eq!(exact(&owned), exact(&in_order));
}
