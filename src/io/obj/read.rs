//! OBJ statements into a surface.

use super::cursor::{Cursor, Result, error, quoted};
use super::names::Names;
use super::sharpness::read_tag;
use crate::geometry::Point;
use crate::io::{Document, Format, ReadError, sniff};
use crate::mesh::{Features, NodeId, PolygonMesh};

/// Statements that say nothing of the shape, and are skipped.
const SKIPPED: &[&[u8]] = &[
    b"vt",
    b"vn",
    b"vp",
    b"vc",
    b"s",
    b"p",
    b"mg",
    b"mtllib",
    b"maplib",
    b"usemap",
    b"lod",
    b"bevel",
    b"c_interp",
    b"d_interp",
    b"shadow_obj",
    b"trace_obj",
    b"ctech",
    b"stech",
];

/// Statements of free-form curves and surfaces.
const FREE_FORM: &[&[u8]] = &[b"cstype", b"curv", b"curv2", b"surf", b"bzp", b"bsp", b"cdc", b"cdp", b"res"];

/// Words that are not OBJ, with the statement that they were probably meant to be.
const MISTAKEN: &[(&str, &str)] = &[
    ("V", "v"),
    ("F", "f"),
    ("L", "l"),
    ("G", "g"),
    ("O", "o"),
    ("face", "f"),
    ("vertex", "v"),
    ("point", "v"),
    ("line", "l"),
    ("facet", "f"),
    ("polygon", "f"),
    ("tri", "f"),
    ("triangle", "f"),
    ("quad", "f"),
];

/// Reads the vertices, faces, polylines, tags and sharpness of an OBJ file; see [`super`] for what is
/// taken from it. Time and memory are linear in the length of `bytes`.
///
/// # Errors
/// With the line, a code that starts in `obj-`, and what to do.
pub fn read(bytes: &[u8]) -> Result<Document> {
    refuse_other_files(bytes)?;
    let mut reader = Reader::new(bytes);
    while reader.cursor.next_statement() {
        reader.statement()?;
    }
    reader.finish()
}

/// Refuses what is well known to be something else, so that the error names it.
fn refuse_other_files(bytes: &[u8]) -> Result<()> {
    let refuse = |code, message| Err(ReadError { format: Format::Obj, line: None, code, message });
    if bytes.is_empty() {
        return refuse("obj-empty", "the file is empty: export the mesh again".to_owned());
    }
    if let Some(encoding) = sniff::wide_text(bytes) {
        return refuse("obj-wide-text", format!("this is {encoding} text: save the file as UTF-8"));
    }
    match sniff::not_obj(bytes) {
        Some(kind) => {
            refuse("obj-other-format", format!("this is {kind}, not OBJ: choose an OBJ file, or convert it"))
        }
        None => Ok(()),
    }
}

struct Reader<'a> {
    cursor: Cursor<'a>,
    positions: Vec<Point>,
    offsets: Vec<u32>,
    corners: Vec<NodeId>,
    features: Features,
    names: Names,
    /// References to vertices that had not been read yet, with their lines: how many vertices each needs,
    /// rising. The first that needs more than there turn out to be is the first wrong one of the file.
    ahead: Vec<(u64, u64)>,
}

impl<'a> Reader<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self {
            cursor: Cursor::new(bytes),
            positions: Vec::new(),
            offsets: vec![0],
            corners: Vec::new(),
            features: Features::default(),
            names: Names::new(bytes.len()),
            ahead: Vec::new(),
        }
    }

    fn statement(&mut self) -> Result<()> {
        let line = self.cursor.line();
        let keyword = self.cursor.word().unwrap_or_default();
        match keyword {
            b"v" => self.vertex(line),
            b"f" | b"fo" => self.face(line),
            b"l" => self.polyline(line),
            b"t" => {
                if let Some(vertex) = read_tag(&mut self.cursor, &mut self.features)? {
                    self.expect_vertices(u64::from(vertex) + 1, line);
                }
                self.end(line, keyword)
            }
            b"g" => {
                let cursor = &mut self.cursor;
                self.names.set_groups(std::iter::from_fn(|| cursor.word()));
                self.cursor.skip_statement();
                Ok(())
            }
            b"o" => {
                self.names.set_object(self.cursor.rest_of_statement());
                Ok(())
            }
            b"usemtl" => {
                self.names.set_material(self.cursor.rest_of_statement());
                Ok(())
            }
            _ => self.other(keyword, line),
        }
    }

    /// Checks that nothing more stands in the statement.
    fn end(&mut self, line: u64, keyword: &[u8]) -> Result<()> {
        if self.cursor.at_end() {
            return Ok(());
        }
        let (word, keyword) = (quoted(self.cursor.word().unwrap_or_default()), quoted(keyword));
        Err(error(line, "obj-unexpected-word", format!("{word} is too much for {keyword}: remove it")))
    }

    fn vertex(&mut self, line: u64) -> Result<()> {
        // x y z, x y z w, x y z r g b or x y z w r g b.
        let mut numbers = [0.0; 7];
        let mut count = 0;
        while let Some(number) = self.cursor.number()? {
            if count < numbers.len() {
                numbers[count] = number;
            }
            count += 1;
        }
        if !matches!(count, 3 | 4 | 6 | 7) {
            let message = format!(
                "vertex has {count} {}; write x y z, with a weight (4), a colour (6) or both (7)",
                if count == 1 { "number" } else { "numbers" }
            );
            return Err(error(line, "obj-vertex-size", message));
        }
        if self.positions.len() == u32::MAX as usize {
            return Err(error(line, "obj-too-large", "the file has more than 4294967295 vertices: split it"));
        }
        self.positions.push(Point::new(numbers[0], numbers[1], numbers[2]));
        Ok(())
    }

    fn face(&mut self, line: u64) -> Result<()> {
        let start = self.corners.len();
        while let Some(index) = self.cursor.corner()? {
            let node = self.node("face", index)?;
            self.corners.push(node);
        }
        let nodes = self.corners.len() - start;
        if nodes < 3 {
            let what = format!(
                "face has {nodes} {}; a face needs at least 3 — remove it or write it as an 'l' polyline",
                if nodes == 1 { "node" } else { "nodes" }
            );
            return Err(error(line, "obj-face-too-short", what));
        }
        let end = u32::try_from(self.corners.len());
        let too_large =
            |_| error(line, "obj-too-large", "the file has more than 4294967295 face corners: split it");
        self.offsets.push(end.map_err(too_large)?);
        self.names.push_face(line)
    }

    fn polyline(&mut self, line: u64) -> Result<()> {
        let mut nodes = Vec::new();
        while let Some(index) = self.cursor.corner()? {
            nodes.push(self.node("polyline", index)?);
        }
        if nodes.len() < 2 {
            let message = format!("polyline has {} nodes; it needs at least 2 — remove it", nodes.len());
            return Err(error(line, "obj-polyline-too-short", message));
        }
        self.features.polylines.push(nodes);
        Ok(())
    }

    /// The node that `index` of a file means here. One that is not there yet may still come.
    fn node(&mut self, user: &str, index: i64) -> Result<NodeId> {
        let above = self.positions.len() as u64;
        let line = self.cursor.line();
        match index {
            0 => {
                let message =
                    format!("{user} uses vertex 0; OBJ counts vertices from 1 — add 1 to every index");
                Err(error(line, "obj-index-zero", message))
            }
            1.. => {
                self.expect_vertices(index as u64, line);
                // An id that does not fit is refused by `finish`.
                Ok(NodeId((index - 1) as u32))
            }
            _ if index.unsigned_abs() <= above => Ok(NodeId((above - index.unsigned_abs()) as u32)),
            _ => {
                let message = format!(
                    "{user} uses vertex {index}, counted back from this line, but only {above} vertices stand \
                     above it — move the vertices up or correct the index"
                );
                Err(error(line, "obj-index-out-of-range", message))
            }
        }
    }

    /// Notes that the statement at `line` needs the file to have `count` vertices.
    fn expect_vertices(&mut self, count: u64, line: u64) {
        let known = self.ahead.last().map_or(0, |&(count, _)| count).max(self.positions.len() as u64);
        if count > known {
            self.ahead.push((count, line));
        }
    }

    /// A statement that gives no shape, or a word that is no statement.
    fn other(&mut self, keyword: &[u8], line: u64) -> Result<()> {
        if FREE_FORM.contains(&keyword) {
            let message = format!(
                "{} starts a free-form curve or surface; only polygons are read — export the model as polygons",
                quoted(keyword)
            );
            return Err(error(line, "obj-free-form", message));
        }
        if matches!(keyword, b"call" | b"csh") {
            let message = format!("{} needs another file or program — put its lines here", quoted(keyword));
            return Err(error(line, "obj-include", message));
        }
        let is_word = keyword.iter().all(|b| b.is_ascii_alphabetic() || *b == b'_');
        let meant = MISTAKEN.iter().find(|(word, _)| word.as_bytes() == keyword);
        if !SKIPPED.contains(&keyword) && (!is_word || meant.is_some()) {
            let what = match meant {
                Some((_, meant)) => format!("did you mean '{meant}'?"),
                None => "a statement starts with a word such as v or f — put '#' before the line to skip it"
                    .to_owned(),
            };
            return Err(error(
                line,
                "obj-unknown-statement",
                format!("{} is not OBJ: {what}", quoted(keyword)),
            ));
        }
        self.cursor.skip_statement();
        Ok(())
    }

    fn finish(self) -> Result<Document> {
        let count = self.positions.len() as u64;
        if let Some(&(needed, line)) = self.ahead.iter().find(|(needed, _)| *needed > count) {
            let message = format!(
                "vertex {needed} is used, but the file has {count} vertices — correct the index or add the vertex"
            );
            return Err(error(line, "obj-index-out-of-range", message));
        }
        if count == 0 {
            let message = "the file has no vertices ('v' lines): check that it is an OBJ file with a mesh";
            return Err(ReadError {
                format: Format::Obj,
                line: None,
                code: "obj-no-vertices",
                message: message.to_owned(),
            });
        }
        Ok(Document::from(PolygonMesh {
            positions: self.positions,
            offsets: self.offsets,
            corners: self.corners,
            tags: self.names.finish(),
            features: self.features,
        }))
    }
}
