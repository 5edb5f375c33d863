//! Which cells are in: the minimum cut of the paper's energy (section 5.1, equations 5.5 to 5.7).
//!
//! E(S) = ω · sum over cells of E_f + sum over faces between a cell that is in and one that is out of E_s
//!
//! | | in refined domains ([`Energy::Paper`]) | on a whole background ([`Energy::Clipped`]) |
//! |---|---|---|
//! | E_f | ((1 - D / D_m) / 2)^2; D_m: the least D for a cell that is in, the greatest for one that is out | the same with D clipped to ±h, D_m = ∓h |
//! | ω | 1 | 8 |
//! | E_s | ((1 - J) / 2)^2; infinite for J < 0 | no more than 1/4, also for J < 0 |
//!
//! D is the signed distance of a cell's centre, h its edge length; J is the scaled Jacobian of the cell that is in, once
//! the face between the two is projected to the solid. On a whole background the paper's own terms eat the solid: D_m
//! is that of its thickest part, and an infinite E_s forbids every boundary in places.
//!
//! Energies are rounded to whole numbers, so that the cut is exact.

use super::cells::{Cells, NONE};
use super::distance::Distances;
use crate::geometry::Point;
use crate::graph::FlowNetwork;
use crate::mesh::numbering::hex::FACES;
use crate::mesh::quality::scaled_jacobian;
use crate::{Cancelled, Monitor, parallel};

/// Which form of the energy is cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Energy {
    /// As the paper has it: for domains of few layers of cells around the surface.
    Paper,
    /// With distances clipped to an edge length: on whole backgrounds.
    #[default]
    Clipped,
}

/// ω on whole backgrounds.
const OMEGA: f64 = 8.0;
/// The greatest E_s on whole backgrounds.
const ROUGHEST: f64 = 0.25;

/// In edge lengths: on a whole background deeper cells are on their own side in every minimum cut. To put such cells
/// there saves ω |D| / h of E_f for each, and adds E_s at no more than its six faces. (The design holds cells beyond 2 h
/// where they are: the same cut, of a larger network.)
pub(super) const SURE: f64 = 6.0 * ROUGHEST / OMEGA;

/// What is infinite: more than all other terms of some 100 000 cells together.
const INFINITE: f64 = (1 << 20) as f64;
/// Whole numbers for an energy of 1. So 2^27 faces stay below what a network can hold.
const UNIT: f64 = (1 << 15) as f64;

/// Cuts the cells that are `free`; the others stay as `inside` has them. `foot` tells the solid's nearest point.
pub(super) fn cut(
    cells: &Cells<'_>,
    distances: &Distances,
    energy: Energy,
    free: &[u32],
    foot: impl Fn(Point) -> Point + Sync,
    inside: &mut [bool],
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let mut place = vec![NONE; cells.len()];
    free.iter().zip(0u32..).for_each(|(&cell, k)| place[cell as usize] = k);
    let feet = feet(cells, free, foot, monitor)?;
    let smoothness = parallel::try_collect(free.len(), monitor, |k| {
        let cell = free[k] as usize;
        let counts = |other: u32| other != NONE && (place[other as usize] == NONE || cell < other as usize);
        let at = |face: usize| {
            let other = cells.neighbours[cell][face];
            if counts(other) { roughness(cells, &feet, [cell, other as usize], face, energy) } else { [0; 2] }
        };
        std::array::from_fn::<[u64; 2], 6, _>(at)
    })?;
    let fidelity = Fidelity::new(distances, free, energy);
    let mut network = FlowNetwork::new(free.len());
    for (k, &cell) in (0u32..).zip(free) {
        let [mut when_in, mut when_out] = [true, false].map(|is_in| fidelity.of(cell as usize, is_in));
        for (&other, [here, there]) in cells.neighbours[cell as usize].iter().zip(smoothness[k as usize]) {
            match place.get(other as usize) {
                Some(&NONE) if inside[other as usize] => when_out += there,
                Some(&NONE) => when_in += here,
                Some(&other) if k < other => network.add_edge(k, other, here, there),
                // Counted at the other cell, or nothing is there.
                _ => {}
            }
        }
        network.add_terminals(k, when_out, when_in);
    }
    let cut = network.minimum_cut(monitor)?;
    free.iter().zip(cut.source_side).for_each(|(&cell, is_in)| inside[cell as usize] = is_in);
    Ok(())
}

/// The solid's nearest points to the nodes of some cells; of the other nodes themselves.
fn feet(
    cells: &Cells<'_>,
    free: &[u32],
    foot: impl Fn(Point) -> Point + Sync,
    monitor: &dyn Monitor,
) -> Result<Vec<Point>, Cancelled> {
    let mut feet = cells.mesh.positions.clone();
    let mut nodes: Vec<u32> =
        free.iter().flat_map(|&cell| cells.mesh.hexes[cell as usize].map(|n| n.0)).collect();
    parallel::sort(&mut nodes);
    nodes.dedup();
    let found = parallel::try_collect(nodes.len(), monitor, |k| foot(feet[nodes[k] as usize]))?;
    nodes.iter().zip(found).for_each(|(&node, at)| feet[node as usize] = at);
    Ok(feet)
}

/// E_s at a face of the first cell, in whole numbers: if it is in and the second out, and the other way round.
fn roughness(cells: &Cells<'_>, feet: &[Point], pair: [usize; 2], face: usize, energy: Energy) -> [u64; 2] {
    let of_face = FACES[face].map(|corner| cells.mesh.hexes[pair[0]][usize::from(corner)]);
    pair.map(|cell| {
        let nodes = &cells.mesh.hexes[cell];
        let corners = nodes
            .map(|n| if of_face.contains(&n) { feet[n.index()] } else { cells.mesh.positions[n.index()] });
        let jacobian = scaled_jacobian(&corners);
        let rough = (1.0 - jacobian) * (1.0 - jacobian) / 4.0;
        whole(match energy {
            Energy::Paper if jacobian < 0.0 => INFINITE,
            Energy::Paper => rough,
            Energy::Clipped => rough.min(ROUGHEST),
        })
    })
}

fn whole(energy: f64) -> u64 {
    (energy * UNIT).round() as u64
}

/// ω E_f.
struct Fidelity<'a> {
    distances: &'a Distances,
    energy: Energy,
    /// D_m of the paper's form, for cells that are out and for cells that are in.
    extremes: [f64; 2],
}

impl<'a> Fidelity<'a> {
    fn new(distances: &'a Distances, free: &[u32], energy: Energy) -> Self {
        let of_free = free.iter().map(|&cell| distances.signed[cell as usize]);
        let extremes = of_free.fold([0.0, 0.0], |[most, least], d| [f64::max(most, d), f64::min(least, d)]);
        Self { distances, energy, extremes }
    }

    fn of(&self, cell: usize, is_in: bool) -> u64 {
        let (signed, edge) = (self.distances.signed[cell], self.distances.edge[cell]);
        let (omega, ratio) = match self.energy {
            // Where no cell is on a side, its distance is an edge length.
            Energy::Paper => match self.extremes[usize::from(is_in)] {
                0.0 => (1.0, if is_in { -signed / edge } else { signed / edge }),
                extreme => (1.0, signed / extreme),
            },
            Energy::Clipped => (OMEGA, (if is_in { -signed } else { signed } / edge).clamp(-1.0, 1.0)),
        };
        whole(omega * (1.0 - ratio) * (1.0 - ratio) / 4.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Silent;
    use crate::geometry::Aabb;
    use crate::mesh::{GridOptions, HexMesh, hex_grid};

    fn cubes([x, y, z]: [f64; 3]) -> HexMesh {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 1000 };
        hex_grid(Aabb { min: Point::ZERO, max: Point::new(x, y, z) }, &options).unwrap()
    }

    /// The distance from a ball.
    fn signed(center: Point, radius: f64) -> impl Fn(Point) -> f64 + Sync {
        move |p| p.distance(center) - radius
    }

    fn foot(center: Point, radius: f64) -> impl Fn(Point) -> Point + Sync {
        move |p| center + (p - center).normalize() * radius
    }

    /// The energy of a labelling of all cells, equation 5.5 by itself.
    fn energy_of(
        cells: &Cells<'_>,
        distances: &Distances,
        feet: &[Point],
        energy: Energy,
        inside: &[bool],
    ) -> u64 {
        let all: Vec<u32> = (0..cells.len() as u32).collect();
        let fidelity = Fidelity::new(distances, &all, energy);
        let of_cells = (0..cells.len()).map(|c| fidelity.of(c, inside[c]));
        let of_faces = (0..cells.len()).flat_map(|c| (0..6).map(move |face| (c, face))).map(|(c, face)| {
            match cells.neighbours[c][face] {
                other if other != NONE && inside[c] && !inside[other as usize] => {
                    roughness(cells, feet, [c, other as usize], face, energy)[0]
                }
                _ => 0,
            }
        });
        of_cells.sum::<u64>() + of_faces.sum::<u64>()
    }

    #[test]
    fn no_labelling_of_a_tiny_grid_has_less_energy_than_the_cut() {
        let mesh = cubes([3.0, 2.0, 2.0]);
        let cells = Cells::of(&mesh, &Silent).unwrap();
        let all: Vec<u32> = (0..12).collect();
        for (k, energy) in (0..12).zip([Energy::Clipped, Energy::Paper].into_iter().cycle()) {
            let (center, radius) = (Point::new(0.3 + 0.2 * f64::from(k), 0.4, 0.3), 0.9 + 0.1 * f64::from(k));
            let distances = Distances::of(&cells, signed(center, radius), f64::INFINITY, &Silent).unwrap();
            let feet = feet(&cells, &all, foot(center, radius), &Silent).unwrap();
            let mut inside = vec![false; 12];
            cut(&cells, &distances, energy, &all, foot(center, radius), &mut inside, &Silent).unwrap();
            let found = energy_of(&cells, &distances, &feet, energy, &inside);
            let least = (0..1u32 << 12).map(|labels| {
                let inside: Vec<bool> = (0..12).map(|c| labels >> c & 1 == 1).collect();
                energy_of(&cells, &distances, &feet, energy, &inside)
            });
            assert_eq!(least.min(), Some(found), "{k}");
        }
    }

    #[test]
    fn cells_that_are_sure_stay_where_a_cut_of_all_puts_them() {
        let mesh = cubes([7.0, 7.0, 7.0]);
        let cells = Cells::of(&mesh, &Silent).unwrap();
        for k in 0..6 {
            let (center, radius) =
                (Point::splat(3.3) + Point::X * 0.1 * f64::from(k), 2.0 + 0.2 * f64::from(k));
            let distances = Distances::of(&cells, signed(center, radius), f64::INFINITY, &Silent).unwrap();
            let depth = distances.depth();
            let cut_of = |sure: f64| {
                let mut inside: Vec<bool> = depth.iter().map(|&d| d < 0.0).collect();
                let free: Vec<u32> = (0..343).filter(|&c| depth[c as usize].abs() <= sure).collect();
                let foot = foot(center, radius);
                cut(&cells, &distances, Energy::Clipped, &free, foot, &mut inside, &Silent).unwrap();
                inside
            };
            assert_eq!(cut_of(SURE), cut_of(f64::INFINITY));
        }
    }

    #[test]
    fn terms_are_those_of_the_equations() {
        let mesh = cubes([4.0, 1.0, 1.0]);
        let cells = Cells::of(&mesh, &Silent).unwrap();
        let distances = Distances::of(&cells, |p| p.x - 2.2, f64::INFINITY, &Silent).unwrap();
        let all = [0, 1, 2, 3];
        let paper = Fidelity::new(&distances, &all, Energy::Paper);
        // D = -1.7 -.7 .3 1.3, D_m = -1.7 inside and 1.3 outside.
        assert_eq!((paper.of(0, true), paper.of(3, false)), (0, 0));
        assert_eq!(paper.of(2, true), whole((1.0 + 0.3 / 1.7) * (1.0 + 0.3 / 1.7) / 4.0));
        let clipped = Fidelity::new(&distances, &all, Energy::Clipped);
        assert_eq!((clipped.of(0, true), clipped.of(0, false)), (0, whole(8.0)));
        assert_eq!(clipped.of(2, true), whole(8.0 * 1.3 * 1.3 / 4.0));
        // A face that stays flat costs nothing; one that is turned inside out all, or infinitely much.
        let at = |x: f64| move |p: Point| Point::new(x, p.y, p.z);
        let flat = feet(&cells, &all, at(2.2), &Silent).unwrap();
        assert_eq!(roughness(&cells, &flat, [1, 2], 3, Energy::Clipped), [0, 0]);
        let beyond = feet(&cells, &all, at(0.5), &Silent).unwrap();
        assert_eq!(roughness(&cells, &beyond, [1, 2], 3, Energy::Clipped), [whole(ROUGHEST), 0]);
        assert_eq!(roughness(&cells, &beyond, [1, 2], 3, Energy::Paper), [whole(INFINITE), 0]);
    }
}
