//! A planner of one's own, an honest one and some that lie.

use motion_lab_core::planning::{CertifiedPath, PathError, Search};

use super::*;

/// Tries the detour over one configuration.
struct Detour {
    search: Search<RustyDisc>,
    over: R2,
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
        Detour { search: Search::new(problem), over, lie }
    }
}

impl Planner<RustyDisc> for Detour {
    fn name(&self) -> &'static str {
        "detour"
    }

    fn search(&self) -> &Search<RustyDisc> {
        &self.search
    }

    fn search_mut(&mut self) -> &mut Search<RustyDisc> {
        &mut self.search
    }

    fn advance(&mut self) {
        if self.lie == Lie::Never {
            return;
        }
        let goal = if self.lie == Lie::OtherGoal { R2::new(-1.0, 1.0) } else { self.search.problem.goal() };
        let corners = [self.search.problem.start(), self.over, goal];
        let empty = room(&[]);
        let checker = if self.lie == Lie::OtherScene { &empty } else { self.search.problem.checker() };
        if self.lie != Lie::NoPath {
            self.search.path = CertifiedPath::through(checker, &corners).ok();
        }
    }

    fn step(&mut self) -> Progress {
        self.advance();
        let says_so = self.lie != Lie::None && self.lie != Lie::Never;
        if self.search.path.is_some() || says_so { Progress::Solved } else { Progress::Growing }
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
