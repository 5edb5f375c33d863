//! Malformed and hostile files, each with the error that it must give.

mod hostile;
mod indices;
mod numbers;
mod other_files;
mod statements;

use hexmill::io::obj;

/// A triangle's vertices, which most of the files start with: lines 1 to 3.
const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// Checks that `file` is refused with the error `code`, told as `message` (with its line).
#[track_caller]
fn check(file: impl AsRef<[u8]>, code: &str, message: &str) {
    match obj::read(file.as_ref()) {
        Ok(document) => {
            panic!("was read: {} nodes, {} cells", document.mesh.node_count(), document.mesh.cell_count())
        }
        Err(error) => assert_eq!((error.code(), error.to_string().as_str()), (code, message)),
    }
}

/// [`check`] of `lines` that follow a triangle's vertices, the first of them on line 4.
#[track_caller]
fn check_after_triangle(lines: &str, code: &str, message: &str) {
    check(format!("{TRIANGLE}{lines}"), code, message);
}
