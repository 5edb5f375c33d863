//! Several bodies, and voids.

use super::super::testing::{both, moved, turned, voxels};
use super::made;
use super::*;

#[test]
fn bodies_can_be_had_one_by_one() {
    let (solid, report) = made(&voxels([4, 1, 1], |[x, ..]| x != 1), &SolidOptions::default());
    assert_eq!((report.bodies, report.voids, solid.body_count()), (2, 0, 2));
    assert_eq!(solid.surfaces().iter().filter(|s| s.body == 1).count(), 6);
    for (body, volume) in [(0, 1.0), (1, 2.0)] {
        let alone = solid.body(body, &Silent).unwrap();
        check_graph(&alone);
        assert_eq!((alone.volume(), alone.corners().len(), alone.body_count()), (volume, 8, 1));
        assert_eq!(alone.contains(Point::new(0.5, 0.5, 0.5)), body == 0);
        let of_body = |s: SurfaceId| solid.surfaces()[s.index()].body == body;
        let curves: Vec<_> = solid.curves().iter().filter(|curve| of_body(curve.sides[0])).collect();
        let place = |solid: &SolidModel, curve: &Curve| solid.points()[curve.vertices[0] as usize];
        assert!(alone.curves().iter().zip(curves).all(|(a, b)| place(&alone, a) == place(&solid, b)));
    }
}

#[test]
fn a_shell_within_a_shell_is_a_void_whichever_way_it_is_turned() {
    let hollow = voxels([3, 3, 3], |c| c != [1, 1, 1]);
    let cube = moved(cuboid([1, 1, 1]), |p| p + 1.0);
    for surface in [
        hollow,
        both(cuboid([3, 3, 3]), &cube),
        both(turned(&cuboid([3, 3, 3])), &cube),
        both(cube, &cuboid([3, 3, 3])),
    ] {
        let (solid, report) = made(&surface, &SolidOptions::default());
        assert_eq!((report.bodies, report.voids, report.euler), (1, 1, 4));
        assert!((solid.volume() - 26.0).abs() < 1e-12);
        assert_eq!(solid.signed_distance(Point::splat(1.5)), 0.5);
        assert!(solid.contains(Point::splat(0.5)));
    }
}

#[test]
fn a_body_within_a_void_is_a_body() {
    let shell = |[x, y, z]: [i32; 3]| (x - 3).abs().max((y - 3).abs()).max((z - 3).abs());
    let (solid, report) = made(
        &voxels([7, 7, 7], |c| shell(c) == 3 || shell(c) == 1 && c != [3, 3, 3]),
        &SolidOptions::default(),
    );
    assert_eq!((report.bodies, report.voids), (2, 2));
    let volumes = [0, 1].map(|b| solid.body(b, &Silent).unwrap().volume());
    assert!((volumes[0] - 218.0).abs() < 1e-9 && (volumes[1] - 26.0).abs() < 1e-9, "{volumes:?}");
    assert_eq!(solid.body(1, &Silent).unwrap().euler_number(), 4, "with its void");
}
