//! The table of what became of the runs of each value of a parameter.

use std::fmt::Write as _;

use super::gathered::Gathered;
use super::words::{escaped, rounded};
use crate::capture::{ByValue, Quartiles};

/// The table of an axis of this number: for each value its runs, how they ended, and their results by quartiles.
pub fn table(gathered: &Gathered, axis: usize) -> String {
    let results: Vec<ByValue> = gathered.results_by_value(axis).filter(has_numbers).collect();
    let mut page = String::from("<div class=\"wide\"><table>\n<tr>");
    let solved = gathered.is_planned.then_some("solved");
    let heads = [Some(gathered.axes[axis].name.as_str()), Some("runs"), solved, Some("failed")];
    for head in heads.into_iter().flatten().chain(results.iter().map(|result| result.name.as_str())) {
        // writing into a string can't fail
        let _ = write!(page, "<th>{}</th>", escaped(head));
    }
    page.push_str("</tr>\n");
    let counts = gathered.counts().nth(axis).unwrap_or_default();
    for (number, (value, count)) in gathered.axes[axis].values.iter().zip(counts).enumerate() {
        let _ = write!(page, "<tr><td>{}</td><td>{}</td>", escaped(value), count.runs);
        if gathered.is_planned {
            let _ = write!(page, "<td>{}</td>", count.solved);
        }
        let _ = write!(page, "<td>{}</td>", count.failed);
        for result in &results {
            let found = Quartiles::of(result.groups[number].1.iter().copied());
            let _ = write!(page, "<td>{}</td>", found.as_ref().map_or(String::new(), quartiles));
        }
        page.push_str("</tr>\n");
    }
    page + "</table></div>\n<p>Results: the median, with the quartiles.</p>\n"
}

fn has_numbers(result: &ByValue) -> bool {
    result.groups.iter().any(|(_, numbers)| !numbers.is_empty())
}

/// `2.5 (1.75 to 3.25)`; one number where all are the same.
fn quartiles(of: &Quartiles) -> String {
    let median = rounded(of.median);
    if of.least == of.greatest { median } else { format!("{median} ({} to {})", rounded(of.lower), rounded(of.upper)) }
}
