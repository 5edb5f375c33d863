use super::*;
use crate::geometry::Point;
use crate::mesh::numbering::hex::{CORNERS, FACES};
use crate::mesh::topology::hex_report;

/// `n` unit cubes an axis; node (i, j, k) is `i + (n + 1) * (j + (n + 1) * k)`, and so are the hexes numbered.
fn grid(n: u32) -> HexMesh {
    let (side, count) = (n + 1, n * n * n);
    let at = |m: u32, base: u32| [m % base, m / base % base, m / base / base];
    let positions = (0..side * side * side).map(|m| Point::from(at(m, side).map(f64::from))).collect();
    let hex = |m: u32| {
        let [i, j, k] = at(m, n);
        CORNERS.map(|[x, y, z]| {
            let [x, y, z] = [i + u32::from(x), j + u32::from(y), k + u32::from(z)];
            NodeId(x + side * (y + side * z))
        })
    };
    HexMesh { positions, hexes: (0..count).map(hex).collect(), ..HexMesh::default() }
}

/// The mesh with the given hexes alone, and the nodes that they use.
fn kept(mesh: &HexMesh, keep: &[usize]) -> HexMesh {
    let hexes: Vec<_> = keep.iter().map(|&h| mesh.hexes[h]).collect();
    let mut used: Vec<NodeId> = hexes.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    let new = |n: NodeId| NodeId::new(used.binary_search(&n).unwrap());
    HexMesh {
        positions: used.iter().map(|n| mesh.positions[n.index()]).collect(),
        hexes: hexes.iter().map(|h| h.map(new)).collect(),
        ..HexMesh::default()
    }
}

fn report(mesh: &HexMesh) -> crate::mesh::topology::HexReport {
    hex_report(&HexTopology::of(mesh))
}

fn kinds(mesh: &HexMesh) -> Vec<&'static str> {
    let mut kinds: Vec<_> = check_hexes(mesh).iter().map(Defect::kind).collect();
    kinds.dedup();
    kinds
}

#[test]
fn a_grid_is_without_defect() {
    let mesh = grid(3);
    assert_eq!(check_hexes(&mesh), []);
    assert_eq!(check_hexes(&HexMesh::default()), []);
    let report = report(&mesh);
    assert!(report.is_manifold());
    assert_eq!((report.nodes, report.edges, report.faces, report.hexes), (64, 144, 108, 27));
    assert_eq!((report.boundary_faces, report.boundary_components, report.components), (54, 1, 1));
    assert_eq!((report.euler, report.unused_nodes), (1, 0));
}

#[test]
fn cavities_and_handles_show_in_the_numbers_and_are_no_defects() {
    let hollow: Vec<usize> = (0..27).filter(|&h| h != 13).collect();
    let hollow = kept(&grid(3), &hollow);
    assert_eq!(check_hexes(&hollow), []);
    assert_eq!((report(&hollow).euler, report(&hollow).boundary_components), (2, 2));
    let ring: Vec<usize> = (0..9).filter(|&h| h != 4).collect();
    let ring = kept(&grid(3), &ring);
    assert_eq!(check_hexes(&ring), []);
    assert_eq!((report(&ring).euler, report(&ring).boundary_components), (0, 1));
}

/// All 255 sets of the eight cubes around a node: defects are where the set's cubes touch at an edge or a node alone.
#[test]
fn all_255_stars_of_cubes() {
    let cubes = grid(2);
    for mask in 1..256_usize {
        let keep: Vec<usize> = (0..8).filter(|h| mask >> h & 1 == 1).collect();
        let mesh = kept(&cubes, &keep);
        let defects = check_hexes(&mesh);
        assert!(!defects.iter().any(Defect::is_error), "{mask}: {defects:?}");
        // Around an edge from the middle four cubes meet: two of them, across, touch there alone.
        let across = |axis: usize, end: usize| {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let has = |a: usize, b: usize| mask >> (end << axis | a << u | b << v) & 1 == 1;
            let around = [has(0, 0), has(1, 0), has(1, 1), has(0, 1)];
            around == [true, false, true, false] || around == [false, true, false, true]
        };
        let rims = (0..6).filter(|&k| across(k / 2, k % 2)).count();
        let found = defects.iter().filter(|d| d.kind() == "nonManifoldRim").count();
        assert_eq!(found, rims, "{mask}");
        assert_eq!(report(&mesh).non_manifold_edges, rims);
        // At the middle both the cubes and their complement must hang together through faces.
        let connected = |set: usize| {
            let mut reached = set & set.wrapping_neg();
            loop {
                let step = |h: usize| (0..3).fold(0, |m, axis| m | 1 << (h ^ 1 << axis)) & set;
                let more = (0..8).filter(|h| reached >> h & 1 == 1).fold(reached, |m, h| m | step(h));
                if more == reached {
                    return reached == set;
                }
                reached = more;
            }
        };
        let middle = Point::ONE;
        let odd = defects
            .iter()
            .any(|d| matches!(d, Defect::OddLink { node, .. } if mesh.positions[node.index()] == middle));
        let manifold = connected(mask) && connected(!mask & 255);
        if manifold {
            assert!(!odd, "{mask}");
        } else if rims == 0 {
            assert!(odd, "{mask}: a touch at the middle alone");
        }
    }
}

#[test]
fn tells_hexes_that_name_no_node_and_stops() {
    let mut mesh = grid(2);
    mesh.hexes[3][6] = NodeId(99);
    mesh.hexes[5] = [NodeId(0); 8];
    let expected = Defect::HexNodeOutOfRange { hex: HexId(3), node: NodeId(99), nodes: 27 };
    assert_eq!(check_hexes(&mesh), [expected]);
}

#[test]
fn tells_repeated_nodes_and_hexes_that_come_twice() {
    let mut mesh = grid(2);
    mesh.hexes[1][2] = mesh.hexes[1][1];
    assert_eq!(check_hexes(&mesh)[0], Defect::HexRepeatedNode { hex: HexId(1), node: mesh.hexes[1][1] });
    let mut mesh = grid(2);
    let mut twin = mesh.hexes[6];
    twin.rotate_left(4);
    mesh.hexes.push(twin);
    let found = check_hexes(&mesh);
    assert!(found.contains(&Defect::SameHexes { hexes: [HexId(6), HexId(8)] }), "{found:?}");
    assert!(found.contains(&Defect::InvertedHex { hex: HexId(8), corners: 8 }));
    assert!(found.iter().any(|d| d.kind() == "nonManifoldFace"));
}

#[test]
fn tells_hexes_on_one_side_of_a_face() {
    let mut mesh = grid(2);
    mesh.hexes[0].rotate_left(4);
    let found = check_hexes(&mesh);
    let sides = found.iter().filter(|d| d.kind() == "faceDisagreement").count();
    assert_eq!(sides, 3, "{found:?}");
    assert_eq!(crate::mesh::orient_hexes(&mut mesh), Ok(1));
    assert_eq!(check_hexes(&mesh), []);
}

#[test]
fn tells_faces_whose_nodes_go_around_in_another_order() {
    let mut mesh = kept(&grid(2), &[0, 1]);
    let face = FACES[5].map(usize::from);
    mesh.hexes[1].swap(face[1], face[2]);
    let found = check_hexes(&mesh);
    assert!(
        found.iter().any(|d| matches!(d, Defect::CrossedFace { hexes: [HexId(0), HexId(1)], .. })),
        "{found:?}"
    );
}

#[test]
fn tells_faces_with_three_common_nodes() {
    let mut mesh = kept(&grid(2), &[0, 1]);
    let copy = mesh.positions.len();
    mesh.positions.push(Point::new(1.2, 1.2, 1.2));
    // Corner 7 of the second cube is corner 6 of the first.
    mesh.hexes[1][7] = NodeId::new(copy);
    let found = check_hexes(&mesh);
    let told: Vec<_> = found.iter().filter(|d| d.kind() == "threeSharedNodes").collect();
    assert_eq!(told.len(), 1, "{found:?}");
    assert!(matches!(told[0], Defect::ThreeSharedNodes { hexes: [HexId(0), HexId(1)], .. }));
}

/// A cube beside one that is split into eight: five nodes hang in their common face, four of them in its edges.
#[test]
fn tells_nodes_that_hang_in_edges_and_faces() {
    for bend in [0.0, 0.2] {
        let mut coarse = kept(&grid(2), &[0, 1]);
        coarse.positions.iter_mut().for_each(|p| p.x += bend * p.y * p.z);
        let corners = coarse.hexes[1].map(|n| coarse.positions[n.index()]);
        let place = |x: f64, y: f64, z: f64| -> Point {
            let weight = |c: [u8; 3]| {
                let [a, b, c] = c.map(|c| c == 1);
                (if a { x } else { 1.0 - x }) * (if b { y } else { 1.0 - y }) * (if c { z } else { 1.0 - z })
            };
            CORNERS.iter().zip(corners).map(|(&c, p)| p * weight(c)).sum()
        };
        let mut mesh = HexMesh { positions: coarse.positions.clone(), ..HexMesh::default() };
        mesh.hexes.push(coarse.hexes[0]);
        let first = mesh.positions.len() as u32;
        let ids: Vec<NodeId> = (0..27)
            .map(|m| {
                let at = [m % 3, m / 3 % 3, m / 9];
                let corner = CORNERS.iter().position(|c| at == c.map(|c| 2 * usize::from(c)));
                corner.map_or(NodeId(first + m as u32), |k| coarse.hexes[1][k])
            })
            .collect();
        mesh.positions.extend((0..27).map(|m| {
            let [x, y, z] = [m % 3, m / 3 % 3, m / 9].map(|c| f64::from(c) / 2.0);
            place(x, y, z)
        }));
        for o in CORNERS {
            mesh.hexes.push(CORNERS.map(|c| {
                let [x, y, z] = [0, 1, 2].map(|i| usize::from(o[i] + c[i]));
                ids[x + 3 * y + 9 * z]
            }));
        }
        let found = check_hexes(&mesh);
        let count = |kind| found.iter().filter(|d| d.kind() == kind).count();
        assert_eq!((count("hangingNode"), count("hangingNodeInFace")), (4, 1), "{found:?}");
        let middle = ids[3 + 9];
        assert!(
            found.iter().any(
                |d| matches!(d, Defect::HangingNodeInFace { node, hex: HexId(0), .. } if *node == middle)
            )
        );
    }
}

#[test]
fn tells_loose_nodes_and_coordinates_that_are_no_numbers() {
    let mut mesh = grid(2);
    mesh.positions.push(Point::new(f64::NAN, 0.0, 0.0));
    assert_eq!(kinds(&mesh), ["notFinite", "unusedNode"]);
}

#[test]
fn defects_speak_and_serialise_with_their_ids() {
    let face = [1, 2, 3, 4].map(NodeId);
    let all = [
        (Defect::HexNodeOutOfRange { hex: HexId(1), node: NodeId(9), nodes: 8 }, "hex 1 names node 9"),
        (Defect::HexRepeatedNode { hex: HexId(1), node: NodeId(2) }, "hex 1 has node 2 twice"),
        (Defect::InvertedHex { hex: HexId(1), corners: 3 }, "hex 1 is inside out at 3 corners"),
        (Defect::SameHexes { hexes: [1, 2].map(HexId) }, "hexes 1 and 2 have the same nodes"),
        (
            Defect::NonManifoldFace { face, hexes: [1, 2, 3].map(HexId).to_vec() },
            "3 hexes have the face 1–2–3–4: 1, 2, 3",
        ),
        (Defect::FaceDisagreement { face, hexes: [1, 2].map(HexId) }, "hexes 1 and 2 lie on the same side"),
        (
            Defect::CrossedFace { face, other: face, hexes: [1, 2].map(HexId) },
            "hex 1 has the face 1–2–3–4, and",
        ),
        (
            Defect::ThreeSharedNodes { faces: [face; 2], hexes: [1, 2].map(HexId) },
            "the faces 1–2–3–4 of hex 1",
        ),
        (Defect::HangingNodeInFace { node: NodeId(7), face, hex: HexId(1) }, "node 7 hangs inside the face"),
        (Defect::NonManifoldRim { edge: [1, 2].map(NodeId), hexes: vec![HexId(4)] }, "1 boundary face is at"),
        (
            Defect::OddLink { node: NodeId(7), euler: 2, boundary: true },
            "the hexes around node 7 do not fill half",
        ),
    ];
    for (defect, words) in all {
        assert!(defect.to_string().starts_with(words), "{defect}");
        assert_eq!(serde_json::to_value(&defect).unwrap()["kind"], defect.kind());
    }
}
