//! `Link`, a run and what to show of it in the query of an address.

use std::collections::BTreeMap;
use std::fmt::Write;

use percent_encoding::{AsciiSet, CONTROLS, percent_decode_str, utf8_percent_encode};

use crate::manifest::{ThemeChoice, Widget};
use crate::random::Seed;
use crate::run::{Script, ScriptError};
use crate::tour::{BOOK_SEED, TourConfig};
use crate::worlds::World;

/// The version of the address format that this program writes and reads.
pub const LINK_VERSION: u32 = 1;

/// Largest length of a query, bytes: every browser and mail program carries this much.
pub const MAX_LINK: usize = 8000;

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
    #[error("v={0}: this lab reads links of version {LINK_VERSION}")]
    Version(String),
    /// A field that is no whole number, or too large.
    #[error("{field}={text}: it must be a whole number up to {most}")]
    Number {
        /// The field.
        field: &'static str,
        /// Its text.
        text: String,
        /// The largest number allowed.
        most: u64,
    },
    /// A field that holds none of its known words.
    #[error("{field}={text}: it must be one of {known}")]
    Word {
        /// The field.
        field: &'static str,
        /// Its text.
        text: String,
        /// The words allowed.
        known: String,
    },
    /// A digest that is not 32 hexadecimal digits.
    #[error("digest={0}: it must be 32 hexadecimal digits")]
    Digest(String),
    /// Text that is not UTF-8 once its escapes are undone.
    #[error("{0}: not valid UTF-8")]
    Text(String),
    /// A script that is refused.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// Too long for an address.
    #[error("the link would have {0} characters; the limit is {MAX_LINK}: save the run as a file instead")]
    TooLong(usize),
    /// A run of worlds that are not built in, or of other robots in them.
    #[error("{0} is not an unmodified built-in world: save the run as a file instead")]
    World(String),
    /// A sensor that is not the lab's.
    #[error("the run has a range sensor of its own: save the run as a file instead")]
    Sensor,
}

impl Default for Link {
    fn default() -> Self {
        Link {
            seed: BOOK_SEED,
            worlds: vec![],
            tick: 0,
            widget: None,
            theme: None,
            script: Script::empty(),
            digest: None,
        }
    }
}

impl Link {
    /// The link that shows a run of this seed, configuration and script at the configuration's last tick.
    ///
    /// # Errors
    /// [`LinkError`] when the run's worlds or sensor are not the lab's own, or the tick lies beyond [`MAX_LINK_TICK`].
    pub fn of(seed: Seed, config: &TourConfig, script: Script) -> Result<Self, LinkError> {
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
        Ok(Link { seed, worlds, tick: config.ticks, script, ..Link::default() })
    }

    /// The link that the query of an address holds, with or without its question mark.
    ///
    /// # Errors
    /// [`LinkError`] names the first field that is not right; a script is checked as one in a file is.
    pub fn parse(query: &str) -> Result<Self, LinkError> {
        if query.len() > MAX_LINK {
            return Err(LinkError::TooLong(query.len()));
        }
        let mut fields = BTreeMap::new();
        for pair in query.trim_start_matches('?').split('&').filter(|p| !p.is_empty()) {
            let (name, value) = pair.split_once('=').unwrap_or((pair, ""));
            let value = percent_decode_str(value).decode_utf8().map_err(|_| LinkError::Text(name.to_owned()))?;
            fields.entry(name).or_insert_with(|| value.into_owned());
        }
        if let Some(version) = fields.remove("v").filter(|v| *v != LINK_VERSION.to_string()) {
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
        if let Some(text) = fields.remove("theme") {
            link.theme = ThemeChoice::ALL.into_iter().find(|t| t.name().to_lowercase() == text);
            if link.theme.is_none() {
                return Err(LinkError::Word { field: "theme", text, known: "system, light, dark".into() });
            }
        }
        if let Some(text) = fields.remove("script") {
            link.script = Script::parse("the link's script", &text)?;
        }
        if let Some(text) = fields.remove("digest") {
            if text.len() != 32 || !text.bytes().all(|b| b.is_ascii_hexdigit()) {
                return Err(LinkError::Digest(text));
            }
            link.digest = Some(text.to_ascii_lowercase());
        }
        Ok(link)
    }

    /// The query, without its question mark. Parsing it gives the link back.
    ///
    /// # Errors
    /// [`LinkError::TooLong`].
    pub fn query(&self) -> Result<String, LinkError> {
        let mut query = format!("v={LINK_VERSION}&seed={}", self.seed);
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
        if let Some(theme) = self.theme {
            field("theme", &theme.name().to_lowercase());
        }
        if !self.script.is_empty() {
            field("script", &self.script.to_line());
        }
        if self.tick > 0 {
            field("tick", &self.tick.to_string());
        }
        if let Some(digest) = &self.digest {
            field("digest", digest);
        }
        if query.len() > MAX_LINK { Err(LinkError::TooLong(query.len())) } else { Ok(query) }
    }

    /// The configuration of the run: as long as the link's tick, and at least one tick.
    pub fn config(&self) -> TourConfig {
        let usual = TourConfig { ticks: self.tick.max(1), ..TourConfig::default() };
        if self.worlds.is_empty() {
            return usual;
        }
        TourConfig { worlds: self.worlds.iter().filter_map(|name| World::built_in(name)).collect(), ..usual }
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
mod tests {
    use super::*;
    use crate::run::{Event, Quantized, RobotInput, WorldChange, WorldEvent};

    fn driven() -> Script {
        let event = |tick, robot: &str, input| Event { tick, robot: robot.into(), input };
        let events = vec![
            event(1, "Rusty", RobotInput::Drive(128, -64)),
            event(9, "Reach", RobotInput::MoveTo(vec![Quantized(1 << 20), Quantized(-7)])),
            event(9, "Hitch", RobotInput::SetTrailer(true)),
            event(30, "Rusty", RobotInput::Release),
        ];
        Script::new(events, vec![])
    }

    #[test]
    fn a_link_reads_back_as_it_was_written() {
        let link = Link {
            seed: Seed(u64::MAX),
            worlds: vec!["lot".into(), "workbench".into()],
            tick: 600,
            widget: Some(Widget::Atlas),
            theme: Some(ThemeChoice::Dark),
            script: driven(),
            digest: Some("0123456789abcdef0123456789abcdef".into()),
        };
        let query = link.query().unwrap();
        assert!(query.bytes().all(|b| b.is_ascii_graphic() && !b"\"<>[]{}|\\^`#".contains(&b)), "{query}");
        assert_eq!(Link::parse(&query).unwrap(), link);
        assert_eq!(Link::parse(&format!("?{query}&utm=mail&x")).unwrap(), link, "other fields are ignored");
        assert_eq!(Link::parse("").unwrap(), Link::default());
        assert_eq!(Link::parse(&Link::default().query().unwrap()).unwrap(), Link::default());
        assert_eq!(link.config().worlds.iter().map(|w| w.name.as_str()).collect::<Vec<_>>(), ["Lot", "Workbench"]);
    }

    #[test]
    fn a_link_holds_the_doors_that_were_closed() {
        let change = WorldChange::Close("door A".into());
        let script = Script::new(vec![], vec![WorldEvent { tick: 3, world: "Apartment".into(), change }]);
        let link = Link { script: script.clone(), tick: 9, ..Link::default() };
        assert_eq!(Link::parse(&link.query().unwrap()).unwrap().script, script);
    }

    #[test]
    fn a_run_becomes_the_link_that_runs_it_again() {
        let config = TourConfig { ticks: 77, ..TourConfig::default() };
        let link = Link::of(Seed(3), &config, driven()).unwrap();
        assert_eq!((link.config(), link.seed, &link.script), (config.clone(), Seed(3), &driven()));
        let lot = Link { worlds: vec!["lot".into()], tick: 5, ..Link::default() };
        assert_eq!(Link::of(BOOK_SEED, &lot.config(), Script::empty()).unwrap(), lot);
        let mut edited = config.clone();
        edited.worlds[1].robots.clear();
        let refused = Link::of(Seed(3), &edited, Script::empty()).unwrap_err();
        assert_eq!(refused, LinkError::World("Workbench".into()));
        let long = TourConfig { ticks: MAX_LINK_TICK + 1, ..config };
        assert!(matches!(Link::of(Seed(3), &long, Script::empty()), Err(LinkError::Number { field: "tick", .. })));
    }

    #[test]
    fn hostile_values_are_refused_by_name() {
        let said = |query: &str| Link::parse(query).unwrap_err().to_string();
        assert_eq!(said("v=2&seed=x"), "v=2: this lab reads links of version 1");
        assert!(said("seed=-1").starts_with("seed=-1: it must be a whole number up to 1844"));
        assert!(said("seed=18446744073709551616").starts_with("seed="));
        assert_eq!(said("tick=72001"), "tick=72001: it must be a whole number up to 72000");
        assert_eq!(said("tick=%2B1"), "tick=+1: it must be a whole number up to 72000");
        assert_eq!(said("world=moon"), "world=moon: it must be one of apartment, workbench, lot");
        assert!(said("world=lot,lot").contains("one of"), "a world comes once");
        assert!(said("widget=%3Cscript%3E").starts_with("widget=<script>: it must be one of dashboard"));
        assert_eq!(said("theme=pink"), "theme=pink: it must be one of system, light, dark");
        assert!(said("digest=12").contains("32 hexadecimal"));
        assert_eq!(said("script=%FF"), "script: not valid UTF-8");
        let script = "Script(version:1,events:[(tick:1,robot:\"Rusty\",input:Drive(129,0))])";
        let query = format!("script={}", utf8_percent_encode(script, ESCAPED));
        assert_eq!(said(&query), "the link's script:1: events[0]: channel 129: it must be in -128 to 128");
        assert!(matches!(Link::parse(&"x".repeat(MAX_LINK + 1)), Err(LinkError::TooLong(_))));
        let events = (1..400).map(|tick| Event { tick, robot: "Rusty".into(), input: RobotInput::Release });
        let long = Link { script: Script::new(events.collect(), vec![]), ..Link::default() };
        assert!(long.query().unwrap_err().to_string().ends_with("save the run as a file instead"));
    }
}
