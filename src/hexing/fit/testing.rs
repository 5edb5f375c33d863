//! A house for tests, with a ridge that is no feature.

use super::super::correspondence::{Anchor, Correspondence};
use super::holds::Hold;
use super::survey::Survey;
use crate::Silent;
use crate::geometry::Point;
use crate::mesh::{GridOptions, HexMesh, NodeId, PolygonMesh, hex_grid};
use crate::solid::{SolidModel, SolidOptions};

/// How much the roof of a house of 2 by 2 rises from its eaves to the ridge: less than a feature.
pub(super) const RISE: f64 = 0.25;

/// So many cells along the house, and pieces of the ridge.
const ROWS: u32 = 5;

/// A house, and a mesh of cubes whose roof is straight. Each point of the ridge is so far from the middle, to one side and the
/// other in turn; the mesh has no node near that.
pub(in super::super) fn house(aside: f64) -> (SolidModel, HexMesh) {
    let mut surface = PolygonMesh::default();
    for k in 0..=ROWS {
        let ridge = 1.0 + if k % 2 == 0 { aside } else { -aside };
        let profile = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.5], [ridge, 1.5 + RISE], [0.0, 1.5]];
        let y = 2.0 * f64::from(k) / f64::from(ROWS);
        surface.positions.extend(profile.map(|[x, z]| Point::new(x, y, z)));
    }
    let last = 5 * ROWS;
    surface.push_face([0, 1, 2, 3, 4].map(NodeId));
    surface.push_face([4, 3, 2, 1, 0].map(|n| NodeId(last + n)));
    for (row, side) in (0..ROWS).flat_map(|row| (0..5).map(move |side| (5 * row, side))) {
        let next = (side + 1) % 5;
        surface.push_face([row + next, row + side, row + 5 + side, row + 5 + next].map(NodeId));
    }
    let options = SolidOptions { feature_angle: 50.0, ..SolidOptions::default() };
    let solid = SolidModel::new(&surface, &options, &Silent).expect("it bounds a solid").0;
    let options = GridOptions { spacing: 0.4, margin: 0.0, fitted: true, max_hexes: 1000 };
    let mut mesh = hex_grid(solid.bounds(), &options).unwrap();
    let top = 1.5 + RISE;
    mesh.positions.iter_mut().for_each(|p| p.z *= (top - RISE * (p.x - 1.0).abs()) / top);
    (solid, mesh)
}

/// Every boundary node where it belongs.
pub(super) fn held(on: &Correspondence) -> Vec<Hold> {
    let hold = |anchor: &Anchor| if *anchor == Anchor::Inside { Hold::Free } else { Hold::Held };
    on.anchors.iter().map(hold).collect()
}

/// How far mesh and solid are from each other.
pub(super) fn farthest(mesh: &HexMesh, on: &Correspondence, solid: &SolidModel) -> f64 {
    let mut survey = Survey::new(mesh, &on.faces, solid);
    survey.renew(mesh, &Silent).unwrap();
    survey.distances.iter().copied().fold(0.0, f64::max)
}
