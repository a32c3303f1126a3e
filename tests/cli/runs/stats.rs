//! `stats` and `plot`: tables, JSON and figures of logs, of digest logs and of damaged ones.

use std::fs;

use crate::cli::{command, json, run_in};

/// A car that drives straight ahead for two seconds in the Lot, whose aisle has 5 m of room before it.
fn recorded(folder: &std::path::Path, log: &str, name: &str) {
    let script = "Script(version: 1, events: [(tick: 1, robot: \"Hitch\", input: Drive(128, 0)), (tick: 41, robot: \"Hitch\", \
                  input: Drive(0, 0))])";
    fs::write(folder.join("drive.ron"), script).unwrap();
    let run =
        ["record", "--world", "lot", "--robot", "Hitch=hitch:6.5,2.5,0", "--ticks", "60", "--script", "drive.ron"];
    run_in(folder, &[&run[..], &["--log", log, "-o", name]].concat()).done();
}

#[test]
fn stats_are_a_table_and_json_of_many_logs_of_either_kind() {
    let folder = tempfile::tempdir().unwrap();
    recorded(folder.path(), "full", "full.mcap");
    recorded(folder.path(), "digest", "digest.mcap");
    let lines = run_in(folder.path(), &["stats", "--json", "full.mcap", "digest.mcap"]).done();
    let [full, digest]: [serde_json::Value; 2] = lines.lines().map(json).collect::<Vec<_>>().try_into().unwrap();
    assert_eq!((&full["file"], &digest["file"]), (&"full.mcap".into(), &"digest.mcap".into()));
    assert_eq!(full["robots"], digest["robots"], "simulated again as recorded");
    let car = &full["robots"][0];
    // 40 ticks at 1.5 m/s
    assert!((car["path_m"].as_f64().unwrap() - 3.0).abs() < 1e-9, "{car}");
    assert_eq!((&car["name"], &car["kind"], &car["contacts"]), (&"Hitch".into(), &"hitch".into(), &0.into()));
    assert_eq!((&full["ticks"], &full["seconds"], &full["seed"]), (&60.into(), &3.0.into(), &2005.into()));
    let table = run_in(folder.path(), &["stats", "full.mcap", "digest.mcap"]).done();
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows[0], "full.mcap: 60 ticks (3.00 s)");
    assert!(rows[1].starts_with("robot  world  contacts  in contact ") && rows[2].contains("  3.000 m  "), "{table}");
    assert_eq!((rows[3], rows[4]), ("", "digest.mcap: 60 ticks (3.00 s)"));
}

#[test]
fn a_wrong_file_has_its_message_and_the_others_their_stats() {
    let folder = tempfile::tempdir().unwrap();
    recorded(folder.path(), "full", "full.mcap");
    let bytes = fs::read(folder.path().join("full.mcap")).unwrap();
    fs::write(folder.path().join("cut.mcap"), &bytes[..bytes.len() - 6000]).unwrap();
    let mixed = run_in(folder.path(), &["stats", "--json", "nowhere.mcap", "drive.ron", "full.mcap"]);
    assert_eq!((mixed.code, mixed.out.lines().count()), (Some(3), 1), "{}", mixed.err);
    assert!(mixed.err.contains("nowhere.mcap: there is no such file") && mixed.err.contains("drive.ron: "));
    let cut = run_in(folder.path(), &["stats", "--json", "cut.mcap"]);
    assert_eq!(cut.code, Some(5), "{}", cut.err);
    let ticks = json(&cut.out)["ticks"].as_u64().unwrap();
    assert!((1..60).contains(&ticks) && json(&cut.out)["robots"][0]["path_m"].as_f64().unwrap() > 1.0, "{ticks}");
}

#[test]
fn every_quantity_is_plotted_in_both_forms_and_themes() {
    let folder = tempfile::tempdir().unwrap();
    for (kind, name) in [("full", "full.mcap"), ("digest", "digest.mcap")] {
        run_in(folder.path(), &["record", "--ticks", "100", "--log", kind, "-o", name]).done();
    }
    let digest = json(&run_in(folder.path(), &["info", "--json", "full.mcap"]).done())["digest"].clone();
    let svg = |arguments: &[&str]| {
        run_in(folder.path(), &[&["plot"], arguments, &["-o", "plot.svg"]].concat()).done();
        fs::read_to_string(folder.path().join("plot.svg")).unwrap()
    };
    for (what, title, lines) in [
        ("clearance", "distance to the nearest obstacle, m", &["Rusty", "Reach", "Hitch"][..]),
        ("speed", "speed, m/s", &["Rusty", "Reach", "Hitch"]),
        ("joints", "joint angles, rad", &["Reach theta1", "Reach theta2"]),
        ("encoders", "encoders against true travel, m", &["Rusty encoders", "Rusty true"]),
    ] {
        let drawn = svg(&["full.mcap", "--what", what]);
        assert!(drawn.starts_with("<svg") && drawn.contains(title) && !drawn.contains("NaN"), "{what}");
        for line in lines {
            assert!(drawn.contains(&format!("<title>{line}</title>")), "{what} {line}");
        }
        assert_eq!(drawn.matches("-line-").count(), lines.len(), "{what}: and no others");
        let notes = format!("Seed: 2005; Digest: {}; Ticks: 100", digest.as_str().unwrap());
        assert!(drawn.contains(&notes), "{what}");
        assert_eq!(svg(&["digest.mcap", "--what", what]), drawn, "{what}: the digest log's run is the same");
        assert_ne!(svg(&["full.mcap", "--what", what, "--theme", "dark"]), drawn, "{what}");
        let one = svg(&["full.mcap", "--what", what, "--robot", lines[0].split(' ').next().unwrap()]);
        assert!(one.contains(&format!("<title>{}</title>", lines[0])), "{what}");
    }
    let width = |name: &str| {
        let file = fs::File::open(folder.path().join(name)).unwrap();
        png::Decoder::new(std::io::BufReader::new(file)).read_info().unwrap().info().width
    };
    // to a pipe, in either form
    let piped = |more: &[&str]| {
        let arguments = [&["plot", "full.mcap", "--what", "speed", "-o", "-"], more].concat();
        command(&arguments).current_dir(folder.path()).output().unwrap().stdout
    };
    assert_eq!(piped(&[]), svg(&["full.mcap", "--what", "speed"]).into_bytes());
    assert!(piped(&["--format", "png"]).starts_with(b"\x89PNG"));
    for (scale, name) in [("1", "one.png"), ("2", "two.png")] {
        let plot = ["plot", "full.mcap", "--what", "speed", "--width", "420", "--scale", scale, "-o", name];
        run_in(folder.path(), &plot).done();
    }
    assert_eq!((width("one.png"), width("two.png")), (420, 840));
}

/// The times at which a robot's contacts begin and end, by the table of `export`: the first row in contact, and the
/// first after it that is not.
fn contacts(folder: &std::path::Path, log: &str, robot: &str) -> Vec<[f64; 2]> {
    let table = run_in(folder, &["export", log, "--format", "csv"]).done();
    let mut rows = table.lines().map(|row| row.split(',').collect::<Vec<_>>());
    let head = rows.next().unwrap();
    let column = |name: &str| head.iter().position(|n| *n == name).unwrap();
    let (time, name, touches) = (column("time_s"), column("robot"), column("in_contact"));
    let mut found: Vec<[f64; 2]> = Vec::new();
    let mut was = false;
    for row in rows.filter(|row| row[name] == robot) {
        let (t, is) = (row[time].parse().unwrap(), row[touches] == "true");
        match (was, is) {
            (false, true) => found.push([t, f64::NAN]),
            (true, false) => found.last_mut().unwrap()[1] = t,
            _ => {}
        }
        was = is;
    }
    found
}

#[test]
fn contacts_are_shaded_in_plots_of_both_forms_and_themes() {
    let folder = tempfile::tempdir().unwrap();
    // at this seed the arm of the tour touches its post, and the car nothing
    for (kind, name) in [("full", "full.mcap"), ("digest", "digest.mcap")] {
        run_in(folder.path(), &["record", "--seed", "7", "--ticks", "200", "--log", kind, "-o", name]).done();
    }
    let touched = contacts(folder.path(), "full.mcap", "Reach");
    assert!(touched.iter().any(|[_, to]| to.is_nan()) && touched.iter().any(|[_, to]| !to.is_nan()), "{touched:?}");
    let [first, .., last] = &touched[..] else { panic!("{touched:?}") };
    let times = |[from, to]: &[f64; 2]| match to.is_nan() {
        true => format!("from {from:.2} s to the end"),
        false => format!("from {from:.2} s to {to:.2} s"),
    };
    let count = touched.len();
    let said = format!("Reach is in contact {count} times, first {}, last {}.", times(first), times(last));
    assert!(contacts(folder.path(), "full.mcap", "Hitch").is_empty());
    let words = json(&run_in(folder.path(), &["describe"]).done());
    for log in ["full.mcap", "digest.mcap"] {
        for what in ["clearance", "speed", "joints"] {
            let plot = |robot: &str| {
                let arguments = ["plot", log, "--what", what, "--robot", robot, "-o", "-"];
                run_in(folder.path(), &arguments)
            };
            let drawn = plot("Reach").done();
            assert!(drawn.contains(&said), "{log} {what}: no {said:?}");
            assert_eq!(drawn.matches("<title>in contact</title>").count(), 3, "{log} {what}: shade, sample, words");
            assert!(drawn.contains(">in contact</text>"), "{log} {what}: the legend");
            let free = if what == "joints" { continue } else { plot("Hitch").done() };
            assert!(!free.contains("in contact"), "{log} {what}");
        }
    }
    for theme in ["light", "dark"] {
        let channels = |role: &str| {
            let colour = words["colours"][theme][role].as_str().unwrap().trim_start_matches('#').to_owned();
            [0, 2, 4].map(|i| i32::from_str_radix(&colour[i..i + 2], 16).unwrap())
        };
        // somewhere between paper and contact, nearer to the paper
        let (paper, contact) = (channels("paper"), channels("goal"));
        let shaded = |robot: &str| {
            let arguments = ["plot", "full.mcap", "--what", "speed", "--robot", robot, "--theme", theme, "-o", "p.png"];
            run_in(folder.path(), &arguments).done();
            let file = fs::File::open(folder.path().join("p.png")).unwrap();
            let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().unwrap();
            let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
            let info = reader.next_frame(&mut pixels).unwrap();
            let mix = |pixel: &[u8]| {
                let parts =
                    [0, 1, 2].map(|i| f64::from(i32::from(pixel[i]) - paper[i]) / f64::from(contact[i] - paper[i]));
                (0.1..0.5).contains(&parts[0]) && parts.iter().all(|part| (part - parts[0]).abs() < 0.05)
            };
            pixels.chunks(info.line_size / info.width as usize).filter(|pixel| mix(pixel)).count()
        };
        let (reach, hitch) = (shaded("Reach"), shaded("Hitch"));
        assert!(reach > 10_000 && hitch < reach / 20, "{theme}: {reach} and {hitch} pixels");
    }
}

#[test]
fn what_cannot_be_plotted_is_refused_and_no_file_is_left() {
    let folder = tempfile::tempdir().unwrap();
    recorded(folder.path(), "full", "car.mcap");
    for (arguments, code, reason) in [
        (&["car.mcap", "--what", "joints", "-o", "a.svg"][..], 2, "no robot asked for has joints"),
        (&["car.mcap", "--what", "encoders", "-o", "a.svg"], 2, "no robot asked for has encoders"),
        (&["car.mcap", "--what", "speed", "--robot", "Anna", "-o", "a.svg"], 2, "It has Hitch."),
        (&["car.mcap", "--what", "speed", "-o", "a.gif"], 2, "Let it end in .svg or .png, or say --format."),
        (&["car.mcap", "--what", "mood", "-o", "a.svg"], 2, "clearance, speed, joints, encoders"),
        (&["nowhere.mcap", "--what", "speed", "-o", "a.svg"], 3, "nowhere.mcap: there is no such file"),
        (&["car.mcap", "--what", "speed", "-o", "no/a.svg"], 1, "Make its folder first"),
    ] {
        let error = run_in(folder.path(), &[&["plot"], arguments].concat()).failed(code);
        assert!(error.contains(reason), "{arguments:?}: {error}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "the script and the log");
}
