//! Grids with a refined part, pillowed and filled with the 2-refinement quarter: what the optimiser has to make good.
//!
//! Cells of a grid of unit cubes come in families of 2 x 2 x 2. Between the refined cells and the others stands a
//! layer of flat hexes, each of which becomes seven; a refined cell becomes eight.

use std::collections::BTreeMap;

use hexmill::geometry::Point;
use hexmill::mesh::NodeId;
use hexmill::mesh::numbering::hex::{CORNERS, FACES};

/// A hex mesh with the nodes that may move.
pub struct World {
    pub positions: Vec<Point>,
    pub hexes: Vec<[NodeId; 8]>,
    pub movable: Vec<bool>,
}

/// The thickness of the layer, as a share of an edge.
const PHI: f64 = 0.35;

/// The nodes of the quarter in x, y, z: (0, 0) is the parent's corner, (1, 0) and (0, 1) are the edge nodes, (1, 1) is
/// the face node; z = 0 is the coarse side.
const NODES: [(&str, [f64; 3]); 23] = [
    ("b00", [0., 0., 0.]),
    ("b10", [1., 0., 0.]),
    ("b11", [1., 1., 0.]),
    ("b01", [0., 1., 0.]),
    ("t00", [0., 0., 1.]),
    ("t20", [1., 0., 1.]),
    ("t22", [1., 1., 1.]),
    ("t02", [0., 1., 1.]),
    ("t10", [0.5, 0., 1.]),
    ("t21", [1., 0.5, 1.]),
    ("t12", [0.5, 1., 1.]),
    ("t01", [0., 0.5, 1.]),
    ("t11", [0.5, 0.5, 1.]),
    ("s1", [0.5, 0., 0.5]),
    ("s2", [1., 0., 0.5]),
    ("r1", [0., 0.5, 0.5]),
    ("r2", [0., 1., 0.5]),
    ("c1", [1., 1., 0.25]),
    ("c2", [1., 1., 0.7]),
    ("p1", [1., 0.5, 0.375]),
    ("p2", [1., 0.5, 0.75]),
    ("q", [0.5, 1., 0.8]),
    ("w", [0.5, 0.5, 0.8]),
];

/// The hexes of the quarter, in the order of VTK_HEXAHEDRON.
const HEXES: [[&str; 8]; 7] = [
    ["b00", "b10", "b11", "b01", "r1", "p1", "c1", "r2"],
    ["r1", "p1", "c1", "r2", "w", "p2", "c2", "q"],
    ["b00", "b10", "p1", "r1", "s1", "s2", "p2", "w"],
    ["b00", "s1", "w", "r1", "t00", "t10", "t11", "t01"],
    ["s1", "s2", "p2", "w", "t10", "t20", "t21", "t11"],
    ["r1", "w", "q", "r2", "t01", "t11", "t12", "t02"],
    ["w", "p2", "c2", "q", "t11", "t21", "t22", "t12"],
];

/// A grid of `n` cells a side, where `refined` holds for the families (by their place, from 0 to n / 2) to refine.
/// The refined part touches itself at faces alone.
pub fn pillowed(n: usize, refined: impl Fn([usize; 3]) -> bool) -> World {
    let mut grid = Grid { n, positions: Vec::new(), welded: BTreeMap::new() };
    for i in 0..(n + 1).pow(3) {
        let [x, y, z] = grid.place(i as u32).map(|x| x as f64);
        grid.positions.push(Point::new(x, y, z));
    }
    let cells: Vec<[usize; 3]> = (0..n.pow(3)).map(|i| [i % n, i / n % n, i / (n * n)]).collect();
    let is_refined = |c: [usize; 3]| refined(c.map(|x| x / 2));
    // The interface, as faces of refined cells seen from outside.
    let mut interface = Vec::new();
    for &cell in cells.iter().filter(|&&c| is_refined(c)) {
        for (face, step) in FACES.into_iter().zip(STEPS) {
            if grid.neighbour(cell, step).is_some_and(|c| !is_refined(c)) {
                interface.push(face.map(|k| grid.corner(cell, k)));
            }
        }
    }
    let copies = grid.offset_interface(&interface, &cells, &is_refined);
    let mut hexes = Vec::new();
    for &cell in &cells {
        let corners: [u32; 8] = std::array::from_fn(|k| grid.corner(cell, k as u8));
        if is_refined(cell) {
            grid.split(corners, &mut hexes);
        } else {
            hexes.push(corners.map(|c| copies.get(&c).copied().unwrap_or(c)));
        }
    }
    let mut layer = vec![false; hexes.len()];
    for face in interface {
        grid.quarter(face, &copies, &mut hexes);
    }
    layer.resize(hexes.len(), true);
    let movable = rings(&hexes, &layer, grid.positions.len());
    let hexes = hexes.into_iter().map(|hex| hex.map(NodeId)).collect();
    World { positions: grid.positions, hexes, movable }
}

/// The nodes of the layer's cells and of two rings of cells around.
fn rings(hexes: &[[u32; 8]], layer: &[bool], nodes: usize) -> Vec<bool> {
    let mut reached = layer.to_vec();
    let mut movable = vec![false; nodes];
    for _ in 0..3 {
        for (hex, _) in hexes.iter().zip(&reached).filter(|(_, r)| **r) {
            hex.iter().for_each(|&n| movable[n as usize] = true);
        }
        reached = hexes.iter().map(|hex| hex.iter().any(|&n| movable[n as usize])).collect();
    }
    movable
}

/// The way through each face of the reference hex.
const STEPS: [[i32; 3]; 6] = [[0, 0, -1], [0, 0, 1], [0, -1, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0]];

struct Grid {
    n: usize,
    positions: Vec<Point>,
    /// Nodes by what they divide: sorted nodes, and a number where there are several.
    welded: BTreeMap<(Vec<u32>, u8), u32>,
}

impl Grid {
    fn place(&self, node: u32) -> [usize; 3] {
        let (i, m) = (node as usize, self.n + 1);
        [i % m, i / m % m, i / (m * m)]
    }

    fn corner(&self, cell: [usize; 3], k: u8) -> u32 {
        let [x, y, z] = [0, 1, 2].map(|i| cell[i] + usize::from(CORNERS[usize::from(k)][i]));
        (x + (self.n + 1) * (y + (self.n + 1) * z)) as u32
    }

    fn neighbour(&self, cell: [usize; 3], step: [i32; 3]) -> Option<[usize; 3]> {
        let at = [0, 1, 2].map(|i| cell[i] as i32 + step[i]);
        at.iter().all(|x| (0..self.n as i32).contains(x)).then(|| at.map(|x| x as usize))
    }

    fn node(&mut self, divided: &[u32], which: u8, at: Point) -> u32 {
        let mut key = divided.to_vec();
        key.sort_unstable();
        *self.welded.entry((key, which)).or_insert_with(|| {
            self.positions.push(at);
            self.positions.len() as u32 - 1
        })
    }

    fn middle(&mut self, divided: &[u32]) -> u32 {
        if let [node] = divided {
            return *node;
        }
        let at = divided.iter().map(|&n| self.positions[n as usize]).sum::<Point>() / divided.len() as f64;
        self.node(divided, 0, at)
    }

    /// Copies of the interface's nodes for the coarse side, moved into it, along the domain's boundary.
    fn offset_interface(
        &mut self,
        interface: &[[u32; 4]],
        cells: &[[usize; 3]],
        is_refined: &impl Fn([usize; 3]) -> bool,
    ) -> BTreeMap<u32, u32> {
        let mut towards: BTreeMap<u32, Point> =
            interface.as_flattened().iter().map(|&n| (n, Point::ZERO)).collect();
        for &cell in cells.iter().filter(|&&c| !is_refined(c)) {
            let centre = Point::from(cell.map(|x| x as f64 + 0.5));
            for k in 0..8 {
                let node = self.corner(cell, k);
                if let Some(sum) = towards.get_mut(&node) {
                    *sum += centre - self.positions[node as usize];
                }
            }
        }
        let mut copies = BTreeMap::new();
        for (node, sum) in towards {
            let place = self.place(node);
            let inside: [f64; 3] =
                std::array::from_fn(|i| if place[i] == 0 || place[i] == self.n { 0.0 } else { sum[i] });
            let at = self.positions[node as usize] + PHI * Point::from(inside).normalize_or_zero();
            copies.insert(node, self.positions.len() as u32);
            self.positions.push(at);
        }
        copies
    }

    /// Eight hexes of one.
    fn split(&mut self, corners: [u32; 8], hexes: &mut Vec<[u32; 8]>) {
        for child in CORNERS {
            hexes.push(CORNERS.map(|of_child| {
                // The corners of the cell that the node divides: those that agree where it is at an end.
                let at = [0, 1, 2].map(|i| child[i] + of_child[i]);
                let divided: Vec<u32> = (0..8)
                    .filter(|&k| (0..3).all(|i| at[i] == 1 || at[i] == 2 * CORNERS[k][i]))
                    .map(|k| corners[k])
                    .collect();
                self.middle(&divided)
            }));
        }
    }

    /// Seven hexes between an interface face, seen from the coarse side, and its copy.
    fn quarter(&mut self, face: [u32; 4], copies: &BTreeMap<u32, u32>, hexes: &mut Vec<[u32; 8]>) {
        let odd = |n: u32| self.place(n).iter().filter(|&x| x % 2 == 1).count();
        let start = face.iter().position(|&n| odd(n) == 0).expect("a corner of a family");
        let [k, a, f, b] = [0, 1, 2, 3].map(|i| face[(start + i) % 4]);
        // All quarters around a face node choose the pair of edge nodes that holds the least of the four.
        let along = |n: u32| n.abs_diff(f);
        let (ex, ey, mirrored) = if along(a) > along(b) { (a, b, true) } else { (b, a, false) };
        let top = [k, ex, f, ey];
        let bottom = top.map(|n| copies[&n]);
        let mut ids = BTreeMap::new();
        for (name, [x, y, z]) in NODES {
            let weights = [(1. - x) * (1. - y), x * (1. - y), x * y, (1. - x) * y];
            let on = |side: [u32; 4]| -> Vec<u32> {
                side.into_iter().zip(weights).filter(|(_, w)| *w > 0.0).map(|(n, _)| n).collect()
            };
            let at = |side: [u32; 4]| -> Point {
                side.into_iter().zip(weights).map(|(n, w)| self.positions[n as usize] * w).sum()
            };
            let point = at(bottom) * (1.0 - z) + at(top) * z;
            let id = if z == 0.0 {
                self.middle(&on(bottom))
            } else if z == 1.0 {
                self.middle(&on(top))
            } else {
                let divided = [on(bottom), on(top)].concat();
                self.node(
                    &divided,
                    u8::from(name.ends_with('2') && (name.starts_with('c') || name.starts_with('p'))),
                    point,
                )
            };
            ids.insert(name, id);
        }
        for hex in HEXES {
            let hex = hex.map(|name| ids[name]);
            hexes.push(if mirrored { [0, 3, 2, 1, 4, 7, 6, 5].map(|i| hex[i]) } else { hex });
        }
    }
}
