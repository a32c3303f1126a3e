//! `PotentialField`, descent in a field that the goal attracts to and the obstacles repel from.

use crate::collision::Problem;
use crate::configuration::{Chart, Configuration, Coordinates};
use crate::num::{lesser, sqrt};
use crate::planning::{Metric, NoPath, Planner, SamplingSettings, Search};
use crate::robots::Robot;

/// How often a step is halved before the place counts as a local minimum.
const HALVINGS: u32 = 30;

/// The least decrease of the potential that makes a step worth taking, as a share of what its slope promises.
const SHARE: f64 = 1e-3;

/// The numbers of a potential field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldSettings {
    /// The factor of the attraction.
    pub attraction: f64,
    /// The distance to the goal beyond which the attraction is constant, by the metric.
    pub far: f64,
    /// The factor of the repulsion.
    pub repulsion: f64,
    /// The clearance beyond which nothing repels, metres.
    pub reach: f64,
}

/// Gradient descent in a potential field (Khatib, 1986; the formulas are those of Choset and others, 2005, section
/// 4.1): half the squared distance to the goal, from `far` on linear, plus half the square of `1 / clearance - 1 /
/// reach` within `reach` of the obstacles.
///
/// An iteration is one step down the gradient: halved until the potential falls and the edge is proven free. Where none
/// does, the planner is stuck in a local minimum and ends with [`NoPath::LocalMinimum`], whose node is there to be
/// shown. It needs [`Robot::jacobian`]; a robot without one ends it with [`NoPath::Unsuited`].
#[derive(Clone, Debug)]
pub struct PotentialField<R: Robot> {
    search: Search<R>,
    field: FieldSettings,
    step: f64,
    metric: Metric,
}

/// The potential at a configuration and its gradient.
struct Slope {
    potential: f64,
    gradient: Coordinates,
}

impl<R: Robot<Configuration: Chart>> PotentialField<R> {
    /// The planner in the usual field: obstacles repel within a twentieth of the space's radius.
    pub fn new(problem: Problem<R>) -> Self {
        let step = SamplingSettings::of(&problem).step;
        Self::in_field(problem, FieldSettings { attraction: 1.0, far: step, repulsion: 1e-3, reach: 0.25 * step })
    }

    /// The planner in this field.
    pub fn in_field(problem: Problem<R>, field: FieldSettings) -> Self {
        let SamplingSettings { metric, step, .. } = SamplingSettings::of(&problem);
        PotentialField { search: Search::from_start(problem), field, step: 0.25 * step, metric }
    }

    /// The potential at `q` and its gradient; `None` where the robot has no Jacobian.
    fn slope(&self, q: &R::Configuration) -> Option<Slope> {
        let FieldSettings { attraction, far, repulsion, reach } = self.field;
        let (away, distance) =
            (self.search.problem.goal().log(q).ok()?, self.metric.distance(q, &self.search.problem.goal()));
        let is_near = distance <= far;
        let pull = if is_near { attraction } else { attraction * far / distance };
        let mut potential = 0.5 * attraction * if is_near { distance * distance } else { far * (2.0 * distance - far) };
        let mut gradient: Coordinates = away.iter().map(|c| pull * c).collect();
        let (clearance, uphill) = self.search.problem.checker().chart_gradient(q).ok()?;
        if clearance < reach {
            let excess = 1.0 / clearance - 1.0 / reach;
            potential += 0.5 * repulsion * excess * excess;
            for (g, c) in gradient.iter_mut().zip(&uphill?) {
                *g -= repulsion * excess / (clearance * clearance) * c;
            }
        }
        Some(Slope { potential, gradient })
    }

    /// Goes to the goal where that is a step away and free, else down the gradient. The reason is why it does neither.
    fn descend(&mut self) -> Result<(), NoPath> {
        let node = self.search.growth.nodes().len() - 1;
        let (from, goal) = (self.search.at(node), self.search.problem.goal().in_chart());
        let is_near = self.metric.distance(&from, &goal) <= self.step;
        if is_near
            && let Some(end) = self.search.reach(node, goal)
            && self.search.take_branch(end)
        {
            return Ok(());
        }
        let unsuited = NoPath::Unsuited("the robot has no Jacobian");
        let Slope { potential, gradient } = self.slope(&from).ok_or(unsuited)?;
        let steepness = sqrt(gradient.iter().map(|g| g * g).sum());
        let mut length = lesser(self.step, self.metric.distance(&from, &goal));
        for _ in 0..HALVINGS {
            let down: Coordinates = gradient.iter().map(|g| -g * (length / steepness)).collect();
            if let Some(to) = from.exp(&down)
                && self.slope(&to).is_some_and(|below| below.potential < potential - SHARE * length * steepness)
                && self.search.reach(node, to).is_some()
            {
                return Ok(());
            }
            length *= 0.5;
        }
        Err(NoPath::LocalMinimum { node })
    }
}

impl<R: Robot<Configuration: Chart>> Planner<R> for PotentialField<R> {
    fn name(&self) -> &'static str {
        "potential-field"
    }

    fn search(&self) -> &Search<R> {
        &self.search
    }

    fn search_mut(&mut self) -> &mut Search<R> {
        &mut self.search
    }

    fn advance(&mut self) {
        self.search.end = self.descend().err();
    }
}
