//! Which background a body gets (section 4), and how it is made for each attempt.

use std::sync::OnceLock;

use glam::DMat3;

use super::background::{
    AlignedGrid, Background, BackgroundError, Choice, LEAST_GAP, Octree, OctreeMesh, Shell, Sweep,
    SweepError, SweepOptions, SweptScore, Wanted, choose, has_walls, may_sweep, octree, refined, thickness,
};
use super::direction::{DirectionScore, best_frame, principal_directions};
use super::merit::Taste;
use super::options::HexingOptions;
use crate::sizing::{Region, Target};
use crate::solid::SolidModel;
use crate::{Cancelled, Monitor};

/// The share of the usual tolerances for a sweep that shows walls and steps however thin.
const FINE: f64 = 1.0 / 16.0;

/// What is thicker than so many edges is no shell.
const LAYERS: f64 = 3.0;

/// A body and the kind of background that suits it.
pub(super) struct Site<'a> {
    pub(super) solid: &'a SolidModel,
    pub(super) options: &'a HexingOptions,
    pub(super) choice: Choice,
    pub(super) taste: Taste,
    /// The candidates for the principal direction, the best first; none where nobody asked.
    pub(super) directions: Vec<DirectionScore>,
    axes: DMat3,
    sweep: Option<Sweep>,
    /// One that was no choice.
    unlikely_sweep: OnceLock<Option<Sweep>>,
    /// One that shows walls and steps however thin.
    fine_sweep: OnceLock<Option<Sweep>>,
    shell: OnceLock<Option<Shell>>,
}

/// How an attempt's background differs from others of its site.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plan {
    /// What the core is cut out of; never `Auto`.
    pub(super) kind: Background,
    /// How far the lines of a grid are moved, as a share of an edge along each axis.
    pub(super) shift: [f64; 3],
    /// Do lines of a grid stand in both sides of walls and slots that are thinner than its cells, or does a sweep show them?
    pub(super) holds_walls: bool,
    /// Where cells are to be smaller, beyond what the options want.
    pub(super) regions: Vec<Region>,
    /// Are cells of a grid to be halved, in blocks? Else they are cut in three where halves would spread over all of it:
    /// that shows sooner what was lost, and takes more of the mean.
    pub(super) in_blocks: bool,
    /// How many levels finer cells may become where walls are thin, gaps narrow and curves short.
    pub(super) details: u8,
}

impl<'a> Site<'a> {
    /// Finds out what suits the body, or whether what the options want can be made.
    pub(super) fn new(
        solid: &'a SolidModel,
        options: &'a HexingOptions,
        monitor: &dyn Monitor,
    ) -> Result<Self, BackgroundError> {
        let axes = best_frame(solid).axes();
        let (mut directions, mut sweep) = (Vec::new(), None);
        if matches!(options.background, Background::Auto | Background::Swept) {
            directions = principal_directions(solid, monitor)?;
            sweep = swept(solid, axes, &directions, options, monitor)?;
        }
        let shell = OnceLock::new();
        if options.background == Background::Shell {
            let found = Shell::of(solid, monitor)?.ok_or(BackgroundError::NoShell)?;
            shell.get_or_init(|| Some(found));
        }
        let score = sweep.as_ref().map(|sweep| SweptScore {
            surface_capture: directions[0].surface_capture,
            worst_quad: sweep.worst_quad(),
        });
        let choice = choose(solid, axes, options.background, score, options.curvature.is_some());
        Ok(Self {
            solid,
            options,
            choice,
            taste: Taste::of(solid),
            directions,
            axes,
            sweep,
            unlikely_sweep: OnceLock::new(),
            fine_sweep: OnceLock::new(),
            shell,
        })
    }

    /// Is it a choice whether to take a grid?
    pub(super) fn may_be_grid(&self) -> bool {
        self.options.background == Background::Auto && self.choice.kind != Background::Octree
    }

    /// Was it a choice not to take an octree?
    pub(super) fn may_be_octree(&self) -> bool {
        self.options.background == Background::Auto && self.choice.kind != Background::Octree
    }

    /// May it be swept, though that was no choice? Then it is found out how: nothing tells the thickness of a wall, or the edge of
    /// a wedge, as layers do that stand in them.
    pub(super) fn may_be_swept(&self, monitor: &dyn Monitor) -> Result<bool, Cancelled> {
        let Self { solid, options, .. } = self;
        if options.background != Background::Auto || solid.is_free_form() {
            return Ok(false);
        }
        if self.sweep.is_none() && self.unlikely_sweep.get().is_none() {
            let sweep = sweep_along(solid, self.directions.first(), &sweep_options(options), monitor)?;
            self.unlikely_sweep.get_or_init(|| sweep);
        }
        Ok(self.sweep(false).is_some())
    }

    /// May it be swept so that walls and steps are shown however thin, be it that a sweep was asked for? As that is found out, so
    /// it may.
    pub(super) fn may_hold_walls(&self, monitor: &dyn Monitor) -> Result<bool, Cancelled> {
        if self.options.background != Background::Swept && !self.may_be_swept(monitor)? {
            return Ok(false);
        }
        if self.fine_sweep.get().is_none() {
            let options = SweepOptions { tolerance: FINE, ..sweep_options(self.options) };
            let sweep = sweep_along(self.solid, self.directions.first(), &options, monitor)?;
            self.fine_sweep.get_or_init(|| sweep);
        }
        Ok(self.sweep(true).is_some())
    }

    /// Is it a choice whether to take a layer between the sides of a shell, and may one be made? As that is found out, so it may.
    pub(super) fn may_be_shell(&self, monitor: &dyn Monitor) -> Result<bool, Cancelled> {
        let is_thin = || thickness(self.solid) < LAYERS * self.options.edge_length;
        if self.options.background != Background::Auto || !is_thin() {
            return Ok(false);
        }
        if self.shell.get().is_none() {
            let shell = Shell::of(self.solid, monitor)?;
            self.shell.get_or_init(|| shell);
        }
        Ok(self.shell().is_some())
    }

    fn shell(&self) -> Option<&Shell> {
        self.shell.get()?.as_ref()
    }

    /// Is the body on the whole thinner than the cells of a grid may be?
    pub(super) fn is_thin_walled(&self) -> bool {
        thickness(self.solid) < LEAST_GAP * self.options.edge_length
    }

    /// Has the body walls or slots thinner than the cells of a grid, along its axes?
    pub(super) fn has_walls(&self, monitor: &dyn Monitor) -> Result<bool, Cancelled> {
        has_walls(self.solid, self.axes, self.edge_length(Background::Grid), monitor)
    }

    fn sweep(&self, holds_walls: bool) -> Option<&Sweep> {
        if holds_walls {
            return self.fine_sweep.get()?.as_ref();
        }
        self.sweep.as_ref().or_else(|| self.unlikely_sweep.get()?.as_ref())
    }

    /// A background of this kind, as it is: in an octree details have smaller cells from the beginning.
    pub(super) fn plan(&self, kind: Background) -> Plan {
        let details = if kind == Background::Octree { self.options.max_levels } else { 0 };
        Plan { kind, shift: [0.0; 3], holds_walls: false, regions: Vec::new(), in_blocks: false, details }
    }

    /// How long the edges of cells of level 0 are.
    pub(super) fn edge_length(&self, kind: Background) -> f64 {
        edge_length_of(kind, self.options)
    }

    /// The finest level that retries may ask for.
    pub(super) fn finest(&self, kind: Background) -> u8 {
        boundary_level(kind) + self.options.max_levels
    }

    /// The background of an attempt.
    pub(super) fn background(
        &self,
        plan: &Plan,
        max_hexes: u64,
        monitor: &dyn Monitor,
    ) -> Result<OctreeMesh, BackgroundError> {
        let &Self { solid, options, axes, .. } = self;
        let edge_length = self.edge_length(plan.kind);
        let aligned =
            AlignedGrid { edge_length, axes, shift: plan.shift, holds_walls: plan.holds_walls, max_hexes };
        let mut regions = options.regions.clone();
        if plan.kind == Background::Octree && self.may_be_octree() {
            // The user's levels count from the edge length, where it was not the user who wanted an octree.
            regions.iter_mut().for_each(finer_by_one);
        }
        regions.extend_from_slice(&plan.regions);
        let wanted = Wanted {
            boundary_level: boundary_level(plan.kind),
            curvature: options.curvature,
            details: plan.details > 0,
            levels: if options.curvature.is_some() { options.max_levels } else { plan.details },
            regions: &regions,
            in_blocks: plan.in_blocks,
        };
        match (plan.kind, self.sweep(plan.holds_walls), self.shell()) {
            (Background::Shell, _, Some(shell)) => {
                let mesh = shell.mesh(solid, &aligned, monitor)?;
                refined(mesh, solid, edge_length, &wanted, max_hexes, monitor)
            }
            (Background::Shell, ..) => Err(BackgroundError::NoShell),
            (Background::Swept, Some(sweep), _) => {
                let mesh = sweep.mesh(solid, monitor)?;
                let hexes = mesh.hexes.len();
                if hexes as u64 > max_hexes {
                    return Err(BackgroundError::TooManyHexes { hexes: hexes as f64, limit: max_hexes });
                }
                refined(mesh, solid, edge_length, &wanted, max_hexes, monitor)
            }
            _ => octree(solid, &Octree { grid: aligned, wanted }, monitor),
        }
    }
}

/// A level of a region more; a size stays.
fn finer_by_one(region: &mut Region) {
    if let Target::Level(level) = &mut region.target {
        *level = level.saturating_add(1);
    }
}

/// How long the edges of cells of level 0 of a background of this kind are.
pub(super) fn edge_length_of(kind: Background, options: &HexingOptions) -> f64 {
    if kind == Background::Octree { 2.0 * options.edge_length } else { options.edge_length }
}

/// The level of cells at the boundary that nothing wants smaller.
fn boundary_level(kind: Background) -> u8 {
    u8::from(kind == Background::Octree)
}

/// The longest edges that cells of level 0 of the first attempt may have.
pub(super) fn coarsest(options: &HexingOptions) -> f64 {
    let may_be_octree = options.background == Background::Auto && options.curvature.is_some();
    edge_length_of(if may_be_octree { Background::Octree } else { options.background }, options)
}

/// The sweep along the principal direction: if it is wanted, or may capture more than a grid.
fn swept(
    solid: &SolidModel,
    axes: DMat3,
    directions: &[DirectionScore],
    options: &HexingOptions,
    monitor: &dyn Monitor,
) -> Result<Option<Sweep>, BackgroundError> {
    let best = directions.first();
    if options.background == Background::Swept {
        let best = best.ok_or(BackgroundError::NoDirection)?;
        return Ok(Some(Sweep::new(solid, best.direction, &sweep_options(options), monitor)?));
    }
    let best = best.filter(|best| may_sweep(solid, axes, best.surface_capture));
    Ok(sweep_along(solid, best, &sweep_options(options), monitor)?)
}

fn sweep_options(options: &HexingOptions) -> SweepOptions {
    SweepOptions { max_hexes: options.max_hexes, ..SweepOptions::new(options.edge_length) }
}

/// The sweep along a direction, if there is one; else there are other backgrounds.
#[inline(never)] // Compiled once for all that call it.
fn sweep_along(
    solid: &SolidModel,
    direction: Option<&DirectionScore>,
    options: &SweepOptions,
    monitor: &dyn Monitor,
) -> Result<Option<Sweep>, Cancelled> {
    let Some(&DirectionScore { direction, .. }) = direction else { return Ok(None) };
    match Sweep::new(solid, direction, options, monitor) {
        Ok(sweep) => Ok(Some(sweep)),
        Err(SweepError::Cancelled(cancelled)) => Err(cancelled),
        Err(_) => Ok(None),
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::Silent;
    use crate::geometry::Point;
    use crate::sizing::Shape;
    use crate::solid::testing::{cuboid, solid};

    #[test]
    fn levels_of_regions_count_from_the_edge_length_where_an_octree_is_no_wish() {
        let solid = solid(&cuboid([8, 8, 8]));
        let shape = Shape::Sphere { center: Point::splat(4.0), radius: 1.0 };
        let finest = |background: Background| {
            let regions = vec![Region { shape: shape.clone(), target: Target::Level(1) }];
            let options = HexingOptions { edge_length: 1.0, regions, background, ..HexingOptions::default() };
            let site = Site::new(&solid, &options, &Silent).unwrap();
            let octree = site.plan(Background::Octree);
            let made = site.background(&octree, 1_000_000, &Silent).unwrap();
            let in_the_middle = (0..made.level.len()).filter(|&hex| {
                let corners = made.mesh.hexes[hex].map(|n| made.mesh.positions[n.index()]);
                (corners.into_iter().sum::<Point>() / 8.0).distance(Point::splat(4.0)) < 1.0
            });
            in_the_middle.map(|hex| made.level[hex]).max()
        };
        assert_eq!([finest(Background::Auto), finest(Background::Octree)], [Some(2), Some(1)]);
    }
}
