//! What an attempt missed, with the place: where another one is to have smaller cells.

use super::background::{Background, Failure, OctreeMesh};
use super::core::Core;
use super::correspondence::{CurveFate, LostCurve, LostSurface, Reason, Reduction};
use super::ground::Site;
use crate::geometry::{Aabb, BoxIndex, Point};

/// Unless a sweep follows its walls, mesh and solid are near enough within this share of the solid's diagonal, however small
/// the cells are.
const NEAR: f64 = 0.003;

/// How near mesh and solid are to be to each other, or somewhat more (`attempt`), before smaller cells are tried: beyond that
/// a feature is not shown that these may show.
pub(super) fn tolerance(site: &Site<'_>, kind: Background) -> f64 {
    let of_edge = site.taste.near * site.options.edge_length;
    let of_solid = if matches!(kind, Background::Swept | Background::Shell) {
        0.0
    } else {
        NEAR * site.solid.diagonal()
    };
    site.options.max_distance.unwrap_or(of_edge.max(of_solid))
}

/// A closed curve needs so many edges to be routed.
const AROUND: f64 = 2.5;

/// The cells of a background that are finer than the coarsest. They are many, and kept throughout a fit, after which few
/// points are asked for: so they take little memory, and are walked over.
#[derive(Default)]
pub(super) struct FineCells {
    /// Where shares are counted from, and how many of them a unit of length has.
    origin: Point,
    scale: f64,
    /// A box around each cell, in shares, rounded outwards, and its level.
    cells: Vec<([[u16; 3]; 2], u8)>,
}

impl FineCells {
    pub(super) fn of(background: &OctreeMesh) -> Self {
        let OctreeMesh { mesh, level } = background;
        let around = Aabb::around(&mesh.positions);
        let scale = f64::from(u16::MAX) / around.size().max_element();
        let mut fine = Self { origin: around.min, scale, cells: Vec::new() };
        let is_fine = |hex: &usize| level[*hex] > 0;
        let cell = |hex: usize| {
            let Aabb { min, max } = Aabb::around(&mesh.hexes[hex].map(|n| mesh.positions[n.index()]));
            let [min, max] = [fine.share(min).floor(), fine.share(max).ceil()];
            ([min, max].map(|p| p.to_array().map(|x| x as u16)), level[hex])
        };
        let mut cells = Vec::with_capacity((0..level.len()).filter(is_fine).count());
        cells.extend((0..level.len()).filter(is_fine).map(cell));
        fine.cells = cells;
        fine
    }

    fn share(&self, p: Point) -> Point {
        (p - self.origin) * self.scale
    }

    /// The level of the finest cell at each point.
    pub(super) fn finest(&self, points: &[Point]) -> Vec<u8> {
        let shares: Vec<Point> = points.iter().map(|&p| self.share(p)).collect();
        let index = BoxIndex::of_points(&shares);
        let mut finest = vec![0; shares.len()];
        for &([min, max], level) in &self.cells {
            let [min, max] = [min, max].map(|p| Point::from(p.map(f64::from)));
            index.touching(&Aabb { min, max }).for_each(|p| finest[p] = level.max(finest[p]));
        }
        finest
    }
}

/// All that an attempt on a kind of background missed, smaller cells may show, and somebody drew.
pub(super) fn misses(
    site: &Site<'_>,
    kind: Background,
    core: &Core,
    reduction: &Reduction,
    far: Vec<Point>,
    cells: &FineCells,
) -> Vec<Failure> {
    let solid = site.solid;
    let finest = site.edge_length(kind) / f64::from(1u32 << site.finest(kind));
    let mut failures = Vec::new();
    let is_missed = |lost: &&LostCurve| {
        let is_wanted = !matches!(lost.reason, Reason::Costly | Reason::Low) && solid.is_drawn(lost.curve);
        lost.fate == CurveFate::Suppressed && is_wanted
    };
    for lost in reduction.lost_curves.iter().filter(is_missed) {
        // What even the finest cells are too large for is given up at once.
        if lost.reason != Reason::Short || lost.length >= AROUND * finest {
            failures.push(Failure::of_curve(solid, lost.curve, 0, finest));
        }
    }
    let may_show = |lost: &&LostSurface| !solid.is_free_form() && lost.area >= finest * finest;
    for lost in reduction.lost_surfaces.iter().filter(may_show) {
        failures.push(Failure::of_surface(solid, lost.surface, 0, finest));
    }
    if !core.report.is_of_kind() {
        failures.extend(core.lost.iter().map(|part| Failure::of_lost(part.centers.clone(), 0)));
    }
    failures.extend(far.into_iter().map(|place| Failure::of_far(place, 0)));
    let points: Vec<Point> = failures.iter().flat_map(|failure| &failure.points).copied().collect();
    let mut finest = cells.finest(&points).into_iter();
    for failure in &mut failures {
        failure.level = finest.by_ref().take(failure.points.len()).min().unwrap_or(0);
    }
    failures
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::core::CoreReport;
    use super::super::options::HexingOptions;
    use super::*;
    use crate::Silent;
    use crate::mesh::numbering::hex::CORNERS;
    use crate::mesh::{HexMesh, NodeId};
    use crate::solid::testing::{cuboid, solid};
    use crate::solid::{CurveId, SurfaceId};

    /// How many failures it is that a cube of 8 lost a curve and a surface of these sizes, with edges of 1.
    fn failures(curve: Option<(Reason, f64)>, area: Option<f64>) -> usize {
        let solid = solid(&cuboid([8, 8, 8]));
        let options = HexingOptions { edge_length: 1.0, max_levels: 2, ..HexingOptions::default() };
        let site = Site::new(&solid, &options, &Silent).unwrap();
        let mut reduction = Reduction::default();
        reduction.lost_curves = curve
            .map(|(reason, length)| LostCurve {
                curve: CurveId(0),
                fate: CurveFate::Suppressed,
                reason,
                place: Point::ZERO,
                length,
            })
            .into_iter()
            .collect();
        reduction.lost_surfaces = area
            .map(|area| LostSurface { surface: SurfaceId(0), place: Point::ZERO, area })
            .into_iter()
            .collect();
        let report = CoreReport { euler: 2, solid_euler: 2, ..CoreReport::default() };
        let core = Core { mesh: HexMesh::default(), cells: Vec::new(), report, lost: Vec::new() };
        misses(&site, Background::Grid, &core, &reduction, Vec::new(), &FineCells::default()).len()
    }

    /// A row of cells that are ever finer, far from the origin and of any size.
    #[test]
    fn the_finest_cell_at_a_point_is_found() {
        let cells = |origin: f64, size: f64| {
            let x = [0.0, 2.0, 3.0, 3.5, 3.75].map(|x| origin + size * x);
            let corner = |x: f64, [_, y, z]: [u8; 3]| Point::new(x, size * f64::from(y), size * f64::from(z));
            let positions = x.windows(2).flat_map(|x| CORNERS.map(|c| corner(x[usize::from(c[0])], c)));
            let hex = |k: u32| std::array::from_fn(|corner| NodeId(8 * k + corner as u32));
            let mesh = HexMesh {
                positions: positions.collect(),
                hexes: (0..4).map(hex).collect(),
                ..HexMesh::default()
            };
            let at =
                [1.0, 2.0, 2.5, 3.0, 3.2, 3.5, 3.75, 3.76].map(|x| Point::new(origin + size * x, 0.0, size));
            FineCells::of(&OctreeMesh { mesh, level: vec![0, 1, 2, 3] }).finest(&at)
        };
        for (origin, size) in [(0.0, 1.0), (-1e6, 0.25), (1e40, 1e38), (0.0, 1e-40)] {
            assert_eq!(cells(origin, size), [0, 1, 1, 2, 2, 3, 3, 0], "{origin} {size}");
        }
    }

    /// Of a cube whose diagonal is 13.86.
    #[test]
    fn of_small_cells_it_is_the_size_of_the_solid_that_tells_what_is_near() {
        let solid = solid(&cuboid([8, 8, 8]));
        let told = |edge_length: f64, max_distance: Option<f64>, kind: Background| {
            let options = HexingOptions { edge_length, max_distance, ..HexingOptions::default() };
            let site = Site::new(&solid, &options, &Silent).unwrap();
            tolerance(&site, kind) / solid.diagonal()
        };
        let of_edges = [1.0, 0.1].map(|edge| told(edge, None, Background::Swept));
        assert!(of_edges[0] > NEAR && (of_edges[1] - 0.1 * of_edges[0]).abs() < 1e-12, "{of_edges:?}");
        assert_eq!([1.0, 0.1].map(|edge| told(edge, None, Background::Grid)), [of_edges[0], NEAR]);
        assert!((told(0.1, Some(0.01), Background::Grid) * solid.diagonal() - 0.01).abs() < 1e-12);
    }

    /// Cells are a quarter of an edge at the finest.
    #[test]
    fn what_the_finest_cells_are_too_large_for_is_given_up_at_once() {
        assert_eq!([0.06, 0.07].map(|area| failures(None, Some(area))), [0, 1]);
        assert_eq!([0.6, 0.65].map(|length| failures(Some((Reason::Short, length)), None)), [0, 1]);
        assert_eq!(failures(Some((Reason::NoPath, 0.1)), None), 1);
    }

    #[test]
    fn what_was_given_up_for_the_cells_sake_is_not_tried_again() {
        assert_eq!([Reason::Costly, Reason::Low].map(|reason| failures(Some((reason, 8.0)), None)), [0, 0]);
    }
}
