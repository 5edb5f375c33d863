//! The shape of a surface, told by its normals.

use glam::DMat3;

use super::entities::SurfaceClass;
use crate::geometry::{Point, symmetric_eigen};

/// The mean square of the normals' components along a direction below which they count as perpendicular to it: 0.2
/// degrees for a plane, 1.8 degrees for an extruded surface.
const PLANAR: f64 = 1e-5;
const EXTRUDED: f64 = 1e-3;

/// The class of a surface with these area vectors (normals as long as the triangles' areas): by the eigenvalues of the
/// covariance of the normals, weighted by area, so that slivers of a poor tessellation do not count.
pub(super) fn classify(areas: impl Iterator<Item = Point>) -> SurfaceClass {
    let (mut covariance, mut total, mut sum) = (DMat3::ZERO, 0.0, Point::ZERO);
    for area in areas {
        let size = area.length();
        if size > 0.0 {
            let n = area / size;
            covariance += DMat3::from_cols(area * n.x, area * n.y, area * n.z);
            total += size;
            sum += area;
        }
    }
    if total == 0.0 {
        return SurfaceClass::General;
    }
    let [(least, axis), (middle, _), _] = symmetric_eigen(covariance * (1.0 / total));
    // A thin plate's two sides have one covariance; they are planar only if they look the same way.
    if middle < PLANAR && sum.length() > 0.5 * total {
        SurfaceClass::Planar { normal: sum.normalize() }
    } else if least < EXTRUDED {
        SurfaceClass::Cylindrical { axis }
    } else {
        SurfaceClass::General
    }
}
