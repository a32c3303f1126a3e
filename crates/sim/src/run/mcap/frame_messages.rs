//! `FrameMessages`, the messages of a log with frames, tick by tick.

use super::message::{DigestMessage, FrameMessage, InputMessage, ScanMessage};
use super::preamble::Preamble;
use super::record_writer::RecordWriter;
use super::{FORMAT_VERSION_WITH_MANY_CHANGES, LogError, channel};
use crate::run::{Frame, ObstacleStates, Script};

/// Makes the messages of frames and inputs. Once its buffers have grown, a tick allocates nothing.
#[derive(Default)]
pub struct FrameMessages {
    next_event: usize,
    next_change: usize,
    /// The greatest range of each scan of the initial frame, as far as the configuration says.
    max_ranges: Vec<Option<f64>>,
    /// The greatest range of any other scan.
    max_range: Option<f64>,
    frame: FrameMessage,
    scan: ScanMessage,
    digest: DigestMessage,
    /// Whether a frame's message has the obstacles that are not as in the frame before, not all.
    is_by_difference: bool,
    /// The obstacles of the last frame.
    obstacles: ObstacleStates,
    encoding: Vec<u8>,
    content: Vec<u8>,
}

impl FrameMessages {
    /// Those of a run at its start.
    pub fn new(preamble: &Preamble) -> Self {
        let max_range = preamble.recipe.config.sensor.map(|sensor| sensor.max_range);
        let is_by_difference = preamble.format == FORMAT_VERSION_WITH_MANY_CHANGES;
        FrameMessages { max_ranges: preamble.max_ranges(), max_range, is_by_difference, ..FrameMessages::default() }
    }

    /// The obstacles of the last frame.
    pub fn obstacles(&self) -> &ObstacleStates {
        &self.obstacles
    }

    /// Writes the inputs of the script up to `tick` that are not written yet.
    pub fn put_inputs(&mut self, records: &mut RecordWriter, script: &Script, tick: u64) -> Result<(), LogError> {
        while let Some(change) = script.changes.get(self.next_change).filter(|change| change.tick <= tick) {
            records.message(channel::INPUT, tick, &InputMessage::of_change(change), &mut self.content)?;
            self.next_change += 1;
        }
        while let Some(event) = script.events.get(self.next_event).filter(|event| event.tick <= tick) {
            records.message(channel::INPUT, tick, &InputMessage::of(event), &mut self.content)?;
            self.next_event += 1;
        }
        Ok(())
    }

    /// Writes a frame, its scans and its digest.
    pub fn put(&mut self, records: &mut RecordWriter, frame: &Frame) -> Result<(), LogError> {
        let tick = frame.tick;
        self.frame.take(frame, self.is_by_difference.then_some(&self.obstacles));
        self.obstacles.clone_from(&frame.obstacles);
        records.message(channel::FRAME, tick, &self.frame, &mut self.content)?;
        for (i, scan) in frame.scans.iter().enumerate() {
            self.scan.take(tick, self.max_ranges.get(i).copied().unwrap_or(self.max_range), scan);
            records.message(channel::SCAN, tick, &self.scan, &mut self.content)?;
        }
        self.digest.take(tick, frame.digest_in(&mut self.encoding));
        records.message(channel::DIGEST, tick, &self.digest, &mut self.content)
    }
}
