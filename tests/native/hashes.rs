//! The same mesh on any number of threads, and the same as in the browser and in Node.

#[path = "../fixtures/cases.rs"]
mod cases;
#[path = "../fixtures/hex_cases.rs"]
mod hex_cases;
#[path = "../fixtures/solid_cases.rs"]
mod solid_cases;

use cases::cases;
use hex_cases::hex_cases;
use solid_cases::solid_cases;

#[test]
fn results_are_those_of_the_fixture_on_any_number_of_threads() {
    for threads in [1, 2, 4] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        for case in cases() {
            let outcome = pool.install(|| case.run());
            assert_eq!(outcome, case.expected, "{} on {threads} threads", case.name);
        }
        for case in hex_cases() {
            let outcome = pool.install(|| case.run());
            assert_eq!(outcome, case.expected, "{} on {threads} threads", case.name);
        }
        for case in solid_cases() {
            let outcome = pool.install(|| case.run());
            assert_eq!(outcome, case.expected, "{} on {threads} threads", case.name);
        }
    }
}
