//! The same numbers for any number of threads.

use std::collections::BTreeMap;

use super::hexes::corners;
use super::*;
use crate::geometry::{Aabb, Point};
use crate::mesh::numbering::hex::{EDGES, FACES};
use crate::mesh::{GridOptions, NodeId, hex_grid};
use crate::parallel;

/// Runs `check` without threads to share the work, and with several.
fn on_pools(check: impl Fn(usize) + Sync) {
    for threads in [1, 2, 3, 7] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| check(threads));
    }
}

/// The numbers that a walk gives, by the obvious means.
fn walked<const N: usize, const PARTS: usize>(
    hexes: &[[NodeId; 8]],
    table: [[u8; N]; PARTS],
) -> (Vec<[NodeId; N]>, Vec<[u32; PARTS]>) {
    let (mut nodes, mut numbers) = (Vec::new(), BTreeMap::new());
    let mut number = |hex: &[NodeId; 8], local: [u8; N]| {
        let part = corners(hex, local);
        let mut set = part;
        set.sort_unstable();
        *numbers.entry(set).or_insert_with(|| {
            nodes.push(part);
            nodes.len() as u32 - 1
        })
    };
    let of_hex = hexes.iter().map(|hex| table.map(|local| number(hex, local))).collect();
    (nodes, of_hex)
}

#[test]
fn any_number_of_threads_numbers_as_a_walk_does() {
    let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 100_000 };
    let mut mesh = hex_grid(Aabb { min: Point::ZERO, max: Point::splat(20.0) }, &options).unwrap();
    // Far apart what is beside each other, and one hex twice.
    mesh.hexes.sort_unstable_by_key(|hex| hex[0].0.wrapping_mul(2_654_435_761));
    mesh.hexes.push(mesh.hexes[77]);
    let (count, hexes) = (mesh.positions.len(), mesh.hexes.as_slice());
    let (nodes, of_hex) = walked(hexes, FACES);
    let (ends, edges_of_hex) = walked(hexes, EDGES);
    let mut sides = vec![Vec::new(); nodes.len()];
    (0u32..).zip(of_hex.as_flattened()).for_each(|(side, &face)| sides[face as usize].push(side));
    on_pools(|threads| {
        assert_eq!(parallel::shares(count, 6 * hexes.len()).len(), threads);
        let (faces, edges) = (HexFaces::of(count, hexes), HexEdges::of(count, hexes));
        assert!(faces.nodes == nodes && edges.ends == ends, "{threads}");
        assert!(faces.of_hex.iter().map(|hex| hex.map(|f| f.0)).eq(of_hex.iter().copied()));
        assert!(edges.of_hex.iter().map(|hex| hex.map(|e| e.0)).eq(edges_of_hex.iter().copied()));
        assert!(faces.ids().all(|f| faces.sides(f) == sides[f.index()]));
    });
}
