//! `Link`, a run and what to show of it in the query of an address.

mod anatomy;
mod cited;
mod error;
mod limits;
mod names;
mod plan;
mod read;
#[cfg(test)]
mod tests;
mod work;

use std::fmt::Write;

use percent_encoding::utf8_percent_encode;

use super::inputs;
pub use anatomy::LinkedAnatomy;
#[cfg(feature = "web")]
pub use cited::{cited, requoted};
pub use error::LinkError;
use limits::{ESCAPED, LONG, MAX_QUERY};
pub use limits::{LINK_VERSION, LINK_VERSION_WITH_FILES, LINK_VERSION_WITH_INPUTS, MAX_LINK, MAX_LINK_TICK};
use motion_lab_core::random::Seed;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::World;
use motion_lab_sim::manifest::{Lesson, ThemeChoice, Widget};
use motion_lab_sim::run::{Recipe, Script};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
pub use plan::LinkedPlan;
pub use read::ReadLink;

/// A run and what to show of it, as the query of an address: `?v=1&seed=2005&world=lot&tick=600&script=...`.
///
/// Every field may be left out. Fields of other names are ignored, so that a page may add its own. A known field must
/// be valid.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// The run's seed; the book's when left out.
    pub seed: Seed,
    /// Its worlds; an empty list stands for the three that are built in.
    pub worlds: Vec<World>,
    /// The range sensor of every Rusty; the lab's usual one when left out.
    pub sensor: Option<RangeSensor>,
    /// The tick that is shown.
    pub tick: u64,
    /// The widget in front.
    pub widget: Option<Widget>,
    /// The lesson that it begins, in its own widget.
    pub lesson: Option<Lesson>,
    /// What Query shows.
    pub anatomy: LinkedAnatomy,
    /// What Plan shows.
    pub plan: Option<LinkedPlan>,
    /// The paper.
    pub theme: Option<ThemeChoice>,
    /// The input.
    pub script: Script,
    /// The digest of the run up to the tick, as whoever made the link saw it: 32 hexadecimal digits.
    pub digest: Option<String>,
}

impl Default for Link {
    fn default() -> Self {
        Link {
            seed: BOOK_SEED,
            worlds: vec![],
            sensor: TourConfig::default().sensor,
            tick: 0,
            widget: None,
            lesson: None,
            anatomy: LinkedAnatomy::default(),
            plan: None,
            theme: None,
            script: Script::empty(),
            digest: None,
        }
    }
}

impl Link {
    /// The link that shows a run at its configuration's last tick.
    ///
    /// # Errors
    /// [`LinkError::Number`] when the tick lies beyond [`MAX_LINK_TICK`]; [`LinkError::Name`] for a long name in a
    /// world of one's own or of an added obstacle; [`LinkError::Work`] for a run that is more work than a reader waits
    /// for.
    pub fn of(recipe: &Recipe) -> Result<Self, LinkError> {
        let Recipe { seed, config, script } = recipe;
        let usual = TourConfig::default();
        if config.ticks > MAX_LINK_TICK {
            return Err(LinkError::Number { field: "tick", text: config.ticks.to_string(), most: MAX_LINK_TICK });
        }
        let worlds = if config.worlds == usual.worlds { vec![] } else { config.worlds.clone() };
        let (sensor, script) = (config.sensor, script.clone());
        let link = Link { seed: *seed, worlds, sensor, tick: config.ticks, script, ..Link::default() };
        link.check().map(|()| link)
    }

    /// Refuses what no reader is to meet by a click: names that are sentences, and endless work.
    fn check(&self) -> Result<(), LinkError> {
        self.worlds.iter().filter(|world| world.built_in_name().is_none()).try_for_each(names::check)?;
        names::check_added(&self.script)?;
        work::check(&self.recipe())
    }

    /// The query, without its question mark. Parsing it gives the link back. Where it would be long, its inputs are in
    /// few bytes.
    ///
    /// # Errors
    /// [`LinkError::TooLong`].
    pub fn query(&self) -> Result<String, LinkError> {
        let mut query = self.with(&self.script, None);
        if query.len() > LONG
            && !self.script.events.is_empty()
            && let Some(inputs) = inputs::encode(&self.script.events)
        {
            query = self.with(&Script::new(vec![], self.script.changes.clone()), Some(&inputs));
        }
        if query.len() > MAX_LINK { Err(LinkError::TooLong(query.len())) } else { Ok(query) }
    }

    /// The address that shows it at a page of the lab, whose own address has neither a query nor a fragment.
    ///
    /// # Errors
    /// [`LinkError::TooLong`].
    pub fn address(&self, page: &str) -> Result<String, LinkError> {
        let query = self.query()?;
        let mark = if query.len() > MAX_QUERY { '#' } else { '?' };
        Ok(format!("{page}{mark}{query}"))
    }

    /// The query with this script and inputs.
    fn with(&self, script: &Script, inputs: Option<&str>) -> String {
        let names: Option<Vec<&str>> = self.worlds.iter().map(World::built_in_name).collect();
        let is_usual = self.sensor == TourConfig::default().sensor;
        let version = match inputs {
            _ if names.is_none() || !is_usual => LINK_VERSION_WITH_FILES,
            Some(_) => LINK_VERSION_WITH_INPUTS,
            None => LINK_VERSION,
        };
        let mut query = format!("v={version}&seed={}", self.seed);
        let mut field = |name: &str, value: &str| {
            // writing into a string can't fail
            let _ = write!(query, "&{name}={}", utf8_percent_encode(value, ESCAPED));
        };
        match names {
            Some(names) if names.is_empty() => {}
            Some(names) => field("world", &names.join(",")),
            None => self.worlds.iter().for_each(|world| field("file", &in_few_blanks(&world.to_ron()))),
        }
        if !is_usual {
            let sensor = self.sensor.map(|sensor| format!("{},{}", sensor.n_rays, sensor.max_range));
            field("sensor", sensor.as_deref().unwrap_or("none"));
        }
        if let Some(widget) = self.widget {
            field("widget", widget.id());
        }
        if let Some(lesson) = self.lesson {
            field("lesson", &lesson.id());
        }
        if let Some(tab) = self.anatomy.tab {
            field("tab", tab.name());
        }
        let numbers = |all: &[f64]| all.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        for (name, coordinates) in [("q", &self.anatomy.q), ("step", &self.anatomy.step)] {
            if !coordinates.is_empty() {
                field(name, &numbers(coordinates));
            }
        }
        if self.anatomy.thick {
            field("thick", "yes");
        }
        if let Some(plan) = &self.plan {
            field("plan", &format!("{},{}", plan.world, plan.robot));
            for (name, coordinates) in [("from", &plan.from), ("to", &plan.to)] {
                if !coordinates.is_empty() {
                    field(name, &numbers(coordinates));
                }
            }
            if let Some(planner) = plan.planner {
                field("planner", planner.id());
            }
            if let Some(seed) = plan.seed {
                field("planner_seed", &seed.to_string());
            }
            if plan.lies {
                field("lies", "yes");
            }
        }
        if let Some(theme) = self.theme {
            field("theme", &theme.name().to_lowercase());
        }
        if !script.is_empty() {
            field("script", &script.to_line());
        }
        if let Some(inputs) = inputs {
            field("inputs", inputs);
        }
        if self.tick > 0 {
            field("tick", &self.tick.to_string());
        }
        if let Some(digest) = &self.digest {
            field("digest", digest);
        }
        query
    }

    /// The run: as long as the link's tick, and at least one tick.
    pub fn recipe(&self) -> Recipe {
        let usual = TourConfig::default();
        let worlds = if self.worlds.is_empty() { usual.worlds } else { self.worlds.clone() };
        let config = TourConfig { worlds, ticks: self.tick.max(1), sensor: self.sensor };
        Recipe::new(config, (self.seed, self.script.clone()))
    }
}

/// The text of a world file without the blanks that begin its lines.
fn in_few_blanks(text: &str) -> String {
    text.lines().map(str::trim_start).collect::<Vec<_>>().join("\n")
}
