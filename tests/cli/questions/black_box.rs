//! `--checker parry`: answers and paths of the book's black box, which say that they are not proven.

use std::fs;

use serde_json::{Value, json as value};

use crate::cli::{json, run, run_in, run_with};

/// Two free configurations of the arm with the post between them.
const THROUGH_THE_POST: [&str; 9] =
    ["plan", "--robot", "reach", "--from", "2.2,0.5", "--to", "2.9,0.5", "--checker", "parry"];

fn ask(question: &str, q: &[&str], checker: &str) -> Value {
    json(&run(&[&["query", question, "--robot", "reach", "--checker", checker][..], q].concat()).done())
}

#[test]
fn every_answer_of_parry_says_that_it_is_not_proven() {
    for (question, q) in [
        ("intersects", &["2.2,0.5"][..]),
        ("distance", &["2.2,0.5"]),
        ("witness", &["2.2,0.5"]),
        ("swept", &["2.2,0.5", "2.3,0.5"]),
    ] {
        let (exact, parry) = (ask(question, q, "exact"), ask(question, q, "parry"));
        assert_eq!((&parry["checker"], &parry["proven"]), (&value!("parry"), &value!(false)), "{parry}");
        assert!(exact.get("proven").is_none() && exact.get("checker").is_none(), "{exact}");
        let key = question;
        match question {
            "distance" => {
                let [a, b] = [&exact, &parry].map(|answer| answer[key].as_f64().unwrap());
                assert!(a > 0.05 && (a - b).abs() < 1e-6, "{a} {b}");
            }
            "witness" => assert_eq!(exact[key]["obstacle"], parry[key]["obstacle"]),
            _ => assert_eq!(exact[key], parry[key], "{question}"),
        }
    }
    let lines = run_with(
        b"[2.2, 0.5]\n\n[9]\n",
        &["query", "distance", "--robot", "reach", "--checker", "parry", "--input", "-"],
    );
    let out: Vec<Value> = lines.out.lines().map(json).collect();
    assert_eq!((lines.code, out.len(), &out[0]["proven"]), (Some(3), 2, &value!(false)), "{}", lines.out);
    assert!(out[1]["error"].is_string() && out[1].get("proven").is_none());
}

#[test]
fn a_cast_does_not_turn_and_an_edge_has_no_verdict_by_parry() {
    let ends = ["2.2,0.5", "2.9,0.5"];
    assert_eq!(ask("swept", &ends, "exact"), value!({"swept": true}));
    assert_eq!(ask("swept", &ends, "parry"), value!({"swept": false, "checker": "parry", "proven": false}));
    let edge = ["query", "edge", "--robot", "reach", "--checker", "parry", ends[0], ends[1]];
    let said = run(&edge).failed(2);
    assert!(said.contains("the verdict on an edge is a proof, and parry proves nothing"), "{said}");
    assert!(run(&[&edge[..], &["--certificate", "never.json"]].concat()).failed(2).contains("proof"));
    assert!(run(&["query", "swept", "--checker", "box2d", ends[0], ends[1]]).failed(2).contains("exact, parry"));
}

#[test]
fn parrys_rays_agree_with_the_scan_but_for_those_that_graze() {
    let scan = |checker| json(&run(&["query", "scan", "3,5.5,0.3", "--rays", "16", "--checker", checker]).done());
    let (exact, parry) = (scan("exact"), scan("parry"));
    assert_eq!(parry["proven"], false);
    let ranges = |answer: &Value| -> Vec<Option<f64>> {
        answer["ranges"].as_array().unwrap().iter().map(Value::as_f64).collect()
    };
    let (exact, parry) = (ranges(&exact), ranges(&parry));
    assert!(exact.len() == 16 && parry.len() == 16 && exact.iter().flatten().count() > 8);
    for (a, b) in exact.iter().zip(&parry) {
        assert!(a == b || a.zip(*b).is_some_and(|(a, b)| (a - b).abs() < 1e-9), "{exact:?} {parry:?}");
    }
}

#[test]
fn a_path_by_parry_says_that_nothing_is_proven_and_what_the_exact_checker_finds() {
    let folder = tempfile::tempdir().unwrap();
    let said = run_in(folder.path(), &[&THROUGH_THE_POST[..], &["-o", "path.json", "--svg", "path.svg"]].concat());
    assert_eq!(said.code, Some(0), "{}", said.err);
    for line in [
        "rrt-connect at seed 2005: reach in Workbench, by parry",
        "path       1 leg, 0.700 rad",
        "clearance  nothing is proven: parry calls the path free",
        "exact      leg 0 hits the post, at 0.",
    ] {
        assert!(said.out.contains(line), "{line}: {}", said.out);
    }
    assert!(!said.out.contains("proven along"), "{}", said.out);
    let path = json(&fs::read_to_string(folder.path().join("path.json")).unwrap());
    assert_eq!((&path["checker"], &path["proven"]), (&value!("parry"), &value!(false)));
    assert_eq!((&path["clearance"], &path["legs"][0]["steps"]), (&Value::Null, &value!([])));
    let svg = fs::read_to_string(folder.path().join("path.svg")).unwrap();
    assert!(svg.contains("not proven") && svg.contains("Nothing of it is proven"), "what the picture says");
    assert!(svg.contains("what it hits"), "where the exact checker sees it hit");
    let answer = json(&run(&[&THROUGH_THE_POST[..], &["--json"]].concat()).done());
    assert_eq!(
        (&answer["solved"], &answer["checker"], &answer["proven"]),
        (&value!(true), &value!("parry"), &value!(false))
    );
    assert_eq!((&answer["exact"]["edge"], &answer["exact"]["obstacle"]), (&value!("hit"), &value!("the post")));
    assert!(answer.get("clearance").is_none());
}

#[test]
fn any_planner_asks_parry_and_a_path_that_is_free_is_still_not_proven_by_it() {
    let rover = ["--robot", "rusty", "--from", "2.25,6.25", "--to", "2.8,5.9", "--checker", "parry", "--json"];
    for planner in ["rrt-connect", "rrt", "prm", "visibility-graph", "bug1", "bug1-sensor", "cell-decomposition"] {
        let answer = json(&run(&[&["plan", "--planner", planner][..], &rover].concat()).done());
        assert_eq!(answer["proven"], false, "{planner}");
        assert_eq!(answer["exact"]["edge"], "free", "{planner}: {answer}");
    }
    let car = ["--robot", "hitch", "--from", "6.5,2.5,0", "--to", "8.5,2.5,0", "--checker", "parry", "--json"];
    assert_eq!(json(&run(&[&["plan"][..], &car].concat()).done())["proven"], false);
}

#[test]
fn what_is_not_proven_is_not_played() {
    let folder = tempfile::tempdir().unwrap();
    for option in ["--script", "--record"] {
        let said = run_in(folder.path(), &[&THROUGH_THE_POST[..], &[option, "never"]].concat()).failed(2);
        assert!(said.contains("a script plays a path that is proven, and parry proves nothing"), "{said}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}
