//! `PlanFile`, a plan as written: it names worlds and scripts and does not hold them.

use std::collections::{BTreeMap, BTreeSet};

use ron::value::RawValue;
use serde::Deserialize;

use super::error::{PLAN_VERSION, SweepPlanError, SweepProblem};
use super::plan::SweepPlan;
use super::plan_text::{Bundle, FORMAT, Item, PlanText};
use super::values::Over;
use motion_lab_core::text_position::{Position, offset_of, position_at};
use motion_lab_core::worlds::{World, ron_in_words};
use motion_lab_sim::run::Script;

/// The version alone, for files of other versions.
#[derive(Deserialize)]
#[serde(rename = "Sweep")]
struct Version {
    version: u64,
}

/// The items as raw text, for their places in the file.
#[derive(Deserialize)]
#[serde(rename = "Sweep")]
struct Places<'a> {
    #[serde(borrow)]
    version: &'a RawValue,
    #[serde(borrow, default)]
    worlds: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    script: Option<&'a RawValue>,
    #[serde(borrow, default)]
    robots: Option<&'a RawValue>,
    #[serde(borrow, default)]
    goal: Option<&'a RawValue>,
    #[serde(borrow, default)]
    planner: Option<&'a RawValue>,
    #[serde(borrow, default)]
    points: Option<&'a RawValue>,
    #[serde(borrow, default)]
    axes: Vec<&'a RawValue>,
}

/// A plan file as written. It names its worlds and scripts; [`with`](Self::with) adds them.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanFile {
    file: String,
    source: String,
    text: PlanText,
}

/// The RON options of plans: an optional value is written plainly, as in `ticks: 100`.
fn options() -> ron::Options {
    ron::Options::default().with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME)
}

impl PlanFile {
    /// Reads a plan file. Errors call it `file`.
    ///
    /// # Errors
    /// [`SweepPlanError`] names file, line and column, for invalid RON, another version, or an unknown field.
    pub fn parse(file: &str, text: &str) -> Result<Self, SweepPlanError> {
        let read: Result<PlanText, _> = options().from_str(text);
        let error = |at: Position, item: String, problem| SweepPlanError {
            file: file.to_owned(),
            line: at.line,
            column: at.column,
            item,
            problem,
        };
        // the version comes first: the rest of another version's file may look different
        let version = match &read {
            Ok(read) => read.version,
            Err(_) => options().from_str(text).map_or(PLAN_VERSION, |Version { version }| version),
        };
        if version != PLAN_VERSION {
            return Err(error(place(text, Item::Version), "version".into(), SweepProblem::Version(version)));
        }
        let mut read = read.map_err(|e| {
            let at = Position { line: e.span.start.line, column: e.span.start.col };
            error(at, String::new(), SweepProblem::Syntax(ron_in_words(text, &e)))
        })?;
        if read.worlds.is_empty() && read.warehouse.is_none() {
            read.worlds = World::built_in_names().into_iter().map(str::to_owned).collect();
        }
        Ok(PlanFile { file: file.to_owned(), source: text.to_owned(), text: read })
    }

    fn named(&self, parameter: &str) -> impl Iterator<Item = &str> {
        let lists =
            self.text.axes.iter().filter(move |axis| axis.vary == parameter).filter_map(|axis| match &axis.over {
                Over::Names(names) => Some(names),
                _ => None,
            });
        lists.flatten().map(String::as_str)
    }

    /// The names of its worlds: built-in ones, or paths of world files relative to the plan's folder. Each once.
    pub fn world_names(&self) -> BTreeSet<&str> {
        self.text.worlds.iter().map(String::as_str).chain(self.named("world")).collect()
    }

    /// The names of its scripts: paths relative to the plan's folder. Each once.
    pub fn script_names(&self) -> BTreeSet<&str> {
        self.text.script.iter().map(String::as_str).chain(self.named("script")).collect()
    }

    /// The names of its planners. Each once.
    pub fn planner_names(&self) -> BTreeSet<&str> {
        let alone = self.text.planner.iter().filter_map(|planner| planner.name.as_deref());
        alone.chain(self.named("planner")).collect()
    }

    /// Where the plan names this world, script or planner, as messages have it: `plan.ron:3:14`.
    pub fn place_of(&self, name: &str) -> String {
        let places: Option<Places> = options().from_str(&self.source).ok();
        let offset = places.and_then(|places| {
            let names = |raw: &RawValue| options().from_str::<String>(raw.get_ron()).is_ok_and(|named| named == name);
            let alone = places.worlds.iter().copied().chain(places.script).find(|raw| names(raw));
            let alone = alone.map(|raw| offset_of(&self.source, raw.trim().get_ron()));
            let quoted = format!("{name:?}");
            let among = || {
                let mut items = places.planner.iter().chain(&places.axes).map(|raw| raw.get_ron());
                items.find_map(|item| Some(offset_of(&self.source, item) + item.find(&quoted)?))
            };
            alone.or_else(among)
        });
        let Position { line, column } = position_at(&self.source, offset.unwrap_or(0));
        format!("{}:{line}:{column}", self.file)
    }

    /// The plan with the worlds and scripts it names.
    ///
    /// # Errors
    /// [`SweepPlanError`] names the item that can't be: a robot, a goal, an axis, the number of runs. A plan of at most
    /// a thousand runs is refused, too, when none of them can be.
    pub fn with(
        &self,
        worlds: &BTreeMap<String, World>,
        scripts: &BTreeMap<String, Script>,
    ) -> Result<SweepPlan, SweepPlanError> {
        let bundle = Bundle {
            format: FORMAT.to_owned(),
            plan: self.text.clone(),
            worlds: worlds.iter().map(|(name, world)| (name.clone(), world.to_ron())).collect(),
            scripts: scripts.iter().map(|(name, script)| (name.clone(), script.to_ron())).collect(),
        };
        let plan = SweepPlan::of_bundle(bundle);
        let plan = plan.and_then(|plan| plan.check_runs().map(|()| plan).map_err(|problem| (Item::Whole, problem)));
        plan.map_err(|(item, problem)| {
            let Position { line, column } = place(&self.source, item);
            let item = match item {
                Item::Version => "version".into(),
                Item::Robots => "robots".into(),
                Item::Goal => "goal".into(),
                Item::Planner => "planner".into(),
                Item::Points => "points".into(),
                Item::Axis(i) => format!("axes[{i}] {:?}", self.text.axes.get(i).map_or("", |axis| &axis.vary)),
                Item::Whole => String::new(),
            };
            SweepPlanError { file: self.file.clone(), line, column, item, problem }
        })
    }
}

/// The position of an item; the beginning of the text for one that is not there.
fn place(text: &str, item: Item) -> Position {
    let places: Option<Places> = options().from_str(text).ok();
    let part = places.and_then(|places| match item {
        Item::Version => Some(places.version),
        Item::Robots => places.robots,
        Item::Goal => places.goal,
        Item::Planner => places.planner,
        Item::Points => places.points,
        Item::Axis(i) => places.axes.get(i).copied(),
        Item::Whole => None,
    });
    part.map_or(Position { line: 1, column: 1 }, |part| position_at(text, offset_of(text, part.trim().get_ron())))
}
