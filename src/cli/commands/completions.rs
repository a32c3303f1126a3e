//! `completions` and `man`: the completions for a shell, and the manual pages.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use clap::{Args, Command, CommandFactory};
use clap_complete::Shell;
use clap_mangen::Man;

use crate::cli::support::output::write_file;
use crate::cli::{Cli, Data, Failure, Outcome, say};

/// Print the completions for a shell.
///
/// For bash: `motion-lab completions bash > ~/.local/share/bash-completion/completions/motion-lab`.
#[derive(Debug, Args)]
pub struct Completions {
    /// The shell.
    shell: Shell,
}

impl Completions {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let mut text = Vec::new();
        clap_complete::generate(self.shell, &mut Cli::command(), "motion-lab", &mut text);
        data.text(&String::from_utf8(text).map_err(Failure::internal)?)?;
        Ok(Outcome::Done)
    }
}

/// Print the manual page, or write the pages of all commands to a folder.
#[derive(Debug, Args)]
pub struct ManPages {
    /// Write motion-lab.1, motion-lab-record.1 and so on to this folder, which is made if need be.
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
}

impl ManPages {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let mut program = Cli::command();
        program.build();
        match &self.output {
            None => data.text(&page(&program)?)?,
            Some(folder) => {
                fs::create_dir_all(folder).map_err(|error| Failure::output(folder, &error))?;
                let pages = write_pages(&program, folder)?;
                say(format!("wrote {pages} pages to {}", folder.display()));
            }
        }
        Ok(Outcome::Done)
    }
}

/// Writes the page of a command and of each command below it; returns how many.
fn write_pages(command: &Command, folder: &Path) -> Result<usize, Failure> {
    let name = command.get_display_name().unwrap_or(command.get_name());
    write_file(&folder.join(format!("{name}.1")), page(command)?.as_bytes())?;
    let mut pages = 1;
    for below in command.get_subcommands().filter(|c| c.get_name() != "help") {
        pages += write_pages(below, folder)?;
    }
    Ok(pages)
}

fn page(command: &Command) -> Result<String, Failure> {
    let mut text = Vec::new();
    let rendered: io::Result<()> = Man::new(command.clone()).render(&mut text);
    rendered.map_err(Failure::internal)?;
    String::from_utf8(text).map_err(Failure::internal)
}
