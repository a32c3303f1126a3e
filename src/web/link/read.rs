//! Reading a link from an address.

use std::collections::BTreeMap;

use percent_encoding::percent_decode_str;

use super::Link;
use super::error::LinkError;
use super::limits::{
    LINK_VERSION, LINK_VERSION_WITH_FILES, LINK_VERSION_WITH_INPUTS, MAX_COORDINATES, MAX_LINK, MAX_LINK_TICK,
    MAX_PLANNER_SEED,
};
use super::plan::LinkedPlan;
use crate::web::inputs;
use motion_lab_core::random::Seed;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::World;
use motion_lab_sim::anatomy::Tab;
use motion_lab_sim::manifest::{Lesson, ThemeChoice, Widget};
use motion_lab_sim::plans::PlannerName;
use motion_lab_sim::run::Script;

/// The fields that a link has once. It may have several files, a world each.
const FIELDS: [&str; 21] = [
    "v",
    "seed",
    "world",
    "sensor",
    "widget",
    "lesson",
    "tab",
    "q",
    "step",
    "thick",
    "plan",
    "from",
    "to",
    "planner",
    "planner_seed",
    "lies",
    "theme",
    "script",
    "inputs",
    "tick",
    "digest",
];

/// The field of a world's file.
const FILE: &str = "file";

/// What is right of an address.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadLink {
    /// The link. Where its run is refused it has none, and where a field of what to show is, it has all the others.
    pub link: Link,
    /// Why the run is refused: one wrong part of it makes another run.
    pub run: Result<(), LinkError>,
    /// Why a field of what to show is left out: the first of them.
    pub view: Result<(), LinkError>,
}

impl Link {
    /// The link that the query of an address holds, with or without its question mark; likewise that of a fragment.
    ///
    /// # Errors
    /// [`LinkError`] names the first field that is not right; a script is checked as one in a file is.
    pub fn parse(query: &str) -> Result<Self, LinkError> {
        let ReadLink { link, run, view } = Self::read(query);
        run.and(view).map(|()| link)
    }

    /// What is right of the link that the query of an address holds.
    pub fn read(query: &str) -> ReadLink {
        let mut link = Link::default();
        let mut fields = match LinkFields::of(query) {
            Ok(fields) => fields,
            Err(refused) => return ReadLink { link, run: Err(refused), view: Ok(()) },
        };
        let run = fields.run();
        if let Ok(run) = &run {
            link = run.clone();
        }
        let view = fields.show(&mut link);
        ReadLink { link, run: run.map(drop), view }
    }
}

/// The values of a query's known fields.
struct LinkFields {
    values: BTreeMap<&'static str, String>,
    files: Vec<String>,
}

impl LinkFields {
    fn of(query: &str) -> Result<Self, LinkError> {
        if query.len() > MAX_LINK {
            return Err(LinkError::TooLong(query.len()));
        }
        let mut fields = LinkFields { values: BTreeMap::new(), files: Vec::new() };
        for pair in query.trim_start_matches(['?', '#']).split('&').filter(|p| !p.is_empty()) {
            let (name, value) = pair.split_once('=').unwrap_or((pair, ""));
            let Some(name) = FIELDS.into_iter().chain([FILE]).find(|known| *known == name) else { continue };
            let value = percent_decode_str(value).decode_utf8().map_err(|_| LinkError::Text(name))?.into_owned();
            if name == FILE {
                fields.files.push(value);
            } else {
                fields.values.entry(name).or_insert(value);
            }
        }
        Ok(fields)
    }

    fn take(&mut self, field: &str) -> Option<String> {
        self.values.remove(field)
    }

    fn number(&mut self, field: &'static str, most: u64) -> Result<Option<u64>, LinkError> {
        let Some(text) = self.take(field) else { return Ok(None) };
        // a sign or a blank is no digit
        match text.parse().ok().filter(|n| *n <= most && text.bytes().all(|b| b.is_ascii_digit())) {
            Some(number) => Ok(Some(number)),
            None => Err(LinkError::Number { field, text, most }),
        }
    }

    /// The run.
    fn run(&mut self) -> Result<Link, LinkError> {
        let known =
            [LINK_VERSION, LINK_VERSION_WITH_INPUTS, LINK_VERSION_WITH_FILES].map(|version| version.to_string());
        if let Some(version) = self.take("v").filter(|v| !known.contains(v)) {
            return Err(LinkError::Version(version));
        }
        let mut link = Link::default();
        if let Some(seed) = self.number("seed", u64::MAX)? {
            link.seed = Seed(seed);
        }
        if let Some(tick) = self.number("tick", MAX_LINK_TICK)? {
            link.tick = tick;
        }
        link.worlds = self.worlds()?;
        if let Some(text) = self.take("sensor") {
            link.sensor = sensor(text)?;
        }
        if let Some(text) = self.take("script") {
            link.script = Script::parse("line", &text)?;
        }
        if let Some(text) = self.take("inputs") {
            let Script { mut events, changes, .. } = link.script;
            events.extend(inputs::decode(&text).map_err(LinkError::Inputs)?);
            // as text, the inputs are checked as those of a file
            link.script = Script::parse("line", &Script::new(events, changes).to_line())?;
        }
        if let Some(text) = self.take("digest") {
            if text.len() != 32 || !text.bytes().all(|b| b.is_ascii_hexdigit()) {
                return Err(LinkError::Digest(text));
            }
            link.digest = Some(text.to_ascii_lowercase());
        }
        link.check().map(|()| link)
    }

    /// The worlds, by name or as files; none of either stands for those that are built in.
    fn worlds(&mut self) -> Result<Vec<World>, LinkError> {
        let mut worlds: Vec<World> = Vec::new();
        if let Some(text) = self.take("world") {
            for name in text.split(',') {
                match World::built_in(name).filter(|world| !worlds.contains(world)) {
                    Some(world) => worlds.push(world),
                    None => {
                        let known = World::built_in_names().join(", ");
                        return Err(LinkError::Word { field: "world", text, known });
                    }
                }
            }
        }
        for text in &self.files {
            let world = World::parse_recorded("line", text)?;
            worlds.push(world);
        }
        Ok(worlds)
    }

    /// The coordinates of a field; none where it is left out.
    fn coordinates(&mut self, field: &'static str) -> Result<Vec<f64>, LinkError> {
        let Some(text) = self.take(field) else { return Ok(Vec::new()) };
        let numbers = text.split(',').map(|number| number.parse().ok().filter(|x: &f64| x.is_finite()));
        let numbers: Option<Vec<f64>> = numbers.take(MAX_COORDINATES + 1).collect();
        let numbers = numbers.filter(|all| all.len() <= MAX_COORDINATES);
        numbers.ok_or(LinkError::Coordinates { field, text })
    }

    /// Whether a field says so; it does not where it is left out.
    fn yes(&mut self, field: &'static str) -> Result<bool, LinkError> {
        match self.take(field) {
            None => Ok(false),
            Some(text) if text == "yes" => Ok(true),
            Some(text) => Err(word(field, text, &["yes"])),
        }
    }

    /// What Plan shows; a wrong part of it makes another plan.
    fn plan(&mut self) -> Result<Option<LinkedPlan>, LinkError> {
        let Some(text) = self.take("plan") else { return Ok(None) };
        let named = text.split_once(',');
        let known = named
            .and_then(|(world, robot)| Some((World::built_in_names().into_iter().find(|name| *name == world)?, robot)));
        let Some((world, robot)) = known else { return Err(LinkError::Plan(text)) };
        let mut plan = LinkedPlan::in_world(world, robot);
        (plan.from, plan.to) = (self.coordinates("from")?, self.coordinates("to")?);
        let robot = plan.planned()?.robot;
        if let Some(id) = self.take("planner") {
            let suits = |name: &PlannerName| name.suits(&robot).is_ok();
            let fit: Vec<PlannerName> = PlannerName::ALL.into_iter().filter(suits).collect();
            let planner = fit.iter().find(|name| name.id() == id);
            let known = || fit.iter().map(|name| name.id()).collect::<Vec<_>>();
            plan.planner = Some(*planner.ok_or_else(|| word("planner", id, &known()))?);
        }
        plan.seed = self.number("planner_seed", MAX_PLANNER_SEED)?.map(Seed);
        plan.lies = self.yes("lies")?;
        Ok(Some(plan))
    }

    /// Takes over what to show; the first field that is wrong is the error, and the others are taken all the same.
    fn show(&mut self, link: &mut Link) -> Result<(), LinkError> {
        let mut wrong = Ok(());
        let mut refuse = |error: LinkError| wrong = std::mem::replace(&mut wrong, Ok(())).and(Err(error));
        if let Some(text) = self.take("widget") {
            match Widget::of(&text) {
                Some(widget) => link.widget = Some(widget),
                None => refuse(word("widget", text, &Widget::ALL.map(Widget::id))),
            }
        }
        if let Some(text) = self.take("lesson") {
            match Lesson::of(&text) {
                Some(lesson) => link.lesson = Some(lesson),
                None => refuse(LinkError::Lesson(text)),
            }
        }
        if let Some(text) = self.take("tab") {
            match Tab::ALL.into_iter().find(|tab| tab.name() == text) {
                Some(tab) => link.anatomy.tab = Some(tab),
                None => refuse(word("tab", text, &Tab::ALL.map(Tab::name))),
            }
        }
        for (field, coordinates) in [("q", &mut link.anatomy.q), ("step", &mut link.anatomy.step)] {
            match self.coordinates(field) {
                Ok(read) => *coordinates = read,
                Err(error) => refuse(error),
            }
        }
        match self.yes("thick") {
            Ok(is_thick) => link.anatomy.thick = is_thick,
            Err(error) => refuse(error),
        }
        match self.plan() {
            Ok(plan) => link.plan = plan,
            Err(error) => refuse(error),
        }
        if let Some(text) = self.take("theme") {
            match ThemeChoice::ALL.into_iter().find(|t| t.name().to_lowercase() == text) {
                Some(theme) => link.theme = Some(theme),
                None => refuse(word("theme", text, &["system", "light", "dark"])),
            }
        }
        wrong
    }
}

fn word(field: &'static str, text: String, known: &[&str]) -> LinkError {
    LinkError::Word { field, text, known: known.join(", ") }
}

/// `none`, or the number of rays and the range: `360,4`.
fn sensor(text: String) -> Result<Option<RangeSensor>, LinkError> {
    if text == "none" {
        return Ok(None);
    }
    let parts = text.split_once(',').and_then(|(rays, range)| Some((rays.parse().ok()?, range.parse().ok()?)));
    let sensor = parts.map(|(n_rays, max_range)| RangeSensor { n_rays, max_range });
    // whether it may be had is asked where its run begins
    sensor.map(Some).ok_or(LinkError::Sensor(text))
}
