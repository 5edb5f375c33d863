//! The core of a background mesh: the cells that stand for the solid (section 5.1).
//!
//! 1. How deep each cell's centre lies in the solid (`distance`).
//! 2. What is thinner than cells is made thick enough for them (`thin`).
//! 3. Which cells are in: a minimum cut (`energy`).
//! 4. As few changes as may be, so that the boundary is a 2-manifold (`manifold`).
//! 5. Steps are levelled where the solid is smooth (`terraces`).
//! 6. The largest part of each body, without bubbles (`parts`).
//!
//! **Promises.** The core is a conforming mesh, and a manifold with boundary; so its boundary is a closed 2-manifold.
//! Whether that has the solid's Euler number is reported: features smaller than cells may be lost.

mod cells;
mod distance;
mod energy;
mod link;
mod manifold;
mod parts;
mod terraces;
mod thin;

use serde::Serialize;

use crate::geometry::{NearestTriangle, Point};
use crate::mesh::numbering::hex::FACES;
use crate::mesh::{HexId, HexMesh, NodeId, Volumes};
use crate::solid::{SolidModel, SurfaceClass};
use crate::{Cancelled, Monitor, Stage, parallel};
use cells::NONE;
pub(super) use cells::{Cells, NONE as NO_CELL};
use distance::Distances;
pub use energy::Energy;
pub(super) use manifold::make_manifold;
use thin::{Near, keep_thin};

/// How the core is cut out.
#[derive(Clone, Copy, Debug)]
pub struct CoreOptions<'a> {
    /// The energy whose minimum is sought.
    pub energy: Energy,
    /// For each cell of the background, whether it is in a refined domain (section 4.3.1): others are in if their centre
    /// is. `None`: all cells are one domain.
    pub domain: Option<&'a [bool]>,
    /// Keep walls, rods, slots and holes that are thinner than cells, as one layer of these.
    pub keep_thin: bool,
    /// Level steps where the solid is smooth.
    pub level: bool,
}

impl Default for CoreOptions<'_> {
    fn default() -> Self {
        Self { energy: Energy::default(), domain: None, keep_thin: true, level: true }
    }
}

/// The core.
#[derive(Clone, Debug, PartialEq)]
pub struct Core {
    /// Without nodes that no hex uses; empty where no cell stands for the solid.
    pub mesh: HexMesh,
    /// The cell of the background that each hex is.
    pub cells: Vec<HexId>,
    /// What was done, and what came of it.
    pub report: CoreReport,
    /// Where parts were lost, or holes closed.
    pub lost: Vec<LostPart>,
}

/// Cells that the solid has and the core has not, or the other way round.
#[derive(Clone, Debug, PartialEq)]
pub struct LostPart {
    /// The cells' centres.
    pub centers: Vec<Point>,
}

/// What was done to make a core, and what came of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct CoreReport {
    /// Cells of the background.
    pub background: usize,
    /// Cells at what is thinner than cells.
    pub thin: usize,
    /// Cells that the cut decided on.
    pub undecided: usize,
    /// Cells of the core.
    pub cells: usize,
    /// Changes that made the boundary a manifold.
    pub flips: usize,
    /// Rounds of these.
    pub rounds: usize,
    /// Terraces that were moved, so that the boundary has fewer creases.
    pub terraces: usize,
    /// Cells removed because they hung together with no body.
    pub crumbs: usize,
    /// Cells added because they were closed in.
    pub bubbles: usize,
    /// The Euler number of the core's boundary.
    pub euler: i64,
    /// The Euler number of the solid's boundary.
    pub solid_euler: i64,
    /// The core's volume over the solid's.
    pub volume_ratio: f64,
}

impl CoreReport {
    /// Is the core of the solid's kind, as far as the Euler number tells, and the volume?
    pub fn is_of_kind(&self) -> bool {
        self.off_kind() == 0
    }

    /// How far the core is from the solid's kind: by the Euler number, and by more than any where it has not even half of the
    /// solid's volume. What is left then may be of the kind by chance: a crumb is a ball, as a plate is.
    pub fn off_kind(&self) -> u64 {
        let lacks_most = u64::from(self.volume_ratio < MOST) << 32;
        lacks_most + self.euler.abs_diff(self.solid_euler)
    }
}

/// Edges: how deep cells are that lie deeper is of no concern.
const FAR: f64 = 2.0;

/// Edges: cells whose centres are nearer to a curve of the solid are not levelled.
const AROUND_CURVES: f64 = 1.5;

/// A core with less than this share of the solid's volume is not of its kind.
const MOST: f64 = 0.5;

const CORE: Stage = Stage("core");

/// Cuts the core out of a conforming background.
///
/// # Errors
/// If the monitor stops it.
///
/// # Panics
/// If `options.domain` has not one value for each cell.
pub fn core(
    background: &HexMesh,
    solid: &SolidModel,
    options: &CoreOptions<'_>,
    monitor: &dyn Monitor,
) -> Result<Core, Cancelled> {
    monitor.checkpoint(CORE, 0.0)?;
    let cells = Cells::of(background, monitor)?;
    monitor.checkpoint(CORE, 0.2)?;
    // The paper's energy weighs all cells against the deepest.
    let far = if options.energy == Energy::Paper { f64::INFINITY } else { FAR };
    let mut distances = Distances::of(&cells, |p| solid.signed_distance(p), far, monitor)?;
    let near = |p: Point| {
        let (signed, foot) = solid.signed_nearest(p);
        Near { signed, foot: foot.point, normal: foot.normal }
    };
    let thin = if options.keep_thin { keep_thin(&cells, &mut distances, near, monitor)? } else { 0 };
    let depth = distances.depth();
    let mut inside: Vec<bool> = depth.iter().map(|&d| d < 0.0).collect();
    monitor.checkpoint(CORE, 0.5)?;
    let is_free = |cell: usize| match options.energy {
        Energy::Paper => options.domain.is_none_or(|domain| domain[cell]),
        Energy::Clipped => {
            options.domain.is_none_or(|domain| domain[cell]) && depth[cell].abs() <= energy::SURE
        }
    };
    let free = parallel::filter(cells.len(), is_free);
    energy::cut(&cells, &distances, options.energy, &free, |p| solid.nearest(p).point, &mut inside, monitor)?;
    monitor.checkpoint(CORE, 0.7)?;
    let repairs = manifold::make_manifold(&cells, &depth, &mut inside, monitor)?;
    let terraces = if options.level {
        let outward = outward_where_smooth(&cells, &distances, solid, options.domain);
        terraces::level(&cells, &depth, outward, &mut inside, monitor)?
    } else {
        0
    };
    monitor.checkpoint(CORE, 0.8)?;
    let body = |cell: usize| {
        let foot = solid.nearest(cells.barycentre(cell));
        solid.surfaces()[solid.surface_of(foot.triangle as usize).index()].body
    };
    let removed = parts::keep_bodies(&cells, &depth, body, &mut inside);
    monitor.checkpoint(CORE, 0.9)?;
    let kept = parallel::filter(cells.len(), |cell| inside[cell]);
    let mesh = compact(background, &kept);
    let report = CoreReport {
        background: cells.len(),
        thin,
        undecided: free.len(),
        cells: kept.len(),
        flips: repairs.flips,
        rounds: repairs.rounds,
        terraces,
        crumbs: removed.crumbs.iter().map(Vec::len).sum(),
        bubbles: removed.bubbles.iter().map(Vec::len).sum(),
        euler: boundary_euler(&cells, &inside),
        solid_euler: solid.euler_number(),
        volume_ratio: volume_ratio(&mesh, solid),
    };
    let centers = |part: &Vec<u32>| part.iter().map(|&cell| cells.barycentre(cell as usize)).collect();
    let parts = removed.crumbs.iter().chain(&removed.bubbles);
    let lost = parts.map(|part| LostPart { centers: centers(part) }).collect();
    monitor.checkpoint(CORE, 1.0)?;
    Ok(Core { mesh, cells: kept.into_iter().map(HexId).collect(), report, lost })
}

/// The core that is all of a background: one that was made for nothing but the solid, and is a manifold.
///
/// # Errors
/// If the monitor stops it.
pub fn whole_core(
    background: &HexMesh,
    solid: &SolidModel,
    monitor: &dyn Monitor,
) -> Result<Core, Cancelled> {
    monitor.checkpoint(CORE, 0.0)?;
    let cells = Cells::of(background, monitor)?;
    let count = cells.len();
    let report = CoreReport {
        background: count,
        cells: count,
        euler: boundary_euler(&cells, &vec![true; count]),
        solid_euler: solid.euler_number(),
        volume_ratio: volume_ratio(background, solid),
        ..CoreReport::default()
    };
    monitor.checkpoint(CORE, 1.0)?;
    Ok(Core {
        mesh: background.clone(),
        cells: (0..count).map(HexId::new).collect(),
        report,
        lost: Vec::new(),
    })
}

fn volume_ratio(mesh: &HexMesh, solid: &SolidModel) -> f64 {
    Volumes::of(mesh).map_or(0.0, |volumes| volumes.total) / solid.volume()
}

/// The solid's unit normal near a cell that may be levelled: one in the domain, at a surface that is neither a plane nor a
/// cylinder, away from curves. Where the strips between the curves of planes askew were levelled, cells became worse.
fn outward_where_smooth<'a>(
    cells: &'a Cells<'_>,
    distances: &'a Distances,
    solid: &'a SolidModel,
    domain: Option<&'a [bool]>,
) -> impl Fn(usize) -> Option<Point> + use<'a> {
    let edges = solid.curves().iter().flat_map(|curve| curve.vertices.windows(2));
    // As triangles without area.
    let edges = edges.map(|ends| [ends[0], ends[1], ends[1]].map(|v| solid.points()[v as usize]));
    let curves = NearestTriangle::of(edges);
    move |cell| {
        let center = cells.barycentre(cell);
        let foot = solid.nearest(center);
        let surface = &solid.surfaces()[solid.surface_of(foot.triangle as usize).index()];
        let reach = AROUND_CURVES * distances.edge[cell];
        let may_change = surface.class == SurfaceClass::General
            && domain.is_none_or(|domain| domain[cell])
            && curves.nearest(center).is_none_or(|at| at.point.distance(center) >= reach);
        may_change.then_some(foot.normal)
    }
}

/// The mesh of some cells, ascending, without the nodes of others.
fn compact(background: &HexMesh, kept: &[u32]) -> HexMesh {
    let mut number = vec![None; background.positions.len()];
    for &cell in kept {
        background.hexes[cell as usize].iter().for_each(|n| number[n.index()] = Some(NodeId(0)));
    }
    let mut positions = Vec::new();
    for (n, number) in number.iter_mut().enumerate().filter(|(_, number)| number.is_some()) {
        *number = Some(NodeId::new(positions.len()));
        positions.push(background.positions[n]);
    }
    let hex =
        |&cell: &u32| background.hexes[cell as usize].map(|n| number[n.index()].expect("a node of a cell"));
    HexMesh {
        positions,
        hexes: kept.iter().map(hex).collect(),
        tags: background.tags.inherited(kept),
        ..HexMesh::default()
    }
}

/// The Euler number of the boundary of the cells inside, a 2-manifold of quads: these have two edges each.
fn boundary_euler(cells: &Cells<'_>, inside: &[bool]) -> i64 {
    let mut on_boundary = vec![false; cells.mesh.positions.len()];
    let mut faces = 0;
    for cell in (0..cells.len()).filter(|&cell| inside[cell]) {
        for (face, &other) in FACES.iter().zip(&cells.neighbours[cell]) {
            if other == NONE || !inside[other as usize] {
                faces += 1;
                face.iter().for_each(|&k| on_boundary[cells.mesh.hexes[cell][usize::from(k)].index()] = true);
            }
        }
    }
    on_boundary.iter().filter(|&&is| is).count() as i64 - faces
}

#[cfg(test)]
mod testing;

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;
