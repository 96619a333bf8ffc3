//! How long passes take, where the device can tell.

use super::RenderError;
use super::device::Device;
use super::job::PassTiming;
use super::read_back;

/// Timestamps at the beginning and the end of each pass.
pub(super) struct Timer {
    set: Option<wgpu::QuerySet>,
    /// Passes that fit into the set.
    room: usize,
    names: Vec<String>,
}

impl Timer {
    /// A timer for up to `passes` passes.
    pub(super) fn new(device: &Device, passes: usize) -> Self {
        let room = passes.min(wgpu::QUERY_SET_MAX_QUERIES as usize / 2);
        let able = device.features.contains(wgpu::Features::TIMESTAMP_QUERY) && room > 0;
        let set = able.then(|| {
            device.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count: u32::try_from(2 * room).unwrap_or(wgpu::QUERY_SET_MAX_QUERIES),
            })
        });
        Self { set, room, names: Vec::new() }
    }

    /// Names the next pass, which consists of the render passes until the next call.
    pub(super) fn next(&mut self, name: String) {
        self.names.push(name);
    }

    /// Timestamps for a render pass of the current pass; `first` and `last` tell whether it begins and ends it.
    pub(super) fn writes(&self, first: bool, last: bool) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        let (query_set, query) = self.query(first || last)?;
        Some(wgpu::RenderPassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: first.then_some(query),
            end_of_pass_write_index: last.then_some(query + 1),
        })
    }

    /// The same for a compute pass.
    pub(super) fn compute_writes(&self, first: bool, last: bool) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        let (query_set, query) = self.query(first || last)?;
        Some(wgpu::ComputePassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: first.then_some(query),
            end_of_pass_write_index: last.then_some(query + 1),
        })
    }

    /// The first timestamp of the current pass, if any is wanted and there is room.
    fn query(&self, wanted: bool) -> Option<(&wgpu::QuerySet, u32)> {
        let index = self.names.len().checked_sub(1).filter(|i| *i < self.room)?;
        Some((self.set.as_ref().filter(|_| wanted)?, u32::try_from(2 * index).ok()?))
    }

    /// Reads the timestamps of everything submitted before.
    pub(super) fn finish(self, device: &Device) -> Result<Vec<PassTiming>, RenderError> {
        let known = self.names.len().min(self.room);
        let mut milliseconds = vec![None; self.names.len()];
        if let Some(set) = self.set.as_ref().filter(|_| known > 0) {
            let size = known as u64 * 16;
            let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
            let descriptor =
                wgpu::BufferDescriptor { label: Some("timestamps"), size, usage, mapped_at_creation: false };
            let resolved = device.device.create_buffer(&descriptor);
            // A submission of its own: some drivers give zeros where timestamps are resolved beside the passes.
            let mut encoder = device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            encoder.resolve_query_set(set, 0..u32::try_from(2 * known).unwrap_or(0), &resolved, 0);
            device.queue.submit([encoder.finish()]);
            let bytes = read_back::buffer(device, &resolved, size)?;
            let period = f64::from(device.queue.get_timestamp_period());
            for (slot, pair) in milliseconds.iter_mut().zip(bytes.chunks_exact(16)) {
                *slot = span(pair, period);
            }
        }
        let timings = self.names.into_iter().zip(milliseconds);
        Ok(timings.map(|(name, milliseconds)| PassTiming { name, milliseconds }).collect())
    }
}

/// Milliseconds between two timestamps of `period` nanoseconds per tick; none if the device wrote none.
#[allow(clippy::cast_precision_loss, reason = "differences of ticks are far below 2^53")]
fn span(pair: &[u8], period: f64) -> Option<f64> {
    let tick = |bytes: &[u8]| Some(u64::from_le_bytes(bytes.try_into().ok()?));
    let (begin, end) = (tick(pair.get(..8)?)?, tick(pair.get(8..16)?)?);
    let ticks = end.checked_sub(begin).filter(|_| end > 0)?;
    Some(ticks as f64 * period * 1e-6)
}

#[cfg(test)]
mod tests {
    use super::span;

    fn pair(begin: u64, end: u64) -> Vec<u8> {
        [begin.to_le_bytes(), end.to_le_bytes()].concat()
    }

    #[test]
    fn ticks_become_milliseconds_by_the_period() {
        assert_eq!(span(&pair(1000, 3000), 1.0), Some(2e-3));
        assert_eq!(span(&pair(1000, 3000), 52.0), Some(0.104));
    }

    #[test]
    fn timestamps_that_were_not_written_or_run_backwards_are_no_time() {
        assert_eq!(span(&pair(0, 0), 1.0), None);
        assert_eq!(span(&pair(9, 8), 1.0), None);
    }
}
