//! `FrameList`, the frames of a run in memory.

use crate::run::{Frame, ObstacleStates};
use crate::simulation::size_of_lists;

/// Largest size of the frames of a run that are kept in memory, bytes: that of the largest log file that is read.
pub const MAX_FRAME_BYTES: u64 = 4 << 30;

/// Frames that take more memory than [`MAX_FRAME_BYTES`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the frames of {ticks} ticks, of {bytes} bytes each, take more than the {MAX_FRAME_BYTES} bytes that are kept in \
     memory: keep a digest of each second, or write the log tick by tick"
)]
#[non_exhaustive]
pub struct FramesError {
    /// The number of ticks.
    pub ticks: u64,
    /// The memory that a frame takes, bytes.
    pub bytes: u64,
}

/// The frames of a run that are kept in memory, of [`MAX_FRAME_BYTES`] at most. A [`LogWriter`](crate::run::LogWriter)
/// writes a run of any length as it goes on, and a log of digests keeps 8 bytes a second.
#[derive(Clone, Debug)]
pub struct FrameList {
    frames: Vec<Frame>,
    bytes: u64,
    most: u64,
}

impl FrameList {
    /// Room for the frames of this many ticks of a run whose first is like `frame`.
    ///
    /// # Errors
    /// [`FramesError`] where they would not fit.
    pub fn try_new(frame: &Frame, ticks: u64) -> Result<Self, FramesError> {
        Self::within(MAX_FRAME_BYTES, frame, ticks)
    }

    fn within(most: u64, frame: &Frame, ticks: u64) -> Result<Self, FramesError> {
        // they share their obstacles until these change
        let bytes = size_of(frame, &frame.obstacles);
        match bytes.checked_mul(ticks) {
            Some(all) if all <= most => Ok(FrameList { frames: Vec::new(), bytes: 0, most }),
            _ => Err(FramesError { ticks, bytes }),
        }
    }

    /// Keeps the next frame.
    ///
    /// # Errors
    /// [`FramesError`], with nothing kept, where frames have grown so that they don't fit.
    pub fn push(&mut self, frame: &Frame) -> Result<(), FramesError> {
        let none = ObstacleStates::new();
        let bytes = size_of(frame, self.frames.last().map_or(&none, |last| &last.obstacles));
        if self.bytes.saturating_add(bytes) > self.most {
            return Err(FramesError { ticks: frame.tick, bytes });
        }
        self.bytes += bytes;
        self.frames.push(frame.clone());
        Ok(())
    }

    /// The frames.
    pub fn into_frames(self) -> Vec<Frame> {
        self.frames
    }
}

/// The memory that a frame takes, bytes, without what its obstacles share with those of the frame before.
fn size_of(frame: &Frame, before: &ObstacleStates) -> u64 {
    let scans: usize = frame.scans.iter().map(|scan| size_of_val(scan) + size_of_val(&*scan.ranges)).sum();
    (std::mem::size_of::<Frame>() + size_of_lists(frame, before) + scans) as u64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::fixture;

    #[test]
    fn as_many_frames_are_kept_as_fit_and_one_more_is_refused() {
        let frame = fixture::frame(1);
        let one = size_of(&frame, &frame.obstacles);
        // three ranges of 8 bytes and two robots, each with three lists of numbers, of a kilobyte at most
        assert!((24 + 2 * 3 * 8..24 + 2 * 1024).contains(&one), "{one} bytes");
        assert!(FrameList::within(4 * one, &frame, 4).is_ok());
        let refused = FrameList::within(4 * one, &frame, 5).map(FrameList::into_frames);
        assert_eq!(refused, Err(FramesError { ticks: 5, bytes: one }));
        assert!(FrameList::try_new(&frame, u64::MAX).is_err());
        let mut kept = FrameList::within(2 * one, &frame, 2).unwrap();
        kept.push(&frame).unwrap();
        let mut grown = fixture::frame(2);
        grown.scans[0].ranges = vec![0.0; 4].into();
        assert_eq!(kept.push(&grown), Err(FramesError { ticks: 2, bytes: one + 8 }));
        kept.push(&fixture::frame(2)).unwrap();
        assert_eq!(kept.into_frames(), [frame, fixture::frame(2)]);
    }
}
