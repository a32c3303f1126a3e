//! Which robots take part, and what stands in for one of them.

use std::str::FromStr;

use motion_lab::worlds::{Resident, World};

use crate::cli::Failure;

/// A robot to keep: as the world has it, or another robot under its name.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotChoice {
    name: String,
    stand_in: Option<(String, Vec<f64>)>,
}

impl FromStr for RobotChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some((name, stand_in)) = text.split_once('=') else {
            return Ok(RobotChoice { name: text.to_owned(), stand_in: None });
        };
        let (kind, numbers) = stand_in.split_once(':').ok_or("write NAME=KIND:NUMBERS, as Reach=reach3:0.1,0.2,0.3")?;
        let number = |n: &str| n.trim().parse::<f64>().map_err(|_| format!("{n:?} is no number"));
        let start = numbers.split(',').map(number).collect::<Result<_, _>>()?;
        Ok(RobotChoice { name: name.to_owned(), stand_in: Some((kind.to_owned(), start)) })
    }
}

/// Keeps the chosen robots of the worlds; all of them when none is chosen.
pub fn choose(worlds: &mut [World], choices: &[RobotChoice]) -> Result<(), Failure> {
    if choices.is_empty() {
        return Ok(());
    }
    for choice in choices {
        if !worlds.iter().any(|w| w.robots.iter().any(|r| r.name == choice.name)) {
            let names: Vec<&str> = worlds.iter().flat_map(|w| &w.robots).map(|r| r.name.as_str()).collect();
            return Err(Failure::usage(
                format!("--robot {}: no such robot lives in these worlds", choice.name),
                format!("They have {}.", if names.is_empty() { "none".into() } else { names.join(", ") }),
            ));
        }
    }
    for world in worlds {
        let keep = |r: &Resident| {
            let choice = choices.iter().find(|c| c.name == r.name)?;
            Some(match choice.stand_in.clone() {
                Some((kind, start)) => Resident::try_new(r.name.clone(), kind, start, None)
                    .map(|stand_in| Resident { sizes: r.sizes.clone().filter(|_| stand_in.kind == r.kind), ..stand_in })
                    .map_err(|problem| {
                        Failure::usage(format!("--robot {}: {problem}", r.name), "See `motion-lab record --help`.")
                    }),
                None => Ok(r.clone()),
            })
        };
        world.robots = world.robots.iter().filter_map(keep).collect::<Result<_, _>>()?;
    }
    Ok(())
}
