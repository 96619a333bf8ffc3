//! Finished maps, kept from one picture to the next as long as nothing changes that they depend on, and drawn once where
//! two begin alike.

use std::collections::HashMap;

use super::RenderError;
use super::fingerprint::{Fingerprint, Fingerprinter};
use super::format::{name_of, texel_bytes};
use super::job::Draw;
use super::map_passes::{Base, Work, space_bytes};
use super::maps::MapPlan;
use super::shelf::Shelf;
use super::uploads::Uploads;

/// Bytes of maps that are kept at most.
const ROOM: u64 = 512 << 20;

/// Maps of earlier pictures.
pub(super) struct MapStore {
    shelf: Shelf<wgpu::Texture>,
    /// Views that casters were drawn into so far.
    pub(super) drawn: usize,
}

impl Default for MapStore {
    fn default() -> Self {
        Self { shelf: Shelf::new(ROOM), drawn: 0 }
    }
}

/// What casts shadows: the shapes, and the blocks with their places.
pub(super) fn casters(draws: &[Draw<'_>], blocks: &[Vec<u8>], uploads: &mut Uploads<'_>) -> Fingerprint {
    let mut all = Fingerprinter::new();
    for (draw, block) in draws.iter().zip(blocks).filter(|(d, _)| d.casts && !d.mesh.indices.is_empty()) {
        all = all.and(uploads.shape(draw.mesh)).bytes(block);
    }
    all.finish()
}

impl MapPlan<'_> {
    /// Names for what has been made after each of its passes: all that it depends on.
    fn names(&self, casters: Fingerprint) -> Vec<Fingerprint> {
        let mut name = Fingerprinter::new().and(casters).bytes(&space_bytes(&self.views));
        let mut names = Vec::new();
        for (pass, step) in self.passes.iter().zip(&self.steps) {
            name = name
                .bytes(pass.kind.name().as_bytes())
                .bytes(pass.wgsl.as_bytes())
                .bytes(name_of(step.format).as_bytes())
                .number(u64::from(step.side))
                .number(u64::from(pass.reads_light))
                .number(pass.repeat.map_or(0, u64::from));
            for number in &pass.clear {
                name = name.bytes(&number.to_le_bytes());
            }
            for (option, choice) in &pass.choices {
                name = name.bytes(option.as_bytes()).bytes(choice.as_bytes());
            }
            names.push(name.finish());
        }
        names
    }

    /// Bytes of what the first `count` passes make.
    fn made_bytes(&self, count: usize) -> u64 {
        let step = &self.steps[count - 1];
        let texels = u64::from(step.side).pow(2) * self.views.len() as u64;
        // Mip levels add less than a third, and one more layer where the device needs it is not worth counting.
        texels * u64::from(texel_bytes(step.format)) * if count == self.passes.len() { 4 } else { 3 } / 3
    }
}

/// What the maps of a job are made from, and those that are made.
struct Making<'a> {
    plans: &'a [MapPlan<'a>],
    /// Per map, after each of its passes.
    names: Vec<Vec<Fingerprint>>,
    /// How many of the maps that are missing come by here.
    shared: HashMap<Fingerprint, usize>,
    made: HashMap<Fingerprint, wgpu::Texture>,
}

impl MapStore {
    /// The finished maps. Those that are kept are taken, the others made, with equal beginnings made once.
    pub(super) fn maps(
        &mut self,
        plans: &[MapPlan<'_>],
        casters: Fingerprint,
        work: &mut Work<'_, '_>,
    ) -> Result<Vec<wgpu::Texture>, RenderError> {
        let names: Vec<Vec<Fingerprint>> = plans.iter().map(|p| p.names(casters)).collect();
        let mut making = Making { plans, names, shared: HashMap::new(), made: HashMap::new() };
        for names in &making.names {
            let missing = names.last().is_some_and(|last| match self.shelf.get(*last) {
                Some(texture) => making.made.insert(*last, texture).is_some(),
                None => true,
            });
            for name in names.iter().filter(|_| missing) {
                *making.shared.entry(*name).or_default() += 1;
            }
        }
        (0..plans.len()).map(|index| self.made(&mut making, work, index, plans[index].passes.len())).collect()
    }

    /// What the first `count` passes of a map make.
    fn made(
        &mut self,
        making: &mut Making<'_>,
        work: &mut Work<'_, '_>,
        index: usize,
        count: usize,
    ) -> Result<wgpu::Texture, RenderError> {
        let name = making.names[index][count - 1];
        if let Some(texture) = making.made.get(&name).cloned().or_else(|| self.shelf.get(name)) {
            return Ok(texture);
        }
        let sharers = |making: &Making<'_>, name| making.shared.get(&name).copied().unwrap_or(0);
        // The longest beginning that is there, or that more maps need than need this.
        let mut passes = 0;
        for earlier in (1..count).rev() {
            let known = making.names[index][earlier - 1];
            if making.made.contains_key(&known)
                || self.shelf.get(known).is_some()
                || sharers(making, known) > sharers(making, name)
            {
                passes = earlier;
                break;
            }
        }
        let plan = &making.plans[index];
        let texture = if passes == 0 {
            self.drawn += plan.views.len();
            plan.render(work, None, count)?
        } else {
            let base = self.made(making, work, index, passes)?;
            making.plans[index].render(work, Some(&Base { texture: &base, passes }), count)?
        };
        self.shelf.put(name, texture.clone(), making.plans[index].made_bytes(count));
        making.made.insert(name, texture.clone());
        Ok(texture)
    }

    /// Keeps at most so many bytes.
    pub(super) fn set_room(&mut self, bytes: u64) {
        self.shelf.set_room(bytes);
    }

    /// Whether no map is kept.
    #[cfg(test)]
    pub(super) fn is_empty(&self) -> bool {
        self.shelf.is_empty()
    }

    /// Forgets all maps.
    pub(super) fn clear(&mut self) {
        self.shelf.clear();
    }
}
