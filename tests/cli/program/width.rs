//! Help in terminals of every width.

use crate::cli::command;

/// The program's help, or that of a command below it, on a terminal of this many columns; whole lines for 0.
fn help(path: &[String], flag: &str, columns: usize) -> String {
    let mut command = command(&[]);
    command.args(path).arg(flag).env_remove("COLUMNS");
    if columns > 0 {
        command.env("COLUMNS", columns.to_string());
    }
    let output = command.output().unwrap();
    assert!(output.status.success() && output.stderr.is_empty(), "{path:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// The paths of all commands, that of the program itself first, as their help lists them.
fn paths() -> Vec<Vec<String>> {
    let mut paths = vec![Vec::new()];
    let mut next = 0;
    while let Some(path) = paths.get(next).cloned() {
        let text = help(&path, "-h", 0);
        let listed = text.split("\nCommands:\n").nth(1).unwrap_or("").lines().take_while(|line| !line.is_empty());
        let listed = listed.filter_map(|line| line.strip_prefix("  ")).filter(|line| !line.starts_with(' '));
        let names = listed.filter_map(|line| line.split_whitespace().next()).filter(|name| *name != "help");
        paths.extend(names.map(|name| [&path[..], &[name.to_owned()]].concat()));
        next += 1;
    }
    paths
}

/// The words of a text, without the backslashes that end the lines of a long command.
fn words(text: &str) -> Vec<&str> {
    text.split_whitespace().filter(|word| *word != "\\").collect()
}

/// Whether a line could not have been parted: one word, or one that begins with a quote, and a backslash behind it.
fn is_one_word(line: &str) -> bool {
    let line = line.trim().trim_end_matches(" \\");
    !line.contains(' ') || line.find(['\'', '"']).is_some_and(|quote| !line[..quote].contains(' '))
}

#[test]
fn the_help_of_every_command_fits_the_terminal_and_loses_no_word() {
    let paths = paths();
    assert!(paths.len() >= 30, "{paths:?}");
    let mut parted = 0;
    for path in &paths {
        for flag in ["-h", "--help"] {
            let whole = help(path, flag, 0);
            for columns in [40, 60, 80] {
                let fitted = help(path, flag, columns);
                for line in fitted.lines().filter(|line| line.chars().count() > columns) {
                    assert!(is_one_word(line), "{path:?} {flag} at {columns}: {line:?}");
                }
                assert_eq!(words(&fitted), words(&whole), "{path:?} {flag} at {columns}");
                parted += fitted.lines().count() - whole.lines().count();
            }
        }
    }
    assert!(parted > 500, "{parted}");
}

#[test]
fn errors_of_the_command_line_fit_the_terminal_too() {
    let mut wrong = command(&["record", "--log", "nothing", "--seed", "x"]);
    let wrong = wrong.env("COLUMNS", "40").output().unwrap();
    let said = String::from_utf8(wrong.stderr).unwrap();
    assert_eq!((wrong.status.code(), wrong.stdout.len()), (Some(2), 0), "{said}");
    assert!(said.contains("--help") && said.lines().all(|line| line.chars().count() <= 40), "{said}");
}
