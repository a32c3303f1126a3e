//! `Bug1Sensor`, the walk as a planner.

use super::walk::{Bug1Walk, WalkEnd};
use motion_lab_core::collision::Problem;
use motion_lab_core::configuration::{Configuration, R2};
use motion_lab_core::planning::{Growth, LinePath, NoPath, Planner, Progress, Sensed};
use motion_lab_core::random::Stream;
use motion_lab_core::robots::{ChartLine, RustyDisc};
use motion_lab_core::sensors::BeamModel;

/// Bug1 by its range sensor, as a planner: its growth is the way that it has walked, and an iteration a step.
///
/// With a noisy sensor it may misjudge where to leave a boundary, and find no path where there is one:
/// [`NoPath::GaveUp`]. With the exact one [`NoPath::Enclosed`] says that the goal lies behind an obstacle.
#[derive(Clone, Debug)]
pub struct Bug1Sensor {
    problem: Problem<RustyDisc>,
    walk: Bug1Walk,
    is_exact: bool,
    growth: Growth<R2, ChartLine<RustyDisc>>,
    end: Option<Progress>,
    path: Option<LinePath<RustyDisc>>,
}

impl Bug1Sensor {
    /// The planner with an exact sensor, or with a noisy one whose draws come from a stream.
    pub fn new(problem: Problem<RustyDisc>, noise: Option<(BeamModel, Stream)>) -> Self {
        let (start, goal, is_exact) = (problem.start().in_chart(), problem.goal().in_chart(), noise.is_none());
        let mut growth = Growth::new();
        growth.add_root(start);
        let walk = Bug1Walk::new(problem.checker(), [start.0, goal.0], noise);
        Bug1Sensor { problem, walk, is_exact, growth, end: None, path: None }
    }

    fn advance(&mut self) -> Option<Progress> {
        let end = self.walk.step();
        if let Some(stopped) = self.walk.stopped() {
            // what stopped it is there to be drawn
            self.growth.ask(self.problem.checker(), stopped.clone());
        }
        if !self.go(R2(self.walk.at())) {
            return Some(Progress::Ended(NoPath::GaveUp("a step that its sensor allowed is not proven free")));
        }
        Some(match end? {
            WalkEnd::Reached if self.go(self.problem.goal().in_chart()) => self.arrived(),
            WalkEnd::Behind if self.is_exact => {
                let kept = self.walk.keep() - self.problem.checker().robot().radius;
                Progress::Ended(NoPath::Enclosed { kept })
            }
            end => Progress::Ended(NoPath::GaveUp(match end {
                WalkEnd::Reached => "a wall lies before the goal, a step away",
                WalkEnd::NotClosed => "it never closed its round, 5,000 steps long",
                WalkEnd::NotFound => "it never came back to where the boundary had seemed nearest to the goal",
                WalkEnd::Behind => "its sensor shows the goal behind the obstacle",
                WalkEnd::TooManyRounds => "it has made 20 rounds",
            })),
        })
    }

    /// Goes straight to a configuration, if that is proven free.
    fn go(&mut self, to: R2) -> bool {
        let node = self.growth.nodes().len() - 1;
        let from = self.growth.at(node);
        if from == to {
            return true;
        }
        let free = self.growth.ask_edge(self.problem.checker(), &from, &to);
        if free {
            self.growth.add(to, node);
        }
        free
    }

    fn arrived(&mut self) -> Progress {
        let corners: Vec<R2> = self.growth.nodes().iter().map(|node| node.at).collect();
        match LinePath::through(self.problem.checker(), &corners) {
            Ok(path) => {
                self.path = Some(path);
                Progress::Solved
            }
            Err(refused) => Progress::Ended(refused.into()),
        }
    }
}

impl Planner<RustyDisc> for Bug1Sensor {
    fn name(&self) -> &'static str {
        "bug1-sensor"
    }

    fn problem(&self) -> &Problem<RustyDisc> {
        &self.problem
    }

    fn step(&mut self) -> Progress {
        if self.end.is_none() {
            self.growth.begin_iteration();
            self.end = self.advance();
        }
        self.end.clone().unwrap_or(Progress::Growing)
    }

    fn growth(&self) -> &Growth<R2, ChartLine<RustyDisc>> {
        &self.growth
    }

    fn motion(&self, from: usize, to: usize) -> Option<ChartLine<RustyDisc>> {
        self.growth.line(self.problem.checker().robot(), from, to)
    }

    fn path(&self) -> Option<&LinePath<RustyDisc>> {
        self.path.as_ref()
    }

    fn sensed(&self) -> Option<Sensed> {
        Some(self.walk.sensed())
    }
}
