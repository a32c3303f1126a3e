//! The gap that Bug2 passes by, in words and in the picture of docs/cli.md.

use std::fs;
use std::path::PathBuf;

use crate::cli::{json, run_in};

/// A wall across a room with a gap of this width in centimetres, for a rover of 40 cm.
fn with_gap(centimetres: u32) -> String {
    let (low, high) = (1.4 - 0.005 * f64::from(centimetres), 1.4 + 0.005 * f64::from(centimetres));
    format!(
        "World(version: 1, name: \"gap\", bounds: (min: (0, 0), max: (3, 2)), obstacles: [
            (name: \"lower\", shape: Box(min: (1.4, -1), max: (1.6, {low}))),
            (name: \"upper\", shape: Box(min: (1.4, {high}), max: (1.6, 3)))],
        robots: [(name: \"R\", kind: \"rusty\", start: [0.6, 0.6, 0],
                  disc: (radius: 0.2, track: 0.2, wheel_radius: 0.05))])"
    )
}

#[test]
fn a_bug_passes_by_a_gap_of_less_than_a_sixteenth_of_its_radius() {
    let folder = tempfile::tempdir().unwrap();
    let plan = |gap: u32, planner: &str, more: &[&str]| {
        fs::write(folder.path().join("gap.ron"), with_gap(gap)).unwrap();
        let arguments = ["plan", "--world", "gap.ron", "--robot", "R", "--to", "2.4,0.6", "--tube", "0", "--json"];
        let said = run_in(folder.path(), &[&arguments[..], &["--planner", planner], more].concat());
        json(&said.out)
    };
    // the rover is 0.4 m wide and keeps 0.0125 m on either side, so a gap has to be 0.425 m wide
    for (gap, is_found) in [(65, true), (50, true), (43, true), (42, false)] {
        for planner in ["bug1", "bug2"] {
            let answer = plan(gap, planner, &["--svg", "bug2-gap.svg"]);
            assert_eq!(answer["solved"], is_found, "{planner} {gap}: {answer}");
        }
    }
    let answer = plan(42, "bug2", &[]);
    let kept = "the goal lies behind an obstacle without a gap for one that keeps 0.0125 m from it";
    assert_eq!(answer["reason"], kept, "{answer}");
    let arguments =
        ["plan", "--world", "gap.ron", "--robot", "R", "--to", "2.4,0.6", "--tube", "0", "--planner", "bug2"];
    let said = run_in(folder.path(), &arguments).failed(4);
    assert!(said.contains("There may be one: try another --planner."), "{said}");
    assert_eq!(plan(42, "visibility-graph", &[])["solved"], true);
    let figure = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("assets/figures/bug2-gap.svg");
    let drawn = fs::read_to_string(folder.path().join("bug2-gap.svg")).unwrap();
    if std::env::var_os("MOTION_LAB_WRITE_FIGURES").is_some() {
        fs::write(&figure, &drawn).unwrap();
    }
    let shown = fs::read_to_string(&figure).unwrap_or_default();
    assert!(shown == drawn, "{}: MOTION_LAB_WRITE_FIGURES=1 draws it anew", figure.display());
}
