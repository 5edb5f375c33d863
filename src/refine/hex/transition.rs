//! The end of a stage: divides the refined hexes and the transition hexes, and puts the next mesh together.

use super::divide::{Divided, Division, divide};
use super::stage::{NO_ELEMENT, NO_OCTANT, Stage, StageMesh, StageReport};
use crate::geometry::Point;
use crate::mesh::NodeId;
use crate::parallel;
use crate::template::hex::Template;
use crate::{Cancelled, Monitor};

/// A transition hex that a template divides, and the coarse hex that it is part of.
pub(super) struct Transition {
    pub(super) from: u32,
    pub(super) divided: Divided,
}

/// The transition hexes of a stage.
#[derive(Default)]
pub(super) struct Transitions {
    /// Those that stay, after the coarse hexes that they are part of.
    pub(super) whole: Vec<(u32, [NodeId; 8])>,
    /// Those that are divided.
    pub(super) divided: Vec<Transition>,
    /// Coarse hexes of which nothing is left, ascending.
    pub(super) replaced: Vec<u32>,
    pub(super) interface_faces: usize,
    pub(super) pinched_edges: usize,
    pub(super) copies: usize,
}

/// The next mesh: `hexes` are those of the mesh `before`, with their copies of the nodes, over `positions`; those of
/// the set `refined` are divided by `split`.
pub(super) fn assemble(
    before: &StageMesh,
    (mut positions, hexes): (Vec<Point>, &[[NodeId; 8]]),
    refined: &[bool],
    split: &'static Template,
    transitions: &Transitions,
    monitor: &dyn Monitor,
) -> Result<Stage, Cancelled> {
    let divided_ids = parallel::filter(hexes.len(), |hex| refined[hex]);
    let kept = parallel::filter(hexes.len(), |hex| {
        !refined[hex] && transitions.replaced.binary_search(&(hex as u32)).is_err()
    });
    let mut divided = parallel::collect(divided_ids.len(), |k| {
        let hex = hexes[divided_ids[k] as usize];
        Divided { hex, template: split, symmetry: 0 }
    });
    divided.extend(transitions.divided.iter().map(|transition| transition.divided));
    let division = divide(&mut positions, &divided, monitor)?;
    drop(divided);

    let children = split.cell_count();
    let first_transition = kept.len() + children * divided_ids.len();
    let mut parts = Parts { before, mesh: StageMesh::default(), from: Vec::new() };
    parts.reserve(kept.len() + transitions.whole.len() + division.cells.len());
    parts.keep(hexes, &kept);
    parts.add_children(&divided_ids, children);
    parts.add_transitions(&division, divided_ids.len(), transitions);
    let Parts { mut mesh, from, .. } = parts;
    let (split_cells, transition_cells) = division.cells.split_at(children * divided_ids.len());
    parallel::extend_from_slice(&mut mesh.hexes, split_cells);
    mesh.hexes.extend(transitions.whole.iter().map(|&(_, hex)| hex));
    parallel::extend_from_slice(&mut mesh.hexes, transition_cells);
    mesh.positions = positions;
    let report = StageReport {
        refined: divided_ids.len(),
        interface_faces: transitions.interface_faces,
        transition: mesh.hexes.len() - first_transition,
        pinched_edges: transitions.pinched_edges,
        copies: transitions.copies,
    };
    let layer_nodes = nodes_of(&mesh.hexes[first_transition..], mesh.positions.len());
    Ok(Stage { mesh, from, first_transition, layer_nodes, report })
}

/// The next mesh in the making: all arrays but the nodes.
struct Parts<'a> {
    before: &'a StageMesh,
    mesh: StageMesh,
    from: Vec<u32>,
}

impl Parts<'_> {
    fn reserve(&mut self, hexes: usize) {
        self.mesh.hexes.reserve_exact(hexes);
        self.mesh.octant.reserve_exact(hexes);
        self.mesh.level.reserve_exact(hexes);
        self.mesh.root.reserve_exact(hexes);
        self.mesh.element.reserve_exact(hexes);
        self.from.reserve_exact(hexes);
    }

    /// Takes hexes that stay.
    fn keep(&mut self, hexes: &[[NodeId; 8]], kept: &[u32]) {
        let Self { before, mesh, from } = self;
        let (count, hex) = (kept.len(), |k: usize| kept[k] as usize);
        parallel::extend(&mut mesh.hexes, count, |k| hexes[hex(k)]);
        parallel::extend(&mut mesh.octant, count, |k| before.octant[hex(k)]);
        parallel::extend(&mut mesh.level, count, |k| before.level[hex(k)]);
        parallel::extend(&mut mesh.root, count, |k| before.root[hex(k)]);
        parallel::extend(&mut mesh.element, count, |k| before.element[hex(k)]);
        from.extend_from_slice(kept);
    }

    /// Describes the children of the refined hexes. Only eight of them are octants.
    fn add_children(&mut self, parents: &[u32], children: usize) {
        let Self { before, mesh, from } = self;
        let count = children * parents.len();
        let parent = |child: usize| parents[child / children] as usize;
        let octant = |child: usize| if children == 8 { (child % 8) as u8 } else { NO_OCTANT };
        parallel::extend(&mut mesh.octant, count, octant);
        parallel::extend(&mut mesh.level, count, |child| before.level[parent(child)].saturating_add(1));
        parallel::extend(&mut mesh.root, count, |child| before.root[parent(child)]);
        parallel::extend(&mut mesh.element, count, |child| child as u32);
        parallel::extend(from, count, |child| parents[child / children]);
    }

    /// Describes the transition hexes: those that stay, then those that the division made after `refined` hexes.
    fn add_transitions(&mut self, division: &Division, refined: usize, transitions: &Transitions) {
        let Self { before, mesh, from } = self;
        let first = from.len();
        from.extend(transitions.whole.iter().map(|&(hex, _)| hex));
        for (k, transition) in transitions.divided.iter().enumerate() {
            let cells = division.cells_of[refined + k + 1] - division.cells_of[refined + k];
            from.extend(std::iter::repeat_n(transition.from, cells as usize));
        }
        let new = &from[first..];
        mesh.octant.resize(from.len(), NO_OCTANT);
        mesh.element.resize(from.len(), NO_ELEMENT);
        mesh.level.extend(new.iter().map(|&hex| before.level[hex as usize]));
        mesh.root.extend(new.iter().map(|&hex| before.root[hex as usize]));
    }
}

/// The nodes of some hexes, ascending.
fn nodes_of(hexes: &[[NodeId; 8]], node_count: usize) -> Vec<NodeId> {
    let mut has = vec![false; node_count];
    hexes.as_flattened().iter().for_each(|node| has[node.index()] = true);
    parallel::filter_map(node_count, |node| has[node].then(|| NodeId::new(node)))
}
