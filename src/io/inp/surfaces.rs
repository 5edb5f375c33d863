//! `*SURFACE`: named faces of elements.

use std::collections::HashMap;
use std::rc::Rc;

use super::lines::{Keyword, Line, Lines};
use super::part::Part;
use crate::io::tokens::parse_integer;
use crate::mesh::numbering::hex::FACES;

/// A line of a surface: one face of an element, or of each element of a set. Sets may be defined after it.
pub(super) struct SurfaceLine {
    /// The surface's name.
    pub name: Rc<str>,
    /// The number that goes with the name.
    pub number: Option<i64>,
    /// The part in which it stands.
    pub part: usize,
    /// A set or an element, in capitals; in an assembly with an instance's name before a dot.
    target: String,
    /// Which face of a hexahedron it is.
    pub face: usize,
}

impl SurfaceLine {
    /// True if `other` names the same faces.
    pub fn is_same_place(&self, other: &Self) -> bool {
        (self.part, self.face, &self.target) == (other.part, other.face, &other.target)
    }
}

/// The lines of a `*SURFACE` in part number `part` that name faces of hexahedra; other kinds of surfaces have none.
pub(super) fn read_surface(keyword: &Keyword, lines: &mut Lines<'_>, part: usize) -> Vec<SurfaceLine> {
    let is_of_elements = keyword.get("TYPE").is_none_or(|kind| kind.eq_ignore_ascii_case("ELEMENT"));
    let name: Option<Rc<str>> =
        keyword.get("NAME").filter(|_| is_of_elements && keyword.get("COMBINE").is_none()).map(Rc::from);
    let mut found = Vec::new();
    while let Some(line) = lines.next_data() {
        found.extend(name.as_ref().and_then(|name| surface_line(name, part, line)));
    }
    found
}

fn surface_line(name: &Rc<str>, part: usize, line: Line<'_>) -> Option<SurfaceLine> {
    let mut fields = line.fields();
    let target = String::from_utf8_lossy(fields.next()?).trim_matches('"').to_ascii_uppercase();
    let face = match fields.next()? {
        [b'S' | b's', digit @ b'1'..=b'6'] => usize::from(digit - b'1'),
        _ => return None,
    };
    Some(SurfaceLine { name: Rc::clone(name), number: None, part, target, face })
}

/// The lines of surfaces by what they speak of.
pub(super) struct Surfaces<'a> {
    /// By part: lines within the part itself.
    of_part: Vec<Vec<NamedFaces<'a>>>,
    /// By instance: lines of the assembly.
    of_instance: Vec<Vec<NamedFaces<'a>>>,
    /// Lines that name nothing in the file.
    pub lost: usize,
}

/// A line and the elements that it names.
#[derive(Clone, Copy)]
pub(super) struct NamedFaces<'a> {
    pub line: &'a SurfaceLine,
    pub elements: Elements<'a>,
}

impl<'a> Surfaces<'a> {
    /// Finds what each line speaks of; `instances` are the parts of the instances, and their places by name.
    pub fn new(
        lines: &'a [SurfaceLine],
        parts: &'a [Part],
        (instances, instance_of_name): (&[usize], &HashMap<String, usize>),
    ) -> Self {
        let mut instances_with: HashMap<&str, Vec<usize>> = HashMap::new();
        let names = parts.iter().flat_map(Part::sets_of_instances);
        names.for_each(|(name, instance)| instances_with.entry(name).or_default().push(instance));
        let mut found = Self {
            of_part: vec![Vec::new(); parts.len()],
            of_instance: vec![Vec::new(); instances.len()],
            lost: 0,
        };
        for line in lines {
            if let Some(elements) = parts[line.part].named(&line.target, None) {
                found.of_part[line.part].push(NamedFaces { line, elements });
            } else if let Some(with_set) = instances_with.get(line.target.as_str()) {
                for &instance in with_set {
                    let members = parts[instances[instance]].set_members(&line.target, Some(instance));
                    let elements = Elements::Set(members.unwrap_or_default());
                    found.of_instance[instance].push(NamedFaces { line, elements });
                }
            } else if let Some((name, target)) = line.target.split_once('.')
                && let Some(&instance) = instance_of_name.get(name)
                && let Some(elements) = parts[instances[instance]].named(target, Some(instance))
            {
                found.of_instance[instance].push(NamedFaces { line, elements });
            } else {
                found.lost += 1;
            }
        }
        found
    }

    /// What is said of a part that stands by itself or as an instance.
    pub fn of(&self, part: usize, instance: Option<usize>) -> impl Iterator<Item = NamedFaces<'a>> + '_ {
        let of_instance = instance.map_or(&[][..], |instance| &self.of_instance[instance]);
        self.of_part[part].iter().chain(of_instance).copied()
    }
}

/// Elements of a part, by their places.
#[derive(Clone, Copy)]
pub(super) enum Elements<'a> {
    One(u32),
    Set(&'a [u32]),
}

impl Elements<'_> {
    pub fn places(&self) -> &[u32] {
        match self {
            Self::One(place) => std::slice::from_ref(place),
            Self::Set(places) => places,
        }
    }
}

impl Part {
    /// The element or the elements of the set that `target` names.
    fn named(&self, target: &str, instance: Option<usize>) -> Option<Elements<'_>> {
        match parse_integer(target.as_bytes()) {
            Some(number) => self.place_of(number).map(Elements::One),
            None => {
                let of_instance = instance.and_then(|_| self.set_members(target, instance));
                of_instance.or_else(|| self.set_members(target, None)).map(Elements::Set)
            }
        }
    }

    /// The nodes of a face of an element, if it is a hexahedron.
    pub fn nodes_of_face(&self, element: u32, face: usize) -> Option<[u32; 4]> {
        let element = &self.elements[element as usize];
        let nodes = self.nodes_of(element);
        element.kind.is_hex().then(|| FACES[face].map(|k| nodes[usize::from(k)]))
    }
}
