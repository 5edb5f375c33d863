//! Vertices and the numbers in them.

use super::check;

const NOT_FINITE: &str = "is not a finite number: a node needs a place in space";
const NOT_A_NUMBER: &str = "is not a number: write it like 12, -0.5 or 1.5e-3";
const SIZE: &str = "write x y z, with a weight (4), a colour (6) or both (7)";

#[test]
fn vertex_of_two_numbers() {
    check("v 0 0 0\nv 1 2\n", "obj-vertex-size", &format!("line 2: vertex has 2 numbers; {SIZE}"));
}

#[test]
fn vertex_of_one_number() {
    check("v 1", "obj-vertex-size", &format!("line 1: vertex has 1 number; {SIZE}"));
}

#[test]
fn vertex_without_numbers() {
    check("\n\nv\n", "obj-vertex-size", &format!("line 3: vertex has 0 numbers; {SIZE}"));
}

#[test]
fn vertex_of_five_numbers() {
    check("v 1 2 3 4 5", "obj-vertex-size", &format!("line 1: vertex has 5 numbers; {SIZE}"));
}

#[test]
fn vertex_of_eight_numbers() {
    check("v 1 2 3 4 5 6 7 8", "obj-vertex-size", &format!("line 1: vertex has 8 numbers; {SIZE}"));
}

#[test]
fn vertex_cut_short_by_a_comment() {
    check("v 1 2 # 3", "obj-vertex-size", &format!("line 1: vertex has 2 numbers; {SIZE}"));
}

#[test]
fn vertex_cut_short_on_a_continued_line() {
    check("v 1 \\\n2\nf 1 1 1", "obj-vertex-size", &format!("line 1: vertex has 2 numbers; {SIZE}"));
}

#[test]
fn nan() {
    check("v 0 nan 0", "obj-not-finite", &format!("line 1: 'nan' {NOT_FINITE}"));
}

#[test]
fn nan_with_sign_and_payload() {
    check("v 0 -NaN(ind) 0", "obj-not-finite", &format!("line 1: '-NaN(ind)' {NOT_FINITE}"));
}

#[test]
fn microsoft_nan() {
    check("v 0 0 -1.#IND", "obj-not-finite", &format!("line 1: '-1.#IND' {NOT_FINITE}"));
}

#[test]
fn infinity() {
    check("v 0 0 0\nv +Infinity 0 0", "obj-not-finite", &format!("line 2: '+Infinity' {NOT_FINITE}"));
}

#[test]
fn number_beyond_a_double() {
    let message = "line 1: '1e309' is beyond what a double holds (about 1.8e308): scale the model";
    check("v 1e309 0 0", "obj-number-too-large", message);
}

#[test]
fn hexadecimal_number() {
    check("v 0 0x1F 0", "obj-bad-number", "line 1: '0x1F' is hexadecimal: write it in decimal digits");
}

#[test]
fn decimal_comma() {
    check("v 0 1,5 0", "obj-bad-number", "line 1: '1,5' has a comma: write a decimal point");
}

#[test]
fn number_with_a_unit() {
    check("v 0 15mm 0", "obj-bad-number", &format!("line 1: '15mm' {NOT_A_NUMBER}"));
}

#[test]
fn number_with_two_points() {
    check("v 1.2.3 0 0", "obj-bad-number", &format!("line 1: '1.2.3' {NOT_A_NUMBER}"));
}

#[test]
fn exponent_without_digits() {
    check("v 1e 0 0", "obj-bad-number", &format!("line 1: '1e' {NOT_A_NUMBER}"));
}

#[test]
fn sign_alone() {
    check("v - 0 0", "obj-bad-number", &format!("line 1: '-' {NOT_A_NUMBER}"));
}

#[test]
fn point_alone() {
    check("v . 0 0", "obj-bad-number", &format!("line 1: '.' {NOT_A_NUMBER}"));
}

#[test]
fn digits_of_another_script() {
    check("v ٣ 0 0", "obj-bad-number", &format!("line 1: '٣' {NOT_A_NUMBER}"));
}

#[test]
fn word_in_place_of_a_number() {
    check("v 0 0 0\n\nv a b c\n", "obj-bad-number", &format!("line 3: 'a' {NOT_A_NUMBER}"));
}

#[test]
fn the_line_of_a_number_on_a_continued_line() {
    check("v 0 \\\n 0 \\\n oops", "obj-bad-number", &format!("line 3: 'oops' {NOT_A_NUMBER}"));
}
