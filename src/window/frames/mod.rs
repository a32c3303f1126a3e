//! `FrameTimes`, what a window takes of the program's own time and, paused, of the processor, for `open --measure`.

mod processor;

use std::sync::{Arc, Mutex};
use std::time::Duration;

use bevy::platform::time::Instant;
use bevy::prelude::*;
use bevy_egui::{EguiPostUpdateSet, EguiPrimaryContextPass};

use super::aside::Aside;
use super::session::gather;
use motion_lab_sim::simulation::{Playback, Transport};
use processor::{time_taken, time_waited};

/// Frames at the beginning that are not measured: pictures are painted for the first time in them.
const UNMEASURED: u32 = 30;

/// Time after the pause that is not measured: what was under way comes to rest.
const SETTLES: Duration = Duration::from_secs(5);

/// Least length of the measured pause. The system counts hundredths of a second, which are a 1000th of it.
const RESTS: Duration = Duration::from_secs(10);

/// What the frames of a window took.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct FrameTimes {
    /// The program's own time of each measured frame, in order: reading the run, laying out the widgets, turning all
    /// that is drawn into triangles. Ticks of the run are no part of it, nor is what the graphics driver does.
    pub own: Vec<Duration>,
    /// Of each of these frames how long it waited for a core that another thread held, such as one of a driver that
    /// draws without a graphics processor; empty where the system is not asked.
    pub waited: Vec<Duration>,
    /// Of each of these frames what its three pieces took: reading, laying out, triangles.
    pub pieces: Vec<[Duration; 3]>,
    /// The time of the clock that all measured frames took together.
    pub clock: Duration,
    /// The pause after them.
    pub paused: Option<Pause>,
}

/// What a window takes while its run is paused and nobody touches it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Pause {
    /// The length of the pause by the clock.
    pub clock: Duration,
    /// The processor's time in it, of all threads together; `None` where the system is not asked.
    pub processor: Option<Duration>,
}

impl Pause {
    /// The share of one core, 1 for all of it; `None` where the system is not asked.
    pub fn share(&self) -> Option<f64> {
        Some(self.processor?.as_secs_f64() / self.clock.as_secs_f64())
    }
}

impl FrameTimes {
    /// The own time that a `share` of the frames, from 0 to 1, does not exceed; none without frames.
    pub fn quantile(&self, share: f64) -> Option<Duration> {
        quantile(self.own.clone(), share)
    }

    /// What [`FrameTimes::quantile`] says, of the frames' own time without the wait for a core; none where the system
    /// is not asked.
    pub fn on_core(&self, share: f64) -> Option<Duration> {
        quantile(self.own.iter().zip(&self.waited).map(|(own, waited)| own.saturating_sub(*waited)).collect(), share)
    }

    /// What each piece takes in the median: reading, laying out, triangles; none without frames.
    pub fn medians(&self) -> Option<[Duration; 3]> {
        let median = |k: usize| quantile(self.pieces.iter().filter_map(|frame| frame.get(k).copied()).collect(), 0.5);
        Some([median(0)?, median(1)?, median(2)?])
    }

    /// Frames per second of the clock; none without frames.
    pub fn rate(&self) -> Option<f64> {
        (!self.own.is_empty()).then(|| self.own.len() as f64 / self.clock.as_secs_f64())
    }
}

/// The time that a `share` of these does not exceed.
fn quantile(mut times: Vec<Duration>, share: f64) -> Option<Duration> {
    times.sort_unstable();
    let last = times.len().checked_sub(1)?;
    times.get((share.clamp(0.0, 1.0) * last as f64).round() as usize).copied()
}

/// Measures a number of frames while the run plays, then a pause, and closes the window.
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
    frame: [Duration; 3],
    /// How long this thread had waited for a core when the piece began, and how long in this frame.
    waits: Option<Duration>,
    waited: Option<Duration>,
    times: FrameTimes,
    out: Arc<Mutex<FrameTimes>>,
    /// When the pause began, and the measured part of it with the processor's time before.
    paused: Option<Instant>,
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
            .add_systems(Update, (begin.before(gather), end::<0>.after(gather)))
            .add_systems(EguiPrimaryContextPass, end::<1>.after(super::show))
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
fn end<const PIECE: usize>(mut measuring: ResMut<Measuring>) {
    let took = measuring.piece.elapsed();
    measuring.frame[PIECE] += took;
    let waits = time_waited();
    let wait = waits.zip(measuring.waits).map(|(now, before)| now.saturating_sub(before));
    measuring.waited = measuring.waited.zip(wait).map(|(sum, wait)| sum + wait);
    measuring.waits = waits;
    // asking the system is no part of either piece
    measuring.piece = Instant::now();
}

fn frame_ended(
    mut measuring: ResMut<Measuring>,
    mut transport: ResMut<Transport>,
    aside: Res<Aside>,
    mut exits: MessageWriter<AppExit>,
) {
    let measuring = &mut *measuring;
    let took = std::mem::take(&mut measuring.frame);
    let waited = measuring.waited.replace(Duration::ZERO);
    if let Some(paused) = measuring.paused {
        if measuring.rest(paused, Instant::now(), time_taken()) {
            exits.write(AppExit::Success);
        }
        return;
    }
    if aside.is_under_way() {
        // what is opened is compared first
        return;
    }
    if transport.playback != Playback::Playing {
        transport.playback = Playback::Playing;
    }
    if measuring.unmeasured > 0 {
        measuring.unmeasured -= 1;
        measuring.began = Instant::now();
        return;
    }
    measuring.times.own.push(took.iter().sum());
    measuring.times.waited.extend(waited);
    measuring.times.pieces.push(took);
    measuring.left = measuring.left.saturating_sub(1);
    if measuring.left == 0 {
        measuring.times.clock = measuring.began.elapsed();
        measuring.paused = Some(Instant::now());
        transport.playback = Playback::Paused;
    }
}

impl Measuring {
    /// Goes on with the pause that began at `paused`. Returns whether it is over, and then gives the times out.
    fn rest(&mut self, paused: Instant, now: Instant, processor: Option<Duration>) -> bool {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quantile_is_a_time_that_was_measured() {
        let own = [5, 1, 4, 2, 3].map(Duration::from_millis).to_vec();
        let pieces = [[4, 1, 9], [2, 8, 3], [1, 7, 5]].map(|frame| frame.map(Duration::from_millis)).to_vec();
        let waited = [0, 0, 3, 0, 2].map(Duration::from_millis).to_vec();
        let times = FrameTimes { own, waited, pieces, clock: Duration::from_millis(100), paused: None };
        assert_eq!(times.medians(), Some([2, 7, 5].map(Duration::from_millis)));
        assert_eq!(FrameTimes::default().medians(), None);
        let at = |share| times.quantile(share).unwrap().as_millis();
        assert_eq!([at(0.0), at(0.5), at(0.95), at(1.0)], [1, 3, 5, 5]);
        assert_eq!([0.0, 0.5, 1.0].map(|share| times.on_core(share).unwrap().as_millis()), [1, 1, 5], "5 1 1 2 1");
        assert_eq!(FrameTimes { waited: vec![], ..times.clone() }.on_core(0.5), None, "not asked");
        assert_eq!(times.rate(), Some(50.0));
        assert_eq!((FrameTimes::default().quantile(0.5), FrameTimes::default().rate()), (None, None));
    }

    /// The app of a run that plays or is paused, in which `frames` are measured.
    fn measured(playback: Playback, frames: u32) -> (App, Arc<Mutex<FrameTimes>>) {
        let times = Arc::new(Mutex::new(FrameTimes::default()));
        let mut app = App::new();
        app.insert_resource(Transport { playback, ..Transport::new(motion_lab_core::random::Seed(1)) })
            .init_resource::<Aside>()
            .add_plugins(MeasurePlugin { frames, times: Arc::clone(&times) });
        (app, times)
    }

    #[test]
    fn the_pieces_of_a_frame_do_not_overlap() {
        let (mut app, _) = measured(Playback::Playing, 3);
        let pass = |world: &mut World| world.run_schedule(EguiPrimaryContextPass);
        let lay_out = || std::thread::sleep(Duration::from_millis(20));
        app.configure_sets(PostUpdate, (EguiPostUpdateSet::EndPass, EguiPostUpdateSet::ProcessOutput).chain())
            .add_systems(EguiPrimaryContextPass, lay_out.before(end::<1>))
            .add_systems(PostUpdate, pass.in_set(EguiPostUpdateSet::EndPass));
        (0..UNMEASURED + 3).for_each(|_| app.update());
        let measuring = app.world_mut().resource_mut::<Measuring>().into_inner();
        let times = &measuring.times;
        assert!(times.pieces.iter().all(|[_, laid_out, _]| *laid_out >= Duration::from_millis(20)), "{times:?}");
        let own: Duration = times.own.iter().sum();
        assert!(own <= times.clock, "{own:?} of {:?}", times.clock);
    }

    #[test]
    fn frames_are_measured_while_the_run_plays_and_the_pause_after_them() {
        let (mut app, times) = measured(Playback::Paused, 4);
        let playback = |app: &App| app.world().resource::<Transport>().playback;
        for _ in 0..UNMEASURED + 3 {
            app.update();
            assert_eq!(playback(&app), Playback::Playing);
        }
        app.update();
        assert_eq!((playback(&app), app.should_exit()), (Playback::Paused, None), "the pause is measured yet");
        let measuring = app.world_mut().resource_mut::<Measuring>().into_inner();
        assert_eq!((measuring.times.own.len(), measuring.times.pieces.len()), (4, 4));
        let start = measuring.paused.unwrap();
        let at = |millis| start + Duration::from_millis(millis);
        let taken = |millis| Some(Duration::from_millis(millis));
        // the first seconds, in which much is done, are no part of it; 60 ms in 12 s are
        assert!(!measuring.rest(start, at(500), taken(3_000)));
        assert!(!measuring.rest(start, at(5_000), taken(4_000)));
        assert!(!measuring.rest(start, at(14_500), taken(4_010)));
        assert!(measuring.rest(start, at(17_000), taken(4_060)));
        let pause = times.lock().unwrap().paused.unwrap();
        assert_eq!((pause.clock, pause.processor), (Duration::from_secs(12), Some(Duration::from_millis(60))));
        assert!((pause.share().unwrap() - 0.005).abs() < 1e-9);
        assert_eq!(times.lock().unwrap().own.len(), 4);
        assert_eq!(Pause { processor: None, ..pause }.share(), None);
    }
}
