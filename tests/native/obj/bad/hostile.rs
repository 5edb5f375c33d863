//! Files made to break a reader: binary, endless words and lines, names that multiply.
//!
//! The large ones would take hours if any step were quadratic, so that their ending is part of the test.

use hexmill::io::obj;

use super::{TRIANGLE, check, check_after_triangle};

/// Many, for a word or a line: 10 million.
const MANY: usize = 10_000_000;

const MEANT: &str = "a statement starts with a word such as v or f — put '#' before the line to skip it";

#[test]
fn random_bytes() {
    let message = format!("line 1: '\\x9c\\x12\\xff' is not OBJ: {MEANT}");
    check(b"\x9C\x12\xFF\n\x07", "obj-unknown-statement", &message);
}

#[test]
fn nul_bytes_alone() {
    let message = format!("line 1: '{}…' is not OBJ: {MEANT}", "\\0".repeat(40));
    check([0; 1000], "obj-unknown-statement", &message);
}

#[test]
fn nul_byte_in_a_number() {
    let message = "line 1: '0\\0' is not a number: write it like 12, -0.5 or 1.5e-3";
    check("v 0\0 0 0", "obj-bad-number", message);
}

#[test]
fn zeros_after_the_end_of_a_cut_off_download() {
    let message = format!("line 4: '\\0\\0\\0' is not OBJ: {MEANT}");
    check_after_triangle("\0\0\0", "obj-unknown-statement", &message);
}

#[test]
fn control_characters_are_escaped_in_messages() {
    let message = format!("line 4: '\\u{{1b}}[31m' is not OBJ: {MEANT}");
    check_after_triangle("\x1B[31m", "obj-unknown-statement", &message);
}

#[test]
fn number_of_ten_million_digits_that_is_too_large() {
    let message = format!(
        "line 1: '{}…' is beyond what a double holds (about 1.8e308): scale the model",
        "7".repeat(40)
    );
    check(format!("v {} 0 0", "7".repeat(MANY)), "obj-number-too-large", &message);
}

#[test]
fn number_of_ten_million_digits_that_is_fine() {
    let file = format!("v 0.{} 1{}e-{MANY} 0", "3".repeat(MANY), "0".repeat(MANY));
    let mesh = obj::read(file.as_bytes()).unwrap().into_surface().unwrap();
    assert_eq!(mesh.positions[0].to_array(), [1.0 / 3.0, 1.0, 0.0]);
}

#[test]
fn index_of_ten_million_digits() {
    let message = "line 4: vertex 9223372036854775807 is used, but the file has 3 vertices — \
                   correct the index or add the vertex";
    check_after_triangle(&format!("f 1 2 {}", "9".repeat(MANY)), "obj-index-out-of-range", message);
}

#[test]
fn exponent_of_ten_million_digits() {
    let message = format!(
        "line 1: '1e{}…' is beyond what a double holds (about 1.8e308): scale the model",
        "9".repeat(38)
    );
    check(format!("v 1e{} 0 0", "9".repeat(MANY)), "obj-number-too-large", &message);
}

#[test]
fn word_of_ten_million_letters() {
    let message = format!("line 1: '{}…' is not a number: write it like 12, -0.5 or 1.5e-3", "é".repeat(40));
    check(format!("v {}", "é".repeat(MANY / 2)), "obj-bad-number", &message);
}

#[test]
fn line_of_a_hundred_megabytes() {
    let file = format!("{TRIANGLE}f{}\nf 1 2", " 1 2 3".repeat(MANY * 10 / 6));
    let message =
        "line 5: face has 2 nodes; a face needs at least 3 — remove it or write it as an 'l' polyline";
    check(file, "obj-face-too-short", message);
}

#[test]
fn ten_million_continued_lines() {
    let file = format!("{TRIANGLE}f 1 2 3{}0", "\\\n".repeat(MANY));
    let message = "line 10000004: face uses vertex 0; OBJ counts vertices from 1 — add 1 to every index";
    check(file, "obj-index-zero", message);
}

#[test]
fn ten_million_backslashes() {
    let message =
        format!("line 1: '{}…' is not a number: write it like 12, -0.5 or 1.5e-3", r"\\".repeat(40));
    check(format!("v {}", "\\".repeat(MANY)), "obj-bad-number", &message);
}

#[test]
fn counts_of_a_tag_without_end() {
    let message = format!("line 4: '{}…' are no counts of a tag: write them like 2/1/0", "0/".repeat(20));
    check_after_triangle(&format!("t crease {}", "0/".repeat(MANY / 2)), "obj-bad-tag", &message);
}

#[test]
fn long_names_that_multiply() {
    let mut file = format!("{TRIANGLE}g {}\n", "long".repeat(100_000));
    for material in 0..100_000 {
        file += &format!("usemtl {material}\nf 1 2 3\n");
    }
    let error = obj::read(file.as_bytes()).unwrap_err();
    assert_eq!(error.code(), "obj-too-many-names");
    assert!(error.to_string().ends_with("give faces fewer or shorter names"), "{error}");
}

#[test]
fn a_name_for_every_face_is_fine() {
    let mut file = String::from(TRIANGLE);
    for face in 0..100_000 {
        file += &format!("o object {face}\ng group_{face}\nusemtl steel {face}\nf 1 2 3\n");
    }
    let document = obj::read(file.as_bytes()).unwrap();
    assert_eq!(document.tags.sets.len(), 100_000);
}

#[test]
fn mixed_line_ends_are_counted_as_an_editor_does() {
    let message = "line 7: face uses vertex 0; OBJ counts vertices from 1 — add 1 to every index";
    check("v 0 0 0\r\nv 1 0 0\rv 0 1 0\n\r\r\n\nf 0 1 2", "obj-index-zero", message);
}
