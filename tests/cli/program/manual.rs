//! `completions` and `man` cover every command.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::cli::{run, run_in};

/// The commands that `--help` lists.
fn commands() -> Vec<String> {
    let help = run(&["--help"]).done();
    let listed = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    let names = listed.lines().filter_map(|l| l.strip_prefix("  ")).filter(|l| !l.starts_with(' '));
    names.map(|l| l.split(' ').next().unwrap().to_owned()).filter(|name| name != "help").collect()
}

#[test]
fn every_shell_gets_completions_for_every_command() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let completions = run(&["completions", shell]).done();
        for command in commands() {
            assert!(completions.contains(&command), "{shell} does not know {command}");
        }
    }
    let error = run(&["completions", "csh"]).failed(2);
    assert!(error.contains("bash, elvish, fish, powershell, zsh"), "{error}");
}

#[test]
fn every_command_has_a_page() {
    let folder = tempfile::tempdir().unwrap();
    assert!(run(&["man"]).done().contains(".TH motion-lab 1"));
    let output = run_in(folder.path(), &["man", "-o", "pages"]);
    let pages = fs::read_dir(folder.path().join("pages")).unwrap().count();
    assert!(output.code == Some(0) && output.err.contains(&format!("wrote {pages} pages to pages")), "{}", output.err);
    for command in commands() {
        let page = fs::read_to_string(folder.path().join(format!("pages/motion-lab-{command}.1"))).unwrap();
        assert!(page.contains(&format!(".TH motion-lab-{command} 1")), "{command}");
    }
    assert!(folder.path().join("pages/motion-lab-world-check.1").exists());
    fs::write(folder.path().join("file"), "").unwrap();
    let error = run_in(folder.path(), &["man", "-o", "file"]).failed(1);
    assert!(
        error.contains("file: this output is a folder, and a file is there") && error.lines().count() >= 2,
        "{error}"
    );
}

/// A page as `man` shows it at a terminal of 100 columns.
fn shown(page: &Path) -> String {
    let roff = Command::new("groff").args(["-man", "-Tutf8", "-P-cbou", "-rLL=100n"]).arg(page).output().unwrap();
    String::from_utf8(roff.stdout).unwrap()
}

#[test]
fn the_pages_keep_tables_and_examples_line_by_line() {
    let folder = tempfile::tempdir().unwrap();
    run_in(folder.path(), &["man", "-o", "."]).done();
    if Command::new("groff").arg("--version").output().is_err() {
        println!("skipped: groff is not installed, so no page was shown");
        return;
    }
    let lines = |page: &str| -> Vec<String> {
        shown(&folder.path().join(page)).lines().map(|line| line.trim().to_owned()).collect()
    };
    for (page, begin) in [
        ("motion-lab-query.1", "intersects  {\"intersects\":false}"),
        ("motion-lab-query.1", "scan        {\"ranges\":[..]}"),
        ("motion-lab-capture.1", "anatomy    the queries at a configuration"),
        ("motion-lab-capture.1", "atlas      worlds and their robots"),
        ("motion-lab-verify.1", "motion-lab verify run.mcap"),
        ("motion-lab.1", "3  an input file is missing or wrong"),
        ("motion-lab-grade.1", "limits: (ticks: 200, contacts: 0"),
    ] {
        let lines = lines(page);
        assert!(lines.iter().any(|line| line.starts_with(begin)), "{page}: no line begins with {begin}: {lines:#?}");
    }
    let verify = lines("motion-lab-verify.1");
    assert!(verify.iter().any(|line| line == "EXAMPLES"), "{verify:#?}");
    assert!(verify.iter().all(|line| line.chars().count() <= 100), "sentences are filled: {verify:#?}");
    assert!(lines("motion-lab.1").iter().any(|line| line == "EXIT STATUS"));
}
