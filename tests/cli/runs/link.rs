//! `link`: the address of a recorded run.

use std::fs;

use motion_lab::recording::Run;
use motion_lab::run::LogKind;
use motion_lab::web::Link;

use crate::cli::{json, run};

const SCRIPT: &str = r#"Script(version: 1, events: [(tick: 3, robot: "Hitch", input: Drive(128, -7))])"#;

#[test]
fn the_address_of_a_run_is_that_run_with_its_digest() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let script = path("drive.ron");
    fs::write(&script, SCRIPT).unwrap();
    let with = ["record", "--world", "lot", "--seed", "7", "--ticks", "30", "--json", "--script", &script];
    for kind in ["full", "digest"] {
        let log = path(&format!("{kind}.mcap"));
        let recorded = json(&run(&[&with[..], &["--log", kind, "-o", &log]].concat()).done());
        let digest = recorded["digest"].as_str().unwrap();
        let said = run(&["link", &log]).done();
        let query = said.trim_end().strip_prefix("http://localhost:8000/?").unwrap();
        assert!(query.starts_with("v=1&seed=7&world=lot&script=") && said.lines().count() == 1, "{said}");
        assert!(query.ends_with(&format!("&tick=30&digest={digest}")), "{said}");
        // whoever opens it runs the same: the digest of its run, recorded anew from the address alone
        let again = Run::record_recipe(Link::parse(query).unwrap().recipe(), LogKind::Frames, |_| {}).unwrap();
        assert_eq!(again.digest().unwrap().to_string(), digest);
        let elsewhere = run(&["link", &log, "--site", "https://example.org/lab/"]).done();
        assert_eq!(elsewhere.trim_end(), format!("https://example.org/lab/?{query}"));
    }
}

#[test]
fn a_run_of_a_world_and_a_sensor_of_ones_own_has_an_address() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let (yard, log) = (path("yard.ron"), path("run.mcap"));
    fs::write(&yard, run(&["world", "show", "apartment"]).done().replace("name: \"Apartment\"", "name: \"My flat\""))
        .unwrap();
    let with = ["record", "--world", &yard, "--rays", "5", "--ticks", "30", "--json", "-o", &log];
    let digest = json(&run(&with).done())["digest"].as_str().unwrap().to_owned();
    let said = run(&["link", &log]).done();
    let query = said.trim_end().split_once(['?', '#']).unwrap().1;
    assert!(query.contains("&sensor=5,") && query.ends_with(&format!("&digest={digest}")), "{said}");
    let again = Run::record_recipe(Link::parse(query).unwrap().recipe(), LogKind::Frames, |_| {}).unwrap();
    assert_eq!(again.digest().unwrap().to_string(), digest);
}

#[test]
fn a_run_that_fits_in_no_address_is_refused_and_an_unfinished_one_has_no_digest() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let log = path("run.mcap");
    let yard = path("yard.ron");
    let name = "a name that is as long as a whole sentence";
    let text = run(&["world", "show", "lot"]).done();
    fs::write(&yard, text.replace("name: \"Lot\"", &format!("name: {name:?}"))).unwrap();
    run(&["record", "--world", &yard, "--ticks", "30", "-o", &log]).done();
    let refused = run(&["link", &log]);
    assert_eq!((refused.code, &*refused.out), (Some(3), ""));
    assert!(refused.err.contains("run.mcap: the name \"a name that ...\" has more than 32"), "{}", refused.err);
    let none = run(&["link", &path("none.mcap")]);
    assert!(none.code == Some(3) && none.err.contains("none.mcap"), "{}", none.err);
    let place = run(&["link", &log, "--site", "example.org"]);
    assert!(place.code == Some(2) && place.err.contains("write http:// or https://"), "{}", place.err);

    let whole = path("whole.mcap");
    run(&["record", "--ticks", "30", "-o", &whole]).done();
    let bytes = fs::read(&whole).unwrap();
    fs::write(&log, &bytes[..bytes.len() / 2]).unwrap();
    let cut = run(&["link", &log]);
    assert_eq!((cut.code, cut.out.trim_end()), (Some(5), "http://localhost:8000/?v=1&seed=2005&tick=30"));
    assert!(cut.err.contains("the log is cut off") && cut.err.contains("without a digest"), "{}", cut.err);
}
