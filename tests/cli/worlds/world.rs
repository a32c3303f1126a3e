//! `world`: the built-in worlds, and the faults of files.

use std::fs;

use crate::cli::{json, run, run_in};

#[test]
fn the_built_in_worlds_are_listed_and_shown_as_files() {
    let folder = tempfile::tempdir().unwrap();
    let list = run(&["world", "list", "--json"]).done();
    let names: Vec<String> = list.lines().map(|l| json(l)["source"].as_str().unwrap().to_owned()).collect();
    assert_eq!(names, ["apartment", "workbench", "lot"]);
    for line in list.lines() {
        let world = json(line);
        let file = folder.path().join(format!("{}.ron", world["source"].as_str().unwrap()));
        let shown = run(&["world", "show", world["source"].as_str().unwrap()]).done();
        fs::write(&file, &shown).unwrap();
        let file = file.to_str().unwrap();
        let checked = json(&run(&["world", "check", "--json", file]).done());
        assert_eq!(checked["content_hash"], world["content_hash"], "the file is the world");
        assert_eq!(run(&["world", "show", file]).done(), shown);
    }
}

#[test]
fn every_wrong_file_is_named_and_the_right_ones_are_listed() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let right = file("right.ron", run(&["world", "show", "lot"]).done().as_bytes());
    let small = "World(version: 1, name: \"w\", bounds: (min: (0, 0), max: (4, 3)),\n\
                 obstacles: [\n(name: \"the tree\", shape: Disc(center: (1, 1), radius: 0))])";
    let item = file("item.ron", small.as_bytes());
    let syntax = file("syntax.ron", b"World(\n  version: 1,\n  nome: 3)");
    let bytes = file("bytes.ron", b"World(\n\xff)");
    let huge = folder.path().join("huge.ron");
    fs::File::create(&huge).unwrap().set_len((64 << 20) + 1).unwrap();
    let huge = huge.to_str().unwrap().to_owned();
    let folder_name = folder.path().to_str().unwrap();

    let checked = run(&["world", "check", &item, &right, &syntax, &bytes, &huge, folder_name]);
    assert_eq!(checked.code, Some(3));
    assert_eq!(checked.out.lines().count(), 1);
    assert!(checked.out.starts_with(&format!("{right}: Lot, ")), "{}", checked.out);
    for message in [
        format!("{item}:3:1: obstacles[0] \"the tree\": radius 0 m"),
        format!("{syntax}:3:"),
        format!("{bytes}: not UTF-8: byte 7 (line 2)"),
        format!("{huge}: too large"),
        format!("{folder_name}: it is a folder"),
    ] {
        assert!(checked.err.contains(&message), "{message} is missing from\n{}", checked.err);
    }
}

/// A world of 8 m by 6 m with these robots and obstacles.
fn yard(robots: &str, obstacles: &str) -> String {
    format!(
        "World(version: 1, name: \"Yard\", bounds: (min: (0, 0), max: (8, 6)), obstacles: [{obstacles}], robots: [{robots}])"
    )
}

#[test]
fn residents_in_contact_and_obstacles_out_of_sight_are_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("yard.ron");
    let file = path.to_str().unwrap();
    let checked = |robots: &str, obstacles: &str| {
        fs::write(&path, yard(robots, obstacles)).unwrap();
        run(&["world", "check", file])
    };
    let tree = "(name: \"the tree\", shape: Disc(center: (2, 3), radius: 0.5))";
    let (anna, bert) = ("(name: \"Anna\", kind: \"rusty\", start: [3, 3, 0])", |x: &str| {
        format!("(name: \"Bert\", kind: \"rusty\", start: [{x}, 3, 0])")
    });
    // discs of radius 0.11 touch at a centre distance of 0.22 or less
    assert_eq!(checked(&format!("{anna}, {}", bert("3.25")), tree).code, Some(0));
    let touching = checked(&format!("{anna}, {}", bert("3.21875")), tree).failed(3);
    assert!(touching.contains(&format!("{file}: \"Anna\" and \"Bert\" touch")), "{touching}");
    // their boxes overlap, but they are 0.24 m apart, and 0.097 m from the tree
    let aside = bert("3.171875").replace(", 3, 0]", ", 3.171875, 0]");
    let off_the_tree = "(name: \"Cleo\", kind: \"rusty\", start: [2.5, 3.5, 0])";
    assert_eq!(checked(&format!("{anna}, {aside}, {off_the_tree}"), tree).code, Some(0));
    // the tree reaches to x = 2.5, and a rover reaches 0.11 m from its centre
    let inside = checked(&format!("{anna}, {}", bert("2.59375")), tree).failed(3);
    assert!(inside.contains("\"Bert\" starts in contact with \"the tree\"") && !inside.contains("Anna"), "{inside}");
    let both = checked(&format!("{anna}, {}, {}", bert("3.1"), bert("2.5").replace("Bert", "Cleo")), tree).failed(3);
    assert!(both.contains("Anna") && both.contains("Bert") && both.contains("Cleo"), "{both}");

    let far = "(name: \"the moon\", shape: Disc(center: (9, 3), radius: 0.5))";
    let outside = checked(anna, &format!("{tree}, {far}")).failed(3);
    assert!(outside.contains("\"the moon\" lies outside the bounds") && !outside.contains("tree"), "{outside}");
    let edge = "(name: \"the hedge\", shape: Disc(center: (8.5, 3), radius: 0.5))"; // reaches in by a point
    assert_eq!(checked(anna, edge).code, Some(0));

    let empty = checked("", tree);
    assert!(empty.code == Some(0) && empty.err.contains("no robot lives there"), "{}", empty.err);
    for world in ["apartment", "workbench", "lot"] {
        fs::write(&path, run(&["world", "show", world]).done()).unwrap();
        let built_in = run(&["world", "check", file]);
        assert!(built_in.code == Some(0) && built_in.err.is_empty(), "{world}: {}", built_in.err);
    }
}

/// Names may hold characters that reverse a line, and scripts may hold anything. No terminal gets them raw.
#[test]
fn texts_of_files_do_not_steer_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("yard.ron");
    let name = "Ann\u{202e}a";
    fs::write(&path, yard(&format!("(name: \"{name}\", kind: \"rusty\", start: [3, 3, 0])"), "")).unwrap();
    let listed = run(&["world", "check", path.to_str().unwrap()]).done();
    assert!(listed.contains("Ann\\u{202e}a") && !listed.contains('\u{202e}'), "{listed}");
    let as_json = run(&["world", "check", "--json", path.to_str().unwrap()]).done();
    assert_eq!(json(&as_json)["robots"][0], name, "JSON is data, and stays as it is");

    // data for other programs stays as it is, on standard output as in a file
    run_in(folder.path(), &["record", "--ticks", "2", "--world", "yard.ron", "-o", "run.mcap"]).done();
    for format in ["jsonl", "csv"] {
        let shown = run_in(folder.path(), &["export", "run.mcap", "--format", format]).done();
        run_in(folder.path(), &["export", "run.mcap", "--format", format, "-o", "data"]).done();
        assert_eq!(shown, fs::read_to_string(folder.path().join("data")).unwrap(), "{format}");
        assert!(shown.contains(name), "{format} names the robot: {shown}");
    }

    let script = folder.path().join("script.ron");
    let text = "Script(version: 1, events: [(tick: 1, robot: \"\\u{1b}[2JRusty\", input: Release)])";
    fs::write(&script, text).unwrap();
    let error = run(&["record", "--ticks", "2", "--script", script.to_str().unwrap()]).failed(3);
    assert!(error.contains("[2JRusty") && !error.contains('\u{1b}'), "{error:?}");
}

/// A pairwise check would take five thousand million comparisons.
#[test]
fn a_hundred_thousand_residents_in_a_row_are_checked_at_once() {
    use std::fmt::Write as _;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("row.ron");
    for (axis, other) in [("x", "y"), ("y", "x")] {
        let mut robots = String::new();
        for i in 0..100_000 {
            let at = f64::from(i) * 0.25 - 9_999.0;
            // two columns, so that the coordinates stay within the lab's limits
            let (along, across) = if at < 9_999.0 { (at, 0) } else { (at - 19_998.0, 1) };
            let place = if axis == "x" { format!("{along}, {across}") } else { format!("{across}, {along}") };
            writeln!(robots, "(name: \"{i}\", kind: \"rusty\", start: [{place}, 0]),").unwrap();
        }
        let world = |robots: &str| {
            format!(
                "World(version: 1, name: \"Row\", bounds: (min: (-10000, -10000), max: (10000, 10000)), robots: [{robots}])"
            )
        };
        fs::write(&path, world(&robots)).unwrap();
        assert_eq!(run(&["world", "check", path.to_str().unwrap()]).code, Some(0), "along {axis}, not {other}");
        let touching = robots.replacen("start: [-9998.75, 0", "start: [-9998.875, 0", 1).replacen(
            "start: [0, -9998.75",
            "start: [0, -9998.875",
            1,
        );
        fs::write(&path, world(&touching)).unwrap();
        let error = run(&["world", "check", path.to_str().unwrap()]).failed(3);
        assert!(error.contains("\"0\" and \"1\" touch"), "along {axis}: {error}");
    }
}

#[test]
fn a_warehouse_is_generated_checked_and_recorded() {
    let folder = tempfile::tempdir().unwrap();
    let generate = ["world", "generate", "warehouse", "--seed", "3", "--robots", "30"];
    let made = run_in(folder.path(), &[&generate[..], &["-o", "hall.ron"]].concat());
    assert!(made.err.contains("wrote hall.ron with 30 robots, "), "{}", made.err);
    let text = fs::read_to_string(folder.path().join("hall.ron")).unwrap();
    assert_eq!(run(&generate).done(), text, "the same on standard output");
    assert_ne!(run(&[&generate[..], &["--trailers"]].concat()).done(), text);
    let checked = run_in(folder.path(), &["world", "check", "hall.ron"]).done();
    assert!(checked.starts_with("hall.ron: Warehouse of 30, seed 3, content ") && checked.ends_with("robots: 30\n"));
    let record = ["record", "--world", "hall.ron", "--seconds", "1", "--no-sensor", "-o", "run.mcap"];
    run_in(folder.path(), &record).done();
    run_in(folder.path(), &["verify", "run.mcap"]).done();
    let few = run(&["world", "generate", "warehouse", "--robots", "9"]);
    assert_eq!(few.code, Some(2), "{}", few.err);
    assert!(few.err.contains("--robots: 9 robots: a warehouse has 10 to 100000"), "{}", few.err);
}

#[test]
fn robots_of_a_crowd_are_printed_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    for (robots, lines) in [("100", 102), ("101", 2)] {
        let generate = ["world", "generate", "warehouse", "--robots", robots, "-o", "hall.ron"];
        run_in(folder.path(), &generate).done();
        let record = ["record", "--world", "hall.ron", "--ticks", "2", "--no-sensor", "-o", "run.mcap"];
        let out = run_in(folder.path(), &record).done();
        assert_eq!(out.lines().count(), lines, "{out}");
        assert_eq!(out.starts_with("101 robots  contacts: 0\ndigest "), robots == "101", "{out}");
    }
}
