//! Arrays that shaders read by index, kept in textures: WebGL2 has no storage buffers.

use bytemuck::Pod;
use wgpu::{Device, Extent3d, Queue, Texture, TextureFormat, TextureUsages, TextureView};

use super::gpu::{Gpu, GpuError};

/// Bytes handed to the driver at a time; it keeps a copy of each until the next submission.
const BLOCK: usize = 8 << 20;

/// An array of items of type `T`, row by row in a texture.
pub struct DataTexture {
    texture: Texture,
    width: u32,
}

/// Log2 of the width of data textures on this device: as wide as their greatest height allows to be
/// useful, and a power of two so that shaders find an item by shift and mask.
pub fn width_bits(gpu: &Gpu) -> u32 {
    gpu.limits.max_texture_dimension_2d.min(4096).ilog2()
}

impl DataTexture {
    /// Uploads `items`; each is one texel of `format`. `what` names them in the error.
    pub fn new<T: Pod>(
        gpu: &Gpu,
        what: &'static str,
        format: TextureFormat,
        items: &[T],
    ) -> Result<Self, GpuError> {
        let width = 1 << width_bits(gpu);
        let limit = width as usize * gpu.limits.max_texture_dimension_2d as usize;
        if items.len() > limit {
            return Err(GpuError::TooLarge { what, items: items.len(), limit });
        }
        let height = items.len().div_ceil(width as usize).max(1) as u32;
        let texture = empty(&gpu.device, what, format, [width, height]);
        let this = Self { texture, width };
        this.write(&gpu.queue, items);
        Ok(this)
    }

    /// Replaces the items; there must be as many as before.
    pub fn write<T: Pod>(&self, queue: &Queue, items: &[T]) {
        let width = self.width as usize;
        let rows = (BLOCK / (width * size_of::<T>())).max(1);
        let whole = items.len() / width * width;
        for (block, part) in items[..whole].chunks(rows * width).enumerate() {
            self.write_rows(queue, (block * rows) as u32, [self.width, (part.len() / width) as u32], part);
            if part.len() == rows * width {
                queue.submit([]);
            }
        }
        let rest = &items[whole..];
        if !rest.is_empty() {
            self.write_rows(queue, (whole / width) as u32, [rest.len() as u32, 1], rest);
        }
    }

    fn write_rows<T: Pod>(&self, queue: &Queue, row: u32, [width, height]: [u32; 2], items: &[T]) {
        queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                texture: &self.texture,
                mip_level: 0,
                origin: wgpu::Origin3d { x: 0, y: row, z: 0 },
                aspect: wgpu::TextureAspect::All,
            },
            bytemuck::cast_slice(items),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(width * size_of::<T>() as u32),
                rows_per_image: None,
            },
            Extent3d { width, height, depth_or_array_layers: 1 },
        );
    }

    /// The view to bind.
    pub fn view(&self) -> TextureView {
        self.texture.create_view(&Default::default())
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> usize {
        let texel = self.texture.format().block_copy_size(None).unwrap_or(0) as usize;
        self.texture.width() as usize * self.texture.height() as usize * texel
    }
}

fn empty(device: &Device, label: &'static str, format: TextureFormat, [width, height]: [u32; 2]) -> Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
        view_formats: &[],
    })
}
