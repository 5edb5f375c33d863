//! One stage of the refinement of a hex mesh: from a conforming mesh and a set of its hexes to the conforming
//! mesh in which these are divided.

use std::borrow::Cow;

use super::couple::{coupled_middles, middles_of_families};
use super::divide::Divided;
use super::interface::Interface;
use super::labels::{self, Labelled};
use super::layers::layers;
use super::open::open;
use super::options::Method;
use super::part::Whole;
use super::pillow::{LayerHex, Pillow, pillow};
use super::quarters::{Quarter, place_quarters};
use super::sheets::materials_of;
use super::transition::{Transition, Transitions, assemble};
use crate::geometry::Point;
use crate::mesh::topology::Side;
use crate::mesh::{HexId, HexMesh, NodeId};
use crate::template::hex::{SPLIT, THIRDS, THIRTEEN, Template};
use crate::{Cancelled, Monitor};

/// No child of a family: the hex is an input hex or a transition hex.
pub const NO_OCTANT: u8 = u8::MAX;

/// No element of the forest: the hex is a transition hex.
pub const NO_ELEMENT: u32 = u32::MAX;

/// A conforming hex mesh between two stages. All arrays but `positions`, `labels` and `materials` have one entry a hex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StageMesh {
    /// Coordinates of the nodes.
    pub positions: Vec<Point>,
    /// The nodes of each hex, in the order of VTK_HEXAHEDRON.
    pub hexes: Vec<[NodeId; 8]>,
    /// Which child of its family each hex is: it stands at that corner of its parent, its axes parallel to the
    /// parent's, so that its local corner `j` divides as many of the parent's axes as `j` differs from it in
    /// coordinates: none at the parent's corner, one at an edge node, two at a face node, three at the volume
    /// node. [`NO_OCTANT`] for input hexes and transition hexes.
    pub octant: Vec<u8>,
    /// How many times the input was refined to make each hex; a transition hex has the level of the coarse hex
    /// that it is part of.
    pub level: Vec<u8>,
    /// The input hex that each hex is part of.
    pub root: Vec<u32>,
    /// The number of each hex among the elements of its level, [`NO_ELEMENT`] for transition hexes.
    pub element: Vec<u32>,
    /// Faces that belong to a group, by side, ascending, each with the group's number. Faces between hexes are there from
    /// both sides, with bit 30 set, and bit 31 on the side that the group does not have.
    pub labels: Vec<(Side, u32)>,
    /// The material of each input hex, by its set of tags and by the groups of faces between hexes; empty if all are of
    /// one. Faces between hexes of different materials stay where they are, like the boundary.
    pub materials: Vec<u32>,
    /// May nodes leave the boundary, since nobody keeps it?
    pub has_free_boundary: bool,
}

impl StageMesh {
    /// The hexes, with what they have of the input.
    pub(super) fn whole(&self) -> Whole<'_> {
        let Self { positions, hexes, labels, root, materials, has_free_boundary, .. } = self;
        let has_free_boundary = *has_free_boundary;
        Whole { positions, hexes, labels, root, materials, has_free_boundary }
    }

    /// The mesh before the first stage: the input's hexes, at level 0.
    pub fn of_input(positions: Vec<Point>, hexes: Vec<[NodeId; 8]>) -> Self {
        let count = hexes.len();
        Self {
            positions,
            octant: vec![NO_OCTANT; count],
            level: vec![0; count],
            root: (0..count as u32).collect(),
            element: (0..count as u32).collect(),
            labels: Vec::new(),
            materials: Vec::new(),
            has_free_boundary: false,
            hexes,
        }
    }

    /// The same of a mesh with its groups of faces and its materials.
    pub(super) fn of_mesh(mesh: &HexMesh, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let labels = labels::of_mesh(mesh);
        let materials = materials_of(mesh, &labels, monitor)?;
        Ok(Self { labels, materials, ..Self::of_input(mesh.positions.clone(), mesh.hexes.clone()) })
    }

    /// The same, with the positions and the hexes of the mesh, which get back there by [`StageMesh::give_back`].
    pub(super) fn taken_from(mesh: &mut HexMesh, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let labels = labels::of_mesh(mesh);
        let materials = materials_of(mesh, &labels, monitor)?;
        let (positions, hexes) = (std::mem::take(&mut mesh.positions), std::mem::take(&mut mesh.hexes));
        Ok(Self { labels, materials, ..Self::of_input(positions, hexes) })
    }

    /// Gives back what was taken from a mesh.
    pub(super) fn give_back(self, mesh: &mut HexMesh) {
        (mesh.positions, mesh.hexes) = (self.positions, self.hexes);
    }

    /// The material of a hex.
    pub(super) fn material(&self, hex: HexId) -> u32 {
        self.materials.get(self.root[hex.index()] as usize).copied().unwrap_or(0)
    }
}

/// What a stage returns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StageResult {
    /// The mesh: first the hexes that stay, in their order; then the children of the refined ones; then the
    /// transition hexes, those that a template made first. Nodes keep their ids; new ones follow.
    pub mesh: StageMesh,
    /// The hex of the mesh before that each hex came from. A transition hex came from the coarse hex whose place
    /// it takes part of.
    pub from: Vec<u32>,
    /// The first transition hex; the others follow to the end.
    pub first_transition: usize,
    /// The nodes that the stage made or moved between refined and coarse hexes, ascending: those that may be
    /// moved to improve the transition hexes.
    pub layer_nodes: Vec<NodeId>,
    /// Is none of these on the boundary, as far as is known?
    pub is_inside: bool,
    /// What was done, in numbers.
    pub report: StageReport,
}

/// A stage in numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "camelCase")]
pub struct StageReport {
    /// Hexes that were divided.
    pub refined: usize,
    /// Faces between refined and coarse hexes.
    pub interface_faces: usize,
    /// Transition hexes made.
    pub transition: usize,
    /// Edges at which the interface touches itself.
    pub pinched_edges: usize,
    /// Nodes that a pillow made.
    pub copies: usize,
}

/// Why a stage was not done.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StageError {
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] crate::Cancelled),
    /// The interface cannot be pillowed unless these hexes, with their families, are refined too. Adding them
    /// and running the stage again always ends.
    #[error("hexes at places where the interface cannot be separated ({}) must be refined too", .0.len())]
    Conflict(Vec<u32>),
    /// No template of Method I fits these coarse hexes. The forest's closure prevents them.
    #[error("Method I has no template for {} coarse hexes, hex {} first; refine around them", .0.len(), .0[0])]
    Forbidden(Vec<u32>),
    /// The faces between refined and coarse hexes cannot be grouped by four, which 2-refinement needs; hexes of
    /// the refined set at such faces.
    #[error(
        "the faces at {} refined hexes, hex {} first, cannot be grouped two by two; refine whole families, \
         or use 3-refinement", .0.len(), .0[0]
    )]
    NotCouplable(Vec<u32>),
}

/// Refines the hexes of `mesh` for which `refined` holds. For 2-refinement they are whole families of one
/// level, or a set whose interface can be grouped two by two.
///
/// # Errors
/// See [`StageError`]; nothing is returned in part.
///
/// # Panics
/// If `refined` is not as long as the mesh's hexes.
pub fn stage(
    mesh: &StageMesh,
    refined: &[bool],
    method: Method,
    monitor: &dyn Monitor,
) -> Result<StageResult, StageError> {
    stage_of(mesh, refined, (method, false), monitor)
}

/// The same, with the layer of a pillow opened before it is divided, where that is done (`open`).
pub(super) fn opened_stage(
    mesh: &StageMesh,
    refined: &[bool],
    method: Method,
    monitor: &dyn Monitor,
) -> Result<StageResult, StageError> {
    stage_of(mesh, refined, (method, true), monitor)
}

fn stage_of(
    mesh: &StageMesh,
    refined: &[bool],
    (method, is_opened): (Method, bool),
    monitor: &dyn Monitor,
) -> Result<StageResult, StageError> {
    assert_eq!(refined.len(), mesh.hexes.len(), "one entry a hex");
    let mut interface = Interface::new(mesh.whole(), refined, monitor)?;
    match method {
        Method::One => {
            let mut positions = mesh.positions.clone();
            let transitions = layers(&mut positions, &interface, &mesh.octant, monitor)?;
            drop(interface);
            Ok(assemble(
                mesh,
                (positions, Cow::Borrowed(&mesh.hexes)),
                refined,
                &SPLIT,
                transitions,
                monitor,
            )?)
        }
        Method::Two => {
            let pillow = pillow(&mesh.positions, &mut interface, monitor)?;
            let divided = quarters(&pillow, mesh).map_err(StageError::NotCouplable)?;
            drop(interface);
            pillowed_stage(mesh, refined, (pillow, is_opened), (&SPLIT, divided), monitor)
        }
        Method::Three => {
            let pillow = pillow(&mesh.positions, &mut interface, monitor)?;
            let divided = thirteens(&pillow);
            drop(interface);
            pillowed_stage(mesh, refined, (pillow, is_opened), (&THIRDS, divided), monitor)
        }
        Method::Auto => {
            let pillow = pillow(&mesh.positions, &mut interface, monitor)?;
            let templates = match quarters(&pillow, mesh) {
                Ok(divided) => (&SPLIT, divided),
                Err(_) => (&THIRDS, thirteens(&pillow)),
            };
            drop(interface);
            pillowed_stage(mesh, refined, (pillow, is_opened), templates, monitor)
        }
    }
}

/// Can Method II join a set to the rest?
pub(super) enum Joining {
    Possible,
    /// These hexes must be refined too.
    Conflict(Vec<u32>),
    /// At these refined hexes its interface cannot be grouped two by two.
    Ungrouped(Vec<u32>),
}

/// Looks whether Method II can join the set.
pub(super) fn joining(
    mesh: &StageMesh,
    refined: &[bool],
    monitor: &dyn Monitor,
) -> Result<Joining, Cancelled> {
    let mut interface = Interface::new(mesh.whole(), refined, monitor)?;
    match pillow(&mesh.positions, &mut interface, monitor) {
        Ok(pillow) => Ok(quarters(&pillow, mesh).map_or_else(Joining::Ungrouped, |_| Joining::Possible)),
        Err(StageError::Conflict(more)) => Ok(Joining::Conflict(more)),
        Err(StageError::Cancelled(cancelled)) => Err(cancelled),
        Err(StageError::Forbidden(hexes) | StageError::NotCouplable(hexes)) => Ok(Joining::Ungrouped(hexes)),
    }
}

/// The layer's hexes as quarters, grouped by families or, if there are none, in any way that fits; or the refined
/// hexes at faces that cannot be grouped.
fn quarters(pillow: &Pillow, mesh: &StageMesh) -> Result<Vec<Divided>, Vec<u32>> {
    let layer = &pillow.layer;
    let place = |middles: Vec<u8>| {
        let on_top = |(hex, middle): (&LayerHex, u8)| Quarter::on_face(hex.hex, [4, 5, 6, 7], middle);
        let quarters: Vec<Quarter> = layer.iter().zip(middles).map(on_top).collect();
        place_quarters(&quarters)
    };
    if let Some(divided) = middles_of_families(layer, &mesh.octant).and_then(place) {
        return Ok(divided);
    }
    let middles = coupled_middles(mesh, layer)?;
    place(middles).ok_or_else(|| layer.iter().map(|hex| hex.face.refined).collect())
}

/// The layer's hexes as 13-hex transitions.
fn thirteens(pillow: &Pillow) -> Vec<Divided> {
    let of = |hex: &LayerHex| Divided { hex: hex.hex, template: &THIRTEEN, symmetry: 0 };
    pillow.layer.iter().map(of).collect()
}

/// The stage after a pillow, with the template of the refined hexes and those of the layer's.
fn pillowed_stage(
    mesh: &StageMesh,
    refined: &[bool],
    (mut pillow, is_opened): (Pillow, bool),
    (split, divided): (&'static Template, Vec<Divided>),
    monitor: &dyn Monitor,
) -> Result<StageResult, StageError> {
    let is_inside = is_opened && mesh.materials.is_empty() && open(&mut pillow, monitor)?;
    let Pillow { positions, hexes, layer, pinched_edges } = pillow;
    let of_coarse = |(hex, divided): (&LayerHex, Divided)| Transition {
        from: hex.face.coarse,
        within: hex.within,
        divided,
    };
    let labelled = Labelled {
        labels: &mesh.labels,
        before: &mesh.hexes,
        hexes: &hexes,
        layer: &layer,
        node_count: mesh.positions.len(),
    };
    let (labels, taken) = labelled.of_layer(|hex| mesh.material(HexId(hex)));
    let transitions = Transitions {
        labels,
        taken,
        interface_faces: layer.len(),
        divided: layer.iter().zip(divided).map(of_coarse).collect(),
        pinched_edges,
        copies: positions.len() - mesh.positions.len(),
        ..Transitions::default()
    };
    let result = assemble(mesh, (positions, Cow::Owned(hexes)), refined, split, transitions, monitor)?;
    Ok(StageResult { is_inside, ..result })
}
