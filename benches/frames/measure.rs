//! `MeasurePlugin`, which measures the frames of a window and closes it.

use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use bevy::prelude::*;
use bevy_egui::{EguiPostUpdateSet, EguiPrimaryContextPass};
use motion_lab::app::{LabSystems, is_busy};
use motion_lab::simulation::{Playback, Transport};

use super::processor::{time_taken, time_waited};
use super::times::{FrameTimes, Pause};

/// Frames at the beginning that are not measured: pictures are painted for the first time in them.
pub const UNMEASURED: u32 = 30;

/// Time after the pause that is not measured: what was under way comes to rest.
const SETTLES: Duration = Duration::from_secs(5);

/// Least length of the measured pause. The system counts hundredths of a second, which are a 1000th of it.
const RESTS: Duration = Duration::from_secs(10);

/// Measures a number of frames while the run plays, then a pause, and closes the window.
pub struct MeasurePlugin {
    /// The number of frames.
    pub frames: u32,
    /// Where the times are put at the end.
    pub times: Arc<Mutex<FrameTimes>>,
}

/// The measurement under way.
#[derive(Resource)]
pub struct Measuring {
    left: u32,
    unmeasured: u32,
    began: Instant,
    /// When the piece of work under way began, and what the pieces of this frame took.
    piece: Instant,
    frame: [Duration; 3],
    /// How long this thread had waited for a core when the piece began, and how long in this frame.
    waits: Option<Duration>,
    waited: Option<Duration>,
    /// The times so far.
    pub times: FrameTimes,
    out: Arc<Mutex<FrameTimes>>,
    /// When the pause began, and the measured part of it with the processor's time before.
    pub paused: Option<Instant>,
    rests: Option<(Instant, Option<Duration>)>,
}

impl Plugin for MeasurePlugin {
    fn build(&self, app: &mut App) {
        let now = Instant::now();
        let measuring = Measuring {
            left: self.frames,
            unmeasured: UNMEASURED,
            began: now,
            piece: now,
            frame: [Duration::ZERO; 3],
            waits: None,
            waited: Some(Duration::ZERO),
            times: FrameTimes::default(),
            out: Arc::clone(&self.times),
            paused: None,
            rests: None,
        };
        // egui's pass, in which the widgets are laid out, runs within the set `EndPass`
        app.insert_resource(measuring)
            .add_systems(Update, (begin.before(LabSystems::Read), end::<0>.after(LabSystems::Read)))
            .add_systems(EguiPrimaryContextPass, end::<1>.after(LabSystems::LayOut))
            .add_systems(
                PostUpdate,
                (begin.before(EguiPostUpdateSet::EndPass), end::<2>.after(EguiPostUpdateSet::ProcessOutput)),
            )
            .add_systems(Last, frame_ended);
    }
}

fn begin(mut measuring: ResMut<Measuring>) {
    measuring.waits = time_waited();
    measuring.piece = Instant::now();
}

/// Ends a piece of work, and begins the next.
pub fn end<const PIECE: usize>(mut measuring: ResMut<Measuring>) {
    let took = measuring.piece.elapsed();
    measuring.frame[PIECE] += took;
    let waits = time_waited();
    let wait = waits.zip(measuring.waits).map(|(now, before)| now.saturating_sub(before));
    measuring.waited = measuring.waited.zip(wait).map(|(sum, wait)| sum + wait);
    measuring.waits = waits;
    // asking the system is no part of either piece
    measuring.piece = Instant::now();
}

fn frame_ended(world: &mut World) {
    let is_busy = is_busy(world);
    world.resource_scope(|world, mut measuring: Mut<Measuring>| {
        if measuring.end_frame(&mut world.resource_mut::<Transport>(), is_busy) {
            world.write_message(AppExit::Success);
        }
    });
}

impl Measuring {
    /// Ends a frame of a run; nothing is measured while other work `is_busy`. Returns whether all is measured.
    fn end_frame(&mut self, transport: &mut Transport, is_busy: bool) -> bool {
        let took = std::mem::take(&mut self.frame);
        let waited = self.waited.replace(Duration::ZERO);
        if let Some(paused) = self.paused {
            return self.rest(paused, Instant::now(), time_taken());
        }
        if is_busy {
            // what is opened is compared first
            return false;
        }
        if transport.playback != Playback::Playing {
            transport.playback = Playback::Playing;
        }
        if self.unmeasured > 0 {
            self.unmeasured -= 1;
            self.began = Instant::now();
            return false;
        }
        self.times.own.push(took.iter().sum());
        self.times.waited.extend(waited);
        self.times.pieces.push(took);
        self.left = self.left.saturating_sub(1);
        if self.left == 0 {
            self.times.clock = self.began.elapsed();
            self.paused = Some(Instant::now());
            transport.playback = Playback::Paused;
        }
        false
    }

    /// Goes on with the pause that began at `paused`. Returns whether it is over, and then gives the times out.
    pub fn rest(&mut self, paused: Instant, now: Instant, processor: Option<Duration>) -> bool {
        let Some((began, before)) = self.rests else {
            if now - paused >= SETTLES {
                self.rests = Some((now, processor));
            }
            return false;
        };
        let clock = now - began;
        if clock < RESTS {
            return false;
        }
        let processor = processor.zip(before).map(|(now, before)| now.saturating_sub(before));
        self.times.paused = Some(Pause { clock, processor });
        if let Ok(mut out) = self.out.lock() {
            *out = std::mem::take(&mut self.times);
        }
        true
    }
}
