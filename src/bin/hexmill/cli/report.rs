//! The record of a command as JSON, documented in `docs/report.md`, and its lines for people.

use std::path::Path;

use hexmill::geometry::Aabb;
use hexmill::io::Format;
use hexmill::mesh::check::{DefectCount, summary};
use hexmill::mesh::quality::{Distribution, HexQualityReport, QualityReport, hex_quality, quad_quality};
use hexmill::mesh::topology::{HexEdges, HexFaces, HexReport, SurfaceReport, hex_report, surface_report};
use hexmill::mesh::{
    Defect, Edges, Faces, HexMesh, MeshHash, NodeId, PolygonMesh, QuadMesh, Volumes, check_hexes, mesh_hash,
    polygon_hash,
};
use hexmill::refine::hex::{Added, Method, StageReport};
use serde::Serialize;

use super::distance::Distances;
use super::failure::Failure;
use super::files::{Loaded, save};
use super::progress::StageSeconds;

/// The version of the record's form. Fields may be added within a version, but not changed or removed.
const SCHEMA: &str = "hexmill-report/1";

/// Defects that are listed one by one; all of them are counted.
const LISTED_DEFECTS: usize = 1000;

/// The record of a command.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Report {
    pub(crate) schema: &'static str,
    pub(crate) version: &'static str,
    pub(crate) command: &'static str,
    pub(crate) input: InputReport,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) options: Option<OptionsReport>,
    /// Of a refinement of hexes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) refinement: Option<HexRefinementReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) output: Option<FileReport>,
    pub(crate) mesh: MeshReport,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) distance: Option<Distances>,
    pub(crate) threads: usize,
    pub(crate) stages: Vec<StageSeconds>,
    pub(crate) seconds: f64,
    pub(crate) peak_memory_bytes: Option<u64>,
}

impl Report {
    /// A record of what `command` made of `input`, with its times still to be filled in.
    pub(crate) fn new(command: &'static str, input: InputReport, mesh: MeshReport) -> Self {
        Self {
            schema: SCHEMA,
            version: env!("CARGO_PKG_VERSION"),
            command,
            input,
            options: None,
            refinement: None,
            output: None,
            mesh,
            distance: None,
            threads: rayon::current_num_threads(),
            stages: Vec::new(),
            seconds: 0.0,
            peak_memory_bytes: None,
        }
    }

    /// Writes the record to `path`.
    pub(crate) fn save(&self, path: &Path) -> Result<(), Failure> {
        let mut text = serde_json::to_vec_pretty(self).expect("a report has no maps and no odd keys");
        text.push(b'\n');
        save(path, &text)
    }
}

/// A file.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct FileReport {
    file: String,
    format: &'static str,
    bytes: u64,
}

impl FileReport {
    pub(crate) fn new(path: &Path, format: Format, bytes: u64) -> Self {
        Self { file: path.display().to_string(), format: format.name(), bytes }
    }
}

/// The file that was read, and the mesh in it.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct InputReport {
    #[serde(flatten)]
    file: FileReport,
    #[serde(flatten)]
    counts: Counts,
}

impl InputReport {
    pub(crate) fn new(loaded: &Loaded, counts: Counts) -> Self {
        Self { file: FileReport::new(&loaded.path, loaded.format, loaded.bytes), counts }
    }
}

/// What the refinement of hexes did.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct HexRefinementReport {
    pub(crate) added: Added,
    pub(crate) turned: usize,
    pub(crate) levels: Vec<StageReport>,
}

/// The command line's options as they were given, defaults filled in.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct OptionsReport {
    pub(crate) edge_length: Option<f64>,
    pub(crate) levels: Option<u8>,
    pub(crate) regions: Vec<String>,
    pub(crate) curvature: Option<f64>,
    pub(crate) gradation: f64,
    pub(crate) keep_coarse: bool,
    pub(crate) max_levels: u8,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) max_quads: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) max_hexes: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) method: Option<Method>,
}

/// How many of what.
#[derive(Clone, Copy, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Counts {
    pub(crate) nodes: usize,
    pub(crate) faces: usize,
    pub(crate) triangles: usize,
    pub(crate) quads: usize,
    pub(crate) polygons: usize,
    pub(crate) hexes: usize,
    bounds: Option<Bounds>,
}

/// The smallest box around the nodes.
#[derive(Clone, Copy, Serialize)]
struct Bounds {
    min: [f64; 3],
    max: [f64; 3],
}

impl Counts {
    pub(crate) fn of_polygons(mesh: &PolygonMesh) -> Self {
        let of_size = |n: usize| mesh.faces().filter(|f| f.len() == n).count();
        let (faces, triangles, quads) = (mesh.face_count(), of_size(3), of_size(4));
        let polygons = faces - triangles - quads;
        Self { faces, triangles, quads, polygons, ..Self::of_nodes(mesh.positions.len(), mesh.bounds()) }
    }

    fn of_quads(mesh: &QuadMesh) -> Self {
        let quads = mesh.quads.len();
        Self { faces: quads, quads, ..Self::of_nodes(mesh.positions.len(), mesh.bounds()) }
    }

    pub(crate) fn of_hexes(mesh: &HexMesh) -> Self {
        Self { hexes: mesh.hexes.len(), ..Self::of_nodes(mesh.positions.len(), mesh.bounds()) }
    }

    fn of_nodes(nodes: usize, around: Aabb) -> Self {
        Self { nodes, faces: 0, triangles: 0, quads: 0, polygons: 0, hexes: 0, bounds: bounds(around) }
    }

    /// In words, such as `8 nodes, 6 quads`.
    pub(crate) fn in_words(&self) -> String {
        let mut words = vec![format!("{} nodes", self.nodes)];
        let kinds = [
            (self.triangles, "triangles"),
            (self.quads, "quads"),
            (self.polygons, "larger polygons"),
            (self.hexes, "hexes"),
        ];
        words.extend(kinds.iter().filter(|(n, _)| *n > 0).map(|(n, kind)| format!("{n} {kind}")));
        if self.faces == 0 && self.hexes == 0 {
            words.push("no faces".to_owned());
        }
        words.join(", ")
    }
}

fn bounds(of: Aabb) -> Option<Bounds> {
    (!of.is_empty()).then(|| Bounds { min: of.min.to_array(), max: of.max.to_array() })
}

/// Everything known of a mesh.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct MeshReport {
    #[serde(flatten)]
    pub(crate) counts: Counts,
    pub(crate) hash: MeshHash,
    pub(crate) levels: Vec<LevelCount>,
    pub(crate) capped: usize,
    pub(crate) quality: Option<Quality>,
    /// Of hexes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) volume: Option<Volumes>,
    /// Filled in by [`MeshReport::check`].
    pub(crate) topology: Option<Topology>,
    /// Filled in by [`MeshReport::check`].
    pub(crate) defects: Option<Defects>,
}

/// How good the cells of a mesh are.
#[derive(Serialize)]
#[serde(untagged)]
pub(crate) enum Quality {
    Quads(QualityReport),
    Hexes(HexQualityReport),
}

/// What kind of surface or solid a mesh is.
#[derive(Serialize)]
#[serde(untagged)]
pub(crate) enum Topology {
    Surface(SurfaceReport),
    Solid(HexReport),
}

/// How many cells are of a level.
#[derive(Serialize)]
pub(crate) struct LevelCount {
    pub(crate) level: u8,
    pub(crate) cells: usize,
}

/// What is wrong with a mesh.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Defects {
    /// True if nothing of severity `error` was found.
    pub(crate) conforming: bool,
    pub(crate) counts: Vec<DefectCount>,
    list: Vec<Defect>,
}

impl Defects {
    fn new(mut defects: Vec<Defect>) -> Self {
        let counts = summary(&defects);
        let conforming = !defects.iter().any(Defect::is_error);
        defects.sort_by_key(|defect| std::cmp::Reverse(defect.severity()));
        defects.truncate(LISTED_DEFECTS);
        Self { conforming, counts, list: defects }
    }
}

impl MeshReport {
    /// Measures a quad mesh whose quads have these levels (none, or one a quad).
    pub(crate) fn of_quads(mesh: &QuadMesh, level: &[u8], capped: usize) -> Self {
        Self {
            counts: Counts::of_quads(mesh),
            hash: mesh_hash(&mesh.positions, &mesh.quads),
            levels: levels(level),
            capped,
            quality: quad_quality(mesh).report().map(Quality::Quads),
            volume: None,
            topology: None,
            defects: None,
        }
    }

    /// Measures a polygon mesh. Quality is that of its quads.
    pub(crate) fn of_polygons(mesh: &PolygonMesh, level: &[u8]) -> Self {
        let quads = quads_of(mesh);
        if mesh.is_all_quad() {
            return Self::of_quads(&quads, level, 0);
        }
        Self {
            counts: Counts::of_polygons(mesh),
            hash: polygon_hash(mesh),
            levels: levels(level),
            capped: 0,
            quality: quad_quality(&quads).report().map(Quality::Quads),
            volume: None,
            topology: None,
            defects: None,
        }
    }

    /// Adds what kind of surface the mesh is, and its `defects`: the slow part.
    pub(crate) fn check<M: Faces>(&mut self, mesh: &M, defects: fn(&M) -> Vec<Defect>) {
        self.topology = Some(Topology::Surface(surface_report(mesh, &Edges::of(mesh))));
        self.defects = Some(Defects::new(defects(mesh)));
    }

    /// Measures a hex mesh whose hexes have these levels (none, or one a hex).
    pub(crate) fn of_hexes(mesh: &HexMesh, level: &[u8], capped: usize) -> Self {
        Self {
            counts: Counts::of_hexes(mesh),
            hash: mesh_hash(&mesh.positions, &mesh.hexes),
            levels: levels(level),
            capped,
            quality: hex_quality(mesh).report().map(Quality::Hexes),
            volume: Volumes::of(mesh),
            topology: None,
            defects: None,
        }
    }

    /// As [`MeshReport::check`], for a hex mesh.
    pub(crate) fn check_hexes(&mut self, mesh: &HexMesh) {
        let (count, hexes) = (mesh.positions.len(), mesh.hexes.as_slice());
        let report = hex_report(mesh, &HexFaces::of(count, hexes), &HexEdges::of(count, hexes));
        self.topology = Some(Topology::Solid(report));
        self.defects = Some(Defects::new(check_hexes(mesh)));
    }
}

/// The quads of a polygon mesh.
fn quads_of(mesh: &PolygonMesh) -> QuadMesh {
    let quads = mesh.faces().filter_map(|face| <[NodeId; 4]>::try_from(face).ok()).collect();
    QuadMesh { positions: mesh.positions.clone(), quads }
}

fn levels(level: &[u8]) -> Vec<LevelCount> {
    let mut cells = [0_usize; 256];
    for &l in level {
        cells[usize::from(l)] += 1;
    }
    (0..=255).zip(cells).filter(|(_, n)| *n > 0).map(|(level, cells)| LevelCount { level, cells }).collect()
}

/// A distribution's ends and mean in a line of a table.
pub(crate) fn quality_line(name: &str, values: &Distribution) -> String {
    let s = &values.summary;
    format!("  {name:<16} {:>9.3} {:>9.3} {:>9.3} {:>9.3}", s.min, s.percentile_1, s.mean, s.max)
}

/// The quality of a mesh as a table.
pub(crate) fn quality_table(quality: &Quality) -> String {
    let mut lines = vec![format!("  {:<16} {:>9} {:>9} {:>9} {:>9}", "quality", "min", "1%", "mean", "max")];
    match quality {
        Quality::Quads(quality) => lines.extend([
            quality_line("scaled Jacobian", &quality.scaled_jacobian),
            quality_line("least angle", &quality.min_angle),
            quality_line("greatest angle", &quality.max_angle),
            quality_line("aspect", &quality.aspect),
        ]),
        Quality::Hexes(quality) => lines.extend([
            quality_line("scaled Jacobian", &quality.scaled_jacobian),
            quality_line("aspect", &quality.aspect),
        ]),
    }
    lines.join("\n")
}

/// The most memory that this program has held so far, where the system tells.
pub(crate) fn peak_memory_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024)
}
