//! Marks of constant size on the screen: lines, discs.

use bytemuck::Pod;
use wgpu::{
    BindGroupLayout, BlendState, PrimitiveTopology, RenderPass, RenderPipeline, VertexAttribute,
    VertexBufferLayout, VertexStepMode,
};

use super::{
    gpu::Gpu,
    pipeline::{Recipe, shader},
    place::{Pass, Place},
    stream::Stream,
};
use crate::scene::{Disc, Segment};

/// An instance of a rectangle of pixels.
pub trait Mark: Pod {
    /// Name shown by debuggers.
    const LABEL: &str;
    /// WGSL with entry points `vertex` and `fragment`, and an override `opacity`.
    const SHADER: &str;
    /// The fields of an instance.
    const FIELDS: &[VertexAttribute];
}

/// Lines of constant width.
impl Mark for Segment {
    const LABEL: &str = "lines";
    const SHADER: &str = shader!("lines.wgsl");
    const FIELDS: &[VertexAttribute] =
        &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32, 3 => Unorm8x4];
}

/// Handles, the pivot, and corners of a solid.
impl Mark for Disc {
    const LABEL: &str = "discs";
    const SHADER: &str = shader!("discs.wgsl");
    const FIELDS: &[VertexAttribute] =
        &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x2, 2 => Unorm8x4, 3 => Unorm8x4];
}

/// Draws marks of one kind.
pub struct Marks<M> {
    pipelines: Vec<RenderPipeline>,
    marks: Stream<M>,
}

impl<M: Mark> Marks<M> {
    /// The drawable on a device.
    pub fn new(gpu: &Gpu, frame: &BindGroupLayout, place: Place) -> Self {
        let instance = VertexBufferLayout {
            array_stride: size_of::<M>() as u64,
            step_mode: VertexStepMode::Instance,
            attributes: M::FIELDS,
        };
        let pipeline = |pass: Pass| {
            let recipe = Recipe {
                label: M::LABEL,
                shader: M::SHADER,
                groups: &[frame],
                buffers: std::slice::from_ref(&instance),
                constants: &pass.constants(),
                topology: PrimitiveTopology::TriangleStrip,
                cull: None,
                blend: Some(BlendState::ALPHA_BLENDING),
                depth: (pass.compare, false),
            };
            recipe.build(&gpu.device, gpu.format())
        };
        let pipelines = place.passes().iter().copied().map(pipeline).collect();
        Self { pipelines, marks: Stream::new(M::LABEL) }
    }

    /// Replaces what is drawn.
    pub fn set(&mut self, gpu: &Gpu, marks: &[M]) {
        self.marks.set(gpu, marks);
    }

    /// Draws; bind group 0 must be the frame's.
    pub fn draw(&self, pass: &mut RenderPass<'_>) {
        for pipeline in &self.pipelines {
            if let Some(count) = self.marks.bind(pass) {
                pass.set_pipeline(pipeline);
                pass.draw(0..4, 0..count);
            }
        }
    }
}
