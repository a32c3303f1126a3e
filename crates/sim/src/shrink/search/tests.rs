//! The search, with conditions on recipes that need no run.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::*;
use crate::recording::Run;
use crate::run::{Event, Quantized, RobotInput, Script, WorldChange, WorldEvent};
use crate::run::{Log, LogKind};
use crate::tour::TourConfig;
use motion_lab_core::random::Seed;
use motion_lab_core::worlds::World;

fn drive(tick: u64, robot: &str, channels: (i16, i16)) -> Event {
    Event { tick, robot: robot.into(), input: RobotInput::Drive(channels.0, channels.1) }
}

/// The tour's worlds with many inputs.
fn recipe() -> Recipe {
    let events = (1..=60).map(|tick| drive(tick, ["Rusty", "Hitch"][tick as usize % 2], (tick as i16, 127)));
    let close =
        |tick, name: &str| WorldEvent { tick, world: "apartment".into(), change: WorldChange::Close(name.into()) };
    let config = TourConfig { ticks: 100, ..TourConfig::default() };
    let doors: Vec<_> = config.worlds[0].doors.iter().zip(1..).map(|(door, tick)| close(tick, &door.name)).collect();
    let doors = doors.into_iter().map(|change| WorldEvent { world: config.worlds[0].name.clone(), ..change });
    let script = Script::new(events.collect(), doors.collect());
    assert_eq!(script.check_for(&config), Ok(()));
    Recipe::new(config, (Seed(7), script))
}

fn run(holds: impl Fn(&Recipe) -> bool + Sync) -> Shrunk {
    let of = |jobs| shrink(&recipe(), &ShrinkOptions { jobs, ..ShrinkOptions::default() }, &holds, || true);
    let shrunk = of(1);
    assert!(holds(&shrunk.recipe) && shrunk.is_minimal());
    assert_eq!(shrunk.recipe.script.check_for(&shrunk.recipe.config), Ok(()), "nothing refers to what is not there");
    for jobs in [2, 8] {
        assert!(of(jobs) == shrunk, "with {jobs} jobs it is another");
    }
    shrunk
}

fn has_event(recipe: &Recipe, tick: u64) -> bool {
    recipe.script.events.iter().any(|event| event.tick == tick)
}

#[test]
fn what_is_needed_is_all_that_is_left() {
    let shrunk = run(|recipe| {
        let hall = recipe.config.worlds.iter().find(|world| !world.doors.is_empty());
        hall.is_some_and(|world| world.doors.iter().any(|door| world.doors.len() < 5 || door.open))
            && has_event(recipe, 17)
            && has_event(recipe, 44)
            && recipe.config.ticks >= 53
    });
    let config = &shrunk.recipe.config;
    let ticks: Vec<u64> = shrunk.recipe.script.events.iter().map(|event| event.tick).collect();
    assert_eq!((ticks, config.ticks, config.sensor), (vec![17, 44], 53, None));
    // a robot for each of the events, and its world
    let robots: Vec<&str> = config.robot_names().collect();
    assert_eq!(robots, ["Rusty", "Hitch"]);
    assert_eq!((config.worlds.len(), config.worlds[0].doors.len()), (2, 1));
    let RecipeSize { obstacles, others, changes, sensors, .. } = shrunk.after;
    assert_eq!((obstacles, others, changes, sensors), (1, 0, 0, 0));
    assert_eq!(shrunk.before, RecipeSize::of(&recipe()));
    let RecipeSize { worlds, robots, events, changes, ticks, .. } = shrunk.before;
    assert_eq!((worlds, robots, events, changes, ticks), (3, 3, 60, 5, 100));
}

#[test]
fn what_is_needed_together_stays_together_and_nothing_needed_leaves_one_empty_world() {
    let shrunk = run(|recipe| {
        let count = recipe.script.events.len();
        count > 0 && count.is_multiple_of(3) && !recipe.config.worlds.is_empty()
    });
    assert_eq!(shrunk.after.events, 3);
    let shrunk = run(|recipe| !recipe.config.worlds.is_empty());
    let RecipeSize { worlds, robots, sensors, obstacles, others, events, changes, ticks } = shrunk.after;
    assert_eq!((worlds, robots, sensors, obstacles, others, events, changes, ticks), (1, 0, 0, 0, 0, 0, 0, 0));
}

#[test]
fn a_run_that_only_some_lengths_show_is_as_short_as_one_tick_less_does_not_show() {
    for (least, most, rest) in [(0, 100, 1), (1, 100, 1), (37, 100, 1), (99, 100, 1), (20, 100, 10)] {
        let holds = |recipe: &Recipe| {
            let ticks = recipe.config.ticks;
            !recipe.config.worlds.is_empty() && (least..=most).contains(&ticks) && ticks.is_multiple_of(rest)
        };
        let ticks = run(holds).after.ticks;
        assert!(rest > 1 || ticks == least, "{least}: {ticks}");
        assert!(ticks.is_multiple_of(rest) && (ticks == least || rest > 1));
    }
}

#[test]
fn numbers_keep_the_digits_that_are_needed() {
    let mut precise = recipe();
    // 127 would be rounded to 130, which no script has
    for event in &mut precise.script.events {
        if let RobotInput::Drive(_, b) = &mut event.input {
            *b = 118;
        }
    }
    let exactly = |x: f64| Quantized::try_new(x).unwrap();
    precise.script.events[8].input = RobotInput::Teleport(vec![exactly(1.234_567), exactly(-0.5), exactly(0.004_9)]);
    let needed = |recipe: &Recipe| {
        let of = |event: &Event| match &event.input {
            RobotInput::Teleport(q) => q[0].value() > 1.23 && q[0].value() < 1.2399,
            _ => false,
        };
        let has_drive = |event: &Event| matches!(event.input, RobotInput::Drive(a, _) if a > 46);
        recipe.script.events.iter().any(of) && recipe.script.events.iter().any(has_drive)
    };
    let shrunk = shrink(&precise, &ShrinkOptions::default(), needed, || true);
    let inputs: Vec<&RobotInput> = shrunk.recipe.script.events.iter().map(|event| &event.input).collect();
    let teleport = RobotInput::Teleport(vec![exactly(1.235), exactly(-0.5), exactly(0.005)]);
    assert_eq!(inputs, [&teleport, &RobotInput::Drive(100, 100)]);
}

#[test]
fn worlds_that_are_kept_stay_as_they_are() {
    let options = ShrinkOptions { keeps_worlds: true, ..ShrinkOptions::default() };
    let whole = recipe();
    let shrunk = shrink(&whole, &options, |recipe| has_event(recipe, 17), || true);
    assert_eq!(shrunk.recipe.config.worlds, [whole.config.worlds[2].clone()]);
    assert_eq!((shrunk.recipe.config.sensor, shrunk.after.events, shrunk.after.changes), (whole.config.sensor, 1, 0));
    assert_eq!(shrunk.recipe.config.ticks, 17);
}

#[test]
fn a_search_ends_where_it_is_not_to_go_on_and_keeps_the_best() {
    let whole = recipe();
    let holds = |recipe: &Recipe| has_event(recipe, 17) && has_event(recipe, 44);
    let all = run(holds);
    for most in [0, 1, 2, 10, 30, all.tries - 1] {
        let of = |jobs| shrink(&whole, &ShrinkOptions { jobs, max_tries: most, ..Default::default() }, holds, || true);
        let shrunk = of(1);
        assert_eq!((shrunk.end, shrunk.tries), (ShrinkEnd::TriesSpent, most));
        assert!(holds(&shrunk.recipe) && !shrunk.is_minimal() && of(8) == shrunk);
    }
    let enough = ShrinkOptions { max_tries: all.tries, ..ShrinkOptions::default() };
    assert!(shrink(&whole, &enough, holds, || true) == all);

    for jobs in [1, 2] {
        let asked = AtomicU64::new(0);
        let go_on = || asked.fetch_add(1, Ordering::Relaxed) < 20;
        let shrunk = shrink(&whole, &ShrinkOptions { jobs, ..ShrinkOptions::default() }, holds, go_on);
        assert!(shrunk.end == ShrinkEnd::Stopped && holds(&shrunk.recipe) && shrunk.recipe != whole);
        assert!(shrunk.recipe != all.recipe);
    }
}

#[test]
fn a_recipe_without_anything_is_minimal_at_once() {
    let mut empty = recipe();
    empty.script = Script::empty();
    *Arc::make_mut(&mut empty.config) = TourConfig { worlds: vec![], ticks: 0, sensor: None };
    let shrunk = shrink(&empty, &ShrinkOptions::default(), |_| true, || true);
    assert_eq!((shrunk.tries, shrunk.end, &shrunk.recipe), (0, ShrinkEnd::Minimal, &empty));
}

/// What is left of a run in this world, for which `holds` is to be true; a log holds it, and a world file reads so.
fn left_of(world: &str, holds: impl Fn(&World) -> bool + Sync) -> World {
    let world = World::parse("yard.ron", world).unwrap();
    let config = TourConfig { worlds: vec![world], ticks: 3, sensor: None };
    let holds = |recipe: &Recipe| recipe.config.worlds.first().is_some_and(&holds);
    let shrunk = shrink(&Recipe::new(config, Seed(1)), &ShrinkOptions::default(), holds, || true);
    assert!(shrunk.is_minimal() && holds(&shrunk.recipe));
    let log: Log = Run::record_recipe(shrunk.recipe.clone(), LogKind::Digests, |_| {}).unwrap();
    assert_eq!(log.write_mcap(Vec::new()).map_err(|error| error.to_string()), Ok(()));
    let left = shrunk.recipe.config.worlds[0].clone();
    assert_eq!(World::parse("left.ron", &left.to_ron()).as_ref(), Ok(&left));
    left
}

#[test]
fn a_car_keeps_the_sizes_with_which_it_takes_the_corners_of_its_route() {
    let world = r#"World(version: 1, name: "yard", bounds: (min: (0, 0), max: (20, 20)),
        routes: [(name: "round", points: [(4, 4), (16, 4), (16, 16), (4, 16)], radius: 2.4, speed: 0.4)],
        robots: [(name: "A", kind: "hitch", start: [8, 4, 0], route: "round", car: (wheelbase: 1.5, length: 2.5))],
    )"#;
    let left = left_of(world, |world| world.robots.iter().any(|robot| robot.route.is_some()));
    assert!(left.robots[0].sizes.is_some());
    let left = left_of(world, |world| !world.robots.is_empty());
    assert!(left.robots[0].sizes.is_none() && left.robots[0].route.is_none());
}

#[test]
fn a_heading_of_nearly_half_a_turn_is_not_rounded_beyond_it() {
    for (sign, shape) in [("", "Disc(center: (15, 15), radius: 0.5)"), ("-", "Disc(center: (1, 1), radius: 0.5)")] {
        let world = format!(
            r#"World(version: 1, name: "yard", bounds: (min: (0, 0), max: (20, 20)),
            obstacles: [(name: "post", shape: {shape})],
            robots: [(name: "A", kind: "rusty", start: [8.12, 4.34, {sign}3.141592])])"#
        );
        let nearly = |world: &World| world.robots.iter().any(|robot| robot.start[2].abs() > 3.14155);
        assert_eq!(left_of(&world, nearly).robots[0].start[2].abs(), 314_159.0 / 1e5);
        let about = |world: &World| world.robots.iter().any(|robot| robot.start[2].abs() > 3.1412);
        assert_eq!(left_of(&world, about).robots[0].start[2].abs(), 31_415.0 / 1e4);
    }
}

#[test]
fn a_start_is_not_rounded_to_outside_its_world() {
    let world = r#"World(version: 1, name: "yard", bounds: (min: (0.3, 0.3), max: (5, 5)),
        robots: [(name: "A", kind: "rusty", start: [0.4, 0.4, 0])])"#;
    let start = left_of(world, |world| !world.robots.is_empty()).robots[0].start.clone();
    assert_eq!(start, [0.4, 0.4, 0.0]);
}

#[test]
fn runs_that_were_not_begun_are_not_counted() {
    for jobs in [1, 2, 8] {
        let (asked, tried) = (AtomicU64::new(0), AtomicU64::new(0));
        let holds = |_: &Recipe| {
            tried.fetch_add(1, Ordering::Relaxed);
            false
        };
        // all three worlds, two and one; then each, of which the first is not begun
        let go_on = || asked.fetch_add(1, Ordering::Relaxed) < 5;
        let shrunk = shrink(&recipe(), &ShrinkOptions { jobs, ..ShrinkOptions::default() }, holds, go_on);
        assert_eq!((shrunk.end, shrunk.tries), (ShrinkEnd::Stopped, 3), "{jobs} jobs");
        assert!(tried.into_inner() <= 3);
    }
}
