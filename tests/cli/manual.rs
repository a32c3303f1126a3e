//! `completions` and `man` cover every command.

use std::fs;

use super::{run, run_in};

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
    assert!(error.contains("file: it can't be written") && error.lines().count() >= 2, "{error}");
}
