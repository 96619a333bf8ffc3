//! What a job brings to the device: vertices, images, samplers, surroundings. Each is looked at once per job, and uploaded
//! where an earlier job has not brought the same contents.

use std::collections::BTreeMap;

use half::f16;
use wgpu::TextureFormat;

use super::RenderError;
use super::device::Device;
use super::fingerprint::{Fingerprint, Fingerprinter};
use super::job::{ImageLoader, Picture, Surroundings, SurroundingsLevel, Texels};
use super::picture_levels::levels;
use super::shelf::Shelf;
use crate::module::{Address, Attribute, SamplerSettings};
use crate::scene::Mesh;

/// Bytes of vertices, and of pictures, that are kept at most.
const ROOM: u64 = 256 << 20;

/// Uploads of earlier jobs, by their contents.
pub(super) struct KeptUploads {
    vertices: Shelf<wgpu::Buffer>,
    textures: Shelf<wgpu::TextureView>,
    /// Buffers and textures that were made so far.
    pub(super) made: usize,
}

impl Default for KeptUploads {
    fn default() -> Self {
        Self { vertices: Shelf::new(ROOM), textures: Shelf::new(ROOM), made: 0 }
    }
}

impl KeptUploads {
    /// Whether nothing is kept.
    #[cfg(test)]
    pub(super) fn is_empty(&self) -> bool {
        self.vertices.is_empty() && self.textures.is_empty()
    }

    /// Forgets everything.
    pub(super) fn clear(&mut self) {
        self.vertices.clear();
        self.textures.clear();
    }
}

/// Uploads of one job.
pub(super) struct Uploads<'a> {
    device: &'a Device,
    kept: &'a mut KeptUploads,
    contents: BTreeMap<(usize, u32), Fingerprint>,
    vertices: BTreeMap<(usize, u32), wgpu::Buffer>,
    images: BTreeMap<(String, String, bool), wgpu::TextureView>,
    samplers: BTreeMap<SamplerSettings, wgpu::Sampler>,
    environment: Option<(wgpu::TextureView, wgpu::Sampler)>,
    /// What was done otherwise than asked.
    pub(super) messages: Vec<String>,
}

/// Stands for the index list where a location is expected.
const INDICES: u32 = u32::MAX;

impl<'a> Uploads<'a> {
    pub(super) fn new(device: &'a Device, kept: &'a mut KeptUploads) -> Self {
        Self {
            device,
            kept,
            contents: BTreeMap::new(),
            vertices: BTreeMap::new(),
            images: BTreeMap::new(),
            samplers: BTreeMap::new(),
            environment: None,
            messages: Vec::new(),
        }
    }

    /// Stands for where the triangles of a mesh are.
    pub(super) fn shape(&mut self, mesh: &Mesh) -> Fingerprint {
        let positions = self.contents(mesh, Attribute::Position.location(), bytemuck::cast_slice(&mesh.positions));
        let indices = self.contents(mesh, INDICES, bytemuck::cast_slice(&mesh.indices));
        Fingerprinter::new().and(positions).and(indices).finish()
    }

    /// Stands for the contents of one attribute.
    fn contents(&mut self, mesh: &Mesh, location: u32, bytes: &[u8]) -> Fingerprint {
        // Meshes outlive the job, so that their addresses name them.
        let key = (std::ptr::from_ref(mesh).addr(), location);
        *self.contents.entry(key).or_insert_with(|| Fingerprinter::new().bytes(bytes).finish())
    }

    /// One vertex attribute of a mesh.
    pub(super) fn attribute(&mut self, mesh: &Mesh, location: u32) -> Result<wgpu::Buffer, RenderError> {
        let bytes: (usize, &[u8]) = match location {
            l if l == Attribute::Position.location() => (mesh.positions.len(), bytemuck::cast_slice(&mesh.positions)),
            l if l == Attribute::Normal.location() => (mesh.normals.len(), bytemuck::cast_slice(&mesh.normals)),
            l if l == Attribute::Texcoord.location() => (mesh.texcoords.len(), bytemuck::cast_slice(&mesh.texcoords)),
            l if l == Attribute::Tangent.location() => (mesh.tangents.len(), bytemuck::cast_slice(&mesh.tangents)),
            _ => (mesh.colors.len(), bytemuck::cast_slice(&mesh.colors)),
        };
        if bytes.0 != mesh.positions.len() {
            return Err(RenderError::Job(format!(
                "a mesh of {} vertices has {} values of the attribute at location {location}",
                mesh.positions.len(),
                bytes.0
            )));
        }
        self.vertex_buffer(mesh, location, wgpu::BufferUsages::VERTEX, bytes.1)
    }

    /// The index list of a mesh.
    pub(super) fn indices(&mut self, mesh: &Mesh) -> Result<wgpu::Buffer, RenderError> {
        self.vertex_buffer(mesh, INDICES, wgpu::BufferUsages::INDEX, bytemuck::cast_slice(&mesh.indices))
    }

    fn vertex_buffer(
        &mut self,
        mesh: &Mesh,
        location: u32,
        usage: wgpu::BufferUsages,
        bytes: &[u8],
    ) -> Result<wgpu::Buffer, RenderError> {
        let key = (std::ptr::from_ref(mesh).addr(), location);
        if let Some(buffer) = self.vertices.get(&key) {
            return Ok(buffer.clone());
        }
        let contents = self.contents(mesh, location, bytes);
        let name = Fingerprinter::new().and(contents).number(u64::from(usage.bits())).finish();
        let buffer = match self.kept.vertices.get(name) {
            Some(buffer) => buffer,
            None => {
                let buffer = self.device.buffer("a mesh", usage, bytes)?;
                self.kept.made += 1;
                self.kept.vertices.put(name, buffer.clone(), buffer.size());
                buffer
            }
        };
        self.vertices.insert(key, buffer.clone());
        Ok(buffer)
    }

    /// An image with its mip levels.
    pub(super) fn image(
        &mut self,
        path: &str,
        base: &str,
        srgb: bool,
        load: &ImageLoader<'_>,
    ) -> Result<wgpu::TextureView, RenderError> {
        let key = (path.to_owned(), base.to_owned(), srgb);
        if let Some(view) = self.images.get(&key) {
            return Ok(view.clone());
        }
        let refuse = |message: String| RenderError::Image { path: path.to_owned(), message };
        let picture = load(path, base).map_err(refuse)?;
        let texels = match &picture.texels {
            Texels::Bytes(t) => t.len(),
            Texels::Floats(t) => t.len(),
        };
        if texels == 0 || texels as u64 != u64::from(picture.width) * u64::from(picture.height) {
            return Err(refuse(format!("{texels} texels are no {} x {} picture", picture.width, picture.height)));
        }
        let most = self.device.limits.max_texture_dimension_2d;
        let too_large = picture.width.max(picture.height) > most;
        // Files change: a picture is known by what is in it. One that is reduced is made again, with what is said of it.
        let name = image_name(&picture, srgb);
        if let Some(view) = self.kept.textures.get(name).filter(|_| !too_large) {
            self.images.insert(key, view.clone());
            return Ok(view);
        }
        let mut all = levels(&picture, srgb);
        if too_large {
            let fitting = all.iter().position(|l| l.width.max(l.height) <= most).unwrap_or(0);
            all.drain(..fitting);
            self.messages.push(format!(
                "image `{path}` is larger than the {most} texels that the adapter allows; it is reduced to {} x {}",
                all[0].width, all[0].height
            ));
        }
        let format = match (&picture.texels, srgb) {
            (Texels::Floats(_), _) => TextureFormat::Rgba16Float,
            (Texels::Bytes(_), true) => TextureFormat::Rgba8UnormSrgb,
            (Texels::Bytes(_), false) => TextureFormat::Rgba8Unorm,
        };
        let bytes: Vec<(u32, u32, Vec<u8>)> = all.iter().map(|l| (l.width, l.height, image_bytes(l))).collect();
        let view = self.texture(name, path, format, &bytes);
        self.images.insert(key, view.clone());
        Ok(view)
    }

    /// The surroundings, and how they are sampled. A scene without any has one black texel.
    pub(super) fn environment(
        &mut self,
        surroundings: Option<&Surroundings>,
    ) -> Result<(wgpu::TextureView, wgpu::Sampler), RenderError> {
        if let Some(made) = &self.environment {
            return Ok(made.clone());
        }
        let black = [SurroundingsLevel { width: 1, height: 1, pixels: vec![[0.0; 4]] }];
        let all = surroundings.map_or(&black[..], |s| &s.levels);
        let mut expected = all.first().map_or((0, 0), |l| (l.width, l.height));
        self.device.check_texture("the picture of the surroundings", expected.0, expected.1)?;
        for level in all {
            let texels = u64::from(level.width) * u64::from(level.height);
            if (level.width, level.height) != expected || level.pixels.len() as u64 != texels {
                return Err(RenderError::Job("the levels of the surroundings do not halve".into()));
            }
            expected = ((level.width / 2).max(1), (level.height / 2).max(1));
        }
        let largest = all.first().map_or(1, |l| l.width.max(l.height));
        if all.len() > largest.ilog2() as usize + 1 {
            return Err(RenderError::Job("the surroundings have more levels than their size allows".into()));
        }
        let mut name = Fingerprinter::new().bytes(b"surroundings");
        for level in all {
            let size = u64::from(level.width) << 32 | u64::from(level.height);
            name = name.number(size).bytes(bytemuck::cast_slice(&level.pixels));
        }
        let name = name.finish();
        let view = match self.kept.textures.get(name) {
            Some(view) => view,
            None => {
                let bytes: Vec<(u32, u32, Vec<u8>)> = all
                    .iter()
                    .map(|l| {
                        let halves = l.pixels.iter().flatten().flat_map(|x| half_bytes(x.max(0.0)));
                        (l.width, l.height, halves.collect())
                    })
                    .collect();
                self.texture(name, "surroundings", TextureFormat::Rgba16Float, &bytes)
            }
        };
        let sampler = self.device.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("surroundings"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::ClampToEdge,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..wgpu::SamplerDescriptor::default()
        });
        self.environment = Some((view.clone(), sampler.clone()));
        Ok((view, sampler))
    }

    /// A sampler with these settings, or the nearest to them that the adapter has.
    pub(super) fn sampler(&mut self, settings: &SamplerSettings) -> Result<wgpu::Sampler, RenderError> {
        if let Some(sampler) = self.samplers.get(settings) {
            return Ok(sampler.clone());
        }
        if settings.compare && !self.device.downlevel.contains(wgpu::DownlevelFlags::COMPARISON_SAMPLERS) {
            return Err(RenderError::Unsupported("the adapter has no comparison samplers".into()));
        }
        let mut anisotropy = settings.anisotropy.clamp(1, 16);
        if anisotropy > 1 && !self.device.downlevel.contains(wgpu::DownlevelFlags::ANISOTROPIC_FILTERING) {
            self.messages.push("the adapter has no anisotropic filtering; trilinear filtering takes its place".into());
            anisotropy = 1;
        }
        // Anisotropic filtering is defined on top of trilinear filtering only.
        let linear = settings.linear || anisotropy > 1;
        let mip_linear = settings.mip_linear || anisotropy > 1;
        let filter = if linear { wgpu::FilterMode::Linear } else { wgpu::FilterMode::Nearest };
        let address = match settings.address {
            Address::Repeat => wgpu::AddressMode::Repeat,
            Address::Clamp => wgpu::AddressMode::ClampToEdge,
            Address::Mirror => wgpu::AddressMode::MirrorRepeat,
        };
        let sampler = self.device.device.create_sampler(&wgpu::SamplerDescriptor {
            label: None,
            address_mode_u: address,
            address_mode_v: address,
            mag_filter: filter,
            min_filter: filter,
            mipmap_filter: if mip_linear { wgpu::MipmapFilterMode::Linear } else { wgpu::MipmapFilterMode::Nearest },
            compare: settings.compare.then_some(wgpu::CompareFunction::LessEqual),
            anisotropy_clamp: anisotropy,
            ..wgpu::SamplerDescriptor::default()
        });
        self.samplers.insert(settings.clone(), sampler.clone());
        Ok(sampler)
    }

    fn texture(
        &mut self,
        name: Fingerprint,
        what: &str,
        format: TextureFormat,
        levels: &[(u32, u32, Vec<u8>)],
    ) -> wgpu::TextureView {
        let extent = |width, height| wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        let texture = self.device.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(what),
            size: levels.first().map_or(extent(1, 1), |l| extent(l.0, l.1)),
            mip_level_count: u32::try_from(levels.len()).unwrap_or(1),
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        for (mip_level, (width, height, bytes)) in (0..).zip(levels) {
            let rows = wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(width * format.block_copy_size(None).unwrap_or(4)),
                rows_per_image: Some(*height),
            };
            let to = wgpu::TexelCopyTextureInfo { mip_level, ..texture.as_image_copy() };
            self.device.queue.write_texture(to, bytes, rows, extent(*width, *height));
        }
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        self.kept.made += 1;
        self.kept.textures.put(name, view.clone(), levels.iter().map(|l| l.2.len() as u64).sum());
        view
    }
}

/// Stands for a picture and how it is read.
fn image_name(picture: &Picture, srgb: bool) -> Fingerprint {
    let name = Fingerprinter::new()
        .bytes(b"image")
        .number(u64::from(picture.width) << 32 | u64::from(picture.height))
        .number(u64::from(srgb));
    match &picture.texels {
        Texels::Bytes(texels) => name.number(8).bytes(texels.as_flattened()),
        Texels::Floats(texels) => name.number(32).bytes(bytemuck::cast_slice(texels)),
    }
    .finish()
}

fn image_bytes(picture: &Picture) -> Vec<u8> {
    match &picture.texels {
        Texels::Bytes(texels) => texels.concat(),
        Texels::Floats(texels) => texels.iter().flatten().flat_map(|x| half_bytes(*x)).collect(),
    }
}

/// Half precision, held within its range; NaN is 0.
fn half_bytes(x: f32) -> [u8; 2] {
    const MOST: f32 = 65504.0;
    f16::from_f32(if x.is_nan() { 0.0 } else { x.clamp(-MOST, MOST) }).to_le_bytes()
}
