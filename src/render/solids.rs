//! Translucent surfaces of regions.

use wgpu::{
    BindGroupLayout, BlendState, CompareFunction, Face, PrimitiveTopology, RenderPass, RenderPipeline,
    VertexBufferLayout,
};

use super::{
    gpu::Gpu,
    pipeline::{Recipe, shader},
    stream::Stream,
};
use crate::scene::SolidVertex;

const LAYOUT: VertexBufferLayout<'static> = VertexBufferLayout {
    array_stride: size_of::<SolidVertex>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Snorm8x4, 2 => Unorm8x4],
};

/// Draws translucent solids: their far sides first, then their near sides.
pub struct Solids {
    far: RenderPipeline,
    near: RenderPipeline,
    vertices: Stream<SolidVertex>,
}

impl Solids {
    /// The drawable on a device.
    pub fn new(gpu: &Gpu, frame: &BindGroupLayout) -> Self {
        let side = |cull| {
            let recipe = Recipe {
                label: "solids",
                shader: shader!("solids.wgsl"),
                groups: &[frame],
                buffers: &[LAYOUT],
                constants: &[],
                topology: PrimitiveTopology::TriangleList,
                cull: Some(cull),
                blend: Some(BlendState::ALPHA_BLENDING),
                depth: (CompareFunction::LessEqual, false),
            };
            recipe.build(&gpu.device, gpu.format())
        };
        Self { far: side(Face::Front), near: side(Face::Back), vertices: Stream::new("solids") }
    }

    /// Replaces what is drawn.
    pub fn set(&mut self, gpu: &Gpu, vertices: &[SolidVertex]) {
        self.vertices.set(gpu, vertices);
    }

    /// Draws; bind group 0 must be the frame's.
    pub fn draw(&self, pass: &mut RenderPass<'_>) {
        for pipeline in [&self.far, &self.near] {
            if let Some(count) = self.vertices.bind(pass) {
                pass.set_pipeline(pipeline);
                pass.draw(0..count, 0..1);
            }
        }
    }
}
