//! `FrameTimes`, what the frames of a window take of the program's own time, measured for `open --measure`.

use std::sync::{Arc, Mutex};
use std::time::Duration;

use bevy::platform::time::Instant;
use bevy::prelude::*;
use bevy_egui::{EguiPostUpdateSet, EguiPrimaryContextPass};

use super::session::gather;

/// Frames at the beginning that are not measured: pictures are painted for the first time in them.
const UNMEASURED: u32 = 30;

/// What the frames of a window took.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct FrameTimes {
    /// The program's own time of each measured frame, in order: reading the run, laying out the widgets, turning all
    /// that is drawn into triangles. Ticks of the run are no part of it, nor is what the graphics driver does.
    pub own: Vec<Duration>,
    /// The time of the clock that all measured frames took together.
    pub clock: Duration,
}

impl FrameTimes {
    /// The own time that a `share` of the frames, from 0 to 1, does not exceed; none without frames.
    pub fn quantile(&self, share: f64) -> Option<Duration> {
        let mut sorted = self.own.clone();
        sorted.sort_unstable();
        let last = sorted.len().checked_sub(1)?;
        sorted.get((share.clamp(0.0, 1.0) * last as f64).round() as usize).copied()
    }

    /// Frames per second of the clock; none without frames.
    pub fn rate(&self) -> Option<f64> {
        (!self.own.is_empty()).then(|| self.own.len() as f64 / self.clock.as_secs_f64())
    }
}

/// Measures a number of frames and then closes the window.
pub struct MeasurePlugin {
    /// The number of frames.
    pub frames: u32,
    /// Where the times are put at the end.
    pub times: Arc<Mutex<FrameTimes>>,
}

/// The measurement under way.
#[derive(Resource)]
struct Measuring {
    left: u32,
    unmeasured: u32,
    began: Instant,
    /// When the piece of work under way began, and what the pieces of this frame took.
    piece: Instant,
    frame: Duration,
    times: FrameTimes,
    out: Arc<Mutex<FrameTimes>>,
}

impl Plugin for MeasurePlugin {
    fn build(&self, app: &mut App) {
        let now = Instant::now();
        let measuring = Measuring {
            left: self.frames,
            unmeasured: UNMEASURED,
            began: now,
            piece: now,
            frame: Duration::ZERO,
            times: FrameTimes::default(),
            out: Arc::clone(&self.times),
        };
        app.insert_resource(measuring)
            .add_systems(Update, (begin.before(gather), end.after(gather)))
            .add_systems(EguiPrimaryContextPass, (begin.before(super::show), end.after(super::show)))
            .add_systems(
                PostUpdate,
                (begin.before(EguiPostUpdateSet::EndPass), end.after(EguiPostUpdateSet::ProcessOutput)),
            )
            .add_systems(Last, frame_ended);
    }
}

fn begin(mut measuring: ResMut<Measuring>) {
    measuring.piece = Instant::now();
}

fn end(mut measuring: ResMut<Measuring>) {
    let took = measuring.piece.elapsed();
    measuring.frame += took;
}

fn frame_ended(mut measuring: ResMut<Measuring>, mut exits: MessageWriter<AppExit>) {
    let measuring = &mut *measuring;
    let took = std::mem::take(&mut measuring.frame);
    if measuring.unmeasured > 0 {
        measuring.unmeasured -= 1;
        measuring.began = Instant::now();
        return;
    }
    measuring.times.own.push(took);
    measuring.left = measuring.left.saturating_sub(1);
    if measuring.left == 0 {
        measuring.times.clock = measuring.began.elapsed();
        if let Ok(mut out) = measuring.out.lock() {
            *out = std::mem::take(&mut measuring.times);
        }
        exits.write(AppExit::Success);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quantile_is_a_time_that_was_measured() {
        let own = [5, 1, 4, 2, 3].map(Duration::from_millis).to_vec();
        let times = FrameTimes { own, clock: Duration::from_millis(100) };
        let at = |share| times.quantile(share).unwrap().as_millis();
        assert_eq!([at(0.0), at(0.5), at(0.95), at(1.0)], [1, 3, 5, 5]);
        assert_eq!(times.rate(), Some(50.0));
        assert_eq!((FrameTimes::default().quantile(0.5), FrameTimes::default().rate()), (None, None));
    }
}
