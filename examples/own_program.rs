//! The lab's program with a planner of one's own among its planners: every command takes it by its name.
//!
//! ```text
//! cargo run --example own_program -- plan --planner detour --robot reach --from 2.0,0 --to 2.2,1.9 --gif detour.gif
//! cargo run --example own_program -- plan --compare detour,rrt-connect --robot reach --from 2.0,0 --to 2.2,1.9
//! cargo run --example own_program -- open
//! ```
use std::process::ExitCode;

use motion_lab::cli::Program;
use motion_lab::configuration::Chart;
use motion_lab::planning::{Planner, Search};
use motion_lab::plans::{LinePlanner, MadePlanner, OwnPlanner, PlannerError};
use motion_lab::prelude::*;

/// Goes from the start to the goal over one sample, the first that both see.
struct Detour<R: Robot>(Search<R>);

impl<R: Robot<Configuration: Chart>> Planner<R> for Detour<R> {
    fn name(&self) -> &'static str {
        DETOUR.id
    }

    fn search(&self) -> &Search<R> {
        &self.0
    }

    fn search_mut(&mut self) -> &mut Search<R> {
        &mut self.0
    }

    fn advance(&mut self) {
        let search = &mut self.0;
        let (over, goal) = (search.problem.sample(), search.problem.goal());
        search.growth.count_sample();
        // node 0 is the start
        let end = search.reach(0, over).and_then(|node| search.reach(node, goal));
        if let Some(end) = end {
            search.take_branch(end);
        }
    }
}

/// Makes it for any robot that goes along straight lines of its chart.
#[derive(Default)]
struct MakeDetour;

impl LinePlanner for MakeDetour {
    fn for_problem<R: Robot<Configuration: Chart>>(&self, problem: Problem<R>) -> MadePlanner<R> {
        Ok(Box::new(Detour(Search::from_start(problem))))
    }
}

static DETOUR: OwnPlanner =
    OwnPlanner::new("detour", "Detour", "Over one sample, the first that start and goal both see")
        .by_lines::<MakeDetour>()
        .drawing_samples();

fn main() -> Result<ExitCode, PlannerError> {
    Ok(Program::default().with_planner(&DETOUR)?.run())
}
