//! `-` as output: standard output holds the file alone, and what is said beside it is on standard error.

use std::fs;

use motion_lab::run::Script;

use crate::cli::{Run, json, run_in};

const ROUND_THE_POST: [&str; 7] = ["plan", "--robot", "reach", "--from", "2,0", "--to", "3.1,0"];

#[test]
fn a_plan_written_to_standard_output_is_the_file_alone() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let plan = |more: &[&str]| run_in(at, &[&ROUND_THE_POST[..], more].concat());
    // the report that would stand on standard output
    let report = plan(&[]).done();
    let begins = |err: &str| err.starts_with(report.lines().next().unwrap());
    for (option, file) in [("-o", "a.json"), ("--script", "a.ron"), ("--svg", "a.svg")] {
        plan(&[option, file]).done();
        let Run { code, out, err } = plan(&[option, "-"]);
        assert!(code == Some(0) && begins(&err), "{option}: {err}");
        assert!(out == fs::read_to_string(at.join(file)).unwrap(), "{option}");
        let quiet = plan(&[option, "-", "--quiet"]);
        assert_eq!((quiet.out == out, quiet.err.as_str()), (true, ""), "{option}");
        let with_json = plan(&[option, "-", "--json"]);
        assert!(with_json.out == out && json(with_json.err.lines().next().unwrap())["solved"] == true, "{option}");
    }
    assert_eq!(json(&plan(&["-o", "-"]).out)["planner"], "rrt-connect");
    assert!(Script::parse("-", &plan(&["--script", "-"]).out).is_ok());
    let png =
        crate::cli::command(&[&ROUND_THE_POST[..], &["--svg", "-", "--format", "png"]].concat()).output().unwrap();
    assert!(png.stdout.starts_with(b"\x89PNG"));
    let short = ["plan", "--robot", "reach", "--from", "2,0", "--to", "2.1,0", "--gif", "-"];
    assert!(crate::cli::command(&short).output().unwrap().stdout.starts_with(b"GIF89a"));
    let compared = plan(&["--compare", "rrt", "--seeds", "0..2", "--csv", "-"]);
    assert_eq!(compared.out.lines().count(), 3, "{}", compared.out);
    assert!(compared.out.starts_with("planner,") && compared.err.contains("medians over"), "{}", compared.err);
    // one to a pipe and another to a file
    let both = plan(&["-o", "-", "--script", "b.ron"]);
    assert!(json(&both.out)["legs"].is_array() && both.err.contains("wrote b.ron"), "{}", both.err);
}

#[test]
fn certificates_tables_and_reports_go_to_standard_output_too() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let asked = run_in(at, &["query", "edge", "--robot", "reach", "2,0", "2.1,0", "--certificate", "-"]);
    assert!(json(&asked.out)["steps"].is_array(), "{}", asked.out);
    assert_eq!(json(asked.err.lines().next().unwrap())["edge"], "free", "{}", asked.err);
    let study = "Sweep(version: 1, worlds: [\"lot\"], ticks: 2, axes: [(vary: \"seed\", over: Range(0, 1))])";
    fs::write(at.join("study.ron"), study).unwrap();
    run_in(at, &["sweep", "study.ron", "-o", "parts"]).done();
    let merged = run_in(at, &["sweep", "merge", "parts", "-o", "-", "-o", "all.parquet"]);
    assert!(merged.out.starts_with("row,seed,ticks,") && merged.out.lines().count() == 2, "{}", merged.out);
    assert!(merged.err.starts_with("1 row, 0 failed, study "), "{}", merged.err);
    run_in(at, &["sweep", "merge", "parts", "-o", "all.csv"]).done();
    assert_eq!(fs::read_to_string(at.join("all.csv")).unwrap(), merged.out);
    // a name that tells no form needs --format, and --format says another than the name
    let error = run_in(at, &["sweep", "merge", "parts", "-o", "table"]).failed(2);
    assert!(error.contains("--format"), "{error}");
    run_in(at, &["sweep", "merge", "parts", "--format", "csv", "-o", "table"]).done();
    assert_eq!(fs::read_to_string(at.join("table")).unwrap(), merged.out);
    let page = run_in(at, &["sweep", "report", "all.parquet", "-o", "-"]);
    assert!(
        page.out.starts_with("<!DOCTYPE html>") && page.out.contains("<p>1 run, 0 of them failed."),
        "{}",
        page.err
    );
    let figure = run_in(at, &["sweep", "report", "all.parquet", "--format", "svg", "-o", "-"]);
    assert!(figure.out.starts_with("<svg") && figure.err.is_empty(), "{}", figure.err);
}
