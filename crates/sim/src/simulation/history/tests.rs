//! What a history keeps of runs, and how it is thinned.

use super::*;
use crate::run::{RobotInput, Script};
use crate::simulation::command::obey;
use crate::simulation::{SimulationPlugin, TransportCommand, seek, start_run, step};
use crate::tour::{BOOK_SEED, TourConfig};
use motion_lab_core::num::{greater, lesser};

fn app(script: Script) -> App {
    let mut app = App::new();
    app.add_plugins((SimulationPlugin, HistoryPlugin));
    start_run(app.world_mut(), TourConfig::default(), (BOOK_SEED, script)).unwrap();
    app
}

fn event(tick: u64, robot: &str, input: RobotInput) -> crate::run::Event {
    crate::run::Event { tick, robot: robot.into(), input }
}

#[test]
fn it_counts_what_the_robots_themselves_count_and_survives_being_taken_back() {
    let mut app = app(Script::empty());
    let world = app.world_mut();
    (0..400).for_each(|_| step(world));
    let contacts: Vec<u32> = crate::simulation::view(world).iter().map(|r| r.contacts).collect();
    let history = world.resource::<History>().clone();
    for (id, count) in (0_u32..).zip(&contacts) {
        let marked = history.marks().iter().filter(|m| m.robot == id && m.what == Happening::Contact).count();
        assert_eq!(marked, *count as usize, "robot {id}");
        assert_eq!(history.at(400, id).unwrap().contacts, *count);
    }
    assert!(contacts[1] > 0, "or nothing is tested");
    seek(world, 130).unwrap();
    assert_eq!(world.resource::<History>().samples(), 401, "what lies ahead is kept");
    seek(world, 400).unwrap();
    assert_eq!(*world.resource::<History>(), history);
    // continuing from a tick keeps the marks of that tick
    let ticks: Vec<u64> = history.marks().iter().map(|m| m.tick).collect();
    for (tick, mark) in ticks.iter().rev().copied().zip(history.marks().iter().rev()) {
        seek(world, tick).unwrap();
        // the box around parts of one radius is that around their corners and ends, wider by it on all sides
        let footprint = crate::simulation::view(world).swap_remove(mark.robot as usize).footprint;
        let ends = || footprint.parts().iter().flat_map(|part| part.placed().core());
        let middle = |of: fn(&Point2) -> f64| {
            let (least, most) = ends().map(of).fold((9e9, -9e9), |(a, b), v| (lesser(a, v), greater(b, v)));
            0.5 * (least + most)
        };
        let expected = Point2::new(middle(|p| p.x), middle(|p| p.y));
        assert!((mark.at - expected).norm() < 1e-12, "{mark:?} {expected}");
        obey(world, TransportCommand::ContinueFromHere).unwrap();
        let kept: Vec<u64> = world.resource::<History>().marks().iter().map(|m| m.tick).collect();
        assert_eq!(kept, ticks.iter().copied().filter(|t| *t <= tick).collect::<Vec<_>>());
    }
}

#[test]
fn a_span_has_its_ticks_and_no_others() {
    let mut app = app(Script::empty());
    let world = app.world_mut();
    let mut seen = vec![crate::simulation::view(world)[0].coordinates.clone()];
    for _ in 0..30 {
        step(world);
        seen.push(crate::simulation::view(world)[0].coordinates.clone());
    }
    let history = world.resource::<History>();
    let span = |ticks| history.span(0, ticks).map(|trail| trail.coordinates.clone()).collect::<Vec<_>>();
    assert_eq!(span(4..=9), seen[4..=9]);
    assert_eq!(span(25..=99), seen[25..]);
    assert!(span(31..=40).is_empty() && history.span(99, 0..=30).next().is_none());
}

#[test]
fn reversals_are_changes_of_the_way_that_was_gone() {
    let drive = |tick, v| event(tick, "Hitch", RobotInput::Drive(v, 0));
    // forward, stand, forward again (none), backward (1), forward (2)
    let events = vec![drive(1, 64), drive(11, 0), drive(16, 64), drive(21, -64), drive(31, 64)];
    let mut app = app(Script { events, ..Script::empty() });
    (0..40).for_each(|_| step(app.world_mut()));
    let history = app.world().resource::<History>();
    let at = |tick| history.at(tick, 2).unwrap();
    assert_eq!([10, 20, 25, 40].map(|t| at(t).reversals), [0, 0, 1, 2]);
    assert!(at(20).travelled > 0.1 && (at(40).travelled - at(20).travelled).abs() < 0.05, "there and back");
    assert_eq!(history.marks().iter().find(|m| m.robot == 2).map(|m| (m.tick, m.what)), Some((1, Happening::Takeover)));
}

#[test]
fn encoders_turn_on_at_a_wall_while_the_way_does_not() {
    // Rusty drives straight ahead from its start until something holds it
    let mut app = app(Script { events: vec![event(1, "Rusty", RobotInput::Drive(128, 0))], ..Script::empty() });
    (0..600).for_each(|_| step(app.world_mut()));
    let history = app.world().resource::<History>();
    let (early, late) = (history.at(500, 0).unwrap(), history.at(600, 0).unwrap());
    assert!((late.travelled - early.travelled).abs() < 1e-3, "held");
    let turned = late.encoders.unwrap() - early.encoders.unwrap();
    assert!((turned - 3.0).abs() < 0.05, "5 s at 0.6 m/s roll 3 m, not {turned}");
    assert!(late.clearance > 0.0 && late.clearance < 1e-3);
}

#[test]
fn continuing_forgets_what_came_after() {
    let mut app = app(Script::empty());
    let world = app.world_mut();
    (0..300).for_each(|_| step(world));
    obey(world, TransportCommand::Seek(100)).unwrap();
    obey(world, TransportCommand::ContinueFromHere).unwrap();
    let history = world.resource::<History>();
    assert_eq!(history.samples(), 101);
    assert!(history.marks().iter().all(|m| m.tick <= 100));
}

#[test]
fn a_long_run_is_thinned_and_goes_on_counting() {
    let mut app = app(Script::empty());
    let world = app.world_mut();
    let trail = Trail::default();
    let sample = |tick| Sample { tick, robots: vec![trail.clone(); 3] };
    world.resource_mut::<History>().samples = (0..MAX_SAMPLES as u64).map(sample).collect();
    world.resource_mut::<History>().latest = Some(sample(MAX_SAMPLES as u64 - 1));
    world.resource_mut::<Transport>().tick = MAX_SAMPLES as u64 - 1;
    (0..2).for_each(|_| step(world));
    let history = world.resource::<History>();
    assert_eq!(history.samples(), MAX_SAMPLES / 2 + 1);
    assert!(history.samples.iter().all(|s| s.tick % 2 == 0));
    assert!(history.series(0, 100, |t| Some(t.travelled)).len() <= 101);
}

#[test]
fn samples_thinned_by_their_size_go_on_from_every_keyframe() {
    let script = || {
        let drive = |tick, v| event(tick, "Hitch", RobotInput::Drive(v, 0));
        Script::new(vec![drive(1, 64), drive(450, -64), drive(700, 64)], vec![])
    };
    let (mut whole, mut thinned) = (app(script()), app(script()));
    let per_sample = whole.world().resource::<History>().bytes;
    thinned.world_mut().resource_mut::<History>().budget = 30 * per_sample;
    for app in [&mut whole, &mut thinned] {
        (0..1000).for_each(|_| step(app.world_mut()));
    }
    let whole = whole.world().resource::<History>();
    let check = |history: &History| {
        assert!(history.samples() == 11 && history.bytes <= history.budget, "{} samples", history.samples());
        for (tick, robot) in (0..=1000).step_by(100).flat_map(|tick| [(tick, 0), (tick, 1), (tick, 2)]) {
            assert_eq!(history.at(tick, robot), whole.at(tick, robot), "tick {tick}, robot {robot}");
        }
        assert_eq!(history.marks(), whole.marks());
    };
    let world = thinned.world_mut();
    check(world.resource::<History>());
    for tick in [730, 130, 999, 250, 1000] {
        seek(world, tick).unwrap();
        assert_eq!(world.resource::<History>().at(tick, 2), whole.at(tick, 2), "tick {tick}");
    }
    seek(world, 870).unwrap();
    obey(world, TransportCommand::ContinueFromHere).unwrap();
    assert_eq!(world.resource::<History>().samples(), 9);
    (870..1000).for_each(|_| step(world));
    check(world.resource::<History>());
}

#[test]
fn more_than_a_hundred_robots_are_measured_once_a_second_and_counted_every_tick() {
    use motion_lab_core::worlds::{Resident, World as WorldModel};
    let start = |robots: u32| {
        let lot = WorldModel::apartment();
        let world = |k: u32| WorldModel {
            name: format!("world {k}"),
            robots: vec![Resident { name: format!("rover {k}"), ..lot.robots[0].clone() }],
            ..lot.clone()
        };
        let config = TourConfig { worlds: (0..robots).map(world).collect(), ticks: 50, sensor: None };
        let mut app = App::new();
        app.add_plugins((SimulationPlugin, HistoryPlugin));
        start_run(app.world_mut(), config, BOOK_SEED).unwrap();
        (0..50).for_each(|_| step(app.world_mut()));
        app
    };
    let (few, many) = (start(100), start(101));
    let (few, many) = (few.world().resource::<History>(), many.world().resource::<History>());
    assert_eq!((few.samples(), many.samples()), (51, 3));
    for robot in 0..100 {
        assert_eq!(many.at(40, robot), few.at(40, robot), "a sample is measured in full");
        let (now, measured) = (few.at(50, robot).unwrap(), few.at(40, robot).unwrap());
        assert!(now.travelled - measured.travelled > 0.05, "it moves, or nothing is tested");
        let mut expected = now.clone();
        (expected.clearance, expected.encoders) = (measured.clearance, measured.encoders);
        assert_eq!(many.at(50, robot), Some(&expected));
    }
}

#[test]
fn marks_are_thinned_by_halves_and_the_last_one_stays() {
    for count in [MAX_MARKS + 1, MAX_MARKS + 2] {
        let mark = |tick| TickMark { tick, robot: 0, what: Happening::Contact, at: Point2::origin() };
        let mut history = History { marks: (1..=count as u64).map(mark).collect(), ..History::default() };
        history.thin_marks();
        assert_eq!(history.marks.len(), count.div_ceil(2));
        assert_eq!(history.marks.last(), Some(&mark(count as u64)));
        history.thin_marks();
        assert_eq!(history.marks.len(), count.div_ceil(2), "few enough");
    }
}

#[test]
fn a_series_is_what_was_sampled_evenly_over_the_run() {
    let mut app = app(Script::empty());
    (0..300).for_each(|_| step(app.world_mut()));
    let history = app.world().resource::<History>();
    let sampled = |tick: u64| (tick, history.at(tick, 0).unwrap().travelled);
    assert!(sampled(300).1 > sampled(4).1, "or nothing is told apart");
    // a fourth of the 301 samples are no more than 100, a third would be 101
    let fourth: Vec<_> = (0..=300).step_by(4).map(sampled).collect();
    assert_eq!(history.series(0, 100, |t| Some(t.travelled)), fourth);
    let whole: Vec<_> = (0..=300).map(sampled).collect();
    assert_eq!(history.series(0, 301, |t| Some(t.travelled)), whole);
    // a sample without the value is left out, and a robot that is not there has none
    let late: Vec<_> = whole.iter().copied().filter(|(_, travelled)| *travelled > whole[150].1).collect();
    let some = |t: &Trail| Some(t.travelled).filter(|travelled| *travelled > whole[150].1);
    assert_eq!(history.series(0, 1000, some), late);
    assert_eq!(history.series(99, 100, |t| Some(t.travelled)), []);
}
