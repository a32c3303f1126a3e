//! Plans: their points, their parameters, and why one is refused.

use super::super::*;
use super::{study, try_plan};
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{BeamModel, ResidentSensor, World};
use motion_lab_sim::run::RobotInput;

/// The starts x and theta of the car in each row.
fn starts(study: &Study) -> Vec<(f64, f64)> {
    let start = |row| study.setup(row).unwrap().config.worlds[0].robots[0].start.clone();
    (0..study.runs()).map(|row| (start(row)[0], start(row)[2])).collect()
}

#[test]
fn a_grid_has_every_combination_and_a_list_goes_side_by_side() {
    let axes = "axes: [(vary: \"Hitch.start.x\", over: Steps(6, 7, 3)), (vary: \"Hitch.start.theta\", over: Values([0, 0.5, 1]))]";
    let grid = study(&format!("Sweep(version: 1, worlds: [\"lot\"], {axes})"));
    let expected = [6.0, 6.5, 7.0].into_iter().flat_map(|x| [0.0, 0.5, 1.0].map(|theta| (x, theta)));
    assert_eq!(starts(&grid), expected.collect::<Vec<_>>());
    let list = study(&format!("Sweep(version: 1, worlds: [\"lot\"], points: List, {axes})"));
    assert_eq!(starts(&list), [(6.0, 0.0), (6.5, 0.5), (7.0, 1.0)]);
    let none = study("Sweep(version: 1, worlds: [\"lot\"], seed: 7)");
    assert_eq!((none.runs(), none.setup(0).unwrap().seed.0), (1, 7));
}

#[test]
fn a_sample_draws_each_axis_by_itself_and_each_row_from_its_number() {
    let text = |count, other: &str| {
        format!(
            "Sweep(version: 1, worlds: [\"lot\"], points: Sample(count: {count}, seed: 3), \
             axes: [{other}(vary: \"Hitch.start.x\", over: Uniform(6, 7)), (vary: \"seed\", over: Range(100, 104))])"
        )
    };
    let sample = study(&text(400, ""));
    let rows: Vec<RunSetup> = (0..400).map(|row| sample.setup(row).unwrap()).collect();
    let xs: Vec<f64> = rows.iter().map(|run| run.config.worlds[0].robots[0].start[0]).collect();
    assert!(xs.iter().all(|x| (6.0..7.0).contains(x)));
    // five standard errors of the mean of 400 uniform numbers, 0.0144 each
    assert!((xs.iter().sum::<f64>() / 400.0 - 6.5).abs() < 0.073);
    for seed in 100..104 {
        let count = rows.iter().filter(|run| run.seed.0 == seed).count();
        assert!((57..143).contains(&count), "100 of 400, five standard deviations of 8.7: {count}");
    }
    // what one axis draws says nothing of the other
    let low: Vec<u64> = rows.iter().zip(&xs).filter(|(_, x)| **x < 6.25).map(|(run, _)| run.seed.0).collect();
    assert!((100..104).all(|seed| low.iter().filter(|s| **s == seed).count() > 5), "{low:?}");
    // neither the number of rows nor another axis changes what a row draws
    assert_eq!(study(&text(10, "")).setup(7).unwrap(), rows[7]);
    let more = study(&text(10, "(vary: \"ticks\", over: Values([5, 6])), ")).setup(7).unwrap();
    assert_eq!((&more.config.worlds, more.seed), (&rows[7].config.worlds, rows[7].seed));
}

#[test]
fn every_parameter_reaches_the_run() {
    let vary = |name: &str, over: &str| {
        let text = format!(
            "Sweep(version: 1, worlds: [\"apartment\", \"workbench\", \"lot\"], script: \"a.ron\", \
             axes: [(vary: {name:?}, over: {over})])"
        );
        let study = study(&text);
        let base = study.setup(0).unwrap();
        (base, study.setup(1).unwrap())
    };
    let numbers = "Values([0.25, 0.5])";
    for name in [
        "Rusty.disc.radius",
        "Rusty.disc.track",
        "Rusty.disc.wheel_radius",
        "Reach.arm.radius",
        "Reach.arm.base.x",
        "Reach.arm.base.y",
        "Reach.arm.lengths.0",
        "Reach.arm.lengths.1",
        "Hitch.car.rear_overhang",
        "Hitch.car.max_steer",
        "Hitch.car.width",
        "Hitch.car.trailer.hitch_len",
        "Hitch.car.trailer.width",
        "Hitch.car.trailer.front_overhang",
        "Hitch.car.trailer.rear_overhang",
        "Hitch.car.trailer.jackknife",
        "Rusty.noise.sigma_hit",
        "Rusty.noise.z_short",
        "Rusty.noise.lambda_short",
        "Rusty.noise.z_miss",
        "Rusty.noise.z_max",
        "Rusty.noise.z_rand",
        "Rusty.start.theta",
        "Reach.start.theta2",
        "sensor.range",
    ] {
        let (a, b) = vary(name, numbers);
        let texts = [a, b].map(|run| {
            let worlds: String = run.config.worlds.iter().map(World::to_ron).collect();
            (worlds, run.config.sensor.unwrap().max_range.to_string())
        });
        let differing: Vec<_> = texts[0].0.lines().zip(texts[1].0.lines()).filter(|(a, b)| a != b).collect();
        if name == "sensor.range" {
            assert_eq!((texts[0].1.as_str(), texts[1].1.as_str(), differing.len()), ("0.25", "0.5", 0));
            continue;
        }
        let [(a, b)] = differing[..] else { panic!("{name}: {differing:?}") };
        let number = name.rsplit('.').next().unwrap();
        assert!(a.contains("0.25") && b.contains("0.5"), "{name}: {a} {b}");
        // a start, a base and links stand in lists without names
        let is_named = !["start", "base", "lengths"].iter().any(|list| name.contains(list));
        assert!(!is_named || a.contains(&format!("{number}: 0.25")), "{name}: {a}");
    }
    let (a, b) = vary("seed", "Range(7, 9)");
    assert_eq!((a.seed.0, b.seed.0), (7, 8));
    let (a, b) = vary("ticks", "Values([7, 9])");
    assert_eq!((a.config.ticks, b.config.ticks), (7, 9));
    let (a, b) = vary("script", "Names([\"a.ron\", \"b.ron\"])");
    let steered = [a, b].map(|run| match run.inputs {
        RunInputs::Script(script) => script.events[0].input.clone(),
        RunInputs::Planner(_) => panic!("a script"),
    });
    assert_eq!(steered, [RobotInput::Drive(128, 0), RobotInput::Drive(128, 1)]);
    let (a, b) = vary("sensor.rays", "Values([7, 9])");
    assert_eq!((a.config.sensor.unwrap().n_rays, b.config.sensor.unwrap().n_rays), (7, 9));
    let (a, b) = vary("Rusty.start", "Starts([[3, 5.5, 0], [2, 5, 1]])");
    assert_eq!(
        (&a.config.worlds[0].robots[0].start[..], b.config.worlds[0].robots[0].start[0]),
        (&[3.0, 5.5, 0.0][..], 2.0)
    );
    let kept = study("Sweep(version: 1, robots: [\"Rusty\"])").setup(0).unwrap();
    assert_eq!((kept.config.worlds.len(), kept.config.robot_names().collect::<Vec<_>>()), (3, vec!["Rusty"]));
    let worlds = study("Sweep(version: 1, axes: [(vary: \"world\", over: Names([\"lot\", \"apartment\"]))])");
    let names = |row| worlds.setup(row).unwrap().config.worlds.iter().map(|w| w.name.clone()).collect::<Vec<_>>();
    assert_eq!((names(0).len(), names(1).len()), (1, 1));
    assert_ne!(names(0), names(1));
    let yards = study(
        "Sweep(version: 1, warehouse: (robots: 10), axes: [(vary: \"warehouse.robots\", over: Values([10, 20]))])",
    );
    let robots = |row| yards.setup(row).unwrap().config.worlds[0].robots.len();
    assert_eq!((robots(0), robots(1)), (10, 20));
    let yards =
        study("Sweep(version: 1, warehouse: (robots: 10), axes: [(vary: \"warehouse.seed\", over: Range(1, 3))])");
    assert_ne!(yards.setup(0).unwrap().config.worlds, yards.setup(1).unwrap().config.worlds);
}

#[test]
fn a_plan_that_cannot_be_names_its_place() {
    let axes = |axes: &str| format!("Sweep(version: 1, worlds: [\"lot\"],\n    axes: [{axes}])");
    let cases = [
        ("Sweep(version: 2, other: 7)".to_owned(), "1:16: version: version 2: this program reads version 1"),
        ("Sweep(version: 1,\n  world: 3)".to_owned(), "2:3: there is no field `world` here: the fields are"),
        ("Sweep(version: 1".to_owned(), "1:16: "),
        (
            axes("(vary: \"Hitch.start.z\", over: Values([1]))"),
            "2:12: axes[0] \"Hitch.start.z\": there is no such parameter: vary Hitch.start, Hitch.start.x",
        ),
        (
            axes("(vary: \"Rusty.start\", over: Starts([[1]]))"),
            "2:12: axes[0] \"Rusty.start\": there is no such parameter: vary seed,",
        ),
        (
            axes("(vary: \"seed\", over: Range(0, 2)), (vary: \"seed\", over: Range(0, 2))"),
            "axes[1] \"seed\": axes[0] varies the same",
        ),
        (
            axes("(vary: \"Hitch.start\", over: Starts([[7, 2, 0]])), (vary: \"Hitch.start.x\", over: Values([7]))"),
            "axes[1] \"Hitch.start.x\": axes[0] varies the same",
        ),
        (
            axes("(vary: \"seed\", over: Steps(0, 1, 2))"),
            "axes[0] \"seed\": numbers do not fit: it takes Range(FROM, TO)",
        ),
        (axes("(vary: \"seed\", over: Values([0.5]))"), "0.5 does not fit: it takes whole numbers"),
        (axes("(vary: \"seed\", over: Range(5, 5))"), "it has no values"),
        (axes("(vary: \"sensor.range\", over: Values([inf]))"), "inf is no finite number"),
        (axes("(vary: \"sensor.range\", over: Steps(1, 2, 1))"), "1 steps: there must be at least 2"),
        (
            axes("(vary: \"sensor.range\", over: Steps(-1.7e308, 1.7e308, 3))"),
            "from -1.7e308 to 1.7e308: the ends are too far apart",
        ),
        (axes("(vary: \"Hitch.start.x\", over: Uniform(1, 2))"), "use it with points: Sample"),
        (
            axes("(vary: \"Hitch.noise.sigma_hit\", over: Values([0.1]))"),
            "2:12: axes[0] \"Hitch.noise.sigma_hit\": it would change nothing: a hitch does not carry the run's sensor",
        ),
        (
            axes("(vary: \"sensor.range\", over: Values([1]))"),
            "axes[0] \"sensor.range\": it would change nothing: no robot carries the run's sensor",
        ),
        (
            axes("(vary: \"warehouse.seed\", over: Values([1]))"),
            "axes[0] \"warehouse.seed\": it would change nothing: the study has no warehouse",
        ),
        (
            "Sweep(version: 1, no_sensor: true, axes: [(vary: \"Rusty.noise.z_rand\", over: Values([0.1]))])"
                .to_owned(),
            "axes[0] \"Rusty.noise.z_rand\": it would change nothing: the study has no range sensor",
        ),
        (
            "Sweep(version: 1, robots: [\"Hitch\"], axes: [(vary: \"Rusty.start.x\", over: Values([3]))])".to_owned(),
            "axes[0] \"Rusty.start.x\": it would change nothing: robots leaves \"Rusty\" out",
        ),
        (
            axes("(vary: \"Hitch.start\", over: Starts([[6.5, 2.5, 0], [1, 2]]))"),
            "2:12: axes[0] \"Hitch.start\": start 1: ",
        ),
        (
            axes("(vary: \"Hitch.start.x\", over: Steps(20000, 30000, 1000))"),
            "1:1: none of its 1000 runs can be; the first one, because: Hitch.start.x: ",
        ),
        (axes("(vary: \"seed\", over: Values([9007199254740993.0]))"), "without a point from 2^53 on"),
        (axes("(vary: \"seed\", over: Values([-1]))"), "-1 does not fit: it takes whole numbers"),
        (axes("(vary: \"sensor.range\", over: Names([\"a\"]))"), "names do not fit: it takes Values"),
        (
            axes("(vary: \"seed\", over: Range(0, 5000)), (vary: \"ticks\", over: Range(0, 5000))"),
            "25000000 runs: there must be 1 to 10000000",
        ),
        (
            format!(
                "{}, points: List)",
                axes("(vary: \"seed\", over: Range(0, 3)), (vary: \"ticks\", over: Range(0, 2))").trim_end_matches(')')
            ),
            "axes[1] \"ticks\": 2 values, where axes[0] has 3",
        ),
        (
            "Sweep(version: 1, worlds: [\"lot\"], robots: [\"Rusty\"])".to_owned(),
            "1:44: robots: there is no robot \"Rusty\" in the worlds; they have Hitch",
        ),
        (
            "Sweep(version: 1, worlds: [\"lot\"], goal: (robot: \"Hitch\", at: [1], within: [1]))".to_owned(),
            "1:42: goal: 1 coordinates and 1 tolerances: the robot starts with 3",
        ),
        (
            "Sweep(version: 1, worlds: [\"lot\"], goal: (robot: \"Hitch\", at: [1, 1, 1], within: [1, 1, -1]))"
                .to_owned(),
            "tolerance -1",
        ),
        ("Sweep(version: 1, sensor: (rays: 0, range: 1))".to_owned(), "1:1: 0 rays"),
    ];
    let mut wrong = Vec::new();
    for (text, expected) in cases {
        let error = try_plan(&text).map_or_else(|error| error.to_string(), |study| format!("{} runs", study.runs()));
        if !(error.starts_with("study.ron:") && error.contains(expected)) {
            wrong.push(format!("{error}\nexpected: {expected}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn a_world_or_a_script_is_found_where_the_plan_names_it() {
    let text = "Sweep(version: 1, worlds: [\"lot\",\n  \"lott\"], script: \"a.ron\",\n\
                axes: [(vary: \"seed\", over: Range(0, 1)),\n    (vary: \"world\", over: Names([\"lot\", \"b.ron\"]))])";
    let file = StudyFile::parse("study.ron", text).unwrap();
    for (name, place) in [("lot", "1:28"), ("lott", "2:3"), ("a.ron", "2:20"), ("b.ron", "4:41")] {
        assert_eq!(file.place_of(name), format!("study.ron:{place}"));
    }
}

/// The noise of a sensor holds at most one in all, so a number by itself may be too much for what was there before.
#[test]
fn the_order_of_axes_decides_nothing() {
    let mut world = World::lot();
    let rays = RangeSensor::try_new(8, 2.0).unwrap();
    let noise = Some(BeamModel { z_short: 0.5, z_rand: 0.5, ..BeamModel::EXACT });
    world.robots[0].sensors = vec![ResidentSensor { noise, ..ResidentSensor::new("front", rays) }];
    let axes = ["z_short\", over: Values([0.9])", "z_rand\", over: Values([0.05])", "rays\", over: Values([3])"];
    let noise_of = |order: [usize; 3]| {
        let axes: String = order.iter().map(|i| format!("(vary: \"Hitch.sensors.front.{}),", axes[*i])).collect();
        let text = format!("Sweep(version: 1, worlds: [\"lot\"], axes: [{axes}])");
        let worlds = [("lot".to_owned(), world.clone())].into();
        let study = StudyFile::parse("study.ron", &text).unwrap().with(&worlds, &[].into()).unwrap();
        let sensor = study.setup(0).unwrap().config.worlds[0].robots[0].sensors[0].clone();
        (sensor.noise.unwrap().z_short, sensor.noise.unwrap().z_rand, sensor.rays.sensor.n_rays)
    };
    for order in [[0, 1, 2], [1, 0, 2], [2, 0, 1], [2, 1, 0]] {
        assert_eq!(noise_of(order), (0.9, 0.05, 3));
    }
}

#[test]
fn a_sensor_of_a_robots_own_that_cannot_be_is_the_rows_failure() {
    let mut world = World::lot();
    world.robots[0].sensors = vec![ResidentSensor::new("front", RangeSensor::try_new(8, 2.0).unwrap())];
    let text =
        "Sweep(version: 1, worlds: [\"lot\"], axes: [(vary: \"Hitch.sensors.front.z_max\", over: Values([0.5, 2]))])";
    let worlds = [("lot".to_owned(), world)].into();
    let study = StudyFile::parse("study.ron", text).unwrap().with(&worlds, &[].into()).unwrap();
    assert!(study.setup(0).is_ok());
    let reason = study.setup(1).unwrap_err();
    assert!(reason.contains("front") && reason.contains('2'), "{reason}");
}

#[test]
fn whole_numbers_are_exact_however_large() {
    let text = "Sweep(version: 1, worlds: [\"lot\"], axes: [(vary: \"seed\", over: Values([7, 9007199254740992, \
                9007199254740993, 18446744073709551615])), (vary: \"Hitch.start.x\", over: Values([7, 6.5]))])";
    let first = study(text);
    let seeds = [7, 9_007_199_254_740_992, 9_007_199_254_740_993, u64::MAX];
    for study in [&first, &Study::of_line(first.line()).unwrap()] {
        let found: Vec<u64> = (0..8).step_by(2).map(|row| study.setup(row).unwrap().seed.0).collect();
        assert_eq!(found, seeds);
        assert_eq!(study.failed(4, "").cells[1], RowValue::Whole(seeds[2]));
    }
    // small ones stay as parts hold them that were written before
    assert!(first.line().contains("[7.0,6.5]"), "{}", first.line());
}

#[test]
fn a_run_without_robots_is_none() {
    let text =
        "Sweep(version: 1, robots: [\"Rusty\"], axes: [(vary: \"world\", over: Names([\"apartment\", \"lot\"]))])";
    let study = study(text);
    assert!(study.setup(0).is_ok());
    assert_eq!(study.setup(1), Err("no robot takes part in this run".into()));
    let long = text
        .replace("Names([\"apartment\", \"lot\"])", "Names([\"lot\"])")
        .replace("axes: [", "axes: [(vary: \"seed\", over: Range(0, 1001)), ");
    assert!(try_plan(&long).is_ok(), "too long to be tried as a whole");
    assert!(try_plan(&long.replace("1001", "1000")).is_err());
}
