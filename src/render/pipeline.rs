//! What the drawables' pipelines have in common.

use wgpu::{
    BindGroupLayout, BindGroupLayoutEntry, BindingType, BlendState, CompareFunction, Device, Face,
    PrimitiveTopology, RenderPipeline, ShaderStages, TextureFormat, TextureSampleType, VertexBufferLayout,
};

use super::gpu::{DEPTH_FORMAT, SAMPLES};

/// How one drawable is drawn.
pub struct Recipe<'a> {
    /// Name shown by debuggers.
    pub label: &'static str,
    /// WGSL with entry points `vertex` and `fragment`.
    pub shader: &'a str,
    /// Bind groups in order.
    pub groups: &'a [&'a BindGroupLayout],
    /// Vertex buffers in order.
    pub buffers: &'a [VertexBufferLayout<'a>],
    /// Values of the shader's overrides.
    pub constants: &'a [(&'a str, f64)],
    /// How vertices make triangles.
    pub topology: PrimitiveTopology,
    /// The side that is not drawn.
    pub cull: Option<Face>,
    /// How colours meet what is there.
    pub blend: Option<BlendState>,
    /// What passes the depth test, and whether it is written.
    pub depth: (CompareFunction, bool),
}

impl Recipe<'_> {
    /// The pipeline.
    pub fn build(&self, device: &Device, format: TextureFormat) -> RenderPipeline {
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(self.label),
            source: wgpu::ShaderSource::Wgsl(self.shader.into()),
        });
        let groups: Vec<_> = self.groups.iter().map(|&g| Some(g)).collect();
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(self.label),
            bind_group_layouts: &groups,
            immediate_size: 0,
        });
        let options = || wgpu::PipelineCompilationOptions { constants: self.constants, ..Default::default() };
        let buffers: Vec<_> = self.buffers.iter().cloned().map(Some).collect();
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.label),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: options(),
                buffers: &buffers,
            },
            primitive: wgpu::PrimitiveState {
                topology: self.topology,
                cull_mode: self.cull,
                ..Default::default()
            },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(self.depth.1),
                depth_compare: Some(self.depth.0),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState { count: SAMPLES, ..Default::default() },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options: options(),
                targets: &[Some(wgpu::ColorTargetState {
                    format,
                    blend: self.blend,
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

/// A layout entry of a uniform buffer.
pub fn uniform(binding: u32, visibility: ShaderStages) -> BindGroupLayoutEntry {
    let ty = BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    BindGroupLayoutEntry { binding, visibility, ty, count: None }
}

/// A layout entry of a data texture read by the vertex stage.
pub fn data(binding: u32, sample_type: TextureSampleType) -> BindGroupLayoutEntry {
    let ty = BindingType::Texture {
        sample_type,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    BindGroupLayoutEntry { binding, visibility: ShaderStages::VERTEX, ty, count: None }
}

/// A shader with the declarations that all share before it.
macro_rules! shader {
    ($file:literal) => {
        concat!(include_str!("shaders/frame.wgsl"), include_str!(concat!("shaders/", $file)))
    };
}
pub(crate) use shader;
