//! The state: keyframes, restoring, seeking, and the limits of a frame.

use motion_lab_core::prelude::*;
use motion_lab_sim::recording::{Recorder, Run};
use motion_lab_sim::run::{Frame, Log};
use motion_lab_sim::tour::TourConfig;

use super::crowd::arena;
use super::{assert_same, tour, wild_script};

fn numbers(frame: &Frame) -> impl Iterator<Item = f64> {
    let robots = frame.robots.iter().flat_map(|r| r.configuration.iter().chain(&r.extra).chain(&r.target));
    robots.chain(frame.scans.iter().flat_map(|s| s.ranges.iter())).copied()
}

#[test]
fn fresh_run_restore_seek_and_replay_are_the_same_bits() {
    let ticks = 260;
    for seed in 0..4 {
        let input = (Seed(seed), wild_script(seed, ticks));
        let log = Run::record(tour(ticks), input.clone()).unwrap();
        let frame = |k: u64| if k == 0 { log.initial().unwrap() } else { &log.frames()[k as usize - 1] };
        assert_eq!(Run::replay(&log).unwrap(), log.frames());

        let mut draws = Stream::new(Seed(seed), "seeks");
        let mut run = Recorder::new(tour(ticks), input.clone()).unwrap();
        for _ in 0..8 {
            // back and forth, over keyframes and between them
            let k = draws.below(ticks + 1);
            assert_same(run.seek(k).unwrap(), frame(k));
        }
        for _ in 0..5 {
            // into the middle of a fresh run, straight from the log
            let k = draws.below(ticks);
            let mut run = Recorder::new(tour(ticks), input.clone()).unwrap();
            run.restore(frame(k)).unwrap();
            assert_same(run.frame(), frame(k));
            for ahead in k + 1..=(k + 20).min(ticks) {
                assert_same(run.step(), frame(ahead));
            }
        }
        assert_same(run.seek(0).unwrap(), log.initial().unwrap());
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
