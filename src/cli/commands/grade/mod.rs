//! `grade`: submissions against an assignment.

mod gradebook;
mod graded;
mod submissions;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use motion_lab_sim::course::{Assignment, AssignmentError, AssignmentFile, AssignmentProblem, Refusal, Submission};
use motion_lab_sim::recording::{RunError, verify};
use motion_lab_sim::run::{Log, LogError, Script};
use motion_lab_sim::simulation::SpawnError;

use crate::cli::support::console::note;
use crate::cli::support::input::{MAX_TEXT, read_bytes, read_text};
use crate::cli::support::log_source::{ExpectedDigests, MAX_LOG};
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::simulate::unknown_kind;
use crate::cli::support::world_source::find_world_beside;
use crate::cli::{Data, Failure, Outcome, say};
use gradebook::Results;
use graded::{Graded, in_one_line};
use submissions::{Submissions, ending};

/// Grade scripts and logs by running them again at every seed of an assignment
///
/// A log's frames are simulated again first: a log that claims others is forged. A submission passes when its robot is
/// at the goal within every limit, at every seed. A robot that the script does not drive stands. What can't be read is
/// not graded: it has no points, rather than none earned. The exit code is 0 when all pass, 3 when a file is missing or
/// can't be read, else 4.
///
/// An assignment, in which the car has to park: it passes only when it stays there for the last 20 ticks.
///
/// Assignment(version: 1, world: "lot", robot: "Hitch", start: [6.5, 2.5, 0],
///     goal: (at: [7.5, 2.5, 0], within: [0.1, 0.1, 0.1]),
///     stay: (hold: 20, at: end),
///     limits: (ticks: 200, contacts: 0, reversals: 3),
///     points: (goal: 6, contacts: 2, reversals: 2),
///     seeds: "0..10")
///
/// A submission that passes:
///
/// Script(version: 1, events: [
///     (tick: 1, robot: "Hitch", input: Drive(128, 0)),
///     (tick: 14, robot: "Hitch", input: Drive(0, 0))])
#[derive(Debug, Args)]
#[command(
    verbatim_doc_comment,
    after_help = "\
Examples:
  motion-lab grade exam.ron ann.ron ben.mcap
  motion-lab grade --json exam.ron submissions/*.ron
  motion-lab grade --csv exam.ron submissions > grades.csv
  motion-lab grade --format gradescope exam.ron ann.ron > results.json"
)]
pub struct GradeArgs {
    /// The assignment, RON.
    assignment: PathBuf,
    /// The submissions: scripts, logs named .mcap and saved pages named .html; a folder stands for those in it, and
    /// says what else it holds; a pattern in quotes, as "week3/*.ron", for the files that match.
    #[arg(required = true, value_name = "SUBMISSION")]
    submissions: Vec<PathBuf>,
    /// How the grades are written. [default: table]
    #[arg(long, value_enum, value_name = "FORM", conflicts_with_all = ["json", "csv"])]
    format: Option<ReportForm>,
    /// One line of JSON for each submission; the same as --format json.
    #[arg(long, conflicts_with = "csv")]
    json: bool,
    /// A gradebook: a row of comma-separated values for each submission; the same as --format csv.
    #[arg(long)]
    csv: bool,
    #[command(flatten)]
    expected: ExpectedDigests,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ReportForm {
    /// A line for people for each seed.
    Table,
    /// A line of JSON for each submission.
    Json,
    /// A row for each submission.
    Csv,
    /// Gradescope's results.json, of one submission.
    Gradescope,
}

impl GradeArgs {
    fn form(&self) -> ReportForm {
        match self.format {
            Some(form) => form,
            None if self.json => ReportForm::Json,
            None if self.csv => ReportForm::Csv,
            None => ReportForm::Table,
        }
    }

    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let form = self.form();
        let (_, assignment) = read_assignment(&self.assignment)?;
        let Submissions { graded: files, left_out } = submissions::find(&self.submissions, &self.assignment)?;
        for (file, reason) in &left_out {
            say(format!("{}: left out: {reason}", in_one_line(&file.display().to_string())));
        }
        if form == ReportForm::Gradescope && files.len() != 1 {
            return Err(Failure::usage(
                format!("{} submissions: Gradescope's results.json is of one", files.len()),
                "Name one submission, or use --csv for many.",
            ));
        }
        let names: Vec<String> = files.iter().map(|path| path.display().to_string()).collect();
        let width =
            names.iter().map(|name| in_one_line(name).chars().count()).max().unwrap_or(0).max("submission".len());
        let (mut passed, mut is_missing) = (0, false);
        match form {
            ReportForm::Table => data.line(Graded::head(width))?,
            ReportForm::Csv => data.data_line(gradebook::HEAD)?,
            ReportForm::Json | ReportForm::Gradescope => {}
        }
        let (ticks, seeds) = (assignment.limits().ticks, assignment.seeds().len() as u64);
        let mut first_with: BTreeMap<String, String> = BTreeMap::new();
        let progress = CommandProgress::of(names.len() as u64 * seeds * ticks, "ticks");
        for ((path, name), number) in files.iter().zip(&names).zip(0_u64..) {
            let before = number * seeds * ticks;
            let graded = match read_submission(path, &self.expected) {
                Ok(SubmissionFile::Submission(submission)) => {
                    let grade = assignment.grade_watched(&submission, |attempt, tick| {
                        progress.at(before + attempt as u64 * ticks + tick)
                    });
                    if let Some(Refusal::Run(RunError::Spawn(SpawnError::UnknownKind { .. }))) = grade.refusal {
                        say(format!("{name}: {}", unknown_kind()));
                    }
                    let first = first_with.entry(inputs(&submission)).or_insert_with(|| name.clone());
                    let same_as = Some(first.clone()).filter(|first| first != name);
                    Graded { same_as, ..Graded::new(name.clone(), &assignment, &grade) }
                }
                Ok(SubmissionFile::Refused(reason)) => Graded::refused(name.clone(), &assignment, reason),
                Ok(SubmissionFile::Forged(reason)) => {
                    Graded { forged_at: Some(0), ..Graded::refused(name.clone(), &assignment, reason) }
                }
                Ok(SubmissionFile::NotGraded(reason)) => Graded::not_graded(name.clone(), &assignment, reason),
                Err(failure @ Failure::Input { .. }) => {
                    is_missing = true;
                    let reason = reason_of(&failure, name);
                    data.flush()?;
                    say(failure);
                    Graded::not_graded(name.clone(), &assignment, reason)
                }
                Err(failure) => return Err(failure),
            };
            passed += usize::from(graded.passed);
            match form {
                ReportForm::Table => graded.print(width, data)?,
                ReportForm::Json => data.json(&graded)?,
                ReportForm::Csv => data.data_line(gradebook::row(&graded))?,
                ReportForm::Gradescope => data.json(&Results::new(&graded))?,
            }
            data.flush()?;
            progress.at(before + seeds * ticks);
        }
        drop(progress);
        if form == ReportForm::Table {
            data.line(format!("{passed} of {} pass", names.len()))?;
        }
        Ok(match (passed == names.len(), is_missing) {
            (true, _) => Outcome::Done,
            (false, true) => Outcome::BadInput,
            (false, false) => Outcome::NotPassed,
        })
    }
}

/// The inputs of a submission, as a script's canonical text. Students who work by themselves do not have the same.
fn inputs(submission: &Submission) -> String {
    match submission {
        Submission::Script(script) => script.to_line(),
        Submission::Log(log) => log.recipe.script.to_line(),
        other => format!("{other:?}"),
    }
}

/// The reason of a file that can't be read, without the file's name and what to do.
fn reason_of(failure: &Failure, name: &str) -> String {
    let text = failure.to_string();
    let line = text.lines().next().unwrap_or_default();
    line.strip_prefix(name).and_then(|rest| rest.strip_prefix(": ")).unwrap_or(line).to_owned()
}

/// Reads an assignment, with the name of its world as it is written there.
pub fn read_assignment(path: &Path) -> Result<(String, Assignment), Failure> {
    let refused = |error: AssignmentError| {
        let next = match &*error.problem {
            AssignmentProblem::Configuration(RunError::Spawn(SpawnError::UnknownKind { .. })) => unknown_kind(),
            _ => "Correct it there. `motion-lab grade --help` shows an assignment.".into(),
        };
        Failure::input(error, next)
    };
    let file = AssignmentFile::parse(&path.display().to_string(), &read_text(path)?).map_err(refused)?;
    let world =
        find_world_beside(path, file.world_name()).map_err(|failure| failure.named_at(&file.place_of("world")))?;
    file.turns(&world).into_iter().for_each(note);
    let name = file.world_name().to_owned();
    Ok((name, file.in_world(world).map_err(refused)?))
}

/// What a file holds.
enum SubmissionFile {
    /// A submission.
    Submission(Submission),
    /// A log whose end seals the digest of another run, though its frames are those of what it says.
    Forged(String),
    /// A run that is refused.
    Refused(String),
    /// Nothing that can be graded.
    NotGraded(String),
}

/// What a file holds. Only one that can't be read at all is a failure.
fn read_submission(path: &Path, expected: &ExpectedDigests) -> Result<SubmissionFile, Failure> {
    if path.is_dir() {
        return Ok(SubmissionFile::NotGraded("no script, log, page or table is in this folder".into()));
    }
    if ["mcap", "html", "htm"].contains(&&*ending(path)) {
        return Ok(read_run(&read_bytes(path, MAX_LOG)?, expected));
    }
    let bytes = read_bytes(path, MAX_TEXT)?;
    if expected.is_any() {
        return Ok(SubmissionFile::Refused("no log: --expect asks for one with this run digest".into()));
    }
    if ending(path) == "csv" {
        let (file, ron) = (path.display(), path.with_extension("ron"));
        let ron = ron.display();
        return Ok(SubmissionFile::NotGraded(format!(
            "a table is no script; make one of it: motion-lab script convert {file} -o {ron}"
        )));
    }
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    let script = String::from_utf8(bytes)
        .map_err(|_| "no script: it is not UTF-8".to_owned())
        .and_then(|text| Script::parse(&file, &text).map_err(|error| error.to_string()));
    Ok(script.map_or_else(SubmissionFile::NotGraded, |script| SubmissionFile::Submission(Submission::Script(script))))
}

/// The run in the bytes of a log or of a saved page.
fn read_run(bytes: &[u8], expected: &ExpectedDigests) -> SubmissionFile {
    let log = match Log::read_mcap(bytes) {
        Ok(read) => read.log,
        // where a frame was changed too, the replay finds the first
        Err(LogError::OtherRun(other)) if replays(&other.read.log) => return SubmissionFile::Forged(other.to_string()),
        Err(LogError::OtherRun(other)) => other.read.log,
        Err(error) => return SubmissionFile::NotGraded(error.to_string()),
    };
    // the digest of a long log takes a while
    let digest = if expected.is_any() { log.digest() } else { None };
    let refusal = digest.and_then(|digest| expected.refusal(digest));
    refusal.map_or_else(|| SubmissionFile::Submission(Submission::Log(Box::new(log))), SubmissionFile::Refused)
}

/// Whether a log's frames are those of its own settings and script.
fn replays(log: &Log) -> bool {
    verify(log, |_| {}).is_ok_and(|found| found.difference.is_none())
}
