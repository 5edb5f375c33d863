//! Discs of constant size on the screen: handles, the pivot, and corners of a solid.

use wgpu::{BindGroupLayout, BlendState, PrimitiveTopology, RenderPass, RenderPipeline, VertexBufferLayout};

use super::{
    gpu::Gpu,
    pipeline::{Recipe, shader},
    place::{Pass, Place},
    stream::Stream,
};
use crate::scene::Disc;

const LAYOUT: VertexBufferLayout<'static> = VertexBufferLayout {
    array_stride: size_of::<Disc>() as u64,
    step_mode: wgpu::VertexStepMode::Instance,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x2, 2 => Unorm8x4, 3 => Unorm8x4],
};

/// Draws discs.
pub struct Discs {
    pipelines: Vec<RenderPipeline>,
    discs: Stream<Disc>,
}

impl Discs {
    /// The drawable on a device.
    pub fn new(gpu: &Gpu, frame: &BindGroupLayout, place: Place) -> Self {
        let pipeline = |pass: Pass| {
            let recipe = Recipe {
                label: "discs",
                shader: shader!("discs.wgsl"),
                groups: &[frame],
                buffers: &[LAYOUT],
                constants: &pass.constants(),
                topology: PrimitiveTopology::TriangleStrip,
                cull: None,
                blend: Some(BlendState::ALPHA_BLENDING),
                depth: (pass.compare, false),
            };
            recipe.build(&gpu.device, gpu.format())
        };
        Self {
            pipelines: place.passes().iter().copied().map(pipeline).collect(),
            discs: Stream::new("discs"),
        }
    }

    /// Replaces what is drawn.
    pub fn set(&mut self, gpu: &Gpu, discs: &[Disc]) {
        self.discs.set(gpu, discs);
    }

    /// Draws; bind group 0 must be the frame's.
    pub fn draw(&self, pass: &mut RenderPass<'_>) {
        for pipeline in &self.pipelines {
            if let Some(count) = self.discs.bind(pass) {
                pass.set_pipeline(pipeline);
                pass.draw(0..4, 0..count);
            }
        }
    }
}
