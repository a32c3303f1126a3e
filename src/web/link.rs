//! `Link`, a run and what to show of it in the query of an address.

use std::collections::BTreeMap;
use std::fmt::Write;

use percent_encoding::{AsciiSet, CONTROLS, percent_decode_str, utf8_percent_encode};

use super::inputs;
use motion_lab_core::random::Seed;
use motion_lab_core::worlds::World;
use motion_lab_sim::anatomy::Tab;
use motion_lab_sim::manifest::{Lesson, ThemeChoice, Widget};
use motion_lab_sim::run::{Recipe, Script, ScriptError};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

/// The version of the address format in which inputs are in the script.
pub const LINK_VERSION: u32 = 1;

/// The version of the address format with the field `inputs`.
pub const LINK_VERSION_WITH_INPUTS: u32 = 2;

/// Largest length of a query that servers take, bytes. A longer one stands behind a `#`: what is there is never sent.
const MAX_QUERY: usize = 8000;

/// Largest length of a link, bytes.
pub const MAX_LINK: usize = 32_000;

/// Length of a link, bytes, from which the inputs are written in few bytes rather than to be read.
const LONG: usize = 2000;

/// The fields that a link has.
const FIELDS: [&str; 12] =
    ["v", "seed", "world", "widget", "lesson", "tab", "q", "theme", "script", "inputs", "tick", "digest"];

/// Most coordinates of a configuration.
const MAX_COORDINATES: usize = 16;

/// Largest tick of a link: an hour. Opening a link simulates its run up to that tick.
pub const MAX_LINK_TICK: u64 = 72_000;

/// Characters to escape: those with a meaning in a query, and those at which programs that find addresses in text stop.
const ESCAPED: &AsciiSet = &{
    let marks = CONTROLS.add(b' ').add(b'"').add(b'#').add(b'%').add(b'&').add(b'+').add(b'<').add(b'>');
    marks.add(b'[').add(b']').add(b'`').add(b'{').add(b'|').add(b'}').add(b'\\').add(b'^')
};

/// A run and what to show of it, as the query of an address: `?v=1&seed=2005&world=lot&tick=600&script=...`.
///
/// Every field may be left out. Fields of other names are ignored, so that a page may add its own. A known field must
/// be valid.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// The run's seed; the book's when left out.
    pub seed: Seed,
    /// The names of its worlds, which are built in; an empty list stands for all three.
    pub worlds: Vec<String>,
    /// The tick that is shown.
    pub tick: u64,
    /// The widget in front.
    pub widget: Option<Widget>,
    /// The lesson that it begins, in its own widget.
    pub lesson: Option<Lesson>,
    /// Query's question.
    pub tab: Option<Tab>,
    /// The chart coordinates of Query's robot, which is the configuration space's too: metres and radians. An empty
    /// list leaves it where it is.
    pub q: Vec<f64>,
    /// The paper.
    pub theme: Option<ThemeChoice>,
    /// The input.
    pub script: Script,
    /// The digest of the run up to the tick, as whoever made the link saw it: 32 hexadecimal digits.
    pub digest: Option<String>,
}

/// Why an address is refused, or a run does not fit in one.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LinkError {
    /// The link has another version.
    #[error("v: this lab reads links of version {LINK_VERSION} and {LINK_VERSION_WITH_INPUTS}, not {}", cited(.0))]
    Version(String),
    /// A field that is no whole number, or too large.
    #[error("{field}: it must be a whole number up to {most}, not {}", cited(.text))]
    Number {
        /// The field.
        field: &'static str,
        /// Its text.
        text: String,
        /// The largest number allowed.
        most: u64,
    },
    /// A field that holds none of its known words.
    #[error("{field}: it must be one of {known}, not {}", cited(.text))]
    Word {
        /// The field.
        field: &'static str,
        /// Its text.
        text: String,
        /// The words allowed.
        known: String,
    },
    /// An id that no lesson has.
    #[error("lesson: no lesson has the id {}", cited(.0))]
    Lesson(String),
    /// Not the coordinates of a configuration.
    #[error("q: it must be up to {MAX_COORDINATES} numbers, joined by commas, not {}", cited(.0))]
    Coordinates(String),
    /// A digest that is not 32 hexadecimal digits.
    #[error("digest: it must be 32 hexadecimal digits, not {}", cited(.0))]
    Digest(String),
    /// Text that is not UTF-8 once its escapes are undone.
    #[error("{0}: not valid UTF-8")]
    Text(&'static str),
    /// A script that is refused.
    #[error("script: {}", requoted(.0))]
    Script(#[from] ScriptError),
    /// Inputs that make no sense from this byte on.
    #[error("inputs: they make no sense at byte {0}")]
    Inputs(usize),
    /// Too long for an address.
    #[error("the link would have {0} characters; the limit is {MAX_LINK}: save the run as a file instead")]
    TooLong(usize),
    /// A run of worlds that are not built in, or of other robots in them.
    #[error("{0} is not an unmodified built-in world: save the run as a file instead")]
    World(String),
    /// A sensor that is not the lab's.
    #[error("the run's range sensor is not the lab's usual one: save the run as a file instead")]
    Sensor,
}

/// Largest number of characters of a link that its refusal repeats: too few for a sentence of the link's maker.
const MAX_CITED: usize = 12;

/// Largest number of characters of what is said about a script.
const MAX_OF_SCRIPT: usize = 100;

/// Words of somebody else, so that nobody takes them for the lab's: between quotes and cut short.
pub fn cited(text: &str) -> String {
    format!("{:?}", cut(text, MAX_CITED))
}

/// What is said about the link's run, without long names that the link gives: those are between quotes or backticks,
/// where a quote within is escaped.
pub fn requoted(error: &impl ToString) -> String {
    let (mut said, mut name) = (String::new(), None::<(char, String)>);
    let text = error.to_string();
    let mut letters = text.chars();
    while let Some(letter) = letters.next() {
        match &mut name {
            Some((mark, inner)) if letter == *mark => {
                said.extend([cut(inner, MAX_CITED), letter.to_string()]);
                name = None;
            }
            Some((_, inner)) => {
                inner.push(letter);
                inner.extend((letter == '\\').then(|| letters.next()).flatten());
            }
            None => {
                said.push(letter);
                name = matches!(letter, '"' | '`').then(|| (letter, String::new()));
            }
        }
    }
    // a name without an end
    said.extend(name.map(|(_, inner)| cut(&inner, MAX_CITED)));
    cut(&said, MAX_OF_SCRIPT)
}

/// The text up to a number of characters; dots stand for the rest.
fn cut(text: &str, most: usize) -> String {
    let end = text.char_indices().nth(most).map_or(text.len(), |(at, _)| at);
    format!("{}{}", &text[..end], if end < text.len() { "..." } else { "" })
}

impl Default for Link {
    fn default() -> Self {
        Link {
            seed: BOOK_SEED,
            worlds: vec![],
            tick: 0,
            widget: None,
            lesson: None,
            tab: None,
            q: vec![],
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
    /// [`LinkError`] when the run's worlds or sensor are not the lab's own, or the tick lies beyond [`MAX_LINK_TICK`].
    pub fn of(recipe: &Recipe) -> Result<Self, LinkError> {
        let Recipe { seed, config, script } = recipe;
        let usual = TourConfig::default();
        if config.sensor != usual.sensor {
            return Err(LinkError::Sensor);
        }
        if config.ticks > MAX_LINK_TICK {
            return Err(LinkError::Number { field: "tick", text: config.ticks.to_string(), most: MAX_LINK_TICK });
        }
        let mut worlds = Vec::new();
        for world in config.worlds.iter().filter(|_| config.worlds != usual.worlds) {
            let own = World::built_in_names().into_iter().find(|name| World::built_in(name).as_ref() == Some(world));
            worlds.push(own.ok_or_else(|| LinkError::World(world.name.clone()))?.to_owned());
        }
        Ok(Link { seed: *seed, worlds, tick: config.ticks, script: script.clone(), ..Link::default() })
    }

    /// The link that the query of an address holds, with or without its question mark; likewise that of a fragment.
    ///
    /// # Errors
    /// [`LinkError`] names the first field that is not right; a script is checked as one in a file is.
    pub fn parse(query: &str) -> Result<Self, LinkError> {
        if query.len() > MAX_LINK {
            return Err(LinkError::TooLong(query.len()));
        }
        let mut fields = BTreeMap::new();
        for pair in query.trim_start_matches(['?', '#']).split('&').filter(|p| !p.is_empty()) {
            let (name, value) = pair.split_once('=').unwrap_or((pair, ""));
            let Some(name) = FIELDS.into_iter().find(|known| *known == name) else { continue };
            let value = percent_decode_str(value).decode_utf8().map_err(|_| LinkError::Text(name))?;
            fields.entry(name).or_insert_with(|| value.into_owned());
        }
        let known = [LINK_VERSION, LINK_VERSION_WITH_INPUTS].map(|version| version.to_string());
        if let Some(version) = fields.remove("v").filter(|v| !known.contains(v)) {
            return Err(LinkError::Version(version));
        }
        let mut link = Link::default();
        if let Some(seed) = number(&mut fields, "seed", u64::MAX)? {
            link.seed = Seed(seed);
        }
        if let Some(tick) = number(&mut fields, "tick", MAX_LINK_TICK)? {
            link.tick = tick;
        }
        if let Some(text) = fields.remove("world") {
            for name in text.split(',') {
                if World::built_in(name).is_none() || link.worlds.iter().any(|w| w == name) {
                    let known = World::built_in_names().join(", ");
                    return Err(LinkError::Word { field: "world", text, known });
                }
                link.worlds.push(name.to_owned());
            }
        }
        if let Some(text) = fields.remove("widget") {
            link.widget = Widget::of(&text);
            if link.widget.is_none() {
                let known = Widget::ALL.map(Widget::id).join(", ");
                return Err(LinkError::Word { field: "widget", text, known });
            }
        }
        if let Some(text) = fields.remove("lesson") {
            link.lesson = Some(Lesson::of(&text).ok_or(LinkError::Lesson(text))?);
        }
        if let Some(text) = fields.remove("tab") {
            link.tab = Tab::ALL.into_iter().find(|tab| tab.name() == text);
            if link.tab.is_none() {
                let known = Tab::ALL.map(Tab::name).join(", ");
                return Err(LinkError::Word { field: "tab", text, known });
            }
        }
        if let Some(text) = fields.remove("q") {
            let numbers = text.split(',').map(|number| number.parse().ok().filter(|x: &f64| x.is_finite()));
            let numbers: Option<Vec<f64>> = numbers.take(MAX_COORDINATES + 1).collect();
            let numbers = numbers.filter(|all| all.len() <= MAX_COORDINATES);
            link.q = numbers.ok_or(LinkError::Coordinates(text))?;
        }
        if let Some(text) = fields.remove("theme") {
            link.theme = ThemeChoice::ALL.into_iter().find(|t| t.name().to_lowercase() == text);
            if link.theme.is_none() {
                return Err(LinkError::Word { field: "theme", text, known: "system, light, dark".into() });
            }
        }
        if let Some(text) = fields.remove("script") {
            link.script = Script::parse("line", &text)?;
        }
        if let Some(text) = fields.remove("inputs") {
            let Script { mut events, changes, .. } = link.script;
            events.extend(inputs::decode(&text).map_err(LinkError::Inputs)?);
            // as text, the inputs are checked as those of a file
            link.script = Script::parse("line", &Script::new(events, changes).to_line())?;
        }
        if let Some(text) = fields.remove("digest") {
            if text.len() != 32 || !text.bytes().all(|b| b.is_ascii_hexdigit()) {
                return Err(LinkError::Digest(text));
            }
            link.digest = Some(text.to_ascii_lowercase());
        }
        Ok(link)
    }

    /// The query, without its question mark. Parsing it gives the link back. Where it would be long, its inputs are in
    /// few bytes.
    ///
    /// # Errors
    /// [`LinkError::TooLong`].
    pub fn query(&self) -> Result<String, LinkError> {
        let mut query = self.with(&self.script, None);
        if query.len() > LONG
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
        let version = if inputs.is_some() { LINK_VERSION_WITH_INPUTS } else { LINK_VERSION };
        let mut query = format!("v={version}&seed={}", self.seed);
        let mut field = |name: &str, value: &str| {
            // writing into a string can't fail
            let _ = write!(query, "&{name}={}", utf8_percent_encode(value, ESCAPED));
        };
        if !self.worlds.is_empty() {
            field("world", &self.worlds.join(","));
        }
        if let Some(widget) = self.widget {
            field("widget", widget.id());
        }
        if let Some(lesson) = self.lesson {
            field("lesson", &lesson.id());
        }
        if let Some(tab) = self.tab {
            field("tab", tab.name());
        }
        if !self.q.is_empty() {
            field("q", &self.q.iter().map(f64::to_string).collect::<Vec<_>>().join(","));
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
        let mut config = TourConfig { ticks: self.tick.max(1), ..TourConfig::default() };
        if !self.worlds.is_empty() {
            config.worlds = self.worlds.iter().filter_map(|name| World::built_in(name)).collect();
        }
        Recipe::new(config, (self.seed, self.script.clone()))
    }
}

fn number(fields: &mut BTreeMap<&str, String>, field: &'static str, most: u64) -> Result<Option<u64>, LinkError> {
    let Some(text) = fields.remove(field) else { return Ok(None) };
    // a sign or a blank is no digit
    match text.parse().ok().filter(|n| *n <= most && text.bytes().all(|b| b.is_ascii_digit())) {
        Some(number) => Ok(Some(number)),
        None => Err(LinkError::Number { field, text, most }),
    }
}

#[cfg(test)]
mod tests;
