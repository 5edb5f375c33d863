//! Parts put together: instances with their places, and the mesh that they make.

use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use super::lines::{Keyword, Lines};
use super::part::{ElementSet, Part};
use super::surfaces::{NamedFaces, SurfaceLine, Surfaces, read_surface};
use super::{MATERIAL, NUMBER, OBJECT};
use crate::geometry::Point;
use crate::io::cell_collector::{CellAttributes, CellCollector};
use crate::io::cell_kind::CellKind;
use crate::io::refusal::{code, refuse};
use crate::io::tag_interner::CellTags;
use crate::io::{Document, Format, ReadError};
use crate::mesh::{Group, TagSet};

/// Nodes that the instances may have together for each byte of the file, and in any file: a line makes an
/// instance, so that a small file could ask for any amount of memory.
const NODES: (usize, usize) = (16, 1 << 20);

/// Nodes of elements, and members of element sets, that the instances may have together in the same way.
const PLACES: (usize, usize) = (64, 1 << 23);

/// Everything in a file.
pub(super) struct Model {
    /// The size of the file.
    size: usize,
    /// What stands outside of parts, then the parts.
    parts: Vec<Part>,
    part_of_name: HashMap<String, usize>,
    instances: Vec<Place>,
    instance_of_name: HashMap<String, usize>,
    surfaces: Vec<SurfaceLine>,
    /// Names of sets of nodes, and the same in capitals.
    node_sets: Vec<String>,
    known_node_sets: HashSet<String>,
    current: usize,
    in_instance: bool,
}

/// A part where it stands.
#[derive(Clone, Copy)]
struct Place {
    part: usize,
    placement: Placement,
}

/// Where an instance stands: moved, then turned about an axis.
#[derive(Clone, Copy, Default)]
pub(super) struct Placement {
    translation: Point,
    /// A point of the axis, its unit direction, the cosine and the sine of the angle.
    rotation: Option<(Point, Point, f64, f64)>,
}

impl Placement {
    /// From the numbers of `*INSTANCE`: the translation, two points of the axis, the angle in degrees.
    pub fn new(numbers: [f64; 10]) -> Self {
        let point = |i: usize| Point::new(numbers[i], numbers[i + 1], numbers[i + 2]);
        let (from, to) = (point(3), point(6));
        let angle = numbers[9].to_radians();
        let direction = (to - from).normalize_or_zero();
        let turned = angle != 0.0 && direction != Point::ZERO;
        Self {
            translation: point(0),
            rotation: turned.then(|| (from, direction, libm::cos(angle), libm::sin(angle))),
        }
    }

    /// Rodrigues' rotation of the moved point.
    fn apply(&self, point: Point) -> Point {
        let moved = point + self.translation;
        let Some((origin, axis, cos, sin)) = self.rotation else { return moved };
        let arm = moved - origin;
        origin + arm * cos + axis.cross(arm) * sin + axis * (axis.dot(arm) * (1.0 - cos))
    }
}

impl Model {
    /// An empty model for a file of `size` bytes.
    pub fn new(size: usize) -> Self {
        Self {
            size,
            parts: vec![Part::new(size)],
            part_of_name: HashMap::new(),
            instances: Vec::new(),
            instance_of_name: HashMap::new(),
            surfaces: Vec::new(),
            node_sets: Vec::new(),
            known_node_sets: HashSet::new(),
            current: 0,
            in_instance: false,
        }
    }

    /// The part that keywords now speak of.
    pub fn current(&mut self, keyword: &Keyword) -> Result<&mut Part, ReadError> {
        if self.in_instance {
            let message = format!("*{} within *INSTANCE is not read — put it into the part", keyword.name);
            return Err(keyword.refuse(code::UNSUPPORTED_FEATURE, message));
        }
        Ok(&mut self.parts[self.current])
    }

    /// The instance with this name, and its part.
    pub fn instance(&mut self, name: &str, keyword: &Keyword) -> Result<(usize, &mut Part), ReadError> {
        let Some(&instance) = self.instance_of_name.get(&name.to_ascii_uppercase()) else {
            let message = format!("the instance '{name}' stands nowhere before this line");
            return Err(keyword.refuse(code::INCONSISTENT, message));
        };
        Ok((instance, &mut self.parts[self.instances[instance].part]))
    }

    /// Begins a part.
    pub fn begin_part(&mut self, keyword: &Keyword) -> Result<(), ReadError> {
        let name = keyword.require("NAME")?;
        if self.part_of_name.insert(name.to_ascii_uppercase(), self.parts.len()).is_some() {
            let message = format!("the part '{name}' comes twice — give one of the two another name");
            return Err(keyword.refuse(code::INCONSISTENT, message));
        }
        self.current = self.parts.len();
        self.parts.push(Part::new(self.size));
        Ok(())
    }

    /// Ends a part.
    pub fn end_part(&mut self) {
        self.current = 0;
    }

    /// Begins an instance of a part.
    pub fn begin_instance(&mut self, keyword: &Keyword, placement: Placement) -> Result<(), ReadError> {
        let (name, part_name) = (keyword.require("NAME")?, keyword.require("PART")?);
        let Some(&part) = self.part_of_name.get(&part_name.to_ascii_uppercase()) else {
            let message = format!("the part '{part_name}' stands nowhere before this line");
            return Err(keyword.refuse(code::INCONSISTENT, message));
        };
        self.instance_of_name.insert(name.to_ascii_uppercase(), self.instances.len());
        self.instances.push(Place { part, placement });
        self.in_instance = true;
        Ok(())
    }

    /// Reads the data of `*SURFACE`.
    pub fn read_surface(&mut self, keyword: &Keyword, lines: &mut Lines<'_>) {
        let mut read = read_surface(keyword, lines, self.current);
        let number = read.first().and_then(|line| number_of_name(&line.name));
        let before =
            self.surfaces.len().checked_sub(read.len()).map(|start| self.surfaces.split_at_mut(start));
        if let (Some(number), Some((earlier, last))) = (number, before)
            && is_number_of(last, earlier, &read)
        {
            last.iter_mut().for_each(|line| line.number = Some(number));
            read.clear();
        }
        self.surfaces.append(&mut read);
    }

    /// Keeps the name of a set of nodes, unless another program made the set for itself.
    pub fn name_nodes(&mut self, keyword: &Keyword) {
        let name = keyword.get("NSET").filter(|name| !name.is_empty() && keyword.get("INTERNAL").is_none());
        let new = name.filter(|name| self.known_node_sets.insert(name.to_ascii_uppercase()));
        self.node_sets.extend(new.map(str::to_owned));
    }

    /// Ends an instance.
    pub fn end_instance(&mut self) {
        self.in_instance = false;
    }

    /// The mesh of all instances; of all parts where there are none.
    pub fn into_document(self) -> Result<Document, ReadError> {
        let placed = self.placed();
        let sum = |of: fn(&Part) -> usize| -> usize {
            placed.iter().map(|(_, instance)| of(&self.parts[instance.part])).sum()
        };
        let count = sum(|part| part.positions.len());
        self.refuse_beyond(NODES, count, "nodes")?;
        self.refuse_beyond(PLACES, sum(Part::places), "nodes of elements and members of sets")?;
        let mut positions = Vec::with_capacity(count);
        let mut collector = CellCollector::new(Format::Inp, count, 0);
        let mut tags = CellTags::new(self.size);
        let instances: Vec<usize> = self.instances.iter().map(|instance| instance.part).collect();
        let surfaces = Surfaces::new(&self.surfaces, &self.parts, (&instances, &self.instance_of_name));
        let named = |(index, place): &(Option<usize>, Place)| -> usize {
            surfaces.of(place.part, *index).map(|faces| faces.elements.places().len()).sum()
        };
        self.refuse_beyond(PLACES, placed.iter().map(named).sum(), "faces of surfaces")?;
        for (index, place) in placed {
            let part = &self.parts[place.part];
            let first = positions.len() as i64;
            positions.extend(part.positions.iter().map(|&point| place.placement.apply(point)));
            collect(part, index, first, &mut collector, &mut tags)?;
            collect_faces(part, surfaces.of(place.part, index), first, &mut collector, &mut tags)?;
        }
        collector.drop_faces(surfaces.lost);
        drop(surfaces);
        collector.drop_groups(self.node_sets);
        let attributes = CellAttributes { tags: Some(tags), ..CellAttributes::default() };
        collector.finish(positions, attributes)
    }

    /// Refuses more than `most`: so many for each byte of the file, beside so many in any.
    fn refuse_beyond(&self, most: (usize, usize), count: usize, what: &str) -> Result<(), ReadError> {
        if count <= self.size.saturating_mul(most.0).saturating_add(most.1) {
            return Ok(());
        }
        let message = format!(
            "the instances have {count} {what} together, more than a file of this size should — place fewer instances"
        );
        Err(refuse(Format::Inp, None, code::TOO_LARGE, message))
    }

    /// What makes up the mesh, with the index of each that is an instance by name. Nodes outside of parts
    /// belong to it only if elements do: else they are reference points.
    fn placed(&self) -> Vec<(Option<usize>, Place)> {
        let whole = |part| (None, Place { part, placement: Placement::default() });
        let mut placed = Vec::new();
        if self.parts.len() == 1 || !self.parts[0].elements.is_empty() {
            placed.push(whole(0));
        }
        if self.instances.is_empty() {
            placed.extend((1..self.parts.len()).map(whole));
        }
        placed.extend(self.instances.iter().enumerate().map(|(index, &place)| (Some(index), place)));
        placed
    }
}

/// Hands the elements of a part to the collector, in the order of their numbers.
fn collect(
    part: &Part,
    instance: Option<usize>,
    first_node: i64,
    collector: &mut CellCollector,
    tags: &mut CellTags,
) -> Result<(), ReadError> {
    let set_of_element = sets_of_elements(part, instance, tags)?;
    let mut order: Vec<u32> = (0..part.elements.len() as u32).collect();
    order.sort_by_key(|&element| part.elements[element as usize].number);
    let mut nodes = [0; 27];
    for element in order {
        let set = set_of_element[element as usize];
        let element = &part.elements[element as usize];
        let indices = part.nodes_of(element);
        let nodes = &mut nodes[..indices.len()];
        for (node, &index) in nodes.iter_mut().zip(indices) {
            *node = first_node + i64::from(index);
        }
        collector.push(element.kind, nodes, Some(element.line))?;
        tags.push(set);
    }
    Ok(())
}

/// Hands faces of hexahedra to the collector, with the names of their surfaces.
fn collect_faces<'a>(
    part: &Part,
    surfaces: impl Iterator<Item = NamedFaces<'a>>,
    first_node: i64,
    collector: &mut CellCollector,
    tags: &mut CellTags,
) -> Result<(), ReadError> {
    let mut known: Option<(&Rc<str>, u32)> = None;
    for NamedFaces { line, elements } in surfaces {
        let set = match known {
            Some((name, set)) if Rc::ptr_eq(name, &line.name) => set,
            _ => {
                let mut set = TagSet::default();
                add_label(&mut set, &line.name, line.number);
                tags.intern(set, Format::Inp)?
            }
        };
        known = Some((&line.name, set));
        for &element in elements.places() {
            let Some(nodes) = part.nodes_of_face(element, line.face) else {
                collector.drop_faces(1);
                continue;
            };
            collector.push(CellKind::Quad, &nodes.map(|n| first_node + i64::from(n)), None)?;
            tags.push(set);
        }
    }
    Ok(())
}

/// For each element of the part the tag set that its element sets make.
fn sets_of_elements(
    part: &Part,
    instance: Option<usize>,
    tags: &mut CellTags,
) -> Result<Vec<u32>, ReadError> {
    // A combination of element sets is one more set than another combination; the first is of none.
    let mut combinations: Vec<(u32, u32)> = vec![(0, 0)];
    let mut of_element: Vec<u32> = vec![0; part.elements.len()];
    let numbers = numbers_of_sets(&part.sets);
    for (index, set) in (0..).zip(&part.sets) {
        let is_number = index > 0 && numbers[index as usize - 1].is_some();
        if is_number || set.is_internal || set.instance.is_some() && set.instance != instance {
            continue;
        }
        let mut grown: HashMap<u32, u32> = HashMap::new();
        for &member in &set.members {
            let combination = &mut of_element[member as usize];
            *combination = *grown.entry(*combination).or_insert_with(|| {
                combinations.push((*combination, index));
                combinations.len() as u32 - 1
            });
        }
    }
    let mut tag_set: HashMap<u32, u32> = HashMap::new();
    for combination in &mut of_element {
        *combination = match tag_set.get(combination) {
            Some(&set) => set,
            None => {
                let set =
                    tags.intern(tag_set_of(*combination, &combinations, &part.sets, &numbers), Format::Inp)?;
                tag_set.insert(*combination, set);
                set
            }
        };
    }
    Ok(of_element)
}

/// The tag set of a combination of element sets, with the groups in the order of the file.
fn tag_set_of(
    mut combination: u32,
    combinations: &[(u32, u32)],
    sets: &[ElementSet],
    numbers: &[Option<i64>],
) -> TagSet {
    let mut names = Vec::new();
    while combination != 0 {
        let (rest, set) = combinations[combination as usize];
        names.push((&sets[set as usize].name, numbers[set as usize]));
        combination = rest;
    }
    let mut set = TagSet::default();
    names.into_iter().rev().for_each(|(name, number)| add_label(&mut set, name, number));
    set
}

/// True if the lines of a surface, `last`, which come after `earlier`, are a group with the faces of the next one.
fn is_number_of(last: &[SurfaceLine], earlier: &[SurfaceLine], next: &[SurfaceLine]) -> bool {
    let Some(first) = last.first() else { return false };
    let is_whole = last.iter().all(|line| Rc::ptr_eq(&line.name, &first.name))
        && earlier.last().is_none_or(|line| !Rc::ptr_eq(&line.name, &first.name));
    let is_group = is_group(&first.name) && first.number.is_none();
    is_whole && is_group && last.iter().zip(next).all(|(line, next)| line.is_same_place(next))
}

/// The number of each element set that is a group with one: that of the next set, if that is a number and has the same
/// members.
fn numbers_of_sets(sets: &[ElementSet]) -> Vec<Option<i64>> {
    let next = |k: usize| {
        let (set, next) = (&sets[k], sets.get(k + 1)?);
        let same = set.instance == next.instance && !set.is_internal && !next.is_internal;
        let number = number_of_name(&next.name)?;
        (same && is_group(&set.name) && set.members == next.members).then_some(number)
    };
    (0..sets.len()).map(next).collect()
}

/// `name` without a prefix in any case.
fn without<'n>(name: &'n str, prefix: &str) -> Option<&'n str> {
    let (start, rest) = name.split_at_checked(prefix.len())?;
    start.eq_ignore_ascii_case(prefix).then_some(rest)
}

/// The number that a name stands for.
pub(super) fn number_of_name(name: &str) -> Option<i64> {
    without(name, NUMBER)?.parse().ok()
}

/// True if a name is that of a group.
pub(super) fn is_group(name: &str) -> bool {
    number_of_name(name).is_none() && without(name, OBJECT).is_none() && without(name, MATERIAL).is_none()
}

/// Adds what the name of an element set says, which has a number if it is a group.
fn add_label(set: &mut TagSet, name: &str, number: Option<i64>) {
    if let Some(number) = number_of_name(name) {
        if set.number.is_none() {
            set.number = Some(number);
        } else if set.groups.iter().all(|group| group.number != Some(number)) {
            set.groups.push(Group::new("", number));
        }
    } else if let Some(object) = without(name, OBJECT) {
        set.object = Some(object.to_owned());
    } else if let Some(material) = without(name, MATERIAL) {
        set.material = Some(material.to_owned());
    } else {
        set.number = set.number.or(number);
        set.groups.push(Group { name: name.to_owned(), number });
    }
}
