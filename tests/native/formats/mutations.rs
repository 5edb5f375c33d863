//! Damaged files: whatever happens to the bytes, a reader answers with a mesh or an error, and holds no
//! more memory than the file's size warrants.

use hexmill::io::{AnyMesh, Format, ReadError, inp, medit, msh, vtk, vtu};

use super::allocation::most_held;
use super::foreign;
use super::round_trip::read;
use super::stl;
use super::worlds::{document, hex_grid, quad_grid, some_sets};
use crate::valid::assert_valid;

/// Bytes of memory a reader may hold for a byte of the file, beside a constant. Most of the constant is
/// room for the names and the state of a decompression.
const PER_BYTE: usize = 250;
const CONSTANT: usize = 1 << 16;
/// Deflate packs 1032 bytes into one at most, and the numbers that come out take eight times the space.
const PER_COMPRESSED_BYTE: usize = 12_000;

fn files() -> Vec<(String, Vec<u8>, Format)> {
    let mut files: Vec<(String, Vec<u8>, Format)> =
        foreign::all().map(|(name, bytes, format)| (name.to_owned(), bytes.to_vec(), format)).collect();
    files.push(("ASCII STL".to_owned(), stl::ascii(&stl::TETRAHEDRON).into_bytes(), Format::Stl));
    files.push(("binary STL".to_owned(), stl::binary(&stl::TETRAHEDRON), Format::Stl));
    for mesh in [AnyMesh::Quads(quad_grid(3)), AnyMesh::Hexes(hex_grid(2))] {
        let document = document(mesh, some_sets());
        for (format, write) in [
            (Format::Vtu, vtu::write as fn(&_) -> _),
            (Format::Vtk, vtk::write),
            (Format::Msh, msh::write),
            (Format::Inp, inp::write),
            (Format::Medit, medit::write),
        ] {
            files.push((format!("own {format}"), write(&document).unwrap(), format));
        }
    }
    files
}

/// Reads a damaged file; `what` says in a failure how it was damaged.
fn survive(name: &str, bytes: &[u8], format: Format, what: impl Fn() -> String) -> bool {
    let (result, held) = most_held(|| read(bytes, format));
    let per_byte = if format == Format::Vtu { PER_COMPRESSED_BYTE } else { PER_BYTE };
    assert!(
        held <= per_byte * bytes.len() + CONSTANT,
        "{name}, {}: {held} bytes of memory for {} bytes of file",
        what(),
        bytes.len()
    );
    match &result {
        Ok(document) => assert_valid(document),
        Err(error) => check_error(name, error, what),
    }
    result.is_ok()
}

fn check_error(name: &str, error: &ReadError, what: impl Fn() -> String) {
    assert!(!error.code.is_empty() && error.message.len() > 10, "{name}, {}: {error:?}", what());
    assert_ne!(error.line, Some(0), "{name}, {}", what());
}

/// Numbers that look random and are the same in each run (xorshift, Marsaglia 2003).
fn random(state: &mut u64) -> u64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    *state
}

#[test]
fn files_cut_short_are_refused_or_complete() {
    for (name, bytes, format) in files() {
        for length in 0..bytes.len() {
            survive(&name, &bytes[..length], format, || format!("cut to {length} bytes"));
        }
        assert!(!survive(&name, &bytes[..bytes.len() / 3], format, || "cut to a third".into()), "{name}");
    }
}

#[test]
fn flipped_bytes_never_break_a_reader() {
    let mut state = 0x9E37_79B9_7F4A_7C15;
    for (name, bytes, format) in files() {
        let mut damaged = bytes.clone();
        for at in 0..bytes.len() {
            let replacements = [0, 0xFF, b'9', b'-', b' ', random(&mut state) as u8];
            for byte in replacements {
                damaged[at] = byte;
                survive(&name, &damaged, format, || format!("byte {at} is {byte}"));
            }
            damaged[at] = bytes[at];
        }
    }
}

#[test]
fn several_flipped_bytes_never_break_a_reader() {
    let mut state = 0xD1B5_4A32_D192_ED03;
    for (name, bytes, format) in files() {
        for round in 0..400 {
            let mut damaged = bytes.clone();
            for _ in 0..2 + round % 7 {
                let at = random(&mut state) as usize % bytes.len();
                damaged[at] = random(&mut state) as u8;
            }
            survive(&name, &damaged, format, || format!("round {round}"));
        }
    }
}

/// One piece of damage at a random place, with bytes from `other` where it takes some.
fn damage(bytes: &mut Vec<u8>, other: &[u8], state: &mut u64) {
    const NUMBERS: [&str; 10] =
        ["0", "-1", "1", "2147483648", "4294967296", "18446744073709551615", "nan", "-inf", "1e999", "0.5"];
    let mut below = |limit: usize| random(state) as usize % limit.max(1);
    if bytes.is_empty() {
        return;
    }
    let at = below(bytes.len());
    let end = |length: usize| (at + length).min(bytes.len());
    match below(6) {
        0 => bytes[at] ^= 1 << below(8),
        1 => bytes.truncate(at),
        2 => drop(bytes.drain(at..end(1 + below(40)))),
        3 => {
            // From a place of the other file into this one.
            let from = below(other.len());
            let to = (from + 1 + below(200)).min(other.len());
            let end = end(below(200));
            bytes.splice(at..end, other[from..to].iter().copied());
        }
        4 => {
            let piece = bytes[at..end(1 + below(60))].to_vec();
            bytes.splice(at..at, piece);
        }
        _ => {
            // The number at this place or after it.
            let is_digit = |b: &u8| b.is_ascii_digit();
            let Some(start) = bytes[at..].iter().position(is_digit).map(|step| at + step) else { return };
            let length = bytes[start..].iter().take_while(|b| is_digit(b)).count();
            bytes.splice(start..start + length, NUMBERS[below(NUMBERS.len())].bytes());
        }
    }
}

/// The fuzzers' work on a small scale: 200 files from each, with one to four pieces of damage.
#[test]
fn damage_of_all_kinds_never_breaks_a_reader() {
    let mut state = 0xA076_1D64_78BD_642F;
    let files = files();
    for (name, bytes, format) in &files {
        let alike: Vec<&Vec<u8>> = files.iter().filter(|(_, _, f)| f == format).map(|(_, b, _)| b).collect();
        for round in 0..200 {
            let mut damaged = bytes.clone();
            for _ in 0..1 + round % 4 {
                let other = alike[random(&mut state) as usize % alike.len()];
                damage(&mut damaged, other, &mut state);
            }
            survive(name, &damaged, *format, || format!("round {round}"));
        }
    }
}

#[test]
fn numbers_that_claim_too_much_allocate_nothing() {
    for (name, bytes, format) in files() {
        let is_digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
        for start in (0..bytes.len()).filter(|&at| is_digit(at) && (at == 0 || !is_digit(at - 1))) {
            let end = (start..).find(|&at| !is_digit(at)).unwrap();
            for claim in ["1000000000000", "4294967295", "9223372036854775807", "99999999999999999999", "-1"]
            {
                let damaged = [&bytes[..start], claim.as_bytes(), &bytes[end..]].concat();
                survive(&name, &damaged, format, || format!("the number at byte {start} is {claim}"));
            }
        }
    }
}

#[test]
fn sizes_of_binary_data_that_claim_too_much_allocate_nothing() {
    for (name, bytes, format) in files() {
        for at in 0..bytes.len().saturating_sub(8) {
            for claim in [[0xFF; 8], [0, 0, 0, 0, 0, 1, 0, 0], [0xFF, 0xFF, 0xFF, 0x7F, 0, 0, 0, 0]] {
                let mut damaged = bytes.clone();
                damaged[at..at + 8].copy_from_slice(&claim);
                survive(&name, &damaged, format, || format!("eight bytes at {at} are {claim:?}"));
            }
        }
    }
}
