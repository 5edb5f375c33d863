//! Solids of real models: what features they have, and which side of them is inside.

use std::path::Path;

use hexmill::Silent;
use hexmill::geometry::Point;
use hexmill::hexing::direction::{best_frame, principal_directions};
use hexmill::io::obj;
use hexmill::mesh::PolygonMesh;
use hexmill::solid::{SolidModel, SolidOptions, SolidReport};

fn surface(name: &str) -> PolygonMesh {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models/solids").join(name);
    obj::read(&std::fs::read(path).unwrap()).unwrap().into_surface().unwrap()
}

#[track_caller]
fn made(name: &str, options: &SolidOptions) -> (SolidModel, SolidReport) {
    SolidModel::new(&surface(name), options, &Silent).unwrap_or_else(|error| panic!("{error}"))
}

/// The report of a model that needs no mending, with the usual options.
#[track_caller]
fn check_counts(name: &str, corners: usize, curves: usize, surfaces: usize, euler: i64) -> SolidModel {
    let (solid, report) = made(name, &SolidOptions::default());
    let (points, triangles) = (solid.points().len(), solid.triangles().len());
    let expected = SolidReport {
        points,
        triangles,
        bodies: 1,
        corners,
        curves,
        surfaces,
        euler,
        ..SolidReport::default()
    };
    assert_eq!(report, expected);
    solid
}

#[test]
fn models_have_their_features_and_genus() {
    check_counts("MFCAD_3-3-3-3-3-23.obj", 126, 188, 56, -16);
    check_counts("spot.obj", 80, 47, 1, 2);
    let plate = check_counts("nist_ctc_01_asme1_ap242-e1.obj", 59, 103, 40, -18);
    let frame = best_frame(&plate);
    assert_eq!(frame.world(Point::X) - frame.origin(), Point::X, "it is aligned");
    let scores = principal_directions(&plate, &Silent).unwrap();
    assert!(scores[0].direction.z > 0.999_999, "a plate is swept along its thickness: {scores:?}");
}

#[test]
fn noise_goes_where_an_edge_length_is_given() {
    for (name, counts) in [("bunny.obj", [(394, 295), (231, 203)]), ("spot.obj", [(80, 47), (62, 38)])] {
        let (_, raw) = made(name, &SolidOptions::default());
        let size = surface(name).bounds().size().max_element();
        let options = SolidOptions { edge_length: Some(size / 48.0), ..SolidOptions::default() };
        let (solid, filtered) = made(name, &options);
        assert_eq!([&raw, &filtered].map(|r| (r.corners, r.curves)), counts, "{name}");
        assert!(raw.noise_edges == 0 && filtered.noise_edges > 0);
        let is_loose = |c: &hexmill::solid::Corner| c.arms.len() == 1;
        for corner in solid.corners().iter().filter(|c| is_loose(c)) {
            let curve = &solid.curves()[corner.arms[0].curve.index()];
            let ends = curve.ends.expect("a loose end is a corner");
            let is_whole = ends.iter().all(|c| solid.corners()[c.index()].arms.len() != 2);
            assert!(!is_whole || curve.length >= size / 48.0, "a crease of {} on {name}", curve.length);
        }
    }
}

/// How often the surface goes around `p`: 1 inside, 0 outside (van Oosterom and Strackee's solid angles).
fn winding(solid: &SolidModel, p: Point) -> f64 {
    let angle = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| solid.points()[v as usize] - p);
        let (x, y, z) = (a.length(), b.length(), c.length());
        a.dot(b.cross(c)).atan2(x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y)
    };
    solid.triangles().iter().map(angle).sum::<f64>() / std::f64::consts::TAU
}

#[test]
fn signs_agree_with_the_winding_number() {
    for name in ["MFCAD_3-3-3-3-3-23.obj", "bunny.obj"] {
        let (solid, _) = made(name, &SolidOptions::default());
        let reach = solid.diagonal() * 0.02;
        // Beside vertices, where the nearest point is most often one, or on an edge.
        for (i, &v) in solid.points().iter().enumerate().step_by(9) {
            let away = Point::from([2, 3, 5].map(|k| ((i * k * 7919) % 1009) as f64 / 504.5 - 1.0));
            let p = v + away * reach;
            assert_eq!(solid.contains(p), winding(&solid, p) > 0.5, "{name} at {p}");
        }
    }
}
