//! A planar region, and its mesh of quads.

use glam::DVec2;

use super::cells::Quads;
use super::embed::{Embedding, TOLERANCE};
use super::graph::{Graph, Segment};
use super::mesher::{FaceError, mesh};
use super::sample::sample;
use super::scale::Scale;
use super::triangulation::{Outcome, Triangulation};
use crate::Monitor;

/// A region of a plane: what is enclosed by an odd number of closed curves. Lengths are in model units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Region {
    /// Points of the curves.
    pub points: Vec<DVec2>,
    /// Straight segments of the outline, of holes too, in any order and direction: an even number at each point, and none
    /// that cross or touch but at points.
    pub outline: Vec<[u32; 2]>,
    /// Curves inside that edges of the mesh are to follow. What leaves the region is cut off; what is closer than 0.15
    /// edge lengths to the outline or to a curve before it is taken to lie on it.
    pub inner: Vec<Vec<u32>>,
    /// Points of the curves that must be nodes of the mesh; corners of more than 40 degrees are, in any case.
    pub corners: Vec<u32>,
}

/// What [`quad_region`] is to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegionOptions {
    /// About how long edges are to be, in model units.
    pub edge_length: f64,
    /// Refuse to make more quads than this.
    pub max_quads: u64,
}

impl RegionOptions {
    /// The most quads that can be asked for.
    pub const MOST_QUADS: u64 = 1 << 28;

    /// Edges about so long, and at most 16 million quads.
    pub fn new(edge_length: f64) -> Self {
        Self { edge_length, max_quads: 16_000_000 }
    }

    /// Refuses more quads than the limit.
    pub(super) fn refuse_quads(&self, quads: f64) -> Result<(), FaceError> {
        let limit = self.max_quads.min(Self::MOST_QUADS);
        if quads > limit as f64 { Err(FaceError::TooManyQuads { quads, limit }) } else { Ok(()) }
    }
}

/// Quads that fill a region: conforming, all of them positive.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RegionMesh {
    /// Nodes.
    pub points: Vec<DVec2>,
    /// The nodes of each quad, counter-clockwise.
    pub quads: Vec<[u32; 4]>,
    /// For each node whether it is on a curve.
    pub on_curve: Vec<bool>,
    /// Nodes on curves that could not be brought to them without a quad turning over, and how far off they stand.
    pub off_curve: Vec<(u32, f64)>,
    /// Inner curves that were wholly dropped, as places in [`Region::inner`].
    pub dropped: Vec<u32>,
    /// The least scaled Jacobian.
    pub worst: f64,
    /// The mean scaled Jacobian.
    pub mean: f64,
}

/// Meshes a region with quads alone: design after the paper's principal face (§4.1.2), all-quad by construction.
///
/// 1. `embed`: inner curves are laid into the outline, so that curves meet in points alone;
/// 2. `sample`: nodes on curves, about twice the edge length apart;
/// 3. `pack`: points between, in rows along the curves, which `field` carries inwards;
/// 4. `pair`: the triangles of the constrained Delaunay triangulation become quads, two by two, where these are convex;
/// 5. `tidy`: edges are turned and quads closed where nodes have too many or too few cells;
/// 6. `cells`: every cell is split into quads of half its size, which convex cells always can be;
/// 7. `smooth`: nodes are pulled to their curves and moved, and every quad stays positive.
///
/// Promises: every quad is positive, and the mesh conforms to the outline and the inner curves, whose corners are nodes.
/// The same bytes wherever it runs. Time is linear in the quads, but for searches in the triangulation.
///
/// # Errors
/// See [`FaceError`]. The number of quads is held against the limit before any is made.
///
/// # Panics
/// If a curve names a point that there is not.
///
/// ```
/// use hexmill::{Silent, hexing::face::{Region, RegionOptions, quad_region}};
/// let points = [[0., 0.], [2., 0.], [2., 1.], [0., 1.]].map(Into::into).to_vec();
/// let outline = vec![[0, 1], [1, 2], [2, 3], [3, 0]];
/// let region = Region { points, outline, ..Region::default() };
/// let mesh = quad_region(&region, &RegionOptions::new(0.25), &Silent)?;
/// assert_eq!(mesh.quads.len(), 8 * 4);
/// assert!(mesh.worst > 0.999);
/// # Ok::<(), hexmill::hexing::face::FaceError>(())
/// ```
pub fn quad_region(
    region: &Region,
    options: &RegionOptions,
    monitor: &dyn Monitor,
) -> Result<RegionMesh, FaceError> {
    if let Some(p) = region.points.iter().position(|p| !p.is_finite()) {
        return Err(FaceError::NotFinite(p as u32));
    }
    let outlined = region.outline.as_flattened().iter().map(|&p| region.points[p as usize]);
    let scale = Scale::new(outlined, options.edge_length)?;
    let points: Vec<DVec2> = region.points.iter().map(|&p| scale.unit_from_model(p)).collect();
    check_limit(region, &points, options)?;
    let outline = outline(region, &points)?;
    let area = area(region, &outline, options, monitor)?;
    let mut embedding = Embedding::new(outline, TOLERANCE);
    let mut dropped = Vec::new();
    for (k, curve) in region.inner.iter().enumerate() {
        monitor.proceed().map_err(FaceError::from)?;
        let mut curve: Vec<DVec2> = curve.iter().map(|&p| points[p as usize]).collect();
        curve.dedup();
        if curve.len() < 2 || !embedding.lay(&curve) {
            dropped.push(k as u32);
        }
    }
    for &corner in &region.corners {
        embedding.keep(points[corner as usize]);
    }
    let graph = without_outer_curves(embedding.graph, monitor)?;
    let samples = sample(&graph, &graph.arcs(), true, monitor)?;
    let quads = mesh(&samples, area, monitor)?;
    Ok(RegionMesh { dropped, ..region_mesh(quads, &scale) })
}

/// The mesh in model units, measured.
pub(super) fn region_mesh(quads: Quads, scale: &Scale) -> RegionMesh {
    let qualities: Vec<f64> = quads.cells.iter().map(|cell| quads.quality(cell)).collect();
    let off =
        |&(n, target): &(u32, DVec2)| (n, scale.length_from_unit(quads.points[n as usize].distance(target)));
    RegionMesh {
        off_curve: quads.pulled.iter().map(off).collect(),
        dropped: Vec::new(),
        worst: qualities.iter().copied().fold(f64::INFINITY, f64::min),
        mean: qualities.iter().sum::<f64>() / qualities.len().max(1) as f64,
        points: quads.points.iter().map(|&p| scale.model_from_unit(p)).collect(),
        quads: quads.cells,
        on_curve: quads.held,
    }
}

/// Refuses a region whose curves alone would have too many quads beside them.
fn check_limit(region: &Region, points: &[DVec2], options: &RegionOptions) -> Result<(), FaceError> {
    let length = |a: u32, b: u32| points[a as usize].distance(points[b as usize]);
    let outline: f64 = region.outline.iter().map(|&[a, b]| length(a, b)).sum();
    let inner: f64 = region.inner.iter().flat_map(|curve| curve.windows(2)).map(|w| length(w[0], w[1])).sum();
    options.refuse_quads(2.0 * (outline + 2.0 * inner))
}

/// The outline as a graph.
fn outline(region: &Region, points: &[DVec2]) -> Result<Graph, FaceError> {
    let mut graph = Graph { points: points.to_vec(), kept: vec![false; points.len()], ..Graph::default() };
    let mut odd = vec![false; points.len()];
    for &ends in &region.outline {
        graph.segments.push(Segment { ends, outline: true });
        ends.iter().for_each(|&end| odd[end as usize] ^= true);
    }
    match odd.iter().position(|&odd| odd) {
        None => Ok(graph),
        Some(p) => Err(FaceError::Open { node: p as u32, at: region.points[p].to_array() }),
    }
}

/// The area inside of the outline in units, none of whose segments may cross or touch.
fn area(
    region: &Region,
    outline: &Graph,
    options: &RegionOptions,
    monitor: &dyn Monitor,
) -> Result<f64, FaceError> {
    let mut triangulation = Triangulation::new();
    let mut ids = vec![0; outline.points.len()];
    for &end in region.outline.as_flattened() {
        ids[end as usize] = triangulation.insert(outline.points[end as usize], monitor)?;
    }
    for segment in &outline.segments {
        if triangulation.constrain(segment.ends.map(|end| ids[end as usize]), monitor)? != Outcome::Added {
            let at = region.points[segment.ends[0] as usize].to_array();
            return Err(FaceError::Crossing { ends: segment.ends, at });
        }
    }
    let mut points = vec![DVec2::ZERO; outline.points.len()];
    for &end in region.outline.as_flattened() {
        points[ids[end as usize] as usize] = outline.points[end as usize];
    }
    let triangles = triangulation.triangles(&triangulation.inside(|_| true));
    let twice = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|n| points[n as usize]);
        (b - a).perp_dot(c - a)
    };
    let area = 0.5 * triangles.corners.iter().map(twice).sum::<f64>();
    if triangles.corners.is_empty() || area.is_nan() || area <= 0.0 {
        return Err(FaceError::Empty);
    }
    options.refuse_quads(4.0 * area)?;
    Ok(area)
}

/// The graph without the inner segments that are not inside of the outline.
fn without_outer_curves(mut graph: Graph, monitor: &dyn Monitor) -> Result<Graph, FaceError> {
    if graph.segments.iter().all(|segment| segment.outline) {
        return Ok(graph);
    }
    let mut triangulation = Triangulation::new();
    let mut ids = vec![0; graph.points.len()];
    for segment in graph.segments.iter().filter(|segment| segment.outline) {
        for end in segment.ends {
            ids[end as usize] = triangulation.insert(graph.points[end as usize], monitor)?;
        }
    }
    for segment in graph.segments.iter().filter(|segment| segment.outline) {
        triangulation.constrain(segment.ends.map(|end| ids[end as usize]), monitor)?;
    }
    let inside = triangulation.inside(|_| true);
    let is_inside = |segment: &Segment| {
        let [a, b] = segment.ends.map(|end| graph.points[end as usize]);
        triangulation.locate(a.midpoint(b), 0).is_some_and(|(face, _)| inside[face])
    };
    let kept: Vec<Segment> = graph.segments.iter().filter(|s| s.outline || is_inside(s)).copied().collect();
    graph.segments = kept;
    Ok(graph)
}
