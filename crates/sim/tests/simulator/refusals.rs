//! Refused inputs: which are refused wherever a robot is, why the others are, and that logs with them still replay.

use motion_lab_core::configuration::{InputKind, RobotKind};
use motion_lab_core::prelude::*;
use motion_lab_sim::recording::{Recorder, Run, verify};
use motion_lab_sim::run::{Event, RobotInput, Script, ScriptProblem, WorldChange, WorldEvent};
use motion_lab_sim::simulation::{InputRefusal, RefusedEvent};
use motion_lab_sim::tour::TourConfig;

use super::crowd::arena;
use super::{event, quantized, script};

fn one(kind: &str, start: &[f64]) -> TourConfig {
    TourConfig { worlds: vec![arena(10.0, &[("it", kind, start)])], ticks: 3, sensor: None }
}

fn recorded(config: &TourConfig, events: Vec<Event>) -> Recorder {
    let mut run = Recorder::new(config.clone(), (Seed(4), script(events))).unwrap();
    while !run.is_complete() {
        run.step();
    }
    run
}

/// The table of kinds says what the simulator does, and the check against a configuration refuses just what no robot of
/// the kind could ever apply.
#[test]
fn the_table_of_kinds_and_the_check_agree_with_the_simulator() {
    let starts: [(&str, &[f64]); 5] =
        [("rusty", &[0.0; 3]), ("reach", &[0.0; 2]), ("reach3", &[0.0; 3]), ("hitch", &[0.0; 3]), ("hitch", &[0.0; 4])];
    let mut refused = 0;
    for (kind, start) in starts {
        let about = RobotKind::of(kind).unwrap();
        for input in InputKind::ALL {
            for count in 1..=5 {
                let to = quantized(&vec![0.25; count]);
                let input = match input {
                    InputKind::Drive => RobotInput::Drive(1, 1),
                    InputKind::MoveTo => RobotInput::MoveTo(to),
                    InputKind::Teleport => RobotInput::Teleport(to),
                    InputKind::SetTrailer => RobotInput::SetTrailer(count % 2 == 0),
                    _ => RobotInput::Release,
                };
                let has_coordinates = matches!(input, RobotInput::MoveTo(_) | RobotInput::Teleport(_));
                let (config, events) = (one(kind, start), vec![event(2, "it", input.clone())]);
                let checked = script(events.clone()).check_for(&config);
                let run = recorded(&config, events);
                let is_refused = run.frame().robots[0].refusals > 0;
                assert_eq!(is_refused, run.refusals().count() == 1, "{kind} {input:?}");
                // a car without a trailer has no fourth coordinate now, and may have one later
                let later = kind == "hitch" && start.len() == 3 && count == 4 && has_coordinates;
                if later && about.takes.contains(&input.kind()) {
                    assert!(is_refused && checked.is_ok(), "{input:?}");
                    continue;
                }
                assert_eq!(checked.is_err(), is_refused, "{kind} {input:?}: {checked:?}");
                if let Err(error) = checked {
                    refused += 1;
                    let is_taken = about.takes.contains(&input.kind());
                    assert_eq!(matches!(error.problem, ScriptProblem::NoConfiguration(_)), is_taken, "{error}");
                    assert_eq!(matches!(error.problem, ScriptProblem::NotTaken(_)), !is_taken, "{error}");
                    assert_eq!((error.list, error.event), ("events", Some(0)));
                }
            }
        }
    }
    assert!(refused > 30, "{refused}");
}

#[test]
fn the_first_refusal_says_tick_robot_input_and_reason() {
    let start: &[f64] = &[0.0; 3];
    let world = arena(
        10.0,
        &[("it", "rusty", start), ("other", "rusty", &[2.0, 0.0, 0.0]), ("car", "hitch", &[0.0, 5.0, 0.0])],
    );
    let config = TourConfig { worlds: vec![world], ticks: 9, sensor: None };
    let put = |robot: &str, x: f64| event(4, robot, RobotInput::Teleport(quantized(&[x, 0.0, 0.0])));
    let still = |robot: &str| event(1, robot, RobotInput::Drive(0, 0));
    let first = |refused: Event| {
        let mut events = vec![still("it"), still("other"), still("car"), refused];
        events.push(event(9, "it", RobotInput::SetTrailer(true)));
        let run = recorded(&config, events);
        assert_eq!(run.refusals().count(), 2);
        run.refusals().first().unwrap().to_string()
    };
    let said = "tick 4: robot \"it\" refused Teleport: it would touch";
    assert_eq!(first(put("it", 10.0)), format!("{said} the wall there"));
    assert_eq!(first(put("it", 2.1)), format!("{said} another robot there"));
    // also with coordinates that it could not be put at
    for coordinates in [&[0.0; 3][..], &[0.0; 2]] {
        let moved = event(4, "car", RobotInput::MoveTo(quantized(coordinates)));
        assert_eq!(first(moved), "tick 4: robot \"car\" refused MoveTo: it takes no MoveTo");
    }
    let flat = event(4, "car", RobotInput::Teleport(quantized(&[0.0, 0.0])));
    assert_eq!(
        first(flat),
        "tick 4: robot \"car\" refused Teleport: it can be put in no configuration of 2 coordinates"
    );
    let run = recorded(&config, vec![put("it", 10.0)]);
    let Some(RefusedEvent::Input(refused)) = run.refusals().first() else { panic!("{:?}", run.refusals()) };
    assert_eq!(refused.reason, InputRefusal::Touches("the wall".into()));
}

#[test]
fn a_refused_change_counts_and_going_back_counts_nothing_twice() {
    let q = |x: f64| quantized(&[x])[0];
    let disc = |tick| {
        let change = WorldChange::Add { name: format!("disc {tick}"), points: vec![(q(0.0), q(0.0))], radius: q(0.5) };
        WorldEvent { tick, world: "the arena".into(), change }
    };
    let config = TourConfig { ticks: 8, ..one("rusty", &[0.0; 3]) };
    let events = vec![event(1, "it", RobotInput::Drive(0, 0)), event(5, "it", RobotInput::SetTrailer(true))];
    let mut run = Recorder::new(config, (Seed(4), Script::new(events, vec![disc(3), disc(7)]))).unwrap();
    run.seek(8).unwrap();
    assert_eq!(run.refusals().count(), 3, "where the rover stands");
    let first = run.refusals().first().unwrap().to_string();
    assert!(first.starts_with("tick 3: \"disc 3\" in world \"the arena\" stays as it is"), "{first}");
    run.seek(0).unwrap();
    run.seek(8).unwrap();
    assert_eq!(run.refusals().count(), 3);
    assert_eq!(run.frame().robots[0].refusals, 1, "robots count their own");
}

#[test]
fn a_log_with_inputs_that_no_check_lets_through_replays_and_verifies() {
    let events = vec![
        event(1, "it", RobotInput::MoveTo(quantized(&[0.0; 3]))),
        event(2, "it", RobotInput::SetTrailer(true)),
        event(3, "it", RobotInput::Teleport(quantized(&[0.0; 2]))),
    ];
    let config = one("rusty", &[0.0; 3]);
    assert!(script(events.clone()).check_for(&config).is_err());
    let log = Run::record(config, (Seed(4), script(events))).unwrap();
    let mut file = Vec::new();
    log.write_mcap(&mut file).unwrap();
    let read = motion_lab_sim::run::Log::read_mcap(&file).unwrap().log;
    assert_eq!(verify(&read, |_| {}).unwrap().identical, 3);
    assert_eq!(read.frames()[2].robots[0].refusals, 3);
}

#[test]
fn a_teleport_outside_the_world_is_refused_when_it_is_read_and_when_it_is_applied() {
    let start: &[f64] = &[5.0, -5.0, 0.0];
    let mut world =
        arena(10.0, &[("it", "rusty", start), ("car", "hitch", &[0.0, 5.0, 0.0]), ("arm", "reach", &[0.0; 2])]);
    world.obstacles.clear();
    // a side between two units of 2^-20 m, which the units round outward
    world.bounds.max.x = 10.3;
    let config = TourConfig { worlds: vec![world], ticks: 3, sensor: None };
    let put = |robot: &str, to: &[f64]| event(2, robot, RobotInput::Teleport(quantized(to)));
    for (robot, to, point) in [
        ("it", &[90.0, 5.0, 0.0][..], Some("(90, 5)")),
        ("it", &[0.0, -10.5, 0.0], Some("(0, -10.5)")),
        ("car", &[-11.0, 0.0, 0.0], Some("(-11, 0)")),
        ("it", &[10.3, 10.0, 0.0], None),
        ("it", &[-10.0, -10.0, 0.0], None),
        ("car", &[10.3, 0.0, 1.0], None),
        // joint angles are no place
        ("arm", &[30.0, -20.0], None),
    ] {
        let said = point.map(|point| {
            format!("the target {point} lies outside the world, which reaches from (-10, -10) to (10.3, 10)")
        });
        let checked = script(vec![put(robot, to)]).check_for(&config).map_err(|error| error.to_string());
        let read = said.as_ref().map(|said| format!("events[0]: tick 2: Teleport of robot {robot:?}: {said}"));
        assert_eq!(checked.err(), read, "{robot} {to:?}");
        let run = recorded(&config, vec![put(robot, to)]);
        let applied = said.map(|said| format!("tick 2: robot {robot:?} refused Teleport: {said}"));
        assert_eq!(run.refusals().first().map(ToString::to_string), applied, "{robot} {to:?}");
    }
}
