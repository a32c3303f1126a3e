//! Proofs that there is no path: cells judged until they part the ends, and the smallest barrier, beside one edge.

use motion_lab::configuration::AnyConfiguration;
use motion_lab::geometry::Shape;
use motion_lab::planning::{Bounds, CellDecomposition, Planner, solve};
use motion_lab::prelude::*;
use motion_lab::robots::AnyRobot;

use crate::Table;
use crate::measure::{Entrant, race};
use crate::row::{Mark, Row, Verdict};

/// A problem without a path, what it is called, and how long its proof may take, milliseconds.
struct Parted {
    work: &'static str,
    most: f64,
    scene: Scene,
    kind: &'static str,
    ends: [&'static [f64]; 2],
}

fn parted() -> [Parted; 4] {
    let mut apartment = World::apartment();
    apartment.doors.iter_mut().filter(|door| door.name == "door C").for_each(|door| door.open = false);
    let lot = Scene::lot();
    let (low, high) = (lot.bounds().min.y, lot.bounds().max.y);
    let wall = Shape::Rectangle { min: Point2::new(9.0, low), max: Point2::new(9.5, high) };
    let disc = |x: f64, y: f64, radius: f64| (Pose2::new(x, y, 0.0), Shape::Disc { radius });
    let with = |scene: Scene, (pose, shape): (Pose2, Shape)| scene.with_obstacle_at("peg", pose, shape);
    let pegged = with(Scene::workbench(), disc(0.4, -0.4, 0.1));
    let bounds = pegged.bounds();
    let posts = [disc(0.0, 0.3, 0.15), disc(0.0, -0.3, 0.15)].into_iter().fold(Scene::empty(bounds), with);
    let of = |work, most, scene, kind, ends| Parted { work, most, scene, kind, ends };
    [
        of(
            "a rover behind door C",
            50.0,
            Scene::of_world(&apartment),
            "rusty",
            [&[1.5, 5.75, 0.0], &[9.75, 6.25, 0.0]],
        ),
        of("an arm of two links on the Workbench with a peg", 50.0, pegged, "reach", [&[2.0, 0.0], &[3.1, 0.0]]),
        of("an arm of three links between two posts", 5000.0, posts, "reach3", [&[0.0, 0.4, -0.2], &[3.1, 0.2, 0.3]]),
        of(
            "a car in the Lot with a wall across",
            5000.0,
            lot.with_obstacle("wall", wall),
            "hitch",
            [&[3.0, 2.0, 0.0], &[12.0, 2.5, 0.0]],
        ),
    ]
}

pub fn rows(table: &mut Table) {
    for Parted { work, most, scene, kind, ends } in parted() {
        let work = format!("plans: proof that there is no path, with its barrier: {work}");
        if !table.wants(&work) {
            continue;
        }
        let [(robot, start), (_, goal)] = ends.map(|q| AnyRobot::of_kind(kind, q).expect("of this kind"));
        let problem = Problem::try_new(Checker::new(scene, robot), start, goal, Seed(1)).expect("both ends are free");
        let prove = |_| {
            let mut planner = CellDecomposition::new(problem.clone());
            solve(&mut planner, &Bounds::default()).expect_err("there is no path");
            planner.barrier().expect("a barrier proves it").0.cells.len()
        };
        let edge = beside(&start);
        let edge_free = |_| problem.checker().edge_free(&start, &edge);
        let timings = race(vec![Entrant::new("", 1, prove), Entrant::new("one edge_free", 200, edge_free)]);
        let verdict = if timings[0].median <= 1e6 * most { Verdict::Met } else { Verdict::Missed };
        let row = Row::new(work, Mark::cost(" edges"), &timings[0], &timings[1..]);
        table.push(row.held_to(&format!("<= {most} ms"), verdict));
    }
}

/// A configuration a little beside another.
fn beside(q: &AnyConfiguration) -> AnyConfiguration {
    q.with(0, q.coordinates()[0] + 0.1)
}
