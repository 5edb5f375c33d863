//! Lines of constant width on the screen.

use wgpu::{BindGroupLayout, BlendState, PrimitiveTopology, RenderPass, RenderPipeline, VertexBufferLayout};

use super::{
    gpu::Gpu,
    pipeline::{Recipe, shader},
    place::{Pass, Place},
    stream::Stream,
};
use crate::scene::Segment;

const LAYOUT: VertexBufferLayout<'static> = VertexBufferLayout {
    array_stride: size_of::<Segment>() as u64,
    step_mode: wgpu::VertexStepMode::Instance,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32, 3 => Unorm8x4],
};

/// Draws segments.
pub struct Lines {
    pipelines: Vec<RenderPipeline>,
    segments: Stream<Segment>,
}

impl Lines {
    /// The drawable on a device.
    pub fn new(gpu: &Gpu, frame: &BindGroupLayout, place: Place) -> Self {
        let pipeline = |pass: Pass| {
            let recipe = Recipe {
                label: "lines",
                shader: shader!("lines.wgsl"),
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
        let pipelines = place.passes().iter().copied().map(pipeline).collect();
        Self { pipelines, segments: Stream::new("lines") }
    }

    /// Replaces what is drawn.
    pub fn set(&mut self, gpu: &Gpu, segments: &[Segment]) {
        self.segments.set(gpu, segments);
    }

    /// Draws; bind group 0 must be the frame's.
    pub fn draw(&self, pass: &mut RenderPass<'_>) {
        for pipeline in &self.pipelines {
            if let Some(count) = self.segments.bind(pass) {
                pass.set_pipeline(pipeline);
                pass.draw(0..4, 0..count);
            }
        }
    }
}
