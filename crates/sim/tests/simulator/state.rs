//! The state: keyframes, restoring, seeking, and the limits of a frame.

use motion_lab_core::prelude::*;
use motion_lab_sim::recording::{Recorder, Run};
use motion_lab_sim::run::{Frame, Log, LogKind, Recipe};
use motion_lab_sim::tour::TourConfig;

use super::crowd::arena;
use super::{assert_same, tour, wild_script};
use crate::shrink::witness::assert_holds;

fn numbers(frame: &Frame) -> impl Iterator<Item = f64> {
    let robots = frame.robots.iter().flat_map(|r| r.configuration.iter().chain(&r.extra).chain(&r.target));
    robots.chain(frame.scans.iter().flat_map(|s| s.ranges.iter())).copied()
}

/// Compares a fresh run with its replay, and with seeks and restores to ticks drawn from its seed.
pub(crate) fn compare_ways(recipe: &Recipe) -> Result<(), String> {
    let ticks = recipe.config.ticks;
    let Ok(log) = Run::record_recipe(recipe.clone(), LogKind::Frames, |_| {}) else { return Ok(()) };
    if ticks == 0 {
        return Ok(());
    }
    let recorded = |k: u64| if k == 0 { log.initial().unwrap() } else { &log.frames()[k as usize - 1] };
    let same = |how: &str, frame: &Frame, k: u64| {
        let same = frame == recorded(k) && frame.digest() == recorded(k).digest();
        if same { Ok(()) } else { Err(format!("{how}, tick {k} has other bits")) }
    };
    if Run::replay(&log).unwrap() != log.frames() {
        return Err("replayed it is another run".into());
    }
    let mut draws = Stream::new(recipe.seed, "seeks");
    let mut run = Recorder::of(recipe).unwrap();
    for _ in 0..8 {
        // back and forth, over keyframes and between them
        let k = draws.below(ticks + 1);
        same("sought", run.seek(k).unwrap(), k)?;
    }
    for _ in 0..5 {
        // into the middle of a fresh run, straight from the log
        let k = draws.below(ticks);
        let mut run = Recorder::of(recipe).unwrap();
        run.restore(recorded(k)).unwrap();
        same("restored", run.frame(), k)?;
        for ahead in k + 1..=(k + 20).min(ticks) {
            same(&format!("restored at tick {k}"), run.step(), ahead)?;
        }
    }
    same("sought", run.seek(0).unwrap(), 0)
}

#[test]
fn fresh_run_restore_seek_and_replay_are_the_same_bits() {
    for seed in 0..4 {
        assert_holds(&Recipe::new(tour(260), (Seed(seed), wild_script(seed, 260))), compare_ways);
    }
}

#[test]
fn no_frame_holds_a_nan_or_a_negative_zero() {
    for seed in 10..16 {
        let log = Run::record(tour(300), (Seed(seed), wild_script(seed, 300))).unwrap();
        for frame in log.frames().iter().chain([log.initial().unwrap()]) {
            for x in numbers(frame) {
                let negative_zero = x == 0.0 && x.is_sign_negative();
                assert!(!x.is_nan() && !negative_zero, "tick {} holds {x:?}", frame.tick);
            }
            assert!(frame.robots.iter().enumerate().all(|(i, r)| r.id as usize == i));
        }
    }
}

#[test]
fn a_start_at_negative_zero_is_one_at_zero() {
    let at = |x: f64| {
        let robots: [(&str, &str, &[f64]); 2] = [("Rusty", "rusty", &[x, x, x]), ("Hitch", "hitch", &[x, x, 0.5, x])];
        let worlds = vec![arena(20.0, &robots[..1]), arena(20.0, &robots[1..])];
        Run::record(TourConfig { worlds, ticks: 3, sensor: None }, Seed(1)).unwrap()
    };
    let (minus, plus) = (at(-0.0), at(0.0));
    assert_same(minus.initial().unwrap(), plus.initial().unwrap());
    let digests = |log: &Log| log.frames().iter().map(Frame::digest).collect::<Vec<_>>();
    assert_eq!(digests(&minus), digests(&plus));
}

#[test]
fn a_frame_of_another_run_is_refused() {
    let log = Run::record(tour(3), Seed(1)).unwrap();
    let mut run = Recorder::new(tour(3), Seed(1)).unwrap();
    let refused = |run: &mut Recorder, change: &dyn Fn(&mut Frame)| {
        let mut frame = log.frames()[2].clone();
        change(&mut frame);
        run.restore(&frame).unwrap_err().to_string()
    };
    assert!(refused(&mut run, &|f| drop(f.robots.pop())).contains("2 robots, the run has 3"));
    assert!(refused(&mut run, &|f| f.robots[1].id = 7).contains("robot 7"));
    assert!(refused(&mut run, &|f| f.robots[0].configuration.push(1.0)).contains("robot 0"));
    assert!(refused(&mut run, &|f| f.robots[0].configuration[0] = f64::NAN).contains("robot 0"));
    assert!(refused(&mut run, &|f| f.robots[0].extra.clear()).contains("robot 0"));
    run.restore(&log.frames()[2]).unwrap();
    assert_same(run.frame(), &log.frames()[2]);
}
