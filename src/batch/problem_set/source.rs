//! `ProblemSource`, where the problems of one set come from.

use std::sync::Arc;

use motion_lab_core::configuration::RobotKind;
use motion_lab_core::geometry::Point2;
use motion_lab_core::random::Seed;
use motion_lab_import::{MapCell, Scenario};
use motion_lab_sim::plans::Task;
use motion_lab_sim::problems::ProblemGenerator;

use super::known::KnownProblem;
use super::place::ProblemPlace;

/// Where problems come from.
#[derive(Clone, Debug)]
pub(super) enum ProblemSource {
    /// One problem, which stands in no file.
    Own(Box<Task>),
    /// Their ends are given.
    Ends { place: ProblemPlace, starts: Vec<Vec<f64>>, goals: Vec<Vec<f64>>, crossed: bool },
    /// They are a scenario's, with the side of its cells, metres.
    Scenario { place: ProblemPlace, scenario: Arc<Scenario>, scale: f64 },
    /// They are made.
    Generated { generator: ProblemGenerator, seed: Seed, kind: &'static RobotKind, count: u64 },
}

impl ProblemSource {
    /// The number of problems.
    pub fn count(&self) -> u64 {
        match self {
            ProblemSource::Own(_) => 1,
            ProblemSource::Ends { starts, goals, crossed: true, .. } => starts.len() as u64 * goals.len() as u64,
            ProblemSource::Ends { starts, .. } => starts.len() as u64,
            ProblemSource::Scenario { scenario, .. } => scenario.problems.len() as u64,
            ProblemSource::Generated { count, .. } => *count,
        }
    }

    /// The kind of its robot.
    pub fn kind(&self) -> &'static RobotKind {
        match self {
            ProblemSource::Own(task) => task.robot.about(),
            ProblemSource::Ends { place, .. } | ProblemSource::Scenario { place, .. } => place.kind,
            ProblemSource::Generated { kind, .. } => kind,
        }
    }

    /// The name of its robot.
    pub fn robot(&self) -> &str {
        match self {
            ProblemSource::Own(task) => &task.name,
            ProblemSource::Ends { place, .. } | ProblemSource::Scenario { place, .. } => &place.robot,
            ProblemSource::Generated { kind, .. } => kind.title,
        }
    }

    /// The problem of a number below [`count`](Self::count), and what is known of it, into `known`.
    pub fn task(&self, number: u64, known: &mut KnownProblem) -> Result<Task, String> {
        let index = usize::try_from(number).unwrap_or(usize::MAX);
        match self {
            ProblemSource::Own(task) => Ok(Task::clone(task)),
            ProblemSource::Ends { place, starts, goals, crossed } => {
                let [start, goal] = if *crossed { [index / goals.len(), index % goals.len()] } else { [index, index] };
                place.task([&starts[start], &goals[goal]])
            }
            ProblemSource::Scenario { place, scenario, scale } => {
                let problem = &scenario.problems[index];
                (known.bucket, known.optimal) = (Some(problem.bucket), Some(problem.length * scale));
                let low: Point2 = place.world.bounds.min;
                let [start, goal] = [problem.start, problem.goal].map(|cell: MapCell| {
                    let middle = scenario.pose(cell, *scale);
                    place.standing([low.x + middle.x, low.y + middle.y])
                });
                place.task([&start, &goal])
            }
            ProblemSource::Generated { generator, seed, .. } => {
                let made = generator.problem(*seed, number).map_err(|error| error.to_string())?;
                known.has_path = made.has_path;
                Ok(made.task)
            }
        }
    }
}
