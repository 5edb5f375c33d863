//! Words that are no statement, statements that are not read, and `t` tags.

use super::{check, check_after_triangle};

const MEANT: &str = "a statement starts with a word such as v or f — put '#' before the line to skip it";

#[test]
fn empty_file() {
    check("", "obj-empty", "the file is empty: export the mesh again");
}

#[test]
fn file_of_blank_lines() {
    let message = "the file has no vertices ('v' lines): check that it is an OBJ file with a mesh";
    check("\n \n\t\r\n\r", "obj-no-vertices", message);
}

#[test]
fn file_of_comments() {
    let message = "the file has no vertices ('v' lines): check that it is an OBJ file with a mesh";
    check("# nothing\n# at all\n", "obj-no-vertices", message);
}

#[test]
fn byte_order_mark_alone() {
    let message = "the file has no vertices ('v' lines): check that it is an OBJ file with a mesh";
    check("\u{feff}", "obj-no-vertices", message);
}

#[test]
fn prose() {
    let message = "the file has no vertices ('v' lines): check that it is an OBJ file with a mesh";
    check("Dear reader\nthis is no mesh\n", "obj-no-vertices", message);
}

#[test]
fn material_library() {
    let message = "the file has no vertices ('v' lines): check that it is an OBJ file with a mesh";
    check("newmtl steel\nKd 1 1 1\nmap_Kd steel.png\n", "obj-no-vertices", message);
}

#[test]
fn numbers_without_a_keyword() {
    check("0 0 0\n1 0 0\n", "obj-unknown-statement", &format!("line 1: '0' is not OBJ: {MEANT}"));
}

#[test]
fn keyword_without_a_blank() {
    check("v 0 0 0\nv1 0 0\n", "obj-unknown-statement", &format!("line 2: 'v1' is not OBJ: {MEANT}"));
}

#[test]
fn upper_case_keyword() {
    check("V 0 0 0", "obj-unknown-statement", "line 1: 'V' is not OBJ: did you mean 'v'?");
}

#[test]
fn word_for_a_keyword() {
    check_after_triangle(
        "face 1 2 3",
        "obj-unknown-statement",
        "line 4: 'face' is not OBJ: did you mean 'f'?",
    );
}

#[test]
fn merge_conflict() {
    check_after_triangle(
        "<<<<<<< ours\n",
        "obj-unknown-statement",
        &format!("line 4: '<<<<<<<' is not OBJ: {MEANT}"),
    );
}

#[test]
fn free_form_surface() {
    let message = "line 4: 'cstype' starts a free-form curve or surface; only polygons are read — \
                   export the model as polygons";
    check_after_triangle("cstype rat bspline\ndeg 3 3\nsurf 0 1 0 1 1 2 3\nend", "obj-free-form", message);
}

#[test]
fn call_of_another_file() {
    let message = "line 4: 'call' needs another file or program — put its lines here";
    check_after_triangle("call other.obj", "obj-include", message);
}

#[test]
fn tag_without_a_name() {
    let message = "line 4: 't' has no name: write it like 't crease 2/1/0 0 1 2.5'";
    check_after_triangle("t\n", "obj-bad-tag", message);
}

#[test]
fn crease_without_counts() {
    let message = "line 4: '' are no counts of a tag: write them like 2/1/0";
    check_after_triangle("t crease", "obj-bad-tag", message);
}

#[test]
fn crease_with_words_for_counts() {
    let message = "line 4: '2/x/0' are no counts of a tag: write them like 2/1/0";
    check_after_triangle("t crease 2/x/0 0 1 2", "obj-bad-tag", message);
}

#[test]
fn crease_that_announces_more_than_there_is() {
    let message = "line 4: the tag announces 4000000000 values here but has 3: add them";
    check_after_triangle("t crease 4000000000/1/0 0 1 2\n", "obj-bad-tag", message);
}

#[test]
fn crease_that_announces_less_than_there_is() {
    let message = "line 4: '9' is more than the tag's counts announce: correct the counts";
    check_after_triangle("t crease 2/1/0 0 1 2.0 9", "obj-bad-tag", message);
}

#[test]
fn crease_of_three_vertices() {
    let message = "line 4: 't crease' needs pairs of vertices: write it like 't crease 2/1/0 0 1 2.5'";
    check_after_triangle("t crease 3/1/0 0 1 2 2.0", "obj-bad-tag", message);
}

#[test]
fn crease_with_too_few_sharpness_values() {
    let message = "line 4: the tag has 2 sharpness values for 3 features: give one, or one for each";
    check_after_triangle("t crease 6/2/0 0 1 1 2 2 0 1.0 2.0", "obj-bad-tag", message);
}

#[test]
fn crease_of_a_vertex_that_is_not_there() {
    let message =
        "line 4: vertex 4 is used, but the file has 3 vertices — correct the index or add the vertex";
    check_after_triangle("t crease 2/1/0 0 3 2.0", "obj-index-out-of-range", message);
}

#[test]
fn corner_of_a_negative_vertex() {
    let message = "line 4: the tag names vertex -1: vertices of 't' count from 0";
    check_after_triangle("t corner 1/1/0 -1 2.0", "obj-index-out-of-range", message);
}

#[test]
fn corner_with_an_endless_sharpness() {
    let message = "line 4: 'inf' is not a finite number: a node needs a place in space";
    check_after_triangle("t corner 1/1/0 0 inf", "obj-not-finite", message);
}

#[test]
fn corner_of_half_a_vertex() {
    let message = "line 4: '0.5' is not a whole number: write digits only";
    check_after_triangle("t corner 1/1/0 0.5 1", "obj-bad-integer", message);
}

#[test]
fn corner_of_no_vertex() {
    let message = "line 4: 't corner' needs a vertex: write it like 't corner 1/1/0 0 2.5'";
    check_after_triangle("t corner 0/1/0 1.0", "obj-bad-tag", message);
}

#[test]
fn boundary_rule_without_a_number() {
    let message = "line 4: 't interpolateboundary' needs one small whole number: write 0, 1 or 2";
    check_after_triangle("t interpolateboundary 0/0/0", "obj-bad-tag", message);
}

#[test]
fn boundary_rule_beyond_32_bits() {
    let message = "line 4: 't interpolateboundary' needs one small whole number: write 0, 1 or 2";
    check_after_triangle("t interpolateboundary 1/0/0 99999999999", "obj-bad-tag", message);
}
