//! `plan`: a proven path for a robot, and what becomes of it: a file, a script, a recorded run, a picture; planners
//! compared.

mod answer;
mod compare;
mod drawing;
mod film;
mod play;
mod task;

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use motion_lab::planning::{Bounds, NoPath};
use motion_lab::plans::{PathFile, PlanAttempt, PlannerName, Task};
use motion_lab::random::Seed;

use crate::cli::commands::record::SeedRange;
use crate::cli::support::choices::{NumberList, RobotsAndKinds, WorldNames};
use crate::cli::support::output::write_file;
use crate::cli::support::paper::PaperArgs;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome, say};
use answer::PlanAnswer;

/// Plan a path that is proven free along its whole length, or say why there is none.
///
/// A path is certified: every leg has the steps that prove it free, and a verifier of its own has checked them before
/// the path is printed. Where no path is found within the bound on iterations, where the start or the goal is in
/// contact, or where a planner has searched all that it looks at, that is said, and the exit code is 4.
///
/// With -o the path goes to a file as JSON, with --script to an input script that plays it, with --record to the log of
/// the run in which the script plays it, with --svg to a picture, with --gif to a film of the planner's growth. What
/// can't be played is refused when the script is made.
///
/// With --compare several planners work on the same problem at several seeds; --csv has a row for each attempt.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab plan --robot reach --from 2.0,0 --to 3.1,0 --svg path.svg --gif growth.gif
  motion-lab plan --planner rrt-connect --robot reach --from 2.0,0 --to 3.1,0 --seed 7 -o path.json --script out.ron
  motion-lab plan --robot hitch --from 6.5,2.5,0,0 --to 6.75,7,-1.5707963,-1.5707963 --record parked.mcap
  motion-lab plan --compare rrt-connect,prm,a-star --robot rusty --to 9.75,6.25 --seeds 0..20 --csv planners.csv")]
pub struct PlanArgs {
    /// The planner. [default: hybrid-a-star for a car, rrt-connect for any other robot]
    #[arg(long, value_name = "PLANNER", value_parser = task::planner_name(), conflicts_with = "compare")]
    planner: Option<PlannerName>,
    /// The robot: a resident of the world by its name, with the sizes that the world says; else one of a kind: rusty
    /// (x,y), reach (th1,th2), choset (the same arm without thickness), reach3 (th1,th2,th3), hitch (x,y,theta;
    /// with the trailer x,y,theta,psi).
    #[arg(long, value_name = "NAME|KIND", value_parser = RobotsAndKinds, hide_possible_values = true)]
    robot: String,
    /// A built-in world or the path of a world file; the robot's home when left out.
    #[arg(long, value_name = "NAME|FILE", value_parser = WorldNames, hide_possible_values = true)]
    world: Option<String>,
    /// Where the path begins: numbers joined by commas, in metres and radians. [default: where the robot starts]
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    from: Option<NumberList>,
    /// Where the path ends.
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    to: NumberList,
    /// The seed of the planner's samples, and of the run that plays the path.
    #[arg(long, default_value_t = 2005, conflicts_with = "compare")]
    seed: u64,
    /// The greatest number of iterations. [default: 20000 for hybrid-a-star, 100000 for any other planner]
    #[arg(long, value_name = "N")]
    iterations: Option<u64>,
    /// A rover is planned this much larger, metres, so that its script may stray from the path by as much: 0 to 1.
    #[arg(long, value_name = "METRES", default_value_t = 0.02)]
    tube: f64,
    /// Write the path to this file, as JSON.
    #[arg(short, long, value_name = "FILE", conflicts_with = "compare")]
    output: Option<PathBuf>,
    /// Write what the planner has grown to the path's file too.
    #[arg(long, requires = "output")]
    growth: bool,
    /// Write the script that plays the path to this file.
    #[arg(long, value_name = "FILE", conflicts_with = "compare")]
    script: Option<PathBuf>,
    /// Play the path, and write the log of the run to this file.
    #[arg(long, value_name = "FILE", conflicts_with = "compare")]
    record: Option<PathBuf>,
    /// Write a picture of the path and of what the planner has grown to this file, as SVG, or as PNG if its
    /// name ends so.
    #[arg(long, value_name = "FILE", conflicts_with = "compare")]
    svg: Option<PathBuf>,
    /// Write how the planner grows, in the workspace and in the configuration space, to this file as GIF.
    #[arg(long, value_name = "FILE", conflicts_with = "compare")]
    gif: Option<PathBuf>,
    /// Print the result as JSON.
    #[arg(long)]
    json: bool,
    /// Compare these planners, joined by commas.
    #[arg(long, value_parser = task::planner_name(), value_delimiter = ',', value_name = "PLANNERS")]
    compare: Vec<PlannerName>,
    /// The seeds of a comparison, without the last.
    #[arg(long, value_name = "A..B", requires = "compare")]
    seeds: Option<SeedRange>,
    /// Write a row for each attempt of a comparison to this file, as CSV.
    #[arg(long, value_name = "FILE", requires = "compare")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    paper: PaperArgs,
}

impl PlanArgs {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        if !(0.0..=1.0).contains(&self.tube) {
            return Err(Failure::usage(format!("--tube {}: it must be from 0 to 1 m", self.tube), "Change --tube."));
        }
        let from = self.from.as_ref().map(|NumberList(from)| from.as_slice());
        let task = task::find(&self.robot, self.world.as_deref(), from, &self.to.0, self.tube)?;
        if !self.compare.is_empty() {
            return compare::compare(&self, &task, data);
        }
        let name = self.planner.unwrap_or(PlannerName::default_for(&task.robot));
        let begun = Instant::now();
        let mut attempt = match task::attempt(&task, name, Seed(self.seed))? {
            Ok(attempt) => attempt,
            Err(reason) => return self.none(&PlanAnswer::of_none(&task, name, self.seed, &reason), data),
        };
        let progress = CommandProgress::unknown("planning");
        let solved = attempt.solve(&self.bounds(name));
        drop(progress);
        let seconds = begun.elapsed().as_secs_f64();
        match solved {
            Ok(()) => self.solved(&task, name, attempt.as_ref(), seconds, data),
            Err(reason) => {
                let answer = PlanAnswer::of_none(&task, name, self.seed, &reason);
                self.draw(&task, name, attempt.as_ref())?;
                self.none(&answer.after(attempt.effort()), data)
            }
        }
    }

    /// How much a planner may do.
    fn bounds(&self, planner: PlannerName) -> Bounds {
        Bounds::of_iterations(self.iterations.unwrap_or(planner.iterations()))
    }

    /// Says that there is no path.
    fn none(&self, answer: &PlanAnswer, data: &mut Data) -> Result<Outcome, Failure> {
        if self.json {
            data.json(answer)?;
        } else if let Some(reason) = &answer.reason {
            say(format!("{}\n{}", in_words(reason), answer.next));
        }
        Ok(Outcome::NoPath)
    }

    fn solved(
        &self,
        task: &Task,
        name: PlannerName,
        attempt: &dyn PlanAttempt,
        seconds: f64,
        data: &mut Data,
    ) -> Result<Outcome, Failure> {
        let mut answer = PlanAnswer::of_path(task, name, self.seed, attempt, seconds);
        // what can't be played is refused before anything is written
        let played = if self.script.is_some() || self.record.is_some() {
            match play::play(task, attempt, Seed(self.seed))? {
                Ok(played) => Some(played),
                Err(reason) => {
                    let unplayed = format!("the path can't be played: {reason}");
                    if self.json {
                        answer.reason = Some(unplayed);
                        data.json(&answer)?;
                    } else {
                        say(format!("{unplayed}\nNothing was written. {}", play::next(&reason)));
                    }
                    return Ok(Outcome::NoPath);
                }
            }
        } else {
            None
        };
        if !self.json {
            answer.print(data)?;
        } else if played.is_none() {
            data.json(&answer)?;
        }
        if let Some(output) = &self.output {
            let target = Target::of(output)?;
            let file = PathFile::new(name.id(), self.seed, task, attempt, self.growth);
            let text = file.to_json().map_err(Failure::internal)?;
            write_file(target.path(), text.as_bytes())?;
            target.finish(data)?;
        }
        self.draw(task, name, attempt)?;
        if let Some(played) = &played {
            played.write(self.script.as_deref(), self.record.as_deref(), &mut answer, data)?;
            if self.json {
                data.json(&answer)?;
            } else {
                answer.print_run(data)?;
            }
        }
        Ok(Outcome::Done)
    }

    fn draw(&self, task: &Task, name: PlannerName, attempt: &dyn PlanAttempt) -> Result<(), Failure> {
        let paper = self.paper.paper();
        if let Some(svg) = &self.svg {
            drawing::write(task, name, self.seed, attempt, &paper, svg)?;
        }
        if let Some(gif) = &self.gif {
            film::write(task, name, self.seed, attempt.effort().iterations, &paper, gif)?;
        }
        Ok(())
    }
}

/// Why there is no path, in a sentence that says so.
fn in_words(reason: &str) -> String {
    if reason.starts_with("no path") { reason.to_owned() } else { format!("no path: {reason}") }
}

/// What to do where there is no path.
fn next(reason: &NoPath) -> &'static str {
    match reason {
        NoPath::Problem(_) => "Choose another --from or --to; `motion-lab query witness` says what is in the way.",
        NoPath::Exhausted { .. } => "There may be one: allow more --iterations, or try another --seed or --planner.",
        NoPath::NoneInGraph { .. } | NoPath::LocalMinimum { .. } | NoPath::GaveUp(_) => {
            "There may be one: try another --planner."
        }
        NoPath::Unsuited(_) => "Try another --planner.",
        _ => "Choose another --to.",
    }
}
