//! `ProblemSet`, problems by their numbers.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use motion_lab_core::configuration::{RobotKind, WrittenCoordinate};
use motion_lab_core::random::Seed;
use motion_lab_core::worlds::{World, check_name};
use motion_lab_import::Scenario;
use motion_lab_sim::plans::{CheckerName, TUBE, Task};

use super::known::{KnownProblem, SetProblem};
use super::place::ProblemPlace;
use super::source::ProblemSource;
use super::text::{EndsText, GeneratedText, ScenarioText, SetText};

/// Largest number of problems.
const MAX_PROBLEMS: u64 = 10_000_000;

/// The number of a set's problems that are tried for one that there is.
const MAX_LOOKED: u64 = 1_000;

/// Problems by their numbers, which are made when they are asked for: each is a function of the set and its number.
#[derive(Clone, Debug)]
pub struct ProblemSet {
    sets: Vec<NamedSource>,
    /// How much larger rovers are planned, metres.
    pub tube: f64,
    /// The clearance that paths are to keep, metres; `None` for what is [usual](Task::usual_clearance).
    pub clearance: Option<f64>,
    /// Who answers the planners' questions.
    pub checker: CheckerName,
}

/// A set with its name, and the number of the file's problems before it.
#[derive(Clone, Debug)]
struct NamedSource {
    name: String,
    source: ProblemSource,
    before: u64,
}

impl ProblemSet {
    /// One problem, which stands in no file.
    pub fn of_task(task: Task) -> Self {
        let Task { tube, clearance, checker, .. } = task;
        let own = NamedSource { name: String::new(), source: ProblemSource::Own(Box::new(task)), before: 0 };
        ProblemSet { sets: vec![own], tube, clearance, checker }
    }

    /// The problems of a scenario, in the world of its map, for a robot of that world or of a kind.
    ///
    /// # Errors
    /// The reason, in words: the map does not fill the world, or the robot is none that goes from place to place.
    pub fn of_scenario(file: &str, scenario: Scenario, robot: &str, world: &World) -> Result<Self, String> {
        let source = of_scenario(file, Arc::new(scenario), ProblemPlace::of(robot, world)?)?;
        Ok(Self::of_sources([(file.to_owned(), source)]))
    }

    /// The problems of the sets as written.
    pub(super) fn of_texts(
        texts: &[SetText],
        worlds: &BTreeMap<String, World>,
        scenarios: &BTreeMap<String, Arc<Scenario>>,
    ) -> Result<Self, (usize, String)> {
        let names = names(texts)?;
        let mut named = NamedFiles { worlds, scenarios, places: BTreeMap::new() };
        let mut sources = Vec::with_capacity(texts.len());
        for ((i, text), name) in texts.iter().enumerate().zip(names) {
            sources.push((name, source(text, &mut named).map_err(|reason| (i, reason))?));
        }
        Ok(Self::of_sources(sources))
    }

    fn of_sources(sources: impl IntoIterator<Item = (String, ProblemSource)>) -> Self {
        let mut sets: Vec<NamedSource> = Vec::new();
        for (name, source) in sources {
            let before = sets.last().map_or(0, |last| last.before.saturating_add(last.source.count()));
            sets.push(NamedSource { name, source, before });
        }
        ProblemSet { sets, tube: TUBE, clearance: None, checker: CheckerName::EXACT }
    }

    /// The problems of one robot, by its name or its kind's; their numbers stay.
    #[must_use]
    pub fn of_robot(mut self, robot: &str) -> Self {
        self.sets.retain(|set| set.source.robot() == robot || set.source.kind().name == robot);
        self
    }

    /// The number of problems.
    pub fn len(&self) -> u64 {
        self.sets.iter().fold(0, |sum, set| sum.saturating_add(set.source.count()))
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The problems' numbers in their file, from 1; of one that stands in no file it is 1.
    pub fn numbers(&self) -> impl Iterator<Item = u64> + '_ {
        self.sets.iter().flat_map(|set| (1..=set.source.count()).map(|number| set.before + number))
    }

    /// The names of the sets, in their order, no two the same; none for a problem that stands in no file.
    pub fn names(&self) -> Vec<&str> {
        let of_file = self.sets.iter().filter(|set| !matches!(set.source, ProblemSource::Own(_)));
        of_file.map(|set| set.name.as_str()).collect()
    }

    /// The names of the robots, each once, in the order in which they come.
    pub fn robots(&self) -> Vec<&str> {
        let mut seen = BTreeSet::new();
        self.sets.iter().map(|set| set.source.robot()).filter(|robot| seen.insert(*robot)).collect()
    }

    /// The kinds of robots, each once, in the order in which they come.
    pub fn kinds(&self) -> Vec<&'static RobotKind> {
        let mut kinds = Vec::new();
        for set in self.sets.iter().filter(|set| set.source.count() > 0) {
            if !kinds.contains(&set.source.kind()) {
                kinds.push(set.source.kind());
            }
        }
        kinds
    }

    /// The name of the set of the problem with this index, from 0; `None` beyond the end.
    pub fn set_of(&self, index: u64) -> Option<&str> {
        let mut index = index;
        for set in &self.sets {
            match index.checked_sub(set.source.count()) {
                Some(left) => index = left,
                None => return Some(&set.name),
            }
        }
        None
    }

    /// A problem of each set: the first of those that there are.
    pub fn firsts(&self) -> impl Iterator<Item = Task> + '_ {
        let first = |set: &NamedSource| {
            let mut known = KnownProblem::of(set.before + 1, &set.name);
            (0..set.source.count().min(MAX_LOOKED)).find_map(|index| set.source.task(index, &mut known).ok())
        };
        self.sets.iter().filter_map(first)
    }

    /// The problem with this index, from 0; `None` beyond the end.
    pub fn problem(&self, index: u64) -> Option<SetProblem> {
        let mut index = index;
        for NamedSource { name, source, before } in &self.sets {
            if index >= source.count() {
                index -= source.count();
                continue;
            }
            let number = before + index + 1;
            let mut known = KnownProblem::of(number, name);
            let task = source.task(index, &mut known).map(|task| self.asked(task));
            let is_known = !matches!(source, ProblemSource::Own(_));
            return Some(SetProblem { task, known: is_known.then_some(known) });
        }
        None
    }

    /// The problem with this number in its file, from 1; `None` where there is none, or no longer.
    pub fn numbered(&self, number: u64) -> Option<SetProblem> {
        let mut skipped = 0;
        for set in &self.sets {
            let of_set = number.checked_sub(set.before + 1).filter(|index| *index < set.source.count());
            if let Some(index) = of_set {
                return self.problem(skipped + index);
            }
            skipped += set.source.count();
        }
        None
    }

    /// The task as this set asks for it.
    fn asked(&self, task: Task) -> Task {
        Task { tube: self.tube, clearance: self.clearance, checker: self.checker, ..task }
    }
}

/// The names of sets: those that are written, which are names as a world has them and no two the same, else what the
/// problems come from, with a number where it is taken.
fn names(texts: &[SetText]) -> Result<Vec<String>, (usize, String)> {
    let mut taken = BTreeSet::new();
    for (i, name) in texts.iter().enumerate().filter_map(|(i, text)| Some((i, text.written_name()?))) {
        check_name(name).map_err(|problem| (i, problem.to_string()))?;
        if !taken.insert(name.to_owned()) {
            return Err((i, "another set has this name already".into()));
        }
    }
    // how often a stem was taken, so that many sets of one generator are named in one pass
    let mut counts: BTreeMap<&str, u64> = BTreeMap::new();
    let mut named = Vec::with_capacity(texts.len());
    for text in texts {
        if let Some(name) = text.written_name() {
            named.push(name.to_owned());
            continue;
        }
        let stem = text.name();
        let count = counts.entry(stem).or_default();
        let name = loop {
            *count += 1;
            let name = if *count == 1 { stem.to_owned() } else { format!("{stem} {count}") };
            if taken.insert(name.clone()) {
                break name;
            }
        };
        named.push(name);
    }
    Ok(named)
}

/// What sets name, with the places that were made of it.
struct NamedFiles<'a> {
    worlds: &'a BTreeMap<String, World>,
    scenarios: &'a BTreeMap<String, Arc<Scenario>>,
    /// By world and robot, so that sets share a world and its scene.
    places: BTreeMap<(String, String), ProblemPlace>,
}

impl NamedFiles<'_> {
    fn place(&mut self, robot: &str, world: &str) -> Result<ProblemPlace, String> {
        let key = (world.to_owned(), robot.to_owned());
        if let Some(place) = self.places.get(&key) {
            return Ok(place.clone());
        }
        let there = self.worlds.get(world).ok_or_else(|| format!("there is no world {world:?}"))?;
        let place = ProblemPlace::of(robot, there)?;
        self.places.insert(key, place.clone());
        Ok(place)
    }
}

/// The source of a set's problems.
fn source(text: &SetText, named: &mut NamedFiles<'_>) -> Result<ProblemSource, String> {
    let source = match text {
        SetText::Paired(ends) | SetText::Crossed(ends) => {
            let crossed = matches!(text, SetText::Crossed(_));
            of_ends(ends, crossed, named.place(&ends.robot, &ends.world)?)?
        }
        SetText::Scenario(ScenarioText { file, world, robot, .. }) => {
            let scenario = named.scenarios.get(file).ok_or_else(|| format!("there is no scenario {file:?}"))?;
            of_scenario(file, Arc::clone(scenario), named.place(robot, world)?)?
        }
        SetText::Generated(GeneratedText { of, count, seed, .. }) => {
            let (generator, seed, count) = (of.clone(), Seed(*seed), *count);
            // what is wrong with the settings is so for every number; what one number has no room for, that one says
            generator.check().map_err(|error| error.to_string())?;
            let kind = RobotKind::of(generator.kind()).ok_or_else(|| format!("no robot is a {}", generator.kind()))?;
            ProblemSource::Generated { generator, seed, kind, count }
        }
    };
    match source.count() {
        0 => Err("it has no problem".into()),
        count if count > MAX_PROBLEMS => Err(format!("{count} problems: at most {MAX_PROBLEMS}")),
        _ => Ok(source),
    }
}

fn of_ends(ends: &EndsText, crossed: bool, place: ProblemPlace) -> Result<ProblemSource, String> {
    let EndsText { starts, goals, .. } = ends;
    if !crossed && starts.len() != goals.len() {
        let counts = format!("{} starts and {} goals", starts.len(), goals.len());
        return Err(format!("{counts}: paired ones are as many; write Crossed for each to each"));
    }
    let read = |end: &str, all: &[Vec<WrittenCoordinate>]| -> Result<Vec<Vec<f64>>, String> {
        let one = |(number, written): (usize, &Vec<WrittenCoordinate>)| {
            place.written(written).map_err(|reason| format!("{end} {number}: {reason}"))
        };
        (1..).zip(all).map(one).collect()
    };
    let (starts, goals) = (read("start", starts)?, read("goal", goals)?);
    let mut lengths = starts.iter().chain(&goals).map(Vec::len);
    if let Some(first) = lengths.next()
        && lengths.any(|length| length != first)
    {
        return Err("some of the starts and goals have a trailer's heading, others have none".into());
    }
    Ok(ProblemSource::Ends { place, starts, goals, crossed })
}

fn of_scenario(file: &str, scenario: Arc<Scenario>, place: ProblemPlace) -> Result<ProblemSource, String> {
    if place.kind.lengths < 2 {
        return Err(format!("a {} does not go from place to place", place.kind.name));
    }
    let scale = scenario.metres_per_cell(file, &place.world.bounds).map_err(|error| error.to_string())?;
    Ok(ProblemSource::Scenario { place, scenario, scale })
}
