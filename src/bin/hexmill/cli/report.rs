//! The record of a command as JSON, documented in `docs/report.md`.

use std::path::Path;

use hexmill::hexing::{Background, HexingReport};
use hexmill::io::Format;
use hexmill::mesh::NodeId;
use hexmill::mesh::{Distances, Features, SecondOrderHex};
use hexmill::refine::hex::{Added, Growth, HexForecast, Method, StageReport};
use serde::Serialize;

use super::failure::Failure;
use super::files::{Loaded, save};
use super::mesh_report::{Counts, MeshReport};
use super::progress::StageSeconds;
use super::words::counted;

/// The version of the record's form. Fields may be added within a version, but not changed or removed.
const SCHEMA: &str = "hexmill-report/1";

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
    /// Of a refinement of a surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) dropped_features: Option<DroppedFeatures>,
    /// The regions that overlap no part of what was to be refined, or of a solid's mesh.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) idle_regions: Vec<String>,
    /// Of the meshing of a solid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) hexing: Option<HexingReport>,
    /// Of a planar face.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) face: Option<FaceReport>,
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
    /// The regions that refine nothing, a line each.
    pub(crate) fn idle_in_words(&self) -> impl Iterator<Item = String> {
        let idle = |region| format!("  region {region} meets nothing of the input and refines nothing");
        self.idle_regions.iter().map(idle)
    }

    /// A record of what `command` made of `input`, with its times still to be filled in.
    pub(crate) fn new(command: &'static str, input: InputReport, mesh: MeshReport) -> Self {
        Self {
            schema: SCHEMA,
            version: env!("CARGO_PKG_VERSION"),
            command,
            input,
            options: None,
            refinement: None,
            dropped_features: None,
            idle_regions: Vec::new(),
            hexing: None,
            face: None,
            output: None,
            mesh,
            distance: None,
            threads: hexmill::parallel::thread_count(),
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

/// Features of a surface that the refined mesh has not.
#[derive(Clone, Copy, Serialize)]
pub(crate) struct DroppedFeatures {
    pub(crate) polylines: usize,
    pub(crate) creases: usize,
    pub(crate) corners: usize,
}

impl DroppedFeatures {
    /// `None` if there are none.
    pub(crate) fn of(features: &Features) -> Option<Self> {
        let Features { polylines, creases, corners, interpolate_boundary: _ } = features;
        let [polylines, creases, corners] = [polylines.len(), creases.len(), corners.len()];
        (polylines + creases + corners > 0).then_some(Self { polylines, creases, corners })
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
    pub(crate) forecast: HexForecast,
    pub(crate) added: Added,
    pub(crate) turned: usize,
    pub(crate) levels: Vec<StageReport>,
}

impl HexRefinementReport {
    /// What was not told before the work, a line each; `hexes` is how many there are.
    pub(crate) fn in_words(&self, hexes: usize) -> Vec<String> {
        let Self { forecast, added, turned, levels } = self;
        let transition = levels.last().map_or(0, |stage| stage.transition);
        let told = [
            (
                *turned > 0,
                format!(
                    "{} of the input {} numbered inside out, and turned",
                    counted(*turned, "hex", "hexes"),
                    if *turned == 1 { "was" } else { "were" }
                ),
            ),
            (
                added.repairs > 0,
                format!(
                    "{} refined where transition hexes could not be untangled",
                    counted(added.repairs, "element is", "elements are")
                ),
            ),
            (
                hexes != forecast.hexes,
                format!("{}, not {} as was told before", counted(hexes, "hex", "hexes"), forecast.hexes),
            ),
            (
                transition > 0,
                format!(
                    "{} of the last level",
                    counted(transition, "hex is a transition", "hexes are transitions")
                ),
            ),
        ];
        told.into_iter().filter(|(is_so, _)| *is_so).map(|(_, line)| format!("  {line}")).collect()
    }
}

/// The command line's options as they were given, defaults filled in. Regions are the strings of the command line: their
/// files may be large.
#[derive(Serialize)]
#[serde(untagged)]
pub(crate) enum OptionsReport {
    Refinement(RefinementOptions),
    Hexing(SolidOptions),
}

impl OptionsReport {
    pub(crate) fn max_levels(&self) -> u8 {
        match self {
            Self::Refinement(options) => options.max_levels,
            Self::Hexing(options) => options.max_levels,
        }
    }
}

/// Those of a solid to be meshed.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct SolidOptions {
    pub(crate) edge_length: f64,
    pub(crate) regions: Vec<String>,
    pub(crate) background: Background,
    pub(crate) curvature: Option<f64>,
    pub(crate) feature_angle: f64,
    pub(crate) max_distance: Option<f64>,
    pub(crate) max_levels: u8,
    pub(crate) max_hexes: u64,
    pub(crate) second_order: Option<SecondOrderHex>,
}

/// Those of a refinement.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct RefinementOptions {
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
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) growth: Option<Growth>,
}

/// What was asked of the mesh of a planar face, and what could not be met.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct FaceReport {
    pub(crate) edge_length: f64,
    pub(crate) max_quads: u64,
    pub(crate) off_curve: Vec<(NodeId, f64)>,
    pub(crate) dropped_polylines: Vec<u32>,
}

/// The most memory that this program has held so far, where the system tells.
pub(crate) fn peak_memory_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024)
}
