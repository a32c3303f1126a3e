//! `ExitCheck`, a command that tells by its exit code whether a run shows something.

use std::fs::{self, File};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicU64, Ordering};

use crate::output::PassingFolder;
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{LogKind, Recipe};

use super::written::quoted;
use crate::cli::Failure;

/// What stands for the path of a candidate's log; without it the path is the command's last word.
const PATH: &str = "{}";

/// The most lines of what a command says that are shown, the last ones.
const MAX_LINES: usize = 10;

/// A command that is run for each candidate.
pub struct ExitCheck {
    command: String,
    expected: u8,
    kind: LogKind,
    folder: PassingFolder,
    /// The number of the next candidate.
    next: AtomicU64,
}

impl ExitCheck {
    /// The check by a command, whose candidates' logs are of this kind.
    pub fn new(command: &str, expected: u8, kind: LogKind) -> Result<Self, Failure> {
        let command = if command.contains(PATH) { command.to_owned() } else { format!("{command} {PATH}") };
        let folder = PassingFolder::new().map_err(|error| Failure::output(&std::env::temp_dir(), &error))?;
        Ok(ExitCheck { command, expected, kind, folder, next: AtomicU64::new(0) })
    }

    /// Whether the command ends as expected for a recipe's run. False for one that cannot start.
    pub fn holds(&self, recipe: &Recipe) -> Result<bool, Failure> {
        let Ok(log) = self.log_of(recipe) else { return Ok(false) };
        Ok(self.code(log, Stdio::null())? == Some(i32::from(self.expected)))
    }

    /// The log of a recipe's run.
    fn log_of(&self, recipe: &Recipe) -> Result<Vec<u8>, Failure> {
        let log = Run::record_recipe(recipe.clone(), self.kind, |_| {}).map_err(Failure::internal)?;
        let mut bytes = Vec::new();
        log.write_mcap(&mut bytes).map_err(Failure::internal)?;
        Ok(bytes)
    }

    /// The exit code of the command for a log, where it has one. What it says on standard error goes to `said`.
    fn code(&self, log: Vec<u8>, said: Stdio) -> Result<Option<i32>, Failure> {
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        let path = self.folder.path().join(format!("candidate-{number}.mcap"));
        fs::write(&path, log).map_err(|error| Failure::output(&path, &error))?;
        let command = self.command.replace(PATH, &quoted(&path.display().to_string()));
        let mut shell = Command::new("sh");
        shell.arg("-c").arg(command).stdin(Stdio::null()).stdout(Stdio::null()).stderr(said);
        let ended = shell.status();
        // what can't be removed goes with the folder
        let _ = fs::remove_file(&path);
        let no_shell = |error| Failure::input(format!("--exec: sh can't be started: {error}"), "Put sh on the PATH.");
        Ok(ended.map_err(no_shell)?.code())
    }

    /// Why a run does not show it, in words, and what the command says; `None` where it does.
    pub fn refusal(&self, recipe: &Recipe) -> Result<Option<String>, Failure> {
        let said = self.folder.path().join("said");
        let file = File::create(&said).map_err(|error| Failure::output(&said, &error))?;
        let (code, expected) = (self.code(self.log_of(recipe)?, file.into())?, self.expected);
        let meaning = match code {
            Some(126) => " (126: the command is there but can't be run)",
            Some(127) => " (127: there is no such command)",
            _ => "",
        };
        let found = match code {
            Some(code) if code == i32::from(expected) => return Ok(None),
            Some(code) => format!("the command's exit code is {code}, expected {expected}{meaning}"),
            None => format!("the command was ended by a signal, expected exit code {expected}"),
        };
        Ok(Some(format!("{found}{}", last_lines(&fs::read(&said).unwrap_or_default()))))
    }
}

/// The last lines of what a command says, each behind a line's end; nothing where it says nothing.
fn last_lines(said: &[u8]) -> String {
    let said = String::from_utf8_lossy(said);
    let lines: Vec<&str> = said.lines().filter(|line| !line.trim().is_empty()).collect();
    let last = lines.iter().skip(lines.len().saturating_sub(MAX_LINES));
    let plain = |line: &&str| line.chars().map(|c| if c.is_control() { ' ' } else { c }).take(200).collect::<String>();
    last.map(|line| format!("\n  {}", plain(line))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_lines_are_shown_and_no_controls_of_a_terminal() {
        assert_eq!(last_lines(b" \n"), "");
        assert_eq!(last_lines(b"a\x1bb\n\nc"), "\n  a b\n  c");
        let many: String = (0..30).map(|i| format!("{i}\n")).collect();
        assert!(last_lines(many.as_bytes()).starts_with("\n  20\n") && last_lines(many.as_bytes()).ends_with("\n  29"));
    }
}
