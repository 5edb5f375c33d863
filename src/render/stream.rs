//! Vertex buffers whose contents change often.

use std::marker::PhantomData;

use bytemuck::Pod;
use wgpu::{Buffer, BufferUsages, RenderPass};

use super::gpu::Gpu;

/// A vertex buffer of items of type `T` that grows when it must.
pub struct Stream<T> {
    label: &'static str,
    buffer: Option<Buffer>,
    count: u32,
    items: PhantomData<T>,
}

impl<T: Pod> Stream<T> {
    /// An empty buffer.
    pub fn new(label: &'static str) -> Self {
        Self { label, buffer: None, count: 0, items: PhantomData }
    }

    /// Replaces the contents.
    pub fn set(&mut self, gpu: &Gpu, items: &[T]) {
        let bytes: &[u8] = bytemuck::cast_slice(items);
        self.count = items.len() as u32;
        if bytes.is_empty() {
            return;
        }
        let size = bytes.len() as u64;
        let buffer = self.buffer.take().filter(|b| b.size() >= size).unwrap_or_else(|| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(self.label),
                size: size.next_power_of_two(),
                usage: BufferUsages::VERTEX | BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        });
        gpu.queue.write_buffer(&buffer, 0, bytes);
        self.buffer = Some(buffer);
    }

    /// Binds the buffer to slot 0; how many items it holds, or `None` if it is empty.
    pub fn bind(&self, pass: &mut RenderPass<'_>) -> Option<u32> {
        let buffer = self.buffer.as_ref().filter(|_| self.count > 0)?;
        pass.set_vertex_buffer(0, buffer.slice(..));
        Some(self.count)
    }
}
