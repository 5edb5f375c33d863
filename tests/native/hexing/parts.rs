//! Random parts: whatever comes in, the mesh is valid.

use hexmill::hexing::{AttemptReport, Background, HexedSolid, HexingOptions, hex_solid};
use hexmill::mesh::quality::{Certainty, aspect, is_positive, scaled_jacobian};
use hexmill::mesh::topology::{HexTopology, hex_report};
use hexmill::mesh::{NodeId, PolygonMesh, check_hexes};
use hexmill::{Silent, geometry::Point};

use super::csg::random_part;

/// Meshes a part with edges of a share of its longest side.
pub(super) fn hexed(part: &PolygonMesh, share: f64) -> HexedSolid {
    let bounds = part.bounds();
    let edge_length = share * (bounds.max - bounds.min).max_element();
    let options = HexingOptions { edge_length, ..HexingOptions::default() };
    hex_solid(part, &options, &Silent).expect("a mesh")
}

/// The longest edge of any hex over its shortest, at most: 56 in 250 random parts with edges of an eighth and a sixth of them.
const MOST_ASPECT: f64 = 100.0;

/// Is the mesh conforming, a manifold, and positive everywhere, are no edges next to nothing, and does the report tell its
/// quality?
pub(super) fn assert_sound(hexed: &HexedSolid, name: &str) {
    let mesh = &hexed.mesh;
    assert!(!mesh.hexes.is_empty(), "{name}");
    assert_eq!(check_hexes(mesh), [], "{name}");
    let report = hex_report(&HexTopology::of(mesh));
    assert!(report.is_manifold(), "{name}");
    let mut jacobians = Vec::new();
    for hex in &mesh.hexes {
        let corners: [Point; 8] = hex.map(|n| mesh.positions[n.index()]);
        jacobians.push(scaled_jacobian(&corners));
        assert!(is_positive(&corners) == Certainty::Positive, "{name}");
        assert!(aspect(&corners) < MOST_ASPECT, "{name}: {}", aspect(&corners));
    }
    let (result, mean) = (hexed.report.result(), jacobians.iter().sum::<f64>() / jacobians.len() as f64);
    assert!(result.worst > 0.0 && (result.mean - mean).abs() < 1e-9, "{name}: {}, not {mean}", result.mean);
    assert_eq!(result.worst, jacobians.into_iter().fold(1.0, f64::min), "{name}");
}

#[test]
fn random_parts_at_a_coarse_edge_length() {
    for seed in 0..6 {
        let part = random_part(seed);
        assert_sound(&hexed(&part, 0.125), &format!("part {seed}"));
    }
}

/// Seen along its principal direction, the end of one of its cylinders is a line that turns back in two points that fall
/// together.
#[test]
fn a_part_with_a_rim_seen_from_its_side_is_meshed() {
    assert_sound(&hexed(&random_part(19), 0.125), "part 19");
}

/// What is thinner than cells is lost in any grid of them, and the mesh is of another kind.
#[test]
fn a_part_whose_kind_no_grid_shows_is_cut_out_of_an_octree() {
    let hexed = hexed(&random_part(95), 1.0 / 12.0);
    let (body, result) = (&hexed.report.bodies[0], hexed.report.result());
    let tried = |kind: Background| body.attempts.iter().filter(move |attempt| attempt.background == kind);
    assert!(body.choice.kind != Background::Octree && tried(Background::Grid).count() > 0);
    // They are not worth a fit.
    let is_draft = |attempt: &AttemptReport| attempt.mesh.is_none();
    assert!(tried(Background::Grid).all(|a| a.core.euler != a.core.solid_euler && is_draft(a)));
    assert_eq!(body.attempts[body.kept.unwrap()].background, Background::Octree);
    assert_eq!(result.euler, result.solid_euler);
    assert_sound(&hexed, "part 95");
}

/// Pyramids over a regular polygon: at the tip of one over so many sides as many surfaces meet.
#[test]
fn a_tip_of_more_than_three_surfaces_is_captured() {
    for sides in [4, 5] {
        let mut pyramid = PolygonMesh::default();
        for k in 0..sides {
            let angle = f64::from(k) / f64::from(sides) * std::f64::consts::TAU;
            pyramid.positions.push(Point::new(angle.cos(), angle.sin(), 0.0));
            pyramid.push_face([k, (k + 1) % sides, sides].map(NodeId));
        }
        pyramid.positions.push(Point::Z);
        pyramid.push_face((0..sides).rev().map(NodeId));
        let hexed = hexed(&pyramid, 1.0 / 12.0);
        let result = hexed.report.result();
        let curves = result.features.curves;
        assert_eq!((curves.captured, curves.found), (2 * sides as usize, 2 * sides as usize));
        let sheets = hexed.report.bodies[0].attempts.iter().filter_map(|attempt| attempt.mesh.as_ref());
        assert!(sheets.map(|mesh| mesh.sheets).all(|of| of.sheets > 0 && of.pinched == 0), "{sides}");
        assert!(result.worst > 0.25 && (sides == 5 || result.distance.hausdorff() < 1e-9), "{result:?}");
        assert_sound(&hexed, &format!("a pyramid of {sides} sides"));
    }
}

/// A ridge of 40 degrees on a plate: its two slopes are covered together with the plate around, and two hexes side by side
/// along the ridge could have no scaled Jacobian above the sine of 20 degrees.
#[test]
fn a_sharp_ridge_has_one_hex() {
    let base = [[0.0, 0.0], [8.0, 0.0], [8.0, 8.0], [0.0, 8.0]];
    let foot = [[3.0, 2.0], [5.0, 2.0], [5.0, 6.0], [3.0, 6.0]];
    let top = 2.0 + 1.0 / 20f64.to_radians().tan();
    let mut ridge = PolygonMesh::default();
    for (ring, z) in [(base, 0.0), (base, 2.0), (foot, 2.0)] {
        ridge.positions.extend(ring.map(|[x, y]| Point::new(x, y, z)));
    }
    ridge.positions.extend([2.0, 6.0].map(|y| Point::new(4.0, y, top)));
    ridge.push_face([3, 2, 1, 0].map(NodeId));
    for k in 0..4 {
        let next = (k + 1) % 4;
        ridge.push_face([k, next, next + 4, k + 4].map(NodeId));
        ridge.push_face([k + 4, next + 4, next + 8, k + 8].map(NodeId));
    }
    ridge.push_face([9, 10, 13, 12].map(NodeId));
    ridge.push_face([11, 8, 12, 13].map(NodeId));
    ridge.push_face([8, 9, 12].map(NodeId));
    ridge.push_face([10, 11, 13].map(NodeId));
    let options =
        HexingOptions { edge_length: 0.5, background: Background::Grid, ..HexingOptions::default() };
    let hexed = hex_solid(&ridge, &options, &Silent).expect("a mesh");
    let body = &hexed.report.bodies[0];
    let kept = body.attempts[body.kept.unwrap()].mesh.as_ref().unwrap();
    assert!(kept.sheets.wedges > 0 && kept.worst > 0.4, "{:?} {}", kept.sheets, kept.worst);
    assert_sound(&hexed, "a ridge");
}
