//! `query`: the book's numbers, and streams of questions.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, SQRT_2};
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::process::Stdio;

use serde_json::{Value, json as value};

use crate::cli::{command, json, run, run_with};

/// The answer about the robot at `q`.
fn ask(question: &str, robot: &str, q: &[f64], more: &[&str]) -> Value {
    let q = q.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let mut arguments = vec!["query", question, q.as_str()];
    if !robot.is_empty() {
        arguments.extend(["--robot", robot]);
    }
    arguments.extend(more);
    json(&run(&arguments).done())
}

fn number(answer: &Value) -> f64 {
    answer.as_f64().unwrap_or_else(|| panic!("{answer} is no number"))
}

#[track_caller]
fn near(found: &Value, expected: f64, tolerance: f64) {
    let found = number(found);
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}

/// The distance of the arm at (0, 0), which lies along the x axis: from its base to the post's corner (-0.5, 0.3).
fn base_to_post() -> f64 {
    0.34_f64.sqrt()
}

#[test]
fn the_worked_numbers_of_the_block() {
    let q = [FRAC_PI_4, FRAC_PI_2];
    let exact = 1.5 / SQRT_2 - 1.0;
    near(&ask("distance", "choset", &q, &[])["distance"], exact, 1e-9);
    near(&ask("distance", "reach", &q, &[])["distance"], exact - 0.03, 1e-9);
    assert_eq!(ask("intersects", "choset", &q, &[]), value!({"intersects": false}));
    let witness = &ask("witness", "choset", &q, &[])["witness"];
    for (point, expected) in
        [(&witness["on_obstacle"], [0.5, 1.0]), (&witness["on_robot"], [1.0 / SQRT_2 - 0.25, 1.0 / SQRT_2 + 0.25])]
    {
        near(&point[0], expected[0], 1e-6);
        near(&point[1], expected[1], 1e-6);
    }
    assert_eq!(witness["obstacle"], "the block");
    assert_eq!(witness["part"], 1);
    near(&witness["dist"], exact, 1e-9);
}

#[test]
fn first_contact_with_the_block() {
    for (robot, theta2) in [("choset", 1.4008779), ("reach", 1.4846065)] {
        assert!(number(&ask("distance", robot, &[FRAC_PI_4, theta2 + 1e-6], &[])["distance"]) > 0.0);
        let inside = [FRAC_PI_4, theta2 - 1e-6];
        assert_eq!(ask("distance", robot, &inside, &[]), value!({"distance": 0.0}));
        assert_eq!(ask("intersects", robot, &inside, &[]), value!({"intersects": true}));
    }
}

#[test]
fn an_edge_between_free_ends_hits_the_post() {
    let edge = ask("edge", "reach", &[2.0, 0.0], &["3.1,0"]);
    assert_eq!((&edge["edge"], &edge["obstacle"], &edge["part"]), (&value!("hit"), &value!("the post"), &value!(0)));
    assert!(number(&edge["free_until"]) < number(&edge["contact_at"]));
    for end in [2.0, 3.1] {
        assert_eq!(ask("intersects", "reach", &[end, 0.0], &[]), value!({"intersects": false}));
    }
    let free = ask("edge", "reach", &[FRAC_PI_4, FRAC_PI_2], &["0.79,1.6"]);
    assert_eq!(free["edge"], "free");
    assert!(number(&free["clearance"]) > 0.0);
}

#[test]
fn rusty_before_a_wall() {
    let folder = tempfile::tempdir().unwrap();
    let world = folder.path().join("wall.ron");
    let text = r#"World(version: 1, name: "wall", bounds: (min: (0, 0), max: (4, 4)),
        walls: [(name: "the wall", points: [(3, 0), (3, 3)])])"#;
    fs::write(&world, text).unwrap();
    let more = ["--world", world.to_str().unwrap()];
    near(&ask("distance", "rusty", &[2.0, 1.0], &more)["distance"], 0.89, 1e-12);
    near(&ask("witness", "rusty", &[2.0, 1.0, 0.7], &more)["witness"]["on_obstacle"][0], 3.0, 0.0);
    let scan = ask("scan", "", &[2.0, 1.0], &more);
    let ranges = scan["ranges"].as_array().unwrap();
    assert_eq!(ranges.len(), 360);
    near(&ranges[0], 1.0, 1e-9);
    assert_eq!(ranges[180], "inf", "nothing behind");
    // turned by half a turn, the wall is behind
    let turned = ask("scan", "", &[2.0, 1.0, std::f64::consts::PI], &more);
    near(&turned["ranges"][180], 1.0, 1e-9);
    // the same motion under both questions about motions
    for (to, hits) in [("2.8,1", false), ("2.9,1", true)] {
        assert_eq!(ask("swept", "rusty", &[2.0, 1.0], &[more[0], more[1], to]), value!({"swept": hits}));
        let edge = ask("edge", "rusty", &[2.0, 1.0], &[more[0], more[1], to]);
        assert_eq!(edge["edge"], if hits { "hit" } else { "free" });
    }
}

#[test]
fn a_world_without_obstacles_is_infinitely_far() {
    let folder = tempfile::tempdir().unwrap();
    let world = folder.path().join("empty.ron");
    fs::write(&world, r#"World(version: 1, name: "empty", bounds: (min: (0, 0), max: (1, 1)))"#).unwrap();
    let more = ["--world", world.to_str().unwrap()];
    assert_eq!(ask("distance", "reach3", &[0.0, 0.0, 0.0], &more), value!({"distance": "inf"}));
    assert_eq!(ask("witness", "reach3", &[0.0, 0.0, 0.0], &more), value!({"witness": null}));
}

#[test]
fn a_fourth_coordinate_is_the_trailer() {
    // The aisle: the car's side, at y = 2.5 + 0.85, is nearest to the east pillar, at y = 4.85. A trailer straight
    // behind is narrower; swung to the south, 2.8 m long, it lies across the curb.
    near(&ask("distance", "hitch", &[8.0, 2.5, 0.0], &[])["distance"], 1.5, 1e-12);
    near(&ask("distance", "hitch", &[8.0, 2.5, 0.0, 0.0], &[])["distance"], 1.5, 1e-12);
    let folded = [8.0, 2.5, 0.0, FRAC_PI_2];
    assert_eq!(ask("distance", "hitch", &folded, &[]), value!({"distance": 0.0}));
    let witness = ask("witness", "hitch", &folded, &[]);
    assert_eq!((&witness["witness"]["part"], &witness["witness"]["obstacle"]), (&value!(1), &value!("the south curb")));
}

#[test]
fn a_stream_is_answered_line_by_line() {
    let lines =
        "[0.7853981633974483, 1.5707963267948966]\n\n{\"q\": [1]}\nnonsense\n[1e999, 0]\n\u{feff}[1, 2]\n[0, 0]";
    let run = run_with(lines.as_bytes(), &["query", "distance", "--robot", "choset", "--input", "-"]);
    assert_eq!(run.code, Some(3));
    let answers: Vec<Value> = run.out.lines().map(json).collect();
    assert_eq!(answers.len(), 6, "one for each line that is not blank: {}", run.out);
    near(&answers[0]["distance"], 1.5 / SQRT_2 - 1.0, 1e-9);
    for (answer, line) in answers[1..5].iter().zip(["line 3: ", "line 4: ", "line 5: ", "line 6: "]) {
        assert!(answer["error"].as_str().unwrap().starts_with(line), "{answer}");
        let number = line.trim_start_matches("line ").trim_end_matches(": ");
        assert!(run.err.contains(&format!("standard input:{number}: ")), "{}", run.err);
    }
    near(&answers[5]["distance"], base_to_post(), 1e-12);
}

#[test]
fn a_file_gives_what_its_lines_give_one_by_one() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("edges.jsonl");
    fs::write(&file, "{\"q\": [2.0, 0], \"to\": [3.1, 0]}\n{\"to\": [2, 0.5], \"q\": [2, 0]}\n").unwrap();
    let all = run(&["query", "edge", "--robot", "reach", "--input", file.to_str().unwrap()]).done();
    let single = |to| run(&["query", "edge", "--robot", "reach", "2,0", to]).done();
    assert_eq!(all, single("3.1,0") + &single("2,0.5"));
}

#[test]
fn a_line_that_is_too_long_or_not_text_is_an_error_of_that_line() {
    let mut input = b"[".to_vec();
    input.resize(3 << 20, b'1');
    input.extend(b"]\n\xff\xfe\n[0, 0]\n");
    let run = run_with(&input, &["query", "distance", "--robot", "choset", "--input", "-"]);
    assert_eq!(run.code, Some(3));
    let answers: Vec<&str> = run.out.lines().collect();
    assert!(answers[0].contains("line 1: longer than"), "{}", answers[0]);
    assert!(answers[1].contains("line 2: not UTF-8"), "{}", answers[1]);
    near(&json(answers[2])["distance"], base_to_post(), 1e-12);
    assert_eq!(answers.len(), 3);
}

#[test]
fn a_question_is_answered_before_the_next_is_asked() {
    let mut child = command(&["query", "distance", "--robot", "choset", "--input", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let (mut questions, mut answers) = (child.stdin.take().unwrap(), BufReader::new(child.stdout.take().unwrap()));
    for _ in 0..3 {
        writeln!(questions, "[0, 0]").unwrap();
        let mut answer = String::new();
        answers.read_line(&mut answer).unwrap();
        near(&json(&answer)["distance"], base_to_post(), 1e-12);
    }
    drop(questions);
    assert!(child.wait().unwrap().success());
}

#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let input = "[0, 0]\n".repeat(200_000);
    let mut child = command(&["query", "distance", "--robot", "choset", "--input", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let writer = std::thread::spawn(move || drop(stdin.write_all(input.as_bytes())));
    let mut first = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut first).unwrap();
    let ended = child.wait_with_output().unwrap();
    writer.join().unwrap();
    assert!(ended.status.success() && ended.stderr.is_empty(), "{}", String::from_utf8_lossy(&ended.stderr));
}
