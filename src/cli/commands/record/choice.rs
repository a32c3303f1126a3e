//! Which robots take part, and where and as what some of them start.

use std::str::FromStr;

use motion_lab_core::configuration::WrittenCoordinate;
use motion_lab_core::names::did_you_mean;
use motion_lab_core::worlds::{Resident, World};

use crate::cli::Failure;
use crate::cli::support::choices::{lengths_of, values};

/// A robot's place: where it starts, and its kind if that is not the world's.
#[derive(Clone, Debug, PartialEq)]
pub struct StartChoice {
    name: String,
    kind: Option<String>,
    start: Vec<WrittenCoordinate>,
}

impl FromStr for StartChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = "write NAME=NUMBERS or NAME=KIND:NUMBERS, as Rusty=1,2,0 or Reach=reach3:0.1,0.2,0.3";
        let (name, place) = text.split_once('=').ok_or(form)?;
        let (kind, numbers) = match place.split_once(':') {
            Some((kind, numbers)) => (Some(kind.to_owned()), numbers),
            None => (None, place),
        };
        let number = |n: &str| n.parse().map_err(|_| format!("{n:?} is no number: {form}"));
        let start = numbers.split(',').map(number).collect::<Result<_, _>>()?;
        Ok(StartChoice { name: name.to_owned(), kind, start })
    }
}

/// Keeps the robots of these names, or all of them when none is named, and puts those that have a place there.
///
/// `NAME=KIND:NUMBERS` as a name, the earlier spelling, both keeps a robot and puts it there.
pub fn choose(worlds: &mut [World], names: &[String], places: &[StartChoice]) -> Result<(), Failure> {
    let mut places: Vec<(&str, StartChoice)> = places.iter().map(|place| ("--place", place.clone())).collect();
    let mut kept: Vec<&str> = Vec::new();
    for text in names {
        let known = |name: &str| worlds.iter().any(|w| w.robots.iter().any(|r| r.name == name));
        match text.split_once('=').filter(|_| !known(text)) {
            None => kept.push(text),
            Some((name, _)) => {
                let place = text.parse().map_err(|reason| Failure::usage(format!("--robot {text}: {reason}"), HELP))?;
                places.push(("--robot", place));
                kept.push(name);
            }
        }
    }
    let all = kept.iter().map(|name| ("--robot", *name)).chain(places.iter().map(|(o, p)| (*o, p.name.as_str())));
    for (option, name) in all {
        if !worlds.iter().any(|w| w.robots.iter().any(|r| r.name == name)) {
            let there: Vec<&str> = worlds.iter().flat_map(|w| &w.robots).map(|r| r.name.as_str()).collect();
            return Err(Failure::usage(
                format!("{option} {name}: no such robot lives in these worlds"),
                format!(
                    "{}They have {}.",
                    did_you_mean(name, there.iter().copied()),
                    if there.is_empty() { "none".into() } else { there.join(", ") }
                ),
            ));
        }
    }
    for world in worlds {
        let mut placed = None;
        world.robots.retain(|r| kept.is_empty() || kept.contains(&r.name.as_str()));
        for robot in &mut world.robots {
            for (option, place) in &places {
                if place.name != robot.name {
                    continue;
                }
                let put = if *option == "--place" { place.put(robot) } else { place.replace(robot) };
                *robot = put.map_err(|problem| Failure::usage(format!("{option} {problem}"), HELP))?;
                placed = Some(*option);
            }
        }
        // a world from elsewhere was checked when it was read
        if let (Some(option), Err((i, reason))) = (placed, world.check_residents()) {
            return Err(Failure::usage(format!("{option} {}: {reason}", world.robots[i].name), HELP));
        }
    }
    Ok(())
}

/// What to do about a wrong choice.
const HELP: &str = "See `motion-lab record --help`.";

impl StartChoice {
    /// The robot as this placement has it. One of the same kind keeps all else that the world says of it.
    fn put(&self, robot: &Resident) -> Result<Resident, String> {
        let placed = self.replace(robot)?;
        Ok(if placed.kind == robot.kind { Resident { start: placed.start, ..robot.clone() } } else { placed })
    }

    /// A new robot in place of this one, as `--robot NAME=KIND:NUMBERS` makes it. One of the same kind has its sizes.
    fn replace(&self, robot: &Resident) -> Result<Resident, String> {
        let StartChoice { name, kind, start } = self;
        let kind = kind.clone().unwrap_or_else(|| robot.kind.clone());
        let start = values(start, lengths_of(&kind)).map_err(|reason| format!("{name}: {reason}"))?;
        let placed = Resident::try_new(name.clone(), kind, start, None);
        let placed = placed.map_err(|problem| format!("{name}: {problem}"))?;
        Ok(Resident { sizes: robot.sizes.clone().filter(|_| placed.kind == robot.kind), ..placed })
    }
}
