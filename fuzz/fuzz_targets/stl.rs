//! Feeds any bytes to the STL reader; see the crate for what it has to keep.
#![no_main]

use hexmill::io::Format;
use hexmill_fuzz::read_and_write;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| read_and_write(Format::Stl, bytes));
