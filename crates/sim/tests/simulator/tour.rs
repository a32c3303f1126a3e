//! The tours of the robots.

use std::f64::consts::TAU;

use motion_lab_core::prelude::*;
use motion_lab_sim::recording::{Recorder, Run, final_lines};
use motion_lab_sim::run::{Digest, Frame};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

use super::tour;
use oracle::fixtures::count_from_env;

/// The seeds for which the tours are tested.
fn seeds() -> impl Iterator<Item = Seed> {
    // the gate runs them all, optimised
    let usual = if cfg!(debug_assertions) { 100 } else { 1000 };
    (0..count_from_env("MOTION_LAB_SEEDS", usual)).map(Seed).chain([BOOK_SEED])
}

#[test]
fn tour_replays_bitwise() {
    let log = Run::record(TourConfig::default(), BOOK_SEED).unwrap();
    let again = Run::record(TourConfig::default(), BOOK_SEED).unwrap();
    assert_eq!(log.frames().len(), 1200);
    assert_eq!((log.frames()[0].tick, log.frames()[1199].tick, log.initial().unwrap().tick), (1, 1200, 0));
    // the digests distinguish -0.0 from 0.0, which == does not
    assert_eq!(log, again);
    let replayed = Run::replay(&log).unwrap();
    assert_eq!(replayed, log.frames());
    assert!(replayed.iter().map(Frame::digest).eq(log.frames().iter().map(Frame::digest)));
}

/// The book's run, pinned as a regression: a change of these digits changes every printed run.
#[test]
fn tour_at_book_seed() {
    let log = Run::record(TourConfig::default(), BOOK_SEED).unwrap();
    assert_eq!(
        final_lines(&log),
        [
            "Rusty  Pose2 { x: 9.632, y: 6.023 }  contacts: 0",
            "Reach  T2 { th1: 1.984, th2: 0.523 }  contacts: 18",
            "Hitch  Pose2 { x: 12.795, y: 4.150, theta: 0.763 }  contacts: 5",
        ]
    );
}

#[test]
fn another_seed_changes_every_final_coordinate_and_the_first_restores_each() {
    let last = |seed| Run::record(tour(1200), Seed(seed)).unwrap().into_frames().pop().unwrap();
    let (a, b) = (last(2005), last(2006));
    for (x, y) in a.robots.iter().zip(&b.robots) {
        for (x, y) in x.configuration.iter().zip(&y.configuration) {
            assert_ne!(x, y);
        }
    }
    assert_eq!(a, last(2005));
}

#[test]
fn the_tours_keep_their_promises() {
    let mut hitch_hits = 0;
    let (mut reach_hits, mut runs) = (0, 0);
    for seed in seeds() {
        let mut run = Recorder::new(tour(1200), seed).unwrap();
        let (mut laps, mut waypoint) = (0, 0.0);
        while !run.is_complete() {
            let next = run.step().robots[0].extra[2];
            laps += usize::from(next < waypoint);
            waypoint = next;
        }
        let [rusty, reach, hitch] = &run.frame().robots[..] else { panic!("three robots") };
        assert!(laps >= 1, "seed {seed}: Rusty completes a loop in the minute");
        assert_eq!(rusty.contacts, 0, "seed {seed}: Rusty touches nothing");
        runs += 1;
        reach_hits += usize::from(reach.contacts > 0);
        hitch_hits += usize::from(hitch.contacts > 0);
        if seed == BOOK_SEED {
            assert!(reach.contacts > 0 && hitch.contacts > 0, "at the book's seed both meet something");
        }
    }
    assert_eq!(reach_hits, runs, "Reach meets obstacles whatever the seed");
    assert!(2 * hitch_hits > runs, "Hitch meets curb or pillar more often than not");
}

#[test]
fn slip_is_the_tour_s_only_chance_for_rusty_and_bounded() {
    // with two seeds the wheels turn by nearly the same, and the places differ
    let at = |seed| Run::record(tour(40), Seed(seed)).unwrap().into_frames().pop().unwrap().robots.swap_remove(0);
    let (a, b) = (at(1), at(2));
    assert_ne!(a.configuration, b.configuration);
    let apart = Vector2::new(a.configuration[0] - b.configuration[0], a.configuration[1] - b.configuration[1]).norm();
    let rolled = 0.5 * (a.extra[0] + a.extra[1]) * RUSTY.wheel_radius;
    assert!(apart < 4.0 * RUSTY.max_slip * rolled, "{apart} apart after {rolled}");
}

#[test]
fn the_encoders_count_what_the_wheels_turned() {
    let mut run = Recorder::new(tour(100), Seed(3)).unwrap();
    let mut before = [0.0; 2];
    while !run.is_complete() {
        let turned = [run.step().robots[0].extra[0], run.frame().robots[0].extra[1]];
        // 360 counts per turn; only whole counts are read
        let counts = turned.map(|angle| (angle * 360.0 / TAU).floor() as i64);
        let read = run.view()[0].encoders.unwrap();
        assert_eq!([read.left, read.right], counts, "after {turned:?} rad at tick {}", run.frame().tick);
        let most = (RUSTY.max_speed + 0.5 * RUSTY.track * RUSTY.max_turn_rate) * 0.05 / RUSTY.wheel_radius;
        assert!(turned.iter().zip(before).all(|(now, then)| (now - then).abs() <= most * (1.0 + 1e-12)));
        before = turned;
    }
    assert!(before[0] != before[1] && before[0] > 10.0, "both wheels turn, each by its own: {before:?}");
}

/// The digests of a run's frames.
fn digests(seed: u64) -> Vec<Digest> {
    Run::record(tour(60), Seed(seed)).unwrap().frames().iter().map(Frame::digest).collect()
}

#[test]
fn runs_on_many_threads_are_the_run() {
    let alone: Vec<_> = (0..8).map(digests).collect();
    for threads in [2, 8] {
        let many: Vec<_> = std::thread::scope(|scope| {
            let workers: Vec<_> = (0..threads)
                .map(|k| {
                    let mine = (0..8).filter(move |s| s % threads == k);
                    scope.spawn(move || mine.map(|s| (s, digests(s))).collect::<Vec<_>>())
                })
                .collect();
            workers.into_iter().flat_map(|w| w.join().unwrap()).collect()
        });
        assert!(many.len() == 8 && many.iter().all(|(s, digests)| *digests == alone[*s as usize]));
    }
}
