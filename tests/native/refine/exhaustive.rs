//! Small worlds, in full.

use hexmill::refine::{QuadOptions, RefinedQuads};

use super::judge::{angles, area, assert_conforming, assert_oriented, quad_faces};
use super::refine_where;
use super::worlds::{grid, ring, three_sheets};

/// Which of the 3 x 3 unit squares holds the point.
fn cell(p: hexmill::geometry::Point) -> u32 {
    p.x.floor() as u32 + 3 * p.y.floor() as u32
}

fn assert_square_quality(refined: &RefinedQuads) {
    for angle in angles(&refined.mesh) {
        assert!((44.999_999..135.000_001).contains(&angle), "angle {angle}");
    }
}

/// Every subset of nine squares, refined once and twice beyond the first refinement.
#[test]
fn all_512_masks_of_3_by_3_quads_at_two_levels() {
    let input = grid(3, 3);
    for mask in 0..512_u32 {
        for deepest in 1..=2 {
            let refined = refine_where(&input, &QuadOptions::default(), |level, center| {
                level == 0 || level <= deepest && mask >> cell(center) & 1 == 1
            });
            assert_conforming(&input, &refined);
            assert_oriented(&refined.mesh);
            assert_square_quality(&refined);
            assert!((area(&refined.mesh.positions, quad_faces(&refined.mesh)) - 9.0).abs() < 1e-12);
            let expected_deepest = if mask == 0 { 1 } else { deepest as u8 + 1 };
            assert_eq!(refined.level.iter().max(), Some(&expected_deepest));
        }
    }
}

/// The same masks with the coarse quads kept: 3 x 3 quads are two-colourable.
#[test]
fn all_512_masks_with_coarse_quads_kept() {
    let input = grid(3, 3);
    let options = QuadOptions { keep_coarse: true, ..QuadOptions::default() };
    for mask in 0..512_u32 {
        for deepest in 0..=1 {
            let refined = refine_where(&input, &options, |level, center| {
                level <= deepest && mask >> cell(center) & 1 == 1
            });
            assert_conforming(&input, &refined);
            assert_oriented(&refined.mesh);
            assert_square_quality(&refined);
        }
        if mask == 0 {
            let refined = refine_where(&input, &options, |_, _| false);
            assert_eq!(refined.mesh.quads.len(), 9);
        }
    }
}

/// Every subset of the 12 level-1 quads of three sheets at an edge, and of the ring's 8 coarse quads.
#[test]
fn all_masks_of_three_sheets_and_of_a_ring() {
    let sheets = three_sheets();
    let sheet_cell = |p: hexmill::geometry::Point| {
        let (sheet, across) = if p.z > 0.0 {
            (2, p.z)
        } else if p.y < 0.0 {
            (1, -p.y)
        } else {
            (0, p.y)
        };
        4 * sheet + 2 * u32::from(across > 0.5) + u32::from(p.x > 0.5)
    };
    for mask in 0..4096_u32 {
        let refined = refine_where(&sheets, &QuadOptions::default(), |level, center| {
            level == 0 || level == 1 && mask >> sheet_cell(center) & 1 == 1
        });
        assert_conforming(&sheets, &refined);
        assert_square_quality(&refined);
    }
    let ring = ring();
    for mask in 0..512_u32 {
        let refined = refine_where(&ring, &QuadOptions::default(), |level, center| {
            level == 0 || level <= 2 && mask >> cell(center) & 1 == 1
        });
        assert_conforming(&ring, &refined);
        assert_square_quality(&refined);
    }
}
