//! The program: the command line, and on the web, where there is none, nothing. Cargo builds it there for
//! `wasm-pack test`.

#[cfg(not(target_arch = "wasm32"))]
mod cli;

/// Meshes are made in arrays of megabytes: an allocator that keeps its pages spares the system's clearing them anew,
/// which is half of the time of a refinement.
#[cfg(not(target_arch = "wasm32"))]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    cli::run()
}

#[cfg(target_arch = "wasm32")]
fn main() {}
