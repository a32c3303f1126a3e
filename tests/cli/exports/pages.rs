//! `export -o RUN.html`: a run as one page. The browser tests open such pages and compare them with those of the lab's.

use std::fs;
use std::path::Path;

use motion_lab::run::{Digest, Log, ReadLog};
use motion_lab::run_page::simulator_print;

use crate::cli::{Run, json, run_in, run_with};

/// What Chromium saved of 65 ticks at seed 42: see tests/samples/README.md.
const SAVED: &str = include_str!("../../samples/saved_page.html");

/// The site's page, with neither script nor simulator.
fn page_text() -> String {
    let mut text = include_str!("../../../assets/web/saved.html").to_owned();
    for name in ["script", "style", "script-hash", "style-hash"] {
        text = text.replace(&format!("{{{{{name}}}}}"), "");
    }
    text.replace("{{simulator}}", &simulator_print().unwrap())
}

/// A folder with the file `template`, as the site's build makes it, and the log of that run.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let module = b"\0asm\x01\0\0\0";
    fs::write(folder.path().join("template"), [page_text().as_bytes(), module].concat()).unwrap();
    run_in(folder.path(), &["record", "--seed", "42", "--ticks", "65", "-o", "run.mcap"]).done();
    folder
}

fn export(folder: &Path, arguments: &[&str]) -> Run {
    run_in(folder, &[&["export", "--template", "template"], arguments].concat())
}

/// The log in a page, with the program that wrote it and the digest that its end seals.
fn log_of(page: &str) -> (Log, String, Option<Digest>) {
    let ReadLog { log, program, sealed, .. } = Log::read_mcap(page.as_bytes()).unwrap();
    (log, program, sealed)
}

#[test]
fn a_page_holds_the_log_that_a_browser_saved_of_the_same_run() {
    let folder = folder();
    let at = folder.path();
    let said = export(at, &["run.mcap", "-o", "run.html"]);
    assert!(said.err.contains("wrote run.html"), "{}", said.err);
    said.done();
    let page = fs::read_to_string(at.join("run.html")).unwrap();
    assert_eq!(log_of(&page), log_of(SAVED));
    let digest = |page: &str| page.split_once("Its digest was ").unwrap().1[..32].to_owned();
    assert_eq!(digest(&page), digest(SAVED));
    // from a log of digests, from the page itself, by another name of the form: the same
    run_in(at, &["replay", "run.mcap", "--log", "digest", "-o", "few.mcap"]).done();
    export(at, &["few.mcap", "-o", "few.htm"]).done();
    run_in(at, &["export", "run.html", "--template", "run.html", "-o", "again.html"]).done();
    let piped = run_with(
        &fs::read(at.join("run.mcap")).unwrap(),
        &["export", "-", "--format", "html", "--template", at.join("template").to_str().unwrap(), "-o", "-"],
    );
    let others = ["few.htm", "again.html"].map(|name| fs::read_to_string(at.join(name)).unwrap());
    assert!(others.iter().chain([&piped.done()]).all(|other| *other == page));
}

#[test]
fn what_reads_a_log_reads_the_page() {
    let folder = folder();
    let at = folder.path();
    export(at, &["run.mcap", "-o", "run.html"]).done();
    let digest = &SAVED.split_once("Its digest was ").unwrap().1[..32];
    let verified = run_in(at, &["verify", "--expect", digest, "run.html"]).done();
    assert!(verified.contains("65 of 65"), "{verified}");
    assert!(run_in(at, &["info", "run.html"]).done().contains(digest));
    let of = |file: &str| run_in(at, &["stats", "--json", file]).done();
    let rows = |file: &str| of(file).lines().next().map(|line| json(line)["robots"].clone()).unwrap();
    assert_eq!(rows("run.html"), rows("run.mcap"));
    let exam = r#"Assignment(version: 1, world: "apartment", robot: "Rusty",
        goal: (at: [9.75, 6.25, 0], within: [0.2, 0.2, 3.2]), limits: (ticks: 600, contacts: 0), seeds: "0..1")"#;
    fs::write(at.join("exam.ron"), exam).unwrap();
    run_in(at, &["record", "--world", "apartment", "--seed", "0", "--ticks", "40", "-o", "in.mcap"]).done();
    export(at, &["in.mcap", "-o", "in.html"]).done();
    let graded = |file: &str| json(run_in(at, &["grade", "--json", "exam.ron", file]).out.lines().next().unwrap());
    let [page, log] = ["in.html", "in.mcap"].map(|file| graded(file)["attempts"].clone());
    assert!(page == log && page[0]["configuration"].is_array(), "{page} {log}");
    // a folder's page is a submission
    fs::create_dir(at.join("handed")).unwrap();
    fs::copy(at.join("in.html"), at.join("handed/in.html")).unwrap();
    assert!(graded("handed")["submission"].as_str().unwrap().ends_with("in.html"));
}

#[test]
fn of_a_damaged_log_the_page_is_the_sealed_beginning_and_of_a_forged_one_there_is_none() {
    let folder = folder();
    let at = folder.path();
    let log = fs::read(at.join("run.mcap")).unwrap();
    fs::write(at.join("cut.mcap"), &log[..log.len() / 2]).unwrap();
    let cut = export(at, &["cut.mcap", "-o", "cut.html"]).failed(5);
    assert!(cut.contains("This much is exported"), "{cut}");
    let verified = run_in(at, &["verify", "cut.html"]).done();
    assert!(!verified.contains("of 65"), "{verified}");
    let mut forged = Log::read_mcap(&log).unwrap().log;
    forged.frames_mut()[40].robots[0].contacts += 1;
    fs::write(at.join("forged.mcap"), crate::cli::sealed(&forged)).unwrap();
    let refused = export(at, &["forged.mcap", "-o", "forged.html"]).failed(4);
    assert!(refused.contains("forged.mcap: the run is another when it is simulated again: tick 41"), "{refused}");
    assert!(!at.join("forged.html").exists());
}

#[test]
fn what_is_no_template_of_this_version_is_refused_before_anything_is_written() {
    let folder = folder();
    let at = folder.path();
    fs::write(at.join("old.html"), "the older page").unwrap();
    let template = fs::read(at.join("template")).unwrap();
    let text = page_text();
    let with = |from: &str, to: &str| [text.replace(from, to).as_bytes(), b"\0asm"].concat();
    let log = "id=\"bytes\">";
    fs::File::create(at.join("large")).unwrap().set_len(1 << 30).unwrap();
    for (file, bytes, said) in [
        ("empty", Some(Vec::new()), "it has no place for the simulator's print"),
        ("log", Some(fs::read(at.join("run.mcap")).unwrap()), "it is no page: byte 0 begins no character"),
        ("without", Some(with(log, "")), "it has no place for the run's log"),
        ("twice", Some([b"<script type=\"text/plain\" id=\"bytes\"></script>", &*template].concat()), "two places"),
        ("bare", Some(text.clone().into_bytes()), "it is a template without a simulator"),
        ("sample", Some(SAVED.as_bytes().to_vec()), "it has no place for the simulator's print"),
        ("older", Some(with("data-simulator=\"motion-lab 0.", "data-simulator=\"motion-lab 99.")), "another simulator"),
        ("large", None, "too large: more than 67108864 bytes"),
        ("none", None, "there is no such file"),
    ] {
        if let Some(bytes) = bytes {
            fs::write(at.join(file), bytes).unwrap();
        }
        let refused = run_in(at, &["export", "run.mcap", "--template", file, "-o", "old.html"]).failed(3);
        assert!(refused.contains(&format!("{file}: ")) && refused.contains(said), "{file}: {refused}");
        assert_eq!(fs::read(at.join("old.html")).unwrap(), b"the older page");
    }
    let other = export(at, &["run.mcap", "-o", "run.csv"]).failed(2);
    assert!(other.contains("--template is only valid with --format html"), "{other}");
    let names: Vec<_> = fs::read_dir(at).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert!(names.iter().all(|name| !name.to_string_lossy().contains("unfinished")), "{names:?}");
}
