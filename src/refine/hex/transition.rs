//! The end of a stage: divides the refined hexes and the transition hexes, and puts the next mesh together.

use std::borrow::Cow;

use super::divide::{Divided, divide};
use super::labels::{self, Label};
use super::stage::{NO_ELEMENT, NO_OCTANT, StageMesh, StageReport, StageResult};
use crate::geometry::Point;
use crate::mesh::NodeId;
use crate::mesh::topology::Side;
use crate::parallel;
use crate::template::hex::Template;
use crate::{Cancelled, Monitor};

/// A transition hex that a template divides, and the coarse hex that it is part of.
pub(super) struct Transition {
    pub(super) from: u32,
    /// The hex in whose place it is: that, or the refined hex beside it.
    pub(super) within: u32,
    pub(super) divided: Divided,
}

/// The transition hexes of a stage.
#[derive(Default)]
pub(super) struct Transitions {
    /// Those that stay, after the coarse hexes that they are part of.
    pub(super) whole: Vec<(u32, [NodeId; 8])>,
    /// Those that are divided.
    pub(super) divided: Vec<Transition>,
    /// Labels of those that are divided.
    pub(super) labels: Vec<Label>,
    /// And of those that stay.
    pub(super) whole_labels: Vec<Label>,
    /// Sides of the mesh before, ascending, whose labels these have now.
    pub(super) taken: Vec<Side>,
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
    (mut positions, hexes): (Vec<Point>, Cow<'_, [[NodeId; 8]]>),
    refined: &[bool],
    split: &'static Template,
    transitions: Transitions,
    monitor: &dyn Monitor,
) -> Result<StageResult, Cancelled> {
    let divided_ids = parallel::try_filter(hexes.len(), monitor, |hex| refined[hex])?;
    let is_kept = |hex: usize| !refined[hex] && transitions.replaced.binary_search(&(hex as u32)).is_err();
    let kept = parallel::try_filter(hexes.len(), monitor, is_kept)?;
    let Transitions { whole, divided: layer, .. } = transitions;
    let mut divided: Vec<Divided> = Vec::with_capacity(divided_ids.len() + layer.len());
    let split_hex = |k: usize| Divided { hex: hexes[divided_ids[k] as usize], template: split, symmetry: 0 };
    parallel::extend(&mut divided, divided_ids.len(), split_hex);
    divided.extend(layer.iter().map(|transition| transition.divided));
    let in_layer: usize = layer.iter().map(|transition| transition.divided.template.cell_count()).sum();
    let children = split.cell_count();
    let first_transition = kept.len() + children * divided_ids.len();
    let count = first_transition + in_layer + whole.len();

    let mut cells = Vec::with_capacity(count);
    parallel::extend(&mut cells, kept.len(), |k| hexes[kept[k] as usize]);
    drop(hexes);
    let cells_of = divide(&mut positions, &mut cells, &divided, monitor)?;
    let labels = if before.labels.is_empty() {
        Vec::new()
    } else {
        let stay = labels::without(&before.labels, &transitions.taken);
        let to_divide = labels::of_some(&stay, &divided_ids)
            .into_iter()
            .chain(labels::after(divided_ids.len(), transitions.labels));
        let of_cells = labels::of_cells(&to_divide.collect::<Vec<_>>(), &divided, &cells_of);
        let mut labels = labels::of_some(&stay, &kept);
        labels.extend(labels::after(kept.len(), of_cells));
        labels.extend(labels::after(first_transition + in_layer, transitions.whole_labels));
        labels
    };
    drop(divided);
    cells.extend(whole.iter().map(|&(_, hex)| hex));

    let mut from = Vec::with_capacity(count);
    from.extend_from_slice(&kept);
    parallel::extend(&mut from, children * divided_ids.len(), |child| divided_ids[child / children]);
    for (k, transition) in (divided_ids.len()..).zip(&layer) {
        from.extend(std::iter::repeat_n(transition.from, (cells_of[k + 1] - cells_of[k]) as usize));
    }
    from.extend(whole.iter().map(|&(hex, _)| hex));
    monitor.proceed()?;

    let is_child = |h: usize| (kept.len()..first_transition).contains(&h);
    let is_kept = |h: usize| h < kept.len();
    let child = |h: usize| h - kept.len();
    let octant = |h: usize| match h {
        h if is_kept(h) => before.octant[from[h] as usize],
        // Only eight children are octants.
        h if is_child(h) && children == 8 => (child(h) % 8) as u8,
        _ => NO_OCTANT,
    };
    let element = |h: usize| match h {
        h if is_kept(h) => before.element[from[h] as usize],
        h if is_child(h) => child(h) as u32,
        _ => NO_ELEMENT,
    };
    let level = |h: usize| before.level[from[h] as usize].saturating_add(is_child(h).into());
    let mut root = parallel::try_collect(count, monitor, |h| before.root[from[h] as usize])?;
    for (k, transition) in (divided_ids.len()..).zip(&layer) {
        let cells = kept.len() + cells_of[k] as usize..kept.len() + cells_of[k + 1] as usize;
        root[cells].fill(before.root[transition.within as usize]);
    }
    let mesh = StageMesh {
        octant: parallel::try_collect(count, monitor, octant)?,
        level: parallel::try_collect(count, monitor, level)?,
        root,
        element: parallel::try_collect(count, monitor, element)?,
        labels,
        materials: before.materials.clone(),
        has_free_boundary: before.has_free_boundary,
        positions,
        hexes: cells,
    };
    let report = StageReport {
        refined: divided_ids.len(),
        interface_faces: transitions.interface_faces,
        transition: count - first_transition,
        pinched_edges: transitions.pinched_edges,
        copies: transitions.copies,
    };
    let layer_nodes = nodes_of(&mesh.hexes[first_transition..], mesh.positions.len());
    Ok(StageResult { mesh, from, first_transition, layer_nodes, is_inside: false, report })
}

/// The nodes of some hexes, ascending.
fn nodes_of(hexes: &[[NodeId; 8]], node_count: usize) -> Vec<NodeId> {
    let mut has = vec![false; node_count];
    hexes.as_flattened().iter().for_each(|node| has[node.index()] = true);
    parallel::filter_map(node_count, |node| has[node].then(|| NodeId::new(node)))
}
