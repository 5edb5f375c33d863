//! Where the layer would fold: the edge of the layer at a node of the interface must leave each face of the interface
//! there towards its own side. Copies of nodes on the boundary are not free to do so.
//!
//! Smoothing moves the nodes beside such an edge too, where they can move themselves, so that not every fold is one to
//! stay. One stays if the edge is
//! 1. on the wrong side of a face, whichever way the copy may go;
//! 2. in line with an edge of the interface whose other end cannot leave that line;
//! 3. in the plane of a face whose two edges at the node have ends that cannot leave that plane.

use super::bounds::Freedom;
use super::interface::{Interface, Star};
use super::regions::Regions;
use crate::geometry::Point;
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::FACES;

/// The faces of the interface at a node. Its buffer serves one node after another.
#[derive(Default)]
pub(super) struct Folds {
    faces: Vec<Face>,
}

struct Face {
    /// The refined region and the coarse one beside it.
    regions: [u32; 2],
    /// The normal at the node, towards the refined one; of length 1.
    inward: Point,
    /// The face's two edges at the node, of length 1, and their other ends.
    edges: [Point; 2],
    ends: [NodeId; 2],
}

/// The sine of the least angle at which a copy should leave a face, where it can.
const STEEP: f64 = 0.1;

/// How often a direction is turned away from the face that it is nearest to.
const TURNS: usize = 8;

/// Edges with a greater cosine are in line.
const IN_LINE: f64 = 0.99;

/// The sine below which an edge lies in the plane of a face.
const FLAT: f64 = 1e-3;

impl Folds {
    /// Takes the faces of the interface in a star.
    pub(super) fn load(
        &mut self,
        positions: &[Point],
        interface: &Interface,
        star: &Star,
        regions: &Regions,
    ) {
        let at = positions[star.node.index()];
        self.faces.clear();
        for [(refined, side), (coarse, _)] in star.faces.iter().filter_map(|face| star.sides(face)) {
            let (id, corner, _) = star.hexes[refined];
            let nodes = FACES[usize::from(side)].map(|k| interface.hexes[id as usize][usize::from(k)]);
            let here = FACES[usize::from(side)].iter().position(|&k| k == corner);
            let here = here.expect("the face is at the node");
            let ends = [nodes[(here + 1) % 4], nodes[(here + 3) % 4]];
            let edges = ends.map(|end| (positions[end.index()] - at).normalize_or_zero());
            self.faces.push(Face {
                regions: [regions.of_hex[refined], regions.of_hex[coarse]],
                inward: edges[1].cross(edges[0]).normalize_or_zero(),
                edges,
                ends,
            });
        }
    }

    /// The mean normal of the interface at the node, towards the refined side; of length 1 or 0.
    pub(super) fn mean_inward(&self) -> Point {
        self.faces.iter().map(|face| face.inward).sum::<Point>().normalize_or_zero()
    }

    /// A direction that leaves the faces of a region well, if the given one does not.
    pub(super) fn steeper(&self, region: u32, direction: Point, freedom: Freedom) -> Point {
        let own = || {
            self.faces.iter().filter_map(move |face| match face.regions {
                [refined, _] if refined == region => Some(face.inward),
                [_, coarse] if coarse == region => Some(-face.inward),
                _ => None,
            })
        };
        let nearest = |direction: Point| {
            own().map(|inward| (inward.dot(direction), inward)).min_by(|a, b| a.0.total_cmp(&b.0))
        };
        let Some((mut best, mut inward)) = nearest(direction) else { return direction };
        let (mut at_best, mut turned) = (direction, direction);
        for _ in 0..TURNS {
            if best > STEEP {
                break;
            }
            turned = (turned + freedom.part_of(inward)).normalize_or_zero();
            let Some(next) = nearest(turned) else { break };
            inward = next.1;
            if next.0 > best {
                (best, at_best) = (next.0, turned);
            }
        }
        at_best
    }

    /// Does the layer fold for good, if regions move like this? `freedom` tells where the interface's nodes can go.
    pub(super) fn any(
        &self,
        moved: impl Fn(u32) -> Point,
        mut freedom: impl FnMut(NodeId) -> Freedom,
    ) -> bool {
        self.faces.iter().any(|face| {
            let [refined, coarse] = face.regions.map(&moved);
            let leaving = (refined - coarse).normalize_or_zero();
            let sine = face.inward.dot(leaving);
            if sine > FLAT {
                return false;
            }
            let mut stays_in_line = |k: usize| {
                leaving.dot(face.edges[k]).abs() > IN_LINE
                    && !freedom(face.ends[k]).leaves_line(face.edges[k])
            };
            sine < -STEEP
                || stays_in_line(0)
                || stays_in_line(1)
                || !face.ends.into_iter().any(|end| freedom(end).leaves_plane(face.inward))
        })
    }
}
