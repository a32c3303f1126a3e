//! `plan`: a proven path for a robot, and what becomes of it: a file, a script, a recorded run, a picture; planners
//! compared.

mod advice;
mod answer;
mod args;
mod barrier_file;
mod blockers;
mod compare;
pub mod drawing;
mod exact;
pub mod film;
pub mod planners;
mod play;
mod problems;
mod rounds;
mod targets;
pub mod task;

use std::time::Instant;

use crate::capture::{CaptureForm, PlanOutcome};
use motion_lab_core::planning::NoPath;
use motion_lab_core::random::Seed;
use motion_lab_sim::plans::{MAX_CLEARANCE, PathFile, PlanAttempt, PlannerName, Task};

use crate::cli::support::console::note;
use crate::cli::support::output::write_file;
use crate::cli::support::paper::write_picture;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome, say};
use advice::in_words;
use answer::PlanAnswer;
pub use args::PlanArgs;
use barrier_file::BarrierFile;
use blockers::BlockersAnswer;
pub use rounds::solve;
use targets::PlanTargets;

impl PlanArgs {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        if !(0.0..=1.0).contains(&self.tube) {
            return Err(Failure::usage(format!("--tube {}: it must be from 0 to 1 m", self.tube), "Change --tube."));
        }
        let kept = self.clearance.unwrap_or(0.0);
        if !(0.0..=MAX_CLEARANCE).contains(&kept) {
            let reason = format!("--clearance {kept}: it must be from 0 to {MAX_CLEARANCE} m");
            return Err(Failure::usage(reason, "Change --clearance."));
        }
        if !self.checker.proves() && kept > 0.0 {
            let reason = format!("a clearance that is kept is proven, and {} proves nothing", self.checker.id());
            return Err(Failure::usage(reason, "Leave out --checker, or --clearance."));
        }
        if !self.compare.is_empty() {
            return compare::compare(&self, problems::all(&self)?, data);
        }
        let task = problems::one(&self)?;
        if let (false, Some(option)) = (task.checker.proves(), self.asks_for_proofs()) {
            let reason = format!("{option} rests on proofs, and {} proves nothing", task.checker.id());
            return Err(Failure::usage(reason, format!("Leave out --checker, or {option}.")));
        }
        if !task.checker.proves() && (self.script.is_some() || self.record.is_some()) {
            let reason = format!("a script plays a path that is proven, and {} proves nothing", task.checker.id());
            return Err(Failure::usage(reason, "Leave out --checker, or --script and --record."));
        }
        let name = self.planner_for(&task)?;
        let targets = PlanTargets::of(&self)?;
        let begun = Instant::now();
        let mut attempt = match task::attempt(&task, name, Seed(self.seed))? {
            Ok(attempt) => attempt,
            Err(reason) => {
                return self.none(self.completed(PlanAnswer::of_none(&task, name, self.seed, &reason), &task), data);
            }
        };
        let progress = CommandProgress::uncounted("iterations");
        // Ctrl-C ends the process while nothing is written
        let Some(solved) = solve(attempt.as_mut(), name, self.iterations, |done| progress.at(done)) else {
            return Ok(Outcome::Stopped);
        };
        drop(progress);
        if self.shorten && solved.is_ok() && !attempt.shorten(Seed(self.seed)) {
            note("the path was not shortened: a car drives it as it is".to_owned());
        }
        let seconds = begun.elapsed().as_secs_f64();
        match solved {
            Ok(()) => self.solved(&task, name, attempt.as_ref(), seconds, targets, data),
            Err(reason) => {
                let mut answer = PlanAnswer::of_none(&task, name, self.seed, &reason);
                self.draw(&task, name, attempt.as_ref(), (targets.picture, targets.film), data)?;
                match (targets.barrier, &reason) {
                    (Some(target), NoPath::Unreachable { .. }) => {
                        let barrier = BarrierFile::of(&task, attempt.as_ref());
                        let missing = || Failure::internal(anyhow::anyhow!("the cells that prove it hold no barrier"));
                        barrier.ok_or_else(missing)?.write(target, data)?;
                        answer.next = "Choose another --to, or a smaller --tube or --clearance.";
                    }
                    (barrier, _) => unwritten(barrier.as_ref(), "cells prove nothing"),
                }
                self.none(self.completed(answer.after(attempt.effort()), &task), data)
            }
        }
    }

    /// The planner that is named, or the one that what is asked for needs.
    fn planner_for(&self, task: &Task) -> Result<PlannerName, Failure> {
        let by_cells = PlannerName::CellDecomposition;
        match self.planner {
            Some(name)
                if name != by_cells
                    && let Some(option) = self.asks_for_cells() =>
            {
                let reason = format!("{option}: {} proves no barrier, only {} does", name.id(), by_cells.id());
                Err(Failure::usage(reason, format!("Use --planner {}, or leave out {option}.", by_cells.id())))
            }
            None if self.asks_for_cells().is_some() => Ok(by_cells),
            name => Ok(name.unwrap_or(PlannerName::default_for(&task.robot))),
        }
    }

    /// The option that needs cells proven free or blocked.
    fn asks_for_cells(&self) -> Option<&'static str> {
        match self {
            Self { barrier: Some(_), .. } => Some("--barrier"),
            Self { what_blocks: true, .. } => Some("--what-blocks"),
            _ => None,
        }
    }

    /// The option that rests on proofs.
    fn asks_for_proofs(&self) -> Option<&'static str> {
        match self {
            Self { bound: true, .. } => Some("--bound"),
            Self { shorten: true, .. } => Some("--shorten"),
            _ => self.asks_for_cells(),
        }
    }

    /// The answer without a path, with what to move and with a bound, where they are asked.
    fn completed(&self, answer: PlanAnswer, task: &Task) -> PlanAnswer {
        let mut answer = self.with_bound(answer, task);
        answer.blockers = self.what_blocks.then(|| BlockersAnswer::of(task.what_blocks()));
        answer
    }

    fn with_bound(&self, answer: PlanAnswer, task: &Task) -> PlanAnswer {
        match if self.bound { task.length_bound() } else { None } {
            Some(bound) => answer.bounded(bound),
            None => answer,
        }
    }

    /// Says that there is no path.
    fn none(&self, answer: PlanAnswer, data: &mut Data) -> Result<Outcome, Failure> {
        if self.json {
            data.json(&answer)?;
        } else if let Some(reason) = &answer.reason {
            let next = answer.blockers.as_ref().map_or_else(|| answer.next.to_owned(), BlockersAnswer::words);
            say(format!("{}{}\n{next}", in_words(reason), answer.bound_in_words()));
        }
        Ok(answer.without_path())
    }

    fn solved(
        &self,
        task: &Task,
        name: PlannerName,
        attempt: &dyn PlanAttempt,
        seconds: f64,
        targets: PlanTargets,
        data: &mut Data,
    ) -> Result<Outcome, Failure> {
        let PlanTargets { path, script, record, picture, film, barrier } = targets;
        let answer = PlanAnswer::of_path(task, name, self.seed, attempt, seconds);
        let mut answer = self.with_bound(answer, task);
        // what can't be played is refused before anything is written
        let played = if script.is_some() || record.is_some() {
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
        if let Some(target) = path {
            let file = PathFile::new(name.id(), self.seed, task, attempt, self.growth);
            let text = file.to_json().map_err(Failure::internal)?;
            write_file(&target, text.as_bytes())?;
            target.finish(data)?;
        }
        self.draw(task, name, attempt, (picture, film), data)?;
        unwritten(barrier.as_ref(), "there is a path");
        if let Some(played) = &played {
            played.write(script, record, &mut answer, data)?;
            if self.json {
                data.json(&answer)?;
            } else {
                answer.print_run(data)?;
            }
        }
        Ok(Outcome::Done)
    }

    fn draw(
        &self,
        task: &Task,
        name: PlannerName,
        attempt: &dyn PlanAttempt,
        (picture, film): (Option<Target>, Option<Target>),
        data: &mut Data,
    ) -> Result<(), Failure> {
        let paper = self.paper.paper();
        if let Some(target) = picture {
            let captured = drawing::captured(task, name, self.seed, attempt, PlanOutcome::None, None);
            write_picture(&captured, &paper, self.form(), &target)?;
            target.finish(data)?;
        }
        if let Some(target) = film {
            film::write(task, name, self.seed, attempt.effort().iterations, &paper, &target)?;
            target.finish(data)?;
        }
        Ok(())
    }

    /// The form of the picture: what was said, else what its name tells, else SVG.
    fn form(&self) -> CaptureForm {
        let of_name = || self.svg.as_deref().and_then(CaptureForm::of).filter(|form| *form == CaptureForm::Png);
        self.format.or_else(of_name).unwrap_or(CaptureForm::Svg)
    }
}

/// Says that no barrier was written, and why.
fn unwritten(barrier: Option<&Target>, why: &str) {
    if let Some(target) = barrier {
        note(format!("{}: no barrier was written, since {why}", target.path().display()));
    }
}
