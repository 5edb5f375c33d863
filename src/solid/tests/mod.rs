mod bad;
mod bodies;
mod features;
#[cfg(not(target_arch = "wasm32"))]
mod motions;

use super::testing::{cuboid, cylinder, ell, holed, solid, voxels};
use super::*;
use crate::Silent;
use crate::geometry::Point;
use crate::mesh::{NodeId, PolygonMesh};

/// Corners, curves, surfaces, Euler number.
#[track_caller]
fn check_counts(surface: &PolygonMesh, expected: (usize, usize, usize, i64)) -> SolidModel {
    let solid = solid(surface);
    check_graph(&solid);
    let counts = (solid.corners().len(), solid.curves().len(), solid.surfaces().len(), solid.euler_number());
    assert_eq!(counts, expected);
    solid
}

/// The angles of the triangles at a vertex, in radians.
fn angle_around(solid: &SolidModel, vertex: u32) -> f64 {
    let of_triangle = |t: usize| {
        let k = solid.triangles()[t].iter().position(|&v| v == vertex)?;
        let [at, a, b] = [k, k + 1, k + 2].map(|k| solid.corners_of(t)[k % 3]);
        Some((a - at).angle_between(b - at))
    };
    (0..solid.triangles().len()).filter_map(of_triangle).sum()
}

/// What holds in every model.
#[track_caller]
fn check_graph(solid: &SolidModel) {
    let mut arms: Vec<(CurveId, bool, CornerId)> = Vec::new();
    for (c, corner) in solid.corners().iter().enumerate() {
        assert_eq!(solid.points()[corner.vertex as usize], corner.point);
        arms.extend(corner.arms.iter().map(|arm| (arm.curve, arm.at_start, CornerId::new(c))));
        let sectors: f64 = corner.arms.iter().map(|arm| arm.sector).sum();
        assert!((sectors - angle_around(solid, corner.vertex)).abs() < 1e-9, "sectors of corner {c}");
        // Between two arms, counter-clockwise, lies one surface: left of what leaves, right of what comes next.
        for (a, b) in corner.arms.iter().zip(corner.arms.iter().cycle().skip(1)) {
            let left = solid.curves()[a.curve.index()].sides[usize::from(!a.at_start)];
            let right = solid.curves()[b.curve.index()].sides[usize::from(b.at_start)];
            assert_eq!(left, right, "sectors of corner {c}");
        }
    }
    arms.sort_unstable();
    let ends = solid.curves().iter().enumerate().filter_map(|(c, curve)| Some((c, curve.ends?)));
    let expected: Vec<_> =
        ends.flat_map(|(c, [a, b])| [(CurveId::new(c), false, b), (CurveId::new(c), true, a)]).collect();
    assert_eq!(arms, expected, "each end of a curve is one arm");
    for curve in solid.curves() {
        let at = |v: u32| solid.points()[v as usize];
        let length: f64 = curve.vertices.windows(2).map(|w| at(w[0]).distance(at(w[1]))).sum();
        assert!((length - curve.length).abs() < 1e-12 * length);
        assert!(curve.ends.is_some() || curve.vertices.first() == curve.vertices.last());
    }
    for (s, surface) in solid.surfaces().iter().enumerate() {
        assert!(surface.triangles.iter().all(|&t| solid.surface_of(t as usize) == SurfaceId::new(s)));
    }
    let triangles: usize = solid.surfaces().iter().map(|s| s.triangles.len()).sum();
    assert_eq!(triangles, solid.triangles().len());
}

#[test]
fn prisms_have_the_features_that_one_sees() {
    let cube = check_counts(&cuboid([2, 3, 4]), (8, 12, 6, 2));
    assert!(cube.curves().iter().all(|c| (c.interior_angle - 90.0).abs() < 1e-9 && c.is_straight));
    assert_eq!(cube.surfaces().iter().map(|s| s.area).sum::<f64>(), 52.0);
    let ell = check_counts(&ell(), (12, 18, 8, 2));
    let angles: Vec<f64> = ell.curves().iter().map(|c| c.interior_angle.round()).collect();
    assert_eq!(angles.iter().filter(|&&a| a == 270.0).count(), 1, "{angles:?}");
    let sectors =
        ell.corners().iter().flat_map(|corner| &corner.arms).map(|arm| arm.sector.to_degrees().round());
    let sectors: Vec<f64> = sectors.collect();
    assert_eq!([90.0, 270.0].map(|a| sectors.iter().filter(|&&sector| sector == a).count()), [34, 2]);
    check_counts(&holed(), (16, 24, 10, 0));
    let round = check_counts(&cylinder(24), (0, 2, 3, 2));
    assert!(round.curves().iter().all(|c| c.ends.is_none() && !c.is_straight));
    let SurfaceClass::Cylindrical { axis } = round.surfaces()[2].class else { panic!("the mantle") };
    assert!(axis.z.abs() > 1.0 - 1e-12);
    assert_eq!(round.surfaces()[1].class, SurfaceClass::Planar { normal: Point::Z });
    check_counts(&cylinder(6), (12, 18, 8, 2));
}

/// The solid inside a surface with other options than the usual, and what is said of it.
#[track_caller]
fn made(surface: &PolygonMesh, options: &SolidOptions) -> (SolidModel, SolidReport) {
    let made = SolidModel::new(surface, options, &Silent).unwrap_or_else(|error| panic!("{error}"));
    check_graph(&made.0);
    made
}

#[test]
fn faces_are_turned_outward() {
    let mut inside_out = PolygonMesh { positions: holed().positions, ..PolygonMesh::default() };
    for (f, face) in holed().faces().enumerate() {
        let nodes: Vec<NodeId> = face.to_vec();
        if f % 3 == 0 { inside_out.push_face(nodes) } else { inside_out.push_face(nodes.into_iter().rev()) }
    }
    let (turned, report) = SolidModel::new(&inside_out, &SolidOptions::default(), &Silent).unwrap();
    assert_eq!(turned.triangles().len(), report.triangles);
    assert!(report.turned_triangles > 0);
    let right = solid(&holed());
    assert!(turned.contains(Point::splat(0.5)) && right.contains(Point::splat(0.5)));
    assert_eq!(turned.surfaces().len(), right.surfaces().len());
}

#[test]
fn distances_have_the_right_sign_beside_edges_and_corners() {
    type Full = fn([i32; 3]) -> bool;
    let worlds: [([i32; 3], Full); 3] = [
        ([3, 3, 2], |[x, y, _]| (x, y) != (1, 1)),
        ([2, 2, 2], |[x, y, z]| x * y * z == 0),
        ([2, 2, 2], |[x, y, z]| x + y + z == 0 || [x, y, z] == [1, 0, 0] || [x, y, z] == [0, 1, 0]),
    ];
    for (size, full) in worlds {
        let solid = solid(&voxels(size, full));
        let steps = |n: i32| (-3..4 * n + 3).map(|i| (f64::from(i) + 0.5) / 4.0);
        for x in steps(size[0]) {
            for y in steps(size[1]) {
                for z in steps(size[2]) {
                    let p = Point::new(x, y, z);
                    let cell = [x, y, z].map(|c| c.floor() as i32);
                    let inside = (0..3).all(|a| (0..size[a]).contains(&cell[a])) && full(cell);
                    assert_eq!(solid.contains(p), inside, "at {p}");
                    assert_eq!(solid.nearest(p).distance, solid.signed_distance(p).abs());
                    assert_eq!(solid.nearest(p).distance, solid.distance(p));
                }
            }
        }
    }
}

#[test]
fn curves_and_surfaces_have_nearest_points_of_their_own() {
    let cube = solid(&cuboid([2, 2, 2]));
    let p = Point::new(0.5, 0.25, 3.0);
    for (s, surface) in cube.surfaces().iter().enumerate() {
        let foot = cube.nearest_on_surface(SurfaceId::new(s), p);
        let SurfaceClass::Planar { normal } = surface.class else { panic!("a plane") };
        assert_eq!(foot.normal, normal);
        assert_eq!(cube.surface_of(foot.triangle as usize), SurfaceId::new(s));
        let clamped = p.clamp(surface.bounds.min, surface.bounds.max);
        assert!((foot.point - clamped).length() < 1e-15 && foot.distance == foot.point.distance(p));
    }
    for (c, curve) in cube.curves().iter().enumerate() {
        let foot = cube.nearest_on_curve(CurveId::new(c), p);
        let [a, b] = [curve.vertices[0], curve.vertices[2]].map(|v| cube.points()[v as usize]);
        assert!((foot.point - (a + foot.tangent * foot.at)).length() < 1e-15);
        assert_eq!(foot.tangent, (b - a) / 2.0);
        assert!((cube.point_on_curve(CurveId::new(c), foot.at) - foot.point).length() < 1e-15);
        assert_eq!([-1.0, 0.0, 2.0, 3.0].map(|at| cube.point_on_curve(CurveId::new(c), at)), [a, a, b, b]);
        assert!((foot.point - p.clamp(a.min(b), a.max(b))).length() < 1e-15);
    }
}
