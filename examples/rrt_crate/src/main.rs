//! A published planner, the crate `rrt` (its `dual_rrt_connect`, after Kuffner and LaValle, 2000), on two of the lab's
//! problems: Reach past the block and the shelf of the Workbench, Rusty from room A to room E of the Apartment.
//!
//! `cargo run --manifest-path examples/rrt_crate/Cargo.toml -- [FIGURE.svg]`; the figure goes to `runs/rrt_crate.svg`
//! otherwise. It is a crate of its own, as yours would be. It needs the core of the lab and nothing of the simulator.
//!
//! Such a planner asks about points only, here through `&dyn Collision`, and never about the edges between them. This
//! crate even leaves out the two nodes at which its trees meet. So its path is a proposal. Each edge is checked by
//! `edge_free`. A proposal with an edge that is not free is planned anew in smaller steps. Corners are cut where
//! `edge_free` allows, and the remaining edges get certificates that a separate verifier accepts.
//!
//! The crate searches a box and does not know that angles wrap, so Reach's goal is one that it can reach without
//! crossing pi. (The planner of `own_planner` uses the lab's own charts, in which angles wrap.)
//!
//! The program is deterministic: `dual_rrt_connect` draws only from the closure it is given, which draws from a seeded
//! stream. The crate's `smooth_path` draws from the thread's own generator, which nobody can seed, so corners are cut
//! here instead.
use std::cell::RefCell;
use std::error::Error;
use std::fmt::Write as _;
use std::path::PathBuf;

use motion_lab_core::collision::{Certificate, Counted, QueryCounts, verify_certificate};
use motion_lab_core::picture::{Figure, Item, Panel, Role, Theme, footprint, trace, world};
use motion_lab_core::prelude::*;

#[cfg(test)]
mod tests;

type Failure = Box<dyn Error>;

/// A path, and the cost of finding and proving it.
pub struct Solution<C> {
    /// The configurations, start and goal included.
    pub path: Vec<C>,
    /// Number of configurations in the accepted proposal.
    pub proposed: usize,
    /// Number of earlier proposals with an edge that was not free.
    pub refused: u32,
    /// The planner's queries.
    pub asked: QueryCounts,
    /// The steps of all certificates together.
    pub steps: usize,
    /// The clearance proven along the whole path, metres.
    pub clearance: f64,
}

/// One proposal of the crate in steps of `step`, at least the two ends. The crate sees a configuration as a list of
/// numbers, and of the world only the answers of `obstacles`.
fn propose<R: Robot>(
    problem: &RefCell<Problem<R>>,
    obstacles: &dyn Collision,
    step: f64,
) -> Result<Vec<R::Configuration>, Failure> {
    let (robot, start, goal) = {
        let problem = problem.borrow();
        (problem.checker().robot().clone(), problem.start(), problem.goal())
    };
    let is_free = |q: &[f64]| {
        let q = R::Configuration::from_coordinates(q);
        q.is_some_and(|q| !obstacles.intersects(&robot.footprint(&q)))
    };
    let sample = || problem.borrow_mut().sample().coordinates().to_vec();
    let found = rrt::dual_rrt_connect(&start.coordinates(), &goal.coordinates(), is_free, sample, step, 100_000)?;
    let inner =
        found.iter().filter_map(|q| R::Configuration::from_coordinates(q)).filter(|q| *q != start && *q != goal);
    Ok([start].into_iter().chain(inner).chain([goal]).collect())
}

/// Leaves out the configurations between two that a free edge joins, trying the farthest first.
fn cut_corners<R: Robot>(checker: &Checker<R>, path: &[R::Configuration]) -> Vec<R::Configuration> {
    let mut short = vec![path[0]];
    let mut at = 0;
    while at + 1 < path.len() {
        at = (at + 1..path.len()).rev().find(|&next| checker.edge_free(&path[at], &path[next])).unwrap_or(at + 1);
        short.push(path[at]);
    }
    short
}

/// Solves a problem by the crate and proves every edge of the path.
pub fn solve<R: Robot>(problem: Problem<R>, step: f64) -> Result<Solution<R::Configuration>, Failure> {
    let checker = problem.checker().clone();
    let counted = Counted::new(checker.scene().clone());
    let problem = RefCell::new(problem);
    let (mut step, mut refused) = (step, 0);
    let proposal = loop {
        let path = propose(&problem, &counted, step)?;
        if path.windows(2).all(|ends| checker.edge_free(&ends[0], &ends[1])) {
            break path;
        }
        step *= 0.5;
        refused += 1;
    };
    let path = cut_corners(&checker, &proposal);
    let (proposed, asked) = (proposal.len(), counted.counts());
    let mut solution = Solution { path, proposed, refused, asked, steps: 0, clearance: f64::INFINITY };
    let mut certificate = Certificate::new();
    for ends in solution.path.windows(2) {
        checker.edge_certified(&ends[0], &ends[1], &mut certificate)?;
        let edge = checker.robot().edge(&ends[0], &ends[1])?;
        if verify_certificate(checker.scene(), &edge, &certificate)? < 1.0 {
            return Err(format!("the edge from {} to {} is not proven free", ends[0], ends[1]).into());
        }
        solution.steps += certificate.steps().len();
        solution.clearance = motion_lab_core::num::lesser(certificate.clearance(), solution.clearance);
    }
    Ok(solution)
}

/// Reach, stretched out, from one side of the block and the shelf to the other: it must fold to pass them.
pub fn reach() -> Result<Problem<Reach<2>>, Failure> {
    let checker = ChainChecker::new(Scene::workbench(), Reach::<2>::workbench());
    Ok(Problem::try_new(checker, T2::new(2.0, 0.0), T2::new(-3.0, 0.0), Seed(2005))?)
}

/// Rusty between two named places of the Apartment.
pub fn rusty() -> Result<Problem<RustyDisc>, Failure> {
    let world = World::apartment();
    let place = |name| world.place(name).map(|p| R2(p.pose.position())).ok_or("the Apartment lacks a place");
    let checker = DiscChecker::new(Scene::of_world(&world), RustyDisc::default());
    Ok(Problem::try_new(checker, place("room A")?, place("room E")?, Seed(2005))?)
}

/// The world with a path in it: the robot at every corner, and the path of its reference point along the edges.
fn panel<R: Robot>(
    model: &World,
    heading: &str,
    robot: &R,
    path: &[R::Configuration],
    reference: impl Fn(&R::Configuration) -> Point2,
) -> Result<Panel, Failure> {
    let mut items: Vec<Item> = Vec::new();
    for (k, q) in path.iter().enumerate() {
        let (name, role, opacity) = match k {
            0 => ("the start", Role::Robot, 0.85),
            k if k + 1 == path.len() => ("the goal", Role::Goal, 0.85),
            _ => ("on the way", Role::Robot, 0.2),
        };
        items.extend(footprint(&format!("corner/{k}"), name, &robot.footprint(q), role, opacity));
    }
    let mut way = Vec::new();
    for ends in path.windows(2) {
        let edge = robot.edge(&ends[0], &ends[1])?;
        way.extend((0..=32).map(|i| reference(&edge.at(f64::from(i) / 32.0))));
    }
    items.push(trace("path", "the way", &way));
    let bare = World { marks: vec![], ..model.clone() }; // the painted tour would look like a path
    Ok(Panel { picture: world(&bare).with(items), heading: heading.into(), readout: vec![] })
}

/// The program's output, and its figure as SVG.
pub fn report() -> Result<(String, String), Failure> {
    let mut text = String::new();
    let (arm, disc) = (Reach::<2>::workbench(), RustyDisc::default());
    let (reach, rusty) = (solve(reach()?, 0.8)?, solve(rusty()?, 0.8)?);
    tell(&mut text, "Reach on the Workbench", &reach)?;
    tell(&mut text, "Rusty in the Apartment", &rusty)?;
    let figure = Figure {
        title: "Two paths of the crate rrt".into(),
        description:
            "Reach goes past the block and the shelf of the Workbench, Rusty from room A to room E of the Apartment."
                .into(),
        panels: vec![
            panel(&World::workbench(), "Reach, its tip's way", &arm, &reach.path, |q| arm.tip(q))?,
            panel(&World::apartment(), "Rusty, room A to room E", &disc, &rusty.path, |q| q.0)?,
        ],
        caption: vec!["Planned by the crate rrt; every edge is proven free.".into()],
    };
    Ok((text, figure.svg(Theme::Light.palette())))
}

fn tell<C: Configuration>(text: &mut String, name: &str, solution: &Solution<C>) -> std::fmt::Result {
    let Solution { path, proposed, refused, asked, steps, clearance } = solution;
    writeln!(text, "{name}: {} points asked; {refused} proposals refused for an edge", asked.intersects)?;
    writeln!(text, "  {} of {proposed} configurations are left after cutting corners:", path.len())?;
    for q in path {
        writeln!(text, "    {q}")?;
    }
    let edges = path.len() - 1;
    writeln!(text, "  {edges} edges proven free in {steps} steps, clearance at least {clearance:.4} m")
}

fn main() -> Result<(), Failure> {
    let path = std::env::args_os().nth(1).map_or_else(|| PathBuf::from("runs/rrt_crate.svg"), PathBuf::from);
    let (text, figure) = report()?;
    print!("{text}");
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    std::fs::write(&path, &figure)?;
    eprintln!("figure: {}", path.display());
    Ok(())
}
