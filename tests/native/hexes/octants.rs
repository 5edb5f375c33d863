//! All ways to refine the eight families around a node.

use hexmill::refine::hex::Method;

use hexmill::mesh::numbering::hex::{CORNER_AT, SYMMETRIES};
use std::collections::BTreeSet;

use super::judge::{center, families, interface_faces, judge_stage};
use super::refine;

#[test]
fn every_star_of_octants_is_joined() {
    let mesh = families([4; 3]);
    let before = mesh.hexes.len();
    let mut grown = BTreeSet::new();
    for mask in 1..256u32 {
        let wanted: Vec<bool> = (0..before)
            .map(|h| {
                let cell = center(&mesh, h).to_array().map(|x| x as usize / 2);
                let inner = cell.iter().all(|&x| x == 1 || x == 2);
                inner && mask >> ((cell[0] - 1) + 2 * (cell[1] - 1) + 4 * (cell[2] - 1)) & 1 == 1
            })
            .collect();
        let asked = wanted.iter().filter(|&&w| w).count();
        for method in [Method::Two, Method::Three] {
            let (stage, refined) = refine(&mesh, wanted.clone(), method);
            let count = refined.iter().filter(|&&r| r).count();
            if count > asked {
                assert_eq!(count - asked, if method == Method::Two { 8 } else { 1 }, "mask {mask:#b}");
                grown.insert(mask);
            }
            let faces = interface_faces(&mesh, &refined);
            let (inside, layer) = if method == Method::Two { (7, 7) } else { (26, 13) };
            assert_eq!(stage.mesh.hexes.len(), before + inside * count + layer * faces, "mask {mask:#b}");
            judge_stage(&mesh, &stage.mesh);
        }
    }
    // Where coarse octants touch at an edge that refined ones surround, and all else around is coarse, one
    // more family is needed: the same for every symmetry.
    assert_eq!(grown.len(), 36);
    for symmetry in SYMMETRIES {
        let image = |mask: &u32| {
            let moved = |octant: usize| CORNER_AT[usize::from(symmetry[usize::from(CORNER_AT[octant])])];
            (0..8).filter(|octant| mask >> octant & 1 == 1).map(|octant| 1 << moved(octant)).sum::<u32>()
        };
        assert_eq!(grown.iter().map(image).collect::<BTreeSet<u32>>(), grown);
    }
}
