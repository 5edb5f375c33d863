//! How much room hexes take.

use std::ops::Range;

use serde::Serialize;

use super::HexMesh;
use super::numbering::hex::FACES;
use crate::geometry::Point;
use crate::parallel;

/// The volumes of the hexes of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Volumes {
    /// Of all hexes together.
    pub total: f64,
    /// Of the least hex.
    pub min: f64,
    /// Of the greatest hex.
    pub max: f64,
}

/// Hexes that one task sums: sums are made by blocks and then in order of blocks, so that the total does not depend
/// on the number of threads.
const BLOCK: usize = 1 << 12;

impl Volumes {
    /// Measures every hex; `None` for a mesh without hexes.
    ///
    /// # Panics
    /// If a node id is out of range: `check_hexes` tells before.
    pub fn of(mesh: &HexMesh) -> Option<Self> {
        let measure = |block: Range<usize>| {
            let none = Self { total: 0.0, min: f64::INFINITY, max: f64::NEG_INFINITY };
            let volumes =
                mesh.hexes[block].iter().map(|hex| hex_volume(&hex.map(|n| mesh.positions[n.index()])));
            volumes.fold(none, |sum, v| Self {
                total: sum.total + v,
                min: sum.min.min(v),
                max: sum.max.max(v),
            })
        };
        let blocks: Vec<Self> = parallel::blocks(mesh.hexes.len(), BLOCK, measure);
        let add = |a: Self, b: Self| Self {
            total: a.total + b.total,
            min: a.min.min(b.min),
            max: a.max.max(b.max),
        };
        blocks.into_iter().reduce(add)
    }
}

/// The volume of the trilinear hex with the given corners; negative if it is mirrored.
///
/// Exact but for rounding: a third of the flux of the position through each bilinear face, which is the mean of
/// what the triangles of its two diagonals make of it. So the volumes of the hexes of a mesh add up to what its
/// boundary encloses.
pub fn hex_volume(corners: &[Point; 8]) -> f64 {
    let at = |k: u8| corners[usize::from(k)] - corners[0];
    let twelfths = FACES.map(|face| {
        let [a, b, c, d] = face.map(at);
        let (ab, cd) = (a.cross(b), c.cross(d));
        ab.dot(c) + ab.dot(d) + cd.dot(a) + cd.dot(b)
    });
    twelfths.iter().sum::<f64>() / 12.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::NodeId;
    use crate::mesh::numbering::hex::{CORNERS, SYMMETRIES};

    fn cube() -> [Point; 8] {
        CORNERS.map(|c| Point::from(c.map(f64::from)))
    }

    #[test]
    fn boxes_wedges_and_mirrors() {
        let brick = cube().map(|p| p * Point::new(2.0, 3.0, 5.0) + Point::splat(7.0));
        assert_eq!(hex_volume(&brick), 30.0);
        let mut wedge = cube();
        (wedge[1], wedge[5]) = (wedge[0], wedge[4]);
        assert_eq!(hex_volume(&wedge), 0.5);
        for (s, symmetry) in SYMMETRIES.iter().enumerate() {
            let sign = if s < 24 { 1.0 } else { -1.0 };
            assert_eq!(hex_volume(&symmetry.map(|k| cube()[usize::from(k)])), sign);
        }
    }

    #[test]
    fn a_bent_hex_has_the_volume_of_its_integral() {
        let bend = |p: Point| p + Point::new(0.3 * p.y * p.z, 0.2 * p.x * p.z, -0.25 * p.x * p.y * p.z);
        // The trilinear map is (x + 0.3 yz, y + 0.2 xz, z - 0.25 xyz); its Jacobian is integrated by Gauss's rule
        // of three points an axis, exact for the degrees here.
        let nodes =
            [(0.5 - 0.15_f64.sqrt(), 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.5 + 0.15_f64.sqrt(), 5.0 / 18.0)];
        let mut integral = 0.0;
        for (x, wx) in nodes {
            for (y, wy) in nodes {
                for (z, wz) in nodes {
                    let dx = Point::new(1.0, 0.2 * z, -0.25 * y * z);
                    let dy = Point::new(0.3 * z, 1.0, -0.25 * x * z);
                    let dz = Point::new(0.3 * y, 0.2 * x, 1.0 - 0.25 * x * y);
                    integral += wx * wy * wz * dx.cross(dy).dot(dz);
                }
            }
        }
        assert!((hex_volume(&cube().map(bend)) - integral).abs() < 1e-14);
    }

    #[test]
    fn a_mesh_is_measured_as_a_whole() {
        assert_eq!(Volumes::of(&HexMesh::default()), None);
        let mut positions = cube().to_vec();
        positions.extend(cube().map(|p| p * 2.0));
        let hexes = vec![std::array::from_fn(NodeId::new), std::array::from_fn(|k| NodeId::new(8 + k))];
        let mesh = HexMesh { positions, hexes, ..HexMesh::default() };
        assert_eq!(Volumes::of(&mesh), Some(Volumes { total: 9.0, min: 1.0, max: 8.0 }));
    }
}
