//! Planners: from the start to the certified path, beside one edge of the same scene; what cars drive, beside an edge.

use std::f64::consts::FRAC_PI_2;
use std::hint::black_box;
use std::time::Instant;

use motion_lab::collision::{CarChecker, ChainChecker};
use motion_lab::planning::hybrid::HybridAStar;
use motion_lab::planning::{Bounds, RrtConnect, solve};
use motion_lab::prelude::*;

use crate::Table;
use crate::measure::{Entrant, Timing, is_timed, race};
use crate::pairs;
use crate::row::{self, Mark, Row, Verdict};
use crate::worlds::CASES;

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

/// The car with its trailer, to be parked in bay 2 of the Lot from where its resident starts.
fn into_bay_2() -> Problem<Hitch> {
    let at = |x, y, heading| HitchCfg { body: Pose2::new(x, y, heading), trailer: Some(heading) };
    let checker = CarChecker::new(Scene::lot(), HITCH.with_trailer());
    Problem::try_new(checker, at(6.5, 2.5, 0.0), at(6.75, 7.0, -FRAC_PI_2), Seed(2005)).expect("both ends are free")
}

/// Arcs of a second from free configurations in the Lot, free or not, beside the straight edges to their ends.
fn arcs(car: Hitch) -> Vec<Timing> {
    let (lot, cases) = pairs::drives(car);
    race(vec![
        Entrant::new("", CASES, |i| {
            let (q, u, _) = &cases[i];
            car.drive(q, u, 1.0).is_ok_and(|arc| lot.motion_free(&arc))
        }),
        Entrant::new("edge_free", CASES, |i| lot.edge_free(&cases[i].0, &cases[i].2)),
        Entrant::new("driven, not asked", CASES, |i| car.drive(&cases[i].0, &cases[i].1, 1.0)),
    ])
}

pub fn rows(table: &mut Table) {
    for (work, car, most) in [
        ("plans: car's arc of 1 s, integrated, free or not", HITCH, 2.0),
        ("plans: car and trailer's arc of 1 s, integrated, free or not", HITCH.with_trailer(), 4.0),
    ] {
        if table.wants(work) {
            let [arc, edge, driven] = &arcs(car)[..] else { return };
            // an arc counts as the straight edges to its end
            table.push(Row::new(work.into(), Mark::at_most(most, " edges"), arc, std::slice::from_ref(edge)));
            table.push(Row::note(format!("{work}: driving alone"), row::time(driven.median)));
        }
    }
    let work = "plans: hybrid A* parks the trailer in bay 2, start to certified path";
    if table.wants(work) {
        let parked = race(vec![Entrant::new("", 1, |_| {
            solve(&mut HybridAStar::new(into_bay_2()), &Bounds::default()).expect("there is a way")
        })]);
        let median = parked[0].median;
        let verdict = if median <= 1e9 { Verdict::Met } else { Verdict::Missed };
        table.push(Row::note(work.into(), row::time(median)).held_to("<= 1 s", verdict));
    }
    let work = "plans: RRT-Connect, Reach round the post, start to certified path, median of 1,000 seeds";
    if table.wants(work) {
        let [plan, edge] = plan_and_edge(if is_timed() { SEEDS } else { 3 });
        table.push(Row::new(work.into(), Mark::cost(" edges"), &plan, &[edge]));
    }
}
