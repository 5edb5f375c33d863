//! Quads in the middle between the sides of a shell.
//!
//! ```text
//!   +---+---+---  .             +---+---+---  .
//!   |   |   |      .            |   |   |   \__.       Those between cells that are nearer to one side and those nearer to the
//!   +---+---+       .  rim      +---+---+____\_.       other end in steps at the rim. A ring of quads leads from these to the
//!   |   |            .          |   |   \______\.      rim, with one more where the rim turns outwards: no corner of a quad
//!   +---+             .         +---+____\______\     is straight there.
//! ```

use super::sides::{Sides, Turn};
use crate::geometry::Point;
use crate::hexing::core::{Cells, NO_CELL, make_manifold};
use crate::mesh::numbering::hex::FACES;
use crate::mesh::topology::{Bins, EdgeUses, Edges, edge_ids};
use crate::mesh::{HexMesh, NodeId, QuadMesh};
use crate::{Cancelled, Monitor, Stage, parallel};

const SHELL: Stage = Stage("shell");

/// The share of that stage that is done when quads are there, and smoothed.
const SMOOTH: f64 = 0.3;

/// Share of an edge: cells that are as far from one side as from the other are nearer to the second by this, lest rounding
/// decides.
const BIAS: f64 = 1e-6;

/// Edges: how wide the ring is at least, about.
const MARGIN: f64 = 0.15;

/// Edges: what each quad at a node, or each that it lacks to so many, counts as farther from a corner of the rim, and what is too far
/// from one.
const PER_QUAD: f64 = 0.5;
const WHOLE: u32 = 4;
const AT_CORNER: f64 = 3.0;

/// Rounds of smoothing; and of those before, at the rim alone.
const ROUNDS: usize = 10;
const ROUNDS_AT_RIM: usize = 30;

/// The quads, of which all nodes are in the middle between the sides, and those of the rim on it. As seen from the first side their
/// corners go round to the left. The edges are about as long as those of the grid, which reaches beyond the shell by a cell.
pub(super) fn quads_between(
    sides: &Sides,
    grid: &HexMesh,
    edge: f64,
    monitor: &dyn Monitor,
) -> Result<QuadMesh, Cancelled> {
    monitor.checkpoint(SHELL, 0.0)?;
    let mut quads = faces_between(sides, grid, edge, monitor)?;
    monitor.checkpoint(SHELL, SMOOTH / 2.0)?;
    trim(&mut quads, monitor)?;
    let mut mesh = compact(&grid.positions, quads);
    let inner = mesh.positions.len();
    let stays = add_ring(&mut mesh, sides, edge, monitor)?;
    smooth(&mut mesh, inner, &stays, sides, monitor)?;
    monitor.checkpoint(SHELL, 1.0)?;
    Ok(mesh)
}

/// The faces between cells that are nearer to one side and those that are nearer to the other, away from the rim.
fn faces_between(
    sides: &Sides,
    grid: &HexMesh,
    edge: f64,
    monitor: &dyn Monitor,
) -> Result<Vec<[NodeId; 4]>, Cancelled> {
    let cells = Cells::of(grid, monitor)?;
    let depth = parallel::try_collect(cells.len(), monitor, |cell| {
        let [first, second] = sides.distances(cells.barycentre(cell));
        BIAS + (second - first) / (2.0 * edge)
    })?;
    let mut is_below: Vec<bool> = depth.iter().map(|&depth| depth < 0.0).collect();
    make_manifold(&cells, &depth, &mut is_below, monitor)?;
    parallel::try_gather(cells.len(), monitor, |cell, quads: &mut Vec<[NodeId; 4]>| {
        let beside = FACES.iter().zip(&cells.neighbours[cell]).filter(|_| is_below[cell]);
        for (face, _) in beside.filter(|&(_, &other)| other != NO_CELL && !is_below[other as usize]) {
            let quad = face.map(|corner| grid.hexes[cell][usize::from(corner)]);
            let centre = quad.iter().map(|n| grid.positions[n.index()]).sum::<Point>() / 4.0;
            quads.extend((!sides.is_at_rim(centre, MARGIN * edge)).then_some(quad));
        }
    })
}

/// Takes away quads that hang together with others at one edge alone, or at a node where more do: then rims are loops.
fn trim(quads: &mut Vec<[NodeId; 4]>, monitor: &dyn Monitor) -> Result<(), Cancelled> {
    loop {
        monitor.proceed()?;
        let nodes = quads.as_flattened().iter().map(|n| n.index() + 1).max().unwrap_or(0);
        let mesh = QuadMesh { positions: vec![Point::ZERO; nodes], quads: std::mem::take(quads) };
        let edges = Edges::monitored(&mesh, monitor)?;
        let uses = EdgeUses::monitored(&edges, monitor)?;
        let is_rim = |k: usize| uses.count(edges.of_corner[k]) == 1;
        let mut ends = vec![0; nodes];
        let rim = edge_ids(&edges).filter(|&e| uses.count(e) == 1);
        rim.for_each(|e| edges.ends[e.index()].iter().for_each(|n| ends[n.index()] += 1));
        let is_kept = |q: usize| {
            let sides_at_rim = (4 * q..4 * q + 4).filter(|&k| is_rim(k)).count();
            // Of those that meet at a node alone the ones at its rim go.
            let is_pinched = (0..4).any(|k| {
                ends[mesh.quads[q][k].index()] > 2 && (is_rim(4 * q + k) || is_rim(4 * q + (k + 3) % 4))
            });
            sides_at_rim < 3 && !is_pinched
        };
        *quads = (0..mesh.quads.len()).filter(|&q| is_kept(q)).map(|q| mesh.quads[q]).collect();
        if quads.len() == mesh.quads.len() {
            return Ok(());
        }
    }
}

/// Adds a ring of quads between the edges that one quad has and the rim; where that turns outwards one more. Returns which nodes
/// stay where they are.
fn add_ring(
    mesh: &mut QuadMesh,
    sides: &Sides,
    edge: f64,
    monitor: &dyn Monitor,
) -> Result<Vec<bool>, Cancelled> {
    let edges = Edges::monitored(mesh, monitor)?;
    let uses = EdgeUses::monitored(&edges, monitor)?;
    let rim: Vec<[usize; 2]> = edge_ids(&edges)
        .filter(|&e| uses.count(e) == 1)
        .map(|e| edges.ends[e.index()].map(NodeId::index))
        .collect();
    let turns = turning_nodes(mesh, &rim, sides, edge);
    // The nodes before and after each along the rim.
    let mut beside = vec![None; mesh.positions.len()];
    for &[a, b] in &rim {
        beside[a].get_or_insert([a, a])[1] = b;
        beside[b].get_or_insert([b, b])[0] = a;
    }
    // And those beyond it, of the edges before and after it.
    let mut beyond = vec![[NodeId(0); 2]; mesh.positions.len()];
    let mut stays = vec![false; mesh.positions.len()];
    for (n, beside) in beside.iter().enumerate() {
        let Some(beside) = beside else { continue };
        let here = mesh.positions[n];
        let between = beside.map(|other| here.midpoint(mesh.positions[other]));
        let mut add = |place: Point, is_corner: bool| {
            stays.push(is_corner);
            mesh.positions.push(if is_corner { place } else { sides.foot_on_rim(place).unwrap_or(place) });
            NodeId::new(mesh.positions.len() - 1)
        };
        beyond[n] = match turns[n] {
            None => [add(here, false); 2],
            Some(Turn { place, is_outward: false }) => [add(place, true); 2],
            Some(Turn { place: corner, is_outward: true }) => {
                let [before, after] = between.map(|place| add(place, false));
                mesh.quads.push([NodeId::new(n), before, add(corner, true), after]);
                [before, after]
            }
        };
    }
    mesh.quads.extend(rim.iter().map(|&[a, b]| [NodeId::new(b), NodeId::new(a), beyond[a][1], beyond[b][0]]));
    Ok(stays)
}

/// For each node whether the rim turns beside it: of those near that place one that few quads have, if it turns outwards, else one
/// that many have.
fn turning_nodes(mesh: &QuadMesh, rim: &[[usize; 2]], sides: &Sides, edge: f64) -> Vec<Option<Turn>> {
    let mut quads = vec![0_u32; mesh.positions.len()];
    mesh.quads.as_flattened().iter().for_each(|n| quads[n.index()] += 1);
    let mut turns = vec![None; mesh.positions.len()];
    for &corner in sides.corners() {
        let spare = |n: usize| if corner.is_outward { quads[n] } else { WHOLE - quads[n].min(WHOLE) };
        let cost =
            |n: usize| mesh.positions[n].distance(corner.place) / edge + PER_QUAD * f64::from(spare(n));
        let free = rim.iter().map(|&[a, _]| a).filter(|&n| turns[n].is_none());
        let nearest = free.min_by(|&a, &b| cost(a).total_cmp(&cost(b)).then(a.cmp(&b)));
        if let Some(n) = nearest.filter(|&n| cost(n) < AT_CORNER) {
            turns[n] = Some(corner);
        }
    }
    turns
}

/// Moves nodes that do not stay to the middle of those around them, and to the middle between the sides; those from `inner` on along
/// the rim, and first of all, since they may be out of order there.
fn smooth(
    mesh: &mut QuadMesh,
    inner: usize,
    stays: &[bool],
    sides: &Sides,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let edges = Edges::monitored(mesh, monitor)?;
    let ends = edges.ends.as_flattened();
    let count = mesh.positions.len();
    let at = Bins::monitored(count, ends.len(), |k| ends[k].index(), monitor)?;
    let moved = |places: &[Point], n: usize| {
        if stays[n] {
            return places[n];
        }
        let others = at.at(n).iter().map(|&k| ends[k as usize ^ 1].index());
        let (mut sum, mut count) = (places[n], 1.0);
        for other in others.filter(|&other| n < inner || other >= inner) {
            sum += places[other];
            count += 1.0;
        }
        let place = sum / count;
        let place = if n < inner { place } else { sides.foot_on_rim(place).unwrap_or(place) };
        let [a, b] = sides.feet(place);
        a.midpoint(b)
    };
    for round in 0..ROUNDS_AT_RIM + ROUNDS {
        let first = if round < ROUNDS_AT_RIM { inner } else { 0 };
        let done = round.saturating_sub(ROUNDS_AT_RIM) as f64 / ROUNDS as f64;
        monitor.checkpoint(SHELL, SMOOTH + (1.0 - SMOOTH) * done)?;
        let places = &mesh.positions;
        let moved = parallel::try_collect(count - first, monitor, |k| moved(places, first + k))?;
        mesh.positions[first..].copy_from_slice(&moved);
    }
    Ok(())
}

/// The quads with the nodes that they use.
fn compact(positions: &[Point], mut quads: Vec<[NodeId; 4]>) -> QuadMesh {
    let mut is_used = vec![false; positions.len()];
    quads.as_flattened().iter().for_each(|n| is_used[n.index()] = true);
    let used: Vec<usize> = (0..positions.len()).filter(|&n| is_used[n]).collect();
    let mut place = vec![NodeId(0); positions.len()];
    used.iter().enumerate().for_each(|(k, &n)| place[n] = NodeId::new(k));
    quads.as_flattened_mut().iter_mut().for_each(|n| *n = place[n.index()]);
    QuadMesh { positions: used.into_iter().map(|n| positions[n]).collect(), quads }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::grid::{AlignedGrid, grid_around};
    use super::*;
    use crate::Silent;
    use crate::mesh::check_quads;
    use crate::solid::testing::{bent, hollow_ball, solid};

    fn quads(surface: &crate::mesh::PolygonMesh, edge: f64) -> (Sides, QuadMesh) {
        let solid = solid(surface);
        let sides = Sides::of(&solid, &Silent).unwrap().unwrap();
        let grid = grid_around(&solid, &AlignedGrid::new(edge), 1.01, &Silent).unwrap();
        let mesh = quads_between(&sides, &grid, edge, &Silent).unwrap();
        assert_eq!(check_quads(&mesh), []);
        for &p in &mesh.positions {
            let [a, b] = sides.distances(p);
            assert!((a - b).abs() < 0.02 * (a + b), "{p} {a} {b}");
        }
        (sides, mesh)
    }

    /// How many quads meet at each edge, and at each node.
    fn uses(mesh: &QuadMesh) -> (Vec<usize>, Vec<usize>) {
        let edges = Edges::of_quads(mesh);
        let uses = EdgeUses::of(&edges);
        let mut at_node = vec![0; mesh.positions.len()];
        mesh.quads.as_flattened().iter().for_each(|n| at_node[n.index()] += 1);
        (edge_ids(&edges).map(|e| uses.count(e)).collect(), at_node)
    }

    #[test]
    fn quads_end_at_the_rim_and_each_corner_has_one() {
        for thickness in [0.01, 0.4] {
            let (sides, mesh) = quads(&bent(16, thickness, |x, y| -0.03 * (x * x + y * y)), 1.0);
            let (at_edge, at_node) = uses(&mesh);
            assert!(at_edge.iter().all(|&count| count == 1 || count == 2));
            let on_rim = |p: &Point| sides.foot_on_rim(*p).unwrap().distance(*p) < 0.02;
            let at_rim = mesh.positions.iter().filter(|p| on_rim(p)).count();
            assert_eq!(at_rim, at_edge.iter().filter(|&&count| count == 1).count());
            for corner in sides.corners() {
                let n = mesh.positions.iter().position(|p| p.distance(corner.place) < 1e-9).unwrap();
                assert_eq!(at_node[n], 1);
            }
            let edges = Edges::of_quads(&mesh);
            let lengths = edges.ends.iter().map(|ends| {
                let [a, b] = ends.map(|n| mesh.positions[n.index()]);
                a.distance(b)
            });
            let mean = lengths.clone().sum::<f64>() / edges.len() as f64;
            assert!((0.6..1.1).contains(&mean) && lengths.clone().all(|l| (0.1..2.0).contains(&l)), "{mean}");
        }
    }

    #[test]
    fn quads_of_a_closed_shell_have_no_end() {
        let (_, mesh) = quads(&hollow_ball(8, 4.0, 0.1), 0.9);
        let (at_edge, _) = uses(&mesh);
        assert!(at_edge.iter().all(|&count| count == 2));
        assert_eq!(mesh.positions.len() + mesh.quads.len(), at_edge.len() + 2);
    }

    /// Two squares that share a node; a strip of three beside one of them goes with what it leaves.
    #[test]
    fn quads_that_hang_together_at_nodes_or_one_edge_are_taken_away() {
        let quad =
            |x: u32, y: u32| [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]].map(|[x, y]| NodeId(8 * y + x));
        let block = |from: [u32; 2]| (0..9).map(move |k| quad(from[0] + k % 3, from[1] + k / 3));
        let mut quads: Vec<[NodeId; 4]> = block([0, 0]).chain(block([3, 3])).chain([quad(3, 1)]).collect();
        trim(&mut quads, &Silent).unwrap();
        let expected = block([0, 0]).chain(block([3, 3])).filter(|q| *q != quad(2, 2) && *q != quad(3, 3));
        assert_eq!(quads, expected.collect::<Vec<_>>());
        trim(&mut quads, &Silent).unwrap();
        assert_eq!(quads.len(), 16);
    }
}
