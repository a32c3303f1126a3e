//! `SweepPlan`, a checked plan with all it names: how many runs it has, and what each of them is.

use std::collections::BTreeMap;

use super::axis::Axis;
use super::columns::{Column, RobotColumns, columns, heading};
use super::error::{PLAN_VERSION, SweepProblem};
use super::parameter::{Parameter, RobotParameter, RunParameter};
use super::plan_text::{Bundle, FORMAT, GoalText, Item, PlanText, WarehouseText, digest_of};
use super::row::{Cell, RunRow};
use super::values::{AxisValue, Over};
use crate::configuration::{Kinds, RobotKind};
use crate::random::Seed;
use crate::run::{Digest, Script};
use crate::sensors::RangeSensor;
use crate::tour::{BOOK_SEED, TourConfig};
use crate::worlds::{BeamModel, Resident, Warehouse, World, WorldProblem};

/// Largest number of robots that have columns of their own. With more, rows hold what is known of all robots together.
pub const MAX_ROBOT_COLUMNS: usize = 32;

/// Largest number of runs of a plan that is refused where none of them can be; in a longer one every row says so.
const MOST_TRIED: u64 = 1000;

/// A run of a sweep: all that decides it.
#[derive(Clone, Debug, PartialEq)]
pub struct RunSetup {
    /// The seed.
    pub seed: Seed,
    /// The configuration.
    pub config: TourConfig,
    /// The script.
    pub script: Script,
}

/// A checked plan with the worlds and scripts it names.
///
/// ```
/// use motion_lab::sweep::PlanFile;
/// use motion_lab::worlds::World;
///
/// let text = "Sweep(version: 1, worlds: [\"lot\"], axes: [\n\
///             (vary: \"seed\", over: Range(10, 13)), (vary: \"Hitch.start.x\", over: Steps(6, 7, 2))])";
/// let worlds = [("lot".to_owned(), World::lot())].into();
/// let plan = PlanFile::parse("plan.ron", text)?.with(&worlds, &[].into())?;
/// assert_eq!(plan.runs(), 6);
/// let run = plan.setup(3).unwrap();
/// assert_eq!((run.seed.0, run.config.worlds[0].robots[0].start[0]), (11, 7.0));
/// # Ok::<(), motion_lab::sweep::SweepPlanError>(())
/// ```
#[derive(Clone, Debug)]
pub struct SweepPlan {
    line: String,
    digest: Digest,
    text: PlanText,
    worlds: BTreeMap<String, World>,
    scripts: BTreeMap<String, Script>,
    axes: Vec<Axis>,
    runs: u64,
    pub(super) robots: Vec<RobotColumns>,
    columns: Vec<Column>,
    pub(super) kinds: Kinds,
}

impl SweepPlan {
    /// The plan in a line of [`line`](Self::line).
    ///
    /// # Errors
    /// The reason, in words, against a line that holds no plan.
    pub fn of_line(line: &str) -> Result<Self, String> {
        let bundle: Bundle = serde_json::from_str(line).map_err(|error| format!("it holds no plan: {error}"))?;
        if bundle.format != FORMAT {
            return Err(format!("its plan has the format {:?}; this program reads {FORMAT:?}", bundle.format));
        }
        SweepPlan::of_bundle(bundle).map_err(|(_, problem)| format!("its plan cannot be: {problem}"))
    }

    pub(super) fn of_bundle(bundle: Bundle) -> Result<Self, (Item, SweepProblem)> {
        let whole = |problem: String| (Item::Whole, SweepProblem::Run(problem));
        let mut worlds = BTreeMap::new();
        for (name, text) in &bundle.worlds {
            worlds.insert(name.clone(), World::parse(name, text).map_err(|error| whole(error.to_string()))?);
        }
        let mut scripts = BTreeMap::new();
        for (name, text) in &bundle.scripts {
            scripts.insert(name.clone(), Script::parse(name, text).map_err(|error| whole(error.to_string()))?);
        }
        if let Some(sensor) = bundle.plan.sensor {
            RangeSensor::try_new(sensor.rays, sensor.range).map_err(|error| whole(error.to_string()))?;
        }
        if bundle.plan.version != PLAN_VERSION {
            return Err((Item::Version, SweepProblem::Version(bundle.plan.version)));
        }
        let yard = bundle.plan.warehouse.map(|text| generated(text).map_err(whole)).transpose()?;
        let there: Vec<&World> = worlds.values().chain(&yard).collect();
        check_robots(&bundle.plan, &there)?;
        let axes = make_axes(&bundle.plan, &there)?;
        let runs = bundle.plan.points.count(&axes).map_err(|(axis, problem)| {
            let item = axis.map_or(Item::Points, Item::Axis);
            (item, problem)
        })?;
        let robots = robot_columns(&bundle.plan, &there);
        let columns = columns(&axes, bundle.plan.goal.is_some(), &robots);
        let line = serde_json::to_string(&bundle).map_err(|error| whole(error.to_string()))?;
        let (digest, text, kinds) = (digest_of(&line), bundle.plan, Kinds::default());
        Ok(SweepPlan { line, digest, text, worlds, scripts, axes, runs, robots, columns, kinds })
    }

    /// The plan with all it names as one line of JSON, from which [`of_line`](Self::of_line) makes it again.
    pub fn line(&self) -> &str {
        &self.line
    }

    /// The digest of that line. Comments and blanks of the plan file are no part of it.
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

    /// The names of the axes and the numbers of their values; `None` for a range without steps.
    pub fn axes(&self) -> impl Iterator<Item = (String, Option<u64>)> {
        self.axes.iter().map(|axis| (axis.parameter.name(), axis.len()))
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
        let mut draft = Draft::of(&self.text);
        for (axis, value) in self.axes.iter().zip(&values) {
            if let Parameter::Run(of) = axis.parameter {
                draft.set(of, value)?;
            }
        }
        let mut worlds = Vec::with_capacity(draft.worlds.len() + 1);
        for name in &draft.worlds {
            worlds.push(self.worlds.get(name).ok_or_else(|| format!("there is no world {name:?}"))?.clone());
        }
        worlds.extend(draft.warehouse.map(generated).transpose()?);
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
        for resident in worlds.iter_mut().flat_map(|world| &mut world.robots) {
            let Some(reason) = check(&resident.kind, resident.sizes.as_ref(), resident.sensor) else { continue };
            return Err(format!("{}: {reason}", resident.name));
        }
        let script = match &draft.script {
            None => Script::empty(),
            Some(name) => self.scripts.get(name).ok_or_else(|| format!("there is no script {name:?}"))?.clone(),
        };
        let config = TourConfig { worlds, ticks: draft.ticks, sensor: draft.sensor };
        config.validate().map_err(|error| error.to_string())?;
        Ok(RunSetup { seed: Seed(draft.seed), config, script })
    }

    /// Checks that there is a run that can be, in plans of at most [`MOST_TRIED`] runs.
    pub(super) fn check_runs(&self) -> Result<(), SweepProblem> {
        let mut first = None;
        for row in 0..self.runs.min(MOST_TRIED) {
            match self.setup(row) {
                Ok(_) => return Ok(()),
                Err(reason) => first = first.or(Some(reason)),
            }
        }
        match first {
            Some(reason) if self.runs <= MOST_TRIED => Err(SweepProblem::NoRun { runs: self.runs, reason }),
            _ => Ok(()),
        }
    }

    /// The cells that say what is run in a row: its number, seed and length, and the values of the axes.
    pub fn parameters(&self, row: u64) -> Vec<Cell> {
        let values = self.values(row);
        let mut draft = Draft::of(&self.text);
        let mut cells = Vec::new();
        for (axis, value) in self.axes.iter().zip(values) {
            if let Parameter::Run(of @ (RunParameter::Seed | RunParameter::Ticks)) = axis.parameter {
                // these two take every whole number
                let _ = draft.set(of, &value);
                continue;
            }
            match value {
                AxisValue::Whole(n) => cells.push(Cell::Whole(n)),
                AxisValue::Number(x) => cells.push(Cell::Number(x)),
                AxisValue::Name(name) => cells.push(Cell::text(name)),
                AxisValue::Start(start) => {
                    let width = match &axis.parameter {
                        Parameter::Robot { kind, of: RobotParameter::Start, .. } => RobotKind::of(kind),
                        _ => None,
                    };
                    let width = width.map_or(0, |kind| kind.coordinates.len());
                    cells.extend((0..width).map(|i| Cell::finite(start.get(i).copied())));
                }
            }
        }
        let head = [row, draft.seed, draft.ticks].map(Cell::Whole);
        head.into_iter().chain(cells).collect()
    }

    /// The row of a run that could not be run, with the reason.
    pub fn failed(&self, row: u64, reason: &str) -> RunRow {
        let mut cells = self.parameters(row);
        cells.push(Cell::text(reason));
        cells.resize(self.columns.len(), Cell::Empty);
        RunRow { row, cells }
    }
}

/// What the parameters of a whole run change.
struct Draft {
    seed: u64,
    ticks: u64,
    script: Option<String>,
    worlds: Vec<String>,
    sensor: Option<RangeSensor>,
    warehouse: Option<WarehouseText>,
}

impl Draft {
    fn of(text: &PlanText) -> Self {
        // the book's own sensor and length, without making its worlds
        let sensor = text.sensor.map_or(RangeSensor { n_rays: 360, max_range: 4.0 }, |sensor| RangeSensor {
            n_rays: sensor.rays,
            max_range: sensor.range,
        });
        Draft {
            seed: text.seed.unwrap_or(BOOK_SEED.0),
            ticks: text.ticks.unwrap_or(1200),
            script: text.script.clone(),
            worlds: text.worlds.clone(),
            sensor: (!text.no_sensor).then_some(sensor),
            warehouse: text.warehouse,
        }
    }

    fn set(&mut self, of: RunParameter, value: &AxisValue) -> Result<(), String> {
        let no_warehouse = || "the plan has no warehouse".to_owned();
        let no_sensor = || "the plan has no sensor".to_owned();
        match (of, value) {
            (RunParameter::Seed, AxisValue::Whole(n)) => self.seed = *n,
            (RunParameter::Ticks, AxisValue::Whole(n)) => self.ticks = *n,
            (RunParameter::Script, AxisValue::Name(name)) => self.script = Some(name.clone()),
            (RunParameter::World, AxisValue::Name(name)) => self.worlds = vec![name.clone()],
            (RunParameter::Rays, AxisValue::Whole(n)) => {
                let sensor = self.sensor.as_mut().ok_or_else(no_sensor)?;
                sensor.n_rays = u32::try_from(*n).map_err(|_| format!("{n} rays: too many"))?;
            }
            (RunParameter::Range, AxisValue::Number(x)) => {
                self.sensor.as_mut().ok_or_else(no_sensor)?.max_range = *x;
            }
            (RunParameter::WarehouseSeed, AxisValue::Whole(n)) => {
                self.warehouse.as_mut().ok_or_else(no_warehouse)?.seed = *n;
            }
            (RunParameter::WarehouseRobots, AxisValue::Whole(n)) => {
                self.warehouse.as_mut().ok_or_else(no_warehouse)?.robots = *n;
            }
            // an axis has only values of its parameter's form
            _ => {}
        }
        Ok(())
    }
}

fn generated(text: WarehouseText) -> Result<World, String> {
    let WarehouseText { robots, seed, trailers } = text;
    let robots = usize::try_from(robots).unwrap_or(usize::MAX);
    Warehouse { seed: Seed(seed), robots, trailers }.world().map_err(|error| error.to_string())
}

/// What is wrong with a robot's sizes or noise, when all axes have their values.
fn check(kind: &str, sizes: Option<&crate::configuration::Sizes>, noise: Option<BeamModel>) -> Option<String> {
    let sizes = sizes.and_then(|sizes| sizes.check_for(kind).err()).map(|error| error.to_string());
    sizes.or_else(|| noise.and_then(|noise| noise.try_new().err()).map(|error| error.to_string()))
}

fn check_robots(plan: &PlanText, worlds: &[&World]) -> Result<(), (Item, SweepProblem)> {
    let find = |name: &str| worlds.iter().flat_map(|w| &w.robots).find(|r| r.name == name);
    let unknown = |robot: &str| {
        let names: Vec<&str> = worlds.iter().flat_map(|w| &w.robots).map(|r| r.name.as_str()).take(20).collect();
        let there = if names.is_empty() { "none".into() } else { names.join(", ") };
        SweepProblem::Robot { robot: robot.to_owned(), there }
    };
    if let Some(robot) = plan.robots.iter().find(|name| find(name).is_none()) {
        return Err((Item::Robots, unknown(robot)));
    }
    let Some(GoalText { robot, at, within }) = &plan.goal else { return Ok(()) };
    let Some(resident) = find(robot).filter(|_| plan.keeps(robot)) else { return Err((Item::Goal, unknown(robot))) };
    let (coordinates, tolerances, expected) = (at.len(), within.len(), resident.start.len());
    if coordinates != expected || tolerances != expected {
        return Err((Item::Goal, SweepProblem::Goal { coordinates, tolerances, expected }));
    }
    if let Some(wrong) = at.iter().chain(within).find(|x| !x.is_finite()) {
        return Err((Item::Goal, SweepProblem::NotFinite(*wrong)));
    }
    match within.iter().find(|tolerance| **tolerance < 0.0) {
        Some(wrong) => Err((Item::Goal, SweepProblem::Tolerance(*wrong))),
        None => Ok(()),
    }
}

fn make_axes(plan: &PlanText, worlds: &[&World]) -> Result<Vec<Axis>, (Item, SweepProblem)> {
    let mut axes: Vec<Axis> = Vec::with_capacity(plan.axes.len());
    let robots: Vec<&Resident> =
        worlds.iter().flat_map(|world| &world.robots).filter(|robot| plan.keeps(&robot.name)).collect();
    for (i, text) in plan.axes.iter().enumerate() {
        let refused = |problem| (Item::Axis(i), problem);
        let parameter =
            Parameter::named(&text.vary, worlds).map_err(|there| refused(SweepProblem::Parameter(there)))?;
        if let Some(before) = axes.iter().position(|axis| axis.parameter.overlaps(&parameter)) {
            return Err(refused(SweepProblem::Twice(before)));
        }
        let axis = Axis::try_new(parameter, text.over.clone()).map_err(refused)?;
        if let Some(reason) = axis.parameter.idle(&robots, !plan.no_sensor, plan.warehouse.is_some()) {
            return Err(refused(SweepProblem::Idle(reason)));
        }
        if let (Parameter::Robot { robot, of: RobotParameter::Start, .. }, Over::Starts(starts)) =
            (&axis.parameter, &text.over)
        {
            check_starts(starts, &robots, robot).map_err(refused)?;
        }
        axes.push(axis);
    }
    Ok(axes)
}

/// Checks that each start has the number of coordinates of some robot of this name.
fn check_starts(starts: &[Vec<f64>], robots: &[&Resident], robot: &str) -> Result<(), SweepProblem> {
    for (index, start) in starts.iter().enumerate() {
        let reason = |known: &&Resident| match Resident::try_new(robot, known.kind.clone(), start.clone(), None) {
            Err(problem @ WorldProblem::Start { .. }) => Some(problem.to_string()),
            // a start elsewhere, as beyond the lab, is for the row to say
            _ => None,
        };
        let reasons: Option<Vec<String>> = robots.iter().filter(|known| known.name == robot).map(reason).collect();
        if let Some(reason) = reasons.and_then(|reasons| reasons.into_iter().next()) {
            return Err(SweepProblem::Start { index, reason });
        }
    }
    Ok(())
}

/// The robots with columns of their own: all that are kept, of all worlds, unless they are many.
fn robot_columns(plan: &PlanText, worlds: &[&World]) -> Vec<RobotColumns> {
    let mut robots: Vec<RobotColumns> = Vec::new();
    for resident in worlds.iter().flat_map(|w| &w.robots) {
        if plan.keeps(&resident.name) && !robots.iter().any(|known| known.name == resident.name) {
            if robots.len() == MAX_ROBOT_COLUMNS {
                return Vec::new();
            }
            robots.push(RobotColumns { name: resident.name.clone(), kind: resident.kind.clone() });
        }
    }
    robots
}
