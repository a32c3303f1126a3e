//! `completions` and `man`: the completions for a shell, and the manual pages.

mod manual;
mod shells;

pub use manual::ManPages;

use clap::{Args, Command};
use clap_complete::Shell;

use crate::cli::{Data, Failure, Outcome};

/// Print the completions for a shell.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab completions bash > ~/.local/share/bash-completion/completions/motion-lab
  motion-lab completions zsh > ~/.zfunc/_motion-lab
  motion-lab completions fish > ~/.config/fish/completions/motion-lab.fish
  motion-lab completions powershell >> $PROFILE
  motion-lab completions elvish >> ~/.config/elvish/rc.elv")]
pub struct Completions {
    /// The shell.
    shell: Shell,
}

impl Completions {
    /// Runs the command: completions of this program.
    pub fn run(self, mut program: Command, data: &mut Data) -> Result<Outcome, Failure> {
        let mut text = Vec::new();
        clap_complete::generate(self.shell, &mut program, shells::NAME, &mut text);
        let text = String::from_utf8(text).map_err(Failure::internal)?;
        data.text(&shells::mended(self.shell, &text))?;
        Ok(Outcome::Done)
    }
}
