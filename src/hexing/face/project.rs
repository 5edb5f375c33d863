//! What of a solid is seen along a direction: its curves, and where its surface turns away.
//!
//! A curve along the direction becomes a point. Edges where the surface turns from facing the direction to facing
//! against it, or to lying along it, bound what is covered; many of them are of feature curves.
//!
//! Top and foot of a wall along the direction, or nearly, that is lower than a quarter of an edge stand in one layer of a
//! sweep: of engravings and the like only what bounds the covered region is seen, or cells would be small and poor for
//! nothing.

use std::collections::{BTreeSet, HashMap};

use glam::DVec2;

use super::graph::{Graph, Segment};
use super::scale::Projection;
use super::shadow::Shadow;
use crate::geometry::Point;
use crate::hexing::across::{axis_across, faces_both};
use crate::hexing::direction::PERPENDICULAR;
use crate::hexing::extent::{Extent, ONE_LEVEL};
use crate::hexing::steps::step_height;
use crate::parallel::put_greatest_first;
use crate::solid::{Curve, SolidModel, Surface};

/// A curve that is shorter than this seen along the direction is a point: 0.15 h.
const POINT: f64 = 0.075;

/// The sine of 45 degrees: steps between parallel surfaces that lean more are no walls.
const LEANING: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// How far beside a curve it is looked whether something is covered there: 0.02 h.
const ASIDE: f64 = 0.01;

/// The projected curves, in units.
#[derive(Debug, Default)]
pub(super) struct Projected {
    /// Where the surface turns away: first those that bound what is covered, each kind longest first.
    pub(super) rims: Vec<Vec<DVec2>>,
    /// How many of the rims bound what is covered.
    pub(super) outlines: usize,
    /// Rectangles around round holes and pins across the direction that are a few edges thick at most, so that four cells
    /// are around their middle. Closed.
    pub(super) across: Vec<Vec<DVec2>>,
    /// Other feature curves, longest first.
    pub(super) features: Vec<Vec<DVec2>>,
    /// Feature curves along the direction.
    pub(super) points: Vec<DVec2>,
}

impl Projected {
    /// All curves: those that bound what is covered first.
    pub(super) fn curves(&self) -> impl Iterator<Item = &Vec<DVec2>> {
        let (outlines, rims) = self.rims.split_at(self.outlines);
        outlines.iter().chain(&self.across).chain(rims).chain(&self.features)
    }
}

/// Projects all feature curves and rims; `tolerance` is the share of the usual height of walls that are not seen.
pub(super) fn project(
    solid: &SolidModel,
    projection: &Projection,
    shadow: &Shadow,
    tolerance: f64,
) -> Projected {
    let low = low_walls(solid, projection, tolerance * ONE_LEVEL);
    let mut rim = rim_edges(solid, projection, &low);
    let mut projected = Projected::default();
    for curve in solid.curves() {
        let mut flat: Vec<DVec2> =
            curve.vertices.iter().map(|&v| projection.unit_from_model(solid.points()[v as usize])).collect();
        without_doubles(&mut flat);
        if curve.sides.iter().any(|side| low[side.index()]) && !is_outline(&flat, shadow) {
            continue;
        }
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
    let mut chains = chains(solid, projection, &rim);
    chains.iter_mut().for_each(without_doubles);
    projected.rims.extend(chains);
    for curves in [&mut projected.rims, &mut projected.features] {
        curves.retain(|curve| curve.len() > 1);
        // Curves of one length stay in the order of the solid.
        put_greatest_first(curves, |curve| length(curve));
    }
    let (outlines, others) =
        std::mem::take(&mut projected.rims).into_iter().partition::<Vec<_>, _>(|c| is_outline(c, shadow));
    projected.outlines = outlines.len();
    projected.rims = [outlines, others].concat();
    projected.across = solid.surfaces().iter().filter_map(|s| around(solid, s, projection)).collect();
    projected
}

/// The rectangle around a hole or pin across the direction, if it has two sides seen from there.
fn around(solid: &SolidModel, surface: &Surface, projection: &Projection) -> Option<Vec<DVec2>> {
    let axis = axis_across(solid, surface, projection.direction(), projection.scale.edge_length())?;
    let side = projection.direction().cross(axis).normalize();
    if !faces_both(solid, surface, side) {
        return None;
    }
    let [u, v, _] = projection.axes;
    let side = DVec2::new(side.dot(u), side.dot(v));
    let along = side.perp();
    let corners = surface.triangles.iter().flat_map(|&t| solid.corners_of(t as usize));
    let seen = corners.map(|p| projection.unit_from_model(p)).map(|p| DVec2::new(p.dot(side), p.dot(along)));
    let (a, b) = seen.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(a, b), p| (a.min(p), b.max(p)));
    let corner = |x: f64, y: f64| side * x + along * y;
    Some(vec![corner(a.x, a.y), corner(b.x, a.y), corner(b.x, b.y), corner(a.x, b.y), corner(a.x, a.y)])
}

/// Leaves out points that are where the one before is.
fn without_doubles(curve: &mut Vec<DVec2>) {
    curve.dedup_by(|a, b| a.distance(*b) < 1e-9);
}

/// Of each surface: is it a wall so low, in edge lengths, that its top and foot are one level?
fn low_walls(solid: &SolidModel, projection: &Projection, low: f64) -> Vec<bool> {
    let along = projection.direction();
    let low = low * projection.scale.edge_length();
    let is_low = |s: &Surface| Extent::of_surface(solid, s, along).thickness() < low;
    let is_wall = |s: &Surface| {
        let leans =
            |most: f64| s.triangles.iter().any(|&t| solid.normals()[t as usize].dot(along).abs() > most);
        !leans(PERPENDICULAR) || !leans(LEANING) && step_height(solid, s).is_some()
    };
    solid.surfaces().iter().map(|s| is_low(s) && is_wall(s)).collect()
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

/// Does a triangle face the direction (1), against it (-1), or lie along it (0)?
fn facing(solid: &SolidModel, triangle: usize, direction: Point) -> i8 {
    let along = solid.normals()[triangle].dot(direction);
    i8::from(along > PERPENDICULAR) - i8::from(along < -PERPENDICULAR)
}

/// The edges of triangles where the surface turns from facing the direction to lying along it or facing against it, but for
/// those within low walls.
fn rim_edges(solid: &SolidModel, projection: &Projection, low: &[bool]) -> BTreeSet<[u32; 2]> {
    let surface = |t: usize| solid.surface_of(t);
    let is_within = |t: usize, other: usize| low[surface(t).index()] && surface(t) == surface(other);
    let facing = |t: usize| facing(solid, t, projection.direction());
    let mut rim = BTreeSet::new();
    for (t, triangle) in solid.triangles().iter().enumerate() {
        for side in 0..3 {
            let (a, b) = (triangle[side], triangle[(side + 1) % 3]);
            let other = solid.across(t, side) as usize;
            if a < b && facing(t) != facing(other) && !is_within(t, other) {
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

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::Silent;
    use crate::hexing::face::{PrincipalFace, RegionOptions, principal_face};
    use crate::solid::testing::{cylinder, moved, solid, voxels};

    #[test]
    fn pins_across_have_a_rectangle_around_them_unless_they_are_thick_or_thin() {
        let around = |radius: f64, direction: Point| {
            // Along x, from 0 to 2.
            let pin = moved(cylinder(96), |p| Point::new(p.z, radius * p.x, radius * p.y));
            let solid = solid(&pin);
            let projection = Projection::new(solid.points(), direction, 1.0).unwrap();
            let curves = project(&solid, &projection, &Shadow::new(&solid, &projection), 1.0).across;
            let [u, v, _] = projection.axes;
            let place = |&p: &DVec2| {
                let p = projection.scale.model_from_unit(p);
                u * p.x + v * p.y
            };
            curves.iter().map(|curve| curve.iter().map(place).collect()).collect::<Vec<Vec<Point>>>()
        };
        let found = around(0.6, Point::Z);
        let [curve] = &found[..] else { panic!("one pin: {found:?}") };
        assert!(curve.len() == 5 && curve[0].distance(curve[4]) < 1e-9, "{curve:?}");
        for corner in [[0.0, -0.6], [2.0, -0.6], [2.0, 0.6], [0.0, 0.6]] {
            let corner = Point::new(corner[0], corner[1], 0.0);
            assert!(curve.iter().any(|p| p.distance(corner) < 2e-3), "{corner}: {curve:?}");
        }
        for (radius, direction) in [(1.7, Point::Z), (0.3, Point::Z), (0.6, Point::X)] {
            assert_eq!(around(radius, direction), Vec::<Vec<Point>>::new(), "{radius}");
        }
    }

    /// The face along z, with edges of 1, of a plate with a slot from x = 4.4 to 8.4.
    fn slotted(thickness: f64, depth: f64) -> PrincipalFace {
        let slot = |[x, y, z]: [i32; 3]| z > 0 && (4..8).contains(&x) && (3..9).contains(&y);
        let plate = moved(voxels([12, 12, 2], |at| !slot(at)), |p| {
            let x = if (4.0..=8.0).contains(&p.x) { p.x + 0.4 } else { p.x };
            Point::new(x, p.y, [0.0, thickness - depth, thickness][p.z as usize])
        });
        principal_face(&solid(&plate), Point::Z, &RegionOptions::new(1.0), 1.0, &Silent).unwrap()
    }

    #[test]
    fn shallow_slots_are_not_seen_and_deep_ones_are() {
        let shallow = slotted(3.0, 0.2);
        assert!(shallow.mesh.worst > 0.99, "{}", shallow.mesh.worst);
        // The outline of a plate that is as low is seen all the same.
        assert_eq!(shallow.mesh, slotted(0.24, 0.2).mesh);
        let beside = |PrincipalFace { mesh, axes: [u, v, _], .. }: PrincipalFace| {
            mesh.points.iter().filter(|p| ((u * p.x + v * p.y).x - 4.4).abs() < 1e-9).count()
        };
        assert_eq!([beside(shallow), beside(slotted(3.0, 0.5))], [0, 7]);
    }
}
