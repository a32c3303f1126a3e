//! The point of no return, by runs of all inputs of coarse channels: each from tick 0 on, without the run's schedule.

use motion_lab_core::configuration::RobotKind;
use motion_lab_core::geometry::{Aabb, Shape};
use motion_lab_core::num::sin_cos;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{HITCH, RUSTY};
use motion_lab_core::worlds::{Obstacle, ObstacleKind, Resident, World};
use motion_lab_sim::avoid::{
    ContactEpisode, EvasionMeans, EvasionSet, EvasionSpeeds, LastChance, NoEvasion, contact_episodes, explain,
};
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{Event, Recipe, RobotInput, Script};
use motion_lab_sim::simulation::{Replicas, SimulatedRobot};
use motion_lab_sim::tour::TourConfig;
use oracle::fixtures::count_from_env;

/// The number of runs of each kind. `MOTION_LAB_TREES` changes it.
fn runs() -> u64 {
    count_from_env("MOTION_LAB_TREES", 8)
}

/// A robot among walls, driven by a few inputs.
fn generated(kind: &str, trailer: bool, seed: u64) -> Recipe {
    let mut draws = Stream::new(Seed(seed), "trees");
    let bounds = Aabb { min: Point2::new(-20.0, -20.0), max: Point2::new(20.0, 20.0) };
    let mut world = World::empty("field", bounds);
    let heading = draws.uniform(-3.0, 3.0);
    let mut start = vec![0.0, 0.0, heading];
    if trailer {
        start.push(heading + draws.uniform(-0.5, 0.5));
    }
    let (near, far) = if kind == "rusty" { (0.4, 1.5) } else { (4.0, 11.0) };
    for k in 0..16 {
        let (at, bearing) = (draws.uniform(near, far), draws.uniform(-3.2, 3.2));
        let (s, c) = sin_cos(bearing);
        let pose = Pose2::new(at * c, at * s, 0.0);
        let half = draws.uniform(0.1, 1.0) * near;
        let ends = [-half, half].map(|x| Point2::new(x, 0.0));
        let wall = Shape::try_rounded(&ends, 0.05).unwrap();
        let pose = Pose2 { theta: draws.uniform(-3.0, 3.0), ..pose };
        if pose.position().coords.norm() - half > 0.6 * near {
            world.obstacles.push(Obstacle::new(format!("wall {k}"), ObstacleKind::Solid, vec![(pose, wall)]));
        }
    }
    world.robots.push(Resident::new("it", kind, start));
    let mut tick = 1;
    let mut events = Vec::new();
    for _ in 0..4 {
        let mut channel = || draws.below(257) as i16 - 128;
        let (turn, ahead) = (channel(), 64 + channel().abs() / 2);
        let input = RobotInput::Drive(if turn % 5 == 0 { -ahead } else { ahead }, turn);
        events.push(Event { tick, robot: "it".into(), input });
        tick += 1 + draws.below(25);
    }
    let config = TourConfig { worlds: vec![world], ticks: 160, sensor: None };
    Recipe::new(config, (Seed(seed), Script::new(events, vec![])))
}

/// All inputs of a set from a tick on, as lists of channels and of the ticks from which they apply.
fn all_inputs(set: &EvasionSet, speeds: &[i16], first: u64, until: u64) -> Vec<Vec<(u64, [i16; 2])>> {
    let pairs = || speeds.iter().flat_map(|&a| set.turns.iter().map(move |&b| [a, b]));
    let mut all: Vec<Vec<(u64, [i16; 2])>> = pairs().map(|pair| vec![(first, pair)]).collect();
    let mut last = all.clone();
    for _ in 0..set.switches {
        let mut longer = Vec::new();
        for inputs in &last {
            for tick in inputs[inputs.len() - 1].0 + 1..=until {
                if (tick - first).is_multiple_of(set.every) {
                    longer.extend(pairs().map(|pair| [&inputs[..], &[(tick, pair)]].concat()));
                }
            }
        }
        all.extend(longer.iter().cloned());
        last = longer;
    }
    all
}

/// Whether a robot alone is free of contact from a tick to another, with these inputs instead of its own from there on.
fn is_free<R: SimulatedRobot>(
    replicas: &mut Replicas<R>,
    recipe: &Recipe,
    inputs: &[(u64, [i16; 2])],
    until: u64,
) -> bool {
    let from = inputs[0].0;
    assert!(replicas.begin(0, recipe.seed, &[]).unwrap());
    for tick in 1..=until {
        for event in recipe.script.events.iter().filter(|event| event.tick == tick && tick < from) {
            replicas.input(0, &event.input);
        }
        for (_, [a, b]) in inputs.iter().filter(|(at, _)| *at == tick) {
            replicas.input(0, &RobotInput::Drive(*a, *b));
        }
        replicas.step();
        if tick >= from && replicas.contacts(0).in_contact() {
            return false;
        }
    }
    true
}

/// Compares a run's contacts with the tree of all inputs. Returns how many had a last chance before the contact's tick,
/// and how many had none.
fn compare<R: SimulatedRobot>(model: &R, recipe: &Recipe) -> [u64; 2] {
    let world = &recipe.config.worlds[0];
    let mut replicas = Replicas::new(model, world, &world.robots[0], None, [recipe.seed]).unwrap();
    let mut counts = [0, 0];
    for (speeds, back) in [(vec![128, 60], 14), (vec![100], 4)] {
        let set = EvasionSet {
            speeds: EvasionSpeeds::Channels(speeds.clone()),
            turns: vec![0, 128, -128],
            switches: 1,
            every: 4,
            horizon: 7,
            back,
        };
        let episodes = contact_episodes(recipe, |_| true).unwrap();
        let mut free_since = 1;
        for episode in &episodes[..episodes.len().min(2)] {
            let ContactEpisode { first, ended, .. } = *episode;
            let why = explain(recipe, episode, &set).unwrap();
            assert_eq!(why.episode, *episode);
            let until = first + set.horizon;
            let ticks = (first.saturating_sub(set.back).max(free_since)..=first).rev();
            let mut earliest = first;
            let expected = ticks.inspect(|&tick| earliest = tick).find(|&tick| {
                let inputs = all_inputs(&set, &speeds, tick, until);
                inputs.iter().any(|inputs| is_free(&mut replicas, recipe, inputs, until))
            });
            let named = format!("{}, speeds {speeds:?}, tick {first}", recipe.seed);
            match (&why.going_on, expected) {
                (LastChance::At(evasion), Some(tick)) => {
                    assert_eq!((evasion.tick, evasion.free_until), (tick, until), "{named}");
                    let EvasionMeans::Channels(channels) = &evasion.means else { panic!("{named}") };
                    let are_in_time = channels.iter().all(|(at, _)| (at - tick).is_multiple_of(set.every));
                    assert!(are_in_time, "{named}: {channels:?} from tick {tick}");
                    counts[0] += u64::from(tick < first);
                    replays_free(recipe, &evasion.script, tick, until);
                }
                (LastChance::None(NoEvasion::TooLate(extent)), None) => {
                    assert_eq!(extent.earliest, earliest, "{named}");
                    counts[1] += 1;
                }
                (found, expected) => panic!("{named}: {found:?}, the tree says {expected:?}"),
            }
            // it stops within a tick, unless it begins where it touches something
            let stands = |tick: &u64| is_free(&mut replicas, recipe, &[(*tick, [0, 0])], until);
            let expected = (earliest..=first).rev().find(stands);
            assert_eq!(why.stopping.evasion().map(|stop| stop.tick), expected, "{named}");
            assert!(expected == Some(first) || first == 1, "{named}");
            // from the contact's tick on the frames before are in contact, up to its end
            free_since = ended.map_or(u64::MAX, |ended| ended + 1);
        }
    }
    counts
}

/// The run with a way out, recorded: free of contact from its tick on.
fn replays_free(recipe: &Recipe, script: &Script, from: u64, until: u64) {
    let config = TourConfig { ticks: until, ..TourConfig::clone(&recipe.config) };
    let log = Run::record(config, (recipe.seed, script.clone())).unwrap();
    let touched = log.frames().iter().filter(|frame| frame.tick >= from).find(|frame| frame.robots[0].in_contact);
    assert_eq!(touched.map(|frame| frame.tick), None);
    let before = |events: &[Event]| events.iter().filter(|event| event.tick < from).cloned().collect::<Vec<_>>();
    assert_eq!(before(&script.events), before(&recipe.script.events), "what it got before stays");
}

fn compare_all<R: SimulatedRobot>(model: &R, kind: &str, trailer: bool) {
    let mut counts = [0, 0];
    for seed in 0..runs() {
        let [early, none] = compare(model, &generated(kind, trailer, seed));
        counts = [counts[0] + early, counts[1] + none];
    }
    println!("{} runs of {kind}: {} last chances before the contact, {} too late", runs(), counts[0], counts[1]);
    assert!(3 * counts[0] >= runs() && counts[1] >= 1, "too few cases: {counts:?}");
}

#[test]
fn a_rover_s_last_chance_is_that_of_the_whole_tree() {
    compare_all(&RUSTY, RobotKind::RUSTY.name, false);
}

#[test]
fn a_car_s_last_chance_is_that_of_the_whole_tree() {
    compare_all(&HITCH, RobotKind::HITCH.name, false);
}

#[test]
fn a_trailer_s_last_chance_is_that_of_the_whole_tree() {
    compare_all(&HITCH, RobotKind::HITCH.name, true);
}
