//! Where the interface runs along a ridge of the boundary, one of the two sides must leave the ridge, and it must be
//! the same one all along: else a face of the layer would cut the ridge off. A side of which two regions meet at a node of
//! the ridge must leave it, since only one of them could stay. A side that has the ridge for itself beyond the end of the
//! run cannot leave it, since its copy there stays on the ridge, and the layer's face at the run would have three corners
//! in a line. If both sides can leave, it is the one that leaves the interface more steeply, since the other may slide
//! along the interface's own plane. If neither can all along, more must be refined.

use super::blocks::in_blocks;
use super::interface::{Interface, Star};
use super::pinch::Pinches;
use super::regions::Regions;
use super::shift::Shifts;
use crate::geometry::Point;
use crate::mesh::topology::Sets;
use crate::{Cancelled, Monitor};

/// Where the interface runs along ridges of the boundary, and which side stays on them.
pub(super) struct Ridges {
    staying: Vec<Option<bool>>,
}

/// What one node says of it.
struct AtNode {
    place: usize,
    /// The ridges' other ends, by place.
    others: Vec<usize>,
    coarse_must_stay: bool,
    refined_must_stay: bool,
    /// How much more steeply the refined side leaves the interface than the coarse one.
    refined_is_steeper: f64,
}

/// What the nodes of a run of ridges say together.
#[derive(Clone, Copy, Default)]
struct Verdict {
    coarse_must_stay: bool,
    refined_must_stay: bool,
    refined_is_steeper: f64,
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
            // Only nodes with boundary faces of both sides can lie on a ridge between them.
            if star.faces.iter().filter(|face| face.second.is_none()).count() < 2 {
                return;
            }
            regions.load(interface, star, pinches, place);
            shifts.load(positions, interface, star, regions);
            let others: Vec<usize> = shifts.ridges.iter().filter_map(|&end| interface.place(end)).collect();
            let steepness = |refined| shifts.steepness(positions, interface, star, regions, refined);
            found.extend((!others.is_empty()).then(|| AtNode {
                place,
                others,
                coarse_must_stay: shifts.must_stay(regions, false),
                refined_must_stay: shifts.must_stay(regions, true),
                refined_is_steeper: steepness(true) - steepness(false),
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
            verdict.refined_is_steeper += node.refined_is_steeper;
        }
        let mut staying = vec![None; count];
        for node in &found {
            let verdict = verdicts[runs.root(node.place as u32).0 as usize];
            staying[node.place] = Some(verdict.refined_stays());
        }
        Ok(Self { staying })
    }

    /// The side that stays at node `place` of the interface, if it is on such a ridge: true for the refined side.
    pub(super) fn staying_side(&self, place: usize) -> Option<bool> {
        self.staying[place]
    }
}
