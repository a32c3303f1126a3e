//! Values of arguments: names of worlds and robots, which shells offer though any other text is a value too; one of the
//! library's values by its name; numbers; the address of the lab's page.

use std::ffi::OsStr;
use std::str::FromStr;

use crate::capture::CaptureForm;
use clap::builder::{PossibleValue, PossibleValuesParser, StringValueParser, TypedValueParser};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Args, Command, Error};
use motion_lab_core::configuration::{RobotKind, WrittenCoordinate};
use motion_lab_core::names::nearest;
use motion_lab_core::picture::Theme;
use motion_lab_core::worlds::World;
use motion_lab_sim::plans::CheckerName;
use motion_lab_sim::run::LogKind;

use super::console::note;

/// A built-in world's name, or the path of a file.
#[derive(Clone, Copy, Debug)]
pub struct WorldNames;

/// The name of a robot of a run: of the built-in worlds, or of another.
#[derive(Clone, Copy, Debug)]
pub struct RobotNames;

/// The name of a robot, or of one of the lab's kinds.
#[derive(Clone, Copy, Debug)]
pub struct RobotsAndKinds;

/// The names of the robots of the built-in worlds.
const ROBOTS: [&str; 3] = ["Rusty", "Reach", "Hitch"];

/// The name of the two-link arm without thickness, which is no kind of worlds.
pub const CHOSET: &str = "choset";

/// The names of the lab's kinds, and the arm without thickness.
pub const KINDS: [&str; 5] =
    [RobotKind::RUSTY.name, RobotKind::REACH.name, CHOSET, RobotKind::REACH3.name, RobotKind::HITCH.name];

/// Numbers joined by commas: the coordinates of a configuration.
#[derive(Clone, Debug)]
pub struct NumberList(pub Vec<WrittenCoordinate>);

impl NumberList {
    /// The values, of which the first, this many, are lengths. Angles that were hardly meant are noted.
    pub fn values(&self, lengths: usize) -> Result<Vec<f64>, String> {
        values(&self.0, lengths)
    }
}

/// The values of coordinates, of which the first, this many, are lengths. Angles that were hardly meant are noted.
pub fn values(written: &[WrittenCoordinate], lengths: usize) -> Result<Vec<f64>, String> {
    written.iter().skip(lengths).filter_map(|coordinate| coordinate.turns()).for_each(note);
    WrittenCoordinate::values(written, lengths).map_err(|reason| reason.to_string())
}

/// The number of lengths that the coordinates of a kind begin with; none of a kind that the lab does not have.
pub fn lengths_of(kind: &str) -> usize {
    RobotKind::of(kind).map_or(0, |known| known.lengths)
}

impl FromStr for NumberList {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number =
            |n: &str| n.parse().map_err(|_| format!("{n:?} is no number; join numbers by commas: 0.785,90deg"));
        text.split(',').map(number).collect::<Result<_, _>>().map(NumberList)
    }
}

/// Reads one of these values by its name. Each has its help, which may be empty.
pub fn one_of<T: Copy + Send + Sync + 'static>(
    values: impl IntoIterator<Item = (&'static str, T, &'static str)>,
) -> impl TypedValueParser<Value = T> {
    NamedValues { values: values.into_iter().collect() }
}

/// A parser of values by their names. A wrong one that is near a name, in any case of letters, gets that as a tip.
#[derive(Clone)]
struct NamedValues<T> {
    values: Vec<(&'static str, T, &'static str)>,
}

impl<T: Copy> NamedValues<T> {
    fn shown(&self) -> Vec<PossibleValue> {
        let shown = |(name, _, help): &(&'static str, T, &'static str)| {
            let value = PossibleValue::new(*name);
            if help.is_empty() { value } else { value.help(*help) }
        };
        self.values.iter().map(shown).collect()
    }
}

impl<T: Copy + Send + Sync + 'static> TypedValueParser for NamedValues<T> {
    type Value = T;

    fn parse_ref(&self, command: &Command, arg: Option<&Arg>, value: &OsStr) -> Result<T, Error> {
        let name = PossibleValuesParser::new(self.shown()).parse_ref(command, arg, value).map_err(|mut error| {
            let meant = value.to_str().and_then(|name| nearest(name, self.values.iter().map(|(known, ..)| *known)));
            if let Some(meant) = meant {
                error.insert(ContextKind::SuggestedValue, ContextValue::String(meant.to_owned()));
            }
            error
        })?;
        let found = self.values.iter().find(|(known, ..)| *known == name);
        found.map(|(_, value, _)| *value).ok_or_else(|| Error::new(ErrorKind::InvalidValue).with_cmd(command))
    }

    fn possible_values(&self) -> Option<Values> {
        Some(Box::new(self.shown().into_iter()))
    }
}

/// Reads the name of a checker.
pub fn checker() -> impl TypedValueParser<Value = CheckerName> {
    one_of(CheckerName::ALL.map(|name| (name.id(), name, name.words())))
}

/// Reads the name of a theme.
pub fn theme() -> impl TypedValueParser<Value = Theme> {
    one_of([("light", Theme::Light, ""), ("dark", Theme::Dark, "")])
}

/// Reads the name of a form of pictures, one of these.
pub fn form<const N: usize>(forms: [CaptureForm; N]) -> impl TypedValueParser<Value = CaptureForm> {
    one_of(forms.map(|form| (form.extension(), form, "")))
}

/// Reads `full` or `digest`.
pub fn log_kind() -> impl TypedValueParser<Value = LogKind> {
    one_of([
        ("full", LogKind::Frames, "Every frame to the last bit. The default up to 100 robots"),
        (
            "digest",
            LogKind::Digests,
            "A digest of each second instead of the frames, for `verify`. The default above 100 robots",
        ),
    ])
}

type Values = Box<dyn Iterator<Item = PossibleValue>>;

fn offered(names: impl IntoIterator<Item = &'static str>) -> Option<Values> {
    Some(Box::new(names.into_iter().map(PossibleValue::new).collect::<Vec<_>>().into_iter()))
}

macro_rules! offers {
    ($parser:ty, $names:expr) => {
        impl TypedValueParser for $parser {
            type Value = String;

            fn parse_ref(&self, command: &Command, arg: Option<&Arg>, value: &OsStr) -> Result<String, Error> {
                StringValueParser::new().parse_ref(command, arg, value)
            }

            fn possible_values(&self) -> Option<Values> {
                offered($names)
            }
        }
    };
}

offers!(WorldNames, World::built_in_names());
offers!(RobotNames, ROBOTS);
offers!(RobotsAndKinds, KINDS.into_iter().chain(ROBOTS));

/// The page that links lead to.
#[derive(Debug, Args)]
pub struct Site {
    /// The address of the lab's page, for links: where `assets/web/build` was put. By default where `assets/web/serve`
    /// shows it.
    #[arg(long, value_name = "URL", default_value = "http://localhost:8000/", value_parser = page_address)]
    pub site: String,
}

/// The address of a page, to which a query can be added.
fn page_address(text: &str) -> Result<String, String> {
    let rest = text.strip_prefix("http://").or_else(|| text.strip_prefix("https://"));
    match rest {
        Some(rest) if !rest.is_empty() && !rest.contains(['?', '#']) => Ok(text.to_owned()),
        _ => Err("write http:// or https:// and the rest, without ? and #".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_names_offered_are_those_that_there_are() {
        let worlds = World::built_in_names().into_iter().filter_map(World::built_in);
        let robots: Vec<String> = worlds.flat_map(|world| world.robots).map(|robot| robot.name).collect();
        assert_eq!(robots, ROBOTS);
        let kinds = KINDS.into_iter().filter(|name| *name != CHOSET);
        assert!(kinds.eq(RobotKind::ALL.map(|kind| kind.name)));
    }
}
