//! A submission's grade, as JSON and as lines for people.

use motion_lab_sim::course::{Assignment, Attempt, Criterion, Grade, Refusal};
use motion_lab_sim::export::{JsonNumber, json_seed};
use serde::Serialize;

use crate::cli::{Data, Failure};

/// A submission's grade as JSON.
#[derive(Serialize)]
pub struct Graded {
    pub submission: String,
    pub passed: bool,
    /// The points earned; null where it was not graded.
    pub points: Option<JsonNumber>,
    /// The points that could be earned.
    pub max_points: JsonNumber,
    /// The criteria that are worth points; none where it was not graded.
    pub criteria: Vec<GradedCriterion>,
    /// The number of the assignment's seeds.
    pub seeds: usize,
    /// The tick of the first forged frame; 0 where what was changed is no frame.
    pub forged_at: Option<u64>,
    /// The reason why it was refused, or not graded.
    pub refused: Option<String>,
    /// The first submission with the same inputs, where another one came before.
    pub same_as: Option<String>,
    pub attempts: Vec<Tried>,
}

/// A criterion as JSON.
#[derive(Serialize)]
pub struct GradedCriterion {
    pub name: &'static str,
    pub points: JsonNumber,
    pub max_points: JsonNumber,
    /// The number of seeds at which it is met.
    pub met: usize,
}

impl GradedCriterion {
    fn of(criterion: &Criterion) -> Self {
        GradedCriterion {
            name: criterion.name,
            points: JsonNumber(criterion.points),
            max_points: JsonNumber(criterion.of),
            met: criterion.met,
        }
    }
}

/// An attempt as JSON.
#[derive(Serialize)]
pub struct Tried {
    #[serde(serialize_with = "json_seed")]
    pub seed: u64,
    pub verdict: String,
    #[serde(skip)]
    pub passed: bool,
    pub tick: u64,
    pub contacts: u32,
    pub reversals: u32,
    pub configuration: Vec<JsonNumber>,
    /// The distance to the goal; null for a configuration of another space.
    pub metres: Option<JsonNumber>,
    /// The greatest difference of an angle to the goal's; null for a configuration of another space.
    pub radians: Option<JsonNumber>,
}

impl Graded {
    /// The grade of a submission.
    pub fn new(submission: String, assignment: &Assignment, grade: &Grade) -> Self {
        let tried = |attempt: &Attempt| Tried {
            seed: attempt.seed.0,
            verdict: attempt.verdict.to_string(),
            passed: attempt.passed(),
            tick: attempt.tick,
            contacts: attempt.contacts,
            reversals: attempt.reversals,
            configuration: attempt.configuration.iter().copied().map(JsonNumber).collect(),
            metres: attempt.distance.map(|d| JsonNumber(d.metres)),
            radians: attempt.distance.map(|d| JsonNumber(d.radians)),
        };
        let forged_at = match &grade.refusal {
            Some(Refusal::Forged(difference)) => Some(difference.first_tick()),
            _ => None,
        };
        Graded {
            submission,
            passed: grade.passed(),
            points: Some(JsonNumber(grade.score.points)),
            max_points: JsonNumber(grade.score.of),
            criteria: grade.score.criteria.iter().map(GradedCriterion::of).collect(),
            seeds: assignment.seeds().len(),
            forged_at,
            refused: grade.refusal.as_ref().map(Refusal::to_string),
            same_as: None,
            attempts: grade.attempts.iter().map(tried).collect(),
        }
    }

    /// A submission that earns nothing: it was read, and is refused.
    pub fn refused(submission: String, assignment: &Assignment, reason: String) -> Self {
        let none = assignment.score(&[]);
        let criteria = none.criteria.iter().map(GradedCriterion::of).collect();
        Graded { points: Some(JsonNumber(0.0)), criteria, ..Self::not_graded(submission, assignment, reason) }
    }

    /// A submission that can't be read, or is none: it has no points yet.
    pub fn not_graded(submission: String, assignment: &Assignment, reason: String) -> Self {
        Graded {
            submission,
            passed: false,
            points: None,
            max_points: JsonNumber(assignment.score(&[]).of),
            criteria: Vec::new(),
            seeds: assignment.seeds().len(),
            forged_at: None,
            refused: Some(reason),
            same_as: None,
            attempts: Vec::new(),
        }
    }

    /// The reason why it was refused or not graded, which it says.
    pub fn reason(&self) -> Option<String> {
        let reason = self.refused.as_deref()?;
        Some(if self.points.is_none() { format!("not graded: {reason}") } else { reason.to_owned() })
    }

    /// The heading of the table for people.
    pub fn head(width: usize) -> String {
        let columns = "tick  contacts  reversals  to the goal";
        format!("{:width$}  {:>6}  {:18}  {columns}", "submission", "seed", "verdict")
    }

    /// Prints a line for each attempt, or the reason why there are none.
    pub fn print(&self, width: usize, data: &mut Data) -> Result<(), Failure> {
        let name = in_one_line(&self.submission);
        if let Some(reason) = self.reason() {
            data.line(format!("{name:width$}  {:>6}  {}", "-", in_one_line(&reason)))?;
        }
        for tried in &self.attempts {
            let Tried { seed, verdict, tick, contacts, reversals, .. } = tried;
            let far = far(tried);
            data.line(format!(
                "{name:width$}  {seed:>6}  {verdict:18}  {tick:>4}  {contacts:>8}  {reversals:>9}  {far}"
            ))?;
        }
        if let Some(other) = &self.same_as {
            data.line(format!("{name:width$}  {:>6}  the same inputs as {}", "-", in_one_line(other)))?;
        }
        if self.criteria.iter().any(|c| c.name != "all") {
            let part =
                |c: &GradedCriterion| format!("{} {} of {}", c.name, rounded(c.points.0), rounded(c.max_points.0));
            let parts: Vec<String> = self.criteria.iter().map(part).collect();
            let (points, of) = (self.points.map_or(0.0, |points| points.0), rounded(self.max_points.0));
            let points = rounded(points);
            data.line(format!("{name:width$}  {:>6}  {points} of {of} points: {}", "", parts.join(", ")))?;
        }
        Ok(())
    }
}

/// A text without line ends, so that no file's name makes a row of its own: they are written as their numbers, as in
/// `\u{a}`.
pub fn in_one_line(text: &str) -> String {
    let ends = |c: char| matches!(c, '\n' | '\u{2028}' | '\u{2029}');
    let mut line = String::new();
    for c in text.chars() {
        if ends(c) { line.extend(c.escape_unicode()) } else { line.push(c) }
    }
    line
}

/// Points with two decimals at most.
pub fn rounded(points: f64) -> String {
    let text = format!("{points:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// `0.350 m, 0.120 rad`: how far an attempt's configuration is from the goal.
fn far(tried: &Tried) -> String {
    match (&tried.metres, &tried.radians) {
        (Some(metres), Some(radians)) => format!("{:.3} m, {:.3} rad", metres.0, radians.0),
        _ => "another space".into(),
    }
}

/// An attempt as a line of text.
pub fn in_words(tried: &Tried) -> String {
    let Tried { seed, verdict, tick, contacts, reversals, .. } = tried;
    format!(
        "seed {seed}: {verdict} at tick {tick}, contacts {contacts}, reversals {reversals}, to the goal {}",
        far(tried)
    )
}
