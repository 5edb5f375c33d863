//! A hex mesh that JavaScript loaded or had made: the input of refinement.

use std::collections::BTreeMap;
use std::sync::Arc;

use js_sys::{Float64Array, Uint32Array};
use serde::{Deserialize, Serialize};
use wasm_bindgen::prelude::{JsValue, wasm_bindgen};

use super::convert::{Extent, cells, points, to_object};
use super::errors::Failure;
use super::file;
use super::memory::Cost;
use super::pool::on_pool;
use crate::Silent;
use crate::geometry::{Aabb, Point};
use crate::io::{AnyMesh, Document};
use crate::mesh::check::{check_hexes_on, summary};
use crate::mesh::quality::{HexQualityReport, hex_quality};
use crate::mesh::topology::{HexReport, HexTopology, hex_report};
use crate::mesh::{GridError, GridOptions, MeshHash, NodeId, TagSet, hex_grid, mesh_hash, orient_hexes};

type Mesh = crate::mesh::HexMesh;

/// Loading hexes and looking them over, and making a grid of them.
const LOADING: Cost = Cost { bytes_per_cell: 520, most_asked: u64::MAX, cells: "hexes" };

/// A hex mesh in this module's memory.
#[wasm_bindgen]
pub struct HexMesh {
    pub(super) mesh: Arc<Mesh>,
    /// Hexes that were numbered inside out, and were turned.
    pub(super) turned: usize,
    dropped: Dropped,
}

/// What was in the file and is not in the mesh.
#[derive(Clone, Default, Serialize)]
#[serde(rename_all = "camelCase")]
struct Dropped {
    /// Hexes of the second order, of which the corners were read.
    linearized: usize,
    /// Cells that the file hides.
    hidden: usize,
    /// Faces that are no faces of the hexes.
    dropped_faces: usize,
    /// Arrays that are not read.
    dropped_arrays: Vec<String>,
}

/// What JavaScript shows of a hex mesh.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Info {
    #[serde(flatten)]
    report: HexReport,
    #[serde(flatten)]
    extent: Extent,
    hash: MeshHash,
    turned: usize,
    grouped_faces: usize,
    #[serde(flatten)]
    dropped: Dropped,
    losses: BTreeMap<&'static str, Vec<String>>,
    groups: Vec<Group>,
    /// Null for a mesh without hexes.
    quality: Option<HexQualityReport>,
    /// One line for each kind of defect.
    defects: Vec<String>,
}

/// A group of faces.
#[derive(Serialize)]
struct Group {
    names: Vec<String>,
    /// The number of each name.
    numbers: Vec<Option<f64>>,
    number: Option<f64>,
}

impl From<&TagSet> for Group {
    fn from(set: &TagSet) -> Self {
        // Numbers of JavaScript hold all that files have, but for some beyond 2^53.
        let (mut names, mut numbers) = (Vec::new(), Vec::new());
        for group in &set.groups {
            names.push(group.name.clone());
            numbers.push(group.number.map(|number| number as f64));
        }
        let others = set.object.iter().chain(&set.material);
        names.extend(others.cloned());
        numbers.resize(names.len(), None);
        Self { names, numbers, number: set.number.map(|number| number as f64) }
    }
}

/// The grid that JavaScript asked for.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct Grid {
    min: Point,
    max: Point,
    spacing: f64,
    #[serde(default)]
    margin: f64,
    #[serde(default)]
    fitted: bool,
    max_hexes: Option<u64>,
}

#[wasm_bindgen]
impl HexMesh {
    /// The hexes in a file of the named format; without one the content tells it.
    ///
    /// # Errors
    /// What the format's reader refuses, unknown formats, files of surfaces, and more hexes than memory holds.
    pub fn read(bytes: &[u8], format: Option<String>) -> Result<Self, Failure> {
        let document = file::read(bytes, format)?;
        let Document {
            mesh: AnyMesh::Hexes(mesh),
            tags,
            linearized,
            hidden,
            dropped_faces,
            dropped_arrays,
            ..
        } = document
        else {
            let message = "the file holds a surface; give a mesh of hexahedra, or make a grid around it";
            return Err(Failure::input("hexes-expected", &message));
        };
        let dropped = Dropped { linearized, hidden, dropped_faces, dropped_arrays };
        Ok(Self { dropped, ..Self::new(Mesh { tags, ..mesh })? })
    }

    /// Hexes given as arrays: x, y, z of each node, and the eight nodes of each hex in the order of VTK_HEXAHEDRON.
    ///
    /// # Errors
    /// If the arrays do not fit together, or there are more hexes than memory holds.
    #[wasm_bindgen(js_name = fromArrays)]
    pub fn from_arrays(nodes: Vec<f64>, hexes: Vec<u32>) -> Result<Self, Failure> {
        let positions = points(nodes)?;
        let hexes = cells(hexes, positions.len(), "hexes")?;
        Self::new(Mesh { positions, hexes, ..Mesh::default() })
    }

    /// A grid of cubes around a box; see `mesh::hex_grid`.
    ///
    /// # Errors
    /// What `hex_grid` refuses, options that are none, and grids that memory would not hold.
    pub fn grid(options: JsValue) -> Result<Self, Failure> {
        let Grid { min, max, spacing, margin, fitted, max_hexes } = serde_wasm_bindgen::from_value(options)?;
        let limit = LOADING.limit(max_hexes.unwrap_or(u64::MAX));
        let options = GridOptions { spacing, margin, fitted, max_hexes: limit.cells };
        let mesh = on_pool(|| hex_grid(Aabb { min, max }, &options)).map_err(|error| match error {
            GridError::TooManyHexes { counts, .. } if limit.is_memory_s => {
                limit.exceeded(counts.iter().product(), "give a larger spacing")
            }
            other => other.into(),
        })?;
        Ok(Self { mesh: Arc::new(mesh), turned: 0, dropped: Dropped::default() })
    }

    /// What is known of the mesh: an object with the fields of `HexInfo` in `www/lib/results.ts`.
    ///
    /// # Errors
    /// None in practice: numbers and words can always be converted.
    pub fn info(&self) -> Result<JsValue, Failure> {
        to_object(&on_pool(|| Info::of(self)))
    }

    /// x, y, z of each node.
    pub fn nodes(&self) -> Float64Array {
        bytemuck::cast_slice::<Point, f64>(&self.mesh.positions).into()
    }

    /// The eight nodes of each hex.
    pub fn hexes(&self) -> Uint32Array {
        bytemuck::cast_slice::<[NodeId; 8], u32>(&self.mesh.hexes).into()
    }
}

impl HexMesh {
    /// Turns hexes that are numbered inside out. Those that are so in part stay, for `info` to tell and refinement
    /// to refuse.
    fn new(mut mesh: Mesh) -> Result<Self, Failure> {
        let (hexes, limit) = (mesh.hexes.len(), LOADING.limit(u64::MAX));
        if hexes as u64 > limit.cells {
            return Err(limit.exceeded(hexes as f64, "give a smaller mesh"));
        }
        let turned = on_pool(|| orient_hexes(&mut mesh)).unwrap_or(0);
        Ok(Self { mesh: Arc::new(mesh), turned, dropped: Dropped::default() })
    }
}

impl Info {
    fn of(HexMesh { mesh, turned, dropped }: &HexMesh) -> Self {
        let topology = HexTopology::of(mesh);
        let defects = check_hexes_on(mesh, &topology, &Silent).expect("nobody stops it");
        Self {
            report: hex_report(&topology),
            extent: Extent::of(&mesh.positions, &topology.edges.ends),
            hash: mesh_hash(&mesh.positions, &mesh.hexes),
            turned: *turned,
            grouped_faces: mesh.groups.sides().len(),
            dropped: dropped.clone(),
            losses: file::losses(&mesh.tags, Some(&mesh.groups)),
            groups: mesh.groups.tags().sets.iter().map(Group::from).collect(),
            quality: hex_quality(mesh).report(),
            defects: summary(&defects).iter().map(ToString::to_string).collect(),
        }
    }
}
