//! What the elements of a level of the trees have of the input: the groups of faces and the materials, which a stage of the
//! mesh has too.

use super::labels::{self, Label};
use super::part::Whole;
use super::sheets::materials_of;
use super::trees::TreeLevel;
use crate::geometry::Point;
use crate::mesh::{HexMesh, NodeId};
use crate::template::hex::{SPLIT, THIRDS, Template};
use crate::{Cancelled, Monitor};

/// The groups and materials of the elements of one level.
#[derive(Clone)]
pub(super) struct Heritage {
    /// The labels of the elements' faces, ascending.
    labels: Vec<Label>,
    /// The input hex of each element; empty where there is one material.
    root: Vec<u32>,
    /// The material of each of the input's hexes; empty if there is one.
    materials: Vec<u32>,
    /// See [`StageMesh::has_free_boundary`](super::stage::StageMesh::has_free_boundary).
    has_free_boundary: bool,
}

impl Heritage {
    /// Of level 0.
    pub(super) fn of_input(
        input: &HexMesh,
        has_free_boundary: bool,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let labels = labels::of_mesh(input);
        let materials = materials_of(input, &labels, monitor)?;
        let root = (0..materials.len() as u32).collect();
        Ok(Self { labels, root, materials, has_free_boundary })
    }

    /// Of the children of `level`, whose own this is.
    pub(super) fn inherited(&self, level: TreeLevel, children: usize) -> Self {
        let template: &'static Template = if children == SPLIT.cell_count() { &SPLIT } else { &THIRDS };
        let root = if self.root.is_empty() {
            Vec::new()
        } else {
            let of_family = |&e: &u32| std::iter::repeat_n(self.root[e as usize], children);
            level.refined.iter().flat_map(of_family).collect()
        };
        let labels = labels_of_children(&self.labels, level, template);
        Self { labels, root, materials: self.materials.clone(), ..*self }
    }

    /// The elements of the level with it.
    pub(super) fn with<'a>(&'a self, positions: &'a [Point], hexes: &'a [[NodeId; 8]]) -> Whole<'a> {
        let Self { labels, root, materials, has_free_boundary } = self;
        Whole { positions, hexes, labels, root, materials, has_free_boundary: *has_free_boundary }
    }
}

/// The labels of children, from those of their parents.
fn labels_of_children(labels: &[Label], level: TreeLevel, template: &'static Template) -> Vec<Label> {
    if labels.is_empty() {
        return Vec::new();
    }
    let of_family = |(&e, family): (&u32, u32)| {
        let first = labels.partition_point(|&(side, _)| side < 6 * e);
        let own = labels[first..].iter().take_while(move |&&(side, _)| side < 6 * e + 6);
        own.flat_map(move |&(side, label)| {
            let cells = template.faces_on(0, (side % 6) as u8);
            let first = family * template.cell_count() as u32;
            cells.map(move |(cell, face)| (6 * (first + cell as u32) + u32::from(face), label))
        })
    };
    let mut found: Vec<Label> = level.refined.iter().zip(0..).flat_map(of_family).collect();
    found.sort_unstable();
    found
}
