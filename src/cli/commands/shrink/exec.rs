//! `ExitCheck`, a command that tells by its exit code whether a run shows something.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicU64, Ordering};

use motion_lab::output::PassingFolder;
use motion_lab::recording::Run;
use motion_lab::run::{LogKind, Recipe};

use crate::cli::Failure;

/// What stands for the path of a candidate's log; without it the path is the command's last word.
const PATH: &str = "{}";

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
        Ok(self.code(recipe)? == Some(i32::from(self.expected)))
    }

    /// The exit code of the command for a recipe's run; `None` without one, and for a run that cannot start.
    fn code(&self, recipe: &Recipe) -> Result<Option<i32>, Failure> {
        let Ok(log) = Run::record_recipe(recipe.clone(), self.kind, |_| {}) else { return Ok(None) };
        let mut bytes = Vec::new();
        log.write_mcap(&mut bytes).map_err(Failure::internal)?;
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        let path = self.folder.path().join(format!("candidate-{number}.mcap"));
        fs::write(&path, bytes).map_err(|error| Failure::output(&path, &error))?;
        let command = self.command.replace(PATH, &quoted(&path));
        let mut shell = Command::new("sh");
        shell.arg("-c").arg(command).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        let ended = shell.status();
        // what can't be removed goes with the folder
        let _ = fs::remove_file(&path);
        let no_shell = |error| Failure::input(format!("--exec: sh can't be started: {error}"), "Put sh on the PATH.");
        Ok(ended.map_err(no_shell)?.code())
    }

    /// Why a run does not show it, in words; `None` where it does.
    pub fn refusal(&self, recipe: &Recipe) -> Result<Option<String>, Failure> {
        let (code, expected) = (self.code(recipe)?, self.expected);
        Ok(match code {
            Some(code) if code == i32::from(expected) => None,
            Some(code) => Some(format!("the command's exit code is {code}, expected {expected}")),
            None => Some(format!("the command was ended by a signal, expected exit code {expected}")),
        })
    }
}

/// A path as one word of a shell's command.
fn quoted(path: &Path) -> String {
    let path = path.display().to_string();
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "/._-".contains(c);
    if path.chars().all(is_plain) { path } else { format!("'{}'", path.replace('\'', r"'\''")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_stays_one_word() {
        assert_eq!(quoted(Path::new("/tmp/a-b/c_1.mcap")), "/tmp/a-b/c_1.mcap");
        assert_eq!(quoted(Path::new("/tmp/o'clock; x/c.mcap")), r"'/tmp/o'\''clock; x/c.mcap'");
    }
}
