//! `Keyframes`, the frames of a run that are kept to go back to.

use std::collections::BTreeMap;
use std::mem::size_of;

use bevy::prelude::*;

use crate::run::{Frame, ObstacleStates, RobotState};

/// Largest number of keyframes; beyond it every second one is dropped.
const MAX_KEYFRAMES: usize = 1024;

/// Largest size of all keyframes together, bytes; beyond it every second one is dropped.
const BUDGET: usize = 112_000_000;

/// The run's keyframes, so that a seek need not begin at tick 0. They hold no scans, which
/// [`restore`](crate::simulation::restore) takes anew.
///
/// Their number and their size are bounded: beyond 1024, or beyond 112 MB, every second one is dropped, so in long runs
/// and with many robots they lie farther apart. The frame of tick 0 always stays.
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct Keyframes {
    every: u64,
    frames: BTreeMap<u64, Frame>,
    /// The size of the frames, as [`size_of_frame`] estimates it.
    bytes: usize,
    budget: usize,
}

impl Default for Keyframes {
    fn default() -> Self {
        Keyframes::every(100)
    }
}

/// The memory that a frame without scans takes, bytes: its lists, and its share of the map's nodes, which may be no
/// more than half full.
fn size_of_frame(frame: &Frame) -> usize {
    size_of_lists(frame, &ObstacleStates::new()) + 3 * size_of::<(u64, Frame)>()
}

/// The memory that the lists of a frame take, but for its scans, bytes: with what lies on the heap beyond them, and
/// without what its obstacles share with those of another frame.
pub(crate) fn size_of_lists(frame: &Frame, shared: &ObstacleStates) -> usize {
    // lists of up to four numbers need no heap
    let heap = |list: &[f64]| if list.len() > 4 { size_of_val(list) } else { 0 };
    let beyond = |r: &RobotState| heap(&r.configuration) + heap(&r.extra) + heap(&r.target);
    let robots = frame.robots.len() * size_of::<RobotState>() + frame.robots.iter().map(beyond).sum::<usize>();
    robots + frame.obstacles.bytes_beyond(shared)
}

impl Keyframes {
    /// No frames yet; one will be kept every `every` ticks, at least every tick.
    pub fn every(every: u64) -> Self {
        let every = if every == 0 { 1 } else { every };
        Keyframes { every, frames: BTreeMap::new(), bytes: 0, budget: BUDGET }
    }

    /// The same, with at most `bytes` bytes of frames. The frame of tick 0 is kept in any case.
    #[must_use]
    pub fn within(self, bytes: usize) -> Self {
        Keyframes { budget: bytes, ..self }
    }

    /// Bounds the size of the frames to `bytes` from now on; those that are too many are dropped.
    pub(crate) fn set_budget(&mut self, bytes: usize) {
        self.budget = bytes;
        while self.bytes > bytes && self.frames.len() > 1 {
            self.thin();
        }
    }

    /// The last frame kept at or before `tick`. Its list of scans is empty.
    pub fn before(&self, tick: u64) -> Option<&Frame> {
        self.frames.range(..=tick).next_back().map(|(_, f)| f)
    }

    /// The memory that the frames take, bytes: an estimate from the lengths of their lists, rather too high.
    pub fn bytes(&self) -> usize {
        self.bytes
    }

    /// Keeps the frame if its tick is one of those that are kept.
    pub(crate) fn keep(&mut self, frame: &Frame) {
        if !frame.tick.is_multiple_of(self.every) {
            return;
        }
        if let Some(old) = self.frames.remove(&frame.tick) {
            self.bytes -= size_of_frame(&old);
        }
        let size = size_of_frame(frame);
        let has_room =
            |kept: &Self| kept.frames.len() < MAX_KEYFRAMES && kept.bytes.saturating_add(size) <= kept.budget;
        while !has_room(self) && self.frames.len() > 1 {
            self.thin();
        }
        if frame.tick == 0 || (has_room(self) && frame.tick.is_multiple_of(self.every)) {
            let Frame { tick, robots, obstacles, .. } = frame;
            let kept = Frame { tick: *tick, robots: robots.clone(), scans: Vec::new(), obstacles: obstacles.clone() };
            self.frames.insert(*tick, kept);
            self.bytes += size;
        }
    }

    /// Drops every second frame.
    fn thin(&mut self) {
        self.every = self.every.saturating_mul(2);
        self.retain(|tick, every| tick.is_multiple_of(every));
    }

    /// Forgets all frames and keeps the bounds.
    pub(crate) fn clear(&mut self) {
        self.retain(|_, _| false);
    }

    /// Forgets every frame after `tick`.
    pub(crate) fn truncate_after(&mut self, tick: u64) {
        self.retain(|kept, _| kept <= tick);
    }

    /// Keeps the frames of the ticks that `keep` says, by the tick and the present distance.
    fn retain(&mut self, keep: impl Fn(u64, u64) -> bool) {
        let (every, mut bytes) = (self.every, self.bytes);
        self.frames.retain(|tick, frame| {
            let stays = keep(*tick, every);
            bytes -= if stays { 0 } else { size_of_frame(frame) };
            stays
        });
        self.bytes = bytes;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::RobotScan;
    use motion_lab_core::configuration::Coordinates;

    fn frame(tick: u64, robots: usize) -> Frame {
        let state = |id| RobotState {
            id: id as u32,
            configuration: Coordinates::from_slice(&[tick as f64, 0.0, 0.0]),
            extra: [0.0; 3].into_iter().collect(),
            channels: [0; 2],
            target: Coordinates::new(),
            manual: false,
            in_contact: false,
            contacts: 0,
            flash: 0,
            refusals: 0,
        };
        let scans = vec![RobotScan { robot: 0, ranges: vec![1.0; 360].into() }];
        Frame { tick, robots: (0..robots).map(state).collect(), scans, obstacles: ObstacleStates::new() }
    }

    fn kept(keyframes: &Keyframes) -> Vec<u64> {
        keyframes.frames.keys().copied().collect()
    }

    #[test]
    fn small_runs_keep_what_they_kept_and_no_scans() {
        let mut keyframes = Keyframes::default();
        for tick in 0..=102_400 {
            keyframes.keep(&frame(tick, 3));
            match tick {
                102_300 => assert_eq!(kept(&keyframes), (0..1024).map(|k| 100 * k).collect::<Vec<_>>()),
                102_400 => assert_eq!(kept(&keyframes), (0..=512).map(|k| 200 * k).collect::<Vec<_>>()),
                _ => {}
            }
        }
        assert_eq!(keyframes.before(399).unwrap(), &Frame { scans: vec![], ..frame(200, 3) });
        keyframes.truncate_after(400);
        assert_eq!(kept(&keyframes), [0, 200, 400]);
        assert_eq!(keyframes.bytes(), 3 * size_of_frame(&frame(0, 3)));
        // a frame that comes again replaces the one that was kept
        keyframes.keep(&frame(400, 2));
        assert_eq!(keyframes.before(400).unwrap().robots.len(), 2);
        assert_eq!(keyframes.bytes(), 2 * size_of_frame(&frame(0, 3)) + size_of_frame(&frame(0, 2)));
    }

    #[test]
    fn a_budget_thins_by_halves_and_leaves_tick_0() {
        let size = size_of_frame(&frame(0, 50));
        let mut keyframes = Keyframes::every(10).within(5 * size);
        let mut largest = 0;
        for tick in 0..=1000 {
            keyframes.keep(&frame(tick, 50));
            assert!(keyframes.bytes() <= 5 * size && keyframes.bytes() == keyframes.frames.len() * size);
            largest = if keyframes.frames.len() > largest { keyframes.frames.len() } else { largest };
            match tick {
                40 => assert_eq!(kept(&keyframes), [0, 10, 20, 30, 40]),
                50 => assert_eq!(kept(&keyframes), [0, 20, 40], "at the sixth every second one goes"),
                1000 => assert_eq!(kept(&keyframes), [0, 320, 640, 960]),
                _ => {}
            }
        }
        assert_eq!(largest, 5);
        let mut narrow = Keyframes::every(1).within(1);
        (0..100).for_each(|tick| narrow.keep(&frame(tick, 50)));
        assert_eq!(kept(&narrow), [0]);
    }
}
