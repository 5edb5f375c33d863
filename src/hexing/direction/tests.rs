use glam::DQuat;

use super::*;
use crate::geometry::Point;
use crate::mesh::PolygonMesh;
use crate::solid::testing::{cuboid, cylinder, ell, solid};

fn moved(mut surface: PolygonMesh, turn: DQuat, scale: f64, by: Point) -> PolygonMesh {
    surface.positions.iter_mut().for_each(|p| *p = turn * *p * scale + by);
    surface
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
            let found = axes(&moved(surface, turn, scale, Point::new(30.0, -7.0, 1.0) * scale));
            for (axis, world) in found.iter().zip([Point::X, Point::Y, Point::Z]) {
                assert!(axis.distance(turn * world) < 1e-9, "{axis} is not {}", turn * world);
            }
        }
        let [_, _, z] = axes(&moved(cylinder(24), turn, scale, Point::ZERO));
        assert!(z.distance(turn * Point::Z) < 1e-9);
    }
}
