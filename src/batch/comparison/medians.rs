//! `PlannerMedians`, what came of a planner at all its attempts.

use std::collections::BTreeMap;

use motion_lab_sim::capture::CostCurve;
use motion_lab_sim::export::JsonNumber;
use motion_lab_sim::plans::{PathLengths, PlannerName};
use serde::Serialize;

use super::compared::{ComparedAttempt, PlannerComparison};

/// What came of one planner: medians over the attempts that have a path, `None` without any.
#[derive(Clone, Debug, Serialize)]
pub struct PlannerMedians {
    /// The name of the set of problems, where a file has several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub set: Option<String>,
    /// The planner's [name](PlannerName::id).
    pub planner: String,
    /// The number of attempts that have a path.
    pub solved: usize,
    /// The number of attempts.
    pub attempts: usize,
    /// How long it took.
    pub milliseconds: Option<f64>,
    /// The edges that it asked about.
    pub edges: Option<f64>,
    /// The length of the path, in the unit of [`PathLengths`].
    pub length: Option<JsonNumber>,
    /// The clearance proven along the path, metres.
    pub clearance: Option<JsonNumber>,
    /// The length as a share of the shortest one that the scenario says.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub of_optimal: Option<f64>,
}

/// The middle of some numbers; the mean of the two middle ones of an even count. `None` without any.
fn median(mut numbers: Vec<f64>) -> Option<f64> {
    numbers.sort_by(f64::total_cmp);
    let n = numbers.len();
    (n > 0).then(|| 0.5 * (numbers[(n - 1) / 2] + numbers[n / 2]))
}

/// The median length of the paths that a planner's attempts have by a number of iterations; an attempt without one
/// counts as endless. Each step is a number of iterations at which it is another, with the median from there on.
fn median_cost(attempts: &[&ComparedAttempt]) -> Vec<(u64, f64)> {
    let mut moments: Vec<u64> = attempts.iter().flat_map(|a| a.costs.iter().map(|cost| cost.iterations)).collect();
    moments.sort_unstable();
    moments.dedup();
    let mut steps: Vec<(u64, f64)> = Vec::new();
    for moment in moments {
        let length = |attempt: &&ComparedAttempt| {
            let had = attempt.costs.iter().rfind(|cost| cost.iterations <= moment);
            had.map_or(f64::INFINITY, |cost| cost.length)
        };
        let Some(cost) = median(attempts.iter().map(length).collect()).filter(|cost| cost.is_finite()) else {
            continue;
        };
        if steps.last().is_none_or(|(_, last)| cost != *last) {
            steps.push((moment, cost));
        }
    }
    steps
}

impl PlannerComparison {
    /// How the lengths of the planners' paths fell, as medians over the attempts of each, in the planners' order.
    pub fn median_costs(&self, attempts: &[ComparedAttempt]) -> Vec<CostCurve> {
        let of = |planner: &PlannerName| {
            let own: Vec<_> = attempts.iter().filter(|a| a.planner == *planner && a.case.asked.is_some()).collect();
            let end = own.iter().map(|attempt| attempt.effort.iterations).max().unwrap_or(0);
            CostCurve { planner: planner.title().to_owned(), steps: median_cost(&own), end }
        };
        self.planners.iter().map(of).collect()
    }

    /// What came of each planner, in their order; of a file's sets, if there are several, one after the other. Numbers
    /// of which there is no problem do not count.
    pub fn medians(&self, attempts: &[ComparedAttempt]) -> Vec<PlannerMedians> {
        let names = self.problems().names();
        let mut of_set: BTreeMap<&str, Vec<&ComparedAttempt>> = BTreeMap::new();
        for attempt in attempts.iter().filter(|attempt| attempt.case.asked.is_some()) {
            let name = attempt.case.known.as_ref().map_or("", |known| known.set.as_str());
            of_set.entry(if names.len() < 2 { "" } else { name }).or_default().push(attempt);
        }
        let names = if names.len() < 2 { vec![""] } else { names };
        let lines = names.into_iter().flat_map(|name| {
            let own = of_set.remove(name).unwrap_or_default();
            let set = (!name.is_empty()).then_some(name);
            self.planners.iter().map(|planner| of_planner(set, *planner, &own)).collect::<Vec<_>>()
        });
        lines.collect()
    }
}

fn of_planner(set: Option<&str>, planner: PlannerName, attempts: &[&ComparedAttempt]) -> PlannerMedians {
    let own: Vec<&ComparedAttempt> = attempts.iter().copied().filter(|attempt| attempt.planner == planner).collect();
    let solved: Vec<(&ComparedAttempt, PathLengths)> =
        own.iter().filter_map(|attempt| Some((*attempt, *attempt.path.as_ref().ok()?))).collect();
    let of = |number: fn(&ComparedAttempt, PathLengths) -> f64| {
        median(solved.iter().map(|(attempt, path)| number(attempt, *path)).collect())
    };
    PlannerMedians {
        set: set.map(str::to_owned),
        planner: planner.id().to_owned(),
        solved: solved.len(),
        attempts: own.len(),
        milliseconds: of(|attempt, _| 1000.0 * attempt.seconds),
        edges: of(|attempt, _| attempt.effort.edges as f64),
        length: of(|_, path| path.length).map(JsonNumber),
        clearance: of(|_, path| path.clearance).map(JsonNumber),
        of_optimal: median(solved.iter().filter_map(|(a, path)| a.case.of_optimal(path.length)).collect()),
    }
}
