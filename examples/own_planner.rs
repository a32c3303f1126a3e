//! A planner of one's own, a rapidly-exploring random tree (LaValle, 1998): Reach goes round the post of the Workbench.
//!
//! `cargo run --example own_planner`
#![allow(clippy::print_stdout, dead_code)]

use std::error::Error;
use std::fmt::Write;

use motion_lab::collision::{Certificate, ChainChecker, Problem, Scene, verify_certificate};
use motion_lab::prelude::*;

/// The distance of two configurations in the chart.
fn apart<C: Configuration>(a: &C, b: &C) -> f64 {
    a.difference(b).map_or(f64::INFINITY, |d| motion_lab::num::sqrt(d.iter().map(|x| x * x).sum()))
}

/// A path of free edges from the start to the goal, grown in steps of at most `step`; `None` when `samples` draws find
/// none.
pub fn rrt<R: Robot>(problem: &mut Problem<R>, step: f64, samples: u32) -> Option<Vec<R::Configuration>> {
    // every node with the number of its parent; the root is its own
    let mut tree = vec![(problem.start(), 0)];
    for _ in 0..samples {
        let sample = problem.sample();
        let to_sample = |(q, _): &(R::Configuration, usize)| apart(q, &sample);
        let parent = (1..tree.len()).fold(0, |n, i| if to_sample(&tree[i]) < to_sample(&tree[n]) { i } else { n });
        let (from, length) = (tree[parent].0, to_sample(&tree[parent]));
        let q = if length > step { from.interpolate(&sample, step / length).ok()? } else { sample };
        if !problem.checker().edge_free(&from, &q) {
            continue;
        }
        tree.push((q, parent));
        if problem.checker().edge_free(&q, &problem.goal()) {
            let mut path = vec![problem.goal()];
            let mut at = tree.len() - 1;
            while at > 0 {
                path.push(tree[at].0);
                at = tree[at].1;
            }
            path.push(problem.start());
            path.reverse();
            return Some(path);
        }
    }
    None
}

/// The book's pair of configurations: both free, with the post between them.
pub fn problem() -> Result<Problem<Reach<2>>, Box<dyn Error>> {
    let checker = ChainChecker::new(Scene::workbench(), Reach::<2>::workbench());
    Ok(Problem::try_new(checker, T2::new(2.0, 0.0), T2::new(3.1, 0.0), Seed(2005))?)
}

/// The program's output.
pub fn report() -> Result<String, Box<dyn Error>> {
    let mut problem = problem()?;
    let path = rrt(&mut problem, 0.4, 10_000).ok_or("no path within 10000 samples")?;
    let (mut text, mut certificate) = (String::new(), Certificate::new());
    writeln!(text, "{}", path[0])?;
    for ends in path.windows(2) {
        problem.checker().edge_certified(&ends[0], &ends[1], &mut certificate)?;
        // the verifier trusts neither the planner nor the march: it gets the steps and checks them
        let edge = problem.checker().robot().edge(&ends[0], &ends[1])?;
        let proven = verify_certificate(problem.checker().scene(), &edge, &certificate)?;
        assert_eq!(proven, 1.0, "the planner took only edges proven free");
        writeln!(text, "{}  clearance {:.4} m", ends[1], certificate.clearance())?;
    }
    Ok(text)
}

fn main() -> Result<(), Box<dyn Error>> {
    print!("{}", report()?);
    Ok(())
}
