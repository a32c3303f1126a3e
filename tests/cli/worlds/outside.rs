//! What lies outside a world is refused by name, and angles are what people meant.

use std::fs;

use crate::cli::{json, run, run_in};

/// A room of 4 m by 3 m from (-1, -2), with a robot in it.
fn room(robot: &str) -> String {
    format!(
        "World(version: 1, name: \"room\", bounds: (min: (-1, -2), max: (3, 1)), robots: [\n    \
         (name: \"R\", {robot}),\n])"
    )
}

#[test]
fn a_robot_outside_its_world_or_larger_than_it_is_refused_wherever_the_world_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    for (robot, said) in [
        (
            "kind: \"rusty\", start: [90, 90, 2]",
            "the start (90, 90) lies outside the world, which reaches from (-1, -2) to (3, 1)",
        ),
        ("kind: \"hitch\", start: [3.0001, 0, 0]", "the start (3.0001, 0) lies outside"),
        ("kind: \"reach\", start: [0, 0], arm: (base: (0, 1.5))", "the base (0, 1.5) lies outside"),
        (
            "kind: \"rusty\", start: [0, 0, 0], disc: (radius: 110, track: 0.1, wheel_radius: 0.03)",
            "a diameter of 220 m: the world is 4 m by 3 m, and lengths are in metres",
        ),
        ("kind: \"reach\", start: [0, 0], arm: (lengths: [5.1, 1])", "a link of 5.1 m: the world is 4 m by 3 m"),
        ("kind: \"rusty\", start: [\"90deg\", 0, 0]", "coordinate 0 is a length in metres, and 90deg is an angle"),
    ] {
        fs::write(at.join("w.ron"), room(robot)).unwrap();
        for command in [
            &["world", "check", "w.ron"][..],
            &["record", "--world", "w.ron", "--ticks", "2"],
            &["plan", "--world", "w.ron", "--robot", "R", "--to", "0,0"],
            &["query", "distance", "--world", "w.ron", "--robot", "R"],
        ] {
            let refused = run_in(at, command).failed(3);
            assert!(refused.contains(&format!("w.ron:2:5: robots[0] \"R\": {said}")), "{command:?}: {refused}");
        }
    }
    // the sides belong to the world, and what fits is let in: a link along the diagonal of 5 m
    for robot in [
        "kind: \"rusty\", start: [3, 1, 0]",
        "kind: \"rusty\", start: [0, 0, 0], disc: (radius: 1.5, track: 0.1, wheel_radius: 0.03)",
        "kind: \"reach\", start: [0, 0], arm: (base: (-1, 1), lengths: [5, 1])",
    ] {
        fs::write(at.join("w.ron"), room(robot)).unwrap();
        run_in(at, &["world", "check", "w.ron"]).done();
    }
}

#[test]
fn goals_and_placements_outside_are_refused_by_name() {
    let sides = "lies outside the world, which reaches from ";
    for planner in ["rrt-connect", "rrt", "prm", "a-star", "visibility-graph", "bug1", "bug2", "bug1-sensor"] {
        let none = run(&["plan", "--planner", planner, "--robot", "Rusty", "--to", "2000,20"]);
        assert_eq!(none.code, Some(4), "{planner}: {}", none.err);
        assert!(none.err.contains(&format!("the goal (2000, 20) {sides}")), "{planner}: {}", none.err);
    }
    let none = run(&["plan", "--robot", "Rusty", "--from", "-7,1", "--to", "3,5.5"]);
    assert!(none.code == Some(4) && none.err.contains(&format!("the start (-7, 1) {sides}")), "{}", none.err);
    let refused = run(&["record", "--place", "Rusty=99,3,0", "--ticks", "2"]).failed(2);
    assert!(refused.contains(&format!("--place Rusty: the start (99, 3) {sides}")), "{refused}");
    let room = format!("{}/tests/samples/room.yaml", env!("CARGO_MANIFEST_DIR"));
    let refused = run(&["world", "import", &room, "--robot", "rusty", "--start", "99,3,0"]).failed(2);
    assert!(refused.contains(&format!("--robot rusty: the start (99, 3) {sides}")), "{refused}");
}

#[test]
fn degrees_are_taken_where_angles_are_and_more_than_a_turn_is_noted() {
    let noted = "90 rad is 14.3 turns; angles are radians; write 90deg";
    let recorded = |place: &str| run(&["record", "--place", place, "--ticks", "5"]);
    let (degrees, radians) = (recorded("Rusty=3,5.5,90deg"), recorded("Rusty=3,5.5,1.5707963267948966"));
    assert!(!degrees.err.contains("turns") && !radians.err.contains("turns"), "{}", degrees.err);
    assert_eq!(degrees.done(), radians.done());
    let turned = recorded("Rusty=3,5.5,90");
    assert!(turned.err.contains(noted), "{}", turned.err);
    let refused = recorded("Rusty=90deg,5.5,0").failed(2);
    assert!(refused.contains("Rusty: coordinate 0 is a length in metres, and 90deg is an angle"), "{refused}");

    let asked = |q: &str| run(&["query", "witness", "--robot", "reach", q]);
    assert_eq!(asked("90deg,-45deg").done(), asked("1.5707963267948966,-0.7853981633974483").done());
    assert!(asked("90,0").err.contains(noted));
    assert!(run(&["query", "distance", "--robot", "hitch", "6.5,2.5,90,0"]).err.contains(noted));
    let planned = |to: &str| run(&["plan", "--json", "--robot", "reach", "--from", "2.0,0", "--to", to]);
    let answer = |to: &str| {
        let mut answer = json(&planned(to).done());
        answer.as_object_mut().unwrap().remove("seconds");
        answer
    };
    assert_eq!(answer("180deg,0deg"), answer("3.141592653589793,0"));

    let folder = tempfile::tempdir().unwrap();
    for (theta, is_noted) in [("90", true), ("\"90deg\"", false), ("6.28", false)] {
        fs::write(folder.path().join("w.ron"), room(&format!("kind: \"rusty\", start: [0, 0, {theta}]"))).unwrap();
        let checked = run_in(folder.path(), &["world", "check", "w.ron"]);
        let in_quotes = noted.replace("90deg", "\"90deg\"");
        assert_eq!(checked.err.contains(&format!("w.ron: the start of R: {in_quotes}")), is_noted, "{}", checked.err);
        checked.done();
    }
}

#[test]
fn a_script_that_puts_a_robot_outside_its_world_is_refused_when_read_or_counted_when_applied() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("w.ron"), room("kind: \"rusty\", start: [0, 0, 0]")).unwrap();
    // 3.5 m and 0.5 m in units of 2^-20 m
    let script = "Script(version: 1, events: [\n(tick: 2, robot: \"R\", input: Teleport([3670016, 524288, 0])),\n])";
    fs::write(at.join("s.ron"), script).unwrap();
    let target = "the target (3.5, 0.5) lies outside the world, which reaches from (-1, -2) to (3, 1)";
    let read = format!("s.ron:2: events[0]: tick 2: Teleport of robot \"R\": {target}");
    let recorded = ["record", "--world", "w.ron", "--script", "s.ron", "--ticks", "3"];
    for arguments in [&["script", "check", "--world", "w.ron", "s.ron"][..], &[&recorded[..], &["--strict"]].concat()] {
        let refused = run_in(at, arguments).failed(3);
        assert!(refused.contains(&read), "{arguments:?}: {refused}");
    }
    let counted = run_in(at, &recorded);
    assert_eq!(counted.code, Some(0), "{}", counted.err);
    let applied = format!("1 input of the script was refused, at tick 2: robot \"R\" refused Teleport: {target}");
    assert!(counted.err.contains(&applied), "{}", counted.err);
    fs::write(at.join("t.csv"), "tick,robot,input\n2,R,Teleport,3.5,0.5,90deg\n").unwrap();
    let refused = run_in(at, &["script", "convert", "--world", "w.ron", "t.csv"]).failed(3);
    assert!(refused.contains(&format!("t.csv:2:14: tick 2: Teleport of robot \"R\": {target}")), "{refused}");
    let turned = fs::read_to_string(at.join("t.csv")).unwrap().replace("3.5,0.5,90deg", "2,0.5,90");
    fs::write(at.join("t.csv"), turned).unwrap();
    let noted = run_in(at, &["script", "convert", "--world", "w.ron", "t.csv"]);
    assert!(noted.err.contains("t.csv:2:20: 90 rad is 14.3 turns; angles are radians; write 90deg"), "{}", noted.err);
    noted.done();
}
