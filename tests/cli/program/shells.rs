//! Completions, asked of the shells themselves. A shell that is not installed is named and left out.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::cli::run;

/// Whether a shell is installed; says aloud when it is not.
fn installed(shell: &str) -> bool {
    let there = Command::new(shell).arg("--version").output().is_ok_and(|output| output.status.success());
    if !there {
        println!("skipped: {shell} is not installed, so its completions were not asked");
    }
    there
}

/// A folder with the program's completions for a shell, and a world file.
fn folder(shell: &str, name: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(name), run(&["completions", shell]).done()).unwrap();
    fs::write(folder.path().join("yard.ron"), "").unwrap();
    folder
}

/// Asks a shell, by this program of its own, what follows after a line; returns the words of the answer.
fn asked(shell: &str, folder: &Path, program: &str, line: &str) -> Vec<String> {
    let flags: &[&str] = if shell == "zsh" { &["-f", "-c"] } else { &["-c"] };
    let output = Command::new(shell).args(flags).arg(program).args(["ask", line]).current_dir(folder).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    text.split_whitespace().map(str::to_owned).collect()
}

/// Lines that are completed, and what must be among the answers and what must not.
const LINES: [(&str, &[&str], &[&str]); 12] = [
    ("wor", &["world"], &["record"]),
    ("record --wo", &["--world"], &["--robot"]),
    ("record --world ", &["apartment", "workbench", "lot", "yard.ron"], &["--seed"]),
    ("record --robot ", &["Rusty", "Reach", "Hitch"], &["choset", "yard.ron"]),
    ("capture --widget ", &["dashboard", "anatomy", "atlas", "cspace", "plan"], &["lot", "yard.ron"]),
    ("capture --theme ", &["light", "dark"], &["lot", "yard.ron"]),
    ("query distance --robot ", &["rusty", "choset", "reach3", "Hitch"], &["lot", "yard.ron"]),
    ("export run.mcap --format ", &["jsonl", "csv", "svg", "png", "gif", "foxglove"], &["ros", "yard.ron"]),
    ("world export lot --format ", &["ros", "svg", "png"], &["csv", "yard.ron"]),
    ("world exp", &["export"], &["show"]),
    ("world show ", &["apartment", "lot"], &["record"]),
    ("query wit", &["witness"], &["swept"]),
];

#[track_caller]
fn check(shell: &str, asked: impl Fn(&str) -> Vec<String>) {
    for (line, there, not_there) in LINES {
        let answers = asked(line);
        for word in there {
            assert!(answers.iter().any(|a| a == word), "{shell}: {word} is not offered after {line:?}: {answers:?}");
        }
        for word in not_there {
            assert!(answers.iter().all(|a| a != word), "{shell}: {word} is offered after {line:?}: {answers:?}");
        }
    }
}

#[test]
fn bash_completes_commands_options_and_values() {
    if !installed("bash") {
        return;
    }
    let folder = folder("bash", "lab.bash");
    // what bash does at a tab: the words of the line, then the function that the completions name
    let program = "source ./lab.bash; line=\"motion-lab $1\"; read -ra COMP_WORDS <<<\"$line\"
        [[ $line == *' ' ]] && COMP_WORDS+=(''); COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
        spec=$(complete -p motion-lab); spec=${spec#*-F }; function=${spec%% *}
        $function motion-lab \"${COMP_WORDS[COMP_CWORD]}\" \"${COMP_WORDS[COMP_CWORD - 1]}\"
        printf '%s\\n' \"${COMPREPLY[@]}\"";
    check("bash", |line| asked("bash", folder.path(), program, line));
}

#[test]
fn fish_completes_commands_options_and_values() {
    if !installed("fish") {
        return;
    }
    let folder = folder("fish", "lab.fish");
    let program = "source ./lab.fish; complete -C \"motion-lab $argv[2]\"";
    check("fish", |line| asked("fish", folder.path(), program, line));
}

#[test]
fn zsh_completes_commands_options_and_values() {
    if !installed("zsh") {
        return;
    }
    let folder = folder("zsh", "_motion-lab");
    // a zsh at a pseudo terminal, whose tab key lists what there is; the line is then taken back
    let program = "zmodload zsh/zpty; zpty lab zsh -f -i
        zpty -w lab \"fpath=($PWD \\$fpath); autoload -Uz compinit; compinit -u -D; bindkey '^I' list-choices\"
        zpty -w lab \"stty cols 400; PS1='<la''b>'\"; zpty -r lab out '*<lab>*'
        zpty -w -n lab \"motion-lab $1\"$'\\t\\x15'\"echo do''ne\"$'\\n'; zpty -r lab out '*done*'; print -r -- $out";
    let plain = |word: &str| {
        let mut text = String::new();
        let mut rest = word.chars();
        while let Some(c) = rest.next() {
            // a terminal's control sequence ends at a letter
            if c == '\u{1b}' {
                rest.by_ref().find(char::is_ascii_alphabetic)
            } else {
                text.push(c);
                None
            };
        }
        text
    };
    check("zsh", |line| asked("zsh", folder.path(), program, line).iter().map(|word| plain(word)).collect());
}

#[test]
fn powershell_completes_commands_and_options() {
    if !installed("pwsh") {
        return;
    }
    let folder = folder("powershell", "lab.ps1");
    let program = |line: &str| {
        let line = format!("motion-lab {line}");
        format!(". ./lab.ps1; (TabExpansion2 '{line}' {}).CompletionMatches.CompletionText", line.len())
    };
    for (line, word) in [("wor", "world"), ("record --wo", "--world"), ("world exp", "export")] {
        let arguments = ["-NoProfile", "-Command", &program(line)];
        let asked = Command::new("pwsh").args(arguments).current_dir(folder.path()).output().unwrap();
        let answers = String::from_utf8(asked.stdout).unwrap();
        assert!(answers.split_whitespace().any(|answer| answer == word), "{word} after {line}: {answers}");
    }
}

/// The text of the string that a text begins with, as PowerShell and Elvish write it: in single quotes, which are
/// doubled within; and what comes after it.
fn quoted(text: &str) -> (String, &str) {
    let mut rest = text.strip_prefix('\'').unwrap_or_else(|| panic!("no string: {text}"));
    let mut string = String::new();
    loop {
        let end = rest.find('\'').unwrap_or_else(|| panic!("a string without an end: {text}"));
        string.push_str(&rest[..end]);
        rest = &rest[end + 1..];
        match rest.strip_prefix('\'') {
            Some(after) => {
                string.push('\'');
                rest = after;
            }
            None => return (string, rest),
        }
    }
}

/// What completions offer after each command, `motion-lab;world;export`. Every line between the first command and the
/// end of the last has to be of the language.
fn offered(shell: &str, text: &str) -> BTreeMap<String, BTreeSet<String>> {
    let is_powershell = shell == "powershell";
    let (before, after) = if is_powershell { ("", " {") } else { ("&", "= {") };
    let mut offered: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let mut command: Option<String> = None;
    let begin = text.lines().skip_while(|line| line.trim() != format!("{before}'motion-lab'{after}"));
    for line in begin.map(str::trim) {
        match &command {
            None if line == "]" || line == "})" => return offered,
            None => {
                let (path, rest) = quoted(line.strip_prefix(before).unwrap());
                assert_eq!(rest, after, "{line}");
                assert!(offered.insert(path.clone(), BTreeSet::new()).is_none(), "{path} twice");
                command = Some(path);
            }
            Some(_) if line == "}" => command = None,
            Some(_) if line == "break" && is_powershell => {}
            Some(path) => {
                let word = if is_powershell {
                    let (word, rest) = quoted(line.strip_prefix("[CompletionResult]::new(").unwrap());
                    let (_, rest) = quoted(rest.strip_prefix(", ").unwrap());
                    let (kind, rest) =
                        rest.strip_prefix(", [CompletionResultType]::").unwrap().split_once(", ").unwrap();
                    assert_eq!(kind, if word.starts_with('-') { "ParameterName" } else { "ParameterValue" }, "{line}");
                    assert_eq!(quoted(rest).1, ")", "{line}");
                    word
                } else {
                    let (word, rest) = line.strip_prefix("cand ").unwrap().split_once(' ').unwrap();
                    assert_eq!(quoted(rest).1, "", "{line}");
                    word.to_owned()
                };
                assert!(offered.get_mut(path).unwrap().insert(word), "{line} twice");
            }
        }
    }
    panic!("no end")
}

/// The options and the commands that the help of a command lists.
fn listed(command: &[&str]) -> BTreeSet<String> {
    let help = run(&[command, &["--help"]].concat()).done();
    let mut listed = BTreeSet::new();
    let mut among_commands = false;
    for line in help.lines() {
        let (indent, word) = (line.len() - line.trim_start().len(), line.trim_start());
        if indent == 0 {
            among_commands = line == "Commands:";
        } else if among_commands && indent == 2 {
            listed.extend(word.split(' ').next().map(str::to_owned));
        } else if (2..=6).contains(&indent) && word.starts_with('-') {
            let words = word.split([' ', ',']).filter(|word| word.starts_with('-'));
            listed.extend(words.map(|word| word.trim_end_matches("...").to_owned()));
        }
    }
    listed
}

/// Shells that few machines have: what their completions offer after each command is what its help lists, and every
/// line is of the shell's language. The shells themselves are not asked here.
#[test]
fn completions_of_powershell_and_elvish_offer_what_the_help_lists() {
    for shell in ["powershell", "elvish"] {
        let offered = offered(shell, &run(&["completions", shell]).done());
        let mut commands = 0;
        for (path, words) in offered.iter().filter(|(path, _)| !path.contains(";help")) {
            let command: Vec<&str> = path.split(';').skip(1).collect();
            assert_eq!(*words, listed(&command), "{shell}: {path}");
            commands += 1;
            for below in words.iter().filter(|word| !word.starts_with('-') && *word != "help") {
                assert!(offered.contains_key(&format!("{path};{below}")), "{shell}: {path} {below}");
            }
        }
        assert!(commands > 20, "{commands}");
    }
}
