//! `Chosen`, the robot that a name means in a world.

use std::sync::Arc;

use motion_lab_core::collision::{Checker, Scene};
use motion_lab_core::configuration::{AnyConfiguration, RobotKind};
use motion_lab_core::names::did_you_mean;
use motion_lab_core::robots::{AnyRobot, Reach};
use motion_lab_core::worlds::{Resident, World};

use super::line::{QuerySubject, check_place, finite};
use crate::cli::Failure;
use crate::cli::support::choices::{CHOSET, KINDS, NumberList};
use crate::cli::support::words::counted;
use crate::cli::support::world_source::find_world;

/// A robot that can be asked about: a resident, as its world says it is, or one of a kind's own sizes.
#[derive(Clone, Debug)]
pub struct Chosen {
    /// The name by which it was chosen.
    pub name: String,
    about: &'static RobotKind,
    model: AnyRobot,
    /// Where a resident starts; `None` for a kind.
    pub start: Option<Vec<f64>>,
}

impl Chosen {
    /// The robot that `name` means in a world: the resident of this name, else a robot of this kind.
    pub fn find(name: &str, world: &World) -> Result<Chosen, Failure> {
        if let Some(resident) = world.robots.iter().find(|r| r.name == name) {
            return Chosen::resident(resident).ok_or_else(|| {
                let reason = format!("{name} is a {}, a kind of some program's own", resident.kind);
                Failure::usage(reason, "Ask about it through the library, from that program.")
            });
        }
        Chosen::kind(name).ok_or_else(|| {
            let names: Vec<&str> = world.robots.iter().map(|r| r.name.as_str()).collect();
            let there = if names.is_empty() { "nobody".to_owned() } else { names.join(", ") };
            Failure::usage(
                format!("no robot is called {name:?}"),
                format!(
                    "{}The kinds are {}; in {} lives {there}.",
                    did_you_mean(name, names.into_iter().chain(KINDS)),
                    KINDS.join(", "),
                    world.name
                ),
            )
        })
    }

    fn resident(resident: &Resident) -> Option<Chosen> {
        let Resident { name, kind, start, sizes, .. } = resident;
        let (about, model) = (RobotKind::of(kind)?, AnyRobot::model(kind, sizes.as_ref())?);
        Some(Chosen { name: name.clone(), about, model, start: Some(start.clone()) })
    }

    /// A robot of the kind of this name.
    pub fn kind(name: &str) -> Option<Chosen> {
        let model = if name == CHOSET { AnyRobot::Reach(Reach::choset()) } else { AnyRobot::model(name, None)? };
        Some(Chosen { name: name.to_owned(), about: model.about(), model, start: None })
    }

    /// The name of the world in which `name` is looked for when none is given: where that kind lives, else the built-in
    /// world with a resident of this name, else the apartment.
    pub fn home(name: &str) -> &'static str {
        let lives = |world: &World| world.robots.iter().any(|r| r.name == name);
        let of_kind = Chosen::kind(name).and_then(|kind| kind.about.home);
        let of_resident =
            || World::built_in_names().into_iter().find(|world| World::built_in(world).is_some_and(|w| lives(&w)));
        of_kind.or_else(of_resident).unwrap_or("apartment")
    }

    /// The robot that `name` means, and its world: the one given, or the one that the name implies.
    pub fn in_world(name: &str, world: Option<&str>) -> Result<(Chosen, World), Failure> {
        let world = find_world(world.unwrap_or_else(|| Chosen::home(name)))?;
        Ok((Chosen::find(name, &world)?, world))
    }

    /// Whether it goes from place to place, as an arm does not.
    pub fn goes_places(&self) -> bool {
        self.about.lengths >= 2
    }

    /// The name of its kind, as worlds have it.
    pub fn kind_name(&self) -> &'static str {
        self.about.name
    }

    /// The robot with a configuration as a person wrote it, and as [`at`](Self::at) without one.
    pub fn written(&self, numbers: Option<&NumberList>, world: &World) -> Result<(AnyRobot, AnyConfiguration), String> {
        let numbers = numbers.map(|numbers| self.values(numbers)).transpose()?;
        self.at(numbers.as_deref(), world)
    }

    /// The coordinates that a person wrote for this robot.
    pub fn values(&self, numbers: &NumberList) -> Result<Vec<f64>, String> {
        numbers.values(self.about.lengths)
    }

    /// The robot with a configuration: these numbers. Without numbers a resident is at its start, and a kind where the
    /// world's first resident of it starts; where there is none, an arm is as it usually is, and others are refused.
    fn at(&self, numbers: Option<&[f64]>, world: &World) -> Result<(AnyRobot, AnyConfiguration), String> {
        let Chosen { about, start, .. } = self;
        let of_its_kind = || world.robots.iter().find(|r| r.kind == about.name).map(|r| r.start.clone());
        let usual = || about.usual.map(<[f64]>::to_vec);
        match numbers {
            Some(numbers) => self.with(numbers),
            None => {
                let start = start.clone().or_else(of_its_kind).or_else(usual);
                self.with(
                    &start.ok_or_else(|| format!("no {} lives there: give its configuration with --q", about.name))?,
                )
            }
        }
    }

    /// The robot with the configuration of these numbers; the heading of a disc may be left out. A car has its trailer
    /// if they are four.
    fn with(&self, numbers: &[f64]) -> Result<(AnyRobot, AnyConfiguration), String> {
        let about = self.about;
        let without_heading = *about == RobotKind::RUSTY && numbers.len() == 2;
        let numbers = if without_heading { &[numbers, &[0.0]].concat() } else { numbers };
        if about.space(numbers.len()).is_none() {
            let other = if *about == RobotKind::RUSTY { "two: x, y; or " } else { "" };
            return Err(format!("{}: a {} has {other}{}", counted(numbers.len(), "number"), about.name, about.start));
        }
        let check = if about.drives { check_place } else { finite };
        check(numbers)?;
        let none = || format!("{numbers:?} is no configuration of a {}", about.name);
        let (_, q) = AnyRobot::of_kind(about.name, numbers).ok_or_else(none)?;
        Ok((self.model.fitted(&q), q))
    }

    /// The checker of this robot in a scene, the configuration asked about and the motion's end. The error says what is
    /// wrong with either.
    pub fn checker(
        &self,
        scene: &Arc<Scene>,
        asked: &QuerySubject,
    ) -> Result<(Checker<AnyRobot>, AnyConfiguration, Option<AnyConfiguration>), String> {
        let (robot, q) = self.with(&asked.q)?;
        let to = asked.to.as_deref().map(|to| self.with(to)).transpose().map_err(|reason| format!("`to`: {reason}"))?;
        Ok((Checker::new(Arc::clone(scene), robot), q, to.map(|(_, q)| q)))
    }
}
