//! The same mesh on any number of threads, and the same as in the browser and in Node.

#[path = "../fixtures/cases.rs"]
mod cases;
#[path = "../fixtures/hex_cases.rs"]
mod hex_cases;
#[path = "../fixtures/solid_cases.rs"]
mod solid_cases;

use cases::cases;
use hex_cases::hex_cases;
use hexmill::io::Format;
use sha2::{Digest, Sha256};
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

#[test]
fn files_are_those_of_the_fixture_to_the_last_byte() {
    for case in cases() {
        let written = case.written();
        let digests = written.iter().map(|(&name, bytes)| (name, format!("{:x}", Sha256::digest(bytes))));
        let expected = case.files.iter().map(|(name, digest)| (name.as_str(), digest.clone()));
        assert_eq!(digests.collect::<Vec<_>>(), expected.collect::<Vec<_>>(), "{}", case.name);
    }
    assert!(cases().iter().any(|case| case.files.len() == Format::ALL.len() - 1), "STL alone is not written");
}
