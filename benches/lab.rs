//! The cost of each operation: the four queries, an edge, a scan, a tick, the minute's tour.
//!
//! `cargo bench --no-default-features --features headless --bench lab`
#![allow(missing_docs, clippy::unwrap_used)]

use std::f64::consts::PI;
use std::hint::black_box;

use divan::Bencher;
use motion_lab::collision::{Certificate, Checker, Collision, Scene};
use motion_lab::prelude::*;
use motion_lab::recording::{Recorder, Run};
use motion_lab::sensors::RangeSensor;
use motion_lab::tour::{BOOK_SEED, TourConfig};

#[global_allocator]
static ALLOCATOR: divan::AllocProfiler = divan::AllocProfiler::system();

fn main() {
    divan::main();
}

/// Number of configurations that each query bench goes through.
const CONFIGURATIONS: usize = 256;

fn arm() -> (Checker<Reach<2>>, Vec<Footprint>) {
    prepared(Checker::new(Scene::workbench(), Reach::<2>::workbench()))
}

fn prepared<R: Robot>(checker: Checker<R>) -> (Checker<R>, Vec<Footprint>) {
    let mut s = Stream::new(Seed(1), "bench");
    let bounds = checker.scene().bounds();
    let footprints = (0..CONFIGURATIONS)
        .map(|_| checker.robot().footprint(&checker.robot().sample(bounds.min, bounds.max, &mut s)))
        .collect();
    (checker, footprints)
}

mod query {
    use super::*;

    fn each(bencher: Bencher, ask: impl Fn(&Scene, &Footprint) -> bool) {
        let (checker, footprints) = arm();
        let mut next = footprints.iter().cycle();
        bencher.bench_local(|| ask(checker.scene(), next.next().unwrap()));
    }

    #[divan::bench]
    fn intersects(bencher: Bencher) {
        each(bencher, |scene, f| scene.intersects(f));
    }

    #[divan::bench]
    fn distance(bencher: Bencher) {
        each(bencher, |scene, f| scene.distance(f) == 0.0);
    }

    #[divan::bench]
    fn witness(bencher: Bencher) {
        each(bencher, |scene, f| scene.witness(f).is_some());
    }

    #[divan::bench]
    fn swept(bencher: Bencher) {
        let (checker, footprints) = arm();
        let mut pairs = footprints.iter().zip(footprints.iter().skip(1)).cycle();
        bencher.bench_local(|| {
            let (a, b) = pairs.next().unwrap();
            checker.scene().swept(a, b)
        });
    }
}

mod edge {
    use super::*;

    fn edges<R: Robot>(bencher: Bencher, checker: &Checker<R>) {
        let mut s = Stream::new(Seed(2), "bench");
        let bounds = checker.scene().bounds();
        // an edge that starts in contact costs only one query and would flatter the average
        let mut draw = || {
            loop {
                let q = checker.robot().sample(bounds.min, bounds.max, &mut s);
                if checker.is_free(&q) {
                    break q;
                }
            }
        };
        let pairs: Vec<_> = (0..CONFIGURATIONS).map(|_| (draw(), draw())).collect();
        let mut next = pairs.iter().cycle();
        let mut certificate = Certificate::new();
        bencher.bench_local(|| {
            let (a, b) = next.next().unwrap();
            checker.edge_certified(a, b, &mut certificate).unwrap()
        });
    }

    #[divan::bench]
    fn rusty_apartment(bencher: Bencher) {
        edges(bencher, &Checker::new(Scene::apartment(), RustyDisc::default()));
    }

    #[divan::bench]
    fn reach_workbench(bencher: Bencher) {
        edges(bencher, &Checker::new(Scene::workbench(), Reach::<2>::workbench()));
    }

    #[divan::bench]
    fn hitch_lot(bencher: Bencher) {
        edges(bencher, &Checker::new(Scene::lot(), HITCH.with_trailer()));
    }
}

#[divan::bench]
fn scan_360_rays(bencher: Bencher) {
    let scene = Scene::apartment();
    let sensor = RangeSensor { n_rays: 360, max_range: 4.0 };
    let mut headings = (0..CONFIGURATIONS).map(|k| k as f64 * 2.0 * PI / CONFIGURATIONS as f64).cycle();
    bencher.bench_local(|| {
        let (s, c) = motion_lab::num::sin_cos(headings.next().unwrap());
        sensor.scan(&scene, Point2::new(6.0 + 0.3 * c, 4.0 + 0.3 * s))
    });
}

#[divan::bench(sample_count = 20)]
fn tick(bencher: Bencher) {
    let mut recorder = Recorder::new(TourConfig::default(), BOOK_SEED).unwrap();
    bencher.bench_local(|| {
        recorder.step();
    });
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn minute_recorded() {
    black_box(Run::record(TourConfig::default(), BOOK_SEED).unwrap());
}
