//! `problems`: the problems of a file, one after the other, and the world of one.

use std::path::PathBuf;

use clap::Args;
use motion_lab_core::configuration::{AnyConfiguration, Configuration as _, HitchCfg};
use motion_lab_core::worlds::{Place, World};
use motion_lab_sim::plans::Task;
use serde::Serialize;

use crate::batch::{KnownProblem, SetProblem};
use crate::cli::support::choices::RobotsAndKinds;
use crate::cli::support::console::note;
use crate::cli::support::input::shown;
use crate::cli::support::output::write_text;
use crate::cli::support::world_source::{of_robot, read_problems};
use crate::cli::{Data, Failure, Outcome};

/// List the problems of a file, or write the world of one.
///
/// A problem file says worlds, robots, starts and goals, or how problems are made by a seed: mazes, narrow passages,
/// circles, parking lots, warehouses. `motion-lab plan` plans one of them, or compares planners by all.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab problems mazes.ron
  motion-lab problems mazes.ron --robot rusty --json
  motion-lab problems mazes.ron --problem 3 -o third.ron")]
pub struct Problems {
    /// The problem file.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Only those of this robot or kind.
    #[arg(long, value_name = "NAME|KIND", value_parser = RobotsAndKinds, hide_possible_values = true)]
    robot: Option<String>,
    /// Only the one with this number, from 1.
    #[arg(long, value_name = "N")]
    problem: Option<u64>,
    /// Write the problem's world to this file, with the robot alone at its start, and the goal of a rover or a car as
    /// the place `goal`.
    #[arg(short, long, value_name = "FILE", requires = "problem")]
    output: Option<PathBuf>,
    /// One line of JSON for each.
    #[arg(long)]
    json: bool,
}

/// The name of the place that is a problem's goal.
const GOAL: &str = "goal";

/// A problem as a line of JSON.
#[derive(Serialize)]
struct ProblemLine<'a> {
    problem: u64,
    set: &'a str,
    #[serde(flatten)]
    asked: Option<AskedLine<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    known: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    bucket: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    optimal_m: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'a str>,
}

#[derive(Serialize)]
struct AskedLine<'a> {
    world: &'a str,
    robot: &'a str,
    start: Vec<f64>,
    goal: Vec<f64>,
}

impl Problems {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let problems = of_robot(read_problems(&self.file)?, self.robot.as_deref(), &self.file)?;
        let Some(number) = self.problem else {
            for problem in (0..problems.len()).map_while(|index| problems.problem(index)) {
                if data.is_closed() {
                    break;
                }
                self.line(&problem, data)?;
            }
            return Ok(Outcome::Done);
        };
        let problem = problems.numbered(number).ok_or_else(|| {
            let reason = format!("{}: no problem has the number {number}", shown(&self.file));
            Failure::usage(reason, "Change --problem; without it all are listed.")
        })?;
        let Some(output) = self.output else {
            self.line(&problem, data)?;
            return Ok(Outcome::Done);
        };
        let reason =
            |reason: String| Failure::input(format!("{}: {reason}", shown(&self.file)), "Take another problem.");
        let task = problem.task.map_err(reason)?;
        write_text(Some(&output), &world_of(&task).to_ron(), data)?;
        let goal = task.goal.coordinates().iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let robot = task.alone().1;
        note(format!("Plan it: motion-lab plan --world {} --robot {robot} --to {goal}", shown(&output)));
        Ok(Outcome::Done)
    }

    fn line(&self, problem: &SetProblem, data: &mut Data) -> Result<(), Failure> {
        let Some(known) = &problem.known else { return Ok(()) };
        let KnownProblem { number, set, bucket, optimal, .. } = known;
        let numbers = |q: &AnyConfiguration| q.coordinates().to_vec();
        if self.json {
            let asked = problem.task.as_ref().ok().map(|task| AskedLine {
                world: &task.world.name,
                robot: &task.name,
                start: numbers(&task.start),
                goal: numbers(&task.goal),
            });
            let reason = problem.task.as_ref().err().map(String::as_str);
            let known = known.path_in_words();
            return data.json(&ProblemLine {
                problem: *number,
                set,
                asked,
                known,
                bucket: *bucket,
                optimal_m: *optimal,
                reason,
            });
        }
        let joined = |q: &AnyConfiguration| numbers(q).iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let what = match &problem.task {
            Ok(task) => {
                let Task { name, world, start, goal, .. } = task;
                format!("{name} in {}, from {} to {}", world.name, joined(start), joined(goal))
            }
            Err(reason) => reason.clone(),
        };
        let told = match known.has_path {
            Some(true) => ": there is a path",
            Some(false) => ": there is no path",
            None => "",
        };
        data.line(format!("{number}  {set}  {what}{told}"))
    }
}

/// The world of a problem, with the robot where the path begins, and its goal, if it goes from place to place, as the
/// place of that name.
fn world_of(task: &Task) -> World {
    let mut world = task.world_at_start();
    if let AnyConfiguration::Pose(pose) | AnyConfiguration::Hitch(HitchCfg { body: pose, .. }) = task.goal {
        world.places.retain(|place| place.name != GOAL);
        if !world.has_name(GOAL) {
            world.places.push(Place { name: GOAL.into(), pose });
        }
    }
    world
}
