//! `grade`: submissions against an assignment.

use std::path::{Path, PathBuf};

use clap::Args;
use motion_lab::export::JsonNumber;
use motion_lab::recording::{
    Assignment, AssignmentError, AssignmentFile, AssignmentProblem, Attempt, Grade, Refusal, RunError, Submission,
};
use motion_lab::run::{Log, Script};
use motion_lab::simulation::SpawnError;
use motion_lab::worlds::World;
use serde::Serialize;

use crate::cli::support::input::{MAX_TEXT, read_bytes, read_text};
use crate::cli::support::log_source::MAX_LOG;
use crate::cli::support::simulate::unknown_kind;
use crate::cli::support::world_source::{find_world, read_world};
use crate::cli::{Data, Failure, Outcome, say};

/// Grade scripts and logs by running them again at every seed of an assignment.
///
/// A log's frames are simulated again first: a log that claims others is forged. A submission passes when its robot is
/// at the goal within every limit, at every seed. The exit code is 0 when all pass, else 4.
///
/// An assignment:
///
/// Assignment(version: 1, world: "lot", robot: "Hitch", start: [6.5, 2.5, 0],
///     goal: (at: [7.5, 2.5, 0], within: [0.1, 0.1, 0.1]),
///     limits: (ticks: 200, contacts: 0, reversals: 3), seeds: [1, 2])
#[derive(Debug, Args)]
#[command(
    verbatim_doc_comment,
    after_help = "\
Examples:
  motion-lab grade exam.ron ann.ron ben.mcap
  motion-lab grade --json exam.ron submissions/*.ron"
)]
pub struct GradeArgs {
    /// The assignment, RON.
    assignment: PathBuf,
    /// The submissions: scripts, and logs named .mcap.
    #[arg(required = true, value_name = "SUBMISSION")]
    submissions: Vec<PathBuf>,
    /// One line of JSON for each submission.
    #[arg(long)]
    json: bool,
}

/// A submission's grade as JSON.
#[derive(Serialize)]
struct Graded<'a> {
    submission: &'a str,
    passed: bool,
    /// The tick of the first forged frame.
    forged_at: Option<u64>,
    /// The reason why it was refused.
    refused: Option<String>,
    attempts: Vec<Tried>,
}

/// An attempt as JSON.
#[derive(Serialize)]
struct Tried {
    seed: u64,
    verdict: String,
    tick: u64,
    contacts: u32,
    reversals: u32,
    configuration: Vec<JsonNumber>,
}

impl GradeArgs {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let assignment = read_assignment(&self.assignment)?;
        let names: Vec<String> = self.submissions.iter().map(|path| path.display().to_string()).collect();
        let width = names.iter().map(|name| name.chars().count()).max().unwrap_or(0).max("submission".len());
        let mut passed = 0;
        if !self.json {
            data.line(format!("{:width$}  {:>6}  {:18}  tick  contacts  reversals", "submission", "seed", "verdict"))?;
        }
        for (path, name) in self.submissions.iter().zip(&names) {
            let graded = match read_submission(path)? {
                Ok(submission) => {
                    let grade = assignment.grade(&submission);
                    if let Some(Refusal::Run(RunError::Spawn(SpawnError::UnknownKind { .. }))) = grade.refusal {
                        say(format!("{name}: {}", unknown_kind()));
                    }
                    Graded::new(name, &grade)
                }
                Err(reason) => Graded::refused(name, reason),
            };
            passed += usize::from(graded.passed);
            if self.json {
                data.json(&graded)?;
            } else {
                graded.print(width, data)?;
            }
            data.flush()?;
        }
        if !self.json {
            data.line(format!("{passed} of {} pass", names.len()))?;
        }
        Ok(if passed == names.len() { Outcome::Done } else { Outcome::NotPassed })
    }
}

impl<'a> Graded<'a> {
    fn new(submission: &'a str, grade: &Grade) -> Self {
        let tried = |attempt: &Attempt| Tried {
            seed: attempt.seed.0,
            verdict: attempt.verdict.to_string(),
            tick: attempt.tick,
            contacts: attempt.contacts,
            reversals: attempt.reversals,
            configuration: attempt.configuration.iter().copied().map(JsonNumber).collect(),
        };
        let forged_at = match &grade.refusal {
            Some(Refusal::Forged(divergence)) => Some(divergence.tick),
            _ => None,
        };
        Graded {
            submission,
            passed: grade.passed(),
            forged_at,
            refused: grade.refusal.as_ref().map(Refusal::to_string),
            attempts: grade.attempts.iter().map(tried).collect(),
        }
    }

    fn refused(submission: &'a str, reason: String) -> Self {
        Graded { submission, passed: false, forged_at: None, refused: Some(reason), attempts: Vec::new() }
    }

    fn print(&self, width: usize, data: &mut Data) -> Result<(), Failure> {
        let name = self.submission;
        if let Some(reason) = &self.refused {
            data.line(format!("{name:width$}  {:>6}  {reason}", "-"))?;
        }
        for Tried { seed, verdict, tick, contacts, reversals, .. } in &self.attempts {
            data.line(format!("{name:width$}  {seed:>6}  {verdict:18}  {tick:>4}  {contacts:>8}  {reversals:>9}"))?;
        }
        Ok(())
    }
}

fn read_assignment(path: &Path) -> Result<Assignment, Failure> {
    let refused = |error: AssignmentError| {
        let next = match &*error.problem {
            AssignmentProblem::Configuration(RunError::Spawn(SpawnError::UnknownKind { .. })) => unknown_kind(),
            _ => "Correct it there. `motion-lab grade --help` shows an assignment.".into(),
        };
        Failure::input(error, next)
    };
    let file = AssignmentFile::parse(&path.display().to_string(), &read_text(path)?).map_err(refused)?;
    // a world file lies where the assignment says, seen from the assignment's own folder
    let name = file.world_name();
    let beside = path.parent().unwrap_or(Path::new("")).join(name);
    let world =
        if World::built_in(name).is_none() && beside.exists() { read_world(&beside)? } else { find_world(name)? };
    file.in_world(world).map_err(refused)
}

/// A submission, or why it is none. Only a file that can't be read at all is a failure.
fn read_submission(path: &Path) -> Result<Result<Submission, String>, Failure> {
    if path.extension().is_some_and(|extension| extension == "mcap") {
        let log = Log::read_mcap(&read_bytes(path, MAX_LOG)?);
        return Ok(log.map(|read| Submission::Log(Box::new(read.log))).map_err(|error| error.to_string()));
    }
    let bytes = read_bytes(path, MAX_TEXT)?;
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    Ok(String::from_utf8(bytes)
        .map_err(|_| "no script: it is not UTF-8".to_owned())
        .and_then(|text| Script::parse(&file, &text).map_err(|error| error.to_string()))
        .map(Submission::Script))
}
