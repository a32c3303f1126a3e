//! How short a path may be at all: `--bound`, the planner `tangent-graph`, and `--shorten`.

use std::fs;

use crate::cli::{Run, json, run, run_in};

/// A wall's end, half a metre beside the straight line between two places 2 m apart.
const END: &str = "World(version: 1, name: \"end\", bounds: (min: (-2, -2), max: (2, 2)), \
                   walls: [(name: \"wall\", points: [(0, -2), (0, 0.5)])], \
                   robots: [(name: \"R\", kind: \"rusty\", start: [-1, 0, 0])])";

/// Two tangents, and an arc about the wall's end.
fn round_the_end(radius: f64) -> f64 {
    let line = (1.25 - radius * radius).sqrt();
    2.0 * (line + radius * (motion_lab::num::atan2(0.5, 1.0) + motion_lab::num::atan2(radius, line)))
}

fn plan(world: &str, more: &[&str]) -> Run {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("world.ron"), world).unwrap();
    run_in(folder.path(), &[&["plan", "--robot", "R", "--world", "world.ron", "--to", "1,0"], more].concat())
}

#[test]
fn a_bound_is_that_of_the_rover_as_it_is_planned() {
    for (more, radius) in [
        (&["--tube", "0"][..], 0.11),
        (&[], 0.13),
        (&["--clearance", "0.05"], 0.18),
        // the millimetre that a planner keeps by itself binds no other
        (&["--planner", "rrt", "--shorten"], 0.13),
        (&["--planner", "rrt", "--clearance", "0"], 0.13),
    ] {
        let planner = ["--planner", "tangent-graph"];
        let planner = if more.contains(&"--planner") { &[][..] } else { &planner };
        let answer = json(&plan(END, &[&["--json", "--bound"], planner, more].concat()).done());
        let (length, bound) = (answer["length"].as_f64().unwrap(), answer["length_bound"].as_f64().unwrap());
        let by_hand = round_the_end(radius);
        assert!(bound <= by_hand && bound > by_hand - 1e-7, "{more:?}: {bound} {by_hand}");
        let most = if planner.is_empty() { 1.0 } else { 1e-3 };
        assert!(length > bound && length < bound + most, "{more:?}: {length} {bound}");
    }
    // 2.3383 m of a rover of 11 cm, rounded down
    let words = plan(END, &["--planner", "tangent-graph", "--bound", "--tube", "0"]).done();
    let said = format!("; no path is shorter than {:.4} m\n", (round_the_end(0.11) * 1e4).floor() / 1e4);
    assert!(words.contains(&said), "{words} {said}");
    let larger = plan(END, &["--planner", "tangent-graph", "--bound"]).done();
    assert!(larger.contains(" m, for the robot larger by 0.02 m (--tube)\n"), "{larger}");
    assert!(!plan(END, &["--tube", "0"]).done().contains("shorter"), "nobody asked");
}

#[test]
fn where_tangents_lead_nowhere_there_is_no_path_whatever_the_planner_says() {
    // a gap of 25.9 cm, for a rover that is planned 26 cm wide, and of 26.1 cm
    let gate = |gap: f64| {
        let half = 0.5 * gap;
        let more = format!("points: [(0, -2), (0, -{half})]), (name: \"upper\", points: [(0, {half}), (0, 2)])");
        END.replace("points: [(0, -2), (0, 0.5)])", &more)
    };
    for planner in ["tangent-graph", "potential-field"] {
        let none = plan(&gate(0.259), &["--planner", planner, "--bound", "--json", "--iterations", "2000"]);
        let answer = json(&none.out);
        assert_eq!((none.code, &answer["answer"]), (Some(7), &"none".into()), "{planner}: {answer}");
        assert!(answer.get("length_bound").is_none(), "{answer}");
        let unasked = plan(&gate(0.259), &["--planner", planner, "--iterations", "2000"]);
        assert_eq!(unasked.code, Some(4), "{} {}", unasked.out, unasked.err);
    }
    let none = plan(&gate(0.259), &["--planner", "tangent-graph", "--bound"]);
    assert!(none.err.starts_with("motion-lab: no path: no tangents and arcs lead"), "{}", none.err);
    assert!(none.err.contains("for the robot larger by 0.02 m (--tube)"), "{}", none.err);
    // through the gap, straight on
    let through = json(&plan(&gate(0.261), &["--planner", "tangent-graph", "--bound", "--json"]).done());
    assert!((through["length_bound"].as_f64().unwrap() - 2.0).abs() < 1e-7, "{through}");
    // where a planner finds none that there may be, the bound is said
    let undecided = plan(END, &["--planner", "rrt", "--iterations", "2", "--bound", "--tube", "0", "--clearance", "0"]);
    assert_eq!(undecided.code, Some(4));
    let said = format!("; no path is shorter than {:.4} m\n", (round_the_end(0.11) * 1e4).floor() / 1e4);
    assert!(undecided.err.contains(&said), "{}", undecided.err);
    // a gap that leaves less than the millimetre which a planner keeps by itself
    let kept = plan(&gate(0.2605), &["--planner", "rrt", "--iterations", "2000", "--bound", "--json"]);
    assert_eq!((kept.code, &json(&kept.out)["answer"]), (Some(4), &"undecided".into()), "{}", kept.out);
}

#[test]
fn a_path_that_is_shortened_is_shorter_and_as_proven() {
    let folder = tempfile::tempdir().unwrap();
    let of = |more: &[&str]| {
        let ask = ["plan", "--robot", "reach", "--from", "2.0,0", "--to", "3.1,0", "--seed", "7", "--json"];
        let file = ["--planner", "rrt", "-o", "path.json"];
        let answer = json(run_in(folder.path(), &[&ask[..], &file, more].concat()).done().lines().next().unwrap());
        let file = json(&fs::read_to_string(folder.path().join("path.json")).unwrap());
        // what is written is what is said, and each leg has the steps of its proof
        assert_eq!(file["legs"].as_array().unwrap().len() as u64, answer["legs"].as_u64().unwrap());
        assert!(file["legs"].as_array().unwrap().iter().all(|leg| !leg["steps"].as_array().unwrap().is_empty()));
        (answer["length"].as_f64().unwrap(), answer["clearance"].as_f64().unwrap())
    };
    let (plain, short, again) = (of(&[]), of(&["--shorten"]), of(&["--shorten"]));
    assert!(short.0 < 0.95 * plain.0 && short.1 > 0.0 && short == again, "{plain:?} {short:?} {again:?}");
    // the straight line in the joints' space
    assert!(short.0 > 1.1, "{short:?}");
    // a clearance that is asked for is kept
    assert!(of(&["--shorten", "--clearance", "0.02"]).1 > 0.02);
    // a car drives what it drives
    let car = ["plan", "--robot", "hitch", "--from", "6.5,2.5,0", "--to", "7.5,2.5,0", "--shorten"];
    let car = run(&car);
    assert!(car.code == Some(0) && car.err.contains("a car drives it as it is"), "{} {}", car.out, car.err);
}

#[test]
fn what_has_no_bound_or_no_proof_is_refused() {
    let arm = ["plan", "--robot", "reach", "--from", "2.0,0", "--to", "3.1,0"];
    for (more, words) in [
        (&["--checker", "parry", "--bound"][..], "--bound rests on proofs, and parry proves nothing"),
        (&["--checker", "parry", "--shorten"], "--shorten rests on proofs, and parry proves nothing"),
        (&["--compare", "rrt", "--shorten"], "cannot be used with"),
        (&["--compare", "rrt", "--bound"], "cannot be used with"),
    ] {
        let refused = run(&[&arm[..], more].concat());
        assert!(refused.code == Some(2) && refused.err.contains(words), "{more:?}: {} {}", refused.out, refused.err);
    }
}

#[test]
fn an_arm_s_and_a_car_s_bound_are_those_of_cells_in_the_unit_of_their_lengths() {
    let plan = |robot: &str, ends: [&str; 2], more: &[&str]| {
        run(&[&["plan", "--robot", robot, "--from", ends[0], "--to", ends[1], "--bound"], more].concat())
    };
    // nothing is in the way: the straight line, 0.5 rad of joints 3 and 4 tenths apart
    let arm = json(&plan("reach", ["1.5,0", "1.8,0.4"], &["--json"]).done());
    let (length, bound) = (arm["length"].as_f64().unwrap(), arm["length_bound"].as_f64().unwrap());
    assert!(bound <= 0.5 && bound > 0.499 && length >= 0.5, "{arm}");
    let words = plan("reach", ["1.5,0", "1.8,0.4"], &[]).done();
    assert!(words.contains("; no path is shorter than 0.49") && words.contains(" rad"), "{words}");
    // straight ahead by 5 m, of which the goal's region takes 0.1 m
    let car = json(&plan("hitch", ["4,2.5,0", "9,2.5,0"], &["--json"]).done());
    let (length, bound) = (car["length"].as_f64().unwrap(), car["length_bound"].as_f64().unwrap());
    assert!(bound <= 4.9 && bound > 4.4 && length >= bound, "{car}");
    // round the post: more than the straight 1.1 rad, and by how much the path may be longer
    let round = plan("reach", ["2.0,0", "3.1,0"], &["--planner", "rrt"]).done();
    let line = round.lines().find(|line| line.starts_with("path")).unwrap();
    let after = |words: &str| line.split(words).nth(1).unwrap().split(' ').next().unwrap().parse::<f64>().unwrap();
    let (length, bound, percent) = (after("legs, "), after("shorter than "), after("within "));
    assert!(
        bound > 1.1 && percent >= 100.0 * (length / bound - 1.0) - 0.1 && percent < 101.5 * (length / bound),
        "{line}"
    );
    assert!(percent < 100.0 * (length / bound - 1.0) + 1.1, "{line}");
    // a world whose only way is shut
    let folder = tempfile::tempdir().unwrap();
    let posts = "World(version: 1, name: \"posts\", bounds: (min: (-3, -3), max: (3, 3)), obstacles: [\
                 (name: \"up\", shape: Disc(center: (0, 0.3), radius: 0.15)), \
                 (name: \"down\", shape: Disc(center: (0, -0.3), radius: 0.15))])";
    fs::write(folder.path().join("posts.ron"), posts).unwrap();
    let ask = ["plan", "--robot", "reach3", "--world", "posts.ron", "--from", "0,0.4,-0.2", "--to", "3.1,0.2,0.3"];
    let none = run_in(folder.path(), &[&ask[..], &["--bound", "--iterations", "50"]].concat());
    assert_eq!(none.code, Some(7), "{} {}", none.out, none.err);
    assert!(
        none.err.starts_with("motion-lab: no path: cells proven blocked part the goal from the start"),
        "{}",
        none.err
    );
}
