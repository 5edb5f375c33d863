//! Sweeps of small solids.

use super::*;
use crate::Silent;
use crate::mesh::quality::hex_quality;
use crate::mesh::{PolygonMesh, check_hexes};
use crate::solid::testing::{cuboid, cylinder, holed, lathe, moved, solid, voxels};

/// Sweeps along z and checks what is promised.
fn checked(surface: &PolygonMesh, edge_length: f64) -> (SolidModel, HexMesh) {
    let solid = solid(surface);
    let sweep = Sweep::new(&solid, Point::Z * 3.0, &SweepOptions::new(edge_length), &Silent).unwrap();
    let mesh = sweep.mesh(&solid, &Silent).unwrap();
    assert_eq!(check_hexes(&mesh), []);
    let worst = hex_quality(&mesh).report().unwrap().scaled_jacobian.summary.min;
    assert!(worst > 0.1, "{worst}");
    (solid, mesh)
}

/// The heights at which nodes stand, ascending.
fn layers(mesh: &HexMesh) -> Vec<f64> {
    let mut heights: Vec<f64> = mesh.positions.iter().map(|p| p.z).collect();
    heights.sort_by(f64::total_cmp);
    heights.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    heights
}

/// Is there a node at this place?
fn has_node(mesh: &HexMesh, p: Point) -> bool {
    mesh.positions.iter().any(|q| q.distance(p) < 1e-9)
}

#[test]
fn a_box_becomes_a_grid() {
    let (_, mesh) = checked(&cuboid([4, 3, 2]), 0.5);
    assert_eq!(mesh.hexes.len(), 8 * 6 * 4);
    assert!(hex_quality(&mesh).report().unwrap().scaled_jacobian.summary.min > 0.999);
}

#[test]
fn a_hole_through_is_left_free() {
    let (solid, mesh) = checked(&holed(), 0.25);
    for hex in &mesh.hexes {
        let centre = hex.iter().map(|n| mesh.positions[n.index()]).sum::<Point>() / 8.0;
        assert!(solid.contains(centre), "{centre}");
    }
    for x in [0.0, 1.0, 2.0, 3.0] {
        assert!(has_node(&mesh, Point::new(x, 1.0, 2.0)));
    }
}

#[test]
fn a_cylinder_is_followed_by_its_rim() {
    let (_, mesh) = checked(&cylinder(96), 0.2);
    let off = |p: &Point| (p.x.hypot(p.y) - 1.0).abs();
    let on_rim = mesh.positions.iter().filter(|p| p.z == 2.0 && off(p) < 0.01).count();
    assert!(on_rim >= 30, "{on_rim}");
    assert!(hex_quality(&mesh).report().unwrap().scaled_jacobian.summary.min > 0.5);
}

#[test]
fn layers_stand_at_the_steps_of_a_cylinder_and_rims_inside_are_followed() {
    // From below: radius 1 up to 0.45, radius 0.5 up to 1.
    let stepped = lathe(&[[1.0, 0.0], [1.0, 0.45], [0.5, 0.45], [0.5, 1.0]], 96);
    let (_, mesh) = checked(&stepped, 0.1);
    let heights = layers(&mesh);
    assert!(heights.iter().any(|z| (z - 0.45).abs() < 1e-9), "{heights:?}");
    // Steps: 0.45 in four or five, 0.55 in five or six.
    assert!((10..=12).contains(&heights.len()), "{heights:?}");
    let inner = mesh.positions.iter().filter(|p| p.z == 0.0 && (p.x.hypot(p.y) - 0.5).abs() < 0.002).count();
    assert!(inner >= 24, "{inner}");
    // Above the step what is farther outside than two edges is left out.
    let reach = mesh.positions.iter().filter(|p| p.z > 0.9).map(|p| p.x.hypot(p.y)).fold(0.0, f64::max);
    assert!(reach > 0.6 && reach < 0.85, "{reach}");
}

#[test]
fn levels_that_are_close_are_one() {
    let stepped = lathe(&[[1.0, 0.0], [1.0, 0.5], [0.9, 0.51], [0.6, 0.51], [0.6, 1.0]], 48);
    assert_eq!(levels(&solid(&stepped), Point::Z, 0.2, 1.0).len(), 3);
    assert_eq!(levels(&solid(&stepped), Point::Z, 0.02, 1.0).len(), 4);
}

/// A plate a tenth of an edge thick with a block on it.
#[test]
fn levels_of_thin_plates_are_told_apart_where_that_is_wanted() {
    let plate = moved(voxels([3, 3, 2], |[x, y, z]| z == 0 || x == 1 && y == 1), |p| {
        p.with_z([0.0, 0.1, 3.0][p.z as usize])
    });
    let heights = |tolerance| levels(&solid(&plate), Point::Z, 1.0, tolerance);
    assert_eq!([heights(1.0), heights(0.25)], [vec![0.0, 3.0], vec![0.0, 0.1, 3.0]]);
}

#[test]
fn what_cannot_be_swept_is_refused() {
    let solid = solid(&cuboid([1, 1, 1]));
    let code = |direction, edge_length| {
        Sweep::new(&solid, direction, &SweepOptions::new(edge_length), &Silent).unwrap_err().code()
    };
    assert_eq!(code(Point::ZERO, 0.1), "no-direction");
    assert_eq!(code(Point::Z, -1.0), "edge-length-out-of-range");
    for edge_length in [0.002, 1e-4, 1e-10] {
        assert_eq!(code(Point::Z, edge_length), "too-many-hexes");
    }
}

#[test]
fn steps_are_off_the_edge_length_by_the_least_factor() {
    let steps = |gap: f64| heights(&[0.0, gap], 1.0).len() - 1;
    assert_eq!([0.3, 1.4, 1.45, 2.4, 2.5 - 1e-12, 3.48].map(steps), [1, 1, 2, 2, 3, 3]);
}
