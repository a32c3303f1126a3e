//! The table of what became of the runs of each value of a parameter, or of several together.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::gathered::Gathered;
use super::grouping::{RowEnd, RowGroups};
use super::words::{escaped, rounded, share};
use crate::capture::{ByValue, ConfidenceInterval, Quartiles};

/// What the tables' numbers are, for who reads the page.
pub const LEGEND: &str = "<p>Results: the median, with the quartiles, and in brackets the interval of 95 % of the \
    median by order statistics, which fewer than six runs do not have. Shares: with Wilson's interval of \
    95 %.</p>\n";

/// The table of the runs by groups: for each its runs, how they ended, and their results by quartiles.
pub fn table(gathered: &Gathered, groups: &RowGroups) -> String {
    let results: Vec<ByValue> = gathered.results_by_value(groups).filter(has_numbers).collect();
    let mut page = String::from("<div class=\"wide\"><table>\n<tr>");
    let solved = gathered.is_planned;
    let counts = [("runs", true), ("solved", solved), ("failed", true)];
    let shares = [("share solved", solved), ("share failed", true), ("failed by kind", gathered.failed > 0)];
    let heads = counts.into_iter().chain(shares).filter(|(_, is_there)| *is_there).map(|(head, _)| head);
    let names = groups.parameters.iter().map(String::as_str);
    for head in names.chain(heads).chain(results.iter().map(|result| result.name.as_str())) {
        // writing into a string can't fail
        let _ = write!(page, "<th>{}</th>", escaped(head));
    }
    page.push_str("</tr>\n");
    for (number, values) in groups.groups.iter().enumerate() {
        let ended: Vec<&RowEnd> = groups.rows_of(number).filter_map(|row| gathered.ended.get(row)).collect();
        let count = |is: fn(&RowEnd) -> bool| ended.iter().filter(|end| is(end)).count() as u64;
        let runs = ended.len() as u64;
        let (solved, failed) = (count(|end| end.is_solved), count(|end| end.failure.is_some()));
        let mut cells: Vec<String> = values.iter().map(|value| escaped(value)).collect();
        cells.push(runs.to_string());
        cells.extend(gathered.is_planned.then(|| solved.to_string()));
        cells.push(failed.to_string());
        cells.extend(gathered.is_planned.then(|| share(solved, runs)));
        cells.push(share(failed, runs));
        if gathered.failed > 0 {
            let kinds = kinds(gathered, ended.iter().copied());
            cells.push(kinds.iter().map(|(kind, n)| format!("{} {n}", escaped(kind))).collect::<Vec<_>>().join(", "));
        }
        cells.extend(results.iter().map(|result| quartiles(&result.groups[number].1)));
        let _ = write!(page, "<tr>");
        cells.iter().for_each(|cell| _ = write!(page, "<td>{cell}</td>"));
        page.push_str("</tr>\n");
    }
    page + "</table></div>\n" + LEGEND
}

/// The table of the failures by their kinds, the most frequent first; empty without any.
pub fn failures(gathered: &Gathered) -> String {
    if gathered.failed == 0 {
        return String::new();
    }
    let mut kinds: Vec<(&str, u64)> = kinds(gathered, gathered.ended.iter()).into_iter().collect();
    kinds.sort_by(|(a, n), (b, m)| m.cmp(n).then(a.cmp(b)));
    let mut page =
        String::from("<div class=\"wide\"><table>\n<tr><th>failure_kind</th><th>runs</th><th>share</th></tr>\n");
    for (kind, count) in kinds {
        let _ = writeln!(
            page,
            "<tr><td>{}</td><td>{count}</td><td>{}</td></tr>",
            escaped(kind),
            share(count, gathered.rows)
        );
    }
    page + "</table></div>\n"
}

/// The number of failures of each kind.
fn kinds<'a>(gathered: &'a Gathered, ended: impl Iterator<Item = &'a RowEnd>) -> BTreeMap<&'a str, u64> {
    let mut kinds = BTreeMap::new();
    let of = |end: &RowEnd| gathered.kinds.get(usize::from(end.failure?));
    ended.filter_map(of).for_each(|kind| *kinds.entry(kind.as_str()).or_default() += 1);
    kinds
}

fn has_numbers(result: &ByValue) -> bool {
    result.groups.iter().any(|(_, numbers)| !numbers.is_empty())
}

/// `2.5 (1.75 to 3.25) [1 to 4]`; one number where all are the same, nothing without any.
fn quartiles(numbers: &[f64]) -> String {
    let Some(of) = Quartiles::of(numbers.iter().copied()) else { return String::new() };
    let median = rounded(of.median);
    if of.least == of.greatest {
        return median;
    }
    let interval = ConfidenceInterval::of_median(numbers.iter().copied());
    let interval = interval.map(|of| format!(" [{} to {}]", rounded(of.lower), rounded(of.upper))).unwrap_or_default();
    format!("{median} ({} to {}){interval}", rounded(of.lower), rounded(of.upper))
}
