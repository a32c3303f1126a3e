//! Last chances by hand.

use std::sync::Arc;

use bevy::app::App;
use motion_lab_core::geometry::{Aabb, Shape};
use motion_lab_core::num::{greater, hypot, lesser, sin_cos};
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{ChartLine, ConfigurationError, PartRates, Rates};
use motion_lab_core::worlds::{Obstacle, ObstacleKind, Resident, World};
use motion_lab_sim::avoid::{
    AddKinds, AvoidError, ContactPartner, Evasion, EvasionMeans, EvasionSet, EvasionSpeeds, Explaining, LastChance,
    NoEvasion, contact_episodes, contact_episodes_with, explain,
};
use motion_lab_sim::recording::Recorder;
use motion_lab_sim::run::{Event, Recipe, RobotInput, Script, WorldChange, WorldEvent};
use motion_lab_sim::simulation::{Extra, RobotPlugin, SimulatedRobot};
use motion_lab_sim::tour::TourConfig;

use crate::simulator::{event, quantized};

/// A field with a long wall at x = 3 whose face is at x = 2.95, and these residents.
fn field(robots: &[(&str, &str, &[f64])]) -> World {
    let bounds = Aabb { min: Point2::new(-10.0, -10.0), max: Point2::new(10.0, 10.0) };
    let mut world = World::empty("field", bounds);
    world.obstacles.push(wall("wall", 3.0));
    world.robots.extend(robots.iter().map(|(name, kind, start)| Resident::new(*name, *kind, start.to_vec())));
    world
}

fn wall(name: &str, x: f64) -> Obstacle {
    let shape = Shape::try_rounded(&[Point2::new(x, -8.0), Point2::new(x, 8.0)], 0.05).unwrap();
    Obstacle::new(name, ObstacleKind::Solid, vec![(Pose2::IDENTITY, shape)])
}

fn recipe(world: World, ticks: u64, events: Vec<Event>, changes: Vec<WorldEvent>) -> Recipe {
    Recipe::new(TourConfig { worlds: vec![world], ticks, sensor: None }, (Seed(3), Script::new(events, changes)))
}

fn chance(chance: &LastChance) -> &Evasion {
    chance.evasion().unwrap_or_else(|| panic!("no way out: {chance:?}"))
}

#[test]
fn a_rover_steers_away_while_its_circle_fits_and_stops_in_the_last_tick() {
    let world = field(&[("rover", "rusty", &[0.0, 0.0, 0.0])]);
    let recipe = recipe(world, 200, vec![event(1, "rover", RobotInput::Drive(128, 0))], vec![]);
    let episodes = contact_episodes(&recipe, |_| true).unwrap();
    let [episode] = &episodes[..] else { panic!("{episodes:?}") };
    assert_eq!((episode.number, episode.ended), (1, None));
    assert_eq!(episode.with, ContactPartner::Obstacle("wall".into()));
    // at most 0.03 m a tick, less and more by slip, over 2.95 m less the radius
    let gap = 2.95 - RUSTY_RADIUS;
    let ticks = gap / 0.03;
    assert!((episode.first as f64 - ticks).abs() < 0.05 * ticks, "{} of about {ticks}", episode.first);

    let why = explain(&recipe, episode, &EvasionSet::default()).unwrap();
    assert_eq!(chance(&why.stopping).tick, episode.first);
    assert!(!chance(&why.stopping).is_still_met);
    assert_eq!(chance(&why.stopping).means, EvasionMeans::Channels(vec![(episode.first, [0, 0])]));
    // the fastest turn is a circle of v / omega = 0.6 / 2.5 = 0.24 m: so far ahead it comes
    let last = chance(&why.going_on);
    let mut run = Recorder::of(&recipe).unwrap();
    let mut left = |tick| gap - run.seek(tick).unwrap().robots[0].configuration[0];
    let (with_it, too_late) = (left(last.tick - 1), left(last.tick));
    assert!(with_it > 0.24 * 0.9 && too_late < 0.24 * 1.1, "{with_it} m were enough, {too_late} m are not");
    assert!(with_it > too_late);
    let EvasionMeans::Channels(channels) = &last.means else { panic!("{last:?}") };
    assert_eq!(channels[0].1[0], 128, "it keeps its speed");
    assert_eq!(last.free_until, episode.first + 40);
    // and there it stops, so that the way out ends in no other contact
    assert_eq!(last.script.events.last(), Some(&event(last.free_until + 1, "rover", RobotInput::Drive(0, 0))));
}

/// The radius of the lab's rover, metres.
const RUSTY_RADIUS: f64 = motion_lab_core::robots::RUSTY.body_radius;

#[test]
fn a_touring_robot_s_speed_is_measured_and_kept() {
    // the tour of the Apartment's rover, cut off by a wall that is put before it
    let world = World::apartment();
    let start = &world.robots[0].start;
    let mut run = Recorder::new(TourConfig { worlds: vec![world.clone()], ticks: 60, sensor: None }, Seed(3)).unwrap();
    let at = |run: &mut Recorder, tick| run.seek(tick).unwrap().robots[0].configuration.clone();
    let (a, b) = (at(&mut run, 39), at(&mut run, 40));
    let speed = hypot(b[0] - a[0], b[1] - a[1]) / 0.05;
    let (s, c) = sin_cos(b[2]);
    let ahead = RUSTY_RADIUS + 0.06;
    let point = (b[0] + ahead * c, b[1] + ahead * s);
    let quantum = |x: f64| quantized(&[x])[0];
    let change = WorldChange::Add {
        name: "bollard".into(),
        points: vec![(quantum(point.0), quantum(point.1))],
        radius: quantum(0.05),
    };
    let changes = vec![WorldEvent { tick: 40, world: world.name.clone(), change }];
    let recipe = recipe(world.clone(), 80, vec![], changes);
    let episodes = contact_episodes(&recipe, |_| true).unwrap();
    let episode = episodes.first().unwrap_or_else(|| panic!("from {start:?} at {speed} m/s"));
    assert_eq!(episode.with, ContactPartner::Obstacle("bollard".into()));
    let why = explain(&recipe, episode, &EvasionSet { horizon: 5, ..EvasionSet::default() }).unwrap();
    match &why.going_on {
        LastChance::At(evasion) => {
            let EvasionMeans::Channels(channels) = &evasion.means else { panic!() };
            let kept = f64::from(channels[0].1[0]) / 128.0 * 0.6;
            assert!((kept - speed).abs() < 0.05 * speed + 0.6 / 128.0, "{kept} m/s kept of {speed}");
        }
        none => panic!("{none:?}"),
    }
}

#[test]
fn what_is_changed_in_the_world_is_there_in_every_branch() {
    // the wall at 3 is behind one at 1.6 that is put there at tick 20
    let world = field(&[("rover", "rusty", &[0.0, 0.0, 0.0])]);
    let points = quantized(&[1.6, -8.0, 1.6, 8.0]);
    let added = WorldChange::Add {
        name: "new".into(),
        points: vec![(points[0], points[1]), (points[2], points[3])],
        radius: quantized(&[0.05])[0],
    };
    let changes = vec![WorldEvent { tick: 20, world: "field".into(), change: added }];
    let recipe = recipe(world, 100, vec![event(1, "rover", RobotInput::Drive(128, 0))], changes);
    let episode = &contact_episodes(&recipe, |_| true).unwrap()[0];
    assert_eq!(episode.with, ContactPartner::Obstacle("new".into()));
    let why = explain(&recipe, episode, &EvasionSet::default()).unwrap();
    let last = chance(&why.going_on).tick;
    let mut run = Recorder::of(&recipe).unwrap();
    let left = 1.55 - RUSTY_RADIUS - run.seek(last - 1).unwrap().robots[0].configuration[0];
    assert!((0.24 * 0.9..0.24 * 1.1 + 0.0315).contains(&left), "{left} m");
}

#[test]
fn a_robot_that_stood_has_no_speed_to_keep_and_too_late_says_how_far_it_looked() {
    let world = field(&[("rover", "rusty", &[2.95 - RUSTY_RADIUS - 0.02, 0.0, 0.0])]);
    let driven = vec![event(1, "rover", RobotInput::Drive(0, 0)), event(5, "rover", RobotInput::Drive(100, 0))];
    let recipe = recipe(world, 20, driven, vec![]);
    assert!(contact_episodes(&recipe, |_| false).unwrap().is_empty());
    let episode = &contact_episodes(&recipe, |_| true).unwrap()[0];
    assert_eq!(episode.first, 5);
    let speeds = EvasionSpeeds::Channels(vec![128]);
    let set = EvasionSet { speeds, turns: vec![0], switches: 0, back: 3, ..EvasionSet::default() };
    let why = explain(&recipe, episode, &set).unwrap();
    let LastChance::None(NoEvasion::TooLate(extent)) = &why.going_on else { panic!("{:?}", why.going_on) };
    assert_eq!((extent.earliest, extent.branches), (2, 4), "straight on from each of the ticks 5 to 2");
    let none = contact_episodes(&recipe, |_| true).unwrap()[0].clone();
    let other = motion_lab_sim::avoid::ContactEpisode { first: 4, ..none };
    assert!(matches!(explain(&recipe, &other, &set), Err(AvoidError::NoContact { tick: 4, .. })));
    let mut whole = Explaining::new(&recipe, ("rover", 5), &set).unwrap();
    while whole.step().unwrap().is_none() {}
    assert!(whole.ticks() > 20 && whole.step() == Err(AvoidError::Over));
    assert!(matches!(Explaining::new(&recipe, ("nobody", 5), &set), Err(AvoidError::NoContact { .. })));
}

#[test]
fn another_robot_is_named_and_goes_on_as_it_would() {
    let robots: [(&str, &str, &[f64]); 2] =
        [("a", "rusty", &[0.0, 0.0, 0.0]), ("b", "rusty", &[1.5, 0.0, std::f64::consts::PI])];
    let events = vec![event(1, "a", RobotInput::Drive(128, 0)), event(1, "b", RobotInput::Drive(128, 0))];
    let recipe = recipe(field(&robots), 60, events, vec![]);
    let episodes = contact_episodes(&recipe, |robot| robot == "b").unwrap();
    assert_eq!(episodes[0].with, ContactPartner::Robot("a".into()));
    let why = explain(&recipe, &episodes[0], &EvasionSet::default()).unwrap();
    let stop = chance(&why.stopping);
    assert_eq!(stop.tick, episodes[0].first, "whoever stands meets nobody");
    assert!(stop.is_still_met, "and the other one drives into it");
    let last = chance(&why.going_on);
    // a still drives: its own events are in the script of the way out
    assert!(last.script.events.iter().any(|event| event.robot == "a"));
    // they close at 1.2 m/s, and b has to be out of a's way by both radii
    assert!(last.tick < stop.tick);
}

#[test]
fn what_others_are_told_meanwhile_they_do_in_every_branch() {
    // a stands until b, which comes along slowly, is so near that it is too late for b when a begins to drive
    let robots: [(&str, &str, &[f64]); 2] =
        [("a", "rusty", &[0.0, 0.0, 0.0]), ("b", "rusty", &[1.5, 0.0, std::f64::consts::PI])];
    let events = vec![event(1, "b", RobotInput::Drive(64, 0)), event(72, "a", RobotInput::Drive(128, 0))];
    let recipe = recipe(field(&robots), 100, events, vec![]);
    let episode = &contact_episodes(&recipe, |robot| robot == "b").unwrap()[0];
    assert!((73..80).contains(&episode.first), "{}", episode.first);
    // a way out that counts on a to stand is none, and the whole run would say so
    let why = explain(&recipe, episode, &EvasionSet::default()).unwrap();
    let last = chance(&why.going_on);
    assert!(last.tick < 72, "{}", last.tick);
    let mut run = Recorder::of(&Recipe { script: last.script.clone(), ..recipe.clone() }).unwrap();
    let contacts = |run: &mut Recorder, tick| run.seek(tick).unwrap().robots[1].contacts;
    assert_eq!(contacts(&mut run, last.free_until), 0);
}

#[test]
fn a_car_that_backs_up_keeps_its_speed_backward() {
    let recipe = Recipe::new(TourConfig { ticks: 200, ..TourConfig::default() }, Seed(2005));
    let episode = &contact_episodes(&recipe, |robot| robot == "Hitch").unwrap()[0];
    let mut run = Recorder::of(&recipe).unwrap();
    let mut at = |tick| run.seek(tick).unwrap().robots[2].configuration.clone();
    let (a, b) = (at(episode.first - 2), at(episode.first - 1));
    let (s, c) = sin_cos(b[2]);
    let speed = ((b[0] - a[0]) * c + (b[1] - a[1]) * s) / 0.05;
    let why = explain(&recipe, episode, &EvasionSet::default()).unwrap();
    let EvasionMeans::Channels(channels) = &chance(&why.going_on).means else { panic!() };
    let kept = f64::from(channels[0].1[0]) / 128.0 * motion_lab_core::robots::HITCH.max_speed;
    assert!(speed < 0.0 && (kept - speed).abs() < 0.02, "{kept} m/s kept of {speed}");
}

#[test]
fn a_speed_is_measured_right_where_the_greatest_would_hit_too() {
    // the tour drives at half its speed, and so near to a curb a tick at full speed is cut short
    let mut forward = 0;
    for seed in 1..9 {
        let config = TourConfig { worlds: vec![World::lot()], ticks: 600, sensor: None };
        let recipe = Recipe::new(config, Seed(seed));
        for episode in contact_episodes(&recipe, |_| true).unwrap() {
            let why =
                explain(&recipe, &episode, &EvasionSet { back: 4, switches: 0, ..EvasionSet::default() }).unwrap();
            let LastChance::At(evasion) = &why.going_on else { continue };
            let EvasionMeans::Channels(channels) = &evasion.means else { panic!() };
            assert_eq!(channels[0].1[0].abs(), 64, "seed {seed}, {episode:?}");
            forward += u32::from(channels[0].1[0] > 0);
        }
    }
    assert!(forward >= 2, "{forward} forward");
}

#[test]
fn a_way_out_that_stands_in_a_door_is_said_to() {
    // a wall is put across the field right before the rover, which is too near to stop for; further on it stands in its
    // way, and the wall is not put there
    let world = field(&[("rover", "rusty", &[0.0, 0.0, 0.0])]);
    let points = quantized(&[1.0, -8.0, 1.0, 8.0]);
    let added = WorldChange::Add {
        name: "new".into(),
        points: vec![(points[0], points[1]), (points[2], points[3])],
        radius: quantized(&[0.05])[0],
    };
    let changes = vec![WorldEvent { tick: 40, world: "field".into(), change: added }];
    let recipe = recipe(world, 80, vec![event(1, "rover", RobotInput::Drive(64, 0))], changes);
    let episode = &contact_episodes(&recipe, |_| true).unwrap()[0];
    assert_eq!(episode.with, ContactPartner::Obstacle("new".into()));
    let fast =
        EvasionSet { speeds: EvasionSpeeds::Channels(vec![128]), turns: vec![0], switches: 0, ..Default::default() };
    let why = explain(&recipe, episode, &EvasionSet { horizon: 10, ..fast.clone() }).unwrap();
    assert!(chance(&why.going_on).is_in_the_way, "{:?}", chance(&why.going_on));
    assert!(!chance(&why.stopping).is_in_the_way);
}

#[test]
fn a_way_round_that_the_world_blocks_meanwhile_is_none() {
    let recipe = Recipe::new(TourConfig { ticks: 400, ..TourConfig::default() }, Seed(2005));
    let episode = &contact_episodes(&recipe, |robot| robot == "Reach").unwrap()[0];
    let why = explain(&recipe, episode, &EvasionSet::default()).unwrap();
    let round = chance(&why.going_on);
    // a bead is put where the tip will be halfway, when the arm is on its way
    let EvasionMeans::Path { arrives, .. } = round.means else { panic!("{round:?}") };
    let halfway = (round.tick + arrives) / 2;
    let mut run = Recorder::of(&Recipe { script: round.script.clone(), ..recipe.clone() }).unwrap();
    run.seek(halfway).unwrap();
    let tip = run.view()[1].tip.unwrap();
    let bead = WorldChange::Add {
        name: "bead".into(),
        points: vec![(quantized(&[tip.x])[0], quantized(&[tip.y])[0])],
        radius: quantized(&[0.02])[0],
    };
    let changes = vec![WorldEvent { tick: halfway - 2, world: "Workbench".into(), change: bead }];
    let blocked = Recipe { script: Script::new(vec![], changes), ..recipe };
    let episodes = contact_episodes(&blocked, |robot| robot == "Reach").unwrap();
    assert_eq!(episodes[0].first, episode.first);
    let why = explain(&blocked, &episodes[0], &EvasionSet::default()).unwrap();
    match &why.going_on {
        LastChance::At(other) => {
            assert_ne!(other.script.events, round.script.events);
            let mut run = Recorder::of(&Recipe { script: other.script.clone(), ..blocked }).unwrap();
            while run.frame().tick < other.free_until {
                let touches = run.step().robots[1].in_contact;
                assert!(run.frame().tick < other.tick || !touches, "tick {}", run.frame().tick);
            }
        }
        LastChance::None(why) => {
            assert_eq!(*why, NoEvasion::NoPath("the world changes while the path is played".into()));
        }
    }
}

#[test]
fn an_arm_stays_or_goes_round_the_post() {
    let recipe = Recipe::new(TourConfig { ticks: 400, ..TourConfig::default() }, Seed(2005));
    let episodes = contact_episodes(&recipe, |robot| robot == "Reach").unwrap();
    let episode = episodes.iter().find(|episode| episode.ended.is_some()).unwrap();
    assert_eq!(
        (episode.with.clone(), episode.world.as_str()),
        (ContactPartner::Obstacle("the post".into()), "Workbench")
    );
    let why = explain(&recipe, episode, &EvasionSet::default()).unwrap();
    assert_eq!(chance(&why.stopping).means, EvasionMeans::Standing);
    let round = chance(&why.going_on);
    let EvasionMeans::Path { length, arrives } = round.means else { panic!("{round:?}") };
    assert_eq!(round.tick, episode.first, "the arm stops within a tick, so it can go round from the contact's own");
    assert!(length > 0.0 && arrives >= round.tick);
    // it arrives where the run left the contact
    let mut as_it_was = Recorder::of(&recipe).unwrap();
    let mut with_way = Recorder::of(&Recipe { script: round.script.clone(), ..recipe.clone() }).unwrap();
    let goal = as_it_was.seek(episode.ended.unwrap()).unwrap().robots[1].configuration.clone();
    let there = with_way.seek(arrives).unwrap().robots[1].configuration.clone();
    for (a, b) in goal.iter().zip(&there) {
        assert!((a - b).abs() < 1e-5, "{there:?} is not {goal:?}");
    }
}

/// A disc on a rail along x that changes its speed by at most half a metre per second in a second.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sled;

impl Robot for Sled {
    type Configuration = R2;

    fn check(&self, q: &R2) -> Result<(), ConfigurationError> {
        if q.is_finite() { Ok(()) } else { Err(ConfigurationError::NotFinite) }
    }

    fn footprint(&self, q: &R2) -> Footprint {
        Footprint::disc(q.0, 0.2)
    }

    fn edge_rates(&self, a: &R2, b: &R2) -> Result<PartRates, ConfigurationError> {
        Ok([Rates { speed: (b.0 - a.0).norm(), acceleration: 0.0 }].into_iter().collect())
    }

    fn sample(&self, min: Point2, max: Point2, draws: &mut Stream) -> R2 {
        R2::new(draws.uniform(min.x, max.x), draws.uniform(min.y, max.y))
    }
}

impl Drivable for Sled {
    type Control = [f64; 2];
    type Drive = ChartLine<Sled>;

    fn drive(&self, q: &R2, u: &[f64; 2], dt: f64) -> Result<ChartLine<Sled>, ConfigurationError> {
        self.edge(q, &R2::new(q.0.x + u[0] * dt, q.0.y))
    }
}

impl SimulatedRobot for Sled {
    type Tour = ();

    fn tour(&self, _seed: Seed, _name: &str, _world: &World, _start: &R2) {}

    fn touring(&self, _tour: &(), _tick: u64, _dt: f64, _q: &R2, _extra: &mut Extra) -> [f64; 2] {
        [0.0; 2]
    }

    fn driven(&self, channels: [f64; 2]) -> Option<[f64; 2]> {
        Some(channels)
    }

    fn configuration_at(&self, _now: &R2, coordinates: &[f64]) -> Option<R2> {
        R2::from_coordinates(coordinates)
    }

    fn initial_extra(&self) -> Extra {
        Extra::from_slice(&[0.0])
    }

    fn actuate(&self, u: &[f64; 2], dt: f64, _draws: &mut Stream, extra: &mut Extra) -> [f64; 2] {
        extra[0] += (u[0] - extra[0]).clamp(-0.5 * dt, 0.5 * dt);
        [extra[0], 0.0]
    }
}

#[test]
fn a_robot_with_inertia_has_its_braking_distance() {
    let add: AddKinds = Arc::new(|app: &mut App| {
        app.add_plugins(RobotPlugin::new("sled", Sled));
    });
    let world = field(&[("sled", "sled", &[0.0, 0.0])]);
    let recipe = recipe(world, 200, vec![event(1, "sled", RobotInput::Drive(77, 0))], vec![]);
    let set = EvasionSet { back: 60, turns: vec![0, 64], switches: 0, ..EvasionSet::default() };
    let episode = contact_episodes_with(&recipe, Some(&add), |_| true, |_| true).unwrap().unwrap()[0].clone();
    let why = Explaining::with_robots(&recipe, ("sled", episode.first), &set, Some(add)).unwrap().finish().unwrap();
    // by hand: 77/128 m/s, less 0.025 m/s in each tick, come to rest within this length
    let speed = 77.0 / 128.0;
    let braking: f64 = (1..=25).map(|tick| greater(speed - 0.025 * f64::from(tick), 0.0) * 0.05).sum();
    let at = |tick: u64| {
        // it reaches its speed in 25 ticks, then goes on evenly
        let speeding = (1..=tick).map(|k| lesser(0.025 * k as f64, speed) * 0.05);
        speeding.sum::<f64>()
    };
    let room = 2.95 - 0.2;
    let by_hand = (1..=episode.first).rev().find(|&tick| at(tick - 1) + braking < room - 4e-5).unwrap();
    assert_eq!(chance(&why.stopping).tick, by_hand);
    assert!(by_hand + 10 < episode.first, "it is no trivial one: {by_hand} of {}", episode.first);
    assert!(matches!(why.going_on, LastChance::None(NoEvasion::TooLate(_))), "on a rail nothing steers");
}
