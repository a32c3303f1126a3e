//! `sweep report`: what became of a sweep's runs, as one page or one figure.

mod by_value;
mod gathered;
mod grouping;
mod page;
mod words;

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use motion_lab_core::names::{hint, nearest};
use motion_lab_core::picture::Theme;

use crate::capture::Paper;
use crate::cli::support::choices::{self, Site};
use crate::cli::support::input::is_dash;
use crate::cli::support::output::write_text;
use crate::cli::{Data, Failure, Outcome};
use gathered::Gathered;
use grouping::{MAX_GROUPS, RowGroups};

/// Show what became of a sweep's runs: distributions, the worst runs, the failures.
///
/// A page (.html) stands alone. For each parameter that took two to twelve values it has a table and boxes: how many
/// runs each value had, how many were solved and failed and by which kind of failure, and the results by quartiles;
/// shares and medians with their intervals of 95 %. For each run it names it has the command that shows it in the
/// window, and the link that shows it in a browser or why no link can. A figure (.svg) has the distributions only, or
/// with --by the boxes of a parameter. A table that was changed is refused.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab sweep report noise.parquet -o noise.html
  motion-lab sweep report noise.parquet --theme dark -o noise.svg
  motion-lab sweep report planners.parquet --by planner -o planners.svg
  motion-lab sweep report planners.parquet --by planner,seed -o planners.html")]
pub struct Report {
    /// The table that `sweep merge` wrote, .parquet.
    #[arg(value_name = "TABLE")]
    table: PathBuf,
    /// The page (.html) or figure (.svg) to write. `-` is standard output.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The form. [default: by the output's name; html for `-`]
    #[arg(long)]
    format: Option<PageForm>,
    /// The parameter whose values have figures of their own, as the study calls it; or several, joined by commas, whose
    /// combinations have. [default: in a page each of two to twelve values by itself]
    #[arg(long, value_name = "PARAMETERS", value_delimiter = ',')]
    by: Vec<String>,
    #[command(flatten)]
    site: Site,
    /// The colours of the figure.
    #[arg(long, value_parser = choices::theme(), default_value = "light")]
    theme: Theme,
}

/// The form of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum PageForm {
    /// A page.
    Html,
    /// A figure.
    Svg,
}

impl Report {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let form = self.form()?;
        let mut gathered = Gathered::of(&self.table)?;
        if !self.by.is_empty() {
            gathered.groups = vec![self.groups_asked(&gathered.groups)?];
        }
        let paper = Paper { palette: self.theme.palette(), width: 1280, scale: 1.0 };
        let text = match (form, &self.by[..]) {
            (PageForm::Svg, []) => gathered.figure().svg(&paper),
            (PageForm::Svg, _) => gathered.figures_by_value().map(|figure| figure.svg(&paper)).collect(),
            (PageForm::Html, _) => page::page(&gathered, &self.table, &paper, &self.site.site),
        };
        write_text(Some(&self.output), &text, data)?;
        Ok(Outcome::Done)
    }

    /// The rows by the values of the parameters that were asked for.
    fn groups_asked(&self, known: &[RowGroups]) -> Result<RowGroups, Failure> {
        let mut asked = Vec::new();
        for (i, name) in self.by.iter().enumerate() {
            let reason = if self.by[..i].contains(name) {
                format!("--by {}: {name} stands there twice", self.by.join(","))
            } else if let Some(groups) = known.iter().find(|groups| groups.name() == *name) {
                asked.push(groups);
                continue;
            } else {
                self.unknown(name, known)
            };
            return Err(Failure::usage(reason, "Name each of them once, or leave out --by."));
        }
        RowGroups::crossed(&asked).ok_or_else(|| {
            let reason = format!("--by {}: more than {MAX_GROUPS} combinations of their values", self.by.join(","));
            Failure::usage(reason, "Name fewer parameters.")
        })
    }

    /// What is said of a parameter that is none of few values.
    fn unknown(&self, name: &str, known: &[RowGroups]) -> String {
        let known: Vec<String> = known.iter().map(RowGroups::name).collect();
        let there = match &known[..] {
            [] => "no parameter took two to twelve values".to_owned(),
            known => format!("those of two to twelve values are {}", known.join(", ")),
        };
        let meant = hint(nearest(name, known.iter().map(String::as_str)));
        format!("--by {name}: {} has no such parameter; {there}{meant}", self.table.display())
    }

    /// The form: what was said, else what the output's name tells, else a page for standard output.
    fn form(&self) -> Result<PageForm, Failure> {
        let named = match self.output.extension().and_then(|ending| ending.to_str()) {
            Some("html") => Some(PageForm::Html),
            Some("svg") => Some(PageForm::Svg),
            _ => is_dash(&self.output).then_some(PageForm::Html),
        };
        self.format.or(named).ok_or_else(|| {
            Failure::usage(
                format!("{}: no report has this ending", self.output.display()),
                "Name a file that ends in .html or .svg, or say --format.",
            )
        })
    }
}
