//! Reads Abaqus input decks: one keyword after the other.

use super::assembly::{Model, Placement};
use super::lines::{Keyword, Lines};
use crate::io::refusal::{code, refuse};
use crate::io::{Document, Format, ReadError};

/// Keywords that make nodes or elements in ways that are not read.
const MAKERS: [&str; 9] =
    ["NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "INCLUDE", "SYMMETRIC MODEL GENERATION"];

/// The mesh in an input deck.
pub fn read(bytes: &[u8]) -> Result<Document, ReadError> {
    let mut lines = Lines::new(bytes);
    let mut model = Model::new(bytes.len());
    let mut known = false;
    while let Some(keyword) = lines.next_keyword() {
        known |= read_keyword(&keyword, &mut lines, &mut model)?;
    }
    if !known {
        let message = "this is no Abaqus input deck: it has neither *NODE nor *ELEMENT";
        return Err(refuse(Format::Inp, 1, code::NOT_THIS_FORMAT, message));
    }
    model.into_document()
}

/// Reads what a keyword says; false if it says nothing of the mesh.
fn read_keyword(keyword: &Keyword, lines: &mut Lines<'_>, model: &mut Model) -> Result<bool, ReadError> {
    match keyword.name.as_str() {
        "NODE" | "ELEMENT" | "ELSET" if keyword.get("INPUT").is_some() => {
            let message =
                format!("*{} reads another file — put that file's lines in its place", keyword.name);
            return Err(keyword.refuse(code::UNSUPPORTED_FEATURE, message));
        }
        "NODE" => {
            model.name_nodes(keyword);
            model.current(keyword)?.read_nodes(keyword, lines)?;
        }
        "ELEMENT" => model.current(keyword)?.read_elements(keyword, lines)?,
        "ELSET" => match keyword.get("INSTANCE") {
            Some(name) => {
                let (instance, part) = model.instance(name, keyword)?;
                part.read_set(keyword, lines, Some(instance))?;
            }
            None => model.current(keyword)?.read_set(keyword, lines, None)?,
        },
        "SURFACE" => {
            model.read_surface(keyword, lines);
            return Ok(false);
        }
        "NSET" => {
            model.name_nodes(keyword);
            return Ok(false);
        }
        "PART" => model.begin_part(keyword)?,
        "END PART" => model.end_part(),
        "INSTANCE" => {
            let placement = read_placement(lines)?;
            model.begin_instance(keyword, placement)?;
        }
        "END INSTANCE" => model.end_instance(),
        name if MAKERS.contains(&name) => {
            let message = format!(
                "*{name} is not read — write the nodes and elements that it makes as *NODE and *ELEMENT"
            );
            return Err(keyword.refuse(code::UNSUPPORTED_FEATURE, message));
        }
        _ => return Ok(false),
    }
    Ok(true)
}

/// The data of `*INSTANCE`: a line with a translation, and one with two points of an axis and an angle.
fn read_placement(lines: &mut Lines<'_>) -> Result<Placement, ReadError> {
    let mut numbers = [0.0; 10];
    let mut slots = [0..3, 3..10].into_iter();
    while let Some(line) = lines.next_data() {
        let Some(slots) = slots.next() else {
            let message = "an instance has more than the two lines of translation and rotation".to_owned();
            return Err(line.refuse(code::SYNTAX, message));
        };
        for (slot, field) in numbers[slots].iter_mut().zip(line.fields()) {
            *slot = line.float(field, "a translation or rotation")?;
        }
    }
    Ok(Placement::new(numbers))
}
