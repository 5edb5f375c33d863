//! Random shells: bent both ways, from a tenth of an edge to two edges thick, with holes.

use glam::DVec2;
use hexmill::Silent;
use hexmill::geometry::Point;
use hexmill::hexing::{Background, HexedSolid, HexingOptions, hex_solid};
use hexmill::mesh::{NodeId, PolygonMesh};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::parts::assert_sound;

/// Quads along each side of a plate, before it is bent.
const COUNT: i32 = 20;

/// A plate of quads, bent to waves, with a rectangular hole.
#[derive(Clone, Debug)]
struct Plate {
    thickness: f64,
    /// Heights, and how far each wave runs along both axes in one turn.
    waves: [(f64, DVec2); 2],
    /// From one place to another.
    hole: [[i32; 2]; 2],
}

impl Plate {
    fn is_there(&self, at: [i32; 2]) -> bool {
        let [from, to] = self.hole;
        let is_hole = (0..2).all(|k| (from[k]..to[k]).contains(&at[k]));
        at.iter().all(|c| (0..COUNT).contains(c)) && !is_hole
    }

    fn height(&self, at: DVec2) -> f64 {
        self.waves.iter().map(|(height, way)| height * libm::sin(at.dot(*way))).sum()
    }

    /// The place of a node of either side.
    fn place(&self, [x, y]: [i32; 2], side: f64) -> Point {
        let at = DVec2::new(f64::from(x), f64::from(y));
        let slope = |way: DVec2| (self.height(at + way) - self.height(at - way)) / 2e-5;
        let normal = Point::new(-slope(DVec2::X * 1e-5), -slope(DVec2::Y * 1e-5), 1.0).normalize();
        at.extend(self.height(at)) + normal * (0.5 * self.thickness * side)
    }

    fn surface(&self) -> PolygonMesh {
        let mut mesh = PolygonMesh::default();
        let mut push = |corners: [([i32; 2], f64); 4]| {
            let first = mesh.positions.len() as u32;
            mesh.positions.extend(corners.map(|(at, side)| self.place(at, side)));
            mesh.push_face((first..first + 4).map(NodeId));
        };
        for [x, y] in (0..COUNT * COUNT).map(|k| [k % COUNT, k / COUNT]).filter(|&at| self.is_there(at)) {
            let corners = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]];
            push(corners.map(|at| (at, 1.0)));
            let [a, b, c, d] = corners.map(|at| (at, -1.0));
            push([d, c, b, a]);
            for (k, across) in [[x, y - 1], [x + 1, y], [x, y + 1], [x - 1, y]].into_iter().enumerate() {
                if !self.is_there(across) {
                    let (a, b) = (corners[k], corners[(k + 1) % 4]);
                    push([(a, -1.0), (b, -1.0), (b, 1.0), (a, 1.0)]);
                }
            }
        }
        mesh
    }
}

fn plates() -> impl Strategy<Value = Plate> {
    let wave = (0.0..1.0, (-0.3..0.3, -0.3..0.3)).prop_map(|(height, (x, y))| (height, DVec2::new(x, y)));
    let hole = (3..8, 3..8, 4..9, 4..9).prop_map(|(x, y, w, h)| [[x, y], [x + w, y + h]]);
    (-1.0..0.3, prop::array::uniform2(wave), hole).prop_map(|(power, waves, hole)| Plate {
        thickness: libm::exp10(power),
        waves,
        hole,
    })
}

proptest! {
    // The same worlds each time, as of random parts.
    #![proptest_config(ProptestConfig { cases: 24, rng_seed: RngSeed::Fixed(50), ..ProptestConfig::default() })]

    /// They are sound layers of hexes of the solid's kind that do not go through themselves.
    #[test]
    fn random_shells_are_meshed(plate in plates(), edge_length in 0.8..1.3) {
        let options = HexingOptions { edge_length, background: Background::Shell, ..HexingOptions::default() };
        let hexed: HexedSolid = hex_solid(plate.surface(), &options, &Silent).expect("a mesh");
        assert_sound(&hexed, "a shell");
        let result = hexed.report.result();
        prop_assert!(result.euler == result.solid_euler && result.crossings.is_empty());
    }
}
