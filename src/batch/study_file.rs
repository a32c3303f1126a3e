//! `StudyFile`, a study as written: it names worlds, scripts and scenarios and does not hold them.

use std::collections::{BTreeMap, BTreeSet};

use ron::value::RawValue;
use serde::Deserialize;

use super::error::{PLAN_VERSION, StudyError, SweepProblem};
use super::problem_set::ProblemBundle;
use super::study::Study;
use super::study_text::{Bundle, FORMAT, StudyItem, StudyText};
use super::values::Over;
use motion_lab_core::text_position::{Position, offset_of, position_at};
use motion_lab_core::worlds::{World, ron_in_words};
use motion_lab_import::Scenario;
use motion_lab_sim::run::Script;

/// The version alone, for files of other versions.
#[derive(Deserialize)]
#[serde(rename = "Sweep")]
struct StudyVersion {
    version: u64,
}

/// The items as raw text, for their places in the file.
#[derive(Deserialize)]
#[serde(rename = "Sweep")]
struct RawStudy<'a> {
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

/// A study file as written. It names its worlds, scripts and scenarios, which [`with_scenarios`](Self::with_scenarios)
/// and [`with`](Self::with) add.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyFile {
    file: String,
    source: String,
    text: StudyText,
    scenarios: BTreeMap<String, Scenario>,
    problems: BTreeMap<String, ProblemBundle>,
}

/// The RON options of studies: an optional value is written plainly, as in `ticks: 100`.
fn options() -> ron::Options {
    ron::Options::default().with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME)
}

impl StudyFile {
    /// Reads a study file. Errors call it `file`.
    ///
    /// # Errors
    /// [`StudyError`] names file, line and column, for invalid RON, another version, or an unknown field.
    pub fn parse(file: &str, text: &str) -> Result<Self, StudyError> {
        let read: Result<StudyText, _> = options().from_str(text);
        let error = |at: Position, item: String, problem| StudyError {
            file: file.to_owned(),
            line: at.line,
            column: at.column,
            item,
            problem,
        };
        // the version comes first: the rest of another version's file may look different
        let version = match &read {
            Ok(read) => read.version,
            Err(_) => options().from_str(text).map_or(PLAN_VERSION, |StudyVersion { version }| version),
        };
        if version != PLAN_VERSION {
            return Err(error(place(text, StudyItem::Version), "version".into(), SweepProblem::Version(version)));
        }
        let mut read = read.map_err(|e| {
            let at = Position { line: e.span.start.line, column: e.span.start.col };
            error(at, String::new(), SweepProblem::Syntax(ron_in_words(text, &e)))
        })?;
        if read.worlds.is_empty() && read.warehouse.is_none() && !read.has_filed_problems() {
            read.worlds = World::built_in_names().into_iter().map(str::to_owned).collect();
        }
        Ok(StudyFile {
            file: file.to_owned(),
            source: text.to_owned(),
            text: read,
            scenarios: BTreeMap::new(),
            problems: BTreeMap::new(),
        })
    }

    fn named(&self, parameter: &str) -> impl Iterator<Item = &str> {
        let lists =
            self.text.axes.iter().filter(move |axis| axis.vary == parameter).filter_map(|axis| match &*axis.over {
                Over::Names(names) => Some(names),
                _ => None,
            });
        lists.flatten().map(String::as_str)
    }

    /// The names of its worlds: built-in ones, or paths of world files relative to the study's folder. Each once.
    pub fn world_names(&self) -> BTreeSet<&str> {
        self.text.worlds.iter().map(String::as_str).chain(self.named("world")).collect()
    }

    /// The names of its scripts: paths relative to the study's folder. Each once.
    pub fn script_names(&self) -> BTreeSet<&str> {
        self.text.script.iter().map(String::as_str).chain(self.named("script")).collect()
    }

    /// The names of its planners. Each once.
    pub fn planner_names(&self) -> BTreeSet<&str> {
        let alone = self.text.planner.iter().filter_map(|planner| planner.name.as_deref());
        alone.chain(self.named("planner")).collect()
    }

    /// The names of its scenarios: paths relative to the study's folder. Each once.
    pub fn scenario_names(&self) -> BTreeSet<&str> {
        self.problem_names(false)
    }

    /// The names of its problem files: paths relative to the study's folder, which end in `.ron`. Each once.
    pub fn problem_file_names(&self) -> BTreeSet<&str> {
        self.problem_names(true)
    }

    fn problem_names(&self, is_filed: bool) -> BTreeSet<&str> {
        let all = self.text.axes.iter().filter_map(|axis| axis.over.problem_file());
        all.filter(|(_, filed)| *filed == is_filed).map(|(name, _)| name).collect()
    }

    /// The same study with the scenarios it names.
    #[must_use]
    pub fn with_scenarios(self, scenarios: BTreeMap<String, Scenario>) -> Self {
        StudyFile { scenarios, ..self }
    }

    /// The same study with the problem files it names.
    #[must_use]
    pub fn with_problems(self, problems: BTreeMap<String, ProblemBundle>) -> Self {
        StudyFile { problems, ..self }
    }

    /// Where the study names this world, script, planner or scenario, as messages have it: `study.ron:3:14`.
    pub fn place_of(&self, name: &str) -> String {
        let places: Option<RawStudy> = options().from_str(&self.source).ok();
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

    /// The study with the worlds and scripts it names.
    ///
    /// # Errors
    /// [`StudyError`] names the item that can't be: a robot, a goal, an axis, the number of runs. A study of at most
    /// a thousand runs is refused, too, when none of them can be.
    pub fn with(
        &self,
        worlds: &BTreeMap<String, World>,
        scripts: &BTreeMap<String, Script>,
    ) -> Result<Study, StudyError> {
        let bundle = Bundle {
            format: FORMAT.to_owned(),
            study: self.text.clone(),
            worlds: worlds.iter().map(|(name, world)| (name.clone(), world.to_ron())).collect(),
            scripts: scripts.iter().map(|(name, script)| (name.clone(), script.to_ron())).collect(),
            scenarios: self.scenarios.iter().map(|(name, scenario)| (name.clone(), scenario.to_text())).collect(),
            problems: self.problems.clone(),
        };
        let study = Study::of_bundle(bundle);
        let study =
            study.and_then(|study| study.check_runs().map(|()| study).map_err(|problem| (StudyItem::Whole, problem)));
        study.map_err(|(item, problem)| {
            let Position { line, column } = place(&self.source, item);
            let item = match item {
                StudyItem::Version => "version".into(),
                StudyItem::Robots => "robots".into(),
                StudyItem::Goal => "goal".into(),
                StudyItem::Planner => "planner".into(),
                StudyItem::Points => "points".into(),
                StudyItem::Axis(i) => format!("axes[{i}] {:?}", self.text.axes.get(i).map_or("", |axis| &axis.vary)),
                StudyItem::Whole => String::new(),
            };
            StudyError { file: self.file.clone(), line, column, item, problem }
        })
    }
}

/// The position of an item; the beginning of the text for one that is not there.
fn place(text: &str, item: StudyItem) -> Position {
    let places: Option<RawStudy> = options().from_str(text).ok();
    let part = places.and_then(|places| match item {
        StudyItem::Version => Some(places.version),
        StudyItem::Robots => places.robots,
        StudyItem::Goal => places.goal,
        StudyItem::Planner => places.planner,
        StudyItem::Points => places.points,
        StudyItem::Axis(i) => places.axes.get(i).copied(),
        StudyItem::Whole => None,
    });
    part.map_or(Position { line: 1, column: 1 }, |part| position_at(text, offset_of(text, part.trim().get_ron())))
}
