//! ASCII STL.

use super::facets::{MOST, document};
use crate::geometry::Point;
use crate::io::refusal::{code, excerpt};
use crate::io::tag_interner::CellTags;
use crate::io::tokens::Tokens;
use crate::io::{Document, Format, ReadError};
use crate::mesh::TagSet;

/// The mesh of an ASCII file that begins with `solid`.
pub(super) fn read(text: &[u8]) -> Result<Document, ReadError> {
    let mut file = AsciiFile {
        tokens: Tokens::new(Format::Stl, text, 1, None),
        vertices: Vec::new(),
        tags: CellTags::new(text.len()),
    };
    while let Some(word) = file.tokens.next() {
        if !word.eq_ignore_ascii_case(b"solid") {
            return Err(file.unexpected(word, "solid"));
        }
        file.read_solid()?;
    }
    let facets: Vec<u32> = (0..file.vertices.len() as u32 / 3).collect();
    document(file.vertices, file.tags.of_cells(&facets))
}

/// The tags of the faces of a solid.
fn named(name: &[u8]) -> TagSet {
    let object = (!name.is_empty()).then(|| String::from_utf8_lossy(name).into_owned());
    TagSet { object, ..TagSet::default() }
}

struct AsciiFile<'a> {
    tokens: Tokens<'a>,
    vertices: Vec<Point>,
    tags: CellTags,
}

impl AsciiFile<'_> {
    fn unexpected(&self, word: &[u8], wanted: &str) -> ReadError {
        self.tokens.refuse(code::SYNTAX, format!("{} stands where {wanted} should", excerpt(word)))
    }

    /// Reads words that have to come.
    fn keywords(&mut self, words: &[&str]) -> Result<(), ReadError> {
        for wanted in words {
            let word = self.tokens.expect(wanted)?;
            if !word.eq_ignore_ascii_case(wanted.as_bytes()) {
                return Err(self.unexpected(word, wanted));
            }
        }
        Ok(())
    }

    /// Reads what follows `solid`, to the line of `endsolid`.
    fn read_solid(&mut self) -> Result<(), ReadError> {
        let name = self.tokens.rest_of_line();
        let mut set = None;
        loop {
            let word = self.tokens.expect("facet or endsolid")?;
            if word.eq_ignore_ascii_case(b"endsolid") {
                self.tokens.rest_of_line();
                return Ok(());
            }
            if !word.eq_ignore_ascii_case(b"facet") {
                return Err(self.unexpected(word, "facet or endsolid"));
            }
            self.read_facet()?;
            let set = match set {
                Some(set) => set,
                None => *set.insert(self.tags.intern(named(name), Format::Stl)?),
            };
            self.tags.push(set);
        }
    }

    fn read_facet(&mut self) -> Result<(), ReadError> {
        if self.vertices.len() / 3 == MOST {
            return Err(self
                .tokens
                .refuse(code::TOO_LARGE, format!("the file has more than {MOST} facets: split it")));
        }
        self.keywords(&["normal"])?;
        // Some programs write no numbers for triangles without area.
        for _ in 0..3 {
            self.tokens.expect("the normal of a facet")?;
        }
        self.keywords(&["outer", "loop"])?;
        for _ in 0..3 {
            self.keywords(&["vertex"])?;
            let mut vertex = [0.0; 3];
            for coordinate in &mut vertex {
                *coordinate = self.tokens.float("a coordinate")?;
                if !coordinate.is_finite() {
                    let message =
                        format!("a coordinate of a vertex is {coordinate}; it must be a finite number");
                    return Err(self.tokens.refuse(code::NOT_FINITE, message));
                }
            }
            self.vertices.push(vertex.into());
        }
        self.keywords(&["endloop", "endfacet"])
    }
}
