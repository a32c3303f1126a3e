//! Values of arguments: names of worlds and robots, which shells offer though any other text is a value too; themes;
//! numbers.

use std::ffi::OsStr;
use std::str::FromStr;

use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use clap::{Arg, Command, Error, ValueEnum};
use motion_lab::configuration::RobotKind;
use motion_lab::picture::Theme;
use motion_lab::worlds::World;

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

/// The names of the kinds, as `query` has them.
const KINDS: [&str; 5] =
    [RobotKind::RUSTY.name, RobotKind::REACH.name, "choset", RobotKind::REACH3.name, RobotKind::HITCH.name];

/// The colours of paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ThemeName {
    Light,
    Dark,
}

impl ThemeName {
    /// The theme.
    pub fn theme(self) -> Theme {
        match self {
            ThemeName::Light => Theme::Light,
            ThemeName::Dark => Theme::Dark,
        }
    }
}

/// Numbers joined by commas.
#[derive(Clone, Debug)]
pub struct Numbers(pub Vec<f64>);

impl FromStr for Numbers {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number =
            |n: &str| n.trim().parse().map_err(|_| format!("{n:?} is no number; join numbers by commas: 0.785,1.571"));
        text.split(',').map(number).collect::<Result<_, _>>().map(Numbers)
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::commands::query::RobotName;

    #[test]
    fn the_names_offered_are_those_that_there_are() {
        let worlds = World::built_in_names().into_iter().filter_map(World::built_in);
        let robots: Vec<String> = worlds.flat_map(|world| world.robots).map(|robot| robot.name).collect();
        assert_eq!(robots, ROBOTS);
        assert_eq!(RobotName::list(), KINDS.join(", "));
    }
}
