//! The page of a report.

use std::fmt::Write as _;
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use motion_lab_sim::run::Recipe;

use super::by_value::{failures as failures_by_kind, table};
use super::gathered::{Gathered, parameter_title, title};
use super::words::{escaped, rounded};
use crate::batch::{CellKind, RowValue, RunInputs, RunRow, Study};
use crate::capture::{Captured, Paper};
use crate::cli::support::words::counted;
use crate::web::Link;

/// The link that shows the run of a row in a browser and compares its digest; else why none can.
fn link(study: &Study, row: u64, digest: &str, site: &str) -> Result<String, String> {
    let setup = study.setup(row)?;
    let RunInputs::Script(script) = setup.inputs else { return Err("a planner makes its script".into()) };
    let recipe = Recipe::new(setup.config, (setup.seed, script));
    let link = Link::of(&recipe).map_err(|error| error.to_string())?;
    let link = Link { digest: Some(digest.to_owned()), ..link };
    link.address(site).map_err(|error| error.to_string())
}

/// The page. It has no colours of its own but those of its figures.
pub fn page(gathered: &Gathered, file: &Path, paper: &Paper, site: &str) -> String {
    let Gathered { study, rows, failed, worst, failures, .. } = gathered;
    let (name, runs) = (escaped(&file.display().to_string()), counted(rows, "run"));
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{name}: {runs}</title>\n\
             <meta name=\"viewport\" content=\"width=device-width\">\n<style>\n\
             :root {{ color-scheme: light dark; font-family: sans-serif; }}\nbody {{ margin: 1rem auto; padding: 0 1rem; max-width: 80rem; }}\n\
             svg, img {{ max-width: 100%; height: auto; }}\n.wide {{ overflow-x: auto; }}\n\
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
    let by_kind = failures_by_kind(gathered);
    if !by_kind.is_empty() {
        let _ = writeln!(page, "<h2>Failures by kind</h2>\n{by_kind}");
    }
    for (groups, figure) in gathered.groups.iter().zip(gathered.figures_by_value()) {
        let (table, picture) = (table(gathered, groups), image(&figure, paper));
        let _ = writeln!(page, "<h2>By {}</h2>\n{table}{picture}", escaped(&groups.name()));
    }
    let _ = writeln!(page, "<h2>Distributions</h2>\n{}", gathered.figure().svg(paper));
    list(gathered, &mut page, "Worst runs: most contacts, then least clearance", worst, (file, site));
    list(gathered, &mut page, "Failures, the first", failures, (file, site));
    page + "</body>\n</html>\n"
}

/// A figure as an image of its own: the names within it are no names of the page.
fn image(figure: &Captured, paper: &Paper) -> String {
    let data = STANDARD.encode(figure.svg(paper));
    format!("<img alt=\"{}\" src=\"data:image/svg+xml;base64,{data}\">", escaped(&figure.figure.description))
}

/// A table of runs: their parameters, results of the whole run, and the command and the link that show each.
fn list(gathered: &Gathered, page: &mut String, heading: &str, rows: &[RunRow], (file, site): (&Path, &str)) {
    let columns = gathered.study.columns();
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
                let link = match link(&gathered.study, row.row, digest, site) {
                    Ok(link) => format!("<a href=\"{}\">run {}</a>", escaped(&link), row.row),
                    Err(reason) => format!("no link: {}", escaped(&reason)),
                };
                format!(
                    "<code>motion-lab sweep reproduce '{}' --row {n} &amp;&amp; motion-lab open {n}.mcap</code></td><td>{link}",
                    escaped(&file.display().to_string().replace('\'', "'\\''")),
                    n = row.row
                )
            }
            _ => "there was no run</td><td>".into(),
        };
        let _ = writeln!(page, "<td>{see}</td></tr>");
    }
    page.push_str("</table></div>\n");
}
