//! Shapes of regions, checked and made ready for many questions.

use glam::DMat3;

use super::error::RegionFault;
use super::probe::{FLUSH, Probe, ROUNDING};
use super::region::Shape;
use crate::geometry::{Aabb, Ball, Cylinder, NearestPoint, NearestTriangle, OrientedBox, Point, Triangle};

/// A shape made ready. Nothing here allocates when asked, but for the trees' stacks on deep walks.
#[derive(Debug)]
pub(super) enum Zone {
    Box(OrientedBox),
    Ball(Ball),
    Cylinder(Cylinder),
    Points { tree: NearestPoint, radius: f64, bounds: Aabb },
    Surface { tree: NearestTriangle, distance: f64, bounds: Aabb },
}

impl Zone {
    /// Checks a shape and prepares it.
    pub(super) fn new(shape: &Shape) -> Result<Self, RegionFault> {
        Ok(match shape {
            Shape::Box { min, max, rotation } => Self::Box(oriented_box(*min, *max, *rotation)?),
            Shape::Sphere { center, radius } => {
                finite("a coordinate of the centre", center)?;
                Self::Ball(Ball { center: *center, radius: positive("the radius", *radius)? })
            }
            Shape::Cylinder { from, to, radius } => {
                finite("a coordinate of from", from)?;
                finite("a coordinate of to", to)?;
                let radius = positive("the radius", *radius)?;
                if (*to - *from).try_normalize().is_none() {
                    return Err(RegionFault::NoAxis);
                }
                Self::Cylinder(Cylinder::new(*from, *to, radius))
            }
            Shape::Points { points, radius } => {
                points.iter().try_for_each(|p| finite("a coordinate of a point", p))?;
                if points.is_empty() {
                    return Err(RegionFault::NoPoints);
                }
                let radius = not_negative("the radius", *radius)?;
                Self::Points { tree: NearestPoint::new(points), radius, bounds: Aabb::around(points) }
            }
            Shape::Surface { positions, triangles, distance } => {
                let distance = not_negative("the distance", *distance)?;
                let triangles = corners(positions, triangles)?;
                let bounds = Aabb::around(triangles.iter().flat_map(|t| &t.0));
                Self::Surface { tree: NearestTriangle::new(triangles), distance, bounds }
            }
        })
    }

    /// The smallest box around the zone.
    pub(super) fn bounds(&self) -> Aabb {
        match self {
            Self::Box(b) => b.bounds(),
            Self::Ball(b) => b.bounds(),
            Self::Cylinder(c) => c.bounds(),
            Self::Points { radius, bounds, .. } => bounds.grown(*radius),
            Self::Surface { distance, bounds, .. } => bounds.grown(*distance),
        }
    }

    /// True if the element overlaps the zone by more than a touch.
    pub(super) fn overlaps(&self, probe: &Probe) -> bool {
        // What a round shape touches at a single point or line is not overlapped.
        let round = |radius: f64| probe.thick(radius) * (1.0 - ROUNDING);
        let any = |meets: &dyn Fn(&Triangle) -> bool| probe.triangles.iter().any(meets);
        match self {
            Self::Box(b) => {
                let grown = |half: f64, axis: Point| probe.thick(half) + probe.flush(axis);
                let half = Point::new(
                    grown(b.half.x, b.axes.x_axis),
                    grown(b.half.y, b.axes.y_axis),
                    grown(b.half.z, b.axes.z_axis),
                );
                let b = OrientedBox { half, ..*b };
                any(&|t| b.meets(t))
            }
            Self::Ball(b) => {
                let b = Ball { radius: round(b.radius), ..*b };
                any(&|t| b.meets(t))
            }
            Self::Cylinder(c) => {
                let half_length = probe.thick(c.half_length) + probe.flush(c.axes.z_axis);
                let c = Cylinder { radius: round(c.radius), half_length, ..*c };
                any(&|t| c.meets(t))
            }
            Self::Points { tree, radius, .. } => {
                let radius = round(*radius);
                let mut near = tree.within(probe.center, radius + probe.radius());
                near.any(|center| any(&|t| Ball { center, radius }.meets(t)))
            }
            Self::Surface { tree, distance, .. } => {
                let reach = probe.thick(*distance) + FLUSH * probe.longest;
                let mut near = tree.within(probe.center, reach + probe.radius());
                near.any(|s| any(&|t| t.distance_squared_to(s) <= reach * reach))
            }
        }
    }

    /// The distance between the element and the zone; 0 where they meet.
    pub(super) fn distance(&self, probe: &Probe) -> f64 {
        let beyond = |radius: f64, distance: f64| (distance - radius).max(0.0);
        match self {
            Self::Box(b) => probe.distance_to(|p| b.closest_point(p)),
            Self::Ball(b) => beyond(b.radius, probe.closest_point(b.center).distance(b.center)),
            Self::Cylinder(c) => probe.distance_to(|p| c.closest_point(p)),
            Self::Points { tree, radius, .. } => {
                beyond(*radius, probe.distance_to(|p| tree.closest_point(p).unwrap_or(p)))
            }
            Self::Surface { tree, distance, .. } => {
                beyond(*distance, probe.distance_to(|p| tree.closest_point(p).unwrap_or(p)))
            }
        }
    }
}

fn oriented_box(min: Point, max: Point, rotation: glam::DQuat) -> Result<OrientedBox, RegionFault> {
    finite("a coordinate of min", &min)?;
    finite("a coordinate of max", &max)?;
    for (i, axis) in ['x', 'y', 'z'].into_iter().enumerate() {
        if min[i] > max[i] {
            return Err(RegionFault::MinAboveMax { axis, min: min[i], max: max[i] });
        }
    }
    /// A quaternion this far from unit length was rounded; one farther off is a mistake.
    const ROUNDED: f64 = 1e-3;
    let length = rotation.length();
    if length.is_nan() || (length - 1.0).abs() > ROUNDED {
        return Err(RegionFault::NotARotation(length));
    }
    let axes = DMat3::from_quat(rotation.normalize());
    Ok(OrientedBox { center: min.midpoint(max), axes, half: (max - min) / 2.0 })
}

fn corners(positions: &[Point], triangles: &[[u32; 3]]) -> Result<Vec<Triangle>, RegionFault> {
    positions.iter().try_for_each(|p| finite("a coordinate of the surface", p))?;
    if triangles.is_empty() {
        return Err(RegionFault::NoTriangles);
    }
    let at = |triangle: usize, node: u32| {
        let missing = RegionFault::NodeOutOfRange { triangle, node, nodes: positions.len() };
        positions.get(node as usize).copied().ok_or(missing)
    };
    let all = triangles.iter().enumerate();
    all.map(|(i, &[a, b, c])| Ok(Triangle([at(i, a)?, at(i, b)?, at(i, c)?]))).collect()
}

fn finite(what: &'static str, p: &Point) -> Result<(), RegionFault> {
    match p.to_array().into_iter().find(|x| !x.is_finite()) {
        Some(value) => Err(RegionFault::NotFinite { what, value }),
        None => Ok(()),
    }
}

/// `value`, if it is positive and finite.
pub(super) fn positive(what: &'static str, value: f64) -> Result<f64, RegionFault> {
    match value {
        v if !v.is_finite() => Err(RegionFault::NotFinite { what, value }),
        v if v <= 0.0 => Err(RegionFault::NotPositive { what, value }),
        _ => Ok(value),
    }
}

fn not_negative(what: &'static str, value: f64) -> Result<f64, RegionFault> {
    match value {
        v if !v.is_finite() => Err(RegionFault::NotFinite { what, value }),
        v if v < 0.0 => Err(RegionFault::Negative { what, value }),
        _ => Ok(value),
    }
}
