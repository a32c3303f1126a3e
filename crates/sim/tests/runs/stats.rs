//! What runs were like for their robots: paths, clearances, contacts and their course, against closed forms.

use std::sync::Arc;

use motion_lab_core::configuration::Kinds;
use motion_lab_core::num::{cos, hypot, sin};
use motion_lab_core::picture::Drawing;
use motion_lab_core::prelude::*;
use motion_lab_core::worlds::{Door, World};
use motion_lab_sim::capture::{RunPlot, plot};
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{
    Event, Log, Quantity, RobotInput, RobotStats, RunStats, Script, Series, SeriesGatherer, StatsColumn, WorldChange,
    WorldEvent,
};
use motion_lab_sim::tour::TourConfig;

use crate::simulator::crowd::arena;
use crate::simulator::{event, quantized, script};

/// Half the width of the walled square.
const HALF: f64 = 10.0;

fn square(kind: &str, start: &[f64]) -> World {
    arena(HALF, &[("it", kind, start)])
}

fn log_of(world: World, ticks: u64, script: Script) -> Log {
    Run::record(TourConfig { worlds: vec![world], ticks, sensor: None }, (Seed(7), script)).unwrap()
}

fn drive(tick: u64, a: i16, b: i16) -> Event {
    event(tick, "it", RobotInput::Drive(a, b))
}

fn stats(log: &Log) -> RobotStats {
    let stats = RunStats::of(log);
    assert_eq!(stats.ticks, log.frames().len() as u64);
    stats.robots.into_iter().next().unwrap()
}

fn series(log: &Log, quantity: Quantity) -> Vec<Series> {
    let kinds = Kinds::default();
    let mut gatherer = SeriesGatherer::new(quantity, &log.recipe.config, &log.recipe.script, &kinds, |_| true);
    std::iter::once(log.initial().unwrap()).chain(log.frames()).for_each(|frame| gatherer.see(frame));
    gatherer.series()
}

#[track_caller]
fn assert_close(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9, "{found}, not {expected}");
}

/// The car's front is 3.9 m - 0.7 m ahead of its rear axle, and its greatest speed 1.5 m/s.
#[test]
fn a_straight_drive_is_as_long_as_speed_times_time_and_as_near_as_its_front() {
    let log = log_of(square("hitch", &[0.0; 3]), 60, script(vec![drive(1, 128, 0), drive(41, 0, 0)]));
    let car = stats(&log);
    assert_close(car.path_length.unwrap(), 1.5 * 40.0 * 0.05);
    let least = car.least_clearance.unwrap();
    assert_close(least.metres, HALF - 3.0 - 3.2);
    assert_eq!((least.tick, car.contacts, car.contact_ticks, car.refusals), (40, 0, 0, 0));
    assert_eq!((car.name.as_str(), car.kind.as_str(), car.world.as_str()), ("it", "hitch", "the arena"));
}

#[test]
fn backward_counts_as_forward_does_and_an_arc_by_its_length() {
    let there_and_back = script(vec![drive(1, 128, 0), drive(21, -128, 0), drive(41, 0, 0)]);
    assert_close(stats(&log_of(square("hitch", &[0.0; 3]), 60, there_and_back)).path_length.unwrap(), 2.0 * 1.5);
    // chords would be shorter by 3e-5 m
    let arc = script(vec![drive(1, 128, 128), drive(21, 0, 0)]);
    assert_close(stats(&log_of(square("hitch", &[0.0; 3]), 30, arc)).path_length.unwrap(), 1.5);
}

#[test]
fn an_arm_goes_as_far_as_its_tip() {
    // straight along x, its links 2 m long together and 0.03 m thick; then turned by half a radian at once
    let to = RobotInput::MoveTo(quantized(&[0.5, 0.0]));
    let arm = stats(&log_of(square("reach", &[0.0; 2]), 10, script(vec![event(1, "it", to)])));
    assert_close(arm.path_length.unwrap(), 2.0 * 2.0 * sin(0.25));
    let least = arm.least_clearance.unwrap();
    assert_close(least.metres, HALF - 2.0 - 0.03);
    assert_eq!(least.tick, 0);
}

#[test]
fn a_teleport_is_no_path_and_a_refused_one_does_not_hide_any() {
    let put = |tick, x| event(tick, "it", RobotInput::Teleport(quantized(&[x, 0.0, 0.0])));
    let moved = stats(&log_of(square("hitch", &[0.0; 3]), 10, script(vec![drive(1, 0, 0), put(4, 3.0)])));
    assert_eq!((moved.path_length, moved.refusals), (Some(0.0), 0));
    // onto the wall in every tick
    let mut events = vec![drive(1, 128, 0)];
    events.extend((1..=20).map(|tick| put(tick, HALF)));
    let refused = stats(&log_of(square("hitch", &[0.0; 3]), 20, script(events)));
    assert_close(refused.path_length.unwrap(), 1.5);
    assert_eq!(refused.refusals, 20);
    // onto the wall and elsewhere in one tick, in either order: it is put once and refuses once
    for [one, other] in [[HALF, 3.0], [3.0, HALF]] {
        let both = script(vec![drive(1, 0, 0), put(4, one), put(4, other), put(6, HALF)]);
        let both = stats(&log_of(square("hitch", &[0.0; 3]), 10, both));
        assert_eq!((both.path_length, both.refusals), (Some(0.0), 2));
    }
}

#[test]
fn time_in_contact_is_the_time_held_at_the_wall() {
    // 1.8 m to the wall at 0.075 m a tick: it is held from tick 24 or 25 on, until it backs off at tick 61
    let forth = vec![drive(1, 128, 0), drive(61, -128, 0)];
    let car = stats(&log_of(square("hitch", &[HALF - 5.0, 0.0, 0.0]), 80, script(forth)));
    assert_eq!(car.contacts, 1);
    assert!((36..=37).contains(&car.contact_ticks), "{}", car.contact_ticks);
    assert_close(car.contact_seconds(), car.contact_ticks as f64 * 0.05);
    let least = car.least_clearance.unwrap();
    assert!((0.0..1e-3).contains(&least.metres) && (24..=60).contains(&least.tick), "{least:?}");
}

#[test]
fn clearances_follow_obstacles_that_come_move_and_go_and_doors() {
    let q = |x: f64| quantized(&[x])[0];
    let change = |tick, change| WorldEvent { tick, world: "the arena".into(), change };
    let disc = || "the disc".to_owned();
    let changes = vec![
        change(3, WorldChange::Add { name: disc(), points: vec![(q(0.0), q(3.0))], radius: q(0.5) }),
        change(5, WorldChange::Remove(disc())),
        change(6, WorldChange::Move { name: disc(), to: (q(0.0), q(-1.0), q(0.0)) }),
        change(8, WorldChange::Remove(disc())),
        change(9, WorldChange::Close("the door".into())),
        change(10, WorldChange::Open("the door".into())),
        change(11, WorldChange::Move { name: "the wall".into(), to: (q(1.0), q(0.0), q(0.0)) }),
        change(12, WorldChange::Remove("the wall".into())),
    ];
    let p = Point2::new;
    let mut world = square("rusty", &[0.0; 3]);
    world.doors = vec![Door { name: "the door".into(), a: p(-1.0, 1.0), b: p(1.0, 1.0), open: true }];
    let log = log_of(world, 13, Script::new(vec![drive(1, 0, 0)], changes));
    let body = 0.11;
    let far = HALF - body;
    let (disc, nearer, door) = (3.0 - 0.5 - body, 2.0 - 0.5 - body, 1.0 - body);
    let expected = [far, far, far, disc, disc, far, nearer, nearer, far, door, far, far - 1.0];
    let clearance = series(&log, Quantity::Clearance).remove(0);
    assert_eq!(clearance.points.len(), expected.len(), "nothing is near when the wall is gone");
    for ((tick, metres), (at, expected)) in clearance.points.iter().zip((0..).zip(expected)) {
        assert_eq!(*tick, at);
        assert!((metres - expected).abs() < 1e-6, "tick {tick}: {metres}, not {expected}");
    }
    let least = stats(&log).least_clearance.unwrap();
    assert!((least.metres - door).abs() < 1e-6 && least.tick == 9);
}

#[test]
fn speeds_joints_and_encoders_are_the_runs() {
    let there_and_back = script(vec![drive(1, 128, 0), drive(11, -64, 0), drive(21, 0, 0)]);
    let speed = series(&log_of(square("hitch", &[0.0; 3]), 30, there_and_back), Quantity::Speed).remove(0);
    assert_eq!((speed.points.len(), speed.points[0].0, speed.name().as_str()), (30, 1, "it"));
    for (tick, value) in speed.points {
        assert_close(
            value,
            if tick <= 10 {
                1.5
            } else if tick <= 20 {
                -0.75
            } else {
                0.0
            },
        );
    }

    let to = |tick, th1, th2| event(tick, "it", RobotInput::MoveTo(quantized(&[th1, th2])));
    let log = log_of(square("reach", &[0.25, -0.5]), 4, script(vec![to(1, 0.5, -0.5), to(3, 0.5, 0.75)]));
    let joints = series(&log, Quantity::Joints);
    assert_eq!([joints[0].name(), joints[1].name()], ["it theta1", "it theta2"]);
    assert_eq!(joints[0].points, [(0, 0.25), (1, 0.5), (2, 0.5), (3, 0.5), (4, 0.5)]);
    assert_eq!(joints[1].points, [(0, -0.5), (1, -0.5), (2, -0.5), (3, 0.75), (4, 0.75)]);
    assert!(series(&log, Quantity::Encoders).is_empty(), "an arm has none");

    // wheels of 0.033 m at 0.6 m/s, 360 counts a turn; slip shows in the true distance alone
    let log = log_of(square("rusty", &[0.0; 3]), 50, script(vec![drive(1, 128, 0)]));
    let both = series(&log, Quantity::Encoders);
    assert_eq!([both[0].name(), both[1].name()], ["it encoders", "it true"]);
    let count = std::f64::consts::TAU * 0.033 / 360.0;
    for (tick, metres) in &both[0].points {
        let rolled = 0.03 * *tick as f64;
        assert!((rolled - metres) > -1e-9 && (rolled - metres) < count + 1e-9, "{tick} {metres}");
    }
    let (tick, metres) = both[1].points[50];
    let x = log.frames()[49].robots[0].configuration[0];
    assert!(tick == 50 && metres >= x - 1e-9 && (metres - 1.5).abs() <= 0.05 * 1.5, "{metres} {x}");
    assert!((metres - 1.5).abs() > 1e-6, "slip makes a difference");
    assert!(series(&log, Quantity::Joints).is_empty(), "a rover has none");
}

/// A kind that nobody described has contacts and refusals alone.
#[test]
fn what_is_not_known_of_a_robot_is_not_made_up() {
    let mut log = log_of(square("rusty", &[0.0; 3]), 5, Script::empty());
    Arc::make_mut(&mut log.recipe.config).worlds[0].robots[0].kind = "x-own".into();
    let own = stats(&log);
    assert_eq!((own.path_length, own.least_clearance), (None, None));
    let kinds = Kinds::default().with_footprint("x-own", |q| Some(Footprint::disc(Point2::new(q[0], q[1]), 0.4)));
    let known = RunStats::of_kinds(&log, &kinds).robots.remove(0);
    assert!(known.path_length.is_some() && known.least_clearance.unwrap().metres < HALF - 0.4 + 1e-9);
}

/// What a line of a plot shows, seconds and values, read off the figure by the marks of its axes.
fn read_off(series: &[Series], quantity: Quantity, ticks: u64, width: f64, line: &str) -> Vec<[f64; 2]> {
    let run = RunPlot { quantity, series, ticks, seed: Seed(7), digest: String::new() };
    let figure = plot(&run, width).figure;
    let items = &figure.panels[0].picture.items;
    // the first and the last mark of an axis, each the figure beside it and its place
    let marks = |axis: &str, of: fn(&Point2) -> f64| -> [[f64; 2]; 2] {
        let marks = items.iter().filter_map(|item| {
            let text = item.id.strip_prefix(axis)?.replace('\u{2212}', "-");
            let Drawing::Polyline(ends) = &item.drawing else { panic!("{}", item.id) };
            Some([text.parse().unwrap(), of(&ends[0])])
        });
        let marks: Vec<[f64; 2]> = marks.collect();
        [marks[0], marks[marks.len() - 1]]
    };
    let (across, up) = (marks("tick/", |p| p.x), marks("grid/", |p| p.y));
    let value = |at: f64, [a, b]: [[f64; 2]; 2]| a[0] + (at - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
    let drawn = items.iter().find(|item| item.id == format!("line/{line}")).unwrap();
    let Drawing::Region { outline, .. } = &drawn.drawing else { panic!("lines") };
    // within the frame: down its left side, along its foot
    let Drawing::Polyline(frame) = &items.iter().find(|item| item.id == "axes").unwrap().drawing else { panic!() };
    let is_inside = |p: &Point2| (frame[1].x..=frame[2].x).contains(&p.x) && (frame[1].y..=frame[0].y).contains(&p.y);
    assert!(outline.iter().flatten().all(is_inside), "{line} leaves its frame");
    outline.iter().flatten().map(|p| [value(p.x, across), value(p.y, up)]).collect()
}

/// Fails unless the two lists are the same, and if they are short.
#[track_caller]
fn assert_line(found: &[[f64; 2]], expected: &[[f64; 2]]) {
    assert!(found.len() == expected.len() && found.len() > 40, "{} and {}", found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((0..2).all(|i| (found[i] - expected[i]).abs() < 1e-6), "{found:?}, not {expected:?}");
    }
}

#[test]
fn a_plot_shows_a_drive_back_and_forth_with_its_signs() {
    // by the channels: 1.5 m/s at 128, whichever way the wheels stand
    let legs: [(u64, i16, i16); 6] =
        [(1, 128, 0), (11, -64, 0), (21, 32, -128), (31, -128, 128), (46, 0, 0), (51, -16, 64)];
    let events = legs.iter().map(|(tick, v, phi)| drive(*tick, *v, *phi)).collect();
    let log = log_of(square("hitch", &[0.0; 3]), 60, script(events));
    let speed = |tick: u64| f64::from(legs.iter().rfind(|leg| leg.0 <= tick).unwrap().1) / 128.0 * 1.5;
    let expected: Vec<[f64; 2]> = (1..=60).map(|tick| [0.05 * tick as f64, speed(tick)]).collect();
    let speeds = series(&log, Quantity::Speed);
    assert_line(&read_off(&speeds, Quantity::Speed, 60, 900.0, "it"), &expected);

    // a rover straight ahead, back over its start, and ahead: its place is the distance that it has driven
    let rover = vec![drive(1, 128, 0), drive(16, -128, 0), drive(51, 100, 0)];
    let log = log_of(square("rusty", &[0.0; 3]), 70, script(rover));
    let both = series(&log, Quantity::Encoders);
    let place = |tick: usize| match tick {
        0 => 0.0,
        _ => {
            let ends = |tick: usize| if tick == 0 { log.initial().unwrap() } else { &log.frames()[tick - 1] };
            (1..=tick).fold(0.0, |gone, tick| {
                let [a, b] = [tick - 1, tick].map(|tick| &ends(tick).robots[0].configuration);
                // by the chord of the arc and its turn, which slip makes
                let (dx, dy, half) = (b[0] - a[0], b[1] - a[1], 0.5 * (b[2] - a[2]));
                let ahead = dx * cos(a[2]) + dy * sin(a[2]);
                gone + hypot(dx, dy) * ahead.signum() * if half == 0.0 { 1.0 } else { half / sin(half) }
            })
        }
    };
    let expected: Vec<[f64; 2]> = (0..=70).map(|tick| [0.05 * tick as f64, place(tick)]).collect();
    assert!(expected[15][1] > 0.4 && expected[50][1] < -0.5 && expected[70][1] > expected[50][1] + 0.4);
    assert_line(&read_off(&both, Quantity::Encoders, 70, 900.0, "it true"), &expected);
    // the encoders count whole steps of the wheels
    let step = std::f64::consts::TAU * 0.033 / 360.0;
    for [time, metres] in read_off(&both, Quantity::Encoders, 70, 900.0, "it encoders") {
        let tick = (time / 0.05).round() as i32;
        let rolled = 0.03 * f64::from(tick.min(15) - (tick - 15).clamp(0, 35))
            + 0.03 * 100.0 / 128.0 * f64::from((tick - 50).clamp(0, 20));
        assert!((metres - rolled).abs() < step + 1e-6, "{time} s: {metres}, not {rolled}");
    }
}

#[test]
fn lines_left_out_of_a_plot_are_the_last_ones() {
    let to = RobotInput::MoveTo(quantized(&[0.5, 0.25]));
    let log = log_of(square("reach", &[0.0; 2]), 10, script(vec![event(1, "it", to)]));
    let (config, kinds) = (&log.recipe.config, Kinds::default());
    let both = series(&log, Quantity::Joints);
    let ends: Vec<f64> = both.iter().map(|line| line.points.last().unwrap().1).collect();
    assert_eq!(ends, [0.5, 0.25], "a line for each joint");
    for (most, left) in [(0, 0), (1, 1), (2, 2), (3, 2)] {
        let mut gatherer = SeriesGatherer::new(Quantity::Joints, config, &log.recipe.script, &kinds, |_| true);
        gatherer.truncate(most);
        assert_eq!(gatherer.lines(), left);
        std::iter::once(log.initial().unwrap()).chain(log.frames()).for_each(|frame| gatherer.see(frame));
        assert_eq!(gatherer.series(), both[..left]);
    }
}

#[test]
fn a_column_is_the_one_of_its_name() {
    for (i, column) in StatsColumn::ALL.iter().enumerate() {
        let same = StatsColumn::ALL.iter().map(|other| other == column);
        assert_eq!(same.collect::<Vec<_>>(), (0..7).map(|k| k == i).collect::<Vec<_>>(), "{}", column.name);
        assert_eq!(StatsColumn::named(column.name), Some(*column));
    }
    assert_eq!(StatsColumn::named("contact"), None);
}
