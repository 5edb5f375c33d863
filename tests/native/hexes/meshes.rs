//! Meshes to be refined, and surfaces that govern refinement.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use hexmill::geometry::{Aabb, Point};
use hexmill::mesh::numbering::hex::CORNERS;
use hexmill::mesh::topology::hex_boundary;
use hexmill::mesh::{GridOptions, HexMesh, NodeId, hex_grid};

/// `n` unit cubes an axis.
pub fn cubes(n: u32) -> HexMesh {
    let bounds = Aabb { min: Point::ZERO, max: Point::splat(f64::from(n)) };
    let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 1 << 20 };
    hex_grid(bounds, &options).expect("a small grid")
}

/// The unit cells of a box for which `keep` holds, least corners given, with nodes moved by `place`.
pub fn cells(size: [usize; 3], keep: impl Fn([usize; 3]) -> bool, place: impl Fn(Point) -> Point) -> HexMesh {
    let mut ids = BTreeMap::new();
    let mut mesh = HexMesh::default();
    for m in 0..size[0] * size[1] * size[2] {
        let cell = [m % size[0], m / size[0] % size[1], m / size[0] / size[1]];
        if keep(cell) {
            mesh.hexes.push(CORNERS.map(|c| {
                let at = [0, 1, 2].map(|axis| cell[axis] + usize::from(c[axis]));
                *ids.entry(at).or_insert_with(|| {
                    mesh.positions.push(place(Point::from(at.map(|x| x as f64))));
                    NodeId::new(mesh.positions.len() - 1)
                })
            }));
        }
    }
    mesh
}

/// An I-beam along z: two flanges of 5 x 1 cells and a web of 1 x 3, 8 long.
pub fn i_beam() -> HexMesh {
    cells([5, 5, 8], |[x, y, _]| y == 0 || y == 4 || x == 2, |p| p)
}

/// A box of unit cells about z, each layer turned by `angle` against the one below: its sides are warped.
pub fn twisted(size: [usize; 3], angle: f64) -> HexMesh {
    let middle = Point::new(size[0] as f64 / 2.0, size[1] as f64 / 2.0, 0.0);
    cells(
        size,
        |_| true,
        |p| {
            let (sin, cos) = (libm::sin(angle * p.z), libm::cos(angle * p.z));
            let p = p - middle;
            Point::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y, p.z)
        },
    )
}

/// An o-grid: the hexes of `core` and `layers` of hexes out from each of its boundary faces for which `grows` holds,
/// whose nodes go to where `outside` says.
fn o_grid(
    core: HexMesh,
    layers: usize,
    grows: impl Fn(&[Point; 4]) -> bool,
    outside: impl Fn(Point) -> Point,
) -> HexMesh {
    let HexMesh { mut positions, mut hexes, .. } = core;
    let mut copies: BTreeMap<(NodeId, usize), NodeId> = BTreeMap::new();
    for (face, _) in hex_boundary(&hexes) {
        if !grows(&face.map(|n| positions[n.index()])) {
            continue;
        }
        let mut column = vec![face];
        for layer in 1..=layers {
            column.push(face.map(|n| {
                *copies.entry((n, layer)).or_insert_with(|| {
                    let share = layer as f64 / layers as f64;
                    let from = positions[n.index()];
                    positions.push(from.lerp(outside(from), share));
                    NodeId::new(positions.len() - 1)
                })
            }));
        }
        hexes.extend(column.windows(2).map(|two| {
            let ([a, b, c, d], [e, f, g, h]) = (two[0], two[1]);
            [a, b, c, d, e, f, g, h]
        }));
    }
    HexMesh { positions, hexes, ..HexMesh::default() }
}

/// The radius of [`cylinder`] and [`ball`].
pub const RADIUS: f64 = 2.0;

/// A cylinder of radius [`RADIUS`] about z: a square core of 4 x 4 cells in a ring of 2 layers, 4 cells high.
pub fn cylinder() -> HexMesh {
    let core = cells([4, 4, 4], |_| true, |p| Point::new((p.x - 2.0) * 0.5, (p.y - 2.0) * 0.5, p.z * 0.75));
    let is_lateral = |face: &[Point; 4]| {
        [Point::X, Point::Y].iter().any(|&axis| face.iter().all(|p| p.dot(axis).abs() > 0.999))
    };
    o_grid(core, 2, is_lateral, |p| {
        // Along the square's sides the angle grows evenly.
        let (u, v) = if p.x.abs() >= p.y.abs() { (p.x, p.y) } else { (p.y, p.x) };
        let angle = v / u.abs() * TAU / 8.0;
        let (along, across) = (RADIUS * angle.cos() * u.signum(), RADIUS * angle.sin());
        if p.x.abs() >= p.y.abs() { Point::new(along, across, p.z) } else { Point::new(across, along, p.z) }
    })
}

/// A ball of radius [`RADIUS`]: a cube of 4 cells an axis, its sides bulged, in 2 layers.
pub fn ball() -> HexMesh {
    let bulged = |p: Point| {
        let p = (p - Point::splat(2.0)) * 0.5;
        p * (1.0 + 0.15 * (1.0 - p.length_squared() / 3.0))
    };
    let core = cells([4, 4, 4], |_| true, |p| bulged(p) * 0.9);
    o_grid(core, 2, |_| true, |p| p.normalize() * RADIUS)
}

/// A triangle surface.
pub type Triangles = (Vec<Point>, Vec<[u32; 3]>);

/// A closed hull with a sail, as of a submarine: a body of revolution about x from -4 to 4, swollen into a sail above.
pub fn hull() -> Triangles {
    let (around, along) = (32u32, 48u32);
    let at = |i: u32, j: u32| {
        let (x, angle) =
            (-libm::cos(f64::from(i) * TAU / 2.0 / f64::from(along)), f64::from(j) * TAU / f64::from(around));
        let radius = 0.55 * libm::pow(1.0 - x * x, 0.4) * (1.0 - 0.15 * x);
        let up = libm::sin(angle);
        // The sail: a bump on top of the hull.
        let sail = if up > 0.0 {
            0.6 * libm::exp(-libm::pow((x - 0.2) / 0.14, 4.0) - libm::pow((1.0 - up) / 0.15, 2.0))
        } else {
            0.0
        };
        Point::new(4.0 * x, radius * libm::cos(angle), (radius + sail) * up)
    };
    let mut positions = vec![Point::new(-4.0, 0.0, 0.0), Point::new(4.0, 0.0, 0.0)];
    positions.extend((1..along).flat_map(|i| (0..around).map(move |j| at(i, j))));
    let id = |i: u32, j: u32| match i {
        0 => 0,
        i if i == along => 1,
        i => 2 + (i - 1) * around + j % around,
    };
    let quads = (0..along)
        .flat_map(|i| (0..around).map(move |j| [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)]));
    let halves = quads.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    (positions, halves.filter(|[a, b, c]| a != b && b != c && c != a).collect())
}

/// A box of cells around points.
pub fn around(points: &[Point], spacing: f64, margin: f64) -> HexMesh {
    let options = GridOptions { spacing, margin, fitted: false, max_hexes: 1 << 20 };
    hex_grid(Aabb::around(points), &options).expect("a small grid")
}

/// A generator of repeatable numbers from 0 to 1.
pub struct Numbers(pub u64);

impl Numbers {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}
