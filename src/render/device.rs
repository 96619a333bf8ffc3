//! The device, and how its complaints become errors instead of panics.

use std::sync::{Arc, Mutex, PoisonError};

use wgpu::TextureFormat;

use super::RenderError;
use super::adapter::{self, AdapterOptions, AdapterSummary};
use super::error::UNIFORM_BLOCK;
use super::format::{self, Abilities};

/// An open device with everything that is asked about it.
pub(super) struct Device {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    pub(super) limits: wgpu::Limits,
    pub(super) features: wgpu::Features,
    pub(super) downlevel: wgpu::DownlevelFlags,
    pub(super) summary: AdapterSummary,
    adapter: wgpu::Adapter,
    trouble: Arc<Trouble>,
}

/// What the texels of a texture are, and what they are for besides being rendered and read.
#[derive(Clone, Copy, Debug)]
pub(super) struct Texels {
    pub(super) format: TextureFormat,
    pub(super) samples: u32,
    pub(super) levels: u32,
    /// Compute shaders write them.
    pub(super) stored: bool,
}

impl Texels {
    /// One sample, one level, written by drawing.
    pub(super) fn plain(format: TextureFormat) -> Self {
        Self { format, samples: 1, levels: 1, stored: false }
    }
}

/// What the device reports by itself, outside of any call.
#[derive(Default)]
struct Trouble {
    lost: Mutex<Option<String>>,
    error: Mutex<Option<RenderError>>,
}

fn put<T>(slot: &Mutex<Option<T>>, value: T) {
    slot.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(value);
}

fn take<T>(slot: &Mutex<Option<T>>) -> Option<T> {
    slot.lock().unwrap_or_else(PoisonError::into_inner).take()
}

impl Device {
    /// Opens the adapter that the options ask for.
    pub(super) fn open(options: &AdapterOptions) -> Result<Self, RenderError> {
        let adapter = adapter::find(options)?;
        let summary = adapter::summary(&adapter);
        let features = adapter.features() & adapter::wanted_features();
        let request = adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("shadetree"),
            required_features: features,
            required_limits: adapter.limits(),
            ..Default::default()
        });
        let (device, queue) = pollster::block_on(request)
            .map_err(|e| RenderError::NoDevice { adapter: summary.name.clone(), message: e.to_string() })?;
        let trouble = Arc::new(Trouble::default());
        let reported = trouble.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| put(&reported.error, convert("device", &error))));
        let reported = trouble.clone();
        device.set_device_lost_callback(move |_, message| {
            // Dropping a device destroys it, but then nobody asks any more.
            put(&reported.lost, if message.is_empty() { "it was destroyed".to_owned() } else { message });
        });
        let downlevel = adapter.get_downlevel_capabilities().flags;
        Ok(Self { limits: device.limits(), device, queue, features, downlevel, summary, adapter, trouble })
    }

    /// What the device can do with a format.
    pub(super) fn abilities(&self, format: TextureFormat) -> Abilities {
        let known = format::abilities(&self.adapter, self.features, format);
        // Some OpenGL devices have storage textures and no compute shaders.
        let computes = self.downlevel.contains(wgpu::DownlevelFlags::COMPUTE_SHADERS);
        Abilities { storable: known.storable && computes, ..known }
    }

    /// Does `work`, and turns whatever the device says about it into an error that names `what`.
    pub(super) fn scoped<T>(
        &self,
        what: &str,
        work: impl FnOnce() -> Result<T, RenderError>,
    ) -> Result<T, RenderError> {
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let internal = self.device.push_error_scope(wgpu::ErrorFilter::Internal);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let result = work();
        // Scopes close in the reverse of the order in which they were opened.
        let validation = pollster::block_on(validation.pop());
        let internal = pollster::block_on(internal.pop());
        let memory = pollster::block_on(memory.pop());
        // Memory first: running out of it makes later calls invalid.
        let error = memory.or(validation).or(internal);
        if error.is_some() || result.is_err() {
            // Loss is told while polling, and makes everything else invalid.
            let _ = self.device.poll(wgpu::PollType::Poll);
        }
        if let Some(message) = self.trouble.lost.lock().unwrap_or_else(PoisonError::into_inner).clone() {
            return Err(RenderError::DeviceLost(message));
        }
        if let Some(error) = error {
            return Err(convert(what, &error));
        }
        if let Some(error) = take(&self.trouble.error) {
            return Err(error);
        }
        result
    }

    /// Waits until everything submitted is done.
    pub(super) fn wait(&self) -> Result<(), RenderError> {
        const PATIENCE: std::time::Duration = std::time::Duration::from_secs(600);
        let wait = wgpu::PollType::Wait { submission_index: None, timeout: Some(PATIENCE) };
        match self.device.poll(wait) {
            Ok(_) => Ok(()),
            Err(error) => Err(RenderError::DeviceLost(error.to_string())),
        }
    }

    /// Fails if a texture of this size is impossible.
    pub(super) fn check_texture(&self, what: &str, width: u32, height: u32) -> Result<(), RenderError> {
        if width == 0 || height == 0 {
            return Err(RenderError::Job(format!("{what} has no pixels ({width} x {height})")));
        }
        check(what, u64::from(width.max(height)), u64::from(self.limits.max_texture_dimension_2d), "texels on a side")
    }

    /// Fails if a uniform block of this size is impossible.
    pub(super) fn check_uniform(&self, what: &str, size: u64) -> Result<(), RenderError> {
        let block = format!("{UNIFORM_BLOCK} `{what}`");
        check(&block, size, self.limits.max_uniform_buffer_binding_size, "bytes")
    }

    /// A buffer with `contents`, padded to a multiple of 4 bytes.
    pub(super) fn buffer(
        &self,
        what: &str,
        usage: wgpu::BufferUsages,
        contents: &[u8],
    ) -> Result<wgpu::Buffer, RenderError> {
        let size = (contents.len() as u64).next_multiple_of(4).max(16);
        check(what, size, self.limits.max_buffer_size, "bytes")?;
        if usage.contains(wgpu::BufferUsages::UNIFORM) {
            self.check_uniform(what, size)?;
        }
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(what),
            size,
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let whole = contents.len() / 4 * 4;
        self.queue.write_buffer(&buffer, 0, &contents[..whole]);
        if whole < contents.len() {
            let mut last = [0; 4];
            last[..contents.len() - whole].copy_from_slice(&contents[whole..]);
            self.queue.write_buffer(&buffer, whole as u64, &last);
        }
        Ok(buffer)
    }

    /// Whether shaders can read one layer of an array as if it were a texture of its own.
    pub(super) fn reads_layers(&self) -> bool {
        self.summary.backend != "gl"
    }

    /// How many layers an array for `wanted` views gets. OpenGL takes one layer for no array, and six for a cube.
    pub(super) fn array_layers(&self, wanted: u32) -> u32 {
        let mistaken = wanted == 1 || wanted.is_multiple_of(6);
        if mistaken && !self.reads_layers() { wanted + 1 } else { wanted }
    }

    /// A texture to render to and to read from, in shaders and, where possible, on the host.
    pub(super) fn target(
        &self,
        what: &str,
        (width, height): (u32, u32),
        format: TextureFormat,
        samples: u32,
        levels: u32,
    ) -> wgpu::Texture {
        let texels = Texels { format, samples, levels, stored: false };
        self.texture(what, wgpu::Extent3d { width, height, depth_or_array_layers: 1 }, texels)
    }

    /// A square one with layers.
    pub(super) fn layers(&self, what: &str, side: u32, layers: u32, texels: Texels) -> wgpu::Texture {
        let size = wgpu::Extent3d { width: side, height: side, depth_or_array_layers: layers };
        self.texture(what, size, texels)
    }

    fn texture(&self, what: &str, size: wgpu::Extent3d, texels: Texels) -> wgpu::Texture {
        let Texels { format, samples, levels, stored } = texels;
        let mut usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        if stored {
            usage |= wgpu::TextureUsages::STORAGE_BINDING;
        }
        if samples == 1 {
            usage |= wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC;
            // Depth is not copied between textures, and not every backend could.
            if !format.is_depth_stencil_format() {
                usage |= wgpu::TextureUsages::COPY_DST;
            }
        }
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(what),
            size,
            mip_level_count: levels,
            sample_count: samples,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        })
    }
}

/// Fails where `size` is over `limit`, both counted in `unit`.
pub(super) fn check(what: &str, size: u64, limit: u64, unit: &'static str) -> Result<(), RenderError> {
    if size <= limit { Ok(()) } else { Err(RenderError::TooLarge { what: what.to_owned(), size, limit, unit }) }
}

fn convert(what: &str, error: &wgpu::Error) -> RenderError {
    match error {
        wgpu::Error::OutOfMemory { .. } => RenderError::OutOfMemory(what.to_owned()),
        wgpu::Error::Validation { description, .. } | wgpu::Error::Internal { description, .. } => {
            RenderError::Rejected { what: what.to_owned(), message: description.trim().to_owned() }
        }
    }
}
