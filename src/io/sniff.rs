//! What a file is, told by its first bytes.

use super::{Format, ReadError, stl};

/// Bytes that a kind of file starts with, and what to call it.
const STARTS: &[(&[u8], &str)] = &[
    (b"\x89PNG", "a PNG image"),
    (b"\xFF\xD8\xFF", "a JPEG image"),
    (b"GIF8", "a GIF image"),
    (b"\x1F\x8B", "a gzip archive"),
    (b"PK\x03\x04", "a zip archive (3MF, USDZ and office files are zip archives too)"),
    (b"7z\xBC\xAF\x27\x1C", "a 7z archive"),
    (b"BZh", "a bzip2 archive"),
    (b"\xFD7zXZ", "an xz archive"),
    (b"\x28\xB5\x2F\xFD", "a zstd archive"),
    (b"%PDF", "a PDF document"),
    (b"\x7FELF", "a program"),
    (b"\0asm", "a WebAssembly module"),
    (b"glTF", "a binary glTF file"),
    (b"Kaydara FBX", "an FBX file"),
    (b"BLENDER", "a Blender file"),
    (b"\x89HDF", "an HDF5 file"),
    (b"CDF", "a NetCDF file"),
    (b"ply\n", "a PLY file"),
    (b"ply\r", "a PLY file"),
    (b"solid ", "an STL file"),
    (b"OFF\n", "an OFF file"),
    (b"OFF\r", "an OFF file"),
    (b"# vtk DataFile", "a legacy VTK file"),
    (b"$MeshFormat", "a Gmsh file"),
    (b"MeshVersionFormatted", "a MEDIT file"),
    (b"*HEADING", "an Abaqus input deck"),
    (b"*Heading", "an Abaqus input deck"),
    (b"ISO-10303-21", "a STEP file"),
    (b"<!DOCTYPE", "an HTML page"),
    (b"<!doctype", "an HTML page"),
    (b"<html", "an HTML page"),
    (b"<VTKFile", "a VTK XML file"),
    (b"<?xml", "an XML file"),
    (b"{", "a JSON file"),
    (b"[", "a JSON file"),
    (b"<", "an XML or HTML file"),
];

/// Keywords that an OBJ file may start with.
const OBJ_KEYWORDS: &[&[u8]] = &[
    b"v", b"vt", b"vn", b"vp", b"f", b"l", b"p", b"o", b"g", b"s", b"t", b"mg", b"mtllib", b"usemtl",
    b"usemap", b"maplib", b"cstype",
];

/// How far into a file its XML root element may stand, after a declaration and comments.
const XML_HEAD: usize = 4096;

/// Tells the format of a file whose name says nothing of it.
///
/// # Errors
/// If the content is of none of the formats; the message names those that are read.
pub fn detect(bytes: &[u8]) -> Result<Format, ReadError> {
    known_format(bytes).ok_or_else(|| {
        let is = wide_text(bytes).map(|encoding| format!("this is {encoding} text"));
        let is = is.or_else(|| not_obj(bytes).map(|kind| format!("this is {kind}")));
        let is = is.unwrap_or_else(|| "the content is of no known format".to_owned());
        let readable: Vec<_> = Format::ALL.into_iter().filter(|f| f.is_read()).collect();
        let names: Vec<_> = readable.into_iter().map(|f| format!(".{}", f.name())).collect();
        let message = format!("{is}: give one of {}, or name the format", names.join(", "));
        ReadError { format: Format::Obj, line: None, code: "format-unknown", message }
    })
}

fn known_format(bytes: &[u8]) -> Option<Format> {
    if stl::is_binary(bytes) {
        return Some(Format::Stl);
    }
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
    if text.starts_with(b"# vtk DataFile") {
        return Some(Format::Vtk);
    }
    if stl::is_ascii(text) {
        return Some(Format::Stl);
    }
    if text.starts_with(b"glTF") {
        return Some(Format::Glb);
    }
    if text.starts_with(b"<") {
        let head = &text[..text.len().min(XML_HEAD)];
        return memchr::memmem::find(head, b"<VTKFile").map(|_| Format::Vtu);
    }
    let mut lines = text.split(|&b| b == b'\n' || b == b'\r').map(<[u8]>::trim_ascii);
    let line = lines.find(|line| !line.is_empty() && !line.starts_with(b"#"))?;
    let word = line.split(|b| b.is_ascii_whitespace()).next()?;
    match word {
        [b'$', ..] => matches!(word, b"$MeshFormat" | b"$Comments").then_some(Format::Msh),
        [b'*', b'*' | b'A'..=b'Z' | b'a'..=b'z', ..] => Some(Format::Inp),
        _ if word.starts_with(b"MeshVersionFormatted") => Some(Format::Medit),
        _ => OBJ_KEYWORDS.contains(&word).then_some(Format::Obj),
    }
}

/// Names what `bytes` are if they are well known to be no OBJ.
pub(super) fn not_obj(bytes: &[u8]) -> Option<&'static str> {
    let text = &bytes[bytes.iter().take(64).take_while(|b| b.is_ascii_whitespace()).count()..];
    let known = STARTS.iter().find(|(start, _)| text.starts_with(start)).map(|&(_, name)| name);
    known.or_else(|| stl::is_binary(bytes).then_some("a binary STL file"))
}

/// Names the encoding if `bytes` are text in UTF-16 or UTF-32, with a byte order mark or without.
pub(super) fn wide_text(bytes: &[u8]) -> Option<&'static str> {
    match bytes {
        [0xFF, 0xFE, 0, 0, ..] | [0, 0, 0xFE, 0xFF, ..] => Some("UTF-32"),
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => Some("UTF-16"),
        [a, 0, b, 0, ..] | [0, a, 0, b, ..] if a.is_ascii() && b.is_ascii() && *a != 0 && *b != 0 => {
            Some("UTF-16")
        }
        _ => None,
    }
}
