//! Wherever a solid is, however large and however turned, its mesh is the same.

use glam::DQuat;
use hexmill::Silent;
use hexmill::geometry::Point;
use hexmill::hexing::{HexedSolid, HexingOptions, hex_solid};
use hexmill::mesh::{NodeId, PolygonMesh};

use super::parts::assert_sound;

/// A block of 4 x 3 x 2 with a step, of 3 x 1 on top.
pub(super) fn step() -> PolygonMesh {
    let outline = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let mut mesh = PolygonMesh::default();
    for y in [0.0, 3.0] {
        mesh.positions.extend(outline.iter().map(|&[x, z]| Point::new(x, y, z)));
    }
    mesh.push_face((0..6).map(NodeId));
    mesh.push_face((6..12).rev().map(NodeId));
    for i in 0..6 {
        let j = (i + 1) % 6;
        mesh.push_face([i, i + 6, j + 6, j].map(NodeId));
    }
    mesh
}

/// Meshes the step after a motion.
fn moved(place: impl Fn(Point) -> Point, edge_length: f64) -> HexedSolid {
    let mut surface = step();
    surface.positions.iter_mut().for_each(|p| *p = place(*p));
    let options = HexingOptions { edge_length, ..HexingOptions::default() };
    hex_solid(&surface, &options, &Silent).expect("a mesh")
}

#[test]
fn a_mesh_does_not_depend_on_size_and_place() {
    let as_it_is = moved(|p| p, 0.35);
    assert_eq!(as_it_is.report.result().euler, 2);
    for (scale, shift) in [(1e-6, 0.0), (1e6, 0.0), (1.0, 1e5), (1e-6, 1.0)] {
        let hexed = moved(|p| p * scale + shift, 0.35 * scale);
        assert_eq!(hexed.mesh.hexes, as_it_is.mesh.hexes, "{scale} {shift}");
        assert_sound(&hexed, &format!("{scale} {shift}"));
        assert!((hexed.report.result().worst - as_it_is.report.result().worst).abs() < 1e-3);
    }
}

#[test]
fn a_turned_solid_has_the_mesh_turned() {
    let count = moved(|p| p, 0.35).mesh.hexes.len();
    for (axis, angle) in [(Point::X, 0.3), (Point::new(1.0, 2.0, -1.0), 1.1), (Point::Z, 2.5)] {
        let turn = DQuat::from_axis_angle(axis.normalize(), angle);
        let hexed = moved(|p| turn * p, 0.35);
        assert_eq!((hexed.mesh.hexes.len(), hexed.report.result().euler), (count, 2), "{axis} {angle}");
        assert_sound(&hexed, &format!("{axis} {angle}"));
        assert!(hexed.report.result().worst > 0.99);
    }
}
