//! Takes back what moved where that brought mesh and solid no nearer to each other: each patch of nodes by itself, so that what
//! helped in one place counts though it did not in another.

use crate::geometry::Point;
use crate::mesh::topology::Sets;
use crate::mesh::{HexMesh, NodeId};
use crate::solid::SurfaceId;

/// Some quads, how far they were from the solid, and how far they are.
type Distances<'a> = (&'a [([NodeId; 4], SurfaceId)], &'a [f64], &'a [f64]);

/// Takes nodes back to where they were `before`, unless no more than this share is left of what their patch was apart where it was
/// farthest. A patch is what moved of cells that share such nodes.
pub(super) fn keep_nearer(mesh: &mut HexMesh, before: &[Point], (faces, was, is): Distances, share: f64) {
    let positions = &mesh.positions;
    let is_moved = |n: &&NodeId| positions[n.index()] != before[n.index()];
    let mut patches = Sets::new(before.len());
    for hex in &mesh.hexes {
        let mut moved = hex.iter().filter(is_moved).map(|n| n.index() as u32);
        if let Some(first) = moved.next() {
            moved.for_each(|n| _ = patches.join(first, n, false));
        }
    }
    let mut patch_of = |n: usize| patches.root(n as u32).0 as usize;
    let mut farthest = vec![[0.0_f64; 2]; before.len()];
    for (((quad, _), was), is) in faces.iter().zip(was).zip(is) {
        if let Some(n) = quad.iter().find(is_moved) {
            let patch = &mut farthest[patch_of(n.index())];
            *patch = [patch[0].max(*was), patch[1].max(*is)];
        }
    }
    for (n, (now, before)) in mesh.positions.iter_mut().zip(before).enumerate() {
        let [was, is] = farthest[patch_of(n)];
        if is > share * was {
            *now = *before;
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::geometry::Aabb;
    use crate::mesh::topology::hex_boundary;
    use crate::mesh::{GridOptions, hex_grid};

    /// Nodes moved at both ends of a bar. It came nearer at one of them alone.
    #[test]
    fn patches_count_by_themselves() {
        let bounds = Aabb { min: Point::ZERO, max: Point::new(8.0, 1.0, 1.0) };
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: true, max_hexes: 100 };
        let mut mesh = hex_grid(bounds, &options).unwrap();
        let faces: Vec<_> =
            hex_boundary(&mesh.hexes).into_iter().map(|(quad, _)| (quad, SurfaceId(0))).collect();
        let before = mesh.positions.clone();
        mesh.positions.iter_mut().filter(|p| p.x < 2.0 || p.x > 6.0).for_each(|p| p.y += 0.1);
        let moved = mesh.positions.clone();
        let left = |quad: &[NodeId; 4]| quad.iter().any(|n| before[n.index()].x < 2.0);
        let was = vec![1.0; faces.len()];
        let is: Vec<f64> = faces.iter().map(|(quad, _)| if left(quad) { 0.9 } else { 1.0 }).collect();
        let mut kept = |share: f64| {
            mesh.positions.clone_from(&moved);
            keep_nearer(&mut mesh, &before, (&faces, &was, &is), share);
            mesh.positions.clone()
        };
        let expected = (0..before.len()).map(|n| if before[n].x < 2.0 { moved[n] } else { before[n] });
        assert_eq!(kept(0.99), expected.collect::<Vec<_>>());
        assert_eq!(kept(1.0), moved);
        assert_eq!(kept(0.8), before);
    }
}
