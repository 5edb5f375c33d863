//! Features that the file marks, and noise.

use super::super::testing::{both, moved};
use super::made;
use super::*;
use crate::mesh::{TagSet, Tags};

#[test]
fn borders_of_groups_are_features() {
    let mut surface = cuboid([2, 1, 1]);
    let group =
        |x: f64| TagSet { groups: vec![if x < 1.0 { "low" } else { "high" }.into()], ..TagSet::default() };
    let x_of = |face: &[NodeId]| face.iter().map(|n| surface.positions[n.index()].x).sum::<f64>() / 4.0;
    let of_element = surface.faces().map(|face| u32::from(x_of(face) > 1.0)).collect();
    surface.tags = Tags { sets: vec![group(0.0), group(1.0)], of_element };
    let solid = check_counts(&surface, (12, 20, 10, 2));
    assert_eq!(solid.curves().iter().filter(|c| (c.interior_angle - 180.0).abs() < 1e-9).count(), 4);
    let options = SolidOptions { tags: false, ..SolidOptions::default() };
    assert_eq!(made(&surface, &options).1.curves, 12);
}

/// Of a surface that several of the file's sets share, what these have in common.
#[test]
fn surfaces_have_the_names_that_the_file_has_for_all_of_them() {
    let mut surface = cuboid([2, 1, 1]);
    assert_eq!(made(&surface, &SolidOptions::default()).1.surface_groups, Vec::<Vec<String>>::new());
    let set = |name: &str| TagSet {
        object: Some("part".into()),
        groups: vec![name.into(), "wall".into()],
        material: Some("steel".into()),
        number: None,
    };
    let x_of = |face: &[NodeId]| face.iter().map(|n| surface.positions[n.index()].x).sum::<f64>() / 4.0;
    let of_element = surface.faces().map(|face| u32::from(x_of(face) > 1.0)).collect();
    surface.tags = Tags { sets: vec![set("low"), set("high")], of_element };
    let named = |tags: bool| {
        let (solid, report) = made(&surface, &SolidOptions { tags, ..SolidOptions::default() });
        let middles = solid.surfaces().iter().map(|s| s.bounds.center().x);
        middles.zip(report.surface_groups).collect::<Vec<(f64, Vec<String>)>>()
    };
    let apart = named(true);
    assert_eq!(apart.len(), 10);
    for (x, names) in apart {
        let own = if x < 1.0 { "low" } else { "high" };
        assert_eq!(names, [own, "wall", "object:part", "material:steel"]);
    }
    let whole = named(false);
    assert_eq!(whole.len(), 6);
    for (x, names) in whole {
        let own = [(0.0, "low"), (2.0, "high")].into_iter().find(|(end, _)| *end == x);
        let expected: Vec<&str> =
            own.map(|(_, name)| name).into_iter().chain(["wall", "object:part", "material:steel"]).collect();
        assert_eq!(names, expected);
    }
}

#[test]
fn polylines_are_features_and_no_noise() {
    let mut surface = cuboid([4, 4, 4]);
    let node =
        |p: [f64; 3]| NodeId::new(surface.positions.iter().position(|q| *q == Point::from(p)).unwrap());
    surface.features.polylines = vec![
        [[1., 1., 4.], [2., 1., 4.], [2., 2., 4.]].map(node).to_vec(),
        vec![node([0., 0., 0.]), node([4., 4., 4.])],
    ];
    let options = SolidOptions { edge_length: Some(2.5), ..SolidOptions::default() };
    let (solid, report) = made(&surface, &options);
    // The turn of 90 degrees is a corner.
    assert_eq!((report.corners, report.curves, report.surfaces, report.unmatched_edges), (11, 14, 6, 1));
    let within: Vec<&Curve> = solid.curves().iter().filter(|c| c.sides[0] == c.sides[1]).collect();
    assert_eq!(within.len(), 2);
    assert!(within.iter().all(|c| c.length == 1.0 && c.is_straight));
}

#[test]
fn small_bumps_are_noise_to_coarse_meshes() {
    let bump = moved(cuboid([8, 8, 8]), |p| if p == Point::new(4., 4., 8.) { p + Point::Z } else { p });
    let with = |edge_length| made(&bump, &SolidOptions { edge_length, ..SolidOptions::default() }).1;
    let raw = with(None);
    assert!(raw.curves > 12 && raw.noise_edges == 0);
    assert_eq!(with(Some(1.0)).curves, raw.curves);
    let coarse = with(Some(8.0));
    assert_eq!((coarse.corners, coarse.curves, coarse.surfaces), (8, 12, 6));
    assert!(coarse.noise_edges >= 8);
}

#[test]
fn creases_that_fade_are_noise_to_coarse_meshes() {
    // A roof along x that becomes flat, so that its ridge ends within the top.
    let roof = |p: Point| (1.0 - p.x / 4.0).max(0.0) * (4.0 - (p.y - 4.0).abs()) * 0.5;
    let faded = moved(cuboid([8, 8, 8]), |p| if p.z == 8.0 { p + Point::Z * roof(p) } else { p });
    let ends = |edge_length| {
        let (solid, _) = made(&faded, &SolidOptions { edge_length, ..SolidOptions::default() });
        let dangling: Vec<f64> =
            solid.corners().iter().filter(|c| c.arms.len() == 1).map(|c| c.point.x).collect();
        let ridge = solid.curves().iter().find(|c| c.sides[0] == c.sides[1]).map(|c| c.length);
        (dangling, ridge)
    };
    let (dangling, ridge) = ends(None);
    let length = ridge.expect("a ridge");
    assert_eq!(dangling.len(), 1);
    assert!(dangling[0] > 0.0 && dangling[0] < 4.0);
    assert_eq!(ends(Some(length * 0.9)), (dangling, ridge));
    assert_eq!(ends(Some(length * 1.1)), (vec![], None));
}

#[test]
fn classes_do_not_depend_on_how_finely_a_surface_is_cut() {
    for n in [12, 37, 200] {
        let solid = solid(&cylinder(n));
        assert!(
            matches!(solid.surfaces()[2].class, SurfaceClass::Cylindrical { axis } if axis.z.abs() > 0.999_999)
        );
    }
    let cone = moved(cylinder(48), |p| if p.z > 1.0 { Point::new(p.x * 0.5, p.y * 0.5, p.z) } else { p });
    let cone = solid(&cone);
    let mantle = cone.surfaces().iter().max_by(|a, b| a.area.total_cmp(&b.area)).unwrap();
    assert_eq!(mantle.class, SurfaceClass::General);
}

#[test]
fn free_forms_have_no_planes_and_no_curves_that_somebody_drew() {
    // A cube of many quads, blown up to a ball.
    let ball = moved(cuboid([8, 8, 8]), |p| (p - Point::splat(4.0)).normalize());
    assert!(solid(&ball).is_free_form());
    assert!(!solid(&cuboid([2, 2, 2])).is_free_form() && !solid(&cylinder(48)).is_free_form());
    // A third of the surface of half a ball is a plane.
    let cut = moved(ball.clone(), |p| p.with_z(p.z.max(0.0)));
    assert!(!solid(&cut).is_free_form());
    let mut drawn = ball.clone();
    let edge: Vec<NodeId> = drawn.face(0)[..2].to_vec();
    drawn.features.polylines = vec![edge];
    assert!(!solid(&drawn).is_free_form());
    // Bodies are asked each for itself.
    let pair = solid(&both(drawn, &moved(ball, |p| p + Point::X * 4.0)));
    assert_eq!([0, 1].map(|body| pair.body(body, &Silent).unwrap().is_free_form()), [false, true]);
    assert!(!pair.is_free_form());
}

/// A lens has no plane, and its rim is no crease of a scan where it is sharp.
#[test]
fn of_a_free_form_sharp_curves_are_drawn() {
    let ball = moved(cuboid([8, 8, 8]), |p| (p - Point::splat(4.0)).normalize());
    for (height, is_drawn) in [(0.3, true), (1.2, false)] {
        // Both halves are bent towards each other at the equator.
        let lens = moved(ball.clone(), |p| p.with_z(p.z.signum() * height * (1.0 - p.x.hypot(p.y)).max(0.0)));
        let lens = solid(&lens);
        assert!(lens.is_free_form());
        let rim = lens.curves().iter().position(|curve| curve.length > 5.0).expect("a rim");
        assert_eq!(lens.is_drawn(CurveId::new(rim)), is_drawn, "{:?}", lens.curves()[rim]);
    }
    // All curves of other solids are.
    let cube = solid(&cuboid([2, 2, 2]));
    assert!((0..12).all(|curve| cube.is_drawn(CurveId::new(curve))));
}

#[test]
fn creases_go_on_where_they_fade_for_a_short_way() {
    // The top of a plate bends by 39 degrees at y = 8, but for some of its length, where it begins to a little before.
    let bent = |faded: f64| {
        moved(cuboid([90, 16, 1]), |p| {
            let early = if p.y == 8.0 && (p.x - 45.0).abs() < faded { 0.15 } else { 0.0 };
            p.with_z(p.z * (20.0 + early + 0.8 * (p.y - 8.0).max(0.0)))
        })
    };
    let ends = |faded: f64| {
        let (solid, _) = made(&bent(faded), &SolidOptions::default());
        solid.corners().iter().filter(|corner| corner.arms.len() == 1).count()
    };
    assert_eq!([ends(0.5), ends(3.5)], [0, 2]);
}
