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

use rayon::prelude::*;

use super::RefinedQuads;
use crate::forest::{Level, QuadForest, UNDIVIDED, center, midpoint};
use crate::geometry::Point;
use crate::mesh::{FaceId, NodeId, QuadMesh, Tags};
use crate::template::quad::{Cells, SPLIT, TEMPLATE_1, place};
use crate::{Cancelled, Monitor, Stage};

/// The stage that this file reports.
const TEMPLATES: Stage = Stage("templates");

/// Applies the templates to a strongly balanced forest.
pub(super) fn conform(
    mut forest: QuadForest,
    tags: &Tags,
    monitor: &dyn Monitor,
) -> Result<RefinedQuads, Cancelled> {
    forest.complete_edges();
    let QuadForest { mut positions, levels, base_level } = forest;
    let active = active_nodes(&levels, positions.len());
    let depth = levels.len();
    let mut out = Leaves::default();
    for (k, mut level) in levels.into_iter().enumerate() {
        monitor.checkpoint(TEMPLATES, k as f64 / depth as f64)?;
        if level.refined.is_empty() {
            out.keep(level);
        } else {
            divide_active_edges(&mut level, &active, &mut positions);
            out.conform(&level, &Transition::of(&level, &active), &mut positions);
        }
        out.level.resize(out.quads.len(), base_level + k as u8);
    }
    let tags = tags.inherited(bytemuck::cast_slice(&out.parent));
    let mesh = QuadMesh { positions, quads: out.quads };
    Ok(RefinedQuads { mesh, level: out.level, parent: out.parent, tags, capped: 0 })
}

/// For each node: is it an edge node of a refined element?
fn active_nodes(levels: &[Level], node_count: usize) -> Vec<bool> {
    let mut active = vec![false; node_count];
    for level in levels {
        for &e in &level.refined {
            let [_, edge_node, _, other_edge_node] = level.elements[e as usize];
            active[edge_node.index()] = true;
            active[other_edge_node.index()] = true;
        }
    }
    active
}

/// The elements of a level that are not refined, by what becomes of them.
struct Transition {
    /// Those that stay as they are.
    stay: Vec<u32>,
    /// Those with the active node at local node 1, and at 3.
    one: [Vec<u32>; 2],
    /// Those with two active nodes.
    two: Vec<u32>,
}

impl Transition {
    fn of(level: &Level, active: &[bool]) -> Self {
        let select = |first: bool, second: bool| -> Vec<u32> {
            let all = (0..level.elements.len()).into_par_iter();
            all.filter(|&e| {
                let [_, a, _, b] = level.elements[e];
                !level.is_refined[e] && (active[a.index()], active[b.index()]) == (first, second)
            })
            .map(|e| e as u32)
            .collect()
        };
        Self {
            stay: select(false, false),
            one: [select(true, false), select(false, true)],
            two: select(true, true),
        }
    }
}

/// Divides the edges at active nodes that no refined element divides.
fn divide_active_edges(level: &mut Level, active: &[bool], positions: &mut Vec<Point>) {
    for (ends, middle) in level.edges.ends.iter().zip(&mut level.edges.middle) {
        if *middle == UNDIVIDED && active[ends[0].index()] {
            *middle = NodeId::new(positions.len());
            positions.push(midpoint(positions, *ends));
        }
    }
}

/// The quads of the result so far.
#[derive(Default)]
struct Leaves {
    quads: Vec<[NodeId; 4]>,
    level: Vec<u8>,
    parent: Vec<FaceId>,
}

impl Leaves {
    /// Takes a level none of whose elements is refined: no edge node of it is active.
    fn keep(&mut self, level: Level) {
        self.parent.par_extend(level.roots());
        if self.quads.is_empty() {
            self.quads = level.elements;
        } else {
            self.quads.extend_from_slice(&level.elements);
        }
    }

    /// Takes the elements of a level that are not refined, by their templates.
    fn conform(&mut self, level: &Level, transition: &Transition, positions: &mut Vec<Point>) {
        let Transition { stay, one: [first, third], two } = transition;
        self.parent.par_extend(stay.par_iter().map(|&e| level.root(e as usize)));
        self.quads.par_extend(stay.par_iter().map(|&e| level.elements[e as usize]));
        self.apply(&TEMPLATE_1[1], first, level, positions);
        self.apply(&TEMPLATE_1[3], third, level, positions);
        self.apply(&SPLIT, two, level, positions);
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
        let centers: Vec<_> =
            elements.par_iter().map(|&e| center(positions, level.elements[e as usize])).collect();
        positions.extend_from_slice(&centers);
        let cells: Vec<[[NodeId; 4]; N]> = elements
            .par_iter()
            .enumerate()
            .map(|(k, &e)| {
                let [r0, r1, r2, r3] = level.elements[e as usize];
                let [m0, m1, m2, m3] =
                    level.edges.of_element[e as usize].map(|e| level.edges.middle[e.index()]);
                let face_node = NodeId::new(first_face_node + k);
                place(template, &[r0, r1, r2, r3, m0, m1, m2, m3, face_node])
            })
            .collect();
        self.quads.extend_from_slice(cells.as_flattened());
        let roots: Vec<_> = elements.par_iter().map(|&e| [level.root(e as usize); N]).collect();
        self.parent.extend_from_slice(roots.as_flattened());
    }
}
