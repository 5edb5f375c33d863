//! Where the interface runs along a ridge of the boundary, one of the two sides must leave the ridge, and it must be
//! the same one all along: else a face of the layer would cut the ridge off. A side of which two regions meet at a node of
//! the ridge must leave it, since only one of them could stay. A side that has the ridge for itself beyond the end of the
//! run cannot leave it, since its copy there stays on the ridge, and the layer's face at the run would have three corners
//! in a line. If both sides can leave, it is the one that leaves the interface more steeply, since the other may slide
//! along the interface's own plane. If neither can all along, more must be refined.

use super::blocks::in_blocks;
use super::interface::{Interface, Star};
use super::pinch::Pinches;
use super::regions::{Regions, interface_ends};
use super::shift::Shifts;
use crate::geometry::Point;
use crate::mesh::topology::Sets;
use crate::{Cancelled, Monitor};

/// Where the interface runs along ridges of the boundary, and which side stays on them.
pub(super) struct Ridges {
    staying: Vec<Option<bool>>,
    /// Does the other side leave the run of ridges along the interface's own plane somewhere?
    is_flat: Vec<bool>,
}

/// The sine below which a side leaves along the interface's plane.
const FLAT: f64 = 0.5;

/// What one node says of it.
struct AtNode {
    place: usize,
    /// The ridges' other ends, by place.
    others: Vec<usize>,
    coarse_must_stay: bool,
    refined_must_stay: bool,
    /// How steeply the coarse and the refined side leave the interface.
    steepness: [f64; 2],
}

/// What the nodes of a run of ridges say together.
#[derive(Clone, Copy)]
struct Verdict {
    coarse_must_stay: bool,
    refined_must_stay: bool,
    /// How much more steeply the refined side leaves the interface than the coarse one.
    refined_is_steeper: f64,
    /// How steeply the coarse and the refined side leave the interface where each does least.
    steepness: [f64; 2],
}

impl Default for Verdict {
    fn default() -> Self {
        let steepness = [f64::INFINITY; 2];
        Self { coarse_must_stay: false, refined_must_stay: false, refined_is_steeper: 0.0, steepness }
    }
}

impl Verdict {
    fn refined_stays(self) -> bool {
        if self.coarse_must_stay != self.refined_must_stay {
            return self.refined_must_stay;
        }
        self.refined_is_steeper <= 1e-6
    }
}

impl Ridges {
    /// Decides for each connected run of ridges which side stays.
    pub(super) fn new(
        positions: &[Point],
        interface: &Interface,
        pinches: &Pinches,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let count = interface.nodes.len();
        let buffers = || (Star::default(), Regions::default(), Shifts::default());
        let at = |buffers: &mut (Star, Regions, Shifts), place: usize, found: &mut Vec<AtNode>| {
            let (star, regions, shifts) = buffers;
            star.load(interface, place);
            // Only nodes with faces to be kept of both sides can lie on a ridge between them.
            if star.faces.iter().filter(|face| interface.kind(star, face).is_some()).count() < 2 {
                return;
            }
            regions.load(interface, star, pinches, place);
            shifts.load(positions, interface, star, regions, interface.kept());
            let others: Vec<usize> = shifts.ridges.iter().filter_map(|&end| interface.place(end)).collect();
            let steepness = |refined| shifts.steepness(regions, refined);
            found.extend((!others.is_empty()).then(|| AtNode {
                place,
                others,
                coarse_must_stay: shifts.must_stay(regions, false),
                refined_must_stay: shifts.must_stay(regions, true),
                steepness: [steepness(false), steepness(true)],
            }));
        };
        let found = in_blocks(count, monitor, buffers, at)?;
        let mut runs = Sets::new(count);
        for node in &found {
            for &other in &node.others {
                runs.join(node.place as u32, other as u32, false);
            }
        }
        let mut verdicts = vec![Verdict::default(); count];
        for node in &found {
            let verdict = &mut verdicts[runs.root(node.place as u32).0 as usize];
            verdict.coarse_must_stay |= node.coarse_must_stay;
            verdict.refined_must_stay |= node.refined_must_stay;
            verdict.refined_is_steeper += node.steepness[1] - node.steepness[0];
            verdict.steepness = [0, 1].map(|side| verdict.steepness[side].min(node.steepness[side]));
        }
        let (mut staying, mut is_flat) = (vec![None; count], vec![false; count]);
        for node in &found {
            let verdict = verdicts[runs.root(node.place as u32).0 as usize];
            let refined = verdict.refined_stays();
            staying[node.place] = Some(refined);
            is_flat[node.place] = verdict.steepness[usize::from(!refined)] < FLAT;
        }
        Ok(Self { staying, is_flat })
    }

    /// The side that stays at node `place` of the interface, if it is on such a ridge: true for the refined side.
    pub(super) fn staying_side(&self, place: usize) -> Option<bool> {
        self.staying[place]
    }

    /// The side that stays on ridges at the other ends of the interface's edges at a star's node, where the other side
    /// leaves along the interface's plane. If it stays at this node as well, the layer between them does not fold.
    pub(super) fn side_beside(&self, interface: &Interface, star: &Star) -> Option<bool> {
        let mut sides = interface_ends(star)
            .filter_map(|end| interface.place(end))
            .filter(|&place| self.is_flat[place])
            .filter_map(|place| self.staying[place]);
        let first = sides.next()?;
        sides.all(|side| side == first).then_some(first)
    }
}
