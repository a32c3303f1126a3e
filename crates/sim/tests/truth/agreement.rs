//! Whether every entity's components say what the run's configuration and frame say.

use std::collections::BTreeMap;

use bevy::ecs::relationship::Relationship;
use bevy::prelude::{Entity, RelationshipTarget, With, World as Ecs};
use motion_lab_core::configuration::Configuration as _;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{AnyRobot, Hitch, Reach, Rusty};
use motion_lab_core::worlds::{Obstacle, Resident};
use motion_lab_sim::run::RobotState;
use motion_lab_sim::simulation::{
    Configuration, Contacts, Control, Cut, Door, DrawnTour, DriveMode, LatestFrame, MountedOn, ObstacleOf,
    ObstacleShape, Obstacles, OwnState, Placement, PreviousConfiguration, Residents, ResidesIn, RobotId, RobotModel,
    RobotName, Roster, RunConfig, Scan, SensorModel, SensorMount, SensorName, SensorNoise, SensorRoster, Sensors,
    SimulatedRobot, SimulatedWorld, Slip, StandingWorld, TickMotion, Transport, WorldScene, recipe,
};

/// Fails unless the entities of the run are those of its configuration, with the components that configuration and
/// frame say.
#[track_caller]
pub(crate) fn assert_agrees(world: &mut Ecs) {
    let config = world.resource::<RunConfig>().config().clone();
    let frame = world.resource::<LatestFrame>().frame().clone();
    let transport = world.resource::<Transport>();
    assert_eq!(transport.tick(), frame.tick);
    assert!(transport.frontier() >= transport.tick());
    let worlds = world.resource::<Roster>().worlds().to_vec();
    let robots = world.resource::<Roster>().robots().to_vec();
    let residents: Vec<(usize, &Resident)> =
        config.worlds.iter().enumerate().flat_map(|(w, m)| m.robots.iter().map(move |r| (w, r))).collect();
    assert_eq!((robots.len(), frame.robots.len()), (residents.len(), residents.len()));
    for (id, ((w, resident), state)) in residents.iter().zip(&frame.robots).enumerate() {
        let at = (id as u32, worlds[*w]);
        match resident.kind.as_str() {
            "rusty" => robot::<Rusty>(world, robots[id], at, resident, state),
            "reach" => robot::<Reach<2>>(world, robots[id], at, resident, state),
            "reach3" => robot::<Reach<3>>(world, robots[id], at, resident, state),
            "hitch" => robot::<Hitch>(world, robots[id], at, resident, state),
            kind => panic!("{kind}"),
        }
    }
    let mut models = 0;
    models += world.query_filtered::<&ResidesIn, With<RobotModel<Rusty>>>().iter(world).count();
    models += world.query_filtered::<&ResidesIn, With<RobotModel<Reach<2>>>>().iter(world).count();
    models += world.query_filtered::<&ResidesIn, With<RobotModel<Reach<3>>>>().iter(world).count();
    models += world.query_filtered::<&ResidesIn, With<RobotModel<Hitch>>>().iter(world).count();
    assert_eq!(models, residents.len(), "robots beside the run's");
    for (w, (&entity, model)) in worlds.iter().zip(&config.worlds).enumerate() {
        let simulated = world.get::<SimulatedWorld>(entity).unwrap();
        assert_eq!((simulated.index as usize, &*simulated.model), (w, model));
        obstacles(world, w, entity);
    }
    sensors(world, &robots, &residents);
    for &entity in &worlds {
        lists::<Obstacles>(world, entity);
        lists::<Residents>(world, entity);
    }
    robots.iter().for_each(|&robot| lists::<Sensors>(world, robot));
}

/// Checks that an entity lists those that say that they belong to it, each once.
#[track_caller]
fn lists<T: RelationshipTarget>(world: &mut Ecs, entity: Entity) {
    let mut listed: Vec<Entity> = world.get::<T>(entity).into_iter().flat_map(RelationshipTarget::iter).collect();
    let mut all = world.query::<(Entity, &T::Relationship)>();
    let mut belonging: Vec<Entity> =
        all.iter(world).filter(|(_, of)| of.get() == entity).map(|(entity, _)| entity).collect();
    // what an observer despawns at once is listed after that
    listed.retain(|entity| world.get_entity(*entity).is_ok());
    listed.sort_unstable();
    belonging.sort_unstable();
    assert_eq!(listed, belonging, "{}", std::any::type_name::<T>());
}

/// Checks a robot.
#[track_caller]
fn robot<R: SimulatedRobot>(
    world: &Ecs,
    e: Entity,
    (id, home): (u32, Entity),
    resident: &Resident,
    state: &RobotState,
) {
    let get = world.entity(e);
    let name = get.get::<RobotName>().unwrap();
    assert_eq!((&name.name, &name.kind), (&resident.name, &resident.kind));
    assert_eq!((get.get::<RobotId>().unwrap().0, get.get::<ResidesIn>().unwrap().0), (id, home));
    let (model, _) = AnyRobot::sized(&resident.kind, &resident.start, resident.sizes.as_ref()).unwrap();
    let q = get.get::<Configuration<R>>().unwrap().0;
    let has = |robot: AnyRobot| match robot {
        AnyRobot::Hitch(car) => AnyRobot::Hitch(car.with_trailer()),
        robot => robot,
    };
    assert_eq!(get.get::<RobotModel<R>>().unwrap().0.lab_model().map(has), Some(has(model)), "{}", resident.name);
    let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&q.coordinates()), bits(&state.configuration), "{}", resident.name);
    let contacts = get.get::<Contacts<R>>().unwrap();
    assert_eq!(
        (contacts.in_contact(), contacts.episodes(), contacts.flash()),
        (state.in_contact, state.contacts, state.flash)
    );
    let mode = get.get::<DriveMode<R>>().unwrap();
    let target = mode.target.map_or_else(Vec::new, |target| target.coordinates().to_vec());
    assert_eq!(
        (mode.manual, mode.channels, &target[..], mode.refusals),
        (state.manual, state.channels, &state.target[..], state.refusals)
    );
    assert_eq!(bits(get.get::<OwnState<R>>().unwrap().extra()), bits(&state.extra));
    for there in [
        get.contains::<DrawnTour<R>>(),
        get.contains::<Slip>(),
        get.contains::<Control<R>>(),
        get.contains::<PreviousConfiguration<R>>(),
        get.contains::<TickMotion<R>>(),
        get.contains::<Cut<R>>(),
    ] {
        assert!(there, "{} lacks a component", resident.name);
    }
}

/// Checks the obstacles of a world.
#[track_caller]
fn obstacles(world: &mut Ecs, w: usize, entity: Entity) {
    let recipe = recipe(world).unwrap();
    let (model, frame) = (&recipe.config.worlds[w], world.resource::<LatestFrame>().frame().clone());
    let added = recipe.script.changes.iter().filter(|c| c.world == model.name).filter_map(|c| c.change.added());
    let added: Vec<Obstacle> = added.map(Result::unwrap).collect();
    let there = |present| Placement { present, ..Placement::default() };
    let solid = model.obstacles.iter().map(|o| (o.clone(), false, there(true)));
    let doors = model.doors.iter().map(|d| (d.leaf(), true, there(!d.open)));
    let added = added.into_iter().map(|o| (o, false, there(false)));
    let mut expected: Vec<(Obstacle, bool, Placement)> = solid.chain(doors).chain(added).collect();
    for state in frame.obstacles.iter().filter(|state| state.world as usize == w) {
        expected[state.obstacle as usize].2 = Placement { present: state.present, pose: state.pose };
    }
    let mut found: BTreeMap<String, (ObstacleShape, bool, Placement)> = BTreeMap::new();
    let mut all = world.query::<(&ObstacleShape, &ObstacleOf, &Placement, Option<&Door>)>();
    for (shape, of, placement, door) in all.iter(world).filter(|(_, of, placement, door)| {
        // what was taken away at tick 0 may come back there
        of.0 == entity && (frame.tick > 0 || placement.present || door.is_some())
    }) {
        let twin = found.insert(shape.name.clone(), (shape.clone(), door.is_some(), *placement));
        assert!(twin.is_none(), "{}: two in {of:?}", shape.name);
    }
    for (obstacle, is_door, placement) in &expected {
        if frame.tick == 0 && !placement.present && !is_door {
            continue;
        }
        let (shape, door, at) = found.remove(&obstacle.name).unwrap_or_else(|| panic!("{} is gone", obstacle.name));
        assert_eq!((&shape.pieces, shape.kind), (&obstacle.pieces, obstacle.kind), "{}", obstacle.name);
        assert_eq!((door, at), (*is_door, *placement), "{}", obstacle.name);
    }
    assert!(found.is_empty() || frame.tick == 0, "beside the run's: {found:?}");
    // the scene is that of the standing world
    let standing = &world.get::<StandingWorld>(entity).unwrap().0;
    let there = expected.iter().filter(|(_, is_door, placement)| placement.present && !is_door);
    let moved: Vec<Obstacle> = there.map(|(obstacle, _, placement)| at(obstacle, &placement.pose)).collect();
    assert_eq!(standing.obstacles, moved);
    let closed = expected.iter().filter(|(_, is_door, _)| *is_door).map(|(_, _, placement)| placement.present);
    assert!(standing.doors.iter().map(|door| !door.open).eq(closed));
    let scene = &world.get::<WorldScene>(entity).unwrap().0;
    let made = motion_lab_core::collision::Scene::of_world(standing);
    let probe = Footprint::disc(Point2::new(0.3, 0.4), 0.05);
    assert_eq!(scene.distance(&probe).to_bits(), made.distance(&probe).to_bits());
}

/// An obstacle after a rigid motion.
fn at(obstacle: &Obstacle, pose: &Pose2) -> Obstacle {
    if *pose == Pose2::IDENTITY {
        return obstacle.clone();
    }
    let pieces = obstacle.pieces.iter().map(|(frame, shape)| (pose.compose(frame), shape.clone())).collect();
    Obstacle::new(&obstacle.name, obstacle.kind, pieces)
}

/// Checks the sensors that the run has.
#[track_caller]
fn sensors(world: &Ecs, robots: &[Entity], residents: &[(usize, &Resident)]) {
    let config = world.resource::<RunConfig>().config();
    let scans = &world.resource::<LatestFrame>().frame().scans;
    let entities: Vec<Entity> = world.resource::<SensorRoster>().entities().collect();
    let mut expected = Vec::new();
    for (id, (_, resident)) in residents.iter().enumerate() {
        if resident.kind == "rusty"
            && let Some(own) = config.sensor
        {
            expected.push((id, String::new(), SensorModel::from(own), Pose2::IDENTITY, resident.sensor));
        }
        let mut named: Vec<_> = resident.sensors.iter().collect();
        named.sort_by(|a, b| a.name.cmp(&b.name));
        expected.extend(named.iter().map(|s| (id, s.name.clone(), SensorModel(s.rays), s.mount, s.noise)));
    }
    assert_eq!((entities.len(), scans.len()), (expected.len(), expected.len()));
    for ((&entity, scan), (id, name, model, mount, noise)) in entities.iter().zip(scans).zip(expected) {
        let get = world.entity(entity);
        assert_eq!(get.get::<MountedOn>().unwrap().0, robots[id], "{name:?}");
        assert_eq!((&get.get::<SensorName>().unwrap().0, get.get::<SensorModel>()), (&name, Some(&model)));
        assert_eq!(get.get::<SensorMount>().unwrap().0, mount);
        assert_eq!(get.get::<SensorNoise>().map(|noise| noise.0), noise);
        assert_eq!((scan.robot as usize, get.get::<Scan>().unwrap().ranges()), (id, &scan.ranges));
    }
}
