//! The graphics device, the canvas it draws on, and the targets of a frame.

use std::sync::{Arc, Mutex, PoisonError};

use wgpu::{
    CurrentSurfaceTexture, Device, Extent3d, Instance, Limits, Queue, Surface, SurfaceConfiguration, Texture,
    TextureFormat, TextureUsages, TextureView,
};

/// Samples a pixel of the multisampled targets.
pub const SAMPLES: u32 = 4;
/// Format of the depth target.
pub const DEPTH_FORMAT: TextureFormat = TextureFormat::Depth24Plus;

/// Why nothing can be drawn.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// The canvas gives no WebGL2 context.
    #[error("this browser gives the page no WebGL2, which drawing needs: {0}")]
    NoContext(String),
    /// The driver refused the device.
    #[error("the graphics driver refused to start: {0}")]
    NoDevice(String),
    /// The canvas can no longer be drawn on.
    #[error("the graphics driver took the canvas away")]
    Lost,
    /// The driver or wgpu refused a call: memory has run out, or it is our mistake.
    #[error("the graphics driver gave up: {0}")]
    Failed(String),
    /// A mesh is too large for the driver's textures.
    #[error("{items} {what} are more than this graphics driver can draw ({limit})")]
    TooLarge {
        /// What there is too much of.
        what: &'static str,
        /// How many there are.
        items: usize,
        /// How many there may be.
        limit: usize,
    },
}

/// Device, queue and canvas.
pub struct Gpu {
    /// The device.
    pub device: Device,
    /// Its queue.
    pub queue: Queue,
    /// What the device can do.
    pub limits: Limits,
    surface: Surface<'static>,
    config: SurfaceConfiguration,
    targets: Targets,
    /// What the device reported since the last frame.
    failure: Arc<Mutex<Option<String>>>,
}

/// What a frame is drawn into before it is resolved to the canvas.
struct Targets {
    colour: TextureView,
    depth: TextureView,
}

/// A frame being drawn.
pub struct Target<'a> {
    /// Multisampled colour.
    pub colour: &'a TextureView,
    /// The canvas.
    pub resolved: TextureView,
    /// Multisampled depth.
    pub depth: &'a TextureView,
}

impl Gpu {
    /// Starts a device on a canvas through WebGL2.
    #[cfg(target_arch = "wasm32")]
    pub async fn on_canvas(canvas: web_sys::HtmlCanvasElement) -> Result<Self, GpuError> {
        let size = [canvas.width(), canvas.height()];
        let mut description = wgpu::InstanceDescriptor::new_without_display_handle();
        description.backends = wgpu::Backends::GL;
        let instance = Instance::new(description);
        let surface = instance
            .create_surface(wgpu::SurfaceTarget::Canvas(canvas))
            .map_err(|e| GpuError::NoContext(e.to_string()))?;
        Self::on_surface(&instance, surface, size).await
    }

    /// Starts a device that can draw on `surface`.
    pub async fn on_surface(
        instance: &Instance,
        surface: Surface<'static>,
        size: [u32; 2],
    ) -> Result<Self, GpuError> {
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            compatible_surface: Some(&surface),
            ..Default::default()
        };
        let adapter =
            instance.request_adapter(&options).await.map_err(|e| GpuError::NoContext(e.to_string()))?;
        let limits = Limits::downlevel_webgl2_defaults().using_resolution(adapter.limits());
        let description = wgpu::DeviceDescriptor { required_limits: limits.clone(), ..Default::default() };
        let (device, queue) =
            adapter.request_device(&description).await.map_err(|e| GpuError::NoDevice(e.to_string()))?;
        let mut config =
            surface.get_default_config(&adapter, size[0].max(1), size[1].max(1)).ok_or_else(|| {
                GpuError::NoContext("the canvas and the driver have no format in common".into())
            })?;
        // Colours are blended as they are seen, like everything else in the page.
        config.format = config.format.remove_srgb_suffix();
        surface.configure(&device, &config);
        let targets = Targets::new(&device, &config);
        let failure = Arc::new(Mutex::new(None));
        let report = Arc::clone(&failure);
        device.on_uncaptured_error(Arc::new(move |e: wgpu::Error| {
            report.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(e.to_string());
        }));
        Ok(Self { failure, device, queue, limits, surface, config, targets })
    }

    /// Fits the targets to a canvas of this many device pixels.
    pub fn resize(&mut self, width: u32, height: u32) {
        let largest = self.limits.max_texture_dimension_2d;
        let size = (width.clamp(1, largest), height.clamp(1, largest));
        if size != (self.config.width, self.config.height) {
            (self.config.width, self.config.height) = size;
            self.surface.configure(&self.device, &self.config);
            self.targets = Targets::new(&self.device, &self.config);
        }
    }

    /// Format of the canvas.
    pub fn format(&self) -> TextureFormat {
        self.config.format
    }

    /// Device pixels across and down.
    pub fn size(&self) -> [u32; 2] {
        [self.config.width, self.config.height]
    }

    /// What went wrong since the last call, if anything did.
    pub fn check(&self) -> Result<(), GpuError> {
        let failure = self.failure.lock().unwrap_or_else(PoisonError::into_inner).take();
        failure.map_or(Ok(()), |message| Err(GpuError::Failed(message)))
    }

    /// Draws a frame with `draw` and shows it.
    pub fn frame(&self, draw: impl FnOnce(&Device, &Queue, Target<'_>)) -> Result<(), GpuError> {
        let canvas = match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(texture) | CurrentSurfaceTexture::Suboptimal(texture) => texture,
            // Nothing to be seen now; the next change draws again.
            CurrentSurfaceTexture::Timeout | CurrentSurfaceTexture::Occluded => return Ok(()),
            CurrentSurfaceTexture::Outdated
            | CurrentSurfaceTexture::Lost
            | CurrentSurfaceTexture::Validation => return Err(GpuError::Lost),
        };
        let resolved = canvas.texture.create_view(&Default::default());
        draw(
            &self.device,
            &self.queue,
            Target { colour: &self.targets.colour, resolved, depth: &self.targets.depth },
        );
        self.queue.present(canvas);
        self.check()
    }
}

impl Targets {
    fn new(device: &Device, config: &SurfaceConfiguration) -> Self {
        let view = |format| multisampled(device, config, format).create_view(&Default::default());
        Self { colour: view(config.format), depth: view(DEPTH_FORMAT) }
    }
}

fn multisampled(device: &Device, config: &SurfaceConfiguration, format: TextureFormat) -> Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: Extent3d { width: config.width, height: config.height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: SAMPLES,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    })
}
