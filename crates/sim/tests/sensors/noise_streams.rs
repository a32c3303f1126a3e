//! Random numbers of a run: every robot's sensor and wheels have streams of their own, named by the robot, and the
//! draws have the documented distributions.

use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};

use motion_lab_core::num::{cos, sin, sqrt};
use motion_lab_core::prelude::*;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{Event, Frame, Log, RobotInput, Script};
use motion_lab_sim::tour::TourConfig;

/// Rays of every sensor, and their range, which is beyond everything in the square.
const RAYS: u32 = 24;
const RANGE: f64 = 16.0;
/// Half the width of the square.
const HALF: f64 = 4.0;

/// A rover at (x, y), with `noise` as a world file writes it.
fn rover(name: &str, (x, y): (f64, f64), noise: &str) -> String {
    let sensor = if noise.is_empty() { String::new() } else { format!(", sensor: ({noise})") };
    format!("(name: \"{name}\", kind: \"rusty\", start: [{x:?}, {y:?}, 0]{sensor})")
}

/// A walled square with these robots.
fn square(name: &str, robots: &[String]) -> World {
    let text = format!(
        "World(version: 1, name: \"{name}\", bounds: (min: (-4, -4), max: (4, 4)),
         walls: [(name: \"the wall\", points: [(-4, -4), (4, -4), (4, 4), (-4, 4)], closed: true)], robots: [{}])",
        robots.join(", ")
    );
    World::parse("square.ron", &text).unwrap()
}

/// A run in which only driven robots move.
fn run(worlds: Vec<World>, ticks: u64, drive: &[(&str, i16, i16)]) -> Log {
    let sensor = Some(RangeSensor { n_rays: RAYS, max_range: RANGE });
    let input =
        |&(robot, a, b): &(&str, i16, i16)| Event { tick: 1, robot: robot.into(), input: RobotInput::Drive(a, b) };
    let script = Script { events: drive.iter().map(input).collect(), ..Script::empty() };
    Run::record(TourConfig { worlds, ticks, sensor }, (Seed(77), script)).unwrap()
}

fn frames(log: &Log) -> impl Iterator<Item = &Frame> {
    std::iter::once(log.initial().unwrap()).chain(log.frames())
}

/// The readings of the sensor of a robot, tick after tick.
fn readings(log: &Log, robot: &str) -> Vec<f64> {
    let id = log.recipe.config.robot_names().position(|name| name == robot).unwrap() as u32;
    let scans = frames(log).flat_map(|frame| frame.scans.iter().filter(move |scan| scan.robot == id));
    scans.flat_map(|scan| scan.ranges.iter().copied()).collect()
}

/// Sorted bit patterns that two lists have in common.
fn common(a: &[f64], b: &[f64]) -> usize {
    let set: BTreeSet<u64> = a.iter().map(|x| x.to_bits()).collect();
    b.iter().filter(|x| set.contains(&x.to_bits())).count()
}

/// The Kolmogorov-Smirnov statistic of numbers that should be uniform in [0, 1): the largest gap between x and the
/// share of numbers up to x, times the root of their number. It is above 2.3 in one of twenty thousand lists.
fn from_uniform(numbers: &[f64]) -> f64 {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len() as f64;
    let gaps = sorted.iter().enumerate().flat_map(|(k, u)| [u - k as f64 / n, (k + 1) as f64 / n - u]);
    sqrt(n) * gaps.fold(0.0, |m, gap| if gap > m { gap } else { m })
}

/// The correlation of two lists, in standard deviations of independent lists: above 5 in one of two million pairs.
fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len().min(b.len());
    let mean = |x: &[f64]| x[..n].iter().sum::<f64>() / n as f64;
    let (ma, mb) = (mean(a), mean(b));
    let product =
        |x: &[f64], mx: f64, y: &[f64], my: f64| x.iter().zip(y).take(n).map(|(x, y)| (x - mx) * (y - my)).sum::<f64>();
    (product(a, ma, b, mb) / sqrt(product(a, ma, a, ma) * product(b, mb, b, mb)) * sqrt(n as f64)).abs()
}

/// A sensor with random readings only: each reading is the range times one draw, whatever is ahead.
#[test]
fn every_sensor_draws_numbers_of_its_own() {
    let noise = "z_rand: 1";
    let west = square("west", &[rover("a", (-2.0, 0.0), noise), rover("b", (2.0, 0.0), noise)]);
    let east = square("east", &[rover("c", (-2.0, 0.0), noise), rover("d", (2.0, 0.0), noise)]);
    let log = run(vec![west, east], 120, &[]);
    let draws = ["a", "b", "c", "d"].map(|name| readings(&log, name).iter().map(|r| r / RANGE).collect::<Vec<f64>>());
    for (i, a) in draws.iter().enumerate() {
        assert_eq!(a.len(), 121 * RAYS as usize);
        assert!(from_uniform(a) < 2.3, "sensor {i}: {}", from_uniform(a));
        // no draw serves two rays or two ticks, and neighbouring draws are uncorrelated
        let distinct: BTreeSet<u64> = a.iter().map(|u| u.to_bits()).collect();
        assert_eq!(distinct.len(), a.len(), "sensor {i}");
        for lag in [1, RAYS as usize - 1, RAYS as usize, RAYS as usize + 1] {
            assert!(correlation(a, &a[lag..]) < 5.0, "sensor {i} at a lag of {lag}");
        }
        for (j, b) in draws[..i].iter().enumerate() {
            assert_eq!(common(a, b), 0, "sensors {j} and {i} draw the same numbers");
            assert!(correlation(a, b) < 5.0, "sensors {j} and {i}");
        }
    }
}

#[test]
fn another_robot_or_sensor_changes_nobodys_noise() {
    let a = || rover("a", (-2.0, 0.0), "z_rand: 1");
    let alone = run(vec![square("home", &[a()])], 40, &[("a", 0, 60)]);
    let (numbers, states) = (readings(&alone, "a"), |log: &Log| -> Vec<_> {
        let id = log.recipe.config.robot_names().position(|name| name == "a").unwrap();
        frames(log).map(|f| (f.robots[id].configuration.to_vec(), f.robots[id].extra.to_vec())).collect()
    });
    let companies = [
        vec![square("home", &[a(), rover("b", (2.0, 2.0), "z_rand: 1")])],
        vec![square("home", &[rover("b", (2.0, 2.0), "sigma_hit: 0.1"), a()])],
        vec![square("home", &[rover("b", (2.0, 2.0), ""), rover("c", (2.0, -2.0), "z_max: 1"), a()])],
        vec![square("away", &[rover("b", (-2.0, 0.0), "z_rand: 1")]), square("home", &[a()])],
        vec![square("home", &[a(), "(name: \"arm\", kind: \"reach3\", start: [0.1, 0.2, 0.3])".to_owned()])],
    ];
    for worlds in companies {
        let others: Vec<String> = worlds.iter().flat_map(|w| &w.robots).map(|r| r.name.clone()).collect();
        // driven robots draw slip of their own
        let mut drive = vec![("a", 0, 60)];
        drive.extend(
            others.iter().filter(|name| ["b", "c"].contains(&name.as_str())).map(|name| (name.as_str(), 0, -90)),
        );
        let log = run(worlds, 40, &drive);
        assert_eq!(readings(&log, "a"), numbers, "among {others:?} its sensor reads otherwise");
        assert_eq!(states(&log), states(&alone), "among {others:?} its wheels slip otherwise");
    }
}

/// By the documentation of `SensorNoise`, ray k of tick t draws at index t n + k; by that of `BeamModel`, it draws its
/// kind first, then its place. Slip is drawn at the tick's index, the left wheel's first.
#[test]
fn the_streams_are_named_by_the_robot_and_drawn_at_the_ticks_index() {
    let robots = [rover("Ada", (0.0, 0.0), "z_rand: 1"), rover("Bob", (2.0, 2.0), "z_rand: 1")];
    let log = run(vec![square("home", &robots)], 30, &[("Ada", 0, 128), ("Bob", 0, -128)]);
    for (id, name) in ["Ada", "Bob"].into_iter().enumerate() {
        let (beam, slip) = (format!("{name}/beam"), format!("{name}/slip"));
        let (beam, slip) = (Stream::new(Seed(77), &beam), Stream::new(Seed(77), &slip));
        for (i, reading) in readings(&log, name).into_iter().enumerate() {
            let mut draws = beam.at(i as u64);
            draws.bits();
            assert_eq!(reading, RANGE * draws.unit(), "{name}, ray {} of tick {}", i as u32 % RAYS, i as u32 / RAYS);
        }
        for (tick, factors) in (1..).zip(slips(&log, id)) {
            let mut draws = slip.at(tick);
            for factor in factors {
                let stated = 1.0 + 0.05 * (2.0 * draws.unit() - 1.0);
                assert!((factor - stated).abs() < 1e-11, "{name}, tick {tick}: {factor}, not {stated}");
            }
        }
    }
}

/// The slip of both wheels of a rover in every tick, left first: the ground covered divided by the length rolled, which
/// must not be 0. A differential drive whose wheels cover l and r goes (l + r) / 2 ahead along an arc and turns by (r -
/// l) / track.
pub fn slips(log: &Log, id: usize) -> Vec<[f64; 2]> {
    let all: Vec<&Frame> = frames(log).collect();
    let pair = |pair: &[&Frame]| {
        let [before, after] = [0, 1].map(|i| &pair[i].robots[id]);
        let q = |i: usize| after.configuration[i] - before.configuration[i];
        let turn = q(2) % TAU;
        let turn = if turn.abs() > PI { turn - TAU.copysign(turn) } else { turn };
        // along the chord, whose heading is the mean one; the arc is longer by half the turn over its sine
        let mean = before.configuration[2] + 0.5 * turn;
        let half = 0.5 * turn;
        let ahead = (q(0) * cos(mean) + q(1) * sin(mean)) * if half == 0.0 { 1.0 } else { half / sin(half) };
        let ground = [ahead - 0.5 * RUSTY.track * turn, ahead + 0.5 * RUSTY.track * turn];
        [0, 1].map(|wheel| ground[wheel] / ((after.extra[wheel] - before.extra[wheel]) * RUSTY.wheel_radius))
    };
    all.windows(2).map(pair).collect()
}

#[test]
fn slip_is_uniform_within_its_limits_and_each_wheel_has_its_own() {
    let robots = [rover("a", (-2.0, 0.0), ""), rover("b", (2.0, 0.0), "")];
    let log = run(vec![square("home", &robots)], 600, &[("a", 0, 128), ("b", 0, 128)]);
    let unit = |factor: f64| 0.5 * (factor - 1.0) / RUSTY.max_slip + 0.5;
    let wheels: Vec<Vec<f64>> =
        (0..2).flat_map(|id| [0, 1].map(|wheel| slips(&log, id).iter().map(|s| unit(s[wheel])).collect())).collect();
    for (i, a) in wheels.iter().enumerate() {
        assert!(a.iter().all(|u| (-1e-9..1.0 + 1e-9).contains(u)), "wheel {i} slips more than it may");
        assert!(from_uniform(a) < 2.3 && correlation(a, &a[1..]) < 5.0, "wheel {i}: {}", from_uniform(a));
        for (j, b) in wheels[..i].iter().enumerate() {
            assert!(correlation(a, b) < 5.0, "wheels {j} and {i}");
        }
    }
}

/// The exact range in the square from (x, y), by its nearest wall ahead.
fn to_the_wall((x, y): (f64, f64), ray: usize) -> f64 {
    let bearing = TAU * (ray % RAYS as usize) as f64 / f64::from(RAYS);
    let wall = |at: f64, along: f64| if along == 0.0 { f64::INFINITY } else { (HALF.copysign(along) - at) / along };
    let (across, up) = (wall(x, cos(bearing)), wall(y, sin(bearing)));
    if across < up { across } else { up }
}

#[test]
fn hits_stray_by_the_stated_deviation_alike_at_every_range_ray_and_tick() {
    for sigma in [0.01, 0.05, 0.25] {
        let at = [(-1.75, 0.5), (1.0, -1.25)];
        let noise = format!("sigma_hit: {sigma}");
        // in two worlds, so that neither sees the other
        let worlds = vec![square("west", &[rover("a", at[0], &noise)]), square("east", &[rover("b", at[1], &noise)])];
        let log = run(worlds, 200, &[]);
        let strays = [("a", at[0]), ("b", at[1])].map(|(name, place)| {
            let errors = readings(&log, name).into_iter().enumerate();
            errors.map(|(i, reading)| (reading - to_the_wall(place, i)) / sigma).collect::<Vec<f64>>()
        });
        assert!(correlation(&strays[0], &strays[1]) < 5.0, "sigma {sigma}: two sensors stray together");
        for (k, all) in strays.iter().enumerate() {
            let near = |ray: &usize| to_the_wall(at[k], *ray) < 3.2;
            let (n, of) = (all.len(), |keep: &dyn Fn(usize) -> bool| -> Vec<f64> {
                all.iter().enumerate().filter(|(i, _)| keep(*i)).map(|(_, z)| *z).collect()
            });
            for part in [of(&|_| true), of(&|i| near(&i)), of(&|i| !near(&i)), of(&|i| i < n / 2)] {
                // a mean of n normal numbers deviates by 1 / sqrt(n), their mean square by sqrt(2 / n)
                let count = part.len() as f64;
                let (mean, square) =
                    (part.iter().sum::<f64>() / count, part.iter().map(|z| z * z).sum::<f64>() / count);
                assert!(count > 1_000.0 && mean.abs() < 5.0 / sqrt(count), "sigma {sigma}: mean {mean}");
                assert!((square - 1.0).abs() < 5.0 * sqrt(2.0 / count), "sigma {sigma}: mean square {square}");
            }
            for lag in [1, RAYS as usize] {
                assert!(correlation(all, &all[lag..]) < 5.0, "sigma {sigma}, a lag of {lag}");
            }
        }
    }
}
