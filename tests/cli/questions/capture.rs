//! `capture`: every widget as SVG and PNG, the dashboard as GIF, the contents of the files, and refusals.

use std::fs;
use std::path::Path;

use motion_lab::prelude::*;
use motion_lab::recording::Recorder;
use motion_lab::tour::{BOOK_SEED, TourConfig};

use crate::cli::run;

/// The text notes of a PNG, `keyword: text`.
fn notes(path: &Path) -> Vec<String> {
    let decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(path).unwrap()));
    let reader = decoder.read_info().unwrap();
    reader.info().uncompressed_latin1_text.iter().map(|t| format!("{}: {}", t.keyword, t.text)).collect()
}

fn size(path: &Path) -> (u32, u32) {
    let decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(path).unwrap()));
    let reader = decoder.read_info().unwrap();
    (reader.info().width, reader.info().height)
}

#[test]
fn every_widget_is_captured_in_both_themes_the_same_each_time() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let widgets: [&[&str]; 8] = [
        &["dashboard", "--tick", "40", "--seed", "7"],
        &["anatomy"],
        &["anatomy", "--tab", "witness", "--robot", "hitch"],
        &["atlas", "--world", "apartment", "--grid", "0.2"],
        &["atlas", "--world", "lot", "--teleport", "5.5,5,1.2"],
        &["cspace", "--cells", "6", "--annulus"],
        &["plan", "--seed", "7"],
        &["plan", "--robot", "rusty", "--q", "9,5", "--goal", "9.75,6.25", "--planner", "rrt"],
    ];
    for widget in widgets {
        let mut seen = Vec::new();
        for theme in ["light", "dark", "light"] {
            let file = at("w.svg");
            let arguments = [&["capture", "--widget"], widget, &["--theme", theme, "-o", &file]].concat();
            run(&arguments).done();
            let svg = fs::read_to_string(&file).unwrap();
            assert!(svg.starts_with("<svg") && svg.contains("<metadata>Software: motion-lab"), "{widget:?}");
            assert!(svg.contains("<title id=\"title\">") && !svg.contains("NaN"), "{widget:?}");
            seen.push(svg);
        }
        assert_eq!(seen[0], seen[2], "{widget:?}: the same bytes for the same request");
        assert_ne!(seen[0], seen[1], "{widget:?}");
    }
}

#[test]
fn a_png_holds_seed_digest_and_tick_and_is_as_large_as_asked() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("d.png");
    let out = file.to_str().unwrap();
    run(&["capture", "--widget", "dashboard", "--seed", "7", "--tick", "600", "--theme", "dark", "--out", out]).done();
    let in_file = notes(&file);
    let log = folder.path().join("r.mcap");
    run(&["record", "--seed", "7", "-o", log.to_str().unwrap()]).done();
    let info = run(&["info", log.to_str().unwrap(), "--json"]).done();
    let digest = crate::cli::json(&info)["digest"].as_str().unwrap().to_owned();
    assert!(in_file.contains(&"Seed: 7".to_owned()) && in_file.contains(&"Tick: 600".to_owned()), "{in_file:?}");
    assert!(in_file.contains(&format!("Digest: {digest}")), "{in_file:?}: the digest that the log has, {digest}");
    let (one, _) = size(&file);
    let of_log = ["capture", "--widget", "dashboard", "--log", log.to_str().unwrap(), "--tick", "600"];
    run(&[&of_log[..], &["--theme", "dark", "--scale", "2", "-o", out]].concat()).done();
    assert_eq!(size(&file).0, 2 * one);
    assert_eq!(notes(&file), in_file, "from the log as from its seed");
    run(&["capture", "--widget", "anatomy", "--width", "420", "-o", out]).done();
    assert!(size(&file).0 <= 420, "a column's width");
    assert!(notes(&file).iter().any(|n| n.starts_with("Configuration: T2(Tn([0.785398")), "{:?}", notes(&file));
}

#[test]
fn a_gif_runs_over_the_ticks_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("d.gif");
    let out = file.to_str().unwrap();
    run(&[
        "capture",
        "--widget",
        "dashboard",
        "--from",
        "10",
        "--to",
        "30",
        "--every",
        "5",
        "--width",
        "400",
        "-o",
        out,
    ])
    .done();
    let bytes = fs::read(&file).unwrap();
    let mut decoder = gif::DecodeOptions::new().read_info(&bytes[..]).unwrap();
    let mut delays = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        delays.push(frame.delay);
    }
    assert_eq!(delays, [25; 5], "ticks 10, 15, 20, 25 and 30, a quarter of a second each");
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.contains("Seed: 2005; Digest: ") && text.contains("Tick: 10 to 30"));
}

#[test]
fn a_gif_shows_a_robot_of_the_run_beside_its_point_and_the_atlas_with_its_robots() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("w.gif");
    let out = file.to_str().unwrap();
    let span = ["--seed", "7", "--from", "20", "--to", "60", "--every", "20", "--width", "320", "-o", out];
    let widgets: [&[&str]; 4] = [
        &["cspace", "--robot", "reach", "--cells", "5"],
        &["cspace", "--robot", "rusty", "--cells", "4"],
        &["cspace", "--robot", "hitch", "--cells", "4"],
        &["atlas", "--world", "apartment"],
    ];
    for widget in widgets {
        run(&[&["capture", "--widget"], widget, &span].concat()).done();
        let bytes = fs::read(&file).unwrap();
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(&bytes[..]).unwrap();
        let mut pictures = Vec::new();
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            assert_eq!(frame.delay, 100, "{widget:?}");
            pictures.push(frame.buffer.to_vec());
        }
        assert_eq!(pictures.len(), 3, "{widget:?}");
        assert!(pictures[0] != pictures[1] && pictures[1] != pictures[2], "{widget:?}: it moves");
        let text = String::from_utf8_lossy(&bytes);
        assert!(text.contains("Seed: 7; Digest: ") && text.contains("Tick: 20 to 60"), "{widget:?}");
    }
    // and at one tick, with its path
    let svg = folder.path().join("w.svg");
    run(&["capture", "--widget", "cspace", "--seed", "7", "--tick", "60", "-o", svg.to_str().unwrap()]).done();
    let drawn = fs::read_to_string(&svg).unwrap();
    assert!(drawn.contains(">where it was<") && drawn.contains("Seed: 7; Digest: ") && drawn.contains("; Tick: 60"));
}

#[test]
fn a_plan_is_the_one_that_plan_finds_and_as_gif_it_grows() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (svg, gif) = (at("p.svg"), at("p.gif"));
    // the chapter's question, unless another is asked
    let other: &[&str] = &["--robot", "rusty", "--planner", "rrt", "--seed", "3"];
    let places = [["--from", "9,5", "--to", "9.75,6.25"], ["--q", "9,5", "--goal", "9.75,6.25"]];
    for (plan, capture) in [
        (vec!["--robot", "Reach", "--from", "2.0,0", "--to", "3.1,0"], vec![]),
        ([other, &places[0]].concat(), [other, &places[1]].concat()),
    ] {
        let found = crate::cli::json(&run(&[&["plan", "--json"], &plan[..]].concat()).done());
        run(&[&["capture", "--widget", "plan", "-o", &svg], &capture[..]].concat()).done();
        let drawn = fs::read_to_string(&svg).unwrap();
        let length = format!("length {:.3} ", found["length"].as_f64().unwrap());
        assert!(drawn.contains(&length) && drawn.contains("configuration space"), "{length}: {plan:?}");
        assert!(drawn.contains(&format!("{} iterations", found["effort"]["iterations"])), "{found}");
    }
    run(&["capture", "--widget", "plan", "--width", "320", "-o", &gif]).done();
    let bytes = fs::read(&gif).unwrap();
    let mut decoder = gif::DecodeOptions::new().read_info(&bytes[..]).unwrap();
    let mut pictures = 0;
    while decoder.read_next_frame().unwrap().is_some() {
        pictures += 1;
    }
    let found =
        crate::cli::json(&run(&["plan", "--json", "--robot", "Reach", "--from", "2.0,0", "--to", "3.1,0"]).done());
    assert_eq!(pictures, found["effort"]["iterations"].as_u64().unwrap().min(72), "a picture for each iteration");
    assert!(String::from_utf8_lossy(&bytes).contains("Planner: rrt-connect; Seed: 2005"));
}

#[test]
fn names_are_there_where_they_are_asked_for_and_lengths_have_units() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.svg");
    let out = file.to_str().unwrap();
    for widget in [&["dashboard", "--tick", "0"][..], &["atlas"], &["atlas", "--seed", "7", "--tick", "3"]] {
        for names in [&[][..], &["--names"]] {
            run(&[&["capture", "--widget"], widget, names, &["-o", out]].concat()).done();
            let svg = fs::read_to_string(&file).unwrap();
            assert_eq!(svg.contains("the shelf</text>"), !names.is_empty(), "{widget:?} {names:?}");
        }
    }
    let teleport = ["capture", "--widget", "atlas", "--world", "lot", "--teleport", "5.5,5,1.2", "-o", out];
    run(&teleport).done();
    let svg = fs::read_to_string(&file).unwrap();
    assert!(svg.contains(" m away"));
    let teleport = ["capture", "--widget", "atlas", "--world", "workbench", "--teleport", "2.55,0", "-o", out];
    run(&teleport).done();
    assert!(fs::read_to_string(&file).unwrap().contains(" rad is free"));
}

#[test]
fn the_nearest_points_of_each_robot_that_touches_nothing_are_drawn_where_they_are_asked_for() {
    let dir = tempfile::tempdir().unwrap();
    let svg = dir.path().join("run.svg");
    let out = svg.to_str().unwrap();
    let drawn = |tick: &str, nearest: &[&str]| {
        run(&[&["capture", "--widget", "dashboard", "--tick", tick, "-o", out], nearest].concat()).done();
        std::fs::read_to_string(&svg).unwrap().matches(">the shortest way<").count()
    };
    // at tick 139 of the run of seed 2005 the arm touches the block; the car is held before it touches
    let mut recorder = Recorder::new(TourConfig::default(), BOOK_SEED).unwrap();
    (0..139).for_each(|_| _ = recorder.step());
    let scenes = [Scene::apartment(), Scene::workbench(), Scene::lot()];
    let apart = recorder.view().iter().filter(|r| scenes[r.world as usize].distance(&r.footprint) > 0.0).count();
    assert_eq!((drawn("139", &["--nearest"]), drawn("139", &[])), (apart, 0));
    assert_eq!((apart, drawn("0", &["--nearest"])), (2, 3), "at the start nothing touches");
}

#[test]
fn what_is_said_of_the_arm_is_not_said_of_the_car() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("c.svg");
    let out = out.to_str().unwrap();
    for (robot, words, arm) in [
        ("reach", "opposite edges are one", true),
        ("rusty", "every obstacle is grown by r = 0.11 m", false),
        ("hitch", "x and y at \u{3b8} = 0.000", false),
        ("reach3", "at \u{3b8}\u{2081} = ", true),
    ] {
        run(&["capture", "--widget", "cspace", "--robot", robot, "--cells", "4", "-o", out]).done();
        let svg = fs::read_to_string(out).unwrap();
        assert!(svg.contains(words), "{robot}");
        assert_eq!(svg.contains("The robot is a point"), arm, "{robot}");
    }
}

#[test]
fn the_space_shows_a_motion_only_where_one_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("space.svg");
    for (step, is_drawn) in [(None, false), (Some("--step=-90deg,0"), true)] {
        let words = ["capture", "--widget", "cspace", "--robot", "choset", "--cells", "3", "-o", out.to_str().unwrap()];
        run(&words.into_iter().chain(step).chain(["--force"]).collect::<Vec<_>>()).done();
        let svg = fs::read_to_string(&out).unwrap();
        // its line in the square, and the steps of its proof in the workspace
        for id in ["id=\"configuration-space-of-Reach-line\"", "id=\"Workbench-step-2\""] {
            assert_eq!(svg.contains(id), is_drawn, "{step:?}: {id}");
        }
    }
}

#[test]
fn what_cannot_be_drawn_is_refused_and_no_file_is_left() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (svg, gif, bmp) = (at("a.svg"), at("a.gif"), at("a.bmp"));
    let refused: [(&[&str], &str); 23] = [
        (&["dashboard", "--tick", "99999", "-o", &svg], "there is no tick 99999"),
        (&["dashboard", "--from", "9", "--to", "3", "-o", &gif], "there is no tick 9"),
        (&["anatomy", "-o", &gif], "query anatomy is one frozen scene"),
        (&["anatomy", "-o", &bmp], "its name does not tell the form"),
        (&["anatomy", "--q", "1,2,3", "-o", &svg], "3 numbers: a reach has two"),
        (&["anatomy", "--step", "1", "-o", &svg], "the step has 2"),
        (&["anatomy", "--robot", "hitch", "--world", "workbench", "-o", &svg], "no hitch lives there"),
        (&["atlas", "--grid", "1e-9", "-o", &svg], "more than"),
        (&["atlas", "--teleport", "1,2,3", "-o", &svg], "--teleport needs a world"),
        (&["cspace", "--tab", "swept", "-o", &svg], "--tab is only valid for the anatomy"),
        (&["anatomy", "--seed", "7", "-o", &svg], "--seed is only valid for dashboard, atlas, cspace and plan"),
        (&["anatomy", "--names", "-o", &svg], "--names is only valid for dashboard and atlas"),
        (&["atlas", "--nearest", "-o", &svg], "--nearest is only valid for the dashboard"),
        (&["cspace", "--goal", "1,2", "-o", &svg], "--goal or --planner is only valid for plan"),
        (&["plan", "--robot", "rusty", "-o", &svg], "where the path is to end is not said"),
        (&["plan", "--goal", "2.55,0", "-o", &svg], "goal"),
        (&["dashboard", "--every", "2", "-o", &svg], "--from, --to and --every is only valid for GIF"),
        (&["dashboard", "--tick", "2", "-o", &gif], "--tick is only valid for SVG and PNG"),
        (&["cspace", "--seed", "7", "--q", "0,0", "-o", &svg], "--q is only valid for figures that do not show a run"),
        (
            &["atlas", "--seed", "7", "--grid", "0.1", "-o", &svg],
            "--grid is only valid for figures that do not show a run",
        ),
        (&["cspace", "--robot", "reach3", "--to", "8", "-o", &gif], "the run has no robot of kind reach3"),
        (&["cspace", "--robot", "reach", "--world", "lot", "-o", &gif], "no robot of kind reach in Lot"),
        (&["atlas", "--world", "lot", "--teleport", "1,2", "-o", &svg], "2 numbers: Hitch is at HitchCfg"),
    ];
    for (arguments, reason) in refused {
        let error = run(&[&["capture", "--widget"], arguments].concat()).failed(2);
        assert!(error.contains(reason), "{arguments:?}: {error}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}
