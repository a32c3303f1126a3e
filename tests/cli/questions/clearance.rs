//! `plan --clearance`: paths that are proven to keep it, and ends that do not have it.

use std::fs;

use motion_lab::collision::Scene;
use motion_lab::geometry::Footprint;
use motion_lab::prelude::*;

use crate::cli::{json, run, run_in};

fn numbers(value: &serde_json::Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

/// The least distance of a disc from the Apartment's obstacles along the legs of a path, at each millimetre.
fn sampled(path: &serde_json::Value, radius: f64) -> f64 {
    let scene = Scene::apartment();
    let mut least = f64::INFINITY;
    for leg in path["legs"].as_array().unwrap() {
        let (from, to) = (numbers(&leg["from"]), numbers(&leg["to"]));
        let steps = 1 + (motion_lab::num::hypot(to[0] - from[0], to[1] - from[1]) / 1e-3) as u32;
        for k in 0..=steps {
            let s = f64::from(k) / f64::from(steps);
            let at = Point2::new(from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1]));
            let distance = scene.distance(&Footprint::disc(at, radius));
            least = if distance < least { distance } else { least };
        }
    }
    least
}

const ACROSS: [&str; 7] = ["plan", "--robot", "Rusty", "--from", "3,5.5", "--to", "9.75,6.25"];

#[test]
fn a_path_keeps_the_clearance_that_is_asked_for_whatever_the_planner() {
    let folder = tempfile::tempdir().unwrap();
    let planners = [
        "rrt-connect",
        "rrt",
        "rrt-star",
        "prm",
        "a-star",
        "dijkstra",
        "visibility-graph",
        "tangent-graph",
        "bug1",
        "bug2",
    ];
    let mut nearer = 0;
    for planner in planners {
        let plan = |more: &[&str]| {
            let arguments = ["--planner", planner, "--json", "-o", "path.json"];
            let said = run_in(folder.path(), &[&ACROSS[..], &arguments, more].concat()).done();
            let path = json(&fs::read_to_string(folder.path().join("path.json")).unwrap());
            (json(said.lines().next().unwrap()), path)
        };
        let (answer, path) = plan(&["--clearance", "0.1"]);
        let claimed = answer["clearance"].as_f64().unwrap();
        // the robot is planned larger by the tube
        let found = sampled(&path, 0.11 + 0.02);
        assert!(claimed > 0.1 && found >= claimed - 1e-9, "{planner}: {claimed} {found}");
        // each step of the file proves it too
        for leg in path["legs"].as_array().unwrap() {
            for step in leg["steps"].as_array().unwrap() {
                assert!(numbers(step)[2] > 0.1, "{planner}: {step}");
            }
        }
        nearer += u32::from(sampled(&plan(&[]).1, 0.13) < 0.1);
    }
    assert!(nearer >= 6, "{nearer}: without the option most come nearer");
}

#[test]
fn an_arm_and_a_car_keep_it_and_play_their_paths() {
    let folder = tempfile::tempdir().unwrap();
    for (ends, clearance) in [
        (["--robot", "reach", "--from", "2.0,0", "--to", "3.1,0"], 0.05),
        (["--robot", "Hitch", "--from", "6.5,2.5,0,0", "--to", "6.75,7,-1.5707963,-1.5707963"], 0.1),
    ] {
        let arguments = ["--clearance", &clearance.to_string(), "--json", "--record", "run.mcap"];
        let answer = json(&run_in(folder.path(), &[&["plan"][..], &ends, &arguments].concat()).done());
        assert!(answer["clearance"].as_f64().unwrap() > clearance, "{answer}");
        assert_eq!(answer["contacts"], 0, "{answer}");
    }
}

#[test]
fn ends_without_the_clearance_are_named_with_what_they_have() {
    // in the corridor, whose end is the outer wall at x = 0
    let near = ["plan", "--robot", "Rusty", "--from", "0.5,4", "--to", "4.5,2", "--clearance", "0.4"];
    let said = run(&near).failed(4);
    // 0.5 m less the radius and the tube
    assert!(said.contains("the start has a clearance of 0.37 m from the outer wall; "), "{said}");
    assert!(said.contains("it is to keep more than 0.4 m") && said.contains("a smaller --clearance"), "{said}");
    let answer = json(&run(&[&near[..], &["--json"]].concat()).out);
    assert_eq!(answer["solved"], false);
    let overlap = ["plan", "--robot", "Rusty", "--from", "0.1,4", "--to", "4.5,2", "--clearance", "0.4"];
    assert!(run(&overlap).failed(4).contains("the start would overlap the outer wall"));
    // what it overlaps is named, though another wall is as near as the clearance and comes first
    let box_beside = ["plan", "--robot", "Rusty", "--from", "0.5,5.5", "--to", "4.5,2", "--clearance", "0.4"];
    let said = run(&box_beside).failed(4);
    assert!(said.contains("the start would overlap ") && !said.contains("outer wall"), "{said}");
    // no way that wide leads to another room
    let shut = [&ACROSS[..], &["--clearance", "0.6", "--planner", "cell-decomposition"]].concat();
    assert_eq!(run(&shut).code, Some(7), "which is proven");
    for wrong in ["-1", "NaN", "inf", "101"] {
        let said = run(&[&ACROSS[..], &["--clearance", wrong]].concat()).failed(2);
        assert!(said.contains("it must be from 0 to 100 m"), "{said}");
    }
    let parry = run(&[&ACROSS[..], &["--clearance", "0.1", "--checker", "parry"]].concat()).failed(2);
    assert!(parry.contains("parry proves nothing"), "{parry}");
    let sensor = run(&[&ACROSS[..], &["--clearance", "0.1", "--planner", "bug1-sensor"]].concat()).failed(4);
    assert!(sensor.contains("keeps no clearance of yours"), "{sensor}");
}

#[test]
fn a_black_box_goes_on_with_its_path_up_to_the_iterations() {
    let answer = json(&run(&[&ACROSS[..], &["--json", "--checker", "parry", "--iterations", "300"]].concat()).done());
    assert_eq!((&answer["solved"], &answer["proven"]), (&true.into(), &false.into()), "{answer}");
}
