//! `man`: the manual pages.

use std::io;
use std::path::{Path, PathBuf};

use clap::{Args, Command};

use crate::cli::support::console::note;
use crate::cli::support::output::{make_folder, write_file};
use crate::cli::support::target::Target;
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure, Outcome};
use clap_mangen::Man;

/// Print the manual page, or write the pages of all commands to a folder.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab man | man -l -
  motion-lab man -o ~/.local/share/man/man1")]
pub struct ManPages {
    /// Write motion-lab.1, motion-lab-record.1 and so on to this folder, which is made if need be.
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
}

impl ManPages {
    /// Runs the command: pages about this program.
    pub fn run(self, mut program: Command, data: &mut Data) -> Result<Outcome, Failure> {
        program.build();
        match &self.output {
            None => data.text(&page(&program)?)?,
            Some(folder) => {
                make_folder(folder)?;
                let pages = write_pages(&program, folder)?;
                note(format!("wrote {} to {}", counted(pages, "page"), folder.display()));
            }
        }
        Ok(Outcome::Done)
    }
}

/// Writes the page of a command and of each command below it; returns how many.
fn write_pages(command: &Command, folder: &Path) -> Result<usize, Failure> {
    let name = command.get_display_name().unwrap_or(command.get_name());
    write_file(&Target::file(&folder.join(format!("{name}.1")))?, page(command)?.as_bytes())?;
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
    let text = String::from_utf8(text).map_err(Failure::internal)?;
    // what stands after the help has sections of its own
    let text = text.replace(".SH EXTRA\nExamples:\n", ".SH EXAMPLES\n");
    Ok(keep_tables(&text.replace("\nExit codes:\n", "\n.SH \"EXIT STATUS\"\n")))
}

/// The page with its tables and examples as they are written: not filled, each line a line.
fn keep_tables(page: &str) -> String {
    let mut kept = String::with_capacity(page.len() + 64);
    let mut within = false;
    for line in page.lines() {
        let table = is_of_a_table(line);
        if table != within {
            kept.push_str(if table { ".nf\n" } else { ".fi\n" });
            within = table;
        }
        kept.push_str(line);
        kept.push('\n');
    }
    if within {
        kept.push_str(".fi\n");
    }
    kept
}

/// Whether a line is of a table or an example: indented, or with columns two blanks apart. Lines of roff's own are not.
fn is_of_a_table(line: &str) -> bool {
    !line.starts_with(['.', '\'']) && (line.starts_with("  ") || line.trim().contains("  "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_not_filled_and_sentences_are() {
        let page = ".SH DESCRIPTION\nOf two lines\none sentence.\n.PP\nname  what it is\nlong  the rest\n   0  done\n.SH EXTRA\nExamples:\n  lab one\n";
        let kept = ".SH DESCRIPTION\nOf two lines\none sentence.\n.PP\n.nf\nname  what it is\nlong  the rest\n   0  done\n.fi\n.SH EXTRA\nExamples:\n.nf\n  lab one\n.fi\n";
        assert_eq!(keep_tables(page), kept);
    }
}
