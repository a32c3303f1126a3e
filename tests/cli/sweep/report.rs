//! `sweep report`: what became of the runs of each value.

use std::fs;

use super::planner::{PLAN, rows};
use super::{folder_with, names};
use crate::cli::run_in;

/// The cells of the table under a heading.
fn table(page: &str, heading: &str) -> Vec<Vec<String>> {
    let from = page.find(&format!("<h2>{heading}</h2>")).unwrap_or_else(|| panic!("{heading}"));
    let table = page[from..].split("</table>").next().unwrap();
    let cells = |row: &str| {
        let ends = row.split("<t").skip(1).filter_map(|cell| cell.split_once('>'));
        ends.map(|(_, cell)| cell.split("</t").next().unwrap().to_owned()).collect()
    };
    table.split("<tr>").skip(1).map(cells).collect()
}

/// The middle of some numbers, as a sorted list has it.
fn median(mut numbers: Vec<f64>) -> Option<f64> {
    numbers.sort_by(f64::total_cmp);
    let upper = *numbers.get(numbers.len() / 2)?;
    Some(if numbers.len() % 2 == 1 { upper } else { 0.5 * (upper + numbers[numbers.len() / 2 - 1]) })
}

#[test]
fn a_report_tells_the_runs_of_each_value_apart() {
    let folder = folder_with(PLAN);
    let at = folder.path();
    run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
    run_in(at, &["sweep", "merge", "parts", "-o", "all.csv", "-o", "all.parquet"]).done();
    run_in(at, &["sweep", "report", "all.parquet", "-o", "all.html"]).done();
    let page = fs::read_to_string(at.join("all.html")).unwrap();
    let all = fs::read_to_string(at.join("all.csv")).unwrap();
    let rows = rows(&all);
    for (axis, values) in
        [("planner", &["rrt-connect", "prm"][..]), ("planner.iterations", &["3", "1000"]), ("seed", &["7", "8", "9"])]
    {
        let table = table(&page, &format!("By {axis}"));
        assert_eq!(table[0][..4], [axis, "runs", "solved", "failed"].map(str::to_owned));
        assert_eq!(table.len(), 1 + values.len(), "{axis}");
        for (cells, value) in table[1..].iter().zip(values) {
            let own: Vec<_> = rows.iter().filter(|row| row(axis) == *value).collect();
            let solved = own.iter().filter(|row| row("solved") == "1").count();
            let failed = own.iter().filter(|row| !row("failure").is_empty()).count();
            let counts = [own.len(), solved, failed].map(|n| n.to_string());
            assert_eq!(cells[0], *value);
            assert_eq!(cells[1..4], counts, "{axis} {value}");
            for (title, column) in [("planned path, rad", "planned_path_rad"), ("edges", "edges")] {
                let numbers: Vec<f64> = own.iter().filter_map(|row| row(column).parse().ok()).collect();
                let cell = &cells[table[0].iter().position(|head| head == title).unwrap()];
                match median(numbers) {
                    None => assert!(cell.is_empty(), "{axis} {value} {title}: {cell}"),
                    Some(expected) => {
                        let shown: f64 = cell.split(' ').next().unwrap().parse().unwrap();
                        assert!((shown - expected).abs() <= 5e-7 * (1.0 + expected), "{title}: {cell} {expected}");
                    }
                }
            }
        }
        let solved: u64 = table[1..].iter().map(|cells| cells[2].parse::<u64>().unwrap()).sum();
        assert_eq!(solved, 6, "{axis}");
    }
    // each picture has names of its own
    let ids: Vec<&str> =
        page.match_indices(" id=\"").map(|(i, id)| page[i + id.len()..].split('"').next().unwrap()).collect();
    let once: std::collections::BTreeSet<&str> = ids.iter().copied().collect();
    assert_eq!(ids.len(), once.len(), "{ids:?}");
    // an axis of few values each, with words for who does not see it, and the distributions
    assert_eq!((page.matches("<svg").count(), page.matches("<img alt=\"").count()), (1, 4));
    assert!(page.contains("<img alt=\"contacts by planner: rrt-connect "));
}

#[test]
fn one_parameter_is_drawn_alone() {
    let folder = folder_with(PLAN);
    let at = folder.path();
    run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
    run_in(at, &["sweep", "merge", "parts", "-o", "all.parquet"]).done();
    run_in(at, &["sweep", "report", "all.parquet", "--by", "planner", "-o", "by.svg"]).done();
    let svg = fs::read_to_string(at.join("by.svg")).unwrap();
    assert!(svg.contains("planned path, rad by planner: rrt-connect ") && svg.matches("<svg").count() == 1, "{svg}");
    run_in(at, &["sweep", "report", "all.parquet", "--by", "seed", "-o", "by.html"]).done();
    let page = fs::read_to_string(at.join("by.html")).unwrap();
    assert!(page.contains("<h2>By seed</h2>") && !page.contains("<h2>By planner</h2>"));
    // its runs are those of the whole report
    run_in(at, &["sweep", "report", "all.parquet", "-o", "all.html"]).done();
    let whole = fs::read_to_string(at.join("all.html")).unwrap();
    assert_eq!(table(&page, "By seed"), table(&whole, "By seed"));
    let refused = run_in(at, &["sweep", "report", "all.parquet", "--by", "plannr", "-o", "no.svg"]).failed(2);
    assert!(refused.contains("those of two to twelve values are planner, planner.iterations, seed"), "{refused}");
    assert!(refused.contains("did you mean \"planner\"?"), "{refused}");
    assert!(!names(at).contains(&"no.svg".to_owned()));
}
