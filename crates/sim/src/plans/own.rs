//! `OwnPlanner`, a planner of a program's own, by name.

use motion_lab_core::collision::Problem;
use motion_lab_core::configuration::Chart;
use motion_lab_core::planning::{NoPath, Planner};
use motion_lab_core::robots::{AnyRobot, ChartLine, Hitch, HitchArc, Reach, Robot, RustyDisc};

/// What a maker makes: the planner with its problem before its first iteration, or why there is none.
pub type MadePlanner<R, M = ChartLine<R>> = Result<Box<dyn Planner<R, M> + Send>, NoPath>;

/// Makes a planner of a problem.
pub type PlannerMaker<R, M = ChartLine<R>> = fn(Problem<R>) -> MadePlanner<R, M>;

/// A planner of a program's own: what it is called, and how it is made for each kind of robot that it plans for.
///
/// [`Planners::register`](super::Planners::register) puts it among the lab's planners.
#[derive(Clone, Copy, Debug)]
pub struct OwnPlanner {
    /// The name by which the command line, studies and files name it: small letters, digits and hyphens, of at most 40
    /// characters. Its [`Planner::name`] is the same.
    pub id: &'static str,
    /// Its name in lists for people.
    pub title: &'static str,
    /// What it does, in a line.
    pub words: &'static str,
    /// Whether its paths come near obstacles by chance, as those of planners that join samples: unless somebody says
    /// another, they are to keep a [margin](motion_lab_core::planning::MARGIN).
    pub draws_samples: bool,
    /// The number of iterations that it does unless more are allowed.
    pub iterations: u64,
    /// Makes it for a rover, a disc that is larger by the task's tube.
    pub disc: Option<PlannerMaker<RustyDisc>>,
    /// Makes it for an arm of two links.
    pub arm: Option<PlannerMaker<Reach<2>>>,
    /// Makes it for an arm of three links.
    pub arm3: Option<PlannerMaker<Reach<3>>>,
    /// Makes it for a car, with its trailer if it starts with one.
    pub car: Option<PlannerMaker<Hitch, HitchArc>>,
}

/// Makes a planner that is the same for every robot that can go along straight lines of its chart: rovers and arms.
pub trait LinePlanner {
    /// The planner with its problem before its first iteration.
    ///
    /// # Errors
    /// [`NoPath::Unsuited`]: it does not plan for this robot.
    fn for_problem<R: Robot<Configuration: Chart>>(&self, problem: Problem<R>) -> MadePlanner<R>;
}

impl OwnPlanner {
    /// A planner that is made for no robot yet, and draws no samples.
    #[must_use]
    pub const fn new(id: &'static str, title: &'static str, words: &'static str) -> Self {
        let (disc, arm, arm3, car) = (None, None, None, None);
        OwnPlanner { id, title, words, draws_samples: false, iterations: 100_000, disc, arm, arm3, car }
    }

    /// The planner, made for rovers and for arms of two and of three links.
    #[must_use]
    pub const fn by_lines<P: LinePlanner + Default>(self) -> Self {
        OwnPlanner { disc: Some(made::<P, _>), arm: Some(made::<P, _>), arm3: Some(made::<P, _>), ..self }
    }

    /// The same planner, said to join samples that it draws.
    #[must_use]
    pub const fn drawing_samples(self) -> Self {
        OwnPlanner { draws_samples: true, ..self }
    }

    /// Whether it is made for robots of this kind.
    pub(super) const fn suits(&self, robot: &AnyRobot) -> bool {
        match robot {
            AnyRobot::Rusty(_) => self.disc.is_some(),
            AnyRobot::Reach(_) => self.arm.is_some(),
            AnyRobot::Reach3(_) => self.arm3.is_some(),
            AnyRobot::Hitch(_) => self.car.is_some(),
        }
    }

    /// Whether it is made for any robot.
    pub(super) const fn suits_any(&self) -> bool {
        self.disc.is_some() || self.arm.is_some() || self.arm3.is_some() || self.car.is_some()
    }
}

fn made<P: LinePlanner + Default, R: Robot<Configuration: Chart>>(problem: Problem<R>) -> MadePlanner<R> {
    P::default().for_problem(problem)
}

// a maker is no value to be compared
impl PartialEq for OwnPlanner {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl Eq for OwnPlanner {}
