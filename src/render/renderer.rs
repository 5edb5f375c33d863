//! One frame: ground, mesh, and what lies over it.

use bytemuck::{Pod, Zeroable};
use glam::Vec4;
use wgpu::{BindGroup, Buffer, BufferUsages, Color, LoadOp, Operations, RenderPass, ShaderStages, StoreOp};

use super::{
    background::Background,
    gpu::{Gpu, GpuError, Target},
    marks::Marks,
    mesh::{MeshDrawable, MeshPipeline},
    pipeline::uniform,
    place::Place,
    solids::Solids,
};
use crate::scene::{Disc, Palette, Placement, Rgba, Scene, Segment, Solid, Surface};

/// Draws a scene on a canvas.
pub struct Renderer {
    gpu: Gpu,
    frame: Buffer,
    frame_group: BindGroup,
    background: Background,
    mesh_pipeline: MeshPipeline,
    mesh: Option<MeshDrawable>,
    solids: Solids,
    outlines: Marks<Segment>,
    points: Marks<Disc>,
    front_lines: Marks<Segment>,
    discs: Marks<Disc>,
    /// The regions' buffers are out of date.
    regions_changed: bool,
}

/// `Frame` of frame.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct FrameUniform {
    clip_from_scene: [[f32; 4]; 4],
    view_from_scene: [[f32; 4]; 4],
    eye: Vec4,
    canvas: Vec4,
    ground_top: Vec4,
    ground_bottom: Vec4,
    front: Vec4,
    back: Vec4,
    cap: Vec4,
    edge: Vec4,
    counts: [u32; 4],
    regions: [RegionUniform; REGIONS],
}

/// `Region` of frame.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct RegionUniform {
    unit_from_scene: [[f32; 4]; 4],
    colour_solid: Vec4,
}

/// Regions whose crossing with the surface is marked; those beyond are only drawn as solids.
const REGIONS: usize = 16;

impl Renderer {
    /// A renderer on a canvas.
    #[cfg(target_arch = "wasm32")]
    pub async fn on_canvas(canvas: web_sys::HtmlCanvasElement) -> Result<Self, GpuError> {
        Self::new(Gpu::on_canvas(canvas).await?)
    }

    /// A renderer on a device.
    pub fn new(gpu: Gpu) -> Result<Self, GpuError> {
        let frame = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frame"),
            size: size_of::<FrameUniform>() as u64,
            usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("frame"),
            entries: &[uniform(0, ShaderStages::VERTEX_FRAGMENT)],
        });
        let frame_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("frame"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: frame.as_entire_binding() }],
        });
        let background = Background::new(&gpu, &layout);
        let mesh_pipeline = MeshPipeline::new(&gpu, &layout);
        let solids = Solids::new(&gpu, &layout);
        let outlines = Marks::new(&gpu, &layout, Place::InScene);
        let front_lines = Marks::new(&gpu, &layout, Place::OnTop);
        let points = Marks::new(&gpu, &layout, Place::InScene);
        let discs = Marks::new(&gpu, &layout, Place::OnTop);
        gpu.check()?;
        Ok(Self {
            gpu,
            frame,
            frame_group,
            background,
            mesh_pipeline,
            mesh: None,
            solids,
            outlines,
            points,
            front_lines,
            discs,
            regions_changed: true,
        })
    }

    /// Fits the canvas, in device pixels.
    pub fn resize(&mut self, width: u32, height: u32) {
        self.gpu.resize(width, height);
    }

    /// Replaces the surface that is drawn.
    pub fn set_surface(&mut self, surface: Option<&Surface>) -> Result<(), GpuError> {
        // The old one goes first: two large meshes may not fit.
        self.mesh = None;
        self.mesh = surface.map(|s| self.mesh_pipeline.upload(&self.gpu, s)).transpose()?;
        self.gpu.check()
    }

    /// Replaces the surface by one of other faces between the same nodes.
    pub fn set_faces(&mut self, surface: &Surface) -> Result<(), GpuError> {
        if let Some(mesh) = &mut self.mesh {
            self.mesh_pipeline.replace_faces(&self.gpu, mesh, surface)?;
        }
        self.gpu.check()
    }

    /// Colours the surface's faces by index, or all alike.
    pub fn set_colours(&mut self, colours: Option<(&[u8], &Palette)>) {
        if let Some(mesh) = &mut self.mesh {
            mesh.set_colours(&self.gpu, colours);
        }
    }

    /// Tells that the scene's regions, their place or their colours have changed.
    pub fn regions_changed(&mut self) {
        self.regions_changed = true;
    }

    /// Bytes of the surface on the device.
    pub fn mesh_bytes(&self) -> usize {
        self.mesh.as_ref().map_or(0, MeshDrawable::bytes)
    }

    /// Draws a frame.
    pub fn draw(&mut self, scene: &Scene) -> Result<(), GpuError> {
        if let Some(mesh) = &mut self.mesh {
            mesh.set_edges(&self.gpu, scene.style.edges);
        }
        if std::mem::take(&mut self.regions_changed) {
            let regions = scene.region_buffers();
            self.solids.set(&self.gpu, &regions.solids);
            self.outlines.set(&self.gpu, &regions.outlines);
            self.points.set(&self.gpu, &regions.discs);
        }
        let front = scene.front_buffers();
        self.front_lines.set(&self.gpu, &front.lines);
        self.discs.set(&self.gpu, &front.discs);
        let uniform = self.frame_uniform(scene);
        self.gpu.queue.write_buffer(&self.frame, 0, bytemuck::bytes_of(&uniform));
        self.gpu.frame(|device, queue, target| {
            let mut encoder = device.create_command_encoder(&Default::default());
            self.encode(&mut begin(&mut encoder, &target));
            queue.submit([encoder.finish()]);
        })
    }

    fn encode(&self, pass: &mut RenderPass<'_>) {
        pass.set_bind_group(0, &self.frame_group, &[]);
        self.background.draw(pass);
        if let Some(mesh) = &self.mesh {
            self.mesh_pipeline.draw(pass, mesh);
        }
        self.solids.draw(pass);
        self.outlines.draw(pass);
        self.points.draw(pass);
        self.front_lines.draw(pass);
        self.discs.draw(pass);
    }

    fn frame_uniform(&self, scene: &Scene) -> FrameUniform {
        let theme = scene.style.background.theme();
        let [width, height] = self.gpu.size().map(|p| p as f32);
        let pixels = width / scene.viewport.width as f32;
        let mut regions = [RegionUniform::zeroed(); REGIONS];
        let mut count = 0;
        for (slot, (i, placement)) in regions.iter_mut().zip(drawn(scene)) {
            let is_selected = scene.selected() == Some(i);
            let colour = if is_selected { theme.selected } else { theme.region };
            let unit_from_scene = placement.unit_from_world() * scene.frame().world_from_scene();
            *slot = RegionUniform {
                unit_from_scene: unit_from_scene.as_mat4().to_cols_array_2d(),
                colour_solid: float(colour).with_w(solid_number(placement.solid)),
            };
            count += 1;
        }
        FrameUniform {
            clip_from_scene: scene.clip_from_scene().to_cols_array_2d(),
            view_from_scene: scene.view_from_scene().to_cols_array_2d(),
            eye: scene.eye(),
            canvas: Vec4::new(width, height, pixels, scene.style.edge_width * pixels),
            ground_top: float(theme.ground_top),
            ground_bottom: float(theme.ground_bottom),
            front: float(theme.front),
            back: float(theme.back),
            cap: float(theme.cap),
            edge: float(theme.edge),
            counts: [count, u32::from(self.mesh.as_ref().is_some_and(MeshDrawable::is_coloured)), 0, 0],
            regions,
        }
    }
}

/// The regions that can be drawn, with their indices.
fn drawn(scene: &Scene) -> impl Iterator<Item = (usize, &Placement)> {
    scene.placements().iter().enumerate().filter_map(|(i, p)| Some((i, p.as_ref()?)))
}

/// The number of a solid in frame.wgsl.
fn solid_number(solid: Solid) -> f32 {
    match solid {
        Solid::Cube => 0.0,
        Solid::Ball => 1.0,
        Solid::Cylinder => 2.0,
    }
}

fn float(colour: Rgba) -> Vec4 {
    Vec4::from(colour.map(f32::from)) / 255.0
}

fn begin<'a>(encoder: &'a mut wgpu::CommandEncoder, target: &Target<'_>) -> RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("frame"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: target.colour,
            depth_slice: None,
            resolve_target: Some(&target.resolved),
            ops: Operations { load: LoadOp::Clear(Color::BLACK), store: StoreOp::Discard },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: target.depth,
            depth_ops: Some(Operations { load: LoadOp::Clear(1.0), store: StoreOp::Discard }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}
