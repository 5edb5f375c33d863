//! Discs of constant size on the screen: handles and the pivot.

use wgpu::{
    BindGroupLayout, BlendState, CompareFunction, PrimitiveTopology, RenderPass, RenderPipeline,
    VertexBufferLayout,
};

use super::{
    gpu::Gpu,
    pipeline::{Recipe, shader},
    stream::Stream,
};
use crate::scene::Disc;

const LAYOUT: VertexBufferLayout<'static> = VertexBufferLayout {
    array_stride: size_of::<Disc>() as u64,
    step_mode: wgpu::VertexStepMode::Instance,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x2, 2 => Unorm8x4, 3 => Unorm8x4],
};

/// Draws discs over everything.
pub struct Discs {
    pipeline: RenderPipeline,
    discs: Stream<Disc>,
}

impl Discs {
    /// The drawable on a device.
    pub fn new(gpu: &Gpu, frame: &BindGroupLayout) -> Self {
        let recipe = Recipe {
            label: "discs",
            shader: shader!("discs.wgsl"),
            groups: &[frame],
            buffers: &[LAYOUT],
            constants: &[],
            topology: PrimitiveTopology::TriangleStrip,
            cull: None,
            blend: Some(BlendState::ALPHA_BLENDING),
            depth: (CompareFunction::Always, false),
        };
        Self { pipeline: recipe.build(&gpu.device, gpu.format()), discs: Stream::new("discs") }
    }

    /// Replaces what is drawn.
    pub fn set(&mut self, gpu: &Gpu, discs: &[Disc]) {
        self.discs.set(gpu, discs);
    }

    /// Draws; bind group 0 must be the frame's.
    pub fn draw(&self, pass: &mut RenderPass<'_>) {
        if let Some(count) = self.discs.bind(pass) {
            pass.set_pipeline(&self.pipeline);
            pass.draw(0..4, 0..count);
        }
    }
}
