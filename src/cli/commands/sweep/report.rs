//! `sweep report`: what became of a sweep's runs, as one page or one figure.

use motion_lab_core::picture::Theme;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use crate::batch::{CellKind, Column, RowValue, RunInputs, RunRow, Study, TableError, TableFile};
use crate::capture::{Captured, Distribution, Paper, histograms};
use crate::web::Link;
use clap::{Args, ValueEnum};
use motion_lab_sim::run::Recipe;

use crate::cli::support::choices;
use crate::cli::support::choices::Site;
use crate::cli::support::input::{is_dash, open};
use crate::cli::support::output::write_text;
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure, Outcome};

/// Show what became of a sweep's runs: distributions, the worst runs, the failures.
///
/// A page (.html) stands alone. For each run it names it has the command that shows it in the window, and the link that
/// shows it in a browser or why no link can. A figure (.svg) has the distributions only.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab sweep report noise.parquet -o noise.html
  motion-lab sweep report noise.parquet --theme dark -o noise.svg")]
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

/// Runs that are listed of each sort.
const LISTED: usize = 20;

/// The results of a whole run that have a distribution.
const SHOWN: [&str; 12] = [
    "contacts",
    "first_contact_s",
    "least_clearance_m",
    "path_m",
    "at_goal_s",
    "first_at_goal_s",
    "iterations",
    "edges",
    "planned_path_m",
    "planned_path_rad",
    "planned_clearance_m",
    "planned_time_s",
];

/// What a report is made of.
struct Gathered {
    study: Study,
    rows: u64,
    failed: u64,
    distributions: Vec<Distribution>,
    /// The runs with the most contacts, then the least clearance; worst first.
    worst: Vec<RunRow>,
    /// The first runs that failed.
    failures: Vec<RunRow>,
}

/// The number in a cell.
fn number(cell: Option<&RowValue>) -> Option<f64> {
    match cell {
        Some(RowValue::Whole(n)) => Some(*n as f64),
        Some(RowValue::Number(x)) => Some(*x),
        _ => None,
    }
}

/// The name of a column without its unit, and the unit where the name does not say it.
fn parts_of(column: &Column) -> (&str, Option<&str>) {
    let unit = Some(column.unit.as_str()).filter(|unit| !unit.is_empty() && *unit != column.name);
    let name = unit.and_then(|unit| column.name.strip_suffix(unit)?.strip_suffix('_'));
    (name.unwrap_or(&column.name), unit)
}

/// What a parameter is, called as the study calls it, with its unit.
fn parameter_title(column: &Column) -> String {
    let (name, unit) = parts_of(column);
    unit.map_or_else(|| name.to_owned(), |unit| format!("{name}, {unit}"))
}

/// What a result is, in words, with its unit.
fn title(column: &Column) -> String {
    let (name, unit) = parts_of(column);
    let name = name.replace('_', " ");
    unit.map_or_else(|| name.clone(), |unit| format!("{name}, {unit}"))
}

/// The link that shows the run of a row in a browser and compares its digest; else why none can.
fn link(study: &Study, row: u64, digest: &str, site: &str) -> Result<String, String> {
    let setup = study.setup(row)?;
    let RunInputs::Script(script) = setup.inputs else { return Err("a planner makes its script".into()) };
    let recipe = Recipe::new(setup.config, (setup.seed, script));
    let link = Link::of(&recipe).map_err(|error| error.to_string())?;
    let link = Link { digest: Some(digest.to_owned()), ..link };
    link.address(site).map_err(|error| error.to_string())
}

impl Gathered {
    fn of(file: &Path) -> Result<Self, Failure> {
        if file.extension().is_some_and(|ending| ending == "csv") {
            return Err(Failure::input(
                format!("{}: a table of comma-separated values does not hold its study", file.display()),
                "Name the table that ends in .parquet; `sweep merge` writes both.",
            ));
        }
        let refused = |error: TableError| {
            Failure::input(
                format!("{}: {error}", file.display()),
                "Name a table that ends in .parquet and that `sweep merge` wrote.",
            )
        };
        let table = TableFile::open(open(file)?).map_err(refused)?;
        let study = table.study().clone();
        let columns = study.columns();
        let shown: Vec<&Column> = columns.iter().filter(|column| SHOWN.contains(&column.name.as_str())).collect();
        let mut distributions: Vec<Distribution> =
            shown.iter().map(|column| Distribution { name: title(column), values: Vec::new() }).collect();
        let (mut rows, mut failed) = (0, 0);
        let (mut worst, mut failures): (Vec<RunRow>, Vec<RunRow>) = (Vec::new(), Vec::new());
        // worst first; of equals the one of the lesser number
        let badness = |row: &RunRow| {
            let contacts = number(row.cell(columns, "contacts")).unwrap_or(0.0);
            (contacts, number(row.cell(columns, "least_clearance_m")).unwrap_or(f64::INFINITY))
        };
        let order = |a: &RunRow, b: &RunRow| {
            let ((contacts, clearance), (others, other)) = (badness(a), badness(b));
            others.total_cmp(&contacts).then(clearance.total_cmp(&other)).then(a.row.cmp(&b.row))
        };
        table
            .each(|row| {
                rows += 1;
                for (distribution, column) in distributions.iter_mut().zip(&shown) {
                    distribution.values.extend(number(row.cell(columns, &column.name)));
                }
                if row.is_failure(columns) {
                    failed += 1;
                    if failures.len() < LISTED {
                        failures.push(row.clone());
                    }
                }
                if row.has_contacts(columns) || number(row.cell(columns, "least_clearance_m")).is_some() {
                    let at = worst.partition_point(|known| order(known, &row).is_lt());
                    if at < LISTED {
                        worst.insert(at, row);
                        worst.truncate(LISTED);
                    }
                }
            })
            .map_err(refused)?;
        Ok(Gathered { study, rows, failed, distributions, worst, failures })
    }

    fn figure(&self) -> Captured {
        let digest = self.study.digest().to_string();
        histograms(&format!("{} of a sweep", counted(self.rows, "run")), &self.distributions, vec![("Study", digest)])
    }

    /// The page. It has no colours of its own but those of its figure.
    fn page(&self, file: &Path, figure: &str, site: &str) -> String {
        let Gathered { study, rows, failed, worst, failures, .. } = self;
        let (name, runs) = (escaped(&file.display().to_string()), counted(rows, "run"));
        let mut page = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{name}: {runs}</title>\n\
             <meta name=\"viewport\" content=\"width=device-width\">\n<style>\n\
             :root {{ color-scheme: light dark; font-family: sans-serif; }}\nbody {{ margin: 1rem auto; max-width: 80rem; }}\n\
             svg {{ max-width: 100%; height: auto; }}\n.wide {{ overflow-x: auto; }}\n\
             td, th {{ padding: 0.2rem 0.6rem; text-align: left; vertical-align: top; }}\n</style>\n</head>\n<body>\n\
             <h1>{name}</h1>\n<p>{runs}, {failed} of them failed. Study {}.</p>\n",
            study.digest()
        );
        let axes = study.axes().map(|(axis, len)| match len {
            Some(1) => format!("{} (1 value)", escaped(&axis)),
            Some(len) => format!("{} ({len} values)", escaped(&axis)),
            None => escaped(&axis),
        });
        let axes = axes.collect::<Vec<_>>().join(", ");
        // writing into a string can't fail
        let _ = writeln!(page, "<p>Varied: {}.</p>", if axes.is_empty() { "nothing" } else { axes.as_str() });
        let _ = writeln!(page, "<h2>Distributions</h2>\n{figure}");
        self.list(&mut page, "Worst runs: most contacts, then least clearance", worst, (file, site));
        self.list(&mut page, "Failures, the first", failures, (file, site));
        page + "</body>\n</html>\n"
    }

    /// A table of runs: their parameters, results of the whole run, and the command and the link that show each.
    fn list(&self, page: &mut String, heading: &str, rows: &[RunRow], (file, site): (&Path, &str)) {
        let columns = self.study.columns();
        let shown = columns.iter().position(|column| column.name == "digest").unwrap_or(columns.len());
        let _ = writeln!(page, "<h2>{heading}</h2>");
        if rows.is_empty() {
            page.push_str("<p>None.</p>\n");
            return;
        }
        page.push_str("<div class=\"wide\"><table>\n<tr>");
        let results = columns.iter().position(|column| column.name == "failure").unwrap_or(0);
        for (i, column) in columns[..shown].iter().enumerate() {
            let title = if i < results { parameter_title(column) } else { title(column) };
            let _ = write!(page, "<th title=\"{}\">{}</th>", escaped(&column.about), escaped(&title));
        }
        page.push_str("<th>in the window</th><th>in a browser</th></tr>\n");
        for row in rows {
            page.push_str("<tr>");
            for (cell, column) in row.cells.iter().zip(&columns[..shown]) {
                let text = match (cell, column.kind) {
                    (RowValue::Empty, _) => String::new(),
                    (RowValue::Whole(n), _) => n.to_string(),
                    (RowValue::Number(x), CellKind::Number) => rounded(*x),
                    (RowValue::Number(x), _) => x.to_string(),
                    (RowValue::Text(text), _) => escaped(text),
                };
                let _ = write!(page, "<td>{text}</td>");
            }
            let see = match row.cell(columns, "digest") {
                Some(RowValue::Text(digest)) => {
                    let link = match link(&self.study, row.row, digest, site) {
                        Ok(link) => format!("<a href=\"{}\">run {}</a>", escaped(&link), row.row),
                        Err(reason) => format!("no link: {}", escaped(&reason)),
                    };
                    format!(
                        "<code>motion-lab sweep reproduce '{}' --row {n} &amp;&amp; motion-lab open {n}.mcap</code></td><td>{link}",
                        escaped(&file.display().to_string().replace('\'', "'\\''")),
                        n = row.row
                    )
                }
                _ => "it could not be run</td><td>".into(),
            };
            let _ = writeln!(page, "<td>{see}</td></tr>");
        }
        page.push_str("</table></div>\n");
    }
}

/// A number with six decimals at most.
fn rounded(x: f64) -> String {
    let text = format!("{x:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A text as HTML has it.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

impl Report {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let form = self.form()?;
        let gathered = Gathered::of(&self.table)?;
        let paper = Paper { palette: self.theme.palette(), width: 1280, scale: 1.0 };
        let figure = gathered.figure().svg(&paper);
        let text = match form {
            PageForm::Svg => figure,
            PageForm::Html => gathered.page(&self.table, &figure, &self.site.site),
        };
        write_text(Some(&self.output), &text, data)?;
        Ok(Outcome::Done)
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
