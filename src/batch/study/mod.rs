//! `Study`, a checked study with all it names: how many runs it has, and what each of them is.

mod checks;
mod draft;
mod filed;
mod problems;
mod varied;

use std::collections::BTreeMap;
use std::sync::Arc;

use super::axis::{CheckedAxis, NamedProblems, ProblemFiles};
use super::columns::{Column, RobotColumns, columns, heading, table_heading};
use super::error::{PLAN_VERSION, SweepProblem};
use super::failure_kind::{FailureKind, RunFailure};
use super::parameter::{Parameter, RunParameter};
use super::planning::{Planning, PlanningResult, RunLength};
use super::row::{RowValue, RunRow};
use super::study_text::{Bundle, FORMAT, GoalText, StudyItem, StudyText, digest_of};
use super::values::AxisValue;
pub use varied::VariedAxis;

use checks::{check, check_goal_everywhere, check_planner, check_robots, make_axes, planned_unit, robot_columns};
use draft::{RunDraft, generated};
use motion_lab_core::configuration::{Kinds, RobotKind, WrittenCoordinate};
use motion_lab_core::random::Seed;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{OutsideError, World};
use motion_lab_import::Scenario;
use motion_lab_sim::run::{Digest, Script};
use motion_lab_sim::tour::TourConfig;

/// Largest number of runs of a study that is refused where none of them can be; in a longer one every row says so.
const MAX_TRIED: u64 = 1000;

/// A run of a sweep: all that decides it.
#[derive(Clone, Debug, PartialEq)]
pub struct RunSetup {
    /// The seed.
    pub seed: Seed,
    /// The configuration; without ticks where a path says how many.
    pub config: TourConfig,
    /// How long it is.
    pub length: RunLength,
    /// What drives it.
    pub inputs: RunInputs,
}

/// What drives a run of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub enum RunInputs {
    /// A script; the robots that it leaves alone tour.
    Script(Script),
    /// The path of a planner, which is to be planned and played.
    Planner(Planning),
}

/// A checked study with the worlds and scripts it names.
///
/// ```
/// use motion_lab::batch::StudyFile;
/// use motion_lab::worlds::World;
///
/// let text = "Sweep(version: 1, worlds: [\"lot\"], axes: [\n\
///             (vary: \"seed\", over: Range(10, 13)), (vary: \"Hitch.start.x\", over: Steps(6, 7, 2))])";
/// let worlds = [("lot".to_owned(), World::lot())].into();
/// let study = StudyFile::parse("study.ron", text)?.with(&worlds, &[].into())?;
/// assert_eq!(study.runs(), 6);
/// let run = study.setup(3).unwrap();
/// assert_eq!((run.seed.0, run.config.worlds[0].robots[0].start[0]), (11, 7.0));
/// # Ok::<(), motion_lab::batch::StudyError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Study {
    line: String,
    digest: Digest,
    text: StudyText,
    worlds: BTreeMap<String, World>,
    scripts: BTreeMap<String, Script>,
    axes: Vec<CheckedAxis>,
    runs: u64,
    pub(super) robots: Vec<RobotColumns>,
    columns: Vec<Column>,
    pub(super) kinds: Kinds,
}

impl Study {
    /// The study in a line of [`line`](Self::line).
    ///
    /// # Errors
    /// The reason, in words, against a line that holds no study.
    pub fn of_line(line: &str) -> Result<Self, String> {
        let bundle: Bundle = serde_json::from_str(line).map_err(|error| format!("it holds no study: {error}"))?;
        if bundle.format != FORMAT {
            return Err(format!("its study has the format {:?}; this program reads {FORMAT:?}", bundle.format));
        }
        Study::of_bundle(bundle).map_err(|(_, problem)| format!("its study cannot be: {problem}"))
    }

    pub(super) fn of_bundle(bundle: Bundle) -> Result<Self, (StudyItem, SweepProblem)> {
        let whole = |problem: String| (StudyItem::Whole, SweepProblem::Run(problem));
        let mut worlds = BTreeMap::new();
        for (name, text) in &bundle.worlds {
            worlds.insert(name.clone(), World::parse_recorded(name, text).map_err(|error| whole(error.to_string()))?);
        }
        let mut scripts = BTreeMap::new();
        for (name, text) in &bundle.scripts {
            scripts.insert(name.clone(), Script::parse(name, text).map_err(|error| whole(error.to_string()))?);
        }
        let mut files = ProblemFiles::new();
        for (name, text) in &bundle.scenarios {
            let scenario = Scenario::parse(name, text).map_err(|error| whole(error.to_string()))?;
            files.insert(name.clone(), NamedProblems::Scenario(Arc::new(scenario)));
        }
        let mut filed_worlds = Vec::new();
        for (name, problems) in &bundle.problems {
            let set = problems.set().map_err(|reason| whole(format!("{name}: {reason}")))?;
            filed_worlds.extend(set.firsts().map(|task| task.world_at_start()));
            files.insert(name.clone(), NamedProblems::Filed(Arc::new(set)));
        }
        if let Some(sensor) = bundle.study.sensor {
            RangeSensor::try_new(sensor.rays, sensor.range).map_err(|error| whole(error.to_string()))?;
        }
        if bundle.study.version != PLAN_VERSION {
            return Err((StudyItem::Version, SweepProblem::Version(bundle.study.version)));
        }
        let yard = bundle.study.warehouse.map(|text| generated(text).map_err(whole)).transpose()?;
        let there: Vec<&World> = worlds.values().chain(&yard).chain(&filed_worlds).collect();
        check_robots(&bundle.study, &there)?;
        check_planner(&bundle.study)?;
        let axes = make_axes(&bundle.study, &there, &files)?;
        let runs = bundle.study.points.count(&axes).map_err(|(axis, problem)| {
            let item = axis.map_or(StudyItem::Points, StudyItem::Axis);
            (item, problem)
        })?;
        let robots = robot_columns(&bundle.study, &there);
        let columns = columns(&axes, bundle.study.goal.is_some(), planned_unit(&bundle.study, &there), &robots);
        let line = serde_json::to_string(&bundle).map_err(|error| whole(error.to_string()))?;
        let (digest, text, kinds) = (digest_of(&line), bundle.study, Kinds::default());
        Ok(Study { line, digest, text, worlds, scripts, axes, runs, robots, columns, kinds })
    }

    /// The study with all it names as one line of JSON, from which [`of_line`](Self::of_line) makes it again.
    pub fn line(&self) -> &str {
        &self.line
    }

    /// The digest of that line. Comments and blanks of the study file are no part of it.
    pub fn digest(&self) -> Digest {
        self.digest
    }

    /// The number of runs, at least 1.
    pub fn runs(&self) -> u64 {
        self.runs
    }

    /// The columns of the rows.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The names of the columns as a line of comma-separated values, without its end.
    pub fn heading(&self) -> String {
        heading(&self.columns)
    }

    /// The names of the columns as the first line of a table for others, none of them a formula.
    pub fn table_heading(&self) -> String {
        table_heading(&self.columns)
    }

    /// What the writer of the study may have meant by angles of more than a turn: a sentence for each axis, and for the
    /// goal, that has some.
    pub fn turns(&self) -> Vec<String> {
        let of_axis = |axis: &CheckedAxis| Some(format!("{}: {}", axis.parameter.name(), axis.turns()?));
        let of_goal = || {
            let GoalText { robot, at, within } = self.goal()?;
            let resident = self.worlds.values().flat_map(|world| &world.robots).find(|known| known.name == *robot)?;
            let lengths = RobotKind::of(&resident.kind)?.lengths;
            Some(format!(
                "goal: {}",
                [at, within]
                    .into_iter()
                    .find_map(|written| WrittenCoordinate::all_turns_in_ron(written, lengths).next())?
            ))
        };
        self.axes.iter().filter_map(of_axis).chain(of_goal()).collect()
    }

    /// The names of the axes and the numbers of their values; `None` for a range without steps.
    pub fn axes(&self) -> impl Iterator<Item = (String, Option<u64>)> {
        self.axes.iter().map(|axis| (axis.parameter.name(), axis.len()))
    }

    /// The axes of two to twelve values, in their order.
    pub fn varied(&self) -> Vec<VariedAxis> {
        self.axes.iter().enumerate().filter_map(|(number, axis)| VariedAxis::of(number, axis)).collect()
    }

    /// For each of these axes, the number of the value that a row has among [`VariedAxis::values`].
    pub fn values_of(&self, axes: &[VariedAxis], row: u64) -> Vec<usize> {
        let values = self.values(row);
        axes.iter().map(|axis| axis.number_of(&values)).collect()
    }

    pub(super) fn goal(&self) -> Option<&GoalText> {
        self.text.goal.as_ref()
    }

    fn values(&self, row: u64) -> Vec<AxisValue> {
        self.text.points.values(&self.axes, row)
    }

    /// The run of a row.
    ///
    /// # Errors
    /// The reason, in words, why there is no such run: a start beyond the lab, a chassis too short for its axles.
    pub fn setup(&self, row: u64) -> Result<RunSetup, String> {
        let values = self.values(row);
        let mut draft = RunDraft::of(&self.text);
        for (axis, value) in self.axes.iter().zip(&values) {
            if let Parameter::Run(of) = axis.parameter {
                draft.set(of, value)?;
            }
        }
        let filed = filed::task_of(&values)?;
        let mut worlds = match &filed {
            Some(task) => vec![task.world_at_start()],
            None => self.worlds_of(&draft)?,
        };
        worlds.iter_mut().for_each(|world| world.robots.retain(|robot| self.text.keeps(&robot.name)));
        if worlds.iter().all(|world| world.robots.is_empty()) {
            return Err("no robot takes part in this run".into());
        }
        for (axis, value) in self.axes.iter().zip(&values) {
            if let Parameter::Robot { robot, of, .. } = &axis.parameter {
                let resident = worlds.iter_mut().flat_map(|world| &mut world.robots).find(|r| r.name == *robot);
                let resident = resident.ok_or_else(|| format!("there is no robot {robot:?} in this run"))?;
                of.apply(resident, value).map_err(|reason| format!("{}: {reason}", axis.parameter.name()))?;
            }
        }
        let goal = match (self.goal().map(|goal| problems::varied(goal, &self.axes, &values)), &filed) {
            (Some(goal), Some(task)) => Some(filed::goal_at(&goal, task)?),
            (Some(goal), None) => {
                let problem = problems::placed(&goal, &values, &worlds)?;
                problems::start_at(&goal, problem, &mut worlds);
                Some(problems::goal_at(&goal, problem))
            }
            (None, _) => None,
        };
        for resident in worlds.iter_mut().flat_map(|world| &mut world.robots) {
            let Some(reason) = check(&resident.kind, resident.sizes.as_ref(), resident.sensor) else { continue };
            return Err(format!("{}: {reason}", resident.name));
        }
        for world in &worlds {
            let refused = |(i, reason): (usize, OutsideError)| format!("{}: {reason}", world.robots[i].name);
            world.check_residents().map_err(refused)?;
        }
        if let Some(goal) = &goal {
            check_goal_everywhere(goal, &worlds)?;
        }
        let inputs = match (&draft.planner, &draft.script) {
            (Some(planner), _) => RunInputs::Planner(planner.planning(goal.as_ref(), &worlds)?),
            (None, None) => RunInputs::Script(Script::empty()),
            (None, Some(name)) => {
                let script = self.scripts.get(name).ok_or_else(|| format!("there is no script {name:?}"))?;
                RunInputs::Script(script.clone())
            }
        };
        let ticks = draft.length.ticks().unwrap_or(0);
        let config = TourConfig { worlds, ticks, sensor: draft.sensor };
        config.validate().map_err(|error| error.to_string())?;
        Ok(RunSetup { seed: Seed(draft.seed), config, length: draft.length, inputs })
    }

    fn worlds_of(&self, draft: &RunDraft) -> Result<Vec<World>, String> {
        let mut worlds = Vec::with_capacity(draft.worlds.len() + 1);
        for name in &draft.worlds {
            worlds.push(self.worlds.get(name).ok_or_else(|| format!("there is no world {name:?}"))?.clone());
        }
        worlds.extend(draft.warehouse.map(generated).transpose()?);
        Ok(worlds)
    }

    /// The goal of a row's run in its worlds.
    pub(super) fn goal_of(&self, row: u64, worlds: &[World]) -> Option<GoalText> {
        let values = self.values(row);
        let goal = self.goal().map(|goal| problems::varied(goal, &self.axes, &values))?;
        if let Ok(Some(task)) = filed::task_of(&values) {
            return filed::goal_at(&goal, &task).ok();
        }
        // where the map is another the run could not be
        let problem = problems::placed(&goal, &values, worlds).ok().flatten();
        Some(problems::goal_at(&goal, problem))
    }

    /// Checks that there is a run that can be, in studies of at most [`MAX_TRIED`] runs.
    pub(super) fn check_runs(&self) -> Result<(), SweepProblem> {
        let mut first = None;
        for row in 0..self.runs.min(MAX_TRIED) {
            match self.setup(row) {
                Ok(_) => return Ok(()),
                Err(reason) => first = first.or(Some(reason)),
            }
        }
        match first {
            Some(reason) if self.runs <= MAX_TRIED => Err(SweepProblem::NoRun { runs: self.runs, reason }),
            _ => Ok(()),
        }
    }

    /// The cells that say what is run in a row: its number, seed and length, and the values of the axes.
    pub fn parameters(&self, row: u64) -> Vec<RowValue> {
        let values = self.values(row);
        let mut draft = RunDraft::of(&self.text);
        for (axis, value) in self.axes.iter().zip(&values) {
            if let Parameter::Run(of @ (RunParameter::Seed | RunParameter::Ticks | RunParameter::World)) =
                axis.parameter
            {
                // the first two take every whole number, the third every name
                let _ = draft.set(of, value);
            }
        }
        let worlds: Vec<&World> = draft.worlds.iter().filter_map(|name| self.worlds.get(name)).collect();
        let mut cells = Vec::new();
        for (axis, value) in self.axes.iter().zip(values) {
            if matches!(axis.parameter, Parameter::Run(RunParameter::Seed | RunParameter::Ticks)) {
                continue;
            }
            match value {
                AxisValue::Whole(n) => cells.push(RowValue::Whole(n)),
                AxisValue::Number(x) => cells.push(RowValue::Number(x)),
                AxisValue::Name(name) => cells.push(RowValue::text(name)),
                AxisValue::Problem(problem) => cells.extend(problems::cells(&problem, self.goal(), &worlds)),
                AxisValue::Filed(problem) => {
                    let kinds = problem.problems.kinds();
                    let of = |kind| filed::cells(&problem, kind, !filed::varies_sizes(self.goal(), &self.axes));
                    cells.extend(kinds.first().map(|kind| of(kind)).unwrap_or_default());
                }
                AxisValue::Configuration(q) => {
                    let width = axis.parameter.configured().map_or(0, |kind| kind.coordinates.len());
                    cells.extend((0..width).map(|i| RowValue::finite(q.get(i).copied())));
                }
            }
        }
        let ticks = draft.length.ticks().map_or(RowValue::Empty, RowValue::Whole);
        let head = [RowValue::Whole(row), RowValue::Whole(draft.seed), ticks];
        head.into_iter().chain(cells).collect()
    }

    /// The first column in which a row says another run than the study has in that row: its number, seed, length, or a
    /// value of an axis. `None` where it says the study's own.
    ///
    /// ```
    /// use motion_lab::batch::{RowValue, StudyFile};
    /// let text = "Sweep(version: 1, worlds: [\"lot\"], axes: [(vary: \"seed\", over: Range(10, 13))])";
    /// let worlds = [("lot".to_owned(), motion_lab::worlds::World::lot())].into();
    /// let study = StudyFile::parse("study.ron", text)?.with(&worlds, &[].into())?;
    /// let mut row = study.failed(2, "made up");
    /// assert_eq!(study.contradicted(&row), None);
    /// row.cells[1] = RowValue::Whole(11);
    /// assert_eq!(study.contradicted(&row).unwrap().0.name, "seed");
    /// # Ok::<(), motion_lab::batch::StudyError>(())
    /// ```
    pub fn contradicted(&self, row: &RunRow) -> Option<(&Column, RowValue)> {
        let own = self.parameters(row.row);
        let differs = |(i, cell): &(usize, RowValue)| row.cells.get(*i).map(RowValue::to_text) != Some(cell.to_text());
        let (i, cell) = own.into_iter().enumerate().find(differs)?;
        Some((self.columns.get(i)?, cell))
    }

    /// The row of a run that could not be [set up](Self::setup), with the reason; with an empty one, a row without any
    /// result.
    pub fn failed(&self, row: u64, reason: &str) -> RunRow {
        self.failed_by(row, &RunFailure::new(FailureKind::Setup, reason))
    }

    /// The row of a run that could not be run.
    pub fn failed_by(&self, row: u64, failure: &RunFailure) -> RunRow {
        let mut cells = self.parameters(row);
        cells.extend(failure.cells());
        cells.resize(self.columns.len(), RowValue::Empty);
        RunRow { row, cells }
    }

    /// The row of a path that no run plays.
    pub fn planned(&self, row: u64, planned: &PlanningResult) -> RunRow {
        self.with_planned(self.failed(row, ""), planned)
    }

    /// The row with what came of planning its path. In a study without a planner nothing is changed.
    pub fn with_planned(&self, mut row: RunRow, planned: &PlanningResult) -> RunRow {
        if let Some(first) = self.columns.iter().position(|column| column.name == "solved") {
            row.cells.iter_mut().skip(first).zip(planned.cells()).for_each(|(cell, known)| *cell = known);
        }
        row
    }
}
