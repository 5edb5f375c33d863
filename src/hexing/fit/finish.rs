//! Raises the mean of a mesh that is kept once more: what is inside is smoothed, and what slides within a plane, which takes
//! mesh and solid no farther from each other. Beside nodes that are off the solid it might: there planes go on beyond their
//! surface.

use super::super::correspondence::{Anchor, Correspondence};
use super::even::even;
use super::holds::Hold;
use super::{Fitted, quality};
use crate::mesh::{HexMesh, NodeId};
use crate::monitor::Part;
use crate::optimize::Evening;
use crate::solid::{SolidModel, SurfaceClass};
use crate::{Cancelled, Monitor, Stage};

pub(in super::super) const FINISHING: Stage = Stage("finishing");

/// The share of that stage that is done then; the rest is for looking at what came of it.
pub(in super::super) const FINISHED: f64 = 0.8;

impl Fitted {
    /// The last step of the fit, for a mesh that is kept: `mesh` and `on` are as the fit left them.
    ///
    /// # Errors
    /// [`Cancelled`] when the monitor says so; then nodes are where they were.
    pub fn finish(
        &mut self,
        mesh: &mut HexMesh,
        on: &Correspondence,
        solid: &SolidModel,
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        let mut is_beside = vec![false; mesh.positions.len()];
        for (quad, _) in &on.faces {
            if quad.iter().any(|n| self.holds[n.index()].is_off()) {
                quad.iter().for_each(|n| is_beside[n.index()] = true);
            }
        }
        let slides = |n: NodeId| match on.anchors[n.index()] {
            Anchor::Inside => true,
            Anchor::Surface(s) if !is_beside[n.index()] => {
                let is_planar = matches!(solid.surfaces()[s.index()].class, SurfaceClass::Planar { .. });
                is_planar && on.reduction.members(s) == [s] && self.holds[n.index()] == Hold::Held
            }
            _ => false,
        };
        let all = Part { whole: monitor, stage: FINISHING, range: [0.0, FINISHED] };
        self.report.sweeps += even(mesh, on, &self.holds, solid, Evening::LAST, &slides, &all)?;
        (self.report.worst, self.report.mean) = quality(mesh);
        Ok(())
    }

    /// These nodes are not on the solid anymore.
    pub fn take_off(&mut self, nodes: &[NodeId]) {
        nodes.iter().for_each(|n| self.holds[n.index()] = Hold::Drawn);
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::testing::held;
    use super::super::{FitOptions, FitReport, fit};
    use super::*;
    use crate::Silent;
    use crate::geometry::Point;
    use crate::hexing::correspondence::correspond;
    use crate::hexing::sheets::insert_sheets;
    use crate::mesh::{GridOptions, hex_grid};
    use crate::solid::testing::{cuboid, solid};

    /// Stops the work at its second question.
    struct Soon(std::sync::atomic::AtomicU32);

    impl Monitor for Soon {
        fn progress(&self, _: Stage, _: f64) {}

        fn cancelled(&self) -> bool {
            self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed) > 0
        }
    }

    /// Since a cube was fitted a node inside was pushed aside, and one of a side.
    #[test]
    fn finishing_raises_the_mean_and_stays_on_the_solid() {
        let solid = solid(&cuboid([4, 4, 4]));
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: true, max_hexes: 100 };
        let mut mesh = hex_grid(solid.bounds(), &options).unwrap();
        let mut on = correspond(&mesh, &solid, &Silent).unwrap();
        let mut sheets = insert_sheets(&mut mesh, &mut on, &solid, &Silent).unwrap();
        let options = FitOptions::default();
        let (mut fitted, _) = fit(&mut mesh, &mut on, &mut sheets, &solid, &options, &Silent).unwrap();
        let node = |p: Point| mesh.positions.iter().position(|&q| q.distance(p) < 1e-9).unwrap();
        let (inside, aside) = (node(Point::splat(2.0)), node(Point::new(2.0, 2.0, 4.0)));
        mesh.positions[inside] += Point::new(0.3, 0.2, 0.1);
        mesh.positions[aside] += Point::new(0.3, -0.2, 0.0);
        let (pushed, (worst, mean)) = (mesh.positions.clone(), quality(&mesh));
        let sweeps = fitted.report.sweeps;

        let stopped = fitted.finish(&mut mesh, &on, &solid, &Soon(0.into()));
        assert_eq!((stopped, &mesh.positions, fitted.report.sweeps), (Err(Cancelled), &pushed, sweeps));
        fitted.finish(&mut mesh, &on, &solid, &Silent).unwrap();
        assert_eq!((fitted.report.worst, fitted.report.mean), quality(&mesh));
        assert!(fitted.report.mean > mean && fitted.report.worst >= worst && fitted.report.sweeps > sweeps);
        assert!(mesh.positions[aside] != pushed[aside] && mesh.positions[aside].z == 4.0);
        for (n, anchor) in on.anchors.iter().enumerate() {
            let stays = matches!(anchor, Anchor::Curve(_) | Anchor::Corner(_));
            assert!(!stays || mesh.positions[n] == pushed[n], "{anchor:?}");
        }
    }

    /// Nodes of a side were pushed apart; one of them is beside a node that is off its curve.
    #[test]
    fn nodes_beside_what_is_off_the_solid_stay_where_they_are() {
        let solid = solid(&cuboid([6, 6, 6]));
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: true, max_hexes: 1000 };
        let mut mesh = hex_grid(solid.bounds(), &options).unwrap();
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        let node = |x: f64| {
            let place = Point::new(x, 3.0, 6.0);
            mesh.positions.iter().position(|&q| q.distance(place) < 1e-9).unwrap()
        };
        let ([edge, beside, other], mut holds) = ([0.0, 1.0, 5.0].map(node), held(&on));
        holds[edge] = Hold::Leashed;
        let pushed = [beside, other].map(|n| {
            mesh.positions[n] += Point::new(0.0, 0.3, 0.0);
            mesh.positions[n]
        });
        let mut fitted = Fitted { report: FitReport::default(), holds };
        fitted.finish(&mut mesh, &on, &solid, &Silent).unwrap();
        assert_eq!(mesh.positions[beside], pushed[0]);
        assert!(mesh.positions[other].distance(pushed[1]) > 0.1, "{}", mesh.positions[other]);
    }
}
