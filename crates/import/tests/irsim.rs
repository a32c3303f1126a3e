//! Worlds of IR-SIM.

use motion_lab_core::configuration::Sizes;
use motion_lab_core::geometry::{Point2, Pose2, Shape};
use motion_lab_core::random::Seed;
use motion_lab_core::worlds::ObstacleKind;
use motion_lab_core::worlds::World;
use motion_lab_import::{ImportError, Imported, IrsimOptions};

use crate::{assert_prints_as_itself, corners, is_hit, sample};

/// Reads a scene strictly, with seed 0.
fn irsim(file: &str, text: &str, name: &str) -> Result<Imported, ImportError> {
    motion_lab_import::irsim(file, text, name, IrsimOptions::default())
}

/// Reads a scene without what the lab does not have.
fn lenient(text: &str) -> Imported {
    let options = IrsimOptions { is_lenient: true, seed: Seed(0) };
    motion_lab_import::irsim("s.yaml", text, "s", options).unwrap()
}

/// The places of an obstacle's one disc, by the obstacle's name.
fn disc(world: &World, name: &str) -> (f64, f64) {
    let (pose, _) = &world.obstacle(name).unwrap().pieces[0];
    (pose.x, pose.y)
}

#[test]
fn shapes_stand_where_their_states_put_them() {
    let imported = irsim("garden.yaml", &sample("garden.yaml"), "Garden").unwrap();
    let world = imported.world;
    let names: Vec<&str> = world.obstacles.iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["wall 1", "disc 1", "box 1", "box 2", "the pond", "disc 2", "disc 3", "disc 4"]);
    assert_eq!((world.bounds.min, world.bounds.max), (Point2::new(-1.0, -2.0), Point2::new(11.0, 6.0)));
    assert_eq!(world.obstacles[0].kind, ObstacleKind::Wall);
    assert_eq!(corners(&world, "wall 1"), [(5.0, 4.0), (8.0, 4.0)]);
    // a quarter turn takes the centre from (1, 0) to (0, 1) before it is moved to (4, 2)
    let (pose, disc) = &world.obstacle("disc 1").unwrap().pieces[0];
    assert!((pose.x - 4.0).abs() < 1e-12 && (pose.y - 3.0).abs() < 1e-12);
    assert_eq!(*disc, Shape::Disc { radius: 0.5 });
    let straight = &world.obstacle("box 1").unwrap().pieces[0].1;
    assert_eq!(*straight, Shape::Rectangle { min: Point2::new(6.0, 0.5), max: Point2::new(8.0, 1.5) });
    // 2 long and 1 wide, turned: 1 wide and 2 high
    assert!(is_hit(&world, 9.0, 2.95) && is_hit(&world, 9.45, 2.0) && !is_hit(&world, 9.95, 2.0));
    assert!(is_hit(&world, 1.0, 4.9) && is_hit(&world, 1.0, 3.5), "the pond stands where it was drawn");
    let radii: Vec<&Shape> =
        ["disc 2", "disc 3", "disc 4"].iter().map(|n| &world.obstacle(n).unwrap().pieces[0].1).collect();
    let disc = |radius| Shape::Disc { radius };
    assert_eq!(radii, [&disc(0.3), &disc(0.1), &disc(0.1)], "the last shape again");
    assert_eq!(world.marks[0].points, [Point2::new(0.0, 2.0), Point2::new(3.0, 2.0)]);
    assert!(!is_hit(&world, 1.0, 2.0), "a mark is painted");

    let robots: Vec<(&str, &str, &[f64])> =
        world.robots.iter().map(|r| (r.name.as_str(), r.kind.as_str(), r.start.as_slice())).collect();
    assert_eq!(robots, [("Rusty", "rusty", &[0.0, 0.0, 0.0][..]), ("Hitch", "hitch", &[2.0, -1.0, 0.0])]);
    assert_eq!(world.place("goal 1").unwrap().pose, Pose2::new(9.0, 4.0, 1.5));
    for left_out in ["world.step_time", "world.collision_mode", "robot.behavior", "obstacle.color"] {
        assert!(imported.notes.contains(&format!("{left_out} is left out")), "{left_out}: {:?}", imported.notes);
    }
    let own = "robot[1]: its circle is left out; it has hitch's own shape";
    assert!(imported.notes.contains(&own.to_owned()) && imported.notes.len() == 5, "{:?}", imported.notes);
    let Some(Sizes::Disc(disc)) = &world.robots[0].sizes else { panic!("a rover is a disc") };
    assert_eq!((disc.radius, world.robots[1].sizes.is_none()), (0.2, true));
    assert_prints_as_itself(&world);
}

#[test]
fn what_is_not_read_is_refused_with_line_and_item() {
    let refuse = |from: &str, to: &str| {
        let text = sample("garden.yaml");
        assert!(text.contains(from), "{from}");
        irsim("g.yaml", &text.replacen(from, to, 1), "g").unwrap_err().to_string()
    };
    let expect = |from: &str, to: &str, error: &str| {
        let found = refuse(from, to);
        assert!(found.starts_with(error), "{found}\n{error}");
    };
    expect("collision_mode: 'stop'", "obstacle_map: 'map.png'", "g.yaml:7: world.obstacle_map: not supported");
    expect(
        "    color: 'k'",
        "    colour: 'k'",
        "g.yaml:25: obstacle[2].colour: not supported: this key; known are shape",
    );
    expect(
        "    color: 'k'",
        "    kinematics: {name: 'diff'}",
        "g.yaml:25: obstacle[2].kinematics: not supported: an obstacle that moves",
    );
    expect("    color: 'k'", "    mass: 2", "g.yaml:25: obstacle[2].mass: not supported");
    expect("name: polygon", "name: blob", "g.yaml:28: obstacle[3].shape.name: blob: it must be circle, rectangle");
    expect(
        "name: 'diff'",
        "name: 'omni'",
        "g.yaml:10: robot[0].kinematics.name: not supported: a robot that drives as omni; known are diff and acker",
    );
    expect("'manual'", "'uniform'", "g.yaml:40: obstacle[6].distribution: not supported: uniform; known are manual");
    expect("number: 3", "number: 3.5", "g.yaml:39: obstacle[6].number: 3.5: it must be a whole number of objects");
    expect(
        "number: 3",
        "number: 100001",
        "g.yaml:39: obstacle[6].number: 100001: it must be a whole number of objects",
    );
    expect("radius: 0.5,", "radius: .inf,", "g.yaml:19: obstacle[0].shape.radius: .inf: it must be a finite number");
    expect("radius: 0.5,", "radius: 0,", "g.yaml:19: obstacle[0]: radius 0 m");
    expect("radius: 0.5,", "radius: 0.5, wiggle: 1,", "g.yaml:19: obstacle[0].shape.wiggle: not supported");
    expect("state: [7, 1, 0]", "state: [7]", "g.yaml:22: obstacle[1].state: 1 of them: it must be two to four");
    expect("state: [7, 1, 0]", "state: [7000000, 1, 0]", "g.yaml:21: obstacle[1]: point (6999999");
    expect("[1, 5]", "[1, 3]", "g.yaml:26: obstacle[3]: polygon: ");
    expect("height: 8", "height: -8", "g.yaml:3: world.height: -8: it must be above 0");
    expect("world:", "word:", "g.yaml:2: word: not supported: this key; known are world, robot and obstacle");
    expect("robot:", "robots:", "g.yaml:9: robots: not supported: this key; known are world, robot and obstacle");
    expect("vertices: [[0, 0]", "corners: [[0, 0]", "g.yaml:34: obstacle[4].shape: `vertices` is missing");
}

#[test]
fn a_number_takes_the_first_states_and_the_last_one_again() {
    let posts = |more: &str| {
        irsim("s.yaml", &format!("obstacle:\n  - shape: {{name: circle, radius: 0.1}}\n    {more}\n"), "s").unwrap()
    };
    let places = |imported: &Imported| {
        let names = imported.world.obstacles.iter().map(|o| o.name.clone());
        names.map(|name| disc(&imported.world, &name)).collect::<Vec<_>>()
    };
    let first = posts("number: 2\n    state: [[3, 4], [5, 6], [7, 8]]");
    assert_eq!(places(&first), [(3.0, 4.0), (5.0, 6.0)]);
    assert_eq!(first.notes, ["obstacle[0]: the first 2 of its 3 states are taken, as in IR-SIM"]);
    assert_eq!(places(&posts("state: [[3, 4], [5, 6]]")), [(3.0, 4.0)], "one object if no number is said");
    assert_eq!(places(&posts("number: 3\n    state: [[3, 4], [5, 6]]")), [(3.0, 4.0), (5.0, 6.0), (5.0, 6.0)]);
    let without = posts("number: 2");
    assert_eq!(places(&without), [(1.0, 1.0), (1.0, 1.0)], "IR-SIM's own default");
    assert_eq!(without.notes, ["obstacle[0] has no state: it stands at (1, 1), as in IR-SIM"]);
    assert_eq!(without.world.bounds.max, Point2::new(10.0, 10.0), "a world without a size has ten metres");
    assert!(places(&posts("number: 0")).is_empty());
    let named = posts("number: 3\n    name: [left, right]\n    state: [[3, 4], [5, 6], [7, 8]]").world;
    assert_eq!(
        (disc(&named, "left"), disc(&named, "right"), disc(&named, "right 2")),
        ((3.0, 4.0), (5.0, 6.0), (7.0, 8.0))
    );
}

#[test]
fn shapes_left_unsaid_are_those_of_irsim() {
    let text = "obstacle:\n  - state: [5, 5]\n  - {shape: {name: polygon}, state: [3, 3]}\n  \
                - {shape: {name: Rectangle}, state: [7, 7]}\n  \
                - {shape: {name: polygon, vertices: [[0, 0], [2, 2], [2, 0], [0, 1]]}, state: [0, 7]}\n  \
                - {shape: {name: polygon, vertices: [[0, 0], [1, 0], [0, 1], [0, 0]]}, state: [8, 1]}\n";
    let imported = irsim("s.yaml", text, "s").unwrap();
    let world = &imported.world;
    assert_eq!(world.obstacle("disc 1").unwrap().pieces[0].1, Shape::Disc { radius: 1.0 });
    assert!(is_hit(world, 2.01, 3.99) && is_hit(world, 3.99, 2.01) && !is_hit(world, 4.01, 3.0), "a square of 2 m");
    assert!(is_hit(world, 6.51, 7.49) && !is_hit(world, 6.49, 7.0), "a square of 1 m");
    // an outline that crosses itself is its bounding box
    assert!(is_hit(world, 0.05, 8.95) && is_hit(world, 1.95, 7.05));
    assert_eq!(imported.notes, ["polygon 2: its outline crosses itself; its bounding box stands for it, as in IR-SIM"]);
    assert!(is_hit(world, 8.3, 1.3), "a ring may end where it began");
}

#[test]
fn compounds_are_all_of_their_parts() {
    let text = "obstacle:\n  - state: [5, 5, 1.5707963267948966]\n    shape:\n      name: compound\n      parts:\n\
                \x20       \
                - {name: rectangle, length: 2, width: 0.2}\n        \
                - {name: circle, radius: 0.5, pose: [2, 0, 0]}\n";
    let world = irsim("s.yaml", text, "s").unwrap().world;
    assert_eq!(world.obstacles.len(), 1);
    // a quarter turn: the bar stands upright, the circle above it
    assert!(is_hit(&world, 5.0, 5.9) && is_hit(&world, 5.0, 4.1) && !is_hit(&world, 5.9, 5.0));
    assert!(is_hit(&world, 5.4, 7.0) && !is_hit(&world, 5.4, 6.0) && !is_hit(&world, 5.0, 7.6));
    assert_prints_as_itself(&world);
}

#[test]
fn distributions_put_objects_on_circles_and_at_random() {
    let scene = |distribution: &str, seed: u64| {
        let text = format!(
            "world: {{width: 20, height: 12, offset: [-10, -6]}}\nrobot:\n  - number: 4\n    \
             kinematics: {{name: diff}}\n    shape: {{name: circle, radius: 0.2}}\n    distribution: {distribution}\n"
        );
        let options = IrsimOptions { is_lenient: false, seed: Seed(seed) };
        motion_lab_import::irsim("s.yaml", &text, "s", options).unwrap()
    };
    let near = |pose: [f64; 3], expected: [f64; 3]| (0..3).all(|i| (pose[i] - expected[i]).abs() < 1e-12);
    let starts = |world: &World| world.robots.iter().map(|r| [r.start[0], r.start[1], r.start[2]]).collect::<Vec<_>>();
    let quarter = std::f64::consts::FRAC_PI_2;
    // the default circle leaves half a metre of the shorter side; every robot faces the middle
    let circle = scene("{name: circle}", 0).world;
    let expected = [[5.5, 0.0, 2.0 * quarter], [0.0, 5.5, -quarter], [-5.5, 0.0, 0.0], [0.0, -5.5, quarter]];
    assert!(starts(&circle).into_iter().zip(expected).all(|(found, expected)| near(found, expected)), "{circle:?}");
    let goal = circle.place("goal 2").unwrap().pose;
    assert!(near([goal.x, goal.y, 0.0], [0.0, -5.5, 0.0]), "opposite");
    let small = scene("{name: circle, center: [1, 2], radius: 3}", 0).world;
    assert!(near(starts(&small)[1], [1.0, 5.0, -quarter]));

    let random = scene("{name: random, range_low: [0, 0, 0], range_high: [5, 2, 1]}", 7);
    assert_eq!(random.notes, ["robot[0]: 4 objects are drawn with seed 7; IR-SIM draws others"]);
    let found = starts(&random.world);
    for (i, pose) in found.iter().enumerate() {
        assert!((0..3).all(|k| (0.0..[5.0, 2.0, 1.0][k]).contains(&pose[k])), "{pose:?}");
        let apart = |other: &[f64; 3]| {
            let (x, y) = (other[0] - pose[0], other[1] - pose[1]);
            x * x + y * y >= 1.0
        };
        assert!(found[..i].iter().all(apart), "a metre apart");
    }
    assert_eq!(random.world.places.len(), 4);
    let again = scene("{name: random, range_low: [0, 0, 0], range_high: [5, 2, 1]}", 7).world;
    assert_eq!(again, random.world, "the same seed");
    let other = scene("{name: random, range_low: [0, 0, 0], range_high: [5, 2, 1]}", 8).world;
    assert_ne!(other.robots, random.world.robots, "another seed");
}

#[test]
fn random_polygons_lie_in_their_ranges() {
    let text = "world: {height: 50, width: 50}\nobstacle:\n  - number: 10\n    state: [0, 0]\n    \
                shape: [{name: polygon, random_shape: true, center_range: [5, 10, 40, 30], \
                avg_radius_range: [0.5, 2]}]\n";
    let imported = irsim("s.yaml", text, "s").unwrap();
    assert_eq!(imported.notes, ["obstacle[0]: its shapes are drawn with seed 0; IR-SIM draws others"]);
    assert_eq!(imported.world.obstacles.len(), 10);
    for obstacle in &imported.world.obstacles {
        // a vertex is at most twice the average radius from the centre
        for part in obstacle.placed() {
            let bounds = part.bounds();
            assert!(bounds.min.x >= 1.0 && bounds.max.x <= 44.0 && bounds.min.y >= 6.0 && bounds.max.y <= 34.0);
        }
    }
    let first = imported.world.obstacles[0].placed().next().map(|part| part.bounds());
    assert_ne!(first, imported.world.obstacles[1].placed().next().map(|part| part.bounds()), "each is another one");
    assert_prints_as_itself(&imported.world);
}

#[test]
fn what_moves_or_drives_otherwise_is_left_out_by_name_if_asked() {
    let text = "world: {height: 50, width: 50, obstacle_map: cave.png, fog_map: true}\nobstacle:\n  \
                - {kinematics: {name: omni}, state: [5, 5, 0]}\n  \
                - {kinematics: {name: omni}, static: True, state: [6, 6]}\n  \
                - {kinematics: {name: static}, state: [9, 9], hue: red}\n\
                robot:\n  - {kinematics: {name: omni_angular}}\n  - {state: [1, 1]}\n  \
                - {kinematics: {name: diff}, state: [2, 2]}\n";
    let imported = lenient(text);
    assert_eq!((imported.world.obstacles.len(), imported.world.robots.len()), (2, 1));
    for note in [
        "world.obstacle_map is left out: a grid map",
        "world.fog_map is left out",
        "obstacle[0] is left out: obstacle[0].kinematics: an obstacle that moves",
        "obstacle.hue is left out",
        "robot[0] is left out: robot[0].kinematics.name: a robot that drives as omni_angular; known are diff and acker",
        "robot[1] is left out: robot[1].kinematics: a robot that does not drive",
    ] {
        assert!(imported.notes.iter().any(|found| found == note), "{note}: {:?}", imported.notes);
    }
    let strict = irsim("s.yaml", text, "s").unwrap_err().to_string();
    assert_eq!(strict, "s.yaml:1: world.obstacle_map: not supported: a grid map");
    // what is malformed is an error all the same
    let malformed = IrsimOptions { is_lenient: true, seed: Seed(0) };
    let error = motion_lab_import::irsim("s.yaml", "obstacle: {state: [a, b]}", "s", malformed).unwrap_err();
    assert_eq!(error.to_string(), "s.yaml:1: obstacle.state: a: it must be a finite number");
}

#[test]
fn robots_keep_their_sizes_their_lidars_and_their_goals() {
    let text = "world: {width: 50, height: 50}\nrobot:\n  - kinematics: {name: acker}\n    \
                shape: {name: rectangle, length: 4.6, width: 1.6, wheelbase: 3}\n    state: [5, 5, 0, 0]\n    \
                goal: [[[9, 9, 0], [2, 4, 1]]]\n    sensors:\n      \
                - {type: lidar2d, range_max: 20, angle_range: 2.5, number: 100, offset: [0.3, 0, 0.5], \
                noise: True, std: 0.1}\n      \
                - {name: lidar2d, angle_range: 6.283185307179586}\n  \
                - number: 2\n    kinematics: [{name: diff}]\n    name: scout\n    \
                shape: {name: rectangle, length: 0.6, width: 0.8}\n    \
                state: [[10, 10], [20, 20]]\n    goal: [[1, 2], [3, 4]]\n";
    let imported = irsim("s.yaml", text, "s").unwrap();
    let world = &imported.world;
    let Some(Sizes::Car(car)) = &world.robots[0].sizes else { panic!("a car") };
    // the rear axle is as far from the back as the front axle from the front: (4.6 - 3) / 2
    assert_eq!((car.wheelbase, car.length, car.width), (3.0, 4.6, 1.6));
    assert!((car.rear_overhang - 0.8).abs() < 1e-12);
    let sensors = &world.robots[0].sensors;
    let names: Vec<&str> = sensors.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, ["lidar2d", "lidar2d 2"]);
    let first = &sensors[0];
    assert_eq!((first.rays.sensor.n_rays, first.rays.sensor.max_range, first.rays.field_of_view), (100, 20.0, 2.5));
    assert_eq!((first.mount, first.noise.unwrap().sigma_hit), (Pose2::new(0.3, 0.0, 0.5), 0.1));
    assert_eq!(sensors[1].rays.field_of_view, std::f64::consts::TAU);
    assert!(sensors[1].noise.is_none() && sensors[1].rays.sensor.max_range == 10.0, "IR-SIM's defaults");
    let robots: Vec<&str> = world.robots.iter().map(|r| r.name.as_str()).collect();
    assert_eq!(robots, ["Hitch", "scout", "scout 2"]);
    // the disc about a rectangle of 0.6 x 0.8 m
    let Some(Sizes::Disc(disc)) = &world.robots[1].sizes else { panic!("a rover") };
    assert!((disc.radius - 0.5).abs() < 1e-12, "{}", disc.radius);
    let goals: Vec<(f64, f64)> = world.places.iter().map(|place| (place.pose.x, place.pose.y)).collect();
    assert_eq!(goals, [(9.0, 9.0), (2.0, 4.0), (1.0, 2.0), (3.0, 4.0)]);
    assert_prints_as_itself(world);
}

#[test]
fn a_robot_that_starts_outside_and_an_unknown_sensor_are_left_out_by_themselves_if_asked() {
    let outside = "world: {width: 10, height: 10, offset: [5, 5]}\nrobot:\n  \
                   - {kinematics: {name: diff}, state: [5, 15]}\n  \
                   - number: 3\n    kinematics: {name: diff}\n    state: [[15, 5], [4.9, 9], [9, 9]]\n";
    let starts = |imported: &Imported| -> Vec<Vec<f64>> {
        imported.world.robots.iter().map(|robot| robot.start.clone()).collect()
    };
    let why = "the start (4.9, 9) lies outside the world, which reaches from (5, 5) to (15, 15)";
    // what stands on the border stands in the world
    let imported = lenient(outside);
    assert_eq!(starts(&imported), [[5.0, 15.0, 0.0], [15.0, 5.0, 0.0], [9.0, 9.0, 0.0]]);
    assert!(imported.notes.contains(&format!("robot[1] is left out: {why}")), "{:?}", imported.notes);
    let strict = irsim("s.yaml", outside, "s").unwrap_err().to_string();
    assert_eq!(strict, format!("s.yaml:4: robot[1]: not supported: {why}"));
    let sensors =
        "robot:\n  kinematics: {name: diff}\n  sensors: [{name: lidar2d_custom}, {name: lidar2d, number: 7}]\n";
    let imported = lenient(sensors);
    let kept: Vec<u32> = imported.world.robots[0].sensors.iter().map(|sensor| sensor.rays.sensor.n_rays).collect();
    assert_eq!(kept, [7]);
    let unknown = "a sensor lidar2d_custom; known are lidar2d and fmcw_lidar2d";
    let note = format!("robot.sensors[0] is left out: {unknown}");
    assert!(imported.notes.contains(&note), "{:?}", imported.notes);
    let strict = irsim("s.yaml", sensors, "s").unwrap_err().to_string();
    assert_eq!(strict, format!("s.yaml:3: robot.sensors[0]: not supported: {unknown}"));
}

/// PyYAML, with which IR-SIM reads, keeps the last one.
#[test]
fn of_a_key_that_stands_twice_the_last_one_counts_with_a_note() {
    let text = "world: {width: 9, height: 9}\nobstacle:\n  - {state: [1, 1]}\nobstacle:\n  \
                - {shape: {name: circle, radius: 1, radius: 0.5}, state: [4, 4]}\n";
    let imported = irsim("s.yaml", text, "s").unwrap();
    let parts: Vec<_> = imported.world.obstacles[0].placed().map(|part| part.bounds()).collect();
    assert_eq!(
        (imported.world.obstacles.len(), parts[0].min, parts[0].max),
        (1, Point2::new(3.5, 3.5), Point2::new(4.5, 4.5))
    );
    for note in [
        "obstacle stands in line 2 and again in line 4, which counts",
        "radius stands in line 5 and again in line 5, which counts",
    ] {
        assert!(imported.notes.iter().any(|found| found == note), "{note}: {:?}", imported.notes);
    }
}

#[test]
fn more_obstacles_than_are_read_are_refused() {
    let read = |post: &str, posts: usize| {
        let text = format!("world: {{width: 9, height: 9}}\nobstacle:\n{}", post.repeat(posts));
        irsim("posts.yaml", &text, "posts")
    };
    // three of the characters , [ ] { } are in the first line and nine in each post
    let post = "  - {shape: {name: circle, radius: 0.1}, state: [1, 1]}\n";
    assert_eq!(read(post, 5_555).unwrap().world.obstacles.len(), 5_555);
    assert!(read(post, 5_556).unwrap_err().to_string().contains("more than 50000 of the signs"));
    // seven values come before the posts, eleven are in each, and the list and the whole count at the end
    let post = "  - shape:\n      name: circle\n      radius: 0.1\n    state:\n      - 1\n      - 1\n";
    assert_eq!(read(post, 18_181).unwrap().world.obstacles.len(), 18_181);
    // value 200,001 is in post 18,182, at six lines per post
    let error = read(post, 18_182).unwrap_err().to_string();
    assert!(error.ends_with("not supported: more than 200000 values"), "{error}");
    let line: usize = error.split(':').nth(1).unwrap().parse().unwrap();
    assert!((2 + 6 * 18_181..=2 + 6 * 18_182).contains(&(line - 1)), "{error}");
}
