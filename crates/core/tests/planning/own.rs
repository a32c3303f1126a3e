//! A planner of one's own, an honest one and some that lie.

use motion_lab_core::planning::{CertifiedPath, Growth, PathError};
use motion_lab_core::robots::ChartLine;

use super::*;

/// Tries the detour over one configuration.
struct Detour {
    problem: Problem<RustyDisc>,
    over: R2,
    growth: Growth<R2, ChartLine<RustyDisc>>,
    path: Option<LinePath<RustyDisc>>,
    lie: Lie,
}

#[derive(Clone, Copy, PartialEq)]
enum Lie {
    None,
    NoPath,
    OtherScene,
    OtherGoal,
    Never,
}

impl Detour {
    fn new(lie: Lie, over: R2) -> Self {
        let (start, goal) = (R2::new(-1.0, 0.0), R2::new(1.0, 0.0));
        let problem = Problem::try_new(room(&[[0.0, -0.5, 0.0, 0.5]]), start, goal, Seed(1)).unwrap();
        Detour { problem, over, growth: Growth::new(), path: None, lie }
    }
}

impl Planner<RustyDisc> for Detour {
    fn name(&self) -> &'static str {
        "detour"
    }

    fn problem(&self) -> &Problem<RustyDisc> {
        &self.problem
    }

    fn step(&mut self) -> Progress {
        if self.lie == Lie::Never {
            return Progress::Growing;
        }
        let goal = if self.lie == Lie::OtherGoal { R2::new(-1.0, 1.0) } else { self.problem.goal() };
        let corners = [self.problem.start(), self.over, goal];
        let empty = room(&[]);
        let checker = if self.lie == Lie::OtherScene { &empty } else { self.problem.checker() };
        if self.lie != Lie::NoPath {
            self.path = CertifiedPath::through(checker, &corners).ok();
        }
        if self.path.is_some() || self.lie != Lie::None { Progress::Solved } else { Progress::Growing }
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
}

#[test]
fn an_honest_planner_of_ones_own_plugs_in() {
    let path = solve(&mut Detour::new(Lie::None, R2::new(0.0, 0.8)), &Bounds::default()).unwrap();
    assert_eq!(path.corners(), [R2::new(-1.0, 0.0), R2::new(0.0, 0.8), R2::new(1.0, 0.0)]);
    // it counts nothing, and is bounded all the same: its detour hits the wall
    let ended = solve(&mut Detour::new(Lie::None, R2::new(0.0, 0.2)), &Bounds::of_iterations(50)).unwrap_err();
    assert!(matches!(ended, NoPath::Exhausted { bound: Bound::Iterations, effort } if effort.iterations == 50));
}

#[test]
fn a_planner_that_lies_is_found_out() {
    let lie = |lie, over| solve(&mut Detour::new(lie, over), &Bounds::of_iterations(50)).unwrap_err();
    let round = R2::new(0.0, 0.8);
    assert_eq!(lie(Lie::NoPath, round), NoPath::Refused(PathError::Missing));
    assert_eq!(lie(Lie::OtherGoal, R2::new(-1.0, 0.5)), NoPath::Refused(PathError::OtherEnds));
    let through_the_wall = lie(Lie::OtherScene, R2::new(0.0, 0.2));
    assert!(matches!(through_the_wall, NoPath::Refused(PathError::Certificate { leg: 0, .. })), "{through_the_wall}");
    assert!(matches!(lie(Lie::Never, round), NoPath::Exhausted { .. }));
}
