//! The ground behind everything.

use wgpu::{BindGroupLayout, CompareFunction, PrimitiveTopology, RenderPass, RenderPipeline};

use super::{
    gpu::Gpu,
    pipeline::{Recipe, shader},
};

/// Draws a gradient over the whole canvas.
pub struct Background(RenderPipeline);

impl Background {
    /// The drawable on a device.
    pub fn new(gpu: &Gpu, frame: &BindGroupLayout) -> Self {
        let recipe = Recipe {
            label: "background",
            shader: shader!("background.wgsl"),
            groups: &[frame],
            buffers: &[],
            constants: &[],
            topology: PrimitiveTopology::TriangleList,
            cull: None,
            blend: None,
            depth: (CompareFunction::Always, false),
        };
        Self(recipe.build(&gpu.device, gpu.format()))
    }

    /// Draws it; bind group 0 must be the frame's.
    pub fn draw(&self, pass: &mut RenderPass<'_>) {
        pass.set_pipeline(&self.0);
        pass.draw(0..3, 0..1);
    }
}
