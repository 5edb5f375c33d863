//! A surface that JavaScript loaded: the input of refinement.

use std::collections::BTreeMap;
use std::sync::Arc;

use js_sys::{Float64Array, Uint32Array};
use serde::Serialize;
use wasm_bindgen::prelude::{JsValue, wasm_bindgen};

use super::convert::{Extent, check_ids, points, to_object};
use super::errors::Failure;
use super::file;
use super::pool::on_pool;
use crate::geometry::Point;
use crate::mesh::check::{check_polygons, summary};
use crate::mesh::topology::{SurfaceReport, surface_report};
use crate::mesh::{Edges, MeshHash, NodeId, PolygonMesh, polygon_hash};

/// A polygon surface in this module's memory.
#[wasm_bindgen]
pub struct Surface {
    pub(super) mesh: Arc<PolygonMesh>,
    dropped: Dropped,
}

/// What was in the file and is not in the mesh.
#[derive(Clone, Default, Serialize)]
#[serde(rename_all = "camelCase")]
struct Dropped {
    /// Cells that the file hides.
    hidden: usize,
    /// Arrays that are not read.
    dropped_arrays: Vec<String>,
}

/// What JavaScript shows of a surface.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Info {
    #[serde(flatten)]
    report: SurfaceReport,
    hash: MeshHash,
    triangles: usize,
    quads: usize,
    /// Faces of five nodes and more.
    polygons: usize,
    #[serde(flatten)]
    extent: Extent,
    #[serde(flatten)]
    dropped: Dropped,
    losses: BTreeMap<&'static str, Vec<String>>,
    /// One line for each kind of defect.
    defects: Vec<String>,
}

#[wasm_bindgen]
impl Surface {
    /// The surface in a file of the named format; without one the content tells it.
    ///
    /// # Errors
    /// What the format's reader refuses, unknown formats, and files of hexahedra.
    pub fn read(bytes: &[u8], format: Option<String>) -> Result<Self, Failure> {
        let mut document = file::read(bytes, format)?;
        let dropped_arrays = std::mem::take(&mut document.dropped_arrays);
        let dropped = Dropped { hidden: document.hidden, dropped_arrays };
        let mesh = document.into_surface().ok_or_else(|| {
            let message = "the file holds hexahedra; give a surface of polygons";
            Failure::input("surface-expected", &message)
        })?;
        Ok(Self { mesh: Arc::new(mesh), dropped })
    }

    /// A surface of faces given as arrays: x, y, z of each node; where each face's corners start, and the end of
    /// the last; the nodes of all faces. Without `offsets` all faces are quads.
    ///
    /// # Errors
    /// If the arrays do not fit together.
    #[wasm_bindgen(js_name = fromArrays)]
    pub fn from_arrays(nodes: Vec<f64>, offsets: Option<Vec<u32>>, corners: &[u32]) -> Result<Self, Failure> {
        let positions = points(nodes)?;
        check_ids(corners, positions.len())?;
        let offsets = match offsets {
            Some(offsets) => offsets,
            None if corners.len().is_multiple_of(4) => (0..=corners.len() as u32).step_by(4).collect(),
            None => {
                let message = format!("{} corners are no quads; give offsets for other faces", corners.len());
                return Err(Failure::input("array-length", &message));
            }
        };
        check_offsets(&offsets, corners.len())?;
        let corners = corners.iter().copied().map(NodeId).collect();
        let mesh = PolygonMesh { positions, offsets, corners, ..PolygonMesh::default() };
        Ok(Self { mesh: Arc::new(mesh), dropped: Dropped::default() })
    }

    /// What is known of the surface: an object with the fields of `SurfaceInfo` in `www/lib/results.ts`.
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

    /// Where each face's corners start, and the end of the last.
    pub fn offsets(&self) -> Uint32Array {
        self.mesh.offsets.as_slice().into()
    }

    /// The nodes of all faces, face after face.
    pub fn corners(&self) -> Uint32Array {
        bytemuck::cast_slice::<NodeId, u32>(&self.mesh.corners).into()
    }
}

impl Info {
    fn of(Surface { mesh, dropped }: &Surface) -> Self {
        let mesh: &PolygonMesh = mesh;
        let edges = Edges::of_polygons(mesh);
        let faces_of = |wanted: fn(usize) -> bool| mesh.faces().filter(|f| wanted(f.len())).count();
        Self {
            report: surface_report(mesh, &edges),
            hash: polygon_hash(mesh),
            triangles: faces_of(|n| n == 3),
            quads: faces_of(|n| n == 4),
            polygons: faces_of(|n| n > 4),
            extent: Extent::of(&mesh.positions, &edges.ends),
            dropped: dropped.clone(),
            losses: file::losses(&mesh.tags, None),
            defects: summary(&check_polygons(mesh)).iter().map(ToString::to_string).collect(),
        }
    }
}

fn check_offsets(offsets: &[u32], corners: usize) -> Result<(), Failure> {
    let ends = offsets.first() == Some(&0) && offsets.last().map(|&end| end as usize) == Some(corners);
    if !ends {
        let message = format!("offsets have to start with 0 and end with the number of corners, {corners}");
        return Err(Failure::input("array-offsets", &message));
    }
    match offsets.windows(2).position(|w| w[1] < w[0] || w[1] - w[0] < 3) {
        None => Ok(()),
        Some(face) => {
            let message = format!("face {face} has fewer than 3 corners by its offsets");
            Err(Failure::input("array-offsets", &message))
        }
    }
}
