//! Worlds of IR-SIM.

use motion_lab_core::geometry::{Point2, Pose2, Shape};
use motion_lab_core::worlds::ObstacleKind;
use motion_lab_import::irsim;

use crate::{assert_prints_as_itself, corners, is_hit, sample};

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
    for left_out in ["world.step_time", "world.collision_mode", "robot.shape", "robot.behavior", "obstacle.color"] {
        assert!(imported.notes.contains(&format!("{left_out} is left out")), "{left_out}: {:?}", imported.notes);
    }
    assert_eq!(imported.notes.len(), 5);
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
        "    behavior: {name: 'dash'}",
        "g.yaml:25: obstacle[2].behavior: not supported: an obstacle that moves",
    );
    expect("    color: 'k'", "    mass: 2", "g.yaml:25: obstacle[2].mass: not supported");
    expect("name: polygon", "name: blob", "g.yaml:28: obstacle[3].shape.name: blob: it must be circle, rectangle");
    expect("name: 'diff'", "name: 'omni'", "g.yaml:10: robot[0].kinematics.name: omni: it must be diff or acker");
    expect("'manual'", "'random'", "g.yaml:38: obstacle[6].distribution: random: it must be manual");
    expect("number: 3", "number: 4", "g.yaml:37: obstacle[6].number: 4 with 3 states: it must be");
    expect("radius: 0.5,", "radius: .inf,", "g.yaml:19: obstacle[0].shape.radius: .inf: it must be a finite number");
    expect("radius: 0.5,", "radius: 0,", "g.yaml:19: obstacle[0]: radius 0 m");
    expect("radius: 0.5,", "radius: 0.5, wiggle: 1,", "g.yaml:19: obstacle[0].shape.wiggle: not supported");
    expect("state: [7, 1, 0]", "state: [7]", "g.yaml:22: obstacle[1].state: 1 of them: it must be two to four");
    expect("state: [7, 1, 0]", "state: [7000000, 1, 0]", "g.yaml:21: obstacle[1]: point (6999999");
    expect("[1, 5]", "[1, 3]", "g.yaml:26: obstacle[3]: polygon: ");
    expect("height: 8", "height: -8", "g.yaml:3: world.height: -8: it must be above 0");
    expect("world:", "word:", "g.yaml:2: `world` is missing");
    expect("robot:", "robots:", "g.yaml:9: robots: not supported: this key; known are world, robot and obstacle");
    expect("length: 2, width: 1}", "length: 2}", "g.yaml:21: obstacle[1].shape: `width` is missing");
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
