//! Files of other kinds, which the error names.

use super::check;

/// Checks that `file` is told to be `kind`.
#[track_caller]
fn check_kind(file: impl AsRef<[u8]>, kind: &str) {
    check(file, "obj-other-format", &format!("this is {kind}, not OBJ: choose an OBJ file, or convert it"));
}

#[test]
fn png() {
    check_kind(b"\x89PNG\r\n\x1A\n\0\0\0\rIHDR", "a PNG image");
}

#[test]
fn jpeg() {
    check_kind(b"\xFF\xD8\xFF\xE0\0\x10JFIF", "a JPEG image");
}

#[test]
fn gzip() {
    check_kind(b"\x1F\x8B\x08\0\0\0\0\0", "a gzip archive");
}

#[test]
fn zip() {
    check_kind(b"PK\x03\x04\x14\0", "a zip archive (3MF, USDZ and office files are zip archives too)");
}

#[test]
fn ascii_stl() {
    check_kind("solid part\n facet normal 0 0 1\n", "an STL file");
}

#[test]
fn binary_stl() {
    let mut file = vec![b' '; 80];
    file.extend(2_u32.to_le_bytes());
    file.extend([0; 100]);
    check_kind(file, "a binary STL file");
}

#[test]
fn ply() {
    check_kind("ply\nformat ascii 1.0\n", "a PLY file");
}

#[test]
fn binary_gltf() {
    check_kind(b"glTF\x02\0\0\0", "a binary glTF file");
}

#[test]
fn json() {
    check_kind("\n  {\"vertices\": [0, 0, 0]}", "a JSON file");
}

#[test]
fn html() {
    check_kind("<!DOCTYPE html>\n<html><body>404</body></html>", "an HTML page");
}

#[test]
fn vtk() {
    check_kind("# vtk DataFile Version 3.0\nv\nASCII\n", "a legacy VTK file");
}

#[test]
fn medit() {
    check_kind("MeshVersionFormatted 2\n", "a MEDIT file");
}

#[test]
fn step() {
    check_kind("ISO-10303-21;\nHEADER;", "a STEP file");
}

#[test]
fn utf16_with_a_byte_order_mark() {
    let file: Vec<u8> = "\u{feff}v 0 0 0\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    check(file, "obj-wide-text", "this is UTF-16 text: save the file as UTF-8");
}

#[test]
fn utf16_big_endian_without_a_byte_order_mark() {
    let file: Vec<u8> = "v 0 0 0\n".encode_utf16().flat_map(u16::to_be_bytes).collect();
    check(file, "obj-wide-text", "this is UTF-16 text: save the file as UTF-8");
}

#[test]
fn utf32() {
    let file: Vec<u8> = "\u{feff}v 0 0 0\n".chars().flat_map(|c| (c as u32).to_le_bytes()).collect();
    check(file, "obj-wide-text", "this is UTF-32 text: save the file as UTF-8");
}
