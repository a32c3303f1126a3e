//! `plan`: a proven path for a robot, and what becomes of it: a file, a script, a recorded run, a picture; planners
//! compared.

mod advice;
mod answer;
mod args;
mod compare;
mod drawing;
mod film;
mod play;
mod task;

use std::time::Instant;

use motion_lab::planning::Bounds;
use motion_lab::plans::{PathFile, PlanAttempt, PlannerName, Task};
use motion_lab::random::Seed;

use crate::cli::support::output::write_file;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome, say};
use advice::in_words;
use answer::PlanAnswer;
pub use args::PlanArgs;

impl PlanArgs {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        if !(0.0..=1.0).contains(&self.tube) {
            return Err(Failure::usage(format!("--tube {}: it must be from 0 to 1 m", self.tube), "Change --tube."));
        }
        let (world, from) = (self.world.as_deref(), self.from.as_ref());
        let task = task::find(&self.robot, world, from, &self.to, self.tube)?;
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
        // a bound that somebody gives is how long a path may be shortened
        let solved = match self.iterations {
            Some(_) => solved.and_then(|()| attempt.improve(&self.bounds(name))),
            None => solved,
        };
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
