//! What is known of a mesh: a part of every command's record, and its lines for people.

use hexmill::Silent;
use hexmill::geometry::Aabb;
use hexmill::io::{AnyMesh, Document};
use hexmill::mesh::check::{DefectCount, check_hexes_on, summary};
use hexmill::mesh::quality::{Distribution, HexQualityReport, QualityReport, hex_quality, quad_quality};
use hexmill::mesh::topology::{HexReport, HexTopology, SurfaceReport, hex_report, surface_report};
use hexmill::mesh::{
    Defect, Edges, Faces, HexMesh, MeshHash, NodeId, PolygonMesh, QuadMesh, Volumes, check_polygons,
    check_quads, mesh_hash, polygon_hash,
};
use serde::Serialize;

use super::words::counted;

/// Defects that are listed one by one; all of them are counted.
const LISTED_DEFECTS: usize = 1000;

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
    /// Faces of hexes that are in groups.
    pub(crate) grouped_faces: usize,
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
        let grouped_faces = mesh.groups.sides().len();
        Self { hexes: mesh.hexes.len(), grouped_faces, ..Self::of_nodes(mesh.positions.len(), mesh.bounds()) }
    }

    fn of_nodes(nodes: usize, around: Aabb) -> Self {
        let bounds = bounds(around);
        Self { nodes, faces: 0, triangles: 0, quads: 0, polygons: 0, hexes: 0, grouped_faces: 0, bounds }
    }

    /// In words, such as `8 nodes, 6 quads`.
    pub(crate) fn in_words(&self) -> String {
        let mut words = vec![counted(self.nodes, "node", "nodes")];
        let kinds = [
            (self.triangles, "triangle", "triangles"),
            (self.quads, "quad", "quads"),
            (self.polygons, "larger polygon", "larger polygons"),
            (self.hexes, "hex", "hexes"),
            (self.grouped_faces, "face in a group", "faces in groups"),
        ];
        words.extend(kinds.iter().filter(|kind| kind.0 > 0).map(|&(n, one, many)| counted(n, one, many)));
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
    /// Elements that are larger than asked for, where levels are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) capped: Option<usize>,
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
    /// Measures the mesh of a document. Quality is that of its quads or hexes.
    pub(crate) fn of(document: &Document, capped: Option<usize>) -> Self {
        let (counts, hash, quality, volume) = match &document.mesh {
            AnyMesh::Polygons(mesh) => {
                let quality = quad_quality(&quads_of(mesh)).report().map(Quality::Quads);
                (Counts::of_polygons(mesh), polygon_hash(mesh), quality, None)
            }
            AnyMesh::Quads(mesh) => {
                let quality = quad_quality(mesh).report().map(Quality::Quads);
                (Counts::of_quads(mesh), mesh_hash(&mesh.positions, &mesh.quads), quality, None)
            }
            AnyMesh::Hexes(mesh) => {
                let quality = hex_quality(mesh).report().map(Quality::Hexes);
                let hash = mesh_hash(&mesh.positions, &mesh.hexes);
                (Counts::of_hexes(mesh), hash, quality, Volumes::of(mesh))
            }
        };
        let levels = levels(&document.level);
        Self { counts, hash, levels, capped, quality, volume, topology: None, defects: None }
    }

    /// Adds what kind of surface or solid the mesh is, and its defects: the slow part.
    pub(crate) fn check(&mut self, mesh: &AnyMesh) {
        let (topology, defects) = match mesh {
            AnyMesh::Polygons(mesh) => (surface_topology(mesh), check_polygons(mesh)),
            AnyMesh::Quads(mesh) => (surface_topology(mesh), check_quads(mesh)),
            AnyMesh::Hexes(mesh) => {
                let topology = HexTopology::of(mesh);
                let defects = check_hexes_on(mesh, &topology, &Silent).expect("nobody stops it");
                (Topology::Solid(hex_report(&topology)), defects)
            }
        };
        self.topology = Some(topology);
        self.defects = Some(Defects::new(defects));
    }
}

fn surface_topology<M: Faces>(mesh: &M) -> Topology {
    Topology::Surface(surface_report(mesh, &Edges::of(mesh)))
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
