//! Refused inputs: which are refused wherever a robot is, why the others are, and that logs with them still replay.

use motion_lab_core::configuration::{InputKind, RobotKind};
use motion_lab_core::num::sin_cos;
use motion_lab_core::prelude::*;
use motion_lab_core::worlds::{Door, Obstacle, ObstacleKind};
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

/// The middle of each part of a robot at a configuration, by the kinematics written out.
fn middles(kind: &str, q: &[f64]) -> Vec<Point2> {
    let along = |from: Point2, heading: f64, length: f64| {
        let (s, c) = sin_cos(heading);
        Point2::new(from.x + length * c, from.y + length * s)
    };
    let lengths: &[f64] = match kind {
        "reach" => &[1.0, 1.0],
        "reach3" => &[0.6, 0.5, 0.4],
        // the chassis is 0.7 m behind the rear axle to 3.2 m ahead of it, the trailer 1 m to 2.8 m behind
        _ => {
            let (at, ends) =
                (Point2::new(q[0], q[1]), [(q[2], 1.25)].into_iter().chain(q.get(3).map(|psi| (*psi, -1.9))));
            return ends.map(|(heading, length)| along(at, heading, length)).collect();
        }
    };
    let (mut at, mut heading, mut all) = (Point2::new(0.0, 0.0), 0.0, Vec::new());
    for (length, turn) in lengths.iter().zip(q) {
        heading += turn;
        all.push(along(at, heading, 0.5 * length));
        at = along(at, heading, *length);
    }
    all
}

/// Robots of several parts, each away from the walls and folded, so that a hair about a part's middle is that part's
/// alone.
const FOLDED: [(&str, &[f64]); 4] = [
    ("reach", &[0.5, 1.9]),
    ("reach3", &[0.5, 1.2, -1.4]),
    ("hitch", &[3.0, -4.0, 0.5]),
    ("hitch", &[3.0, -4.0, 0.5, 1.2]),
];

#[test]
fn an_obstacle_is_refused_where_any_part_of_any_robot_stands() {
    let q = |x: f64| quantized(&[x])[0];
    let disc = |at: Point2| (vec![(q(at.x), q(at.y))], q(0.01));
    let in_tick = |tick, change| WorldEvent { tick, world: "the arena".into(), change };
    let mut parts = 0;
    for (kind, start) in FOLDED {
        for (part, at) in middles(kind, start).into_iter().enumerate() {
            // beside a rover far away, with a higher id and with a lower one
            for rover_first in [false, true] {
                let far: (&str, &str, &[f64]) = ("far", "rusty", &[-9.0, 9.0, 0.0]);
                let it: (&str, &str, &[f64]) = ("it", kind, start);
                let mut world = arena(10.0, &if rover_first { [far, it] } else { [it, far] });
                let door = |name: &str, at: Point2| Door {
                    name: name.into(),
                    a: Point2::new(at.x - 0.01, at.y),
                    b: Point2::new(at.x + 0.01, at.y),
                    open: true,
                };
                world.doors = vec![door("the door", at), door("the other door", Point2::new(-5.0, 5.0))];
                let config = TourConfig { worlds: vec![world], ticks: 3, sensor: None };
                let ((points, radius), (there, _)) = (disc(at), disc(Point2::new(-5.0, 5.0)));
                let add = |name: &str, points| WorldChange::Add { name: name.into(), points, radius };
                let to = (q(at.x + 5.0), q(at.y - 5.0), q(0.0));
                let changes = vec![
                    in_tick(1, add("onto it", points)),
                    in_tick(1, add("beside it", there)),
                    in_tick(1, WorldChange::Close("the door".into())),
                    in_tick(1, WorldChange::Close("the other door".into())),
                    in_tick(2, WorldChange::Move { name: "beside it".into(), to }),
                ];
                let still: Vec<Event> = match kind {
                    "hitch" => vec![event(1, "it", RobotInput::Drive(0, 0))],
                    _ => vec![event(1, "it", RobotInput::MoveTo(quantized(start)))],
                };
                let mut run = Recorder::new(config, (Seed(4), Script::new(still, changes))).unwrap();
                run.seek(3).unwrap();
                assert_eq!(run.refusals().count(), 3, "{kind}, part {part}: {:?}", run.refusals().first());
                let first = run.refusals().first().unwrap().to_string();
                let said = "tick 1: \"onto it\" in world \"the arena\" stays as it is: robot \"it\" stands there";
                assert_eq!(first, said, "{kind}, part {part}");
                let states = &run.frame().obstacles;
                assert_eq!(states.len(), 2, "the disc and the door beside it are there: {states:?}");
                assert!(states.iter().all(|state| state.present && state.pose == Pose2::IDENTITY));
                parts += 1;
            }
        }
    }
    assert_eq!(parts, 2 * (2 + 3 + 1 + 2));
}

/// The arena's wall has four sides; moved by 8 m along an axis, one of them comes to lie on the rover.
#[test]
fn an_obstacle_of_many_pieces_is_refused_whichever_of_them_meets_a_robot() {
    let q = |x: f64| quantized(&[x])[0];
    for (x, y) in [(8.0, 0.0), (-8.0, 0.0), (0.0, 8.0), (0.0, -8.0)] {
        let config = one("rusty", &[-0.25 * x, -0.25 * y, 0.0]);
        for (by, count) in [(1.0, 1), (0.5, 0)] {
            let to = (q(by * x), q(by * y), q(0.0));
            let change = WorldChange::Move { name: "the wall".into(), to };
            let change = WorldEvent { tick: 1, world: "the arena".into(), change };
            let still = vec![event(1, "it", RobotInput::Drive(0, 0))];
            let mut run = Recorder::new(config.clone(), (Seed(4), Script::new(still, vec![change]))).unwrap();
            run.seek(2).unwrap();
            assert_eq!(run.refusals().count(), count, "moved by ({x}, {y}), {by}");
        }
    }
}

#[test]
fn a_robot_is_put_nowhere_where_any_part_of_it_would_touch() {
    let (mut put, mut refused) = (0, 0);
    for (kind, to) in FOLDED {
        for (part, at) in middles(kind, to).into_iter().enumerate() {
            for aside in [0.0, 3.0] {
                let start: &[f64] = if kind == "hitch" { &[-5.0, 5.0, 0.0] } else { &[-2.5, 0.1, 0.1] };
                let mut config = one(kind, &start[..if kind == "reach" { 2 } else { 3 }]);
                let pillar = vec![(Pose2::new(at.x + aside, at.y - aside, 0.0), Shape::Disc { radius: 0.01 })];
                config.worlds[0].obstacles.push(Obstacle::new("the pillar", ObstacleKind::Solid, pillar));
                // a car without a trailer gets one where it stands, and is then put with it
                let mut events = vec![event(1, "it", RobotInput::Teleport(quantized(to)))];
                if to.len() == 4 {
                    events.insert(0, event(1, "it", RobotInput::SetTrailer(true)));
                }
                let run = recorded(&config, events);
                assert_eq!(run.refusals().count(), u64::from(aside == 0.0), "{kind}, part {part}");
                if aside == 0.0 { refused += 1 } else { put += 1 }
            }
        }
    }
    assert_eq!((put, refused), (8, 8));
    // a trailer comes to stand straight behind its car, from 1 m to 2.8 m
    for (behind, count) in [(-0.9, 0), (-1.1, 1), (-1.9, 1), (-2.7, 1), (-2.9, 0)] {
        let mut config = one("hitch", &[0.0; 3]);
        let pillar = vec![(Pose2::new(behind, 0.7, 0.0), Shape::Disc { radius: 0.01 })];
        config.worlds[0].obstacles.push(Obstacle::new("the pillar", ObstacleKind::Solid, pillar));
        let run = recorded(&config, vec![event(2, "it", RobotInput::SetTrailer(true))]);
        assert_eq!(run.refusals().count(), count, "a pillar {behind} m behind");
        assert_eq!(run.frame().robots[0].configuration.len(), if count == 0 { 4 } else { 3 });
    }
}
