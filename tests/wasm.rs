//! The core in WebAssembly, in headless Chromium: the same meshes as natively.
#![cfg(target_arch = "wasm32")]

#[path = "fixtures/cases.rs"]
mod cases;
#[path = "fixtures/hex_cases.rs"]
mod hex_cases;
#[path = "fixtures/solid_cases.rs"]
mod solid_cases;

use hexmill::io::{self, Format};
use wasm_bindgen_test::{wasm_bindgen_test, wasm_bindgen_test_configure};

wasm_bindgen_test_configure!(run_in_dedicated_worker);

#[wasm_bindgen_test]
fn results_are_those_of_the_fixture() {
    for case in cases::cases() {
        assert_eq!(case.run(), case.expected, "{}", case.name);
    }
}

#[wasm_bindgen_test]
fn hexes_are_those_of_the_fixture() {
    for case in hex_cases::hex_cases() {
        assert_eq!(case.run(), case.expected, "{}", case.name);
    }
}

#[wasm_bindgen_test]
fn solids_are_those_of_the_fixture() {
    for case in solid_cases::solid_cases() {
        assert_eq!(case.run(), case.expected, "{}", case.name);
    }
}

#[wasm_bindgen_test]
fn errors_name_the_line() {
    let error = io::read(b"v 0 0 0\nv 1 0 0\nf 1 2\n", Format::Obj).expect_err("a face of two nodes");
    assert_eq!(error.line, Some(3), "{error}");
}

/// What is written is read back bit by bit: numbers are printed and parsed the same in WebAssembly.
#[wasm_bindgen_test]
fn obj_survives_a_round_trip() {
    for case in cases::cases() {
        let document = io::read(case.input.obj().as_bytes(), Format::Obj).expect("a case is a good OBJ");
        let written = io::write(&document, Format::Obj).expect("OBJ holds every surface");
        let again = io::read(&written, Format::Obj).expect("what was written can be read");
        assert_eq!(again, document, "{}", case.name);
    }
}
