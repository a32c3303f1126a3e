//! `Score`, the points that a submission earns.

use super::{Attempt, Points};

/// The points of a submission.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Score {
    /// The points earned.
    pub points: f64,
    /// The points that could be earned.
    pub of: f64,
    /// The criteria that are worth points, in the order of [`Points`].
    pub criteria: Vec<Criterion>,
}

/// A criterion and what a submission earns by it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Criterion {
    /// `goal`, `contacts` or `reversals`; `all` in an assignment without points, which is worth 1 point, for passing.
    pub name: &'static str,
    /// The points earned.
    pub points: f64,
    /// The points that could be earned.
    pub of: f64,
    /// The number of seeds at which it is met.
    pub met: usize,
}

impl Score {
    /// The score of a submission with these attempts, of `seeds` seeds.
    pub(super) fn of(points: Option<Points>, attempts: &[Attempt], seeds: usize) -> Self {
        let met = |by: fn(&Attempt) -> bool| attempts.iter().filter(|attempt| by(attempt)).count();
        let part = |name, of: f64, met: usize| Criterion { name, points: of * met as f64 / seeds as f64, of, met };
        let criteria: Vec<Criterion> = match points {
            Some(Points { goal, contacts, reversals }) => [
                part("goal", goal, met(|attempt| attempt.met.goal)),
                part("contacts", contacts, met(|attempt| attempt.met.contacts)),
                part("reversals", reversals, met(|attempt| attempt.met.reversals)),
            ]
            .into_iter()
            .filter(|criterion| criterion.of > 0.0)
            .collect(),
            None => {
                let met = met(Attempt::passed);
                let points = if met == seeds { 1.0 } else { 0.0 };
                vec![Criterion { name: "all", points, of: 1.0, met }]
            }
        };
        let sum = |value: fn(&Criterion) -> f64| criteria.iter().map(value).sum();
        Score { points: sum(|criterion| criterion.points), of: sum(|criterion| criterion.of), criteria }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::{AttemptOutcome, Met};
    use motion_lab_core::configuration::Coordinates;
    use motion_lab_core::random::Seed;

    fn attempt(goal: bool, contacts: bool) -> Attempt {
        let verdict = if goal && contacts { AttemptOutcome::Passed } else { AttemptOutcome::Contacts };
        let met = Met { goal, contacts, reversals: false };
        let configuration = Coordinates::new();
        Attempt { seed: Seed(1), verdict, tick: 1, contacts: 0, reversals: 0, configuration, distance: None, met }
    }

    #[test]
    fn points_are_in_proportion_to_the_seeds_and_without_any_it_is_all_or_nothing() {
        let attempts = [attempt(true, true), attempt(true, false), attempt(false, false), attempt(true, false)];
        let points = Points { goal: 8.0, contacts: 2.0, reversals: 0.0 };
        let score = Score::of(Some(points), &attempts, 4);
        assert_eq!((score.points, score.of), (6.0 + 0.5, 10.0));
        let parts: Vec<_> = score.criteria.iter().map(|c| (c.name, c.points, c.of, c.met)).collect();
        assert_eq!(parts, [("goal", 6.0, 8.0, 3), ("contacts", 0.5, 2.0, 1)], "no points, no criterion");
        let plain = |attempts: &[Attempt]| Score::of(None, attempts, 2).points;
        assert_eq!(
            [plain(&attempts[..2]), plain(&[attempt(true, true), attempt(true, true)]), plain(&[])],
            [0.0, 1.0, 0.0]
        );
    }
}
