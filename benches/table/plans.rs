//! Planners: from the start to the certified path, beside one edge of the same scene.

use std::hint::black_box;
use std::time::Instant;

use motion_lab::collision::ChainChecker;
use motion_lab::planning::{Bounds, RrtConnect, solve};
use motion_lab::prelude::*;

use crate::Table;
use crate::measure::{Timing, is_timed};
use crate::row::{Mark, Row};

/// The number of seeds.
const SEEDS: u64 = 1000;

/// How often an edge is asked about in one measurement.
const EDGES: u32 = 200;

fn round_the_post(seed: u64) -> Problem<Reach<2>> {
    let checker = ChainChecker::new(Scene::workbench(), Reach::<2>::workbench());
    Problem::try_new(checker, T2::new(2.0, 0.0), T2::new(3.1, 0.0), Seed(seed)).expect("both ends are free")
}

/// The nanoseconds that some work takes.
fn time<T>(work: impl FnOnce() -> T) -> f64 {
    let start = Instant::now();
    black_box(work());
    start.elapsed().as_secs_f64() * 1e9
}

/// For every seed, in turns: one plan, and the mean of many questions about one edge between two free configurations.
fn plan_and_edge(seeds: u64) -> [Timing; 2] {
    let (mut plans, mut edges) = (Vec::new(), Vec::new());
    for seed in 0..seeds {
        let problem = round_the_post(seed);
        let mut ends = problem.clone();
        let [a, b] = [0, 1].map(|_| ends.sample_free(1000).expect("most of the space is free"));
        let checker = problem.checker().clone();
        plans.push(time(|| solve(&mut RrtConnect::new(problem), &Bounds::default()).expect("there is a way")));
        edges.push(time(|| (0..EDGES).filter(|_| checker.edge_free(black_box(&a), &b)).count()) / f64::from(EDGES));
    }
    [Timing::of("", plans), Timing::of("one edge_free", edges)]
}

pub fn rows(table: &mut Table) {
    let work = "RRT-Connect, Reach round the post, start to certified path, median of 1,000 seeds";
    if table.wants(work) {
        let [plan, edge] = plan_and_edge(if is_timed() { SEEDS } else { 3 });
        table.push(Row::new(work.into(), Mark::at_most(250.0, " edges"), &plan, &[edge]));
    }
}
