//! The path through corners that somebody names, proven as a planner's is.

use motion_lab_core::collision::Problem;
use motion_lab_core::configuration::{AnyConfiguration, Chart, Configuration};
use motion_lab_core::planning::{CertifiedPath, NoPath, PathError, Planner, Search};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::Robot;

use super::attempt::PlanAttempt;
use super::own::{LinePlanner, MadePlanner, OwnPlanner};
use super::task::Task;

/// Who found a path whose corners were named.
static CORNERS: OwnPlanner = OwnPlanner::new("corners", "Corners", "Goes by straight lines through named corners");

impl OwnPlanner {
    /// Who found a path whose corners were [named](Task::attempt_through).
    pub fn of_corners() -> &'static OwnPlanner {
        &CORNERS
    }
}

/// Tries the lines through these corners, once.
struct CornerLines<'a>(&'a [AnyConfiguration]);

/// The lines through corners, as a planner that has one path or none.
struct CornerSearch<R: Robot> {
    search: Search<R>,
    corners: Vec<R::Configuration>,
}

impl Task {
    /// The straight lines through these corners, from the task's start to its goal, ready to be proven in one
    /// iteration. They keep the task's clearance, where nobody says one none.
    ///
    /// # Errors
    /// [`NoPath`]: the ends are in contact or none of the robot's, or the robot is a car, which drives no such lines.
    /// Then [`solve`](PlanAttempt::solve) says which line is not proven free, and what it hits.
    pub fn attempt_through(&self, corners: &[AnyConfiguration]) -> Result<Box<dyn PlanAttempt>, NoPath> {
        self.attempt_by_lines(&CornerLines(corners), CORNERS.draws_samples, Seed(0))
    }
}

impl LinePlanner for CornerLines<'_> {
    fn for_problem<R: Robot<Configuration: Chart>>(&self, problem: Problem<R>) -> MadePlanner<R> {
        // a rover is planned as a disc, of the first two of its coordinates
        let width = problem.start().coordinates().len();
        let corner = |q: &AnyConfiguration| R::Configuration::from_coordinates(q.coordinates().get(..width)?);
        let corners: Option<Vec<_>> = self.0.iter().map(|q| corner(q).map(|q| q.in_chart())).collect();
        let corners = corners.ok_or(NoPath::Unsuited("a corner is none of the robot's configurations"))?;
        Ok(Box::new(CornerSearch { search: Search::from_start(problem), corners }))
    }
}

impl<R: Robot<Configuration: Chart>> Planner<R> for CornerSearch<R> {
    fn name(&self) -> &'static str {
        CORNERS.id
    }

    fn search(&self) -> &Search<R> {
        &self.search
    }

    fn search_mut(&mut self) -> &mut Search<R> {
        &mut self.search
    }

    fn advance(&mut self) {
        let CornerSearch { search, corners } = self;
        let mut reached = Some(0);
        for corner in corners.iter().skip(1) {
            reached = reached.and_then(|node| search.reach(node, *corner));
        }
        match CertifiedPath::through(search.problem.checker(), corners) {
            Ok(path) if path.solves(&search.problem) == Err(PathError::OtherEnds) => {
                search.end = Some(NoPath::Refused(PathError::OtherEnds));
            }
            Ok(path) => search.path = Some(path),
            Err(error) => search.end = Some(NoPath::Refused(error)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plans::PathLengths;
    use motion_lab_core::configuration::Tn;
    use motion_lab_core::num::hypot;
    use motion_lab_core::planning::Bounds;

    fn arm(q: [f64; 2]) -> AnyConfiguration {
        AnyConfiguration::T2(Tn(q))
    }

    fn through(task: &Task, corners: &[[f64; 2]]) -> Result<PathLengths, NoPath> {
        let corners: Vec<AnyConfiguration> = corners.iter().copied().map(arm).collect();
        let mut attempt = task.attempt_through(&corners)?;
        attempt.solve(&Bounds::default())?;
        assert_eq!(attempt.verify().unwrap().unwrap(), attempt.lengths().clearance);
        Ok(attempt.lengths())
    }

    #[test]
    fn named_corners_are_a_path_where_every_line_is_proven() {
        let task = Task::round_the_post();
        // away from the post, over an edge of the square, and on to the goal from the other side
        let corners = [[2.0, 0.0], [0.0, 2.5], [-2.0, -1.5], [3.1, 0.0]];
        let direct = through(&task, &[[2.0, 0.0], [3.1, 0.0]]).unwrap_err();
        assert!(direct.to_string().contains("leg 0 hits "), "{direct}");
        let found = through(&task, &corners);
        let Ok(PathLengths { length, clearance }) = found else { panic!("{found:?}") };
        // by Pythagoras; the elbow goes from 2.5 to -1.5 by a turn less 4, and joint 1 from -2 to 3.1 by one less 5.1
        let turn = std::f64::consts::TAU;
        let by_hand = hypot(2.0, 2.5) + hypot(2.0, turn - 4.0) + hypot(turn - 5.1, 1.5);
        assert!((length - by_hand).abs() < 1e-12 && clearance > 0.0, "{length} {clearance}");
        // what it does not keep is refused, and so is a path to somewhere else
        let wide = Task { clearance: Some(clearance + 0.2), ..task.clone() };
        assert!(through(&wide, &corners).is_err());
        assert_eq!(through(&task, &corners[..3]), Err(NoPath::Refused(PathError::OtherEnds)));
        assert_eq!(through(&task, &[]), Err(NoPath::Refused(PathError::Empty)));
    }
}
