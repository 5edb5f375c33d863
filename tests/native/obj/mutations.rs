//! Real OBJ text with random damage: the reader neither panics nor holds more than the file is worth.

use hexmill::io::{Document, obj};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select};

use crate::valid::assert_valid;

/// A file with every statement that the reader knows.
const TEXT: &str = "\u{feff}# a file with everything\r\nmtllib a.mtl\nv 0 0 0\nv 1.5e0 0 0 1.0\r\nv 1 1 0 0.5 0.5 0.5\n\
v 0 1.0D+00 0\no part one\ng wall left\nusemtl Material #25\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3//1 4/1\n\
f -4 -3 \\\n -2\nl 1 2 3\np 1\nt crease 2/1/0 0 1 2.5\nt corner 1/1/0 2 10\nt interpolateboundary 1/0/0 2\n\
s off\rf 1 2 3\nf 5 6 7\nv 9 9 9\nv 8 8 8\nv 7 7 7\n";

/// Pieces that readers have stumbled over.
const PIECES: &[&str] = &[
    "\0",
    "\r",
    "\n",
    "\\\n",
    "\\\r\n",
    "\\",
    "#",
    "/",
    "//",
    "-",
    "+",
    ".",
    "e",
    "D",
    "nan",
    "-inf",
    "1e999",
    "0x1",
    "99999999999999999999",
    "4294967296",
    "-2147483649",
    "v",
    "f ",
    "\nf 1 2 3\n",
    "\nv 1 2 3\n",
    "\nt crease 4/2/0 ",
    "\ng \n",
    "\nusemtl\n",
    "\u{feff}",
    "é",
    "\u{1F600}",
    "\nfo 1 1 1\n",
    " ",
    "\t",
    "\x0B",
];

/// One piece of damage at a place of the text.
#[derive(Clone, Debug)]
enum Damage {
    Insert(&'static str),
    Remove(usize),
    Replace(u8),
    Repeat(usize),
    CutHere,
}

fn damage() -> impl Strategy<Value = Damage> {
    prop_oneof![
        select(PIECES).prop_map(Damage::Insert),
        (1..9_usize).prop_map(Damage::Remove),
        any::<u8>().prop_map(Damage::Replace),
        (1..60_usize).prop_map(Damage::Repeat),
        Just(Damage::CutHere),
    ]
}

fn apply(text: &mut Vec<u8>, place: &Index, damage: Damage) {
    if text.is_empty() {
        return;
    }
    let at = place.index(text.len());
    let end = |length: usize| (at + length).min(text.len());
    match damage {
        Damage::Insert(piece) => drop(text.splice(at..at, piece.bytes())),
        Damage::Remove(length) => drop(text.drain(at..end(length))),
        Damage::Replace(byte) => text[at] = byte,
        Damage::Repeat(length) => {
            let piece = text[at..end(length)].to_vec();
            drop(text.splice(at..at, piece));
        }
        Damage::CutHere => text.truncate(at),
    }
}

/// Checks that what was read is a mesh, and no larger than its file can tell.
fn check_document(document: Document, file_length: usize) {
    assert_valid(&document);
    let mesh = document.into_surface().expect("OBJ gives surfaces");
    assert!(mesh.positions.len() * "v 0 0 0".len() <= file_length);
    assert!(mesh.corners.len() * 2 <= file_length);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn damaged_files_are_read_or_refused(places in vec((any::<Index>(), damage()), 1..6)) {
        let mut text = TEXT.as_bytes().to_vec();
        for (place, damage) in places {
            apply(&mut text, &place, damage);
        }
        match obj::read(&text) {
            Ok(document) => check_document(document, text.len()),
            Err(error) => {
                prop_assert!(error.code().starts_with("obj-"));
                // Every message says what to do after one of these.
                prop_assert!(error.message.contains([':', ';', '—']), "{}", error);
                prop_assert!(error.message.chars().count() < 400, "{}", error);
                prop_assert!(error.line.is_none_or(|line| line as usize <= text.len() + 1));
            }
        }
    }

    #[test]
    fn random_bytes_are_read_or_refused(bytes in vec(any::<u8>(), 0..200)) {
        if let Ok(document) = obj::read(&bytes) {
            check_document(document, bytes.len());
        }
    }
}

#[test]
fn the_undamaged_file_is_read() {
    let document = obj::read(TEXT.as_bytes()).unwrap();
    assert_eq!((document.mesh.node_count(), document.mesh.cell_count()), (7, 4));
    check_document(document, TEXT.len());
}
