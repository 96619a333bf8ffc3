//! Textures and buffers back to the host.

use std::sync::{Arc, Mutex, PoisonError};

use wgpu::TextureFormat;

use super::RenderError;
use super::device::{Device, check};
use super::format;

/// Most bytes that are copied at once.
const BAND_BYTES: u64 = 64 << 20;

/// The first `size` bytes of a buffer that can be copied from, once everything submitted is done.
pub(super) fn buffer(device: &Device, source: &wgpu::Buffer, size: u64) -> Result<Vec<u8>, RenderError> {
    let staging = staging(device, size)?;
    let mut encoder = device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_buffer_to_buffer(source, 0, &staging, 0, size);
    device.queue.submit([encoder.finish()]);
    read(device, &staging)
}

/// Mip level 0 of a single-sampled texture, decoded, rows from the top.
pub(super) fn texture(device: &Device, texture: &wgpu::Texture) -> Result<Vec<[f32; 4]>, RenderError> {
    Ok(format::decode_all(texture.format(), &bytes(device, texture, 0)?))
}

/// The texels of one layer as they are stored, without gaps.
pub(super) fn bytes(device: &Device, texture: &wgpu::Texture, layer: u32) -> Result<Vec<u8>, RenderError> {
    let (width, height, format) = (texture.width(), texture.height(), texture.format());
    let texel = format::texel_bytes(format);
    let row = width * texel;
    let pitch = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let is_depth = format == TextureFormat::Depth32Float;
    let depth_copies = wgpu::DownlevelFlags::DEPTH_TEXTURE_AND_BUFFER_COPIES;
    if is_depth && !device.downlevel.contains(depth_copies) {
        return Err(RenderError::Unsupported(
            "the adapter cannot read depth textures back; a map in a colour format or another backend can be".into(),
        ));
    }
    let band_bytes = BAND_BYTES.min(device.limits.max_buffer_size);
    let band = if is_depth {
        // Depth can only be copied as a whole.
        height
    } else {
        u32::try_from(band_bytes / u64::from(pitch)).unwrap_or(height).clamp(1, height)
    };
    let mut all = Vec::with_capacity(row as usize * height as usize);
    for top in (0..height).step_by(band as usize) {
        let rows = band.min(height - top);
        let staging = staging(device, u64::from(pitch) * u64::from(rows))?;
        let mut encoder = device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo {
                texture,
                mip_level: 0,
                origin: wgpu::Origin3d { x: 0, y: top, z: layer },
                aspect: if is_depth { wgpu::TextureAspect::DepthOnly } else { wgpu::TextureAspect::All },
            },
            wgpu::TexelCopyBufferInfo {
                buffer: &staging,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(pitch),
                    rows_per_image: Some(rows),
                },
            },
            wgpu::Extent3d { width, height: rows, depth_or_array_layers: 1 },
        );
        device.queue.submit([encoder.finish()]);
        let bytes = read(device, &staging)?;
        for line in bytes.chunks_exact(pitch as usize) {
            all.extend_from_slice(&line[..row as usize]);
        }
    }
    Ok(all)
}

fn staging(device: &Device, size: u64) -> Result<wgpu::Buffer, RenderError> {
    check("the buffer for reading back", size, device.limits.max_buffer_size, "bytes")?;
    Ok(device.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read back"),
        size,
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    }))
}

fn read(device: &Device, staging: &wgpu::Buffer) -> Result<Vec<u8>, RenderError> {
    let rejected = |message: String| RenderError::Rejected { what: "reading back".into(), message };
    let outcome = Arc::new(Mutex::new(None));
    let told = outcome.clone();
    staging.map_async(wgpu::MapMode::Read, .., move |result| {
        *told.lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
    });
    device.wait()?;
    let outcome = outcome.lock().unwrap_or_else(PoisonError::into_inner).take();
    outcome.ok_or_else(|| rejected("the device gave no answer".into()))?.map_err(|e| rejected(e.to_string()))?;
    let bytes = staging.get_mapped_range(..).map_err(|e| rejected(e.to_string()))?.to_vec();
    staging.unmap();
    Ok(bytes)
}
