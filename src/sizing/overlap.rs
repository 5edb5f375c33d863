//! Whether an element and a region's shape overlap by more than a touch.
//!
//! **Rule.** Shrink the element towards the mean of its corners by [`TOUCH`]. The element overlaps the shape if the
//! rest of it meets the shape, its boundary included. So
//! - an element that a region's face, edge or curve only touches from outside along its own edge is left alone,
//! - an element that lies in a region's face overlaps it (the box from the plane of a planar mesh upwards),
//! - a shape in the element's interior overlaps it, however small, even if it is near none of its corners and edges.
//!
//! **Shapes of no thickness.** Each extent of a shape (half edges of a box, radius and half length of a cylinder, the
//! radius about points, the distance from a surface) counts as at least what the element was shrunk by. So a flat box,
//! a point or a surface refines the elements that it lies in; one that lies in an edge refines all elements at it.
//!
//! **Elements**, quads and hexes, are the hulls of their corners (`geometry::Hull`): for quads that are not flat
//! those of both diagonals and what is between them.
//!
//! **Grading.** The distance of element and shape is asked for in the same way: the element meets the shape grown
//! by `reach`.

use glam::DQuat;

use super::{Shape, SizedElement};
use crate::geometry::{
    Aabb, BoxIndex, CenteredBox, CenteredCylinder, Corners, Frame, Hull, Point, Solid, closest_on_triangle,
};

/// An overlap thinner than this share of an element's width is a touch: regions and nodes are often given with four
/// or five digits, and an edge that is meant to lie on a region's face then misses it by that much.
pub(super) const TOUCH: f64 = 1e-4;

/// An element that lies in a region's face up to this share of its size lies in the region: what rounding leaves of
/// a plane. Far less than [`TOUCH`], so that a touch remains one on elements a thousand times as long as wide.
const COINCIDENT: f64 = 1e-8;

/// What every shape wants to know of an element.
pub(super) struct Probe<const N: usize> {
    corners: [Point; N],
    bounds: Aabb,
    /// The mean of the corners; shrinking does not move it.
    middle: Point,
    /// The greatest distance of a corner from the middle.
    radius: f64,
}

impl<const N: usize> Probe<N>
where
    [Point; N]: Corners,
{
    #[inline]
    pub(super) fn new(element: &SizedElement<N>) -> Self {
        let corners = element.corners;
        let pairs = corners.chunks(2).map(|pair| pair.iter().sum::<Point>());
        let middle = pairs.sum::<Point>() / N as f64;
        let squared = corners.iter().fold(0.0, |m: f64, c| m.max(c.distance_squared(middle)));
        Self { corners, bounds: Aabb::around(&corners), middle, radius: squared.sqrt() }
    }

    /// A box that touches the bounds of every shape that this element can be found to meet with a reach up to `reach`.
    #[inline]
    pub(super) fn bounds_within(&self, reach: f64) -> Aabb {
        self.bounds.grown(reach + self.least_extent())
    }

    fn shrunk(&self) -> <[Point; N] as Corners>::Hull {
        self.corners.map(|c| c + (self.middle - c) * TOUCH).hull()
    }

    /// The least extent that a shape has for this element: as far as shrinking moved a corner.
    fn least_extent(&self) -> f64 {
        TOUCH * self.radius
    }

    fn coincident(&self) -> f64 {
        COINCIDENT * self.radius
    }
}

/// A shape made ready.
#[derive(Debug)]
pub(super) struct Overlap {
    /// Around the shape.
    pub(super) bounds: Aabb,
    shape: Prepared,
}

#[derive(Debug)]
enum Prepared {
    Box { frame: Frame, half: Point },
    Ball { center: Point, radius: f64 },
    Cylinder { frame: Frame, radius: f64, half_length: f64 },
    Points { points: Vec<Point>, index: BoxIndex, radius: f64 },
    Surface { triangles: Vec<[Point; 3]>, index: BoxIndex, distance: f64 },
}

impl Overlap {
    /// Prepares a shape that has been found valid.
    pub(super) fn new(shape: &Shape) -> Self {
        match shape {
            Shape::Box { min, max, rotation } => Self::of_box(*min, *max, *rotation),
            Shape::Sphere { center, radius } => Self::of_ball(*center, *radius),
            Shape::Cylinder { from, to, radius } => Self::of_cylinder(*from, *to, *radius),
            Shape::Points { points, radius } => Self {
                bounds: Aabb::around(points).grown(*radius),
                shape: Prepared::Points {
                    index: BoxIndex::of_points(points),
                    points: points.clone(),
                    radius: *radius,
                },
            },
            Shape::Surface { positions, triangles, distance } => {
                let triangles: Vec<[Point; 3]> =
                    triangles.iter().map(|t| t.map(|n| positions[n as usize])).collect();
                Self {
                    bounds: Aabb::around(triangles.as_flattened()).grown(*distance),
                    shape: Prepared::Surface {
                        index: BoxIndex::new(triangles.iter().map(Aabb::around)),
                        triangles,
                        distance: *distance,
                    },
                }
            }
        }
    }

    fn of_box(min: Point, max: Point, rotation: DQuat) -> Self {
        let frame = Frame::new(min.midpoint(max), unit(rotation));
        let half = max * 0.5 - min * 0.5;
        let around = frame.world_half(half);
        let bounds = Aabb { min: frame.origin() - around, max: frame.origin() + around };
        Self { bounds, shape: Prepared::Box { frame, half } }
    }

    fn of_ball(center: Point, radius: f64) -> Self {
        let bounds = Aabb { min: center, max: center }.grown(radius);
        Self { bounds, shape: Prepared::Ball { center, radius } }
    }

    fn of_cylinder(from: Point, to: Point, radius: f64) -> Self {
        let Some(axis) = (to - from).try_normalize() else { return Self::of_ball(from, radius) };
        let frame = Frame::along(from.midpoint(to), axis);
        // A disc reaches along a coordinate axis as far as the sine of the angle between that and its own axis.
        let disc = (Point::ONE - axis * axis).max(Point::ZERO).map(f64::sqrt) * radius;
        let ends = Aabb::around(&[from, to]);
        let bounds = Aabb { min: ends.min - disc, max: ends.max + disc };
        Self { bounds, shape: Prepared::Cylinder { frame, radius, half_length: from.distance(to) * 0.5 } }
    }

    /// True if the shape holds all of the hull of these points. It may, and that not be told, where it takes several points or
    /// triangles together.
    pub(super) fn holds(&self, points: &[Point]) -> bool {
        let around = Aabb::around(points);
        if !(self.bounds.min.cmple(around.min).all() && self.bounds.max.cmpge(around.max).all()) {
            return false;
        }
        // Each of the shapes is convex: it holds the hull of what it holds.
        match &self.shape {
            Prepared::Box { frame, half } => {
                let body = CenteredBox { half: *half };
                points.iter().all(|&p| body.holds(frame.local(p)))
            }
            Prepared::Ball { center, radius } => points.iter().all(|p| p.distance(*center) <= *radius),
            Prepared::Cylinder { frame, radius, half_length } => {
                let body = CenteredCylinder { radius: *radius, half_length: *half_length };
                points.iter().all(|&p| body.holds(frame.local(p)))
            }
            Prepared::Points { points: centers, index, radius } => index
                .touching(&around.grown(*radius))
                .any(|i| points.iter().all(|p| p.distance(centers[i]) <= *radius)),
            Prepared::Surface { triangles, index, distance } => {
                index.touching(&around.grown(*distance)).any(|i| {
                    points.iter().all(|&p| p.distance(closest_on_triangle(p, triangles[i])) <= *distance)
                })
            }
        }
    }

    /// True if the element overlaps the shape by more than a touch, or is nearer to it than `reach`.
    #[inline]
    pub(super) fn is_met<const N: usize>(&self, element: &Probe<N>, reach: f64) -> bool
    where
        [Point; N]: Corners,
    {
        self.bounds.touches(&element.bounds_within(reach)) && self.shape.is_met(element, reach)
    }
}

impl Prepared {
    fn is_met<const N: usize>(&self, element: &Probe<N>, reach: f64) -> bool
    where
        [Point; N]: Corners,
    {
        let (least, coincident) = (element.least_extent(), element.coincident());
        match self {
            Self::Box { frame, half } => {
                let body = CenteredBox { half: half.max(Point::splat(least)) };
                solid_is_met(&body.grown(coincident), frame, element, reach)
            }
            Self::Cylinder { frame, radius, half_length } => {
                let body =
                    CenteredCylinder { radius: radius.max(least), half_length: half_length.max(least) };
                solid_is_met(&body.grown(coincident), frame, element, reach)
            }
            Self::Ball { center, radius } => {
                is_near(element, *center, radius.max(least) + coincident + reach)
            }
            Self::Points { points, index, radius } => {
                let distance = radius.max(least) + coincident + reach;
                some_is_near(
                    element,
                    index,
                    distance,
                    |i| points[i],
                    |hull, i| hull.is_near(points[i], distance),
                )
            }
            Self::Surface { triangles, index, distance } => {
                let distance = distance.max(least) + coincident + reach;
                let closest = |i: usize| closest_on_triangle(element.middle, triangles[i]);
                some_is_near(element, index, distance, closest, |hull, i| {
                    hull.comes_within(&triangles[i], distance)
                })
            }
        }
    }
}

/// True if one of the indexed things comes as near to the shrunk element as `distance`. `closest` gives a thing's
/// point that is closest to the element's middle; `is_near` tells of it exactly.
///
/// Most elements that are met have something near their middle, so the cube in the ball about it is searched first.
fn some_is_near<const N: usize>(
    element: &Probe<N>,
    index: &BoxIndex,
    distance: f64,
    closest: impl Fn(usize) -> Point,
    is_near: impl Fn(&<[Point; N] as Corners>::Hull, usize) -> bool,
) -> bool
where
    [Point; N]: Corners,
{
    let gap = |i: usize| closest(i).distance_squared(element.middle);
    let cube = Aabb { min: element.middle, max: element.middle }.grown(distance / 3.0_f64.sqrt());
    if index.touching(&cube).any(|i| gap(i) <= distance * distance) {
        return true;
    }
    let far = distance + element.radius;
    let mut hull = None;
    index.touching(&element.bounds.grown(distance)).any(|i| {
        let gap = gap(i);
        gap <= distance * distance
            || gap <= far * far && is_near(hull.get_or_insert_with(|| element.shrunk()), i)
    })
}

/// True if the shrunk element comes as near to a solid in `frame` as `reach`: told by its middle and its circle if
/// they can.
fn solid_is_met<const N: usize>(solid: &impl Solid, frame: &Frame, element: &Probe<N>, reach: f64) -> bool
where
    [Point; N]: Corners,
{
    let middle = frame.local(element.middle);
    if solid.holds(middle) {
        return true;
    }
    if !solid.grown(reach + element.radius).holds(middle) {
        return false;
    }
    let hull = element.shrunk().moved(|p| frame.local(p));
    if reach > 0.0 { hull.comes_within(solid, reach) } else { hull.meets(solid) }
}

/// True if the shrunk element comes as near to `p` as `distance`: told by its middle or its circle if they can.
#[inline]
fn is_near<const N: usize>(element: &Probe<N>, p: Point, distance: f64) -> bool
where
    [Point; N]: Corners,
{
    let squared = element.middle.distance_squared(p);
    let far = distance + element.radius;
    squared <= distance * distance || squared <= far * far && element.shrunk().is_near(p, distance)
}

/// The rotation that a quaternion of any length but 0 stands for.
fn unit(rotation: DQuat) -> DQuat {
    let largest = rotation.to_array().into_iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    (rotation * (1.0 / largest)).normalize()
}
