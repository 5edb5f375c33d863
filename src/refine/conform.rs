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

use super::options::{RefineError, RefinedQuads};
use crate::forest::{Level, QuadForest, UNDIVIDED, center, midpoint};
use crate::geometry::Point;
use crate::mesh::{FaceId, NodeId, QuadMesh, Tags};
use crate::monitor::batches;
use crate::parallel;
use crate::template::quad::{Cells, SPLIT, TEMPLATE_1, place};
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
    let QuadForest { mut positions, levels, base_level } = forest;
    let active = active_nodes(&levels, positions.len(), monitor)?;
    let transitions: Vec<Transition> =
        levels.iter().map(|level| Transition::of(level, &active, monitor)).collect::<Result<_, _>>()?;
    let (depth, quads) = (levels.len(), transitions.iter().map(Transition::quad_count).sum());
    if quads as u64 > limit {
        let level = base_level + (depth - 1) as u8;
        return Err(RefineError::TooManyQuads { level, quads: quads as u64, limit });
    }
    let mut out = Leaves::with_capacity(quads);
    for (k, (mut level, transition)) in levels.into_iter().zip(&transitions).enumerate() {
        monitor.checkpoint(TEMPLATES, k as f64 / depth as f64)?;
        divide_active_edges(&mut level, &active, &mut positions, monitor)?;
        out.conform(level, transition, &mut positions, monitor)?;
        out.level.resize(out.quads.len(), base_level + k as u8);
    }
    let tags = tags.inherited(bytemuck::cast_slice(&out.parent));
    let mesh = QuadMesh { positions, quads: out.quads };
    Ok(RefinedQuads { mesh, level: out.level, parent: out.parent, tags, capped: 0 })
}

/// For each node: is it an edge node of a refined element?
fn active_nodes(levels: &[Level], node_count: usize, monitor: &dyn Monitor) -> Result<Vec<bool>, Cancelled> {
    let mut active = vec![false; node_count];
    for level in levels {
        for batch in batches(level.refined.len(), monitor) {
            for &e in &level.refined[batch?] {
                let [_, edge_node, _, other_edge_node] = level.elements[e as usize];
                active[edge_node.index()] = true;
                active[other_edge_node.index()] = true;
            }
        }
    }
    Ok(active)
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

impl Transition {
    fn of(level: &Level, active: &[bool], monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        if level.refined.is_empty() {
            return Ok(Self { stay: Stay::All(level.elements.len()), ..Self::default() });
        }
        let left = parallel::filter(level.elements.len(), |e| !level.is_refined[e]);
        let select = |wanted: (bool, bool)| -> Result<Vec<u32>, Cancelled> {
            monitor.proceed()?;
            Ok(parallel::filter_map(left.len(), |k| {
                let [_, a, _, b] = level.elements[left[k] as usize];
                ((active[a.index()], active[b.index()]) == wanted).then_some(left[k])
            }))
        };
        Ok(Self {
            stay: Stay::Some(select((false, false))?),
            one: [select((true, false))?, select((false, true))?],
            two: select((true, true))?,
        })
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
    let edges = &mut level.edges;
    for batch in batches(edges.ends.len(), monitor) {
        let batch = batch?;
        for (ends, middle) in edges.ends[batch.clone()].iter().zip(&mut edges.middle[batch]) {
            if *middle == UNDIVIDED && active[ends[0].index()] {
                *middle = NodeId::new(positions.len());
                positions.push(midpoint(positions, *ends));
            }
        }
    }
    Ok(())
}

/// The quads of the result so far.
struct Leaves {
    quads: Vec<[NodeId; 4]>,
    level: Vec<u8>,
    parent: Vec<FaceId>,
}

impl Leaves {
    fn with_capacity(quads: usize) -> Self {
        Self {
            quads: Vec::with_capacity(quads),
            level: Vec::with_capacity(quads),
            parent: Vec::with_capacity(quads),
        }
    }

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
            Stay::All(_) => {
                parallel::extend(&mut self.parent, level.elements.len(), |e| level.root(e));
                if self.quads.is_empty() {
                    self.quads = level.elements;
                } else {
                    parallel::extend_from_slice(&mut self.quads, &level.elements);
                }
                return Ok(());
            }
            Stay::Some(elements) => {
                let (count, element) = (elements.len(), |k: usize| elements[k] as usize);
                parallel::extend(&mut self.parent, count, |k| level.root(element(k)));
                parallel::extend(&mut self.quads, count, |k| level.elements[element(k)]);
            }
        }
        monitor.proceed()?;
        self.apply(&TEMPLATE_1[1], first, &level, positions);
        monitor.proceed()?;
        self.apply(&TEMPLATE_1[3], third, &level, positions);
        monitor.proceed()?;
        self.apply(&SPLIT, two, &level, positions);
        Ok(())
    }

    /// Applies a template to `elements` of a level, giving each a face node.
    fn apply<const N: usize>(
        &mut self,
        template: &Cells<N>,
        elements: &[u32],
        level: &Level,
        positions: &mut Vec<Point>,
    ) {
        let first_face_node = positions.len();
        parallel::grow(positions, elements.len(), |old, k| center(old, level.elements[elements[k] as usize]));
        let cells: Vec<[[NodeId; 4]; N]> = parallel::collect(elements.len(), |k| {
            let e = elements[k] as usize;
            let [r0, r1, r2, r3] = level.elements[e];
            let [m0, m1, m2, m3] = level.edges.of_element[e].map(|e| level.edges.middle[e.index()]);
            let face_node = NodeId::new(first_face_node + k);
            place(template, &[r0, r1, r2, r3, m0, m1, m2, m3, face_node])
        });
        self.quads.extend_from_slice(cells.as_flattened());
        parallel::extend(&mut self.parent, N * elements.len(), |k| level.root(elements[k / N] as usize));
    }
}
