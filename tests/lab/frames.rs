//! The measurement of a window's frames, `benches/frames`.

#[path = "../../benches/frames/measure.rs"]
mod measure;
#[path = "../../benches/frames/processor.rs"]
mod processor;
#[path = "../../benches/frames/times.rs"]
mod times;

use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use bevy::prelude::*;
use bevy_egui::{EguiPostUpdateSet, EguiPrimaryContextPass};
use motion_lab::simulation::{Playback, Transport, headless_app};

use measure::{MeasurePlugin, Measuring, UNMEASURED, end};
use processor::{ticks, ticks_a_second, time_taken, time_waited, waited};
use times::{FrameTimes, Pause, words};

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

#[test]
fn the_words_say_frames_own_time_and_the_share_of_a_core() {
    let own = [2, 1, 9].map(Duration::from_millis).to_vec();
    let mut times = FrameTimes { own, clock: Duration::from_millis(50), ..FrameTimes::default() };
    let played = "3 frames, 60.0 a second; own time 2.00 ms in the median, 9.00 ms in 95 of 100";
    assert_eq!(words(&times), played, "closed before the pause");
    times.waited = [1, 0, 2].map(Duration::from_millis).to_vec();
    let played = format!("{played}\nwithout the wait for a core that others held: 1.00 ms, 7.00 ms in 95 of 100");
    assert_eq!(words(&times), played);
    times.pieces = vec![[0.25, 1.0, 0.75].map(Duration::from_secs_f64).map(|time| time / 1000)];
    let played = format!("{played}\nof it, in the median: reading the run 0.25, laying out 1.00, triangles 0.75");
    assert_eq!(words(&times), played);
    let mut pause = Pause::default();
    (pause.clock, pause.processor) = (Duration::from_secs(5), Some(Duration::from_millis(40)));
    times.paused = Some(pause);
    assert_eq!(words(&times), format!("{played}\npaused for 5.0 s: 0.8 % of a core"));
    times.paused = Some({
        pause.processor = None;
        pause
    });
    assert_eq!(words(&times), format!("{played}\npaused for 5.0 s: the share of a core is not known here"));
}

#[test]
fn both_times_are_read_whatever_the_program_is_called() {
    let line = "7 (a ) b (c) S 1 7 7 0 -1 4194304 100 0 3 0 1234 66 9 8 20 0 1 0 5 1 1";
    assert_eq!(ticks(line), Some(1300), "user and kernel, and not those of children");
    assert_eq!((ticks("7 (a"), ticks("7 (a) S 1 7")), (None, None));
    let vector: Vec<u8> = [6, 4096, 17, 250, 0, 0].iter().flat_map(|w: &usize| w.to_ne_bytes()).collect();
    assert_eq!((ticks_a_second(&vector), ticks_a_second(&vector[..16])), (Some(250), None));
}

#[test]
fn a_wait_is_the_second_number_and_what_sleeps_does_not_wait() {
    assert_eq!(waited("655330 1200 31\n"), Some(Duration::from_nanos(1200)));
    assert_eq!((waited("655330"), waited("a b c")), (None, None));
    let (before, start) = (time_waited().unwrap(), Instant::now());
    std::thread::sleep(Duration::from_millis(300));
    let waited = time_waited().unwrap() - before;
    assert!(waited + Duration::from_millis(290) <= start.elapsed(), "{waited:?} of {:?}", start.elapsed());
}

#[test]
fn more_threads_than_cores_wait() {
    let cores = std::thread::available_parallelism().unwrap().get();
    let work = || {
        let (before, start) = (time_waited().unwrap(), Instant::now());
        let mut sum = 0u64;
        while start.elapsed() < Duration::from_millis(300) {
            sum = std::hint::black_box(sum.wrapping_add(1));
        }
        time_waited().unwrap() - before
    };
    let threads: Vec<_> = (0..4 * cores).map(|_| std::thread::spawn(work)).collect();
    let waited: Duration = threads.into_iter().map(|thread| thread.join().unwrap()).sum();
    // four times as many threads as cores wait for three quarters of their time, and run for one at most
    let whole = Duration::from_millis(300) * 4 * cores as u32;
    assert!(waited >= whole / 3, "{waited:?} of {whole:?}");
}

#[test]
fn work_takes_time_and_sleep_takes_none() {
    // other tests of this process work too, so only a lower bound is certain
    let (before, start) = (time_taken().unwrap(), Instant::now());
    let mut sum = 0u64;
    while start.elapsed() < Duration::from_millis(400) {
        sum = std::hint::black_box(sum.wrapping_add(1));
    }
    let took = time_taken().unwrap() - before;
    assert!(took >= Duration::from_millis(100), "{took:?}");
    assert!(time_taken().unwrap() < Duration::from_secs(1_000_000));
}

/// The app of a run that plays or is paused, in which `frames` are measured.
fn measured(playback: Playback, frames: u32) -> (App, Arc<Mutex<FrameTimes>>) {
    let times = Arc::new(Mutex::new(FrameTimes::default()));
    // the transport of an app that simulates
    let mut transport = headless_app().world_mut().remove_resource::<Transport>().unwrap();
    transport.playback = playback;
    let mut app = App::new();
    app.insert_resource(transport).add_plugins(MeasurePlugin { frames, times: Arc::clone(&times) });
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
