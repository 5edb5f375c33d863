//! The same mesh on any number of threads, and the same as in the browser and in Node.

#[path = "../fixtures/cases.rs"]
mod cases;

use cases::{Outcome, cases};

#[test]
fn results_are_those_of_the_fixture_on_any_number_of_threads() {
    let expected: Vec<Outcome> = cases().into_iter().map(|case| case.expected).collect();
    for threads in [1, 2, 4] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let outcomes: Vec<Outcome> = pool.install(|| cases().iter().map(|case| case.run()).collect());
        assert_eq!(outcomes, expected, "on {threads} threads");
    }
}
