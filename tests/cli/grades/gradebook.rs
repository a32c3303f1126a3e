//! `grade`: staying at the goal, points, ranges of seeds, folders and patterns, the gradebook, Gradescope's results.

use std::fs;
use std::path::Path;

use crate::cli::{Run, json, run, run_in};

/// An assignment to park one metre ahead in the Lot. At full speed the car is there at tick 12 and away at tick 15.
const PARK: &str = r#"Assignment(version: 1, world: "lot", robot: "Hitch", start: [6.5, 2.5, 0],
    goal: (at: [7.5, 2.5, 0], within: [0.11, 0.1, 0.1]),
    limits: (ticks: 60, contacts: 0, reversals: 1), seeds: [1, 2005])"#;

/// On to the end of the time; there the car is 4.5 m on.
const THROUGH: &str = r#"Script(version: 1, events: [(tick: 1, robot: "Hitch", input: Drive(128, 0))])"#;

fn stops_at(tick: u64) -> String {
    THROUGH.replace("])", &format!(", (tick: {tick}, robot: \"Hitch\", input: Drive(0, 0))])"))
}

fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

fn rows(folder: &Path, submissions: &[&str]) -> Vec<serde_json::Value> {
    let graded = run_in(folder, &[&["grade", "--json", "exam.ron"], submissions].concat());
    assert!(matches!(graded.code, Some(0 | 4)), "{}", graded.err);
    graded.out.lines().map(json).collect()
}

fn verdicts(folder: &Path, submissions: &[&str]) -> Vec<String> {
    let verdict = |row: &serde_json::Value| row["attempts"][0]["verdict"].as_str().unwrap().to_owned();
    rows(folder, submissions).iter().map(verdict).collect()
}

/// The texts of the help that stand between an opening word and the end of its paragraph.
fn examples(help: &str, opening: &str) -> Vec<String> {
    let starts = help.match_indices(opening).map(|(at, _)| at);
    starts.map(|at| help[at..].split("\n\n").next().unwrap().to_owned()).collect()
}

#[test]
fn the_example_of_the_help_parks_the_car_and_passes_only_when_it_stays() {
    let help = run(&["grade", "--help"]).done();
    let (assignments, scripts) = (examples(&help, "Assignment("), examples(&help, "Script("));
    assert_eq!((assignments.len(), scripts.len()), (1, 1), "{help}");
    let leaves = scripts[0].replace("])", ",\n (tick: 195, robot: \"Hitch\", input: Drive(-128, 0))])");
    let late = scripts[0].replace("tick: 1,", "tick: 173,").replace("tick: 14,", "tick: 186,");
    let late = late.replace("events: [", "events: [(tick: 1, robot: \"Hitch\", input: Drive(0, 0)),");
    let files =
        [("exam.ron", &*assignments[0]), ("park.ron", &*scripts[0]), ("leave.ron", &leaves), ("late.ron", &late)];
    let folder = folder(&[&files[..], &[("through.ron", THROUGH)]].concat());
    let graded = rows(folder.path(), &["park.ron", "leave.ron", "late.ron", "through.ron"]);
    let passed: Vec<bool> = graded.iter().map(|row| row["passed"].as_bool().unwrap()).collect();
    assert_eq!(passed, [true, false, false, false], "{graded:?}");
    assert_eq!((&graded[0]["points"], &graded[0]["max_points"]), (&10.0.into(), &10.0.into()));
    assert_eq!(graded[1]["attempts"][0]["verdict"], "left the goal");
    assert_eq!(graded[2]["attempts"][0]["verdict"], "left the goal", "there for the last 16 ticks alone");
    assert_eq!(graded[0]["attempts"].as_array().unwrap().len(), 10, "seeds 0 to 9");
}

#[test]
fn a_goal_is_held_for_its_ticks_and_at_the_end() {
    let (stops, drives_on) =
        (stops_at(14), stops_at(14).replace("])", ", (tick: 40, robot: \"Hitch\", input: Drive(128, 0))])"));
    let folder = folder(&[("through.ron", THROUGH), ("stop.ron", &stops), ("on.ron", &drives_on)]);
    let all = ["through.ron", "stop.ron", "on.ron"];
    let stay =
        |stay: &str| fs::write(folder.path().join("exam.ron"), PARK.replace("limits:", &format!("{stay} limits:")));
    // driving through, the car is there in ticks 12, 13 and 14: at 7.4, 7.475 and 7.55 m, with 0.11 m to either side;
    // driving on from 7.475 m at tick 40 it is there for the last time, at 7.55 m
    for (said, expected) in [
        ("", ["passed", "passed", "passed"]),
        ("stay: (),", ["passed", "passed", "passed"]),
        ("stay: (hold: 3),", ["passed", "passed", "passed"]),
        ("stay: (hold: 4),", ["left the goal", "passed", "passed"]),
        ("stay: (hold: 29, at: any),", ["left the goal", "passed", "passed"]),
        ("stay: (hold: 30),", ["left the goal", "passed", "left the goal"]),
        ("stay: (at: end),", ["left the goal", "passed", "left the goal"]),
        ("stay: (hold: 49, at: end),", ["left the goal", "passed", "left the goal"]),
        ("stay: (hold: 50, at: end),", ["left the goal", "left the goal", "left the goal"]),
    ] {
        stay(said).unwrap();
        assert_eq!(verdicts(folder.path(), &all), expected, "{said}");
    }
    stay("stay: (hold: 10),").unwrap();
    let row = rows(folder.path(), &["stop.ron"]).remove(0);
    assert_eq!(row["attempts"][0]["tick"], 21, "the tenth tick from the twelfth on");
    stay("stay: (at: end),").unwrap();
    let row = rows(folder.path(), &["stop.ron"]).remove(0);
    assert_eq!(row["attempts"][0]["tick"], 60, "judged at the end");
    for (said, line, reason) in [
        ("stay: (hold: 0),", 3, "stay: hold 0: it must be 1 to 60"),
        ("stay: (hold: 61),", 3, "stay: hold 61: it must be 1 to 60"),
        ("stay: (at: noon),", 3, "noon"),
        ("stay: (mood: 1),", 3, "mood"),
    ] {
        stay(said).unwrap();
        let error = run_in(folder.path(), &["grade", "exam.ron", "stop.ron"]).failed(3);
        assert!(error.contains(&format!("exam.ron:{line}:")) && error.contains(reason), "{error}");
    }
    let both = PARK.replace("0.1])", "0.1], ticks: 3)").replace("limits:", "stay: (hold: 3), limits:");
    fs::write(folder.path().join("exam.ron"), both).unwrap();
    assert!(run_in(folder.path(), &["grade", "exam.ron", "stop.ron"]).failed(3).contains("leave one of them out"));
}

#[test]
fn points_are_earned_criterion_by_criterion_and_never_for_nothing() {
    // to the west curb first, then to the goal; and back and forth on the way
    let input = |tick: u64, v: i32| format!("(tick: {tick}, robot: \"Hitch\", input: Drive({v}, 0)),");
    let script = |inputs: &[(u64, i32)]| {
        let events: String = inputs.iter().map(|(tick, v)| input(*tick, *v)).collect();
        format!("Script(version: 1, events: [{events}])")
    };
    let (crash, dither) = (script(&[(1, -128), (90, 128)]), script(&[(1, 128), (5, -128), (9, 128)]));
    let idle = script(&[(1, 0)]);
    let folder = folder(&[("crash.ron", &crash), ("dither.ron", &dither), ("idle.ron", &idle), ("ahead.ron", THROUGH)]);
    let exam = PARK
        .replace("ticks: 60", "ticks: 400")
        .replace("seeds:", "points: (goal: 5, contacts: 2, reversals: 3), seeds:");
    fs::write(folder.path().join("exam.ron"), &exam).unwrap();
    let graded = rows(folder.path(), &["ahead.ron", "crash.ron", "dither.ron", "idle.ron"]);
    let points: Vec<f64> = graded.iter().map(|row| row["points"].as_f64().unwrap()).collect();
    assert_eq!(points, [10.0, 8.0, 7.0, 0.0]);
    let verdict = |i: usize| graded[i]["attempts"][0]["verdict"].as_str().unwrap();
    assert_eq!([0, 1, 2, 3].map(verdict), ["passed", "too many contacts", "too many reversals", "missed the goal"]);
    assert!(graded.iter().skip(1).all(|row| row["passed"] == false), "points alone do not pass");
    // decided at the first contact, 6.5 m less the rear's 0.7 m from the curb at 0.075 m a tick
    let tick = graded[1]["attempts"][0]["tick"].as_u64().unwrap();
    assert!((70..=82).contains(&tick), "{tick}");
    // without points one is for passing
    fs::write(folder.path().join("exam.ron"), PARK).unwrap();
    let plain = rows(folder.path(), &["ahead.ron", "idle.ron"]);
    assert_eq!([&plain[0]["points"], &plain[1]["points"]], [1.0, 0.0]);
    for (points, reason) in [
        ("(goal: -1)", "points: -1 points"),
        ("(goal: NaN)", "points: NaN points"),
        ("(goal: 1e7)", "points: 10000000 points"),
        ("()", "points: no points for anything"),
        ("(goal: 1, style: 2)", "style"),
    ] {
        fs::write(folder.path().join("exam.ron"), PARK.replace("seeds:", &format!("points: {points}, seeds:")))
            .unwrap();
        let error = run_in(folder.path(), &["grade", "exam.ron", "idle.ron"]).failed(3);
        assert!(error.contains("exam.ron:3:") && error.contains(reason), "{points}: {error}");
    }
    for (limit, criterion) in [(", reversals: 1)", "reversals"), (", contacts: 0", "contacts")] {
        let unlimited = exam.replace(limit, if criterion == "reversals" { ")" } else { "" });
        fs::write(folder.path().join("exam.ron"), unlimited).unwrap();
        let error = run_in(folder.path(), &["grade", "exam.ron", "idle.ron"]).failed(3);
        assert!(error.contains(&format!("points: points for {criterion}, which the limits do not limit")), "{error}");
    }
}

#[test]
fn the_distance_to_the_goal_is_shown() {
    let folder = folder(&[
        ("exam.ron", PARK),
        ("stop.ron", &stops_at(5)),
        ("idle.ron", "Script(version: 1, events: [(tick: 1, robot: \"Hitch\", input: Drive(0, 0))])"),
    ]);
    let graded = rows(folder.path(), &["stop.ron", "idle.ron"]);
    // four ticks of 0.075 m of the metre
    for (row, metres) in graded.iter().zip([0.7, 1.0]) {
        let attempt = &row["attempts"][0];
        assert!((attempt["metres"].as_f64().unwrap() - metres).abs() < 1e-9, "{attempt}");
        assert_eq!((&attempt["radians"], &attempt["verdict"]), (&0.0.into(), &"missed the goal".into()));
    }
    let table = run_in(folder.path(), &["grade", "exam.ron", "stop.ron"]).out;
    assert!(table.lines().next().unwrap().ends_with("to the goal") && table.contains("0.700 m, 0.000 rad"), "{table}");
}

#[test]
fn seeds_are_ranges_too() {
    let folder = folder(&[("stop.ron", &stops_at(14))]);
    let seeds = |seeds: &str| {
        fs::write(folder.path().join("exam.ron"), PARK.replace("[1, 2005]", seeds)).unwrap();
        run_in(folder.path(), &["grade", "--json", "exam.ron", "stop.ron"])
    };
    let tried = |run: Run| {
        let row = json(&run.done());
        row["attempts"].as_array().unwrap().iter().map(|a| a["seed"].as_u64().unwrap()).collect::<Vec<_>>()
    };
    assert_eq!(tried(seeds("\"3..6, 9\"")), [3, 4, 5, 9]);
    assert_eq!(tried(seeds("[7]")), [7]);
    for (wrong, reason) in [
        ("\"6..3\"", "\"6..3\" is no seed and no range of seeds"),
        ("\"0..1000000000000\"", "seeds: 10001 seeds: there must be 1 to 10000"),
        ("[]", "seeds: 0 seeds"),
    ] {
        let error = seeds(wrong).failed(3);
        assert!(error.contains("exam.ron:3:") && error.contains(reason), "{error}");
    }
}

#[test]
fn folders_and_patterns_stand_for_submissions_and_a_missing_file_is_one_row() {
    let folder = folder(&[
        ("work/exam.ron", PARK),
        ("work/b.ron", &stops_at(14)),
        ("work/anna/a.ron", THROUGH),
        ("work/table.csv", "tick,robot,input\n1,Hitch,Drive,128,0\n"),
        ("work/notes.txt", "not a submission"),
        ("empty/notes.txt", "none here"),
    ]);
    let graded =
        |submissions: &[&str]| run_in(folder.path(), &[&["grade", "--json", "work/exam.ron"], submissions].concat());
    let names = |run: &Run| {
        let name = |line: &str| json(line)["submission"].as_str().unwrap().replace('\\', "/");
        run.out.lines().map(name).collect::<Vec<_>>()
    };
    let all = graded(&["work"]);
    assert_eq!(names(&all), ["work/anna/a.ron", "work/b.ron", "work/table.csv"], "not the assignment");
    assert_eq!(all.code, Some(4));
    let table = json(all.out.lines().nth(2).unwrap());
    let refused = table["refused"].as_str().unwrap().replace('\\', "/");
    assert!(refused.contains("motion-lab script convert work/table.csv -o work/table.ron"), "{refused}");
    assert_eq!(names(&graded(&["work/*.ron"])), ["work/b.ron"]);
    assert_eq!(names(&graded(&["w?rk/a*a/*", "work/b.ron"])), ["work/anna/a.ron", "work/b.ron"]);

    let missing = graded(&["nobody.ron", "work/b.ron", "empty", "work/*.mcap"]);
    assert_eq!(missing.code, Some(3), "{}", missing.err);
    assert!(missing.err.contains("nobody.ron: there is no such file"), "{}", missing.err);
    assert_eq!(names(&missing), ["nobody.ron", "work/b.ron", "empty", "work/*.mcap"]);
    let rows: Vec<serde_json::Value> = missing.out.lines().map(json).collect();
    assert_eq!(rows.iter().map(|row| &row["passed"]).collect::<Vec<_>>(), [false, true, false, false]);
    let reason = |row: usize| rows[row]["refused"].as_str().unwrap();
    assert_eq!([reason(0), reason(3)], ["there is no such file"; 2]);
    assert_eq!(reason(2), "no script, log, page or table is in this folder");
    assert_eq!((&rows[0]["points"], &rows[0]["max_points"]), (&serde_json::Value::Null, &1.0.into()));
}

#[test]
fn a_gradebook_has_a_row_for_each_submission() {
    let exam = PARK.replace("seeds:", "points: (goal: 5, contacts: 2), seeds:");
    let files = [("exam.ron", &*exam), ("a, b.ron", &*stops_at(14)), ("=away.ron", &*stops_at(5))];
    let folder = folder(&files.map(|(name, text)| (name, text)));
    let arguments = ["grade", "--csv", "exam.ron", "a, b.ron", "=away.ron", "nobody.ron"];
    let book = run_in(folder.path(), &arguments).out;
    let lines: Vec<&str> = book.lines().collect();
    assert_eq!(
        lines,
        [
            "submission,passed,points,max_points,seeds_passed,seeds,seed,verdict,tick,contacts,reversals,metres,radians,refused,same_as",
            "\"a, b.ron\",true,7,7,2,2,1,passed,12,0,0,0.1000,0.0000,,",
            "'=away.ron,false,0,7,0,2,1,missed the goal,60,0,0,0.7000,0.0000,,",
            "nobody.ron,false,,7,0,2,,,,,,,,not graded: there is no such file,",
        ]
    );
    let columns = |line: &str| line.replace("a, b", "a").split(',').count();
    assert!(lines.iter().all(|line| columns(line) == 15), "{book}");
    assert_eq!(run_in(folder.path(), &[&["grade", "--format", "csv"], &arguments[2..]].concat()).out, book);
    run_in(folder.path(), &["grade", "--csv", "--json", "exam.ron", "a, b.ron"]).failed(2);
}

#[test]
fn inputs_that_were_handed_in_twice_are_named() {
    let files =
        [("exam.ron", PARK), ("ann.ron", &*stops_at(14)), ("ben.ron", &*stops_at(13)), ("cy.ron", &*stops_at(14))];
    let folder = folder(&files);
    // a log of the same inputs is no other work, and spaces in a script are none
    run_in(folder.path(), &["record", "--world", "lot", "--script", "ann.ron", "--ticks", "60", "-o", "dan.mcap"])
        .done();
    std::fs::write(folder.path().join("eve.ron"), stops_at(14).replace(", ", ",  ")).unwrap();
    let book =
        run_in(folder.path(), &["grade", "--csv", "exam.ron", "ann.ron", "ben.ron", "cy.ron", "dan.mcap", "eve.ron"])
            .out;
    let same: Vec<&str> = book.lines().skip(1).filter_map(|line| line.rsplit(',').next()).collect();
    assert_eq!(same, ["", "", "ann.ron", "ann.ron", "ann.ron"], "{book}");
    let table = run_in(folder.path(), &["grade", "exam.ron", "ann.ron", "cy.ron"]).out;
    assert_eq!(table.matches("the same inputs as ann.ron").count(), 1, "{table}");
}

/// Gradescope's autograder specification: `score`, `output`, `tests`; of a test `name`, `score`, `max_score`, `status`,
/// `output`.
#[test]
fn gradescope_gets_its_results() {
    let exam = PARK.replace("seeds:", "points: (goal: 5, contacts: 2), seeds:");
    let folder = folder(&[("exam.ron", &exam), ("good.ron", &stops_at(14)), ("idle.ron", &stops_at(2))]);
    let results = |submission: &str| {
        let graded = run_in(folder.path(), &["grade", "--format", "gradescope", "exam.ron", submission]);
        (graded.code, json(&graded.out))
    };
    for (submission, code, score) in [("good.ron", 0, 7.0), ("idle.ron", 4, 0.0)] {
        let (ended, results) = results(submission);
        assert_eq!((ended, results["score"].as_f64()), (Some(code), Some(score)), "{submission}");
        let tests = results["tests"].as_array().unwrap();
        let of = |key: &str| tests.iter().map(|test| test[key].clone()).collect::<Vec<_>>();
        assert_eq!(of("max_score"), [5.0, 2.0], "{submission}");
        assert_eq!(of("score").iter().map(|s| s.as_f64().unwrap()).sum::<f64>(), score);
        assert_eq!(of("status"), [if score > 0.0 { "passed" } else { "failed" }; 2]);
        assert!(
            of("name").iter().chain(&of("output")).all(serde_json::Value::is_string) && results["output"].is_string()
        );
        // no other keys, which Gradescope would refuse or ignore
        let keys: Vec<&String> = results.as_object().unwrap().keys().collect();
        assert_eq!(keys, ["output", "score", "tests"]);
    }
    // a score of 0 would be a verdict
    let (ended, nobody) = results("nobody.ron");
    assert_eq!((ended, nobody["tests"].as_array().unwrap().len()), (Some(3), 0));
    assert_eq!(nobody["output"], "not graded: there is no such file");
    assert!(nobody.get("score").is_none(), "{nobody}");
    let many =
        run_in(folder.path(), &["grade", "--format", "gradescope", "exam.ron", "good.ron", "idle.ron"]).failed(2);
    assert!(many.contains("2 submissions"), "{many}");
}

/// Whoever names a file may not write a row, a column or a formula of the gradebook.
#[cfg(unix)]
#[test]
fn the_name_of_a_file_is_one_cell_of_the_gradebook_whatever_is_in_it() {
    let names =
        ["=cmd()|calc.ron", "\u{ff1d}1+1.ron", "a,b;\"c\".ron", "x\nbob.ron     1  passed.ron", "l\u{2028}m.ron"];
    // each of them drives through, with a stop of its own: none is another's work
    let scripts: Vec<String> = (20..).take(names.len()).map(stops_at).collect();
    let files = names.iter().copied().zip(scripts.iter().map(String::as_str));
    let folder = folder(&files.chain([("exam.ron", PARK)]).collect::<Vec<_>>());
    let grade =
        |form: &str| run_in(folder.path(), &[&["grade", "--format", form, "exam.ron"], &names[..]].concat()).out;
    let csv = grade("csv");
    // by RFC 4180: what begins with a quote ends at the next single one
    let rows: Vec<&str> = csv.split(",true,1,1,").map(|row| row.rsplit("same_as\n").next().unwrap()).collect();
    let cell = |row: &str| row.rsplit_once(",\n").map_or(row.to_owned(), |(_, name)| name.to_owned());
    let cells: Vec<String> = rows[..names.len()].iter().map(|row| cell(row)).collect();
    let expected = [
        "'=cmd()|calc.ron",
        "'\u{ff1d}1+1.ron",
        "\"a,b;\"\"c\"\".ron\"",
        "\"x\nbob.ron     1  passed.ron\"",
        "\"l\u{2028}m.ron\"",
    ];
    assert_eq!(cells, expected, "{csv}");
    let table = grade("table");
    assert_eq!(table.lines().count(), 1 + 2 * names.len() + 1, "a line for each seed of each file\n{table}");
    assert!(table.contains("x\\u{a}bob.ron     1  passed.ron  ") && table.contains("l\\u{2028}m.ron "), "{table}");
    let json: Vec<serde_json::Value> = grade("json").lines().map(json).collect();
    assert_eq!(json.iter().map(|row| row["submission"].as_str().unwrap()).collect::<Vec<_>>(), names);
}
