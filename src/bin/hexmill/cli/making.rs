//! What every command that makes a mesh does before its work and after it.

use std::path::Path;

use hexmill::io::{self, Document, Format};

use super::args::Making;
use super::failure::Failure;
use super::files::{Loaded, check_outputs, format_to_read, save, warn_of_losses};
use super::mesh_report::{Counts, MeshReport};
use super::progress::Progress;
use super::report::{FileReport, InputReport, Report, peak_memory_bytes};
use super::tell::print;

/// A mesh that was made.
pub(super) struct Made<'a> {
    pub(super) command: &'static str,
    /// The file that the mesh was made of, and what was in it.
    pub(super) input: (&'a Loaded, Counts),
    pub(super) document: &'a Document,
    /// Elements that are larger than asked for, where levels are.
    pub(super) capped: Option<usize>,
}

impl Making {
    /// Refuses outputs that are inputs or each other, and starts the threads. The first of `inputs` is the mesh to read.
    pub(super) fn prepare(&self, inputs: &[(&str, &Path)]) -> Result<(), Failure> {
        if let Some((_, mesh)) = inputs.first() {
            format_to_read(mesh)?;
        }
        let report = self.working.report.as_deref().map(|path| ("--report", path));
        let outputs: Vec<_> = std::iter::once(("--output", self.output.as_path())).chain(report).collect();
        check_outputs(inputs, &outputs)?;
        self.working.threads.map_or(Ok(()), use_threads)
    }

    /// Writes the mesh, warns of what the format has no room for, and begins the record of the command.
    pub(super) fn write(
        &self,
        made: &Made<'_>,
        format: Format,
        progress: &Progress,
        quiet: bool,
    ) -> Result<Report, Failure> {
        let bytes = progress
            .stage("encode", || io::write(made.document, format))
            .map_err(|e| Failure::write(&self.output, &e))?;
        progress.stage("write", || save(&self.output, &bytes))?;
        warn_of_losses(&self.output, made.document, format, quiet);
        let output = FileReport::new(&self.output, format, bytes.len() as u64);
        drop(bytes);
        let mut mesh = progress.stage("measure", || MeshReport::of(made.document, made.capped));
        if self.working.report.is_some() {
            progress.stage("check", || mesh.check(&made.document.mesh));
        }
        let (loaded, before) = made.input;
        let report = Report::new(made.command, InputReport::new(loaded, before), mesh);
        Ok(Report { output: Some(output), ..report })
    }

    /// Ends the record, saves it if that is wanted, and tells people what was made unless `quiet`.
    pub(super) fn close(
        &self,
        mut report: Report,
        progress: &Progress,
        quiet: bool,
        in_words: fn(&Path, &Report) -> String,
    ) -> Result<(), Failure> {
        (report.stages, report.seconds) = progress.finish();
        report.peak_memory_bytes = peak_memory_bytes();
        self.working.report.as_deref().map_or(Ok(()), |path| report.save(path))?;
        if quiet { Ok(()) } else { print(&in_words(&self.output, &report)) }
    }
}

/// Makes the library's work run on `threads` threads, of which this is one: a thread from without would have to wake
/// others for every loop, and wait for them.
pub(super) fn use_threads(threads: u16) -> Result<(), Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads)).use_current_thread();
    pool.build_global().map_err(|error| {
        Failure::refused(
            "threads-not-started",
            format!("{threads} threads cannot be started: {error}; give fewer"),
        )
    })
}
