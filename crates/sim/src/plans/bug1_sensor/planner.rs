//! `Bug1Sensor`, the walk as a planner.

use super::walk::{Bug1Walk, WalkEnd};
use motion_lab_core::collision::Problem;
use motion_lab_core::configuration::{Configuration, R2};
use motion_lab_core::planning::{NoPath, Planner, Search, Sensed};
use motion_lab_core::random::Stream;
use motion_lab_core::robots::RustyDisc;
use motion_lab_core::sensors::BeamModel;

/// Bug1 by its range sensor, as a planner: its growth is the way that it has walked, and an iteration a step.
///
/// With a noisy sensor it may misjudge where to leave a boundary, and find no path where there is one:
/// [`NoPath::GaveUp`]. So it does where its way leads out of the scene's bounds, which no sensor sees. With the exact
/// sensor [`NoPath::Enclosed`] says that the goal lies behind an obstacle.
#[derive(Clone, Debug)]
pub struct Bug1Sensor {
    search: Search<RustyDisc>,
    walk: Bug1Walk,
    is_exact: bool,
}

impl Bug1Sensor {
    /// The planner with an exact sensor, or with a noisy one whose draws come from a stream.
    pub fn new(problem: Problem<RustyDisc>, noise: Option<(BeamModel, Stream)>) -> Self {
        let (start, goal, is_exact) = (problem.start().in_chart(), problem.goal().in_chart(), noise.is_none());
        let walk = Bug1Walk::new(problem.checker(), [start.0, goal.0], noise);
        Bug1Sensor { search: Search::from_start(problem), walk, is_exact }
    }

    /// Takes a step; the reason is why there will be no path.
    fn go_on(&mut self) -> Option<NoPath> {
        let end = self.walk.step();
        if let Some(stopped) = self.walk.stopped() {
            // what stopped it is there to be drawn
            self.search.growth.ask(self.search.problem.checker(), stopped.clone());
        }
        if !self.search.problem.checker().scene().bounds().contains(self.walk.at()) {
            return Some(NoPath::GaveUp("its way leads out of the world, whose bounds its sensor does not see"));
        }
        if !self.go(R2(self.walk.at())) {
            return Some(NoPath::GaveUp("a step that its sensor allowed is not proven free"));
        }
        match end? {
            WalkEnd::Reached if self.go(self.search.problem.goal().in_chart()) => self.arrived(),
            WalkEnd::Behind if self.is_exact => {
                let kept = self.walk.keep() - self.search.problem.checker().robot().radius;
                Some(NoPath::Enclosed { kept })
            }
            end => Some(NoPath::GaveUp(match end {
                WalkEnd::Reached => "a wall lies before the goal, a step away",
                WalkEnd::NotClosed => "it never closed its round, 5,000 steps long",
                WalkEnd::NotFound => "it never came back to where the boundary had seemed nearest to the goal",
                WalkEnd::Behind => "its sensor shows the goal behind the obstacle",
                WalkEnd::TooManyRounds => "it has made 20 rounds",
            })),
        }
    }

    /// Goes straight to a configuration, if that is proven free.
    fn go(&mut self, to: R2) -> bool {
        let node = self.search.growth.nodes().len() - 1;
        self.search.at(node) == to || self.search.reach(node, to).is_some()
    }

    fn arrived(&mut self) -> Option<NoPath> {
        let nodes: Vec<usize> = (0..self.search.growth.nodes().len()).collect();
        let is_path = self.search.take(&nodes);
        (!is_path).then_some(NoPath::GaveUp("the way that it walked is not proven free"))
    }
}

impl Planner<RustyDisc> for Bug1Sensor {
    fn name(&self) -> &'static str {
        "bug1-sensor"
    }

    fn search(&self) -> &Search<RustyDisc> {
        &self.search
    }

    fn search_mut(&mut self) -> &mut Search<RustyDisc> {
        &mut self.search
    }

    fn advance(&mut self) {
        self.search.end = self.go_on();
    }

    fn sensed(&self) -> Option<Sensed> {
        Some(self.walk.sensed())
    }
}
