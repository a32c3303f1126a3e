//! Keyframes: runs taken back, branched, undone and redone about them, thinned runs, and runs of more than a hundred
//! thousand ticks.

use std::time::Duration;

use bevy::app::App;
use bevy::prelude::MinimalPlugins;
use bevy::time::TimeUpdateStrategy;
use motion_lab_core::num::{sin, tan, wrap};
use motion_lab_core::prelude::*;
use motion_lab_core::random::DRAWS_PER_INDEX;
use motion_lab_sim::recording::{Recorder, Run};
use motion_lab_sim::run::{Event, Frame, Log, LogKind, LogWriter, Recipe, RobotInput};
use motion_lab_sim::simulation::{
    History, HistoryPlugin, Keyframes, LatestFrame, PendingInput, RobotCommand, RunCommand, SimulationPlugin,
    Transport, TransportCommand, Undo, restore, start_run, step,
};
use motion_lab_sim::tour::TourConfig;

use crate::runs::controls::{driven, open};
use crate::simulator::{assert_same, event, script};

const SEED: Seed = Seed(7);

/// A car that pulls its trailer, and a rover whose wheels slip in a world of its own.
fn config(ticks: u64) -> TourConfig {
    let car = open("the car's", &[("car", "hitch", &[0.0, 0.0, 0.5, 0.5])]);
    let rover = open("the rover's", &[("rover", "rusty", &[0.0, 0.0, 1.0])]);
    TourConfig { worlds: vec![car, rover], ticks, sensor: None }
}

/// The script of both robots without a branch.
fn inputs() -> Vec<Event> {
    vec![
        event(1, "car", RobotInput::Drive(96, 40)),
        event(1, "rover", RobotInput::Drive(100, -30)),
        event(150, "car", RobotInput::Drive(-64, 20)),
        event(260, "rover", RobotInput::Drive(-128, 64)),
    ]
}

/// The car's input at the branch.
const OTHERWISE: RobotInput = RobotInput::Drive(-128, -77);

/// The script up to tick `k`, and another input after it.
fn other_inputs_after(k: u64) -> Vec<Event> {
    let mut events = inputs();
    events.retain(|e| e.tick <= k);
    events.push(event(k + 1, "car", OTHERWISE));
    events
}

/// The frames of a run that was never taken back; the frame of tick k is at index k.
fn fresh(events: Vec<Event>, ticks: u64) -> Vec<Frame> {
    let log = Run::record(config(ticks), (SEED, script(events))).unwrap();
    log.initial().into_iter().chain(log.frames()).cloned().collect()
}

/// A run at tick 0, paused, in an app whose clock stands still.
fn app(config: TourConfig, events: Vec<Event>, history: bool) -> App {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, SimulationPlugin));
    if history {
        app.add_plugins(HistoryPlugin);
    }
    start_run(app.world_mut(), config, (SEED, script(events))).unwrap();
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::ZERO));
    app
}

fn send(app: &mut App, command: TransportCommand) {
    app.world_mut().write_message(RunCommand::from(command));
    app.update();
}

fn drive(app: &mut App, robot: &str, input: RobotInput) {
    app.world_mut().write_message(RunCommand::from(RobotCommand { robot: robot.into(), input }));
    app.update();
}

fn frame(app: &App) -> &Frame {
    app.world().resource::<LatestFrame>().frame()
}

fn inputs_of(app: &App) -> &[Event] {
    &app.world().resource::<PendingInput>().script().events
}

/// Goes to these ticks, one after the other, and checks that each frame is that of `run`.
#[track_caller]
fn assert_is(app: &mut App, run: &[Frame], ticks: &[u64]) {
    for &tick in ticks {
        send(app, TransportCommand::Seek(tick));
        assert_same(frame(app), &run[tick as usize]);
    }
}

/// The ticks whose frames are kept.
fn kept(app: &App) -> Vec<u64> {
    let keyframes = app.world().resource::<Keyframes>();
    let before = |f: &&Frame| keyframes.before(f.tick.checked_sub(1)?);
    let mut ticks: Vec<u64> = std::iter::successors(keyframes.before(u64::MAX), before).map(|f| f.tick).collect();
    ticks.reverse();
    ticks
}

#[test]
fn a_branch_before_at_and_after_a_keyframe_is_the_run_of_its_script() {
    let run = fresh(inputs(), 320);
    // the run goes back by a seek or from a frame, and from a tick far ahead or the next one
    for (k, end) in [(99, 320), (100, 320), (101, 320), (199, 200), (199, 320), (200, 320), (201, 320), (299, 300)] {
        for restored in [false, true] {
            let mut app = app(config(end), inputs(), false);
            send(&mut app, TransportCommand::Seek(end));
            assert_eq!(kept(&app).last(), Some(&(end / 100 * 100)), "there is something to forget");
            if restored {
                restore(app.world_mut(), &run[k as usize]).unwrap();
            } else {
                send(&mut app, TransportCommand::Seek(k));
            }
            assert_same(frame(&app), &run[k as usize]);
            drive(&mut app, "car", OTHERWISE);
            assert!(kept(&app).iter().all(|tick| *tick <= k), "{:?} are kept of a branch at {k}", kept(&app));
            assert_eq!(inputs_of(&app), other_inputs_after(k));
            let branch = fresh(other_inputs_after(k), end);
            // straight to the end first, which would use keyframes ahead of the branch, were any kept
            let others = [k + 1, 100, 200, 300, k, 99, 201];
            assert_is(&mut app, &branch, &[end]);
            assert_is(&mut app, &branch, &others.map(|tick| if tick <= end { tick } else { end }));
            assert_ne!(branch[end as usize], run[end as usize]);
        }
    }
}

#[test]
fn a_frame_put_back_about_a_keyframe_is_followed_by_what_followed_it() {
    let run = fresh(inputs(), 320);
    let mut app = app(config(320), inputs(), false);
    for k in [320, 98, 99, 100, 101, 201, 200, 199, 1, 0, 300] {
        restore(app.world_mut(), &run[k]).unwrap();
        for after in &run[k..run.len().min(k + 4)] {
            assert_same(frame(&app), after);
            step(app.world_mut());
        }
    }
    assert_is(&mut app, &run, &[0, 320, 99, 100, 101, 320, 201, 200, 199]);
}

#[test]
fn what_is_undone_and_done_again_is_the_run_of_its_script_at_every_tick() {
    let (first, second) = (fresh(inputs(), 330), fresh(other_inputs_after(120), 330));
    let mut app = app(config(330), inputs(), true);
    assert_is(&mut app, &first, &[330, 120]);
    app.world_mut().write_message(RunCommand::from(TransportCommand::Checkpoint));
    drive(&mut app, "car", OTHERWISE);
    assert_is(&mut app, &second, &[330]);

    let ticks = [330, 301, 300, 299, 200, 121, 120, 100, 330];
    for (command, run, events, stands_at) in [
        (TransportCommand::Undo, &first, inputs(), 120),
        (TransportCommand::Redo, &second, other_inputs_after(120), 330),
        (TransportCommand::Undo, &first, inputs(), 330),
    ] {
        send(&mut app, command);
        let transport = app.world().resource::<Transport>();
        let (tick, frontier) = (transport.tick(), transport.frontier());
        assert_eq!((tick, frontier), (stands_at, 330), "{command:?}");
        assert_eq!(inputs_of(&app), events, "{command:?}");
        // the history of the ticks ahead and behind is of this run too
        let history = app.world().resource::<History>();
        for tick in ticks {
            let known = &history.at(tick, 0).unwrap().coordinates;
            assert_eq!(known, &run[tick as usize].robots[0].configuration, "{command:?}: tick {tick}");
        }
        assert_is(&mut app, run, &ticks);
    }

    // after a new change the undone one cannot be redone
    send(&mut app, TransportCommand::Seek(50));
    app.world_mut().write_message(RunCommand::from(TransportCommand::Checkpoint));
    drive(&mut app, "rover", RobotInput::Drive(1, 1));
    assert!(!app.world().resource::<Undo>().can_redo());
    let events = inputs_of(&app).to_vec();
    send(&mut app, TransportCommand::Redo);
    assert_eq!((inputs_of(&app), frame(&app).tick), (&events[..], 50));
}

#[test]
fn a_run_that_fills_its_keyframes_keeps_fewer_evenly_and_its_beginning() {
    let run = fresh(inputs(), 1100);
    let mut app = app(config(1100), inputs(), false);
    app.world_mut().insert_resource(Keyframes::every(1));
    restore(app.world_mut(), &run[0]).unwrap();
    assert_is(&mut app, &run, &[1000, 1100]);
    let kept = kept(&app);
    let apart = kept[1] - kept[0];
    assert!(kept.len() <= 1024 && kept[0] == 0 && apart.is_power_of_two(), "{kept:?}");
    assert!(kept.windows(2).all(|w| w[1] - w[0] == apart) && kept.last() > Some(&(1100 - apart)), "{kept:?}");
    assert_is(&mut app, &run, &[511, 512, 513, 1, 0, 1023, 1024, 1025, 1100, 0, 1100]);
}

#[test]
fn keyframes_thinned_by_their_size_hold_no_scans_and_lead_back_to_the_same_bits() {
    let config = TourConfig { ticks: 400, ..TourConfig::default() };
    let drive = |tick, robot: &str, v| event(tick, robot, RobotInput::Drive(v, 20));
    let events = vec![drive(30, "Rusty", 128), drive(90, "Hitch", -100), drive(251, "Rusty", -60)];
    let log = Run::record(config.clone(), (SEED, script(events.clone()))).unwrap();
    let run: Vec<Frame> = log.initial().into_iter().chain(log.frames()).cloned().collect();
    assert!(run.iter().all(|frame| frame.scans.iter().any(|scan| scan.ranges.len() == 360)), "there are scans");
    for budget in [1, 5_000, 20_000] {
        let mut app = app(config.clone(), events.clone(), true);
        app.world_mut().insert_resource(Keyframes::every(3).within(budget));
        restore(app.world_mut(), &run[0]).unwrap();
        assert_is(&mut app, &run, &[400]);
        let (ticks, keyframes) = (kept(&app), app.world().resource::<Keyframes>());
        assert_eq!(ticks[0], 0);
        assert_eq!(ticks.len() == 1, budget == 1, "{ticks:?} of {budget} bytes");
        assert!(ticks.len() < 400 / 3 && (budget == 1 || keyframes.bytes() <= budget), "thinned: {ticks:?}");
        assert!(ticks.iter().all(|tick| keyframes.before(*tick).unwrap().scans.is_empty()));
        let history = app.world().resource::<History>().clone();
        assert_is(&mut app, &run, &[399, 0, 251, 250, 96, 95, 97, 1, 400, 192, 29, 30, 31, 400]);
        assert_eq!(*app.world().resource::<History>(), history);
        // an undo lands on the bits of before
        send(&mut app, TransportCommand::Seek(200));
        send(&mut app, TransportCommand::Checkpoint);
        drive_on(&mut app);
        assert_ne!(frame(&app), &run[200]);
        send(&mut app, TransportCommand::Undo);
        assert_is(&mut app, &run, &[200, 400, 33]);
    }
}

#[test]
fn a_recorder_without_keyframes_takes_the_same_memory_however_long_it_goes_on_and_still_goes_back() {
    let run = fresh(inputs(), 300);
    let mut recorder = Recorder::new(config(300), (SEED, script(inputs()))).unwrap();
    assert_same(recorder.seek(300).unwrap(), &run[300]);
    let all = recorder.world().resource::<Keyframes>().bytes();
    let mut recorder = recorder.without_keyframes();
    let first = recorder.world().resource::<Keyframes>().bytes();
    assert!(first > 0 && 4 * first == all, "of the ticks 0, 100, 200 and 300 the first stays: {first} and {all} bytes");
    for _ in 0..200 {
        recorder.step();
    }
    assert_eq!(recorder.world().resource::<Keyframes>().bytes(), first);
    assert_same(recorder.seek(299).unwrap(), &run[299]);
    assert_same(recorder.seek(0).unwrap(), &run[0]);
}

/// Gives the rover another input and goes on for a second.
fn drive_on(app: &mut App) {
    drive(app, "Rusty", RobotInput::Drive(-128, 90));
    (0..20).for_each(|_| step(app.world_mut()));
}

#[test]
fn beyond_a_hundred_thousand_ticks_steps_seeks_history_and_log_go_on() {
    const TICKS: u64 = 102_600;
    const SLOWER: u64 = 100_100;
    let start = [0.0, 0.0, 0.5, 0.5];
    let config = TourConfig { worlds: vec![open("open", &[("car", "hitch", &start)])], ticks: TICKS, sensor: None };
    let events = vec![event(1, "car", RobotInput::Drive(128, 64)), event(SLOWER, "car", RobotInput::Drive(64, 64))];
    let recipe = Recipe::new(config.clone(), (SEED, script(events.clone())));
    let mut app = app(config, events, true);
    let mut log = LogWriter::new(Vec::new(), &recipe, LogKind::Frames, frame(&app)).unwrap();
    let marks = [65_535, 65_536, 65_537, SLOWER - 1, SLOWER, SLOWER + 1, 102_399, 102_400, 102_401, TICKS];
    let mut seen = Vec::new();
    for tick in 1..=TICKS {
        step(app.world_mut());
        log.tick(frame(&app)).unwrap();
        if marks.contains(&tick) {
            seen.push(frame(&app).clone());
        }
    }

    // half the steering all the way: one circle, run through at full speed and then at half, with the trailer at its
    // steady angle
    let curvature = tan(0.5 * HITCH.max_steer) / HITCH.wheelbase;
    let sine = HITCH.with_trailer().hitch_len.unwrap() * curvature;
    for (frame, mark) in seen.iter().zip(marks) {
        assert_eq!(frame.tick, mark);
        let fast = mark.min(SLOWER - 1);
        let way = 0.05 * HITCH.max_speed * (fast as f64 + 0.5 * (mark - fast) as f64);
        let [x, y, theta] = driven([0.0, 0.0, 0.5], 1.0, curvature, way);
        let q = &frame.robots[0].configuration;
        assert!((q[0] - x).abs() < 1e-9 && (q[1] - y).abs() < 1e-9, "tick {mark}: {q:?}, not {x} {y}");
        assert!(wrap(q[2] - theta).abs() < 1e-10, "tick {mark}: {q:?}, not {theta}");
        assert!((sin(q[2] - q[3]) - sine).abs() < 1e-11, "tick {mark}: {q:?}");
    }

    let kept = kept(&app);
    assert!(kept.len() <= 1024 && kept[0] == 0 && kept.last() > Some(&102_000), "{} are kept", kept.len());
    for i in [9, 0, 5, 3, 9, 6, 8, 1, 4, 7, 2] {
        send(&mut app, TransportCommand::Seek(marks[i]));
        assert_same(frame(&app), &seen[i]);
    }
    // half an hour is kept in full and more is thinned; these ticks are among those kept
    let history = app.world().resource::<History>();
    assert!(history.samples() <= 36_000, "{} samples", history.samples());
    for i in [1, 4, 7] {
        assert_eq!(history.at(marks[i], 0).unwrap().coordinates, seen[i].robots[0].configuration);
    }

    let read = Log::read_mcap(&log.finish().unwrap()).unwrap().log;
    assert_eq!((read.frames().len() as u64, read.frames().last().map(|f| f.tick)), (TICKS, Some(TICKS)));
    for frame in &seen {
        assert_same(&read.frames()[frame.tick as usize - 1], frame);
    }
}

#[test]
fn the_draws_of_any_tick_come_after_those_of_all_before_it() {
    // a noisy sensor's rays count too: sixty rays draw a million times in a quarter of an hour
    let stream = Stream::new(SEED, "rover/slip");
    let mut walked = stream.clone();
    for index in 0..=1 << 20 {
        if [0, 65_535, 65_536, 99_999, 100_000, (1 << 20) - 1, 1 << 20].contains(&index) {
            assert_eq!(stream.at(index).bits(), walked.clone().bits(), "index {index}");
        }
        (0..DRAWS_PER_INDEX).for_each(|_| _ = walked.bits());
    }
}
