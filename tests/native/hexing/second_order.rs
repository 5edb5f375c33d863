//! Hexes of the second order, curved along the solid.

use hexmill::Silent;
use hexmill::geometry::Point;
use hexmill::hexing::{HexedSolid, HexingOptions, hex_solid};
use hexmill::mesh::numbering::hex::FACES;
use hexmill::mesh::quality::second_order_jacobian;
use hexmill::mesh::topology::hex_boundary;
use hexmill::mesh::{NodeId, PolygonMesh, SecondOrder, SecondOrderHex};

/// Facets around the cylinder: so many that chords of the mesh are far longer.
const FACETS: u32 = 240;

/// Adds a cylinder of radius 1 and height 2, its foot at `at`.
fn push_cylinder(mesh: &mut PolygonMesh, at: Point) {
    let first = mesh.positions.len() as u32;
    for z in [0.0, 2.0] {
        mesh.positions.extend((0..FACETS).map(|k| {
            let (sin, cos) = libm::sincos(f64::from(k) / f64::from(FACETS) * std::f64::consts::TAU);
            at + Point::new(cos, sin, z)
        }));
    }
    mesh.push_face((0..FACETS).rev().map(|k| NodeId(first + k)));
    mesh.push_face((0..FACETS).map(|k| NodeId(first + FACETS + k)));
    for k in 0..FACETS {
        let next = (k + 1) % FACETS;
        mesh.push_face([k, next, next + FACETS, k + FACETS].map(|n| NodeId(first + n)));
    }
}

fn hexed(surface: &PolygonMesh, hex: SecondOrderHex) -> (HexedSolid, SecondOrder) {
    let options = HexingOptions { edge_length: 0.4, second_order: Some(hex), ..HexingOptions::default() };
    let hexed = hex_solid(surface, &options, &Silent).expect("a mesh");
    let second_order = hexed.second_order.clone().expect("it was asked for");
    (hexed, second_order)
}

/// Where a node is: at a corner of the mesh, or one of the others.
fn place(hexed: &HexedSolid, second_order: &SecondOrder, node: NodeId) -> Point {
    let corners = &hexed.mesh.positions;
    let other = |n: usize| second_order.positions[n - corners.len()];
    corners.get(node.index()).copied().unwrap_or_else(|| other(node.index()))
}

/// The 27 nodes of a hex; of 20, with the others where those around have them.
fn lattice(hexed: &HexedSolid, second_order: &SecondOrder, h: usize) -> [Point; 27] {
    let mut nodes = [Point::ZERO; 27];
    for (node, &id) in nodes.iter_mut().zip(second_order.nodes_of(h)) {
        *node = place(hexed, second_order, id);
    }
    if second_order.hex == SecondOrderHex::Hex20 {
        // The faces in VTK's order, x = 0 first, by their numbers here.
        for (k, face) in [5, 3, 2, 4, 0, 1].into_iter().enumerate() {
            let side = second_order.nodes_of_side((6 * h + face) as u32);
            let sum = |of: &[NodeId]| of.iter().map(|&n| place(hexed, second_order, n)).sum::<Point>();
            assert_eq!(side[0], hexed.mesh.hexes[h][usize::from(FACES[face][0])]);
            nodes[20 + k] = sum(&side[4..]) * 0.5 - sum(&side[..4]) * 0.25;
        }
        let sum = |from: usize, to: usize| nodes[from..to].iter().copied().sum::<Point>();
        nodes[26] = sum(8, 20) * 0.25 - sum(0, 8) * 0.25;
    }
    nodes
}

#[test]
fn a_cylinder_gets_curved_edges_and_positive_hexes() {
    let mut surface = PolygonMesh::default();
    push_cylinder(&mut surface, Point::ZERO);
    for hex in [SecondOrderHex::Hex20, SecondOrderHex::Hex27] {
        let (hexed, second_order) = hexed(&surface, hex);
        let report = hexed.report.second_order.expect("it was asked for");
        let (edges, faces) = (2 * hexed.faces.len(), hexed.faces.len());
        let on_boundary = if hex == SecondOrderHex::Hex20 { edges } else { edges + faces };
        assert_eq!((report.on_solid, report.yielded), (on_boundary, 0), "{hex:?}");
        assert_eq!(report.nodes, second_order.positions.len());
        for h in 0..hexed.mesh.hexes.len() {
            let bound = second_order_jacobian(&lattice(&hexed, &second_order, h));
            assert!(bound.lower > 0.0, "{hex:?}, hex {h}: {bound:?}");
        }
        // The chords of the mesh stay within the cylinder; the nodes between do not.
        let sagitta = 1.0 - libm::cos(std::f64::consts::PI / f64::from(FACETS));
        let mut most: f64 = 0.0;
        for (side, _) in boundary_sides(&hexed) {
            for node in second_order.nodes_of_side(side) {
                let p = place(&hexed, &second_order, node);
                let off_side = 1.0 - p.truncate().length();
                let is_on = |off: f64| (-1e-9..=sagitta + 1e-9).contains(&off);
                assert!(is_on(off_side) || p.z.abs().min((p.z - 2.0).abs()) < 1e-9, "{p}");
                most = most.max(p.truncate().length());
            }
        }
        assert!(most > 1.0 - sagitta, "some are at the rim");
    }
}

/// The sides on the boundary.
fn boundary_sides(hexed: &HexedSolid) -> Vec<(u32, [NodeId; 4])> {
    let hexes = &hexed.mesh.hexes;
    let boundary: std::collections::BTreeSet<[NodeId; 4]> =
        hex_boundary(hexes).into_iter().map(|(quad, _)| sorted(quad)).collect();
    let sides =
        (0..6 * hexes.len() as u32).map(|side| (side, hexmill::mesh::topology::side_nodes(hexes, side)));
    sides.filter(|(_, quad)| boundary.contains(&sorted(*quad))).collect()
}

fn sorted(mut quad: [NodeId; 4]) -> [NodeId; 4] {
    quad.sort_unstable();
    quad
}

#[test]
fn bodies_keep_their_nodes_to_themselves() {
    let mut surface = PolygonMesh::default();
    push_cylinder(&mut surface, Point::ZERO);
    push_cylinder(&mut surface, Point::new(5.0, 0.0, 0.0));
    let (hexed, second_order) = hexed(&surface, SecondOrderHex::Hex27);
    assert_eq!(hexed.report.bodies.len(), 2);
    for h in 0..hexed.mesh.hexes.len() {
        let nodes = lattice(&hexed, &second_order, h);
        assert_eq!(nodes[..8], hexed.mesh.hexes[h].map(|n| hexed.mesh.positions[n.index()]));
        assert!(second_order_jacobian(&nodes).lower > 0.0, "hex {h}");
    }
    let all: std::collections::BTreeSet<NodeId> = second_order.nodes.iter().copied().collect();
    assert_eq!(all.len(), hexed.mesh.positions.len() + second_order.positions.len(), "each node is used");
}
