//! The end of every command that makes a mesh: encode, write, measure.

use std::path::Path;

use hexmill::io::{self, Document, Format};

use super::failure::Failure;
use super::files::{Loaded, save};
use super::mesh_report::{Counts, MeshReport};
use super::progress::Progress;
use super::report::{FileReport, InputReport, Report};

/// A mesh and where it goes.
pub(super) struct Delivery<'a> {
    pub(super) command: &'static str,
    /// The file that the mesh was made of, and what was in it.
    pub(super) input: (&'a Loaded, Counts),
    pub(super) document: &'a Document,
    /// Elements that are larger than asked for.
    pub(super) capped: usize,
    pub(super) output: &'a Path,
    pub(super) format: Format,
    /// Is the mesh to be looked over too?
    pub(super) is_checked: bool,
}

impl Delivery<'_> {
    /// Writes the mesh, and begins the record of the command.
    pub(super) fn write(&self, progress: &Progress) -> Result<Report, Failure> {
        let bytes = progress
            .stage("encode", || io::write(self.document, self.format))
            .map_err(|e| Failure::write(self.output, &e))?;
        progress.stage("write", || save(self.output, &bytes))?;
        let output = FileReport::new(self.output, self.format, bytes.len() as u64);
        drop(bytes);
        let mut mesh = progress.stage("measure", || MeshReport::of(self.document, self.capped));
        if self.is_checked {
            progress.stage("check", || mesh.check(&self.document.mesh));
        }
        let (loaded, before) = self.input;
        let report = Report::new(self.command, InputReport::new(loaded, before), mesh);
        Ok(Report { output: Some(output), ..report })
    }
}
