use glam::DQuat;

use super::*;
use crate::Silent;
use crate::geometry::Point;
use crate::mesh::PolygonMesh;
use crate::solid::testing::{cuboid, cylinder, ell, holed, moved, solid};

fn turned(surface: PolygonMesh, turn: DQuat, scale: f64, by: Point) -> PolygonMesh {
    moved(surface, |p| turn * p * scale + by)
}

fn axes(surface: &PolygonMesh) -> [Point; 3] {
    let solid = solid(surface);
    let (frame, size) = (best_frame(&solid), solid.diagonal());
    [Point::X, Point::Y, Point::Z].map(|axis| (frame.world(axis * size) - frame.origin()) / size)
}

#[test]
fn aligned_solids_keep_the_axes_of_the_world() {
    for surface in [cuboid([2, 3, 4]), ell(), cylinder(24), cylinder(5)] {
        for (axis, world) in axes(&surface).iter().zip([Point::X, Point::Y, Point::Z]) {
            assert!(axis.distance(world) < 1e-15, "{axis} is not {world}");
        }
    }
}

#[test]
fn turned_solids_turn_their_axes_at_any_scale() {
    let turn = DQuat::from_xyzw(0.1, -0.15, 0.2, 0.9).normalize();
    for scale in [1e-6, 1.0, 1e6] {
        for surface in [cuboid([2, 3, 4]), ell()] {
            let found = axes(&turned(surface, turn, scale, Point::new(30.0, -7.0, 1.0) * scale));
            for (axis, world) in found.iter().zip([Point::X, Point::Y, Point::Z]) {
                assert!(axis.distance(turn * world) < 1e-9, "{axis} is not {}", turn * world);
            }
        }
        let [_, _, z] = axes(&turned(cylinder(24), turn, scale, Point::ZERO));
        assert!(z.distance(turn * Point::Z) < 1e-9);
    }
}

#[test]
fn prisms_are_swept_along_their_length() {
    for (surface, along) in [(ell(), Point::Z), (holed(), Point::Z), (cylinder(48), Point::Z)] {
        let scores = principal_directions(&solid(&surface), &Silent).unwrap();
        let best = scores[0];
        assert!(best.direction.distance(along) < 1e-12, "{scores:?}");
        assert!((best.surface_capture - 1.0).abs() < 1e-12 && best.volume_capture > 0.99, "{best:?}");
        // Equation 4.4 at full capture.
        assert!((best.score - (0.85 + 0.15 * best.volume_capture)).abs() < 1e-12);
        assert!(
            scores.iter().skip(1).all(|s| s.score < best.score && (0.0..=1.0).contains(&s.volume_capture))
        );
    }
    // Along x an L of three cubes fills its box of four: swept it is 4 for 3.
    let scores = principal_directions(&solid(&ell()), &Silent).unwrap();
    let along_x = scores.iter().find(|s| s.direction.x > 0.99).unwrap();
    assert!((along_x.volume_capture - 2.0 / 3.0).abs() < 0.01, "{along_x:?}");
}

#[test]
fn shadows_are_as_large_as_they_are() {
    let cube = solid(&cuboid([1, 1, 1]));
    let askew = Point::ONE.normalize();
    let shadow = silhouette::shadow(&cube, askew);
    assert!((shadow.area / 3.0_f64.sqrt() - 1.0).abs() < 0.004, "{shadow:?}");
    assert!((shadow.depth - 3.0_f64.sqrt()).abs() < 1e-12);
    let ring = silhouette::shadow(&solid(&holed()), Point::Z);
    assert!((ring.area / 8.0 - 1.0).abs() < 0.004, "the hole throws none: {ring:?}");
}
