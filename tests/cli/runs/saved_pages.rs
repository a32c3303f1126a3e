//! A page that *Save as page* of the lab wrote is read wherever a log is.

use std::fs;

use base64::prelude::{BASE64_STANDARD, Engine};

use crate::cli::{json, run, run_in};

/// Written by Chromium: see tests/samples/README.md.
const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/samples/saved_page.html");

/// The digest that the browser's simulator found, as the page's own sentence says it.
fn digest() -> String {
    let text = fs::read_to_string(PAGE).unwrap();
    text.split_once("Its digest was ").unwrap().1[..32].to_owned()
}

#[test]
fn a_saved_page_is_verified_described_and_replayed_as_its_log_is() {
    let verified = run(&["verify", PAGE]).done();
    assert!(verified.contains("65 of 65") && verified.contains(&digest()), "{verified}");
    let about = run(&["info", PAGE]).done();
    assert!(about.contains("42") && about.contains("65"), "{about}");
    let row = run(&["stats", "--json", PAGE]).done();
    assert_eq!(json(row.lines().next().unwrap())["ticks"], 65, "{row}");
    let folder = tempfile::tempdir().unwrap();
    run_in(folder.path(), &["replay", PAGE, "--log", "full", "-o", "full.mcap"]).done();
    let full = run_in(folder.path(), &["verify", "--expect", &digest(), "full.mcap"]).done();
    assert!(full.contains("65 of 65"), "{full}");
}

#[test]
fn a_page_that_was_changed_is_no_run_and_one_without_a_run_says_so() {
    let text = fs::read_to_string(PAGE).unwrap();
    let (head, held) = text.split_once("id=\"bytes\">").unwrap();
    let (letters, tail) = held.split_once('<').unwrap();
    let mut bytes = BASE64_STANDARD.decode(letters).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    let folder = tempfile::tempdir().unwrap();
    let changed = format!("{head}id=\"bytes\">{}<{tail}", BASE64_STANDARD.encode(bytes));
    fs::write(folder.path().join("changed.html"), changed).unwrap();
    let refused = run_in(folder.path(), &["verify", "changed.html"]);
    assert!(refused.code != Some(0) && refused.err.contains("changed.html: "), "{}", refused.err);
    fs::write(folder.path().join("report.html"), "<!doctype html><title>A report</title>").unwrap();
    let none = run_in(folder.path(), &["verify", "report.html"]).failed(3);
    assert!(none.contains("report.html: this is a page, and it holds no run"), "{none}");
    // what goes on where it ends would be written over the page
    fs::copy(PAGE, folder.path().join("run.html")).unwrap();
    let kept = run_in(folder.path(), &["record", "--resume", "run.html"]).failed(2);
    assert!(kept.contains("run.html: it is a page"), "{kept}");
    assert_eq!(fs::read_to_string(folder.path().join("run.html")).unwrap(), text);
}
