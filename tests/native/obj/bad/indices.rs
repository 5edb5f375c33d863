//! Faces, polylines and the vertices they name.

use super::{check, check_after_triangle};

const NOT_A_CORNER: &str = "is not a corner: write v, v/vt, v//vn or v/vt/vn in whole numbers";
const CORRECT: &str = "correct the index or add the vertex";

#[test]
fn face_of_no_vertices() {
    let message =
        "line 4: face has 0 nodes; a face needs at least 3 — remove it or write it as an 'l' polyline";
    check_after_triangle("f\n", "obj-face-too-short", message);
}

#[test]
fn face_of_one_vertex() {
    let message =
        "line 4: face has 1 node; a face needs at least 3 — remove it or write it as an 'l' polyline";
    check_after_triangle("f 1\n", "obj-face-too-short", message);
}

#[test]
fn face_of_two_vertices() {
    let message =
        "line 5: face has 2 nodes; a face needs at least 3 — remove it or write it as an 'l' polyline";
    check_after_triangle("\nf 1/1 2/2 # 3/3\n", "obj-face-too-short", message);
}

#[test]
fn polyline_of_one_vertex() {
    check_after_triangle(
        "l 1",
        "obj-polyline-too-short",
        "line 4: polyline has 1 nodes; it needs at least 2 — remove it",
    );
}

#[test]
fn index_zero() {
    let message = "line 4: face uses vertex 0; OBJ counts vertices from 1 — add 1 to every index";
    check_after_triangle("f 0 1 2", "obj-index-zero", message);
}

#[test]
fn minus_zero() {
    let message = "line 4: polyline uses vertex 0; OBJ counts vertices from 1 — add 1 to every index";
    check_after_triangle("l 1 -0", "obj-index-zero", message);
}

#[test]
fn index_beyond_the_last_vertex() {
    let message = format!("line 4: vertex 4 is used, but the file has 3 vertices — {CORRECT}");
    check_after_triangle("f 1 2 4\nf 1 2 9", "obj-index-out-of-range", &message);
}

#[test]
fn faces_before_vertices_that_never_come() {
    let message = format!("line 2: vertex 5 is used, but the file has 3 vertices — {CORRECT}");
    check("f 1 2 3\nf 1 2 5\nf 1 2 6\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", "obj-index-out-of-range", &message);
}

#[test]
fn faces_without_any_vertex() {
    let message = format!("line 1: vertex 1 is used, but the file has 0 vertices — {CORRECT}");
    check("f 1 2 3\n", "obj-index-out-of-range", &message);
}

#[test]
fn negative_index_before_the_first_vertex() {
    let message = "line 4: face uses vertex -4, counted back from this line, but only 3 vertices stand above it — \
                   move the vertices up or correct the index";
    check_after_triangle("f -1 -2 -4\nv 9 9 9\n", "obj-index-out-of-range", message);
}

#[test]
fn negative_indices_before_the_vertices() {
    let message = "line 1: face uses vertex -3, counted back from this line, but only 0 vertices stand above it — \
                   move the vertices up or correct the index";
    check("f -3 -2 -1\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", "obj-index-out-of-range", message);
}

#[test]
fn index_of_two_to_the_32() {
    let message = format!("line 4: vertex 4294967296 is used, but the file has 3 vertices — {CORRECT}");
    check_after_triangle("f 1 2 4294967296", "obj-index-out-of-range", &message);
}

#[test]
fn index_that_wraps_around_to_a_vertex() {
    let message = format!("line 4: vertex 4294967297 is used, but the file has 3 vertices — {CORRECT}");
    check_after_triangle("f 4294967297 4294967298 4294967299", "obj-index-out-of-range", &message);
}

#[test]
fn index_beyond_64_bits() {
    let message =
        format!("line 4: vertex 9223372036854775807 is used, but the file has 3 vertices — {CORRECT}");
    check_after_triangle("f 1 2 18446744073709551617", "obj-index-out-of-range", &message);
}

#[test]
fn negative_index_beyond_64_bits() {
    let message = "line 4: face uses vertex -9223372036854775807, counted back from this line, but only 3 vertices \
                   stand above it — move the vertices up or correct the index";
    check_after_triangle("f 1 2 -18446744073709551615", "obj-index-out-of-range", message);
}

#[test]
fn index_with_a_point() {
    check_after_triangle("f 1.0 2.0 3.0", "obj-bad-index", &format!("line 4: '1.0' {NOT_A_CORNER}"));
}

#[test]
fn index_with_a_word() {
    check_after_triangle("f 1 2 three", "obj-bad-index", &format!("line 4: 'three' {NOT_A_CORNER}"));
}

#[test]
fn corner_without_a_vertex() {
    check_after_triangle("f 1 2 /3/3", "obj-bad-index", &format!("line 4: '/3/3' {NOT_A_CORNER}"));
}

#[test]
fn corner_of_four_parts() {
    check_after_triangle("f 1/1/1/1 2 3", "obj-bad-index", &format!("line 4: '1/1/1/1' {NOT_A_CORNER}"));
}

#[test]
fn corner_with_three_slashes() {
    check_after_triangle("f 1/// 2 3", "obj-bad-index", &format!("line 4: '1///' {NOT_A_CORNER}"));
}

#[test]
fn texture_index_that_is_a_word() {
    check_after_triangle("f 1/a 2 3", "obj-bad-index", &format!("line 4: '1/a' {NOT_A_CORNER}"));
}

#[test]
fn comma_between_indices() {
    check_after_triangle("f 1,2,3", "obj-bad-index", &format!("line 4: '1,2,3' {NOT_A_CORNER}"));
}

#[test]
fn backslash_that_does_not_end_the_line() {
    check_after_triangle("f 1 2 \\ 3", "obj-bad-index", &format!("line 4: '\\\\' {NOT_A_CORNER}"));
}
