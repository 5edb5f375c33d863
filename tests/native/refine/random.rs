//! Random refinement of random surfaces.

use hexmill::geometry::Point;
use hexmill::mesh::{NodeId, PolygonMesh};
use hexmill::refine::QuadOptions;
use proptest::prelude::*;

use super::judge::{angles, area, assert_conforming, assert_oriented, polygon_faces, quad_faces};
use super::refine_where;
use super::worlds::{cube, grid, mapped_grid, mixed_strip, three_sheets};

/// A repeatable coin for each (seed, level, place): true in `percent` of all cases.
pub fn coin(seed: u64, level: usize, p: Point, percent: u64) -> bool {
    let mut h = seed ^ (level as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    for x in p.to_array() {
        h = (h ^ x.to_bits()).wrapping_mul(0xff51_afd7_ed55_8ccd);
        h ^= h >> 33;
    }
    h % 100 < percent
}

/// The surface with the corners of every face rotated and the faces in another order.
pub fn shuffled(mesh: &PolygonMesh, seed: u64) -> PolygonMesh {
    let mut order: Vec<usize> = (0..mesh.face_count()).collect();
    order.sort_by_key(|&f| (f as u64 + 1).wrapping_mul(seed | 1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let mut out = PolygonMesh { positions: mesh.positions.clone(), ..Default::default() };
    for f in order {
        let mut face: Vec<NodeId> = mesh.face(f).to_vec();
        let turns = (seed >> (f % 60)) as usize % face.len();
        face.rotate_left(turns);
        out.push_face(face);
    }
    out
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn square_grids_keep_angles_and_area(
        nx in 1_u32..6, ny in 1_u32..6, levels in 1_usize..6, percent in 5_u64..60, seed: u64, keep: bool,
    ) {
        let input = shuffled(&grid(nx, ny), seed);
        let options = QuadOptions { keep_coarse: keep, ..QuadOptions::default() };
        let refined = refine_where(&input, &options, |level, p| {
            level < levels && (level == 0 && !keep || coin(seed, level, p, percent))
        });
        assert_conforming(&input, &refined);
        assert_oriented(&refined.mesh);
        let total = area(&refined.mesh.positions, quad_faces(&refined.mesh));
        prop_assert!((total - f64::from(nx * ny)).abs() < 1e-9);
        for angle in angles(&refined.mesh) {
            prop_assert!((44.999_999..135.000_001).contains(&angle), "angle {}", angle);
        }
    }

    #[test]
    fn distorted_grids_keep_their_area(seed: u64, levels in 1_usize..5, percent in 5_u64..60) {
        let bend = |x: f64, y: f64| Point::new(x + 0.3 * (y * 1.7).sin(), y + 0.25 * (x * 2.3).cos(), 0.0);
        let input = shuffled(&mapped_grid(4, 4, bend), seed);
        let refined = refine_where(&input, &QuadOptions::default(), |level, p| {
            level < levels && (level == 0 || coin(seed, level, p, percent))
        });
        assert_conforming(&input, &refined);
        let (before, after) = (
            area(&input.positions, polygon_faces(&input)),
            area(&refined.mesh.positions, quad_faces(&refined.mesh)),
        );
        prop_assert!((before - after).abs() < 1e-9 * before);
    }

    #[test]
    fn closed_mixed_and_non_manifold_surfaces_conform(
        which in 0_usize..3, seed: u64, levels in 1_usize..6, percent in 5_u64..60,
    ) {
        let input = shuffled(&[cube(), mixed_strip(), three_sheets()][which], seed);
        let refined = refine_where(&input, &QuadOptions::default(), |level, p| {
            level < levels && (level == 0 || coin(seed, level, p, percent))
        });
        assert_conforming(&input, &refined);
        if which < 2 {
            assert_oriented(&refined.mesh);
        }
    }
}
