//! Residents by name, with the sizes that their world says.

use std::fs;

use serde_json::json as value;

use crate::cli::{json, run};

const YARD: &str = include_str!("../../samples/yard.ron");

/// The yard in a file of its own folder, and the file's path.
fn yard(text: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("yard.ron").to_str().unwrap().to_owned();
    fs::write(&path, text).unwrap();
    (folder, path)
}

fn distance(arguments: &[&str]) -> f64 {
    let answer = json(&run(&[&["query", "distance"], arguments].concat()).done());
    answer["distance"].as_f64().unwrap_or_else(|| panic!("{answer}"))
}

#[test]
fn a_resident_is_asked_about_by_its_name() {
    let (folder, yard) = yard(YARD);
    let of = |name: &str, q: &[&str]| distance(&[&["--robot", name, "--world", &yard], q].concat());
    let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12, "{found} is not {expected}");
    // upright at its start, and flat before the post: base to post less the radii
    near(of("Short", &[]), 1.1 - 0.1 - 0.02);
    near(of("Short", &["0,0"]), 1.1 - 0.1 - 0.9 - 0.02);
    near(of("Long", &["0,0"]), 0.0);
    near(of("Small", &["3,8"]), 1.0 - 0.06);
    near(of("Big", &["3,8"]), 1.0 - 0.25);
    // its trailer's box begins 2.0 m before the middle wall
    near(of("Lorry", &["10,8,0,0"]), 2.0);
    near(of("Lorry", &["10,8,0"]), 9.2 - 4.0);
    // a kind is still the lab's: the arm of 2 m at the origin
    near(of("reach", &["0,0"]), (1.21_f64 + 4.0).sqrt() - 0.1 - 0.03);
    let start = json(&run(&["query", "witness", "--robot", "Big", "--world", &yard]).done());
    assert_eq!(start["witness"]["on_robot"].as_array().unwrap().len(), 2);
    // a resident of a built-in world needs no world
    assert_eq!(distance(&["--robot", "Rusty", "2,1"]), distance(&["--robot", "rusty", "2,1"]));
    let proof = folder.path().join("p.json");
    run(&[
        "query",
        "edge",
        "--robot",
        "Long",
        "--world",
        &yard,
        "1.5,0",
        "1.2,0",
        "--certificate",
        proof.to_str().unwrap(),
    ])
    .done();
    let proof = json(&fs::read_to_string(proof).unwrap());
    assert_eq!(proof["robot"], value!({"kind": "reach", "base": [6.0, 2.0], "lengths": [0.8, 0.6], "radius": 0.02}));
}

#[test]
fn a_resident_named_like_a_kind_is_the_resident() {
    let (_folder, yard) = yard(&YARD.replace("\"Short\"", "\"reach\""));
    assert!((distance(&["--robot", "reach", "--world", &yard, "0,0"]) - 0.08).abs() < 1e-12);
}

#[test]
fn names_that_nobody_has() {
    let (_folder, yard) = yard(&YARD.replace(
        "kind: \"rusty\", start: [3.5, 7, 0], disc: (radius: 0.06, track: 0.1, wheel_radius: 0.02)",
        "kind: \"x-own\", start: [1]",
    ));
    let unknown = run(&["query", "distance", "--robot", "Tall", "--world", &yard, "0,0"]).failed(2);
    assert!(unknown.contains("no robot is called \"Tall\""), "{unknown}");
    assert!(
        unknown.contains("rusty, reach, choset, reach3, hitch; in Yard lives Short, Long, Small, Big, Lorry"),
        "{unknown}"
    );
    let own = run(&["query", "distance", "--robot", "Small", "--world", &yard, "0,0"]).failed(2);
    assert!(own.contains("Small is a x-own"), "{own}");
    let none = run(&["query", "distance", "--robot", "reach"]).failed(2);
    assert!(none.contains("no configuration"), "{none}");
    let wrong = run(&["query", "distance", "--robot", "Long", "--world", &yard, "0,0,0"]).failed(2);
    assert!(wrong.contains("3 numbers: a reach has two: th1, th2"), "{wrong}");
}

#[test]
fn captures_show_the_resident() {
    let (folder, yard) = yard(YARD);
    let svg = |arguments: &[&str]| {
        let file = folder.path().join("c.svg");
        run(&[&["capture", "--out", file.to_str().unwrap()], arguments].concat()).done();
        fs::read_to_string(file).unwrap()
    };
    let still = |name: &str| {
        svg(&["--widget", "anatomy", "--tab", "distance", "--world", &yard, "--robot", name, "--q", "0,0"])
    };
    assert!(still("Short").contains("distance: 0.08"), "8 cm");
    assert!(still("Long").contains("distance: 0 m"), "it touches the post");
    let space = |name: &str| svg(&["--widget", "cspace", "--cells", "7", "--world", &yard, "--robot", name]);
    assert!(space("Short").contains("proven blocked 0.0 %"));
    assert!(!space("Long").contains("proven blocked 0.0 %"));
    let log = folder.path().join("r.mcap").to_str().unwrap().to_owned();
    run(&["record", "--world", &yard, "--ticks", "4", "-o", &log]).done();
    run(&["verify", &log]).done();
    let ran = |name: &str| svg(&["--widget", "cspace", "--cells", "7", "--log", &log, "--robot", name]);
    assert!(ran("Short").contains("proven blocked 0.0 %") && !ran("Long").contains("proven blocked 0.0 %"));
    assert_eq!(ran("reach"), ran("Short"), "a kind is its first robot");
    let unknown = run(&["capture", "--widget", "cspace", "--log", &log, "--robot", "Tall", "--out", "t.svg"]).failed(2);
    assert!(unknown.contains("no robot is called \"Tall\"") && unknown.contains("Short, Long"), "{unknown}");
}

#[test]
fn a_stand_in_of_the_same_kind_keeps_the_sizes() {
    let (_folder, yard) = yard(YARD);
    let digest = |robot: &str| {
        let out = run(&["record", "--world", &yard, "--ticks", "20", "--no-sensor", "--robot", robot]).done();
        out.lines().find(|line| line.starts_with("digest")).unwrap().to_owned()
    };
    assert_eq!(digest("Big"), digest("Big=rusty:2,10,0"));
    assert_ne!(digest("Big"), digest("Big=rusty:2,10,0.1"));
    run(&["record", "--world", &yard, "--ticks", "2", "--robot", "Big=reach:0,0"]).done();
}

#[test]
fn a_world_is_checked_with_its_residents_sizes() {
    let (_folder, good) = yard(YARD);
    run(&["world", "check", &good]).done();
    // 0.2 m before the wall
    let (_other, bad) = yard(&YARD.replace("start: [2, 10, 0]", "start: [3.8, 9, 0]"));
    assert!(run(&["world", "check", &bad]).failed(3).contains("\"Big\" starts in contact with \"the middle wall\""));
    let (_third, apart) = yard(&YARD.replace("start: [2, 10, 0]", "start: [3.7, 9, 0]"));
    run(&["world", "check", &apart]).done();
}
