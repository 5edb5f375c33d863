//! Small meshes of cubes whose boundary quads are told which surface they are.

use std::collections::BTreeMap;

use super::super::correspondence::{Anchor, Correspondence};
use super::SheetReport;
use super::boundary::{Boundary, ascending};
use super::groups::Groups;
use crate::Silent;
use crate::geometry::Point;
use crate::mesh::numbering::hex::CORNERS;
use crate::mesh::topology::hex_boundary;
use crate::mesh::{HexMesh, NodeId};
use crate::solid::{CornerId, CurveId, SurfaceId};

/// A cube of edge 1 at each of the given places, with the nodes that they use.
pub(in crate::hexing) fn voxels(cubes: &[[i32; 3]]) -> HexMesh {
    let mut ids: BTreeMap<[i32; 3], NodeId> = BTreeMap::new();
    let corner = |cube: &[i32; 3], k: usize| -> [i32; 3] {
        std::array::from_fn(|axis| cube[axis] + i32::from(CORNERS[k][axis]))
    };
    for cube in cubes {
        (0..8).for_each(|k| {
            ids.insert(corner(cube, k), NodeId(0));
        });
    }
    for (id, node) in ids.values_mut().enumerate() {
        *node = NodeId::new(id);
    }
    HexMesh {
        positions: ids.keys().map(|p| Point::from(p.map(f64::from))).collect(),
        hexes: cubes.iter().map(|cube| std::array::from_fn(|k| ids[&corner(cube, k)])).collect(),
        ..Default::default()
    }
}

/// The cubes in a box of n x n x n of which `wanted` says so by their middle, seen from the middle of the box.
pub(in crate::hexing) fn cubes(n: i32, wanted: impl Fn(Point) -> bool) -> Vec<[i32; 3]> {
    let all = (0..n * n * n).map(|i| [i / (n * n), i / n % n, i % n]);
    let middle = |cube: &[i32; 3]| Point::from(cube.map(f64::from)) + 0.5 - f64::from(n) / 2.0;
    all.filter(|cube| wanted(middle(cube))).collect()
}

/// What the mesh stands for, where `surface` tells each boundary quad's surface by its middle and its unit normal.
/// There is a curve for each pair of surfaces that meet, in the order of pairs, and a corner for each node with three
/// surfaces or more, in the order of nodes.
pub(in crate::hexing) fn told(mesh: &HexMesh, surface: impl Fn(Point, Point) -> u32) -> Correspondence {
    let mut faces = Vec::new();
    let mut of_edge: BTreeMap<[NodeId; 2], Vec<SurfaceId>> = BTreeMap::new();
    let mut of_node = vec![Vec::new(); mesh.positions.len()];
    for (quad, _) in hex_boundary(&mesh.hexes) {
        let [a, b, c, d] = quad.map(|n| mesh.positions[n.index()]);
        let surface = SurfaceId(surface((a + b + c + d) / 4.0, (c - a).cross(d - b).normalize()));
        faces.push((quad, surface));
        for k in 0..4 {
            of_edge.entry(ascending([quad[k], quad[(k + 1) % 4]])).or_default().push(surface);
            of_node[quad[k].index()].push(surface);
        }
    }
    of_edge.values_mut().for_each(|surfaces| surfaces.sort_unstable());
    of_edge.retain(|_, surfaces| surfaces.windows(2).any(|pair| pair[0] != pair[1]));
    let mut curves: Vec<&Vec<SurfaceId>> = of_edge.values().collect();
    curves.sort_unstable();
    curves.dedup();
    let curve = |surfaces: &Vec<SurfaceId>| CurveId::new(curves.binary_search(&surfaces).unwrap());
    let edges: Vec<([NodeId; 2], CurveId)> =
        of_edge.iter().map(|(&ends, surfaces)| (ends, curve(surfaces))).collect();
    let mut corners = 0;
    let anchor = |(n, mut surfaces): (usize, Vec<SurfaceId>)| {
        surfaces.sort_unstable();
        surfaces.dedup();
        match *surfaces {
            [] => Anchor::Inside,
            [surface] => Anchor::Surface(surface),
            [_, _] => Anchor::Curve(
                edges
                    .iter()
                    .find(|(ends, _)| ends.contains(&NodeId::new(n)))
                    .expect("surfaces meet at edges")
                    .1,
            ),
            _ => {
                corners += 1;
                Anchor::Corner(CornerId(corners - 1))
            }
        }
    };
    let anchors = of_node.into_iter().enumerate().map(anchor).collect();
    Correspondence { anchors, edges, faces, ..Default::default() }
}

/// By the normal: the six sides of a box.
pub(in crate::hexing) fn side_of_box(_: Point, normal: Point) -> u32 {
    let axis = (0..3).find(|&k| normal[k].abs() > 0.5).expect("an axis");
    2 * axis as u32 + u32::from(normal[axis] > 0.0)
}

/// Inserts sheets where each surface is of the given group; curves within a group are flat.
pub(in crate::hexing) fn insert_in_groups(
    mesh: &mut HexMesh,
    on: &mut Correspondence,
    group_of_surface: &[u32],
) -> SheetReport {
    let mut is_flat = vec![false; on.edges.iter().map(|&(_, curve)| curve.index() + 1).max().unwrap_or(0)];
    let boundary = Boundary::of(mesh, on);
    let edges = boundary.edges(|_| true);
    for &(ends, curve) in &on.edges {
        if let Some(quads) = edges.quads(ends) {
            let [p, q] = quads.map(|q| group_of_surface[boundary.surface[q as usize].index()]);
            is_flat[curve.index()] |= p == q;
        }
    }
    super::insert(mesh, on, Groups::given(group_of_surface, &is_flat), &Silent).expect("nobody stops it")
}
