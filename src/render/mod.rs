//! Drawing a scene with wgpu, within WebGL2's limits: no compute, no storage buffers, buffers below
//! 256 MiB.
//!
//! One file a drawable, each with its shader in `shaders/` (`marks` has two). What is drawn is made in
//! [`scene`](crate::scene); nothing here computes geometry. A frame is one render pass, multisampled:
//! ground, mesh, and what lies over it.

mod background;
mod data_texture;
mod gpu;
mod marks;
mod mesh;
mod pipeline;
mod place;
mod renderer;
mod solids;
mod stream;

pub use gpu::GpuError;
pub use renderer::Renderer;
