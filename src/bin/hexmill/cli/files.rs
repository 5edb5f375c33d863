//! Reading meshes from files, and writing files whole or not at all.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard};

use hexmill::io::{self, Document, Format};
use hexmill::mesh::PolygonMesh;

use super::failure::Failure;
use super::tell::tell;
use super::words::counted;

/// What an interruption has to know of the files that are written.
struct Outputs {
    /// The temporary file that is being written, to be removed.
    unfinished: Option<PathBuf>,
    /// The files that are done.
    written: Vec<String>,
}

static OUTPUTS: Mutex<Outputs> = Mutex::new(Outputs { unfinished: None, written: Vec::new() });

fn outputs() -> MutexGuard<'static, Outputs> {
    OUTPUTS.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// The exit code of a program that Ctrl-C ended, as shells have it: 128 + SIGINT.
const INTERRUPTED: i32 = 130;

/// Makes Ctrl-C (and a request to terminate) remove what is half written before it ends the program.
pub(crate) fn remove_unfinished_when_interrupted() {
    let stop = || {
        let outputs = outputs();
        if let Some(path) = &outputs.unfinished {
            // It may be gone already; there is nobody left to tell.
            let _ = fs::remove_file(path);
        }
        match outputs.written.as_slice() {
            [] => tell("interrupted: nothing was written\n"),
            written => tell(&format!("interrupted after {} was written\n", written.join(", "))),
        }
        // The lock is still held, so that no output is renamed into place between here and the end.
        std::process::exit(INTERRUPTED);
    };
    if let Err(error) = ctrlc::set_handler(stop) {
        tell(&format!("warning: Ctrl-C may leave temporary files behind: {error}\n"));
    }
}

/// The format of a file to read, by its extension.
pub(crate) fn format_to_read(path: &Path) -> Result<Format, Failure> {
    format_of(path, Format::is_read, "files are only written")
}

/// The format of a file to write, by its extension.
pub(crate) fn format_to_write(path: &Path) -> Result<Format, Failure> {
    format_of(path, Format::is_written, "files are only read")
}

/// The format of a file to write hexes to, by its extension.
pub(crate) fn format_for_hexes(path: &Path) -> Result<Format, Failure> {
    format_to_write(path)?;
    format_of(path, Format::takes_hexes, "files hold no hexes")
}

/// The format of a file to write hexes of the second order to, by its extension.
pub(crate) fn format_for_second_order(path: &Path) -> Result<Format, Failure> {
    format_for_hexes(path)?;
    format_of(path, Format::takes_second_order, "files are written with hexes of the first order only")
}

/// The format that the extension of `path` names, which has to be a wanted one; `otherwise` says what those are that are
/// not.
fn format_of(path: &Path, is_wanted: fn(Format) -> bool, otherwise: &str) -> Result<Format, Failure> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    let reason = match Format::from_extension(extension) {
        Some(format) if is_wanted(format) => return Ok(format),
        Some(format) => format!("{} {otherwise}", format.name().to_uppercase()),
        None => "the extension names no mesh format".to_owned(),
    };
    let wanted: Vec<String> =
        Format::ALL.iter().filter(|&&f| is_wanted(f)).map(|f| format!(".{f}")).collect();
    Err(Failure::Usage(format!("{}: {reason}; use one of {}", path.display(), wanted.join(", "))))
}

/// A mesh and the file that it came from.
pub(crate) struct Loaded {
    pub(crate) path: PathBuf,
    pub(crate) format: Format,
    pub(crate) bytes: u64,
    pub(crate) document: Document,
}

/// Reads the mesh in `path`.
pub(crate) fn load(path: &Path) -> Result<Loaded, Failure> {
    let format = format_to_read(path)?;
    let bytes = fs::read(path).map_err(|error| Failure::file("file-not-read", "read", path, &error))?;
    let document = io::read(&bytes, format).map_err(|error| Failure::read(path, &error))?;
    Ok(Loaded { path: path.to_owned(), format, bytes: bytes.len() as u64, document })
}

impl Loaded {
    /// Takes the mesh out, and leaves an empty one.
    pub(crate) fn take_document(&mut self) -> Document {
        std::mem::replace(&mut self.document, Document::from(PolygonMesh::default()))
    }

    /// Warns of nodes, faces, groups and arrays in a file that could not be kept.
    pub(crate) fn warn_of_dropped(&self, quiet: bool) {
        let Document { dropped_faces: count, dropped_groups: groups, dropped_arrays: arrays, .. } =
            &self.document;
        let path = self.path.display();
        if self.document.linearized > 0 && !quiet {
            tell(&format!(
                "warning: {path}: {} read as linear: the nodes on edges, on faces and inside are left out\n",
                counted(
                    self.document.linearized,
                    "hex of the second order is",
                    "hexes of the second order are"
                )
            ));
        }
        if self.document.hidden > 0 && !quiet {
            tell(&format!(
                "warning: {path}: {} left out, as hidden or of another piece (vtkGhostType)\n",
                counted(self.document.hidden, "cell is", "cells are")
            ));
        }
        if *count > 0 && !quiet {
            tell(&format!(
                "warning: {path}: {} left out, as no face of these\n",
                counted(*count, "face beside the hexes is", "faces beside the hexes are")
            ));
        }
        if !groups.is_empty() && !quiet {
            tell(&format!(
                "warning: {path}: these groups are not of hexes and their faces alone, and what else is in them is left \
                 out: {}\n",
                groups.join(", ")
            ));
        }
        if !arrays.is_empty() && !quiet {
            tell(&format!(
                "warning: {path}: these arrays are no tags of cells, and are left out: {}\n",
                arrays.join(", ")
            ));
        }
    }
}

/// Warns of what the file at `path` cannot say of the groups of the document in it.
pub(crate) fn warn_of_losses(path: &Path, document: &Document, format: Format, quiet: bool) {
    for loss in io::losses(document, format).iter().filter(|_| !quiet) {
        tell(&format!("warning: {}: {loss}\n", path.display()));
    }
}

/// Finds out before any work whether `outputs` can be written: each is a file of its own and none is of `inputs`, which
/// would be lost, and the folder of each takes new files. Paths are named as on the command line.
pub(crate) fn check_outputs(inputs: &[(&str, &Path)], outputs: &[(&str, &Path)]) -> Result<(), Failure> {
    for (k, (name, path)) in outputs.iter().enumerate() {
        let mut others = inputs.iter().chain(&outputs[..k]);
        if let Some((other, _)) = others.find(|(_, other)| place(other) == place(path)) {
            return Err(Failure::Usage(format!(
                "{name} and {other} are the same file: {}; give another path",
                path.display()
            )));
        }
    }
    outputs.iter().try_for_each(|(_, path)| {
        ensure_writable(path).map_err(|error| Failure::file("file-not-written", "written", path, &error))
    })
}

/// Where a file is, or would be if it were written, whatever the path's spelling.
fn place(path: &Path) -> PathBuf {
    let in_folder = || Some(folder_of(path).canonicalize().ok()?.join(path.file_name()?));
    path.canonicalize().ok().or_else(in_folder).unwrap_or_else(|| path.to_owned())
}

/// The folder that `path` is in.
fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Tries whether a file can be made beside `path`; what is there stays as it is.
fn ensure_writable(path: &Path) -> std::io::Result<()> {
    let target = place(path);
    if target.is_dir() {
        return Err(std::io::ErrorKind::IsADirectory.into());
    }
    if target.exists() && !target.is_file() {
        return Ok(());
    }
    // An interruption waits for the lock, so that it finds no file or one that is gone.
    let _outputs = outputs();
    temporary_file(folder_of(&target)).and_then(tempfile::NamedTempFile::close)
}

/// Writes `bytes` to `path`: first to a temporary file beside it, which then takes its place, so that
/// `path` never holds half of them.
pub(crate) fn save(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let failed = |error| Failure::file("file-not-written", "written", path, &error);
    // Through a link to the file it names; pipes and devices cannot be replaced and are written to.
    let target = place(path);
    if target.exists() && !target.is_file() {
        return fs::write(&target, bytes).map_err(failed);
    }
    let mut file = temporary_file(folder_of(&target)).map_err(failed)?;
    outputs().unfinished = Some(file.path().to_owned());
    let filled = file.write_all(bytes).and_then(|()| file.as_file().sync_all());
    let mut outputs = outputs();
    let done = filled.and_then(|()| file.persist(&target).map(drop).map_err(|e| e.error));
    outputs.unfinished = None;
    done.map_err(failed)?;
    outputs.written.push(path.display().to_string());
    Ok(())
}

/// A new file in `folder` that others may read as they may read any new file.
fn temporary_file(folder: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".hexmill-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}
