//! Small hex meshes for the tests of forests.

use super::HexForest;
use crate::Silent;
use crate::geometry::Point;
use crate::mesh::numbering::hex::CORNERS;
use crate::mesh::{HexMesh, NodeId};

/// Coordinates in units of 2^-20, to tell nodes of dyadic meshes apart exactly.
pub(super) fn key_of(p: Point) -> [i64; 3] {
    (p * 1_048_576.0).round().to_array().map(|x| x as i64)
}

/// `n` unit cubes an axis, numbered along x, then y, then z.
pub(super) fn grid(n: usize) -> HexMesh {
    box_of([n, n, n], |p| p, false)
}

/// A ring of `around` times 1 times `up` hexes about the z axis.
pub(super) fn o_grid(around: usize, up: usize) -> HexMesh {
    let turn = |p: Point| {
        let angle = p.x / around as f64 * std::f64::consts::TAU;
        Point::new((3.0 - p.y) * libm::cos(angle), (3.0 - p.y) * libm::sin(angle), p.z)
    };
    box_of([around, 1, up], turn, true)
}

fn box_of(n: [usize; 3], place: impl Fn(Point) -> Point, is_ring: bool) -> HexMesh {
    let [nx, ny, nz] = n;
    let sx = if is_ring { nx } else { nx + 1 };
    let positions = (0..sx * (ny + 1) * (nz + 1))
        .map(|m| [m % sx, m / sx % (ny + 1), m / sx / (ny + 1)])
        .map(|at| place(Point::from(at.map(|c| c as f64))));
    let hexes = (0..nx * ny * nz).map(|m| [m % nx, m / nx % ny, m / nx / ny]).map(|at| {
        CORNERS.map(|c| {
            let [x, y, z] = [0, 1, 2].map(|i| at[i] + usize::from(c[i]));
            NodeId::new(x % sx + sx * (y + (ny + 1) * z))
        })
    });
    HexMesh { positions: positions.collect(), hexes: hexes.collect(), ..HexMesh::default() }
}

/// The forest of level 1: every hex of `input` refined once, so that elements `8r..8r + 8` are the children of hex `r`.
pub(super) fn refined_once(input: &HexMesh) -> HexForest {
    let mut forest = HexForest::new(input);
    let all: Vec<u32> = (0..input.hexes.len() as u32).collect();
    forest.split_base(&all, &Silent).unwrap();
    forest.make(0, &Silent).unwrap();
    forest
}

/// Splits some elements, and makes their children.
pub(super) fn split(forest: &mut HexForest, depth: usize, marked: &[u32]) {
    forest.split(depth, marked, &Silent).unwrap();
    if !marked.is_empty() {
        forest.make(depth + 1, &Silent).unwrap();
    }
}
