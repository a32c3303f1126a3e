//! The robots that there are at tick 0, as residents of the run's worlds.

use std::collections::{BTreeMap, BTreeSet};

use bevy::prelude::*;

use super::lookup::thing_of;
use super::put_back::residence;
use super::robot_refusal::RobotRefusal;
use super::thing::RunThing;
use crate::simulation::robot::spawn::routes;
use crate::simulation::{RobotKinds, RobotName, Transport};
use crate::tour::{ConfigError, MAX_ROBOTS, RouteTours, TourConfig};
use motion_lab_core::worlds::{Resident, World as WorldModel, check_name};

/// A robot of the run that is about to be.
pub(super) struct FoundRobot {
    /// `None` where it must be spawned anew.
    pub(super) entity: Option<Entity>,
    pub(super) resident: Resident,
    /// The id that it had in the run so far.
    known: Option<usize>,
}

/// An entity that is not taken as the robot that it says it is.
pub(super) struct RefusedRobot {
    pub(super) entity: Entity,
    pub(super) name: String,
    pub(super) reason: RobotRefusal,
    /// Whether it stays in the run as it was.
    pub(super) stays: bool,
}

/// The robots that there are, and the entities that are not taken as they are.
#[derive(Default)]
pub(super) struct FoundRobots {
    /// By world, in the order of their ids to be: those of the run so far, then the others by their names.
    pub(super) worlds: Vec<Vec<FoundRobot>>,
    pub(super) refused: Vec<RefusedRobot>,
}

/// An entity with a model of a robot.
struct Candidate {
    entity: Entity,
    known: Option<usize>,
    name: String,
    /// The numbers of the types of its models.
    types: Vec<usize>,
}

/// The robots that there are. The worlds in `lost` were despawned: their robots are those of the configuration.
pub(super) fn find(world: &mut World, config: &TourConfig, lost: &BTreeSet<usize>) -> FoundRobots {
    let old: Vec<(usize, &Resident)> =
        config.worlds.iter().enumerate().flat_map(|(w, model)| model.robots.iter().map(move |r| (w, r))).collect();
    let mut found = FoundRobots { worlds: config.worlds.iter().map(|_| Vec::new()).collect(), refused: Vec::new() };
    let candidates = candidates(world, &old);
    let seed = world.resource::<Transport>().seed;
    let routes: Vec<Result<RouteTours, ConfigError>> = config.worlds.iter().map(|model| routes(model, seed)).collect();
    let mut names = Names::new(config);
    // which of several new ones with one name to take would depend on the order of entities
    let mut new: BTreeMap<&str, usize> = BTreeMap::new();
    candidates.iter().filter(|c| c.known.is_none()).for_each(|c| *new.entry(&c.name).or_default() += 1);
    names.twins = new.into_iter().filter(|(_, count)| *count > 1).map(|(name, _)| name.to_owned()).collect();
    for (id, (w, resident)) in old.iter().enumerate().filter(|(_, (w, _))| lost.contains(w)) {
        names.taken.insert(resident.name.clone());
        found.worlds[*w].push(FoundRobot { entity: None, resident: (*resident).clone(), known: Some(id) });
    }
    for candidate in candidates {
        let Candidate { entity, known, ref name, .. } = candidate;
        let before = known.and_then(|id| old.get(id)).copied();
        match residence(world, entity) {
            Some(w) => match accept(world, (config, &routes), &candidate, (w, before), &mut names) {
                Ok(resident) => found.worlds[w].push(FoundRobot { entity: Some(entity), resident, known }),
                Err(reason) => {
                    // what the run had stays in it as it was
                    let stays = before.filter(|(_, old)| names.taken.insert(old.name.clone()));
                    if let Some((w, resident)) = stays {
                        found.worlds[w].push(FoundRobot { entity: Some(entity), resident: resident.clone(), known });
                    }
                    let (name, stays) = (name.clone(), stays.is_some());
                    found.refused.push(RefusedRobot { entity, name, reason, stays });
                }
            },
            None => {
                let (name, reason) = (name.clone(), RobotRefusal::World);
                found.refused.push(RefusedRobot { entity, name, reason, stays: false });
            }
        }
    }
    for robots in &mut found.worlds {
        robots.sort_by(|a, b| {
            (a.known.is_none(), a.known, &a.resident.name).cmp(&(b.known.is_none(), b.known, &b.resident.name))
        });
    }
    found.keep_to(MAX_ROBOTS);
    found
}

impl FoundRobots {
    /// Leaves out the last of the new robots, as many as are too many.
    fn keep_to(&mut self, most: usize) {
        let number = self.worlds.iter().map(Vec::len).sum::<usize>();
        let mut left_out = number.saturating_sub(most);
        for robots in self.worlds.iter_mut().rev() {
            let new = robots.iter().filter(|robot| robot.known.is_none()).count();
            let out = robots.split_off(robots.len() - new.min(left_out));
            left_out -= out.len();
            self.refused.extend(out.into_iter().filter_map(|robot| {
                let reason = RobotRefusal::Spawn(ConfigError::Robots(number).into());
                Some(RefusedRobot { entity: robot.entity?, name: robot.resident.name, reason, stays: false })
            }));
        }
    }
}

/// The entities that say that they are robots: those of the run under the names that they had, those of the run under
/// other names, by their ids, then the others by their names.
fn candidates(world: &mut World, old: &[(usize, &Resident)]) -> Vec<Candidate> {
    let types = world.resource::<RobotKinds>().types().to_vec();
    let mut models: BTreeMap<Entity, Vec<usize>> = BTreeMap::new();
    for (number, kind) in types.iter().enumerate() {
        for entity in (kind.models)(world) {
            models.entry(entity).or_default().push(number);
        }
    }
    let candidate = |(entity, types): (Entity, Vec<usize>)| {
        let known = match thing_of(world, entity) {
            Some(RunThing::Robot(id)) => Some(id),
            _ => None,
        };
        let name = world.get::<RobotName>(entity).map_or_else(String::new, |name| name.name.clone());
        Candidate { entity, known, name, types }
    };
    let mut candidates: Vec<Candidate> = models.into_iter().map(candidate).collect();
    let is_renamed = |c: &Candidate| c.known.and_then(|id| old.get(id)).is_none_or(|(_, old)| old.name != c.name);
    candidates.sort_by(|a, b| {
        let key = |c: &Candidate| (c.known.is_none(), is_renamed(c), c.known);
        key(a).cmp(&key(b)).then_with(|| a.name.cmp(&b.name))
    });
    candidates
}

/// The names that a new robot may not have.
struct Names {
    /// Those of the robots taken so far.
    taken: BTreeSet<String>,
    /// Those that several new robots have.
    twins: BTreeSet<String>,
    /// Those of other things, by world.
    others: Vec<BTreeSet<String>>,
}

impl Names {
    fn new(config: &TourConfig) -> Self {
        let others = |world: &WorldModel| {
            let obstacles = world.obstacles.iter().map(|o| &o.name).chain(world.doors.iter().map(|d| &d.name));
            let names = obstacles.chain(world.places.iter().map(|p| &p.name));
            names.chain(world.marks.iter().map(|m| &m.name)).cloned().collect()
        };
        Names { taken: BTreeSet::new(), twins: BTreeSet::new(), others: config.worlds.iter().map(others).collect() }
    }

    fn take(&mut self, world: usize, name: &str) -> Result<(), RobotRefusal> {
        check_name(name).map_err(|_| RobotRefusal::Name)?;
        let is_other = self.others.get(world).is_some_and(|names| names.contains(name));
        if is_other || !self.taken.insert(name.to_owned()) { Err(RobotRefusal::NameTaken) } else { Ok(()) }
    }
}

/// The resident that an entity of a world is.
fn accept(
    world: &World,
    (config, routes): (&TourConfig, &[Result<RouteTours, ConfigError>]),
    candidate: &Candidate,
    (w, before): (usize, Option<(usize, &Resident)>),
    names: &mut Names,
) -> Result<Resident, RobotRefusal> {
    let Candidate { entity, name, types, .. } = candidate;
    let [of_type] = types[..] else { return Err(RobotRefusal::Models) };
    let kind = world.get::<RobotName>(*entity).ok_or(RobotRefusal::Name)?.kind.clone();
    let registered = world.resource::<RobotKinds>().kind(&kind).filter(|registered| registered.of_type == of_type);
    let registered = registered.ok_or(RobotRefusal::Kind(kind.clone()))?;
    let base = match before {
        // a route is one of its world
        Some((old_world, old)) => Resident {
            name: name.clone(),
            route: old.route.clone().filter(|_| old_world == w),
            sizes: old.sizes.clone().filter(|_| old.kind == kind),
            kind,
            ..old.clone()
        },
        None => Resident::new(name.clone(), kind, []),
    };
    let routes = routes[w].as_ref().map_err(|error| RobotRefusal::Spawn(error.clone().into()))?;
    if before.is_none() && names.twins.contains(name) {
        return Err(RobotRefusal::NameTaken);
    }
    let resident = (registered.describe)(world, *entity, base, (&config.worlds[w], routes))?;
    names.take(w, name)?;
    Ok(resident)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_too_many_robots_the_last_new_ones_are_left_out() {
        let robot = |name: &str, known| FoundRobot {
            entity: Some(Entity::PLACEHOLDER),
            resident: Resident::new(name, "rusty", []),
            known,
        };
        let worlds = vec![
            vec![robot("a", Some(0)), robot("new", None)],
            vec![robot("b", Some(1)), robot("x", None), robot("y", None)],
            vec![robot("c", Some(2))],
        ];
        let mut found = FoundRobots { worlds, refused: Vec::new() };
        found.keep_to(4);
        let names = |robots: &Vec<FoundRobot>| robots.iter().map(|r| r.resident.name.clone()).collect::<Vec<_>>();
        assert_eq!(found.worlds.iter().map(names).collect::<Vec<_>>(), [vec!["a", "new"], vec!["b"], vec!["c"]]);
        let refused: Vec<(&str, String)> =
            found.refused.iter().map(|r| (r.name.as_str(), r.reason.to_string())).collect();
        let reason = "6 robots: at most 100000".to_owned();
        assert_eq!(refused, [("x", reason.clone()), ("y", reason)]);
        found.keep_to(4);
        assert_eq!(found.refused.len(), 2);
    }
}
