//! A polygon surface: shaded faces with crisp edges, one draw call a chunk.

use bytemuck::{Pod, Zeroable};
use wgpu::{
    BindGroup, BindGroupLayout, Buffer, BufferUsages, CompareFunction, PrimitiveTopology, RenderPass,
    RenderPipeline, ShaderStages, TextureFormat, TextureSampleType, util::DeviceExt,
};

use super::{
    data_texture::{DataTexture, width_bits},
    gpu::{Gpu, GpuError},
    pipeline::{Recipe, data, shader, uniform},
};
use crate::scene::{Palette, Surface};

/// Triangles drawn by one call: 48 MiB of vertices, and a texture of tags that every device takes.
const CHUNK_TRIANGLES: usize = 1 << 22;

/// Draws surfaces.
pub struct MeshPipeline {
    pipeline: RenderPipeline,
    surface_layout: BindGroupLayout,
    chunk_layout: BindGroupLayout,
}

/// A surface on the device.
pub struct MeshDrawable {
    uniform: Buffer,
    settings: Settings,
    positions: DataTexture,
    palette: DataTexture,
    faces: Faces,
}

/// What changes with the faces of a surface, while its nodes stay.
struct Faces {
    normals: DataTexture,
    colours: DataTexture,
    group: BindGroup,
    chunks: Vec<Chunk>,
}

struct Chunk {
    nodes: Buffer,
    group: BindGroup,
    vertices: u32,
}

/// `Mesh` of mesh.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Settings {
    width_bits: u32,
    coloured: u32,
    edges: u32,
    padding: u32,
}

impl MeshPipeline {
    /// The pipeline on a device.
    pub fn new(gpu: &Gpu, frame: &BindGroupLayout) -> Self {
        let layout = |label, entries: &[_]| {
            gpu.device
                .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries })
        };
        let float = TextureSampleType::Float { filterable: false };
        let surface_layout = layout(
            "surface",
            &[
                uniform(0, ShaderStages::VERTEX_FRAGMENT),
                data(1, float),
                data(2, TextureSampleType::Uint),
                data(3, TextureSampleType::Uint),
                data(4, float),
            ],
        );
        let chunk_layout = layout("chunk", &[data(0, TextureSampleType::Uint)]);
        let recipe = Recipe {
            label: "mesh",
            shader: shader!("mesh.wgsl"),
            groups: &[frame, &surface_layout, &chunk_layout],
            buffers: &[wgpu::VertexBufferLayout {
                array_stride: 4,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Uint32],
            }],
            constants: &[],
            topology: PrimitiveTopology::TriangleList,
            cull: None,
            blend: None,
            depth: (CompareFunction::Less, true),
        };
        Self { pipeline: recipe.build(&gpu.device, gpu.format()), surface_layout, chunk_layout }
    }

    /// Uploads a surface.
    pub fn upload(&self, gpu: &Gpu, surface: &Surface) -> Result<MeshDrawable, GpuError> {
        let settings = Settings { width_bits: width_bits(gpu), coloured: 0, edges: 1, padding: 0 };
        let uniform = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("mesh settings"),
            contents: bytemuck::bytes_of(&settings),
            usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
        });
        let texels: Vec<[f32; 4]> = surface.positions().iter().map(|p| p.extend(1.0).to_array()).collect();
        let positions = DataTexture::new(gpu, "nodes", TextureFormat::Rgba32Float, &texels)?;
        drop(texels);
        let palette = DataTexture::new(gpu, "colours", TextureFormat::Rgba8Unorm, &[[0u8; 4]; 256])?;
        let faces = self.upload_faces(gpu, surface, &uniform, [&positions, &palette])?;
        Ok(MeshDrawable { uniform, settings, positions, palette, faces })
    }

    /// Replaces the faces of a surface by those of `surface`, which has the same nodes.
    pub fn replace_faces(
        &self,
        gpu: &Gpu,
        mesh: &mut MeshDrawable,
        surface: &Surface,
    ) -> Result<(), GpuError> {
        mesh.faces = self.upload_faces(gpu, surface, &mesh.uniform, [&mesh.positions, &mesh.palette])?;
        Ok(())
    }

    fn upload_faces(
        &self,
        gpu: &Gpu,
        surface: &Surface,
        uniform: &Buffer,
        [positions, palette]: [&DataTexture; 2],
    ) -> Result<Faces, GpuError> {
        let normals = DataTexture::new(gpu, "faces", TextureFormat::R32Uint, &surface.normals())?;
        let colours =
            DataTexture::new(gpu, "faces", TextureFormat::R8Uint, &vec![0u8; surface.face_count()])?;
        let views = [positions, &normals, &colours, palette].map(DataTexture::view);
        let textures = views
            .iter()
            .zip(1..)
            .map(|(view, binding)| entry(binding, wgpu::BindingResource::TextureView(view)));
        let entries: Vec<_> =
            std::iter::once(entry(0, uniform.as_entire_binding())).chain(textures).collect();
        let group = bind(gpu, &self.surface_layout, &entries);
        let chunks: Vec<Chunk> = surface
            .runs(CHUNK_TRIANGLES)
            .into_iter()
            .map(|faces| self.upload_chunk(gpu, surface, faces))
            .collect::<Result<_, _>>()?;
        Ok(Faces { normals, colours, group, chunks })
    }

    fn upload_chunk(
        &self,
        gpu: &Gpu,
        surface: &Surface,
        faces: std::ops::Range<usize>,
    ) -> Result<Chunk, GpuError> {
        let buffers = surface.triangles(faces);
        let nodes = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("mesh corners"),
            contents: bytemuck::cast_slice(&buffers.nodes),
            usage: BufferUsages::VERTEX,
        });
        let tags = DataTexture::new(gpu, "triangles", TextureFormat::R32Uint, &buffers.tags)?;
        let view = tags.view();
        let group = bind(gpu, &self.chunk_layout, &[entry(0, wgpu::BindingResource::TextureView(&view))]);
        gpu.queue.submit([]);
        Ok(Chunk { nodes, group, vertices: buffers.nodes.len() as u32 })
    }

    /// Draws a surface; bind group 0 must be the frame's.
    pub fn draw(&self, pass: &mut RenderPass<'_>, mesh: &MeshDrawable) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(1, &mesh.faces.group, &[]);
        for chunk in &mesh.faces.chunks {
            pass.set_bind_group(2, &chunk.group, &[]);
            pass.set_vertex_buffer(0, chunk.nodes.slice(..));
            pass.draw(0..chunk.vertices, 0..1);
        }
    }
}

impl MeshDrawable {
    /// Colours each face by its index into the palette, or all alike.
    pub fn set_colours(&mut self, gpu: &Gpu, colours: Option<(&[u8], &Palette)>) {
        if let Some((indices, palette)) = colours {
            self.faces.colours.write(&gpu.queue, indices);
            self.palette.write(&gpu.queue, &palette.0);
        }
        self.set(gpu, Settings { coloured: colours.is_some().into(), ..self.settings });
    }

    /// True if faces have colours of their own.
    pub fn is_coloured(&self) -> bool {
        self.settings.coloured != 0
    }

    /// Shows or hides edges.
    pub fn set_edges(&mut self, gpu: &Gpu, shown: bool) {
        self.set(gpu, Settings { edges: shown.into(), ..self.settings });
    }

    fn set(&mut self, gpu: &Gpu, settings: Settings) {
        if settings != self.settings {
            self.settings = settings;
            gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&settings));
        }
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> usize {
        let Faces { normals, colours, chunks, .. } = &self.faces;
        let textures = [&self.positions, &self.palette, normals, colours];
        chunks.iter().map(|c| c.nodes.size() as usize / 3 * 4).sum::<usize>()
            + textures.iter().map(|t| t.bytes()).sum::<usize>()
    }
}

fn entry(binding: u32, resource: wgpu::BindingResource<'_>) -> wgpu::BindGroupEntry<'_> {
    wgpu::BindGroupEntry { binding, resource }
}

fn bind(gpu: &Gpu, layout: &BindGroupLayout, entries: &[wgpu::BindGroupEntry<'_>]) -> BindGroup {
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries })
}
