//! Generated runs with one planted cause of a contact: what is left of them is the cause.

use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::sync::Arc;

use motion_lab_core::geometry::{Aabb, Point2, Pose2, Shape};
use motion_lab_core::num;
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{Door, Mark, Obstacle, ObstacleKind, Place, Resident, ResidentSensor, World};
use motion_lab_sim::recording::Recorder;
use motion_lab_sim::run::{Event, Quantized, Recipe, RobotInput, Script, WorldChange, WorldEvent};
use motion_lab_sim::shrink::{Condition, RecipeSize, ShrinkOptions, Shrunk, shrink};
use motion_lab_sim::tour::TourConfig;
use oracle::fixtures::count_from_env;

/// The robot that has a contact.
const DRIVEN: &str = "the driven";

/// The world it is in.
const YARD: &str = "the yard";

/// What it drives into, apart from the event that drives it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Cause {
    Disc,
    /// One side of a fence.
    Side,
    /// An open door, which a change closes.
    Door,
    /// An obstacle that a change puts there.
    Added,
    /// Another robot, which stands.
    Robot,
}

const CAUSES: [Cause; 5] = [Cause::Disc, Cause::Side, Cause::Door, Cause::Added, Cause::Robot];

/// A run in which `DRIVEN` has a contact by `cause` alone: everything else is more than 6 m from its way, and nothing
/// moves so far within the run.
struct Planted {
    cause: Cause,
    recipe: Recipe,
}

impl Planted {
    fn new(number: u64) -> Self {
        let draws = &mut Stream::new(Seed(number), "planted");
        let cause = CAUSES[number as usize % CAUSES.len()];
        let mut yard = clutter(draws, YARD);
        let start = Pose2::new(draws.uniform(-0.5, 0.5), draws.uniform(-0.5, 0.5), draws.uniform(-3.0, 3.0));
        // what it meets stands across its way, from 0.4 m to 0.8 m before its centre
        let ahead = |by: f64, aside: f64| {
            let (sin, cos) = (num::sin(start.theta), num::cos(start.theta));
            Point2::new(start.x + by * cos - aside * sin, start.y + by * sin + aside * cos)
        };
        let by = draws.uniform(0.4, 0.8);
        let (a, b) = (ahead(by, -1.0), ahead(by, 1.0));
        let (mut events, mut changes) = (Vec::new(), Vec::new());
        let change = |tick, change| WorldEvent { tick, world: YARD.into(), change };
        let q = |x: f64| Quantized::try_new(x).unwrap();
        let own = draws.below(yard.obstacles.len() as u64) as usize;
        match cause {
            Cause::Disc => {
                let at = ahead(by + 0.5, draws.uniform(-0.1, 0.1));
                let disc = (Pose2::new(at.x, at.y, 0.0), Shape::try_disc(0.5).unwrap());
                yard.obstacles.push(Obstacle::new("cause", ObstacleKind::Solid, vec![disc]));
            }
            Cause::Side => {
                // the others lead away from it
                let corners = [a, b, ahead(15.0, 1.5), ahead(15.0, 5.0)];
                let side = |ends: &[Point2]| (Pose2::IDENTITY, Shape::try_segment(ends[0], ends[1]).unwrap());
                let sides = corners.windows(2).map(side).collect();
                yard.obstacles.push(Obstacle::new("cause", ObstacleKind::Wall, sides));
            }
            Cause::Door => {
                yard.doors.push(Door { name: "cause".into(), a, b, open: true });
                changes.push(change(1 + draws.below(4), WorldChange::Close("cause".into())));
            }
            Cause::Added => {
                let points = vec![(q(a.x), q(a.y)), (q(b.x), q(b.y))];
                let add = WorldChange::Add { name: "cause".into(), points, radius: q(0.01) };
                changes.push(change(1 + draws.below(4), add));
            }
            Cause::Robot => {
                let at = ahead(by + 0.1, 0.0);
                yard.robots.push(Resident::new("cause", "rusty", [at.x, at.y, draws.uniform(-3.0, 3.0)]));
            }
        }
        let moved = yard.obstacles[own].name.clone();
        changes.push(change(6, WorldChange::Move { name: moved, to: (q(0.125), q(0.0), q(0.0)) }));
        yard.robots.push(Resident::new(DRIVEN, "rusty", [start.x, start.y, start.theta]));
        let drive = |tick, robot: &str, a, b| Event { tick, robot: robot.into(), input: RobotInput::Drive(a, b) };
        events.push(drive(3, DRIVEN, 0, 0));
        let from = 4 + draws.below(10);
        events.push(drive(from, DRIVEN, 90 + draws.below(39) as i16, 0));
        events.push(drive(from + 50, DRIVEN, 0, 0));
        let worlds =
            [vec![yard], (0..draws.below(3)).map(|i| clutter(draws, &format!("world {i}"))).collect()].concat();
        let names: Vec<String> = worlds.iter().flat_map(|w| &w.robots).map(|r| r.name.clone()).collect();
        for _ in 0..draws.below(20) {
            let robot = &names[draws.below(names.len() as u64) as usize];
            if robot != DRIVEN && robot != "cause" {
                let channel = |draws: &mut Stream| draws.below(257) as i16 - 128;
                events.push(drive(1 + draws.below(70), robot, channel(draws), channel(draws)));
            }
        }
        events.sort_by_key(|event| event.tick);
        changes.sort_by_key(|event| event.tick);
        let sensor = Some(RangeSensor { n_rays: 3, max_range: 2.0 });
        let config = TourConfig { worlds, ticks: 80, sensor };
        let recipe = Recipe::new(config, (Seed(number), Script::new(events, changes)));
        assert_eq!(recipe.script.check_for(&recipe.config), Ok(()), "run {number}");
        Planted { cause, recipe }
    }
}

/// A world of obstacles, robots and marks on a ring of 9 m to 12 m.
fn clutter(draws: &mut Stream, name: &str) -> World {
    let bounds = Aabb { min: Point2::new(-20.0, -20.0), max: Point2::new(20.0, 20.0) };
    let mut world = World::empty(name, bounds);
    let count = 3 + draws.below(8);
    let at = |i: u64, draws: &mut Stream| {
        let (angle, far) = (TAU * i as f64 / count as f64, draws.uniform(9.0, 12.0));
        Point2::new(far * num::cos(angle), far * num::sin(angle))
    };
    for i in 0..count {
        let p = at(i, draws);
        let named = format!("{name}, thing {i}");
        match draws.below(5) {
            0 => world.robots.push(Resident::new(named, "rusty", [p.x, p.y, draws.uniform(-3.0, 3.0)])),
            1 => {
                let sensors = vec![ResidentSensor::new("front", RangeSensor { n_rays: 2, max_range: 1.0 })];
                let robot = Resident::new(named, "hitch", [p.x, p.y, draws.uniform(-3.0, 3.0)]);
                world.robots.push(Resident { sensors, ..robot });
            }
            2 => world.places.push(Place { name: named, pose: Pose2::new(p.x, p.y, 0.0) }),
            3 => world.marks.push(Mark { name: named, points: vec![p, Point2::new(0.0, 0.0)] }),
            _ => {}
        }
        let disc = (Pose2::new(p.x + 1.0, p.y, 0.0), Shape::try_disc(draws.uniform(0.05, 0.2)).unwrap());
        world.obstacles.push(Obstacle::new(format!("{name}, stone {i}"), ObstacleKind::Solid, vec![disc]));
    }
    world
}

/// Whether the driven robot has a contact, by the frames alone.
fn shows(recipe: &Recipe) -> bool {
    let Ok(mut run) = Recorder::of(recipe) else { return false };
    let Some(id) = recipe.config.robot_names().position(|name| name == DRIVEN) else { return false };
    (0..recipe.config.ticks).for_each(|_| _ = run.step());
    run.frame().robots[id].contacts > 0
}

/// The recipe after a change of its configuration or its script.
fn changed(recipe: &Recipe, change: impl FnOnce(&mut TourConfig, &mut Script)) -> Recipe {
    let mut changed = recipe.clone();
    change(Arc::make_mut(&mut changed.config), &mut changed.script);
    changed.script.version = Script::version_of(&changed.script.changes);
    changed
}

/// Everything that a recipe has, each taken away by itself: what, and the recipe without it.
fn each_taken(recipe: &Recipe) -> Vec<(String, Recipe)> {
    let mut all = Vec::new();
    let mut take = |what: String, change: &dyn Fn(&mut TourConfig, &mut Script)| {
        all.push((what, changed(recipe, |config, script| change(config, script))));
    };
    take("a tick".into(), &|config, _| config.ticks -= 1);
    for (w, world) in recipe.config.worlds.iter().enumerate() {
        for r in 0..world.robots.len() {
            let name = world.robots[r].name.clone();
            take(format!("robot {name}"), &|config, script| {
                config.worlds[w].robots.remove(r);
                script.events.retain(|event| event.robot != name);
            });
        }
        for o in 0..world.obstacles.len() {
            take(format!("obstacle {o}"), &|config, script| {
                let name = config.worlds[w].obstacles.remove(o).name;
                script.changes.retain(|change| change.change.name() != name);
            });
            for p in 0..world.obstacles[o].pieces.len() {
                take(format!("piece {p} of {o}"), &|config, _| _ = config.worlds[w].obstacles[o].pieces.remove(p));
            }
        }
        for d in 0..world.doors.len() {
            take(format!("door {d}"), &|config, script| {
                let name = config.worlds[w].doors.remove(d).name;
                script.changes.retain(|change| change.change.name() != name);
            });
        }
    }
    for i in 0..recipe.script.events.len() {
        take(format!("event {i}"), &|_, script| _ = script.events.remove(i));
    }
    for i in 0..recipe.script.changes.len() {
        take(format!("change {i}"), &|_, script| _ = script.changes.remove(i));
    }
    all
}

/// Fails unless what is left of a run is its cause, 1-minimal.
fn judge(number: u64, Planted { cause, recipe }: &Planted, shrunk: &Shrunk) {
    let Shrunk { recipe: left, before, after, .. } = shrunk;
    assert_eq!(*before, RecipeSize::of(recipe));
    let expected = |robots, obstacles, changes| (1, robots, 0, obstacles, 0, 1, changes);
    let expected = match cause {
        Cause::Disc | Cause::Side => expected(1, 1, 0),
        Cause::Door => expected(1, 1, 1),
        Cause::Added => expected(1, 0, 1),
        Cause::Robot => expected(2, 0, 0),
    };
    let RecipeSize { worlds, robots, sensors, obstacles, others, events, changes, ticks, .. } = *after;
    let found = (worlds, robots, sensors, obstacles, others, events, changes);
    assert_eq!(found, expected, "run {number}, {cause:?}: {left:?}");
    let world = &left.config.worlds[0];
    let mut names: BTreeSet<&str> = left.config.robot_names().collect();
    names.extend(world.obstacles.iter().map(|o| &*o.name).chain(world.doors.iter().map(|d| &*d.name)));
    names.extend(left.script.changes.iter().map(|change| change.change.name()));
    assert_eq!((&*world.name, names), (YARD, BTreeSet::from(["cause", DRIVEN])), "run {number}");
    assert!(world.obstacles.iter().all(|obstacle| obstacle.pieces.len() == 1), "run {number}");
    assert_eq!(left.script.events[0].robot, DRIVEN);
    assert!(ticks < 80 && shows(left) && shrunk.is_minimal(), "run {number}");
    for (what, less) in each_taken(left) {
        assert!(!shows(&less), "run {number}, {cause:?}: {what} is not needed: {left:?}");
    }
}

/// `MOTION_LAB_SHRUNK` sets the number of runs.
#[test]
fn what_is_left_of_a_run_with_one_planted_cause_is_the_cause_whatever_the_number_of_jobs() {
    let runs = count_from_env("MOTION_LAB_SHRUNK", 5);
    let condition = Condition::parse(&format!("{DRIVEN}.contacts > 0")).unwrap();
    let (mut tries, mut taken) = (0, 0);
    for number in 0..runs {
        let planted = Planted::new(number);
        assert!(shows(&planted.recipe), "run {number} does not show its cause");
        let of = |jobs| {
            let options = ShrinkOptions { jobs, ..ShrinkOptions::default() };
            shrink(&planted.recipe, &options, |recipe| condition.holds(recipe), || true)
        };
        let shrunk = of(1);
        judge(number, &planted, &shrunk);
        for jobs in [2, 8] {
            assert!(of(jobs) == shrunk, "run {number} is another with {jobs} jobs");
        }
        tries += shrunk.tries;
        taken += shrunk.before.events + shrunk.before.obstacles + shrunk.before.robots + shrunk.before.others - 3;
    }
    println!("{runs} runs, {tries} tries, {taken} things taken");
    assert!(taken as u64 > 10 * runs && tries > 20 * runs, "{taken} things taken in {tries} tries");
}
