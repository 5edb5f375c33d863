//! The last loop of Algorithm 1: transition templates turn a balanced forest into a conforming mesh.
//!
//! An edge node is **active** at its level if a refined element of that level has it. In a balanced forest the
//! edges at an active node are divided, and no others: a refined element divides its four edges, each of which
//! has one of its two edge nodes, and an edge whose elements are all coarse is divided by their templates alone.
//! So the template of a coarse element follows from its own two edge nodes:
//!
//! | active | template | quads |
//! |---|---|---|
//! | none | the element stays | 1 |
//! | one | template 1, oriented by the active node | 3 |
//! | both (always opposite) | template 2 | 4 |
//!
//! Quads come out level by level: first those that stay, then template 1, then template 2, each in the order of
//! their elements.

use std::mem::take;

use super::options::{RefineError, RefinedQuads};
use crate::forest::{Level, QuadForest, center, midpoint};
use crate::geometry::Point;
use crate::mesh::{EdgeId, FaceId, NodeId, QuadMesh, Tags};
use crate::parallel;
use crate::template::quad::{SPLIT, TEMPLATE_1, place};
use crate::{Cancelled, Monitor, Stage};

/// The stage that this file reports.
const TEMPLATES: Stage = Stage("templates");

/// Applies the templates to a strongly balanced forest.
///
/// # Errors
/// If the monitor stops it, or the templates would bring the mesh over `limit` quads.
pub(super) fn conform(
    mut forest: QuadForest,
    tags: &Tags,
    limit: u64,
    monitor: &dyn Monitor,
) -> Result<RefinedQuads, RefineError> {
    forest.complete_edges(monitor)?;
    let QuadForest { mut positions, mut levels, base_level } = forest;
    let active = active_nodes(&levels, positions.len());
    let transitions: Vec<Transition> =
        levels.iter().map(|level| Transition::of(level, &active, monitor)).collect::<Result<_, _>>()?;
    let (depth, quads) = (levels.len(), transitions.iter().map(Transition::quad_count).sum());
    if quads as u64 > limit {
        let level = base_level + (depth - 1) as u8;
        return Err(RefineError::TooManyQuads { level, quads: quads as u64, limit });
    }
    // Their memory is soon used again.
    levels.iter_mut().filter(|level| !is_mixed(level)).for_each(|level| level.edges = Default::default());
    let mut out =
        Leaves { level: Vec::with_capacity(quads), parent: Vec::with_capacity(quads), quads: Vec::new() };
    if levels.iter().any(is_mixed) {
        out.quads.reserve_exact(quads);
    }
    for (k, (mut level, transition)) in levels.into_iter().zip(&transitions).enumerate() {
        monitor.checkpoint(TEMPLATES, k as f64 / depth as f64)?;
        divide_active_edges(&mut level, &active, &mut positions, monitor)?;
        out.conform(level, transition, &mut positions, monitor)?;
        let made = out.quads.len() - out.level.len();
        parallel::extend(&mut out.level, made, |_| base_level + k as u8);
    }
    let tags = tags.inherited(bytemuck::cast_slice(&out.parent));
    let mesh = QuadMesh { positions, quads: out.quads };
    Ok(RefinedQuads { mesh, level: out.level, parent: out.parent, tags, capped: 0 })
}

/// True if some elements of a level are refined and others are not: only there are transitions.
fn is_mixed(level: &Level) -> bool {
    !level.refined.is_empty() && !level.is_full()
}

/// For each node: is it an edge node of a refined element, in a level with transitions? None is where there are none.
fn active_nodes(levels: &[Level], node_count: usize) -> Vec<bool> {
    let mut active = Vec::new();
    for Level { elements, refined, .. } in levels.iter().filter(|level| is_mixed(level)) {
        active.resize(node_count, false);
        parallel::raise(&mut active, refined.len(), |k| {
            let [_, edge_node, _, other_edge_node] = elements[refined[k] as usize];
            [edge_node.index(), other_edge_node.index()]
        });
    }
    active
}

/// The elements of a level that are not refined, by what becomes of them.
#[derive(Default)]
struct Transition {
    /// Those that stay as they are.
    stay: Stay,
    /// Those with the active node at local node 1, and at 3.
    one: [Vec<u32>; 2],
    /// Those with two active nodes.
    two: Vec<u32>,
}

/// Elements that no template changes.
enum Stay {
    All(usize),
    Some(Vec<u32>),
}

impl Default for Stay {
    fn default() -> Self {
        Self::Some(Vec::new())
    }
}

/// So many elements of a level are sorted by their templates at a time.
const SORTED_AT_ONCE: usize = 1 << 14;

impl Transition {
    fn of(level: &Level, active: &[bool], monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        if level.refined.is_empty() {
            return Ok(Self { stay: Stay::All(level.elements.len()), ..Self::default() });
        }
        if level.is_full() {
            return Ok(Self::default());
        }
        let is_refined = level.are_refined();
        let mut blocks = parallel::try_blocks(level.elements.len(), SORTED_AT_ONCE, monitor, |block| {
            let mut by_active: [Vec<u32>; 4] = Default::default();
            for e in block.filter(|&e| !is_refined[e]) {
                let [_, a, _, b] = level.elements[e].map(|n| usize::from(active[n.index()]));
                by_active[a + 2 * b].push(e as u32);
            }
            by_active
        })?;
        let mut with =
            |active: usize| parallel::concat(blocks.iter_mut().map(|b| take(&mut b[active])).collect());
        Ok(Self { stay: Stay::Some(with(0)), one: [with(1), with(2)], two: with(3) })
    }

    /// How many quads the elements become.
    fn quad_count(&self) -> usize {
        let stay = match &self.stay {
            Stay::All(count) => *count,
            Stay::Some(elements) => elements.len(),
        };
        stay + 3 * (self.one[0].len() + self.one[1].len()) + 4 * self.two.len()
    }
}

/// Divides the edges at active nodes that no refined element divides.
fn divide_active_edges(
    level: &mut Level,
    active: &[bool],
    positions: &mut Vec<Point>,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    if !is_mixed(level) {
        return Ok(());
    }
    let edges = &mut level.edges;
    let divided = parallel::filter_map(edges.ends.len(), |e| {
        let edge = EdgeId::new(e);
        (edges.is_undivided(edge) && active[edges.ends[e][0].index()]).then_some(edge)
    });
    let first_node = positions.len();
    parallel::try_grow(positions, divided.len(), monitor, |old, k| {
        midpoint(old, edges.ends[divided[k].index()])
    })?;
    edges.divide(&divided, first_node, monitor)
}

/// The quads of the result so far.
struct Leaves {
    quads: Vec<[NodeId; 4]>,
    level: Vec<u8>,
    parent: Vec<FaceId>,
}

impl Leaves {
    /// Takes the elements of a level that are not refined, by their templates.
    fn conform(
        &mut self,
        level: Level,
        transition: &Transition,
        positions: &mut Vec<Point>,
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        let Transition { stay, one: [first, third], two } = transition;
        match stay {
            Stay::All(count) => {
                parallel::try_extend(&mut self.parent, *count, monitor, |e| level.root(e))?;
                if self.quads.is_empty() {
                    self.quads = level.elements;
                    return Ok(());
                }
                return parallel::try_extend(&mut self.quads, *count, monitor, |e| level.elements[e]);
            }
            Stay::Some(elements) => {
                let (count, element) = (elements.len(), |k: usize| elements[k] as usize);
                parallel::try_extend(&mut self.parent, count, monitor, |k| level.root(element(k)))?;
                parallel::try_extend(&mut self.quads, count, monitor, |k| level.elements[element(k)])?;
            }
        }
        self.apply(|nodes| place(&TEMPLATE_1[1], nodes), first, &level, positions, monitor)?;
        self.apply(|nodes| place(&TEMPLATE_1[3], nodes), third, &level, positions, monitor)?;
        self.apply(|nodes| place(&SPLIT, nodes), two, &level, positions, monitor)
    }

    /// Replaces `elements` of a level by the quads of a template, giving each a face node.
    fn apply<const N: usize>(
        &mut self,
        template: impl Fn(&[NodeId; 9]) -> [[NodeId; 4]; N] + Sync,
        elements: &[u32],
        level: &Level,
        positions: &mut Vec<Point>,
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        let (count, element) = (elements.len(), |k: usize| elements[k] as usize);
        let first_face_node = positions.len();
        parallel::try_grow(positions, count, monitor, |old, k| center(old, level.elements[element(k)]))?;
        parallel::try_extend_arrays(&mut self.quads, count, monitor, |k| {
            let [r0, r1, r2, r3] = level.elements[element(k)];
            let sides = level.edges.of_element[element(k)];
            let [m0, m1, m2, m3] = sides.map(|edge| level.edges.middle[edge.index()]);
            template(&[r0, r1, r2, r3, m0, m1, m2, m3, NodeId::new(first_face_node + k)])
        })?;
        parallel::try_extend_arrays(&mut self.parent, count, monitor, |k| [level.root(element(k)); N])
    }
}
