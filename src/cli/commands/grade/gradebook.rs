//! The grades as a table of comma-separated values, and as Gradescope's `results.json`.

use motion_lab_sim::export::csv_cell;
use serde::Serialize;

use crate::cli::support::words::counted;

use super::graded::{Graded, GradedCriterion, Tried, in_words, rounded};

/// The first row of the table.
pub const HEAD: &str = "submission,passed,points,max_points,seeds_passed,seeds,seed,verdict,tick,contacts,reversals,metres,radians,refused,same_as";

/// A submission's row. From `seed` on it is the first attempt that does not pass; if all pass, the first.
pub fn row(graded: &Graded) -> String {
    let passed = graded.attempts.iter().filter(|attempt| attempt.passed).count();
    let shown = graded.attempts.iter().find(|attempt| !attempt.passed).or(graded.attempts.first());
    let number = |value: Option<f64>| value.map_or_else(String::new, |x| format!("{x:.4}"));
    let attempt = match shown {
        Some(Tried { seed, verdict, tick, contacts, reversals, metres, radians, .. }) => {
            let (metres, radians) = (number(metres.map(|x| x.0)), number(radians.map(|x| x.0)));
            format!("{seed},{verdict},{tick},{contacts},{reversals},{metres},{radians}")
        }
        None => ",,,,,,".into(),
    };
    let Graded { submission, points, max_points, seeds, .. } = graded;
    format!(
        "{},{},{},{},{passed},{seeds},{attempt},{},{}",
        csv_cell(submission),
        graded.passed,
        points.map_or_else(String::new, |points| rounded(points.0)),
        rounded(max_points.0),
        csv_cell(&graded.reason().unwrap_or_default()),
        csv_cell(graded.same_as.as_deref().unwrap_or_default())
    )
}

/// Gradescope's `results.json` of one submission, as its autograder specification documents it. What was not graded has
/// no score: Gradescope says then that its autograder failed, and the submission waits for a person.
#[derive(Serialize)]
pub struct Results {
    #[serde(skip_serializing_if = "Option::is_none")]
    score: Option<f64>,
    output: String,
    tests: Vec<Test>,
}

/// A criterion as one of Gradescope's tests.
#[derive(Serialize)]
struct Test {
    name: String,
    score: f64,
    max_score: f64,
    /// `passed` or `failed`.
    status: &'static str,
    output: String,
}

impl Results {
    /// The results of a submission.
    pub fn new(graded: &Graded) -> Self {
        let Graded { attempts, seeds, .. } = graded;
        let lines: Vec<String> = attempts.iter().map(in_words).collect();
        let verdict = if graded.passed { "It passes at every seed." } else { "It does not pass." };
        let test = |criterion: &GradedCriterion| Test {
            name: match criterion.name {
                "goal" => "reaches the goal".into(),
                "all" => "passes at every seed".into(),
                limit => format!("reaches the goal within the limit of {limit}"),
            },
            score: criterion.points.0,
            max_score: criterion.max_points.0,
            status: if criterion.met == *seeds { "passed" } else { "failed" },
            output: format!("met at {} of {}", criterion.met, counted(seeds, "seed")),
        };
        Results {
            score: graded.points.map(|points| points.0),
            output: match graded.reason() {
                Some(reason) => reason,
                None => format!("{verdict}\n{}", lines.join("\n")),
            },
            tests: graded.criteria.iter().map(test).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use motion_lab_sim::export::JsonNumber;

    use super::*;

    #[test]
    fn the_row_shows_the_first_attempt_that_does_not_pass() {
        let tried = |seed, passed| Tried {
            seed,
            verdict: "v".into(),
            passed,
            tick: 9,
            contacts: 0,
            reversals: 0,
            configuration: Vec::new(),
            metres: None,
            radians: None,
        };
        let graded = |attempts: Vec<Tried>| Graded {
            submission: "s.ron".into(),
            passed: false,
            points: Some(JsonNumber(1.0)),
            max_points: JsonNumber(3.0),
            criteria: Vec::new(),
            seeds: attempts.len(),
            forged_at: None,
            refused: None,
            same_as: None,
            attempts,
        };
        let mixed = graded(vec![tried(4, true), tried(5, false), tried(6, false)]);
        assert_eq!(row(&mixed), "s.ron,false,1,3,1,3,5,v,9,0,0,,,,");
        assert_eq!(row(&graded(vec![tried(4, true), tried(5, true)])), "s.ron,false,1,3,2,2,4,v,9,0,0,,,,");
    }

    #[test]
    fn points_have_two_decimals_at_most() {
        assert_eq!((rounded(2.0), rounded(20.0 / 3.0), rounded(0.0)), ("2".into(), "6.67".into(), "0".into()));
    }
}
