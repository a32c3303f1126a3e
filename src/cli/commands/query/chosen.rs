//! `Chosen`, the robot that a name means in a world.

use std::sync::Arc;

use clap::ValueEnum;
use motion_lab::collision::Scene;
use motion_lab::configuration::{AnyConfiguration, RobotKind};
use motion_lab::robots::AnyRobot;
use motion_lab::worlds::{Resident, World};

use super::inquiry::Inquiry;
use super::line::{Asked, check_place};
use super::robot::{RobotName, ask_about};
use crate::cli::Failure;
use crate::cli::support::world_source::find_world;

/// A robot that can be asked about.
#[derive(Clone, Debug)]
pub enum Chosen {
    /// A robot of a kind's own sizes.
    Kind(RobotName),
    /// A resident of the world, as its world says it is.
    Resident(Box<Resident>),
}

impl Chosen {
    /// The robot that `name` means in a world: the resident of this name, else a robot of this kind.
    pub fn find(name: &str, world: &World) -> Result<Chosen, Failure> {
        if let Some(resident) = world.robots.iter().find(|r| r.name == name) {
            if RobotKind::of(&resident.kind).is_none() {
                let reason = format!("{name} is a {}, a kind of some program's own", resident.kind);
                return Err(Failure::usage(reason, "Ask about it through the library, from that program."));
            }
            return Ok(Chosen::Resident(Box::new(resident.clone())));
        }
        RobotName::from_str(name, false).map(Chosen::Kind).map_err(|_| {
            let names: Vec<&str> = world.robots.iter().map(|r| r.name.as_str()).collect();
            let there = if names.is_empty() { "nobody".to_owned() } else { names.join(", ") };
            Failure::usage(
                format!("no robot is called {name:?}"),
                format!("The kinds are {}; in {} lives {there}.", RobotName::list(), world.name),
            )
        })
    }

    /// The name of the world in which `name` is looked for when none is given: where that kind lives, else the built-in
    /// world with a resident of this name, else the apartment.
    pub fn home(name: &str) -> &'static str {
        if let Ok(kind) = RobotName::from_str(name, false) {
            return kind.home();
        }
        let lives = |world: &World| world.robots.iter().any(|r| r.name == name);
        let mut worlds = World::built_in_names().into_iter();
        worlds.find(|world| World::built_in(world).is_some_and(|w| lives(&w))).unwrap_or("apartment")
    }

    /// The robot that `name` means, and its world: the one given, or the one that the name implies.
    pub fn in_world(name: &str, world: Option<&str>) -> Result<(Chosen, World), Failure> {
        let world = find_world(world.unwrap_or_else(|| Chosen::home(name)))?;
        Ok((Chosen::find(name, &world)?, world))
    }

    /// Where it starts; `None` for a kind.
    pub fn start(&self) -> Option<&[f64]> {
        match self {
            Chosen::Kind(_) => None,
            Chosen::Resident(resident) => Some(&resident.start),
        }
    }

    /// The robot with a configuration: these numbers, or its start. A kind without numbers is where
    /// [`RobotName::at`] says.
    pub fn at(&self, numbers: Option<&[f64]>, world: &World) -> Result<(AnyRobot, AnyConfiguration), String> {
        let resident = match self {
            Chosen::Kind(name) => return name.at(numbers, world),
            Chosen::Resident(resident) => resident,
        };
        let Resident { name, kind, start, sizes, .. } = &**resident;
        let numbers = match numbers {
            Some([x, y]) if *kind == RobotKind::RUSTY.name => vec![*x, *y, 0.0],
            Some(numbers) => numbers.to_vec(),
            None => start.clone(),
        };
        if RobotKind::of(kind).is_some_and(|known| known.drives) {
            check_place(&numbers)?;
        }
        AnyRobot::sized(kind, &numbers, sizes.as_ref())
            .ok_or_else(|| format!("{numbers:?} is no configuration of {name}, a {kind}"))
    }

    /// The answer to an inquiry about this robot.
    pub(crate) fn answer<I: Inquiry>(
        &self,
        scene: &Arc<Scene>,
        inquiry: &I,
        asked: &Asked,
    ) -> Result<I::Answer, String> {
        let model = match self {
            Chosen::Kind(name) => Some(name.model()),
            Chosen::Resident(resident) => AnyRobot::model(&resident.kind, resident.sizes.as_ref()),
        };
        ask_about(&model.ok_or("this robot is of some program's own kind")?, scene, inquiry, asked)
    }
}
