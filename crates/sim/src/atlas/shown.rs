//! `Atlas`, a world with its robots where the reader puts them.

use super::teleport::{Teleport, TeleportRefusal};
use motion_lab_core::collision::{Checker, ObstacleId};
use motion_lab_core::configuration::{AnyConfiguration, Configuration, Kinds};
use motion_lab_core::geometry::Footprint;
use motion_lab_core::picture::{Drawing, Gait, Picture, RobotDrawing, places, robot, world};
use motion_lab_core::robots::{AnyRobot, Robot};
use motion_lab_core::worlds::{Resident, World};
use std::collections::{BTreeMap, BTreeSet};

/// A world and those of its residents that are robots of the lab. Robots of a program's own kinds stand at their starts
/// when the atlas [knows](Atlas::knowing) the kinds.
#[derive(Clone, Debug, PartialEq)]
pub struct Atlas {
    world: World,
    residents: Vec<AtlasRobot>,
    kinds: Kinds,
}

/// A robot on the atlas.
#[derive(Clone, Debug, PartialEq)]
pub struct AtlasRobot {
    /// Its name in the world.
    pub name: String,
    /// The robot.
    pub robot: AnyRobot,
    /// Its configuration.
    pub q: AnyConfiguration,
}

impl Atlas {
    /// The world with its robots at their starts. Residents of other kinds are left out.
    pub fn new(world: World) -> Self {
        let residents = world.robots.iter().filter_map(|r| {
            let (robot, q) = AnyRobot::of_resident(r)?;
            Some(AtlasRobot { name: r.name.clone(), robot, q })
        });
        Atlas { residents: residents.collect(), world, kinds: Kinds::default() }
    }

    /// The same atlas that knows these kinds of robots too. It names and draws robots of a program's own kinds at their
    /// starts, and the lab's robots can't be put onto them.
    #[must_use]
    pub fn knowing(self, kinds: Kinds) -> Self {
        Atlas { kinds, ..self }
    }

    /// The same atlas with its robots where an earlier atlas has them: those of the same name, kind, sizes and start.
    #[must_use]
    pub fn keeping(mut self, earlier: &Atlas) -> Self {
        let were: BTreeMap<&str, &Resident> = earlier.world.robots.iter().map(|r| (r.name.as_str(), r)).collect();
        let are: BTreeMap<&str, &Resident> = self.world.robots.iter().map(|r| (r.name.as_str(), r)).collect();
        let stood: BTreeMap<&str, &AtlasRobot> = earlier.residents.iter().map(|r| (r.name.as_str(), r)).collect();
        let alike = |a: &Resident, b: &Resident| a.kind == b.kind && a.sizes == b.sizes && a.start == b.start;
        for robot in &mut self.residents {
            let name = robot.name.as_str();
            let both = were.get(name).zip(are.get(name));
            if let (Some((was, is)), Some(stood)) = (both, stood.get(name))
                && alike(was, is)
            {
                robot.q = stood.q;
            }
        }
        self
    }

    /// The kinds of robots that it knows.
    pub fn kinds(&self) -> &Kinds {
        &self.kinds
    }

    /// The residents of kinds that are not the lab's, with their footprints at their starts.
    pub fn others(&self) -> impl Iterator<Item = (&str, Footprint)> {
        let known: BTreeSet<&str> = self.residents.iter().map(|known| known.name.as_str()).collect();
        let strangers = self.world.robots.iter().filter(move |r| !known.contains(r.name.as_str()));
        strangers.filter_map(|r| Some((r.name.as_str(), self.kinds.footprint(&r.kind, &r.start)?)))
    }

    /// The world.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The world with its robots' starts where the robots are now.
    pub fn from_here(&self) -> World {
        let mut world = self.world.clone();
        // of two with one name the first counts
        let now: BTreeMap<&str, &AtlasRobot> = self.residents.iter().rev().map(|r| (r.name.as_str(), r)).collect();
        for resident in &mut world.robots {
            if let Some(now) = now.get(resident.name.as_str()) {
                resident.start = now.q.coordinates().to_vec();
            }
        }
        world
    }

    /// The robots.
    pub fn robots(&self) -> &[AtlasRobot] {
        &self.residents
    }

    /// All robots with their footprints: the lab's where they are, the others at their starts.
    pub fn standing(&self) -> impl Iterator<Item = (&str, Footprint)> {
        self.residents.iter().map(|r| (r.name.as_str(), r.robot.footprint(&r.q))).chain(self.others())
    }

    /// The checker of robot number `index` among the obstacles and the other robots, each an obstacle under its name.
    /// `None` for an unknown robot.
    pub fn checker(&self, index: usize) -> Option<Checker<AnyRobot>> {
        let robot = self.residents.get(index)?.robot;
        let standing = self.standing().enumerate().filter(|(i, _)| *i != index).map(|(_, standing)| standing);
        Some(Checker::new(super::teleport::crowd(&self.world, standing), robot))
    }

    /// The robots that could not be put where they stand, each with its name and the reason. Of the lab's robots it is
    /// what [`Teleport::ask_only`] says of each by its own [`checker`](Self::checker), from one scene for all.
    pub fn in_contact(&self) -> Vec<(&str, TeleportRefusal)> {
        let standing: Vec<(&str, Footprint)> = self.standing().collect();
        // where the parts of each robot begin among the obstacles of the scene
        let world = self.world.obstacles.len() + self.world.closed_doors().count();
        let first = standing.iter().scan(world, |first, (_, footprint)| {
            *first += footprint.parts().len();
            Some(*first - footprint.parts().len())
        });
        let first: Vec<usize> = first.collect();
        let scene =
            super::teleport::crowd(&self.world, standing.iter().map(|(name, footprint)| (*name, footprint.clone())));
        let residents = self.residents.iter().map(Some).chain(std::iter::repeat(None));
        let refused = standing.iter().zip(first).zip(residents).filter_map(|(((name, footprint), first), resident)| {
            let there = resident.map(|r| super::teleport::check_there(&r.robot, &r.q, &self.world.bounds));
            if let Some(Err(refusal)) = there {
                return Some((*name, refusal));
            }
            let own = first..first + footprint.parts().len();
            let touched = scene.touched(footprint);
            let others: Vec<ObstacleId> = touched.into_iter().filter(|id| !own.contains(&(id.0 as usize))).collect();
            // a footprint that is not finite is in contact, with nothing in particular
            let is_free = others.is_empty() && footprint.is_valid();
            (!is_free).then(|| {
                (*name, TeleportRefusal::Overlap { names: super::teleport::names(&scene, others), nearest: None })
            })
        });
        refused.collect()
    }

    /// Puts robot number `index` at `to`, or returns why not. `None` for an unknown robot.
    pub fn teleport(&mut self, index: usize, to: AnyConfiguration) -> Option<Result<(), TeleportRefusal>> {
        let checker = self.checker(index)?;
        let answer = Teleport::ask(&checker, &to);
        if answer.is_ok() {
            self.residents[index].q = to;
        }
        Some(answer)
    }

    /// The picture of the world with its robots and the dots of its places.
    pub fn picture(&self) -> Picture {
        // the places' names are drawn by `names`
        let dots = places(&self.world.places).into_iter().filter(|i| !matches!(i.drawing, Drawing::Label { .. }));
        let drawn = self.residents.iter().flat_map(|r| {
            robot(&RobotDrawing {
                name: &r.name,
                footprint: &r.robot.footprint(&r.q),
                heading: r.robot.heading(&r.q),
                model: Some(r.robot),
                gait: Gait::default(),
                in_contact: false,
            })
        });
        let others = self.others().flat_map(|(name, footprint)| {
            let (model, gait) = (None, Gait::default());
            robot(&RobotDrawing { name, footprint: &footprint, heading: None, model, gait, in_contact: false })
        });
        world(&self.world).with(dots).with(drawn).with(others)
    }
}
