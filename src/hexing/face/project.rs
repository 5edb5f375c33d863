//! What of a solid is seen along a direction: its curves, and where its surface turns away.
//!
//! A curve along the direction becomes a point. Edges where the surface turns from facing the direction to facing
//! against it, or to lying along it, bound what is covered; many of them are of feature curves.

use std::collections::{BTreeSet, HashMap};

use glam::DVec2;

use super::graph::{Graph, Segment};
use super::scale::Projection;
use super::shadow::Shadow;
use crate::hexing::direction::PERPENDICULAR;
use crate::solid::{Curve, SolidModel};

/// A curve that is shorter than this seen along the direction is a point: 0.15 h.
const POINT: f64 = 0.075;

/// How far beside a curve it is looked whether something is covered there: 0.02 h.
const ASIDE: f64 = 0.01;

/// The projected curves, in units.
#[derive(Debug, Default)]
pub(super) struct Projected {
    /// Where the surface turns away: first those that bound what is covered, each kind longest first.
    pub(super) rims: Vec<Vec<DVec2>>,
    /// How many of the rims bound what is covered.
    pub(super) outlines: usize,
    /// Other feature curves, longest first.
    pub(super) features: Vec<Vec<DVec2>>,
    /// Feature curves along the direction.
    pub(super) points: Vec<DVec2>,
}

/// Projects all feature curves and rims.
pub(super) fn project(solid: &SolidModel, projection: &Projection, shadow: &Shadow) -> Projected {
    let mut rim = rim_edges(solid, projection);
    let mut projected = Projected::default();
    for curve in solid.curves() {
        let flat: Vec<DVec2> =
            curve.vertices.iter().map(|&v| projection.unit_from_model(solid.points()[v as usize])).collect();
        let extent = flat.iter().fold(0.0_f64, |extent, p| extent.max(p.distance(flat[0])));
        if extent < POINT {
            projected.points.push(flat[0]);
        } else if is_rim(curve, &rim) {
            projected.rims.push(flat);
        } else {
            projected.features.push(flat);
        }
    }
    for edge in solid.curves().iter().flat_map(edges) {
        rim.remove(&edge);
    }
    projected.rims.extend(chains(solid, projection, &rim));
    for curves in [&mut projected.rims, &mut projected.features] {
        curves.iter_mut().for_each(|curve| curve.dedup_by(|a, b| a.distance(*b) < 1e-9));
        curves.retain(|curve| curve.len() > 1);
        // Stable, so that curves of one length stay in the order of the solid.
        curves.sort_by(|a, b| length(b).total_cmp(&length(a)));
    }
    let (outlines, others) =
        std::mem::take(&mut projected.rims).into_iter().partition::<Vec<_>, _>(|c| is_outline(c, shadow));
    projected.outlines = outlines.len();
    projected.rims = [outlines, others].concat();
    projected
}

/// Is most of the curve's length between what is covered and what is not?
fn is_outline(curve: &[DVec2], shadow: &Shadow) -> bool {
    let bounding = curve.windows(2).filter(|pair| {
        let (middle, way) = (pair[0].midpoint(pair[1]), pair[1] - pair[0]);
        let aside = way.perp() * (ASIDE / way.length());
        shadow.covers(middle + aside) != shadow.covers(middle - aside)
    });
    2.0 * bounding.map(|pair| pair[0].distance(pair[1])).sum::<f64>() > length(curve)
}

fn length(curve: &[DVec2]) -> f64 {
    curve.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

fn edges(curve: &Curve) -> impl Iterator<Item = [u32; 2]> {
    curve.vertices.windows(2).map(|pair| [pair[0].min(pair[1]), pair[0].max(pair[1])])
}

/// Is most of the curve of edges where the surface turns away?
fn is_rim(curve: &Curve, rim: &BTreeSet<[u32; 2]>) -> bool {
    2 * edges(curve).filter(|edge| rim.contains(edge)).count() > curve.vertices.len() - 1
}

/// The edges of triangles where the surface turns from facing the direction to lying along it or facing against it.
fn rim_edges(solid: &SolidModel, projection: &Projection) -> BTreeSet<[u32; 2]> {
    let facing = |t: usize| {
        let along = solid.normals()[t].dot(projection.direction());
        i8::from(along > PERPENDICULAR) - i8::from(along < -PERPENDICULAR)
    };
    let mut rim = BTreeSet::new();
    for (t, triangle) in solid.triangles().iter().enumerate() {
        for side in 0..3 {
            let (a, b) = (triangle[side], triangle[(side + 1) % 3]);
            if a < b && facing(t) != facing(solid.across(t, side) as usize) {
                rim.insert([a, b]);
            }
        }
    }
    rim
}

/// The edges as curves from branch to branch.
fn chains(solid: &SolidModel, projection: &Projection, rim: &BTreeSet<[u32; 2]>) -> Vec<Vec<DVec2>> {
    let mut graph = Graph::default();
    let mut ids: HashMap<u32, u32> = HashMap::new();
    for edge in rim {
        let ends = edge.map(|v| {
            let at = projection.unit_from_model(solid.points()[v as usize]);
            *ids.entry(v).or_insert_with(|| graph.add(at, false))
        });
        graph.segments.push(Segment { ends, outline: false });
    }
    let arcs = graph.arcs();
    arcs.iter().map(|arc| arc.points.iter().map(|&p| graph.points[p as usize]).collect()).collect()
}
