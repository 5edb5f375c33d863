//! An independent judge of refined quad meshes: slow, simple, and trusting nothing.

use std::collections::{BTreeMap, BTreeSet};

use hexmill::geometry::Point;
use hexmill::mesh::{PolygonMesh, QuadMesh};
use hexmill::refine::RefinedQuads;

/// Vertices minus edges plus faces.
pub fn euler(faces: impl Iterator<Item = Vec<u32>>) -> i64 {
    let (mut nodes, mut edges, mut count) = (BTreeSet::new(), BTreeSet::new(), 0);
    for face in faces {
        count += 1;
        for k in 0..face.len() {
            let (a, b) = (face[k], face[(k + 1) % face.len()]);
            nodes.insert(a);
            edges.insert((a.min(b), a.max(b)));
        }
    }
    nodes.len() as i64 - edges.len() as i64 + count
}

pub fn polygon_faces(mesh: &PolygonMesh) -> impl Iterator<Item = Vec<u32>> + '_ {
    mesh.faces().map(|f| f.iter().map(|n| n.0).collect())
}

pub fn quad_faces(mesh: &QuadMesh) -> impl Iterator<Item = Vec<u32>> + '_ {
    mesh.quads.iter().map(|q| q.iter().map(|n| n.0).collect())
}

/// How many faces each edge has.
pub fn edge_uses(faces: impl Iterator<Item = Vec<u32>>) -> BTreeMap<(u32, u32), usize> {
    let mut uses = BTreeMap::new();
    for face in faces {
        for k in 0..face.len() {
            let (a, b) = (face[k], face[(k + 1) % face.len()]);
            *uses.entry((a.min(b), a.max(b))).or_default() += 1;
        }
    }
    uses
}

/// Area as the sum of triangle areas about each face's mean.
pub fn area(positions: &[Point], faces: impl Iterator<Item = Vec<u32>>) -> f64 {
    faces
        .map(|f| {
            let at = |k: usize| positions[f[k % f.len()] as usize];
            let mean = f.iter().map(|&n| positions[n as usize]).sum::<Point>() / f.len() as f64;
            (0..f.len()).map(|k| (at(k) - mean).cross(at(k + 1) - mean).length() / 2.0).sum::<f64>()
        })
        .sum()
}

/// All corner angles in degrees, from 0 to 180.
pub fn angles(mesh: &QuadMesh) -> Vec<f64> {
    mesh.quads
        .iter()
        .flat_map(|q| {
            (0..4).map(|k| {
                let at = |i: usize| mesh.positions[q[i % 4].index()];
                (at(k + 1) - at(k)).angle_between(at(k + 3) - at(k)).to_degrees()
            })
        })
        .collect()
}

/// Panics unless the mesh is conforming: valid, complete, and without a node inside an edge.
///
/// A hanging node shows as an edge with fewer faces than its place in the input calls for: the refined edges on
/// an input edge have as many faces as that edge, all others have two.
pub fn assert_conforming(input: &PolygonMesh, refined: &RefinedQuads) {
    let mesh = &refined.mesh;
    assert_eq!(refined.level.len(), mesh.quads.len());
    assert_eq!(refined.parent.len(), mesh.quads.len());
    let mut used = vec![false; mesh.positions.len()];
    for quad in &mesh.quads {
        for n in quad {
            used[n.index()] = true;
        }
        assert_eq!(BTreeSet::from(*quad).len(), 4, "a repeated node in {quad:?}");
    }
    assert!(used.iter().all(|&u| u), "unused nodes");
    assert!(mesh.positions.iter().all(|p| p.is_finite()));
    assert_eq!(euler(quad_faces(mesh)), euler(polygon_faces(input)), "Euler characteristic");

    let uses_before = edge_uses(polygon_faces(input));
    let uses_after = edge_uses(quad_faces(mesh));
    let count = |uses: &BTreeMap<(u32, u32), usize>, wanted: fn(usize) -> bool| {
        uses.values().filter(|&&n| wanted(n)).count()
    };
    let length = |positions: &[Point], uses: &BTreeMap<(u32, u32), usize>, n: usize| -> f64 {
        let wanted = uses.iter().filter(|&(_, &faces)| faces == n);
        wanted.map(|((a, b), _)| positions[*a as usize].distance(positions[*b as usize])).sum()
    };
    if count(&uses_before, |n| n != 2) == 0 {
        assert_eq!(count(&uses_after, |n| n != 2), 0, "an open edge in a closed surface");
    }
    for n in (1..=*uses_before.values().max().unwrap()).filter(|&n| n != 2) {
        let (before, after) =
            (length(&input.positions, &uses_before, n), length(&mesh.positions, &uses_after, n));
        assert!(
            (before - after).abs() <= 1e-9 * before.max(1.0),
            "edges with {n} faces: {before} became {after}"
        );
    }
}

/// Panics unless neighbours that share an edge run along it in opposite directions.
pub fn assert_oriented(mesh: &QuadMesh) {
    let mut directed = BTreeSet::new();
    for quad in &mesh.quads {
        for k in 0..4 {
            assert!(directed.insert((quad[k], quad[(k + 1) % 4])), "an edge runs twice the same way");
        }
    }
}
