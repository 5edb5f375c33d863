//! An independent judge of hex meshes: slow, simple, and trusting nothing.

use std::collections::{BTreeMap, BTreeSet};

use hexmill::geometry::Point;
use hexmill::mesh::NodeId;
use hexmill::mesh::numbering::hex::{CORNERS, EDGES, FACES};
use hexmill::refine::hex::StageMesh;

/// A grid of cells of size 1; `keep` by cell, `map` moves the nodes.
pub fn grid(
    size: [usize; 3],
    keep: impl Fn([usize; 3]) -> bool,
    map: impl Fn([f64; 3]) -> [f64; 3],
) -> StageMesh {
    let at = |[x, y, z]: [usize; 3]| (z * (size[1] + 1) + y) * (size[0] + 1) + x;
    let (mut positions, mut ids, mut hexes) = (Vec::new(), BTreeMap::new(), Vec::new());
    for cell in 0..size[0] * size[1] * size[2] {
        let cell = [cell % size[0], cell / size[0] % size[1], cell / size[0] / size[1]];
        if keep(cell) {
            hexes.push(CORNERS.map(|c| {
                let node = [0, 1, 2].map(|axis| cell[axis] + usize::from(c[axis]));
                *ids.entry(at(node)).or_insert_with(|| {
                    positions.push(Point::from_array(map(node.map(|x| x as f64))));
                    NodeId::new(positions.len() - 1)
                })
            }));
        }
    }
    StageMesh::of_input(positions, hexes)
}

/// A box of level-0 cells, each refined once, measured in the finer cells.
pub fn families(size: [usize; 3]) -> StageMesh {
    super::refined_once(&grid(size, |_| true, |p| p.map(|x| 2.0 * x)))
}

pub fn corners(mesh: &StageMesh, hex: usize) -> [Point; 8] {
    mesh.hexes[hex].map(|n| mesh.positions[n.index()])
}

pub fn center(mesh: &StageMesh, hex: usize) -> Point {
    corners(mesh, hex).into_iter().sum::<Point>() / 8.0
}

/// The corner Jacobians: the three edges at each corner.
fn edges_at(p: &[Point; 8], corner: usize) -> [Point; 3] {
    [0, 1, 2].map(|axis| {
        let mut there = CORNERS[corner];
        there[axis] ^= 1;
        let other = CORNERS.iter().position(|&c| c == there).expect("a corner");
        (p[other] - p[corner]) * if CORNERS[corner][axis] == 1 { -1.0 } else { 1.0 }
    })
}

/// The least scaled Jacobian of all corners.
pub fn worst(mesh: &StageMesh) -> f64 {
    (0..mesh.hexes.len())
        .flat_map(|h| {
            let p = corners(mesh, h);
            (0..8).map(move |k| {
                let [a, b, c] = edges_at(&p, k).map(Point::normalize);
                a.cross(b).dot(c)
            })
        })
        .fold(1.0, f64::min)
}

/// The volume: two Gauss points an axis are exact for trilinear hexes.
pub fn volume(mesh: &StageMesh) -> f64 {
    let gauss = [0.5 - 0.75f64.sqrt() / 3.0, 0.5 + 0.75f64.sqrt() / 3.0];
    let mut sum = 0.0;
    for h in 0..mesh.hexes.len() {
        let p = corners(mesh, h);
        for k in 0..8 {
            let at = [gauss[k % 2], gauss[k / 2 % 2], gauss[k / 4]];
            let slope = |axis: usize| -> Point {
                (0..8)
                    .map(|c| {
                        let along = |a: usize| if CORNERS[c][a] == 1 { at[a] } else { 1.0 - at[a] };
                        let others: f64 = (0..3).filter(|&a| a != axis).map(along).product();
                        p[c] * if CORNERS[c][axis] == 1 { others } else { -others }
                    })
                    .sum()
            };
            sum += slope(0).cross(slope(1)).dot(slope(2)) / 8.0;
        }
    }
    sum
}

/// What kind of complex a mesh is.
#[derive(Debug, PartialEq)]
pub struct Complex {
    /// Nodes - edges + faces - hexes.
    pub euler: i64,
    /// The area of the boundary, whose faces are planar.
    pub boundary_area: f64,
    pub volume: f64,
}

/// Checks that a mesh conforms; returns its invariants.
pub fn judge(mesh: &StageMesh) -> Complex {
    let count = mesh.hexes.len();
    assert!(
        [mesh.octant.len(), mesh.level.len(), mesh.root.len(), mesh.element.len()]
            .iter()
            .all(|&n| n == count)
    );
    let mut faces: Vec<([NodeId; 4], [NodeId; 4])> = Vec::new();
    let mut edges = BTreeSet::new();
    let mut used = vec![false; mesh.positions.len()];
    for hex in &mesh.hexes {
        let distinct: BTreeSet<_> = hex.iter().collect();
        assert_eq!(distinct.len(), 8, "a repeated node in {hex:?}");
        hex.iter().for_each(|n| used[n.index()] = true);
        edges.extend(EDGES.map(|[a, b]| {
            let (a, b) = (hex[usize::from(a)], hex[usize::from(b)]);
            [a.min(b), a.max(b)]
        }));
        faces.extend(FACES.map(|face| {
            let face = face.map(|k| hex[usize::from(k)]);
            let mut key = face;
            key.sort_unstable();
            (key, face)
        }));
    }
    assert!(used.iter().all(|&used| used), "an unused node");
    faces.sort_unstable();
    let (mut face_count, mut boundary_area) = (0, 0.0);
    let mut triples = Vec::new();
    // Per node: edges - faces + hexes at it, and whether it is on the boundary.
    let mut link = vec![0i64; mesh.positions.len()];
    let mut on_boundary = vec![false; mesh.positions.len()];
    edges.iter().flatten().for_each(|n| link[n.index()] += 1);
    mesh.hexes.as_flattened().iter().for_each(|n| link[n.index()] += 1);
    for same in faces.chunk_by(|a, b| a.0 == b.0) {
        face_count += 1;
        let ([a, b, c, d], first) = same[0];
        triples.extend([[a, b, c], [a, b, d], [a, c, d], [b, c, d]]);
        first.iter().for_each(|n| link[n.index()] -= 1);
        match same {
            [_] => {
                first.iter().for_each(|n| on_boundary[n.index()] = true);
                let p = first.map(|n| mesh.positions[n.index()]);
                boundary_area += (p[2] - p[0]).cross(p[3] - p[1]).length() / 2.0;
            }
            [_, (_, second)] => {
                let at = second.iter().position(|&n| n == first[0]).expect("the same nodes");
                assert!((0..4).all(|k| first[k] == second[(at + 4 - k) % 4]), "{first:?} and {second:?}");
            }
            more => panic!("{} hexes at the face {first:?}", more.len()),
        }
    }
    triples.sort_unstable();
    assert!(triples.windows(2).all(|w| w[0] != w[1]), "two faces share three nodes");
    for (n, (&link, &boundary)) in link.iter().zip(&on_boundary).enumerate() {
        assert_eq!(link, if boundary { 1 } else { 2 }, "the link of node {n} is no disk or sphere");
    }
    let euler = used.len() as i64 - edges.len() as i64 + face_count - count as i64;
    Complex { euler, boundary_area, volume: volume(mesh) }
}

/// Checks the next mesh against the one before.
pub fn judge_stage(before: &StageMesh, after: &StageMesh) {
    let (a, b) = (judge(before), judge(after));
    assert_eq!(a.euler, b.euler);
    assert!((a.volume - b.volume).abs() < 1e-9 * a.volume, "volume {} became {}", a.volume, b.volume);
    let off = (a.boundary_area - b.boundary_area).abs();
    assert!(off < 1e-9 * a.boundary_area, "boundary {} became {}", a.boundary_area, b.boundary_area);
    for h in 0..after.hexes.len() {
        assert_eq!(after.octant[h] == u8::MAX, after.element[h] == u32::MAX || after.octant[h] > 7);
    }
}

/// Faces between the set and the rest.
pub fn interface_faces(mesh: &StageMesh, refined: &[bool]) -> usize {
    let mut sides: BTreeMap<[NodeId; 4], Vec<bool>> = BTreeMap::new();
    for (hex, &side) in mesh.hexes.iter().zip(refined) {
        for face in FACES {
            let mut key = face.map(|k| hex[usize::from(k)]);
            key.sort_unstable();
            sides.entry(key).or_default().push(side);
        }
    }
    sides.values().filter(|sides| sides.contains(&true) && sides.contains(&false)).count()
}
