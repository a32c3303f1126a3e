//! `grade`: nothing is earned without driving, and nothing of a folder vanishes.

use std::fs;
use std::path::Path;

use crate::cli::{json, run, run_in};

const NOTHING: &str = "Script(version: 1, events: [])";

fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

/// The row of a submission, in a folder with the assignment `exam.ron`.
fn row(folder: &Path, submission: &str) -> serde_json::Value {
    let graded = run_in(folder, &["grade", "--json", "exam.ron", submission]);
    assert!(matches!(graded.code, Some(0 | 4)), "{}", graded.err);
    json(graded.out.lines().next().unwrap())
}

/// The assignments in a text, without the marks of comments before their lines.
fn assignments(text: &str) -> Vec<String> {
    let plain: Vec<&str> =
        text.lines().map(|line| line.trim_start().trim_start_matches("//!").trim_start_matches("///")).collect();
    let plain = plain.join("\n");
    let whole = |at: usize| {
        let mut depth = 0;
        for (i, c) in plain[at..].char_indices() {
            depth += i32::from(c == '(') - i32::from(c == ')');
            if c == ')' && depth == 0 {
                return Some(plain[at..=at + i].to_owned());
            }
        }
        None
    };
    let written = plain.match_indices("Assignment(").filter_map(|(at, _)| whole(at));
    written.filter(|text| text.contains("version: 1")).collect()
}

#[test]
fn the_empty_script_earns_nothing_in_any_assignment_of_the_docs() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |path: &str| fs::read_to_string(root.join(path)).unwrap();
    let mut all: Vec<String> = assignments(&run(&["grade", "--help"]).done());
    for page in ["README.md", "docs/cli.md", "docs/web/course.md", "docs/formats.md", "crates/sim/src/course/mod.rs"] {
        all.extend(assignments(&read(page)));
    }
    assert!(all.len() >= 3, "{}", all.len());
    for text in all {
        let folder = folder(&[("exam.ron", &text), ("nothing.ron", NOTHING)]);
        let row = row(folder.path(), "nothing.ron");
        assert_eq!((&row["passed"], &row["points"]), (&false.into(), &0.0.into()), "{text}");
        assert!(row["refused"].is_null(), "{row}");
    }
}

/// The place to which a rover's tour of the Apartment leads within 600 ticks.
const ROOM_C: &str = r#"Assignment(version: 1, world: "apartment", robot: "Rusty",
    goal: (at: [9.75, 6.25, 0], within: [0.2, 0.2, 3.2]), limits: (ticks: 600, contacts: 0), seeds: "0..5")"#;

#[test]
fn a_robot_that_nobody_drives_stands() {
    let release = r#"Script(version: 1, events: [
        (tick: 1, robot: "Rusty", input: Drive(0, 0)), (tick: 2, robot: "Rusty", input: Release)])"#;
    let folder = folder(&[("exam.ron", ROOM_C), ("nothing.ron", NOTHING), ("release.ron", release)]);
    let start = motion_lab::worlds::World::apartment().robots[0].start.clone();
    for submission in ["nothing.ron", "release.ron"] {
        let row = row(folder.path(), submission);
        assert_eq!((&row["passed"], &row["points"]), (&false.into(), &0.0.into()), "{submission}");
        for attempt in row["attempts"].as_array().unwrap() {
            let at: Vec<f64> =
                attempt["configuration"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
            assert_eq!((at, &attempt["contacts"]), (start.clone(), &0.into()), "{submission}: {attempt}");
        }
    }
    // an arm stands too, and a car whose script asks for what no car takes
    let arm = r#"Assignment(version: 1, world: "workbench", robot: "Reach", start: [2.0, 0],
        goal: (at: [3.1, 0], within: [0.1, 0.1]), limits: (ticks: 40), seeds: "0..2")"#;
    let car = r#"Assignment(version: 1, world: "lot", robot: "Hitch", start: [6.5, 2.5, 0],
        goal: (at: [7.5, 2.5, 0], within: [0.1, 0.1, 0.1]), limits: (ticks: 200, contacts: 0), seeds: "0..2")"#;
    let moved = r#"Script(version: 1, events: [(tick: 1, robot: "Hitch", input: MoveTo([1, 2]))])"#;
    for (exam, script, start) in [(arm, NOTHING, &[2.0, 0.0][..]), (car, moved, &[6.5, 2.5, 0.0])] {
        fs::write(folder.path().join("exam.ron"), exam).unwrap();
        fs::write(folder.path().join("it.ron"), script).unwrap();
        let row = row(folder.path(), "it.ron");
        let attempt = &row["attempts"][1];
        assert_eq!((&attempt["verdict"], &attempt["contacts"]), (&"missed the goal".into(), &0.into()), "{row}");
        assert_eq!(attempt["configuration"], serde_json::json!(start), "{row}");
    }
}

#[test]
fn a_robot_on_a_route_stands_when_it_is_graded_and_is_traffic_when_it_is_not() {
    // a square lane of 6 m by 6 m, along whose lower side A drives to the right
    let world = r#"World(version: 1, name: "yard", bounds: (min: (0, 0), max: (10, 10)),
        routes: [(name: "lane", points: [(2, 2), (8, 2), (8, 8), (2, 8)], radius: 0.5, speed: 0.4)],
        robots: [(name: "A", kind: "rusty", start: [4, 2, 0], route: "lane"),
                 (name: "B", kind: "rusty", start: [6, 5, 0])])"#;
    let exam = |robot: &str, from: &str, to: &str| {
        format!(
            "Assignment(version: 1, world: \"yard.ron\", robot: \"{robot}\", start: {from},
            goal: (at: {to}, within: [0.2, 0.2, 3.2]), limits: (ticks: 200, contacts: 0), seeds: [1])"
        )
    };
    // along the lane A would pass (6, 2); B stands in its way
    let folder =
        folder(&[("yard.ron", world), ("nothing.ron", NOTHING), ("exam.ron", &exam("A", "[4, 2, 0]", "[6, 2, 0]"))]);
    let standing = row(folder.path(), "nothing.ron");
    assert_eq!(standing["attempts"][0]["configuration"], serde_json::json!([4.0, 2.0, 0.0]), "{standing}");
    // B comes toward A along the lane: were A to stand, they would meet at 4.22 m, a diameter from it
    fs::write(folder.path().join("exam.ron"), exam("B", "[7.5, 2, 3.14159]", "[6, 5, 0]")).unwrap();
    fs::write(
        folder.path().join("ahead.ron"),
        r#"Script(version: 1, events: [(tick: 1, robot: "B", input: Drive(128, 0))])"#,
    )
    .unwrap();
    let met = row(folder.path(), "ahead.ron");
    let attempt = &met["attempts"][0];
    assert_eq!(attempt["verdict"], "too many contacts", "{met}");
    assert!(attempt["configuration"][0].as_f64().unwrap() > 4.6, "{met}");
}

#[test]
fn a_trailer_is_dropped_and_taken_again_only_where_the_assignment_says_so() {
    let exam = r#"Assignment(version: 1, world: "lot", robot: "Hitch", start: [6.5, 2.5, 0, 0],
        goal: (at: [7.25, 2.5, 0, 0], within: [0.15, 0.15, 0.06, 0.06]), limits: (ticks: 60), seeds: [1])"#;
    let script = r#"Script(version: 1, events: [(tick: 1, robot: "Hitch", input: SetTrailer(false)),
        (tick: 1, robot: "Hitch", input: Drive(128, 0)), (tick: 11, robot: "Hitch", input: Drive(0, 0)),
        (tick: 12, robot: "Hitch", input: SetTrailer(true))])"#;
    let folder = folder(&[("exam.ron", exam), ("drops.ron", script)]);
    let refused = row(folder.path(), "drops.ron");
    assert!(refused["refused"].as_str().unwrap().starts_with("events[0]: SetTrailer is not allowed"), "{refused}");
    assert_eq!(refused["points"], 0.0);
    let allowed = exam.replace("seeds", "set_trailer: true, seeds");
    fs::write(folder.path().join("exam.ron"), allowed).unwrap();
    assert_eq!(row(folder.path(), "drops.ron")["passed"], true);
}

#[test]
fn an_assignment_whose_robot_starts_at_its_goal_is_refused() {
    let folder = folder(&[("nothing.ron", NOTHING), ("exam.ron", &ROOM_C.replace("9.75, 6.25", "2.25, 6.3"))]);
    let refused = run_in(folder.path(), &["grade", "exam.ron", "nothing.ron"]).failed(3);
    assert!(refused.contains("exam.ron:2:11: goal: the robot is there at the start"), "{refused}");
    for (from, to, said) in [
        ("at: [9.75, 6.25, 0]", "at: [99.75, 6.25, 0]", "goal: the goal (99.75, 6.25) lies outside the world"),
        (
            "robot: \"Rusty\",",
            "robot: \"Rusty\", start: [-5, 1, 0],",
            "start: the start (-5, 1) lies outside the world",
        ),
        ("within: [0.2, 0.2, 3.2]", "within: [\"2deg\", 0.2, 3.2]", "goal: coordinate 0 is a length in metres"),
    ] {
        fs::write(folder.path().join("exam.ron"), ROOM_C.replace(from, to)).unwrap();
        let refused = run_in(folder.path(), &["grade", "exam.ron", "nothing.ron"]).failed(3);
        assert!(refused.contains(said), "{refused}");
    }
}

#[test]
fn every_file_of_a_folder_is_a_row_or_left_out_by_name() {
    let folder = folder(&[
        ("exam.ron", ROOM_C),
        ("in/UP.RON", NOTHING),
        ("in/kim.txt", NOTHING),
        ("in/x.mcap.partial", ""),
        ("in/page.html", "<html><p>what Moodle adds</p>"),
        // what the lab fills in, with no run in it yet
        ("in/saved.html", include_str!("../../../assets/web/saved.html")),
        ("in/._ann.ron", "\u{0}"),
        ("in/none", ""),
        ("in/LOG.Mcap", "not a log"),
    ]);
    let graded = run_in(folder.path(), &["grade", "--json", "exam.ron", "in"]);
    let rows: Vec<serde_json::Value> = graded.out.lines().map(json).collect();
    let names: Vec<String> = rows.iter().map(|row| row["submission"].as_str().unwrap().replace('\\', "/")).collect();
    assert_eq!(names, ["in/LOG.Mcap", "in/UP.RON", "in/saved.html"], "{}", graded.err);
    let points = [serde_json::Value::Null, 0.0.into(), serde_json::Value::Null];
    assert_eq!([0, 1, 2].map(|row: usize| rows[row]["points"].clone()), points, "what can't be read has none");
    assert!(rows[0]["refused"].is_string() && rows[1]["refused"].is_null(), "{rows:?}");
    assert_eq!(rows[2]["refused"], "this is a page, and its run is not base64: it was changed");
    for (file, reason) in [
        ("kim.txt", "its name ends in none of .ron, .mcap, .html and .csv"),
        ("none", "its name ends in none of"),
        ("x.mcap.partial", "it is the beginning of a log"),
        ("page.html", "it is a page that the lab did not save"),
        ("._ann.ron", "it is hidden"),
    ] {
        let said = format!("{file}: left out: {reason}");
        assert!(graded.err.contains(&said), "{said}: {}", graded.err);
    }
    assert_eq!(graded.err.matches("left out").count(), 5, "{}", graded.err);
}
