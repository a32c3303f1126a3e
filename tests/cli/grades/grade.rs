//! `grade`: submissions that pass, that fail and that are forged.

use std::fs;
use std::path::Path;

use base64::prelude::{BASE64_STANDARD, Engine};
use motion_lab::run::Log;

use crate::cli::{Run, json, run_in, sealed};

/// An assignment to drive one metre ahead in the Lot, where Hitch has 5 m of free aisle before it.
const ASSIGNMENT: &str = r#"Assignment(
    version: 1,
    world: "lot",
    robot: "Hitch",
    start: [6.5, 2.5, 0],
    goal: (at: [7.5, 2.5, 0], within: [0.1, 0.1, 0.1]),
    limits: (ticks: 200, contacts: 0, reversals: 1),
    seeds: [1, 2005],
)
"#;

fn script(events: &[(u64, &str)]) -> String {
    let events: Vec<String> =
        events.iter().map(|(tick, input)| format!("(tick: {tick}, robot: \"Hitch\", input: {input}),\n")).collect();
    format!("Script(version: 1, events: [\n{}])", events.concat())
}

#[test]
fn a_world_that_an_assignment_names_and_nobody_knows_has_its_place_in_the_assignment() {
    let folder = folder(&[("ann.ron", script(&[]))]);
    fs::write(folder.path().join("exam.ron"), ASSIGNMENT.replace("\"lot\"", "\"lott\"")).unwrap();
    let refused = run_in(folder.path(), &["grade", "exam.ron", "ann.ron"]).failed(3);
    assert!(refused.contains("exam.ron:3:12: lott: no built-in world has this name"), "{refused}");
    assert!(refused.contains("Did you mean \"lot\"?"), "{refused}");
    // a world file of another folder says where it is wrong, and who names it
    fs::write(folder.path().join("lott"), "World(version: 1, name: 3)").unwrap();
    let refused = run_in(folder.path(), &["grade", "exam.ron", "ann.ron"]).failed(3);
    assert!(refused.contains("exam.ron:3:12: lott:1:"), "{refused}");
}

fn graded(folder: &Path, submissions: &[&str]) -> Run {
    run_in(folder, &[&["grade", "--json", "exam.ron"], submissions].concat())
}

fn folder(files: &[(&str, String)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("exam.ron"), ASSIGNMENT).unwrap();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

#[test]
fn scripts_pass_miss_touch_and_turn_round() {
    let folder = folder(&[
        ("ahead.ron", script(&[(1, "Drive(128, 0)")])),
        // away from the goal until the west curb holds it: 6.5 m less the car's rear, well over 200 ticks of creeping
        ("away.ron", script(&[(1, "Drive(-16, 0)")])),
        // to the curb first, at full speed
        ("crash.ron", script(&[(1, "Drive(-128, 0)"), (150, "Drive(128, 0)")])),
        // back, ahead, back
        (
            "dither.ron",
            script(&[(1, "Drive(-64, 0)"), (11, "Drive(64, 0)"), (21, "Drive(-64, 0)"), (31, "Drive(64, 0)")]),
        ),
        (
            "demolition.ron",
            script(&[(1, "Drive(128, 0)")])
                .replace("version: 1", "version: 2")
                .replace("])", "], changes: [(tick: 1, world: \"Lot\", change: Remove(\"the west pillar\"))])"),
        ),
        ("jump.ron", script(&[(1, "Drive(0, 0)"), (2, "Teleport([7864320, 2621440, 0])")])),
        ("stranger.ron", script(&[(1, "Release")]).replace("Hitch", "Rusty")),
        ("broken.ron", "Script(version: 1,\nevents: [(tick: 0)])".into()),
    ]);
    let passed = graded(folder.path(), &["ahead.ron"]).done();
    let passed = json(&passed);
    assert_eq!(passed["passed"], true);
    let attempts = passed["attempts"].as_array().unwrap();
    assert_eq!(attempts.iter().map(|a| a["seed"].as_u64().unwrap()).collect::<Vec<_>>(), [1, 2005]);
    for attempt in attempts {
        let x = attempt["configuration"][0].as_f64().unwrap();
        assert!((7.4..=7.6).contains(&x), "decided at the tick it arrives: {attempt}");
        assert_eq!((&attempt["contacts"], &attempt["reversals"]), (&0.into(), &0.into()));
    }

    let files = ["away.ron", "crash.ron", "dither.ron", "jump.ron", "stranger.ron", "broken.ron", "ahead.ron"];
    let all = graded(folder.path(), &files);
    assert_eq!(all.code, Some(4), "{}", all.err);
    let rows: Vec<serde_json::Value> = all.out.lines().map(json).collect();
    assert_eq!(rows.len(), files.len());
    for (row, verdict) in rows.iter().zip(["missed the goal", "too many contacts", "too many reversals"]) {
        assert_eq!(row["attempts"][0]["verdict"], verdict, "{row}");
        assert_eq!(row["passed"], false);
    }
    assert_eq!(rows[0]["attempts"][0]["tick"], 200, "all its time");
    assert_eq!(rows[1]["attempts"][0]["contacts"], 1, "decided at the first one too many");
    assert_eq!(rows[2]["attempts"][0]["reversals"], 2);
    for (row, reason) in
        rows[3..6].iter().zip(["events[1]: a teleport", "no robot \"Rusty\"", "broken.ron:2: events[0]"])
    {
        assert!(row["refused"].as_str().unwrap().contains(reason), "{row}");
        assert!(row["passed"] == false && row["attempts"].as_array().unwrap().is_empty());
    }
    assert_eq!(rows[6]["passed"], true);

    let cheat = graded(folder.path(), &["demolition.ron"]);
    assert!(
        cheat.code == Some(4) && cheat.out.contains("changes[0]: a change of a world is not allowed"),
        "{}",
        cheat.out
    );
    let table = run_in(folder.path(), &["grade", "exam.ron", "ahead.ron", "jump.ron"]);
    assert_eq!(table.code, Some(4));
    let lines: Vec<&str> = table.out.lines().collect();
    assert!(lines[1].starts_with("ahead.ron        1  passed             "), "{}", table.out);
    assert!(lines[3].contains("events[1]: a teleport is not allowed") && lines[4] == "1 of 2 pass", "{}", table.out);
}

#[test]
fn a_world_file_is_found_beside_the_assignment() {
    let folder = folder(&[("ahead.ron", script(&[(1, "Drive(128, 0)")]))]);
    fs::create_dir(folder.path().join("week 3")).unwrap();
    let text = run_in(folder.path(), &["world", "show", "lot"]).done();
    fs::write(folder.path().join("week 3/yard.ron"), text).unwrap();
    fs::write(folder.path().join("week 3/exam.ron"), ASSIGNMENT.replace("\"lot\"", "\"yard.ron\"")).unwrap();
    let table = run_in(folder.path(), &["grade", "week 3/exam.ron", "ahead.ron"]).done();
    assert!(table.ends_with("1 of 1 pass\n"), "{table}");
}

#[test]
fn a_goal_may_have_to_be_held() {
    let folder = folder(&[
        ("through.ron", script(&[(1, "Drive(128, 0)")])),
        ("stop.ron", script(&[(1, "Drive(128, 0)"), (13, "Drive(0, 0)")])),
    ]);
    // at full speed the car is within 0.1 m of the goal for less than five ticks
    fs::write(folder.path().join("exam.ron"), ASSIGNMENT.replace("0.1])", "0.1], ticks: 5)")).unwrap();
    let rows = graded(folder.path(), &["through.ron", "stop.ron"]).out;
    let rows: Vec<serde_json::Value> = rows.lines().map(json).collect();
    assert_eq!(rows[0]["attempts"][0]["verdict"], "too many contacts", "on to the east curb");
    assert_eq!(
        (&rows[1]["passed"], &rows[1]["attempts"][0]["tick"]),
        (&true.into(), &16.into()),
        "at it from tick 12 on"
    );
}

fn record(folder: &Path) -> Log {
    let arguments = ["record", "--world", "lot", "--robot", "Hitch=hitch:6.5,2.5,0", "--ticks", "80", "--seed", "9"];
    run_in(folder, &[&arguments[..], &["--script", "ahead.ron", "-o", "run.mcap"]].concat()).done();
    Log::read_mcap(&fs::read(folder.join("run.mcap")).unwrap()).unwrap().log
}

fn seal(log: &Log) -> Vec<u8> {
    sealed(log)
}

#[test]
fn a_log_passes_when_its_script_does_and_a_forged_one_never() {
    let folder = folder(&[("ahead.ron", script(&[(1, "Drive(128, 0)")]))]);
    let log = record(folder.path());
    let passed = json(&graded(folder.path(), &["run.mcap"]).done());
    assert_eq!(passed["attempts"][1]["seed"], 2005, "at the assignment's seeds, not at its own");

    // forged by one unit in the last place, with right seals
    let mut forged = log.clone();
    let x = &mut forged.frames_mut()[40].robots[0].configuration[0];
    *x = f64::from_bits(x.to_bits() + 1);
    let x = *x;
    fs::write(folder.path().join("forged.mcap"), seal(&forged)).unwrap();
    let refused = graded(folder.path(), &["forged.mcap", "run.mcap"]);
    assert_eq!(refused.code, Some(4));
    let row = json(refused.out.lines().next().unwrap());
    assert_eq!(row["forged_at"], 41);
    let reason = row["refused"].as_str().unwrap();
    assert!(
        reason.starts_with("forged at tick 41, robot 0, configuration[0]: expected ")
            && reason.ends_with("1 ulp apart")
    );
    assert!(row["attempts"].as_array().unwrap().is_empty());
    // what is expected and what is found is said as `verify` says it
    let verified = run_in(folder.path(), &["verify", "forged.mcap"]);
    assert_eq!(verified.code, Some(4));
    let said = verified.out.lines().next().unwrap();
    assert!(said.contains(&format!("expected {x:?}")), "{said}");
    assert_eq!(reason, format!("forged at {said}"));

    // with settings that change no frame, and a digest of its own: the honest one settles it
    let mut bounds = log.clone();
    std::sync::Arc::make_mut(&mut bounds.recipe.config).ticks -= 1;
    let bounds = Log::with_frames(
        bounds.recipe,
        log.initial().unwrap().clone(),
        log.frames()[..log.frames().len() - 1].to_vec(),
    );
    fs::write(folder.path().join("shorter.mcap"), seal(&bounds)).unwrap();
    assert_eq!(graded(folder.path(), &["shorter.mcap"]).code, Some(0));
    let digest = log.digest().unwrap().to_string();
    let strict = graded(folder.path(), &["--expect", &digest, "run.mcap", "shorter.mcap", "ahead.ron"]);
    let rows: Vec<serde_json::Value> = strict.out.lines().map(json).collect();
    assert_eq!((strict.code, &rows[0]["passed"]), (Some(4), &true.into()));
    let held = bounds.digest().unwrap();
    let reason = rows[1]["refused"].as_str().unwrap();
    assert!(reason.starts_with(&format!("the run digest is {held}, expected {digest}: ")), "{reason}");
    assert_eq!(rows[2]["refused"], "no log: --expect asks for one with this run digest");

    // as a page that holds it
    let page = format!(
        "<!doctype html><script type=\"text/plain\" id=\"bytes\">{}</script>",
        BASE64_STANDARD.encode(seal(&log))
    );
    fs::write(folder.path().join("run.html"), page).unwrap();
    assert_eq!(json(&graded(folder.path(), &["run.html"]).done())["points"], passed["points"]);

    // cut, and not sealed
    let bytes = seal(&log);
    fs::write(folder.path().join("cut.mcap"), &bytes[..bytes.len() - 2000]).unwrap();
    let cut = json(&graded(folder.path(), &["cut.mcap"]).out);
    assert!(cut["refused"].as_str().unwrap().contains("cut off"), "{cut}");
    assert!(cut["points"].is_null(), "what can't be read is not graded: {cut}");

    // an honest run from another start
    let arguments =
        ["record", "--world", "lot", "--ticks", "5", "--robot", "Hitch=hitch:6.6,2.5,0", "-o", "other.mcap"];
    run_in(folder.path(), &arguments).done();
    let other = json(&graded(folder.path(), &["other.mcap"]).out);
    assert!(other["refused"].as_str().unwrap().contains("another world"), "{other}");
}

#[test]
fn a_wrong_assignment_is_3_and_names_line_column_and_item() {
    let folder = folder(&[("ahead.ron", script(&[]))]);
    let refuse = |from: &str, to: &str| {
        assert!(ASSIGNMENT.contains(from), "{from}");
        fs::write(folder.path().join("exam.ron"), ASSIGNMENT.replacen(from, to, 1)).unwrap();
        graded(folder.path(), &["ahead.ron"]).failed(3)
    };
    let unknown = refuse("contacts: 0,", "contacts: 0, mood: 3,");
    assert!(
        unknown.contains("exam.ron:7:39: ") && unknown.contains("mood") && unknown.contains("reversals"),
        "{unknown}"
    );
    assert!(refuse("    seeds:", "    grade: 3,\n    seeds:").contains("exam.ron:8:5: "));
    assert!(refuse("version: 1", "version: 2").contains("exam.ron:2:14: version: version 2"));
    assert!(
        refuse("\"Hitch\"", "\"Rusty\"")
            .contains("exam.ron:4:12: robot: there is no robot \"Rusty\" in the world; it has Hitch")
    );
    assert!(refuse("[6.5, 2.5, 0]", "[6.5, 2.5]").contains("exam.ron:5:12: start: no configuration"));
    assert!(
        refuse("[6.5, 2.5, 0]", "[0.1, 2.5, 0]")
            .contains("exam.ron:5:12: start: there the robot touches the west curb")
    );
    assert!(
        refuse("at: [7.5, 2.5, 0]", "at: [15.9, 2.5, 0]")
            .contains("exam.ron:6:11: goal: there the robot touches the east curb")
    );
    assert!(refuse("[0.1, 0.1, 0.1]", "[0.1, 0.1]").contains("exam.ron:6:11: goal: 3 coordinates, 2 tolerances"));
    assert!(refuse("[0.1, 0.1, 0.1]", "[0.1, -0.1, 0.1]").contains("exam.ron:6:11: goal: tolerance -0.1"));
    assert!(refuse("[0.1, 0.1, 0.1]", "[0.1, NaN, 0.1]").contains("exam.ron:6:11: goal: tolerance NaN"));
    assert!(refuse("at: [7.5, 2.5, 0]", "at: [inf, 2.5, 0]").contains("exam.ron:6:11: goal: no configuration"));
    for far in ["10001", "1e300"] {
        let error = refuse("at: [7.5, 2.5, 0]", &format!("at: [{far}, 2.5, 0]"));
        assert!(error.contains("exam.ron:6:11: goal: ") && error.contains("10000 m"), "no car can be there: {error}");
    }
    assert!(refuse("ticks: 200", "ticks: 0").contains("exam.ron:7:13: limits: 0 ticks"));
    assert!(refuse("[1, 2005]", "[]").contains("exam.ron:8:12: seeds: 0 seeds"));
    assert!(refuse("[1, 2005]", "(0, 10)").contains("exam.ron:8:12: seeds: in parentheses they are neither a list"));
    assert!(refuse("\"lot\"", "\"nowhere.ron\"").contains("nowhere.ron: no built-in world"));
    fs::write(folder.path().join("exam.ron"), ASSIGNMENT).unwrap();
    assert!(graded(folder.path(), &["nobody.ron"]).failed(3).contains("nobody.ron: there is no such file"));
}

#[test]
fn what_an_assignment_asks_for_is_told_to_pages_that_judge_by_it() {
    let folder = folder(&[]);
    let arm = ASSIGNMENT.replace("\"lot\"", "\"workbench\"").replace("\"Hitch\"", "\"Reach\"");
    let arm = arm.replace("[6.5, 2.5, 0]", "[\"90deg\", 0.5]").replace("[7.5, 2.5, 0]", "[\"180deg\", 0]");
    let arm =
        arm.replace("within: [0.1, 0.1, 0.1]", "within: [0.1, \"1deg\"]").replace("contacts: 0, reversals: 1", "");
    fs::write(folder.path().join("arm.ron"), arm.replace("limits:", "stay: (hold: 7), limits:")).unwrap();
    let told = json(&run_in(folder.path(), &["describe", "exam.ron", "arm.ron"]).done())["assignments"].take();
    let turn = std::f64::consts::PI;
    let expected = serde_json::json!([
        {
            "id": "exam", "world": "lot", "robot": "Hitch", "at": [7.5, 2.5, 0.0], "within": [0.1, 0.1, 0.1],
            "names": ["x", "y", "\u{3b8}"], "is_angle": [false, false, true], "hold": 1, "ticks": 200, "seconds": 10.0, "contacts": 0,
            "script": "Script(version:1,events:[(tick:1,robot:\"Hitch\",input:Drive(0,0)),])",
        },
        {
            "id": "arm", "world": "workbench", "robot": "Reach", "at": [turn, 0.0], "within": [0.1, turn / 180.0],
            "names": ["\u{3b8}\u{2081}", "\u{3b8}\u{2082}"], "is_angle": [true, true], "hold": 7, "ticks": 200, "seconds": 10.0, "contacts": null,
            // in units of 2^-20 rad
            "script": "Script(version:1,events:[(tick:1,robot:\"Reach\",input:MoveTo([1647099,524288])),])",
        },
    ]);
    assert_eq!(told, expected);
    assert_eq!(json(&run_in(folder.path(), &["describe"]).done())["assignments"], serde_json::json!([]));
    let refused = run_in(folder.path(), &["describe", "exam.ron", "none.ron"]).failed(3);
    assert!(refused.contains("none.ron"), "{refused}");
}
