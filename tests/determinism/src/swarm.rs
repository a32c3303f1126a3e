//! The generated runs.

use std::f64::consts::TAU;

use motion_lab_core::configuration::{ArmSizes, CarSizes, DiscSizes, RobotKind, Sizes};
use motion_lab_core::geometry::Pose2;
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::sensors::{FanSensor, RangeSensor};
use motion_lab_core::worlds::{BeamModel, Resident, ResidentSensor, Warehouse, World};
use motion_lab_sim::run::Recipe;
use motion_lab_sim::tour::TourConfig;

use crate::feature::Feature;
use crate::inputs::script;

/// The run of a seed, with the features that the seed has.
pub fn recipe(seed: Seed) -> Recipe {
    let on = Feature::of_seed(seed);
    let mut draws = Stream::new(seed, "determinism/run");
    let mut worlds = worlds(seed, &on, &mut draws);
    for world in &mut worlds {
        furnish(world, &on, &mut draws);
    }
    let ticks = 100 + draws.below(101);
    let sensor = RangeSensor { n_rays: 4 + draws.below(60) as u32, max_range: draws.uniform(1.0, 8.0) };
    let script = script(&worlds, &on, ticks, &mut draws);
    let sensor = on.contains(&Feature::RunSensor).then_some(sensor);
    Recipe::new(TourConfig { worlds, ticks, sensor }, (seed, script))
}

/// Some of the built-in worlds, at least one; the one with doors where doors are on, and a warehouse where routes are.
fn worlds(seed: Seed, on: &[Feature], draws: &mut Stream) -> Vec<World> {
    let names: Vec<&str> = World::built_in_names().into_iter().filter(|_| draws.below(2) == 0).collect();
    let mut worlds: Vec<World> = names.into_iter().filter_map(World::built_in).collect();
    if worlds.is_empty() || (on.contains(&Feature::Doors) && worlds.iter().all(|world| world.doors.is_empty())) {
        worlds.insert(0, World::apartment());
    }
    if on.contains(&Feature::Routes) {
        let warehouse = Warehouse { seed, robots: 10, trailers: on.contains(&Feature::Trailers) };
        worlds.extend(warehouse.world());
    }
    worlds
}

/// Gives a world more robots, and its robots sizes and sensors, as far as these are on.
fn furnish(world: &mut World, on: &[Feature], draws: &mut Stream) {
    if on.contains(&Feature::Crowd) {
        let more = 3 + draws.below(5);
        (0..more).for_each(|k| add_robot(world, k, draws));
    }
    let plain = world.robots.clone();
    for (i, robot) in plain.into_iter().enumerate() {
        let sized = sized(robot.clone(), on, draws);
        if world.check_resident(&sized).is_ok() {
            world.robots[i] = sized;
        }
        sense(&mut world.robots[i], on, draws);
    }
}

/// Adds a rover or a car anywhere. A start in contact is a start too.
fn add_robot(world: &mut World, k: u64, draws: &mut Stream) {
    let (min, max) = (world.bounds.min, world.bounds.max);
    let (x, y) = (draws.uniform(min.x, max.x), draws.uniform(min.y, max.y));
    let theta = draws.uniform(-3.0, 3.0);
    let (kind, start) = match draws.below(3) {
        0 => (RobotKind::HITCH, vec![x, y, theta]),
        _ => (RobotKind::RUSTY, vec![x, y, theta]),
    };
    let robot = Resident::new(format!("{} {}", world.name, k + 1), kind.name, start);
    if world.check_resident(&robot).is_ok() {
        world.robots.push(robot);
    }
}

/// The robot with sizes of its own.
fn sized(mut robot: Resident, on: &[Feature], draws: &mut Stream) -> Resident {
    let mut sizes = robot.sizes.clone().or_else(|| Sizes::of_kind(&robot.kind));
    let mut factor = |is_on: bool| if is_on { draws.uniform(0.7, 1.2) } else { 1.0 };
    let is_on = on.contains(&Feature::Sizes);
    match &mut sizes {
        Some(Sizes::Disc(DiscSizes { radius, .. })) => *radius *= factor(is_on),
        Some(Sizes::Arm(ArmSizes { lengths, .. })) => lengths.iter_mut().for_each(|length| *length *= factor(is_on)),
        Some(Sizes::Car(CarSizes { max_steer, trailer, .. })) => {
            *max_steer *= factor(is_on);
            trailer.hitch_len *= factor(is_on);
            if on.contains(&Feature::Jackknife) {
                trailer.jackknife = Some(factor(true));
            }
        }
        None => {}
    }
    let is_changed = is_on || on.contains(&Feature::Jackknife);
    robot.sizes = sizes.filter(|sizes| is_changed && sizes.check_for(&robot.kind).is_ok()).or(robot.sizes);
    robot
}

/// Gives a robot sensors and noise.
fn sense(robot: &mut Resident, on: &[Feature], draws: &mut Stream) {
    let model = BeamModel {
        sigma_hit: draws.uniform(0.0, 0.1),
        z_short: 0.1,
        lambda_short: 0.8,
        z_miss: 0.05,
        z_max: 0.05,
        z_rand: 0.05,
    };
    let noise = on.contains(&Feature::Noise).then_some(model);
    if RobotKind::of(&robot.kind).is_some_and(|kind| kind.senses) {
        robot.sensor = noise;
    }
    if on.contains(&Feature::OwnSensors) && draws.below(2) == 0 {
        let rays = RangeSensor { n_rays: 1 + draws.below(20) as u32, max_range: draws.uniform(0.5, 6.0) };
        let field_of_view = if draws.below(2) == 0 { TAU } else { draws.uniform(0.1, 6.0) };
        let mount = Pose2::new(draws.uniform(-0.3, 0.3), draws.uniform(-0.3, 0.3), draws.uniform(-3.0, 3.0));
        let rays = FanSensor { sensor: rays, field_of_view };
        robot.sensors.push(ResidentSensor { name: "own".into(), rays, mount, noise });
    }
}
