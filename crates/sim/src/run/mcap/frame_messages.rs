//! `FrameMessages`, the messages of a log with frames, tick by tick.

use super::message::{DigestMessage, FrameMessage, InputMessage, ScanMessage};
use super::preamble::Preamble;
use super::record_writer::RecordWriter;
use super::{LogError, channel};
use crate::run::{Frame, Script};

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
    encoding: Vec<u8>,
    content: Vec<u8>,
}

impl FrameMessages {
    /// Those of a run at its start.
    pub fn new(preamble: &Preamble) -> Self {
        let max_range = preamble.recipe.config.sensor.map(|sensor| sensor.max_range);
        FrameMessages { max_ranges: preamble.max_ranges(), max_range, ..FrameMessages::default() }
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
        self.frame.take(frame);
        records.message(channel::FRAME, tick, &self.frame, &mut self.content)?;
        for (i, scan) in frame.scans.iter().enumerate() {
            self.scan.take(tick, self.max_ranges.get(i).copied().unwrap_or(self.max_range), scan);
            records.message(channel::SCAN, tick, &self.scan, &mut self.content)?;
        }
        self.digest.take(tick, frame.digest_in(&mut self.encoding));
        records.message(channel::DIGEST, tick, &self.digest, &mut self.content)
    }
}
