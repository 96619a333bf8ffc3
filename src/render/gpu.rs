//! Rendering a job: maps, then the picture, then back to the host.

use wgpu::TextureFormat;

use super::adapter::{AdapterOptions, AdapterSummary};
use super::blocks::{check_camera, object_block};
use super::device::{Device, check};
use super::format::{self, Abilities, channels, name_of, texel_bytes};
use super::job::{ColorFormat, Frame, Job, MapPicture, MapSummary};
use super::main_pass::{Main, Target, background_spec, main_spec};
use super::map_passes::Work;
use super::map_store::{MapStore, casters};
use super::maps::{LightPlans, MapPlan};
use super::pipeline::Pipelines;
use super::timing::Timer;
use super::uploads::{KeptUploads, Uploads};
use super::{RenderError, read_back};

/// Most bytes of textures that one job may take.
const MOST_BYTES: u64 = 4 << 30;

/// A device with what it has made so far, and uses again where nothing has changed that it depends on.
pub struct Gpu {
    device: Device,
    pipelines: Pipelines,
    maps: MapStore,
    uploads: KeptUploads,
}

impl Gpu {
    /// Opens the adapter that the options ask for.
    pub fn new(options: &AdapterOptions) -> Result<Self, RenderError> {
        Ok(Self {
            device: Device::open(options)?,
            pipelines: Pipelines::default(),
            maps: MapStore::default(),
            uploads: KeptUploads::default(),
        })
    }

    /// What it runs on.
    pub fn adapter(&self) -> &AdapterSummary {
        &self.device.summary
    }

    /// Pipelines that were built so far. Other parameter values need no new ones.
    pub fn pipelines_built(&self) -> usize {
        self.pipelines.built
    }

    /// Views of lights that casters were drawn into so far. A light and casters that stay as they were need none, however
    /// the camera moves: their maps are kept.
    pub fn views_drawn(&self) -> usize {
        self.maps.drawn
    }

    /// Buffers and textures that were uploaded so far. Meshes and pictures with the same contents need none.
    pub fn uploads_made(&self) -> usize {
        self.uploads.made
    }

    /// Keeps at most so many bytes of maps for later pictures (512 MiB unless said). With 0 every picture makes its maps,
    /// which is what measuring them takes.
    pub fn keep_maps(&mut self, bytes: u64) {
        self.maps.set_room(bytes);
    }

    /// Whether no map and no upload is kept.
    #[cfg(test)]
    pub(super) fn keeps_nothing(&self) -> bool {
        self.maps.is_empty() && self.uploads.is_empty()
    }

    /// Destroys the device, as a driver reset would.
    #[cfg(test)]
    pub(crate) fn lose(&self) {
        self.device.device.destroy();
    }

    /// Renders a picture.
    pub fn render(&mut self, job: &Job<'_>) -> Result<Frame, RenderError> {
        self.draw(job, true)
    }

    /// Renders a picture, waits until it is finished and leaves it on the device: what is of interest is how long it took.
    pub fn time(&mut self, job: &Job<'_>) -> Result<Frame, RenderError> {
        self.draw(job, false)
    }

    fn draw(&mut self, job: &Job<'_>, wanted: bool) -> Result<Frame, RenderError> {
        check_camera(&job.camera)?;
        let Self { device, pipelines, maps: store, uploads: kept } = self;
        let device = &*device;
        device.check_texture("the picture", job.size.0, job.size.1)?;
        if !matches!(job.samples, 1 | 4) {
            return Err(RenderError::Job(format!("{} samples per pixel: only 1 and 4 are possible", job.samples)));
        }
        let mut lights = LightPlans::gather(device, job)?;
        let mut messages = std::mem::take(&mut lights.messages);
        let target = choose_target(job.output, job.samples, &|f| device.abilities(f), &mut messages)?;
        let pixels = u64::from(job.size.0) * u64::from(job.size.1);
        let picture_bytes = u64::from(target.samples + 1) * u64::from(texel_bytes(target.format) + 4);
        let map_bytes: u64 = lights.maps.iter().map(MapPlan::bytes).sum();
        check("the picture with its maps", pixels * picture_bytes + map_bytes, MOST_BYTES, "bytes")?;

        lights.build(device, pipelines)?;
        let mut main = Vec::new();
        for (draw, map_of) in job.draws.iter().zip(&lights.map_of) {
            let spec = main_spec(device, draw, map_of, &lights, target)?;
            main.push(pipelines.get(device, "the material's shader", spec)?);
        }
        let background = match job.surroundings {
            Some(surroundings) if surroundings.background => {
                Some(pipelines.get(device, "the background", background_spec(target))?)
            }
            _ => None,
        };
        let frame = device.scoped("the picture", || {
            let mut uploads = Uploads::new(device, kept);
            let passes = lights.maps.iter().map(|m| m.passes.len() * m.views.len()).sum::<usize>();
            let mut timer = Timer::new(device, passes + 1);
            let mut encoder = device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let blocks = object_blocks(job)?;
            let objects = objects(device, &blocks)?;
            let casters = if lights.maps.is_empty() { None } else { Some(casters(&job.draws, &blocks, &mut uploads)) };
            let mut work = Work {
                device,
                encoder: &mut encoder,
                timer: &mut timer,
                draws: &job.draws,
                objects: &objects,
                uploads: &mut uploads,
            };
            let maps = casters.map(|casters| store.maps(&lights.maps, casters, &mut work)).transpose()?;
            let maps = maps.unwrap_or_default();
            timer.next("main".into());
            let prepared = Main { job, target, lights: &lights, maps: &maps, objects: &objects };
            let picture = prepared.render(device, &mut encoder, &timer, &main, background.as_deref(), &mut uploads)?;
            device.queue.submit([encoder.finish()]);
            let pixels = if wanted {
                read_back::texture(device, &picture)?
            } else {
                device.wait()?;
                Vec::new()
            };
            let timings = timer.finish(device)?;
            add_new(&mut messages, uploads.messages);
            Ok(Frame { size: job.size, pixels, timings, adapter: device.summary.clone(), messages })
        });
        if frame.is_err() {
            // What was made may never have been finished, and is gone where the device is.
            store.clear();
            kept.clear();
        }
        frame
    }

    /// The distinct maps that a job needs, as this adapter makes them.
    pub fn maps_of(&self, job: &Job<'_>) -> Result<Vec<MapSummary>, RenderError> {
        let lights = LightPlans::gather(&self.device, job)?;
        let summary = |map: &MapPlan<'_>| MapSummary {
            light: map.light.to_owned(),
            side: map.side(),
            layers: map.views.len(),
            format: name_of(map.format()),
            bits: 8 * texel_bytes(map.format()),
        };
        Ok(lights.maps.iter().map(summary).collect())
    }

    /// Renders a map of a light and reads it back: the one at `index` among the distinct maps of that light.
    pub fn map(&mut self, job: &Job<'_>, light: &str, index: usize) -> Result<MapPicture, RenderError> {
        let (device, kept) = (&self.device, &mut self.uploads);
        let mut lights = LightPlans::gather(device, job)?;
        let position = lights.maps.iter().enumerate().filter(|(_, m)| m.light == light).nth(index).map(|(i, _)| i);
        let Some(position) = position else {
            let mut names: Vec<&str> = lights.maps.iter().map(|m| m.light).collect();
            names.dedup();
            return Err(RenderError::Job(format!(
                "light `{light}` has no map {index}; lights with maps: {}",
                if names.is_empty() { "none".to_owned() } else { names.join(", ") }
            )));
        };
        lights.maps.swap(0, position);
        lights.maps.truncate(1);
        lights.build(device, &mut self.pipelines)?;
        let mut messages = std::mem::take(&mut lights.messages);
        let map = &lights.maps[0];
        check("the map", map.bytes(), MOST_BYTES, "bytes")?;
        let picture = device.scoped("the map", || {
            let mut uploads = Uploads::new(device, kept);
            let mut timer = Timer::new(device, map.passes.len() * map.views.len());
            let mut encoder = device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let objects = objects(device, &object_blocks(job)?)?;
            let mut work = Work {
                device,
                encoder: &mut encoder,
                timer: &mut timer,
                draws: &job.draws,
                objects: &objects,
                uploads: &mut uploads,
            };
            let texture = map.render(&mut work, None, map.passes.len())?;
            device.queue.submit([encoder.finish()]);
            let layers = u32::try_from(map.views.len()).unwrap_or(1);
            let (mut pixels, mut integers) = (Vec::new(), Vec::new());
            for layer in 0..layers {
                let bytes = read_back::bytes(device, &texture, layer)?;
                pixels.append(&mut format::decode_all(map.format(), &bytes));
                integers.append(&mut format::integers(map.format(), &bytes));
            }
            add_new(&mut messages, uploads.messages);
            Ok(MapPicture {
                size: (map.side(), map.side() * u32::try_from(map.views.len()).unwrap_or(1)),
                pixels,
                integers,
                channels: channels(map.format()),
                format: name_of(map.format()),
                spaces: map.views.clone(),
                messages,
            })
        });
        if picture.is_err() {
            self.maps.clear();
            self.uploads.clear();
        }
        picture
    }
}

/// Adds messages that are not there yet.
fn add_new(messages: &mut Vec<String>, more: Vec<String>) {
    for message in more {
        if !messages.contains(&message) {
            messages.push(message);
        }
    }
}

/// The object blocks as the passes read them.
fn objects(device: &Device, blocks: &[Vec<u8>]) -> Result<Vec<wgpu::Buffer>, RenderError> {
    blocks.iter().map(|block| device.buffer("object", wgpu::BufferUsages::UNIFORM, block)).collect()
}

/// One object block per draw.
fn object_blocks(job: &Job<'_>) -> Result<Vec<Vec<u8>>, RenderError> {
    for draw in &job.draws {
        let vertices = draw.mesh.positions.len();
        let stray = draw.mesh.indices.iter().find(|i| usize::try_from(**i).is_ok_and(|i| i >= vertices));
        if let Some(index) = stray {
            return Err(RenderError::Job(format!("a mesh of {vertices} vertices mentions vertex {index}")));
        }
    }
    job.draws.iter().map(object_block).collect()
}

/// The precision that was asked for, or the best that the adapter has.
fn choose_target(
    output: ColorFormat,
    samples: u32,
    abilities: &dyn Fn(TextureFormat) -> Abilities,
    messages: &mut Vec<String>,
) -> Result<Target, RenderError> {
    let all = [TextureFormat::Rgba32Float, TextureFormat::Rgba16Float, TextureFormat::Rgba8Unorm];
    let candidates = if output == ColorFormat::Float { &all[..] } else { &all[1..] };
    // Losing precision hurts less than losing the edges that four samples smooth.
    let able = |f: &&TextureFormat, samples| {
        let able = abilities(**f);
        able.renderable && (samples == 1 || able.multisampled)
    };
    let mut found = candidates.iter().find(|f| able(f, samples)).map(|&format| Target { format, samples });
    if found.is_none() && samples > 1 {
        found = candidates.iter().find(|f| able(f, 1)).map(|&format| Target { format, samples: 1 });
    }
    let target =
        found.ok_or_else(|| RenderError::Unsupported("the adapter cannot render to any colour format".into()))?;
    if target.format != candidates[0] {
        messages.push(format!(
            "the picture is made in {}: the adapter cannot render {} with {samples} samples per pixel",
            name_of(target.format),
            name_of(candidates[0])
        ));
    }
    if target.samples != samples {
        messages.push(format!("the adapter cannot render {samples} samples per pixel; there is one"));
    }
    Ok(target)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn target(output: ColorFormat, samples: u32, abilities: &dyn Fn(TextureFormat) -> Abilities) -> (Target, usize) {
        let mut messages = Vec::new();
        (choose_target(output, samples, abilities, &mut messages).expect("a target"), messages.len())
    }

    #[test]
    fn targets_give_up_precision_before_samples_and_say_so() {
        let all = Abilities { renderable: true, filterable: true, multisampled: true, storable: true };
        let float = Target { format: TextureFormat::Rgba32Float, samples: 4 };
        assert_eq!(target(ColorFormat::Float, 4, &|_| all), (float, 0));
        let portable = |f| Abilities { multisampled: f != TextureFormat::Rgba32Float, ..all };
        let half = Target { format: TextureFormat::Rgba16Float, samples: 4 };
        assert_eq!(target(ColorFormat::Float, 4, &portable), (half, 1));
        assert_eq!(target(ColorFormat::Float, 1, &portable), (Target { samples: 1, ..float }, 0));
        let single = |_| Abilities { multisampled: false, ..all };
        assert_eq!(target(ColorFormat::Half, 4, &single), (Target { samples: 1, ..half }, 1));
    }

    #[test]
    fn an_adapter_without_colour_is_an_error() {
        let nothing = |_| Abilities::default();
        assert!(choose_target(ColorFormat::Half, 1, &nothing, &mut Vec::new()).is_err());
    }
}
