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
            let kinds = |kind: &str| own.iter().filter(|row| row("failure_kind") == kind).count();
            let (exhausted, none) = (kinds("exhausted"), kinds("no-problem"));
            let by_kind = [(exhausted, "exhausted"), (none, "no-problem")].into_iter().filter(|(n, _)| *n > 0);
            let by_kind: Vec<String> = by_kind.map(|(n, kind)| format!("{kind} {n}")).collect();
            assert_eq!(cells[6], by_kind.join(", "), "{axis} {value}");
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

#[test]
fn two_parameters_are_told_apart_together_and_shares_have_their_intervals() {
    let folder = folder_with(PLAN);
    let at = folder.path();
    run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
    run_in(at, &["sweep", "merge", "parts", "-o", "all.csv", "-o", "all.parquet"]).done();
    run_in(at, &["sweep", "report", "all.parquet", "--by", "planner.iterations,planner", "-o", "by.html"]).done();
    let page = fs::read_to_string(at.join("by.html")).unwrap();
    let by = table(&page, "By planner.iterations, planner");
    let heads = ["planner.iterations", "planner", "runs", "solved", "failed", "share solved", "share failed"];
    assert_eq!(by[0][..7], heads.map(str::to_owned));
    let values: Vec<[&str; 2]> = by[1..].iter().map(|cells| [&*cells[0], &*cells[1]]).collect();
    assert_eq!(values, [["3", "rrt-connect"], ["3", "prm"], ["1000", "rrt-connect"], ["1000", "prm"]]);
    let all = fs::read_to_string(at.join("all.csv")).unwrap();
    let rows = rows(&all);
    for cells in &by[1..] {
        let own: Vec<_> =
            rows.iter().filter(|row| row("planner.iterations") == cells[0] && row("planner") == cells[1]).collect();
        let solved = own.iter().filter(|row| row("solved") == "1").count();
        assert_eq!(cells[2..5], [own.len(), solved, own.len() - solved].map(|n| n.to_string()));
        // of six Wilson's intervals by hand: z^2 = 3.841459, for 0 of 6 z^2 / (6 + z^2) = 0.390334, and for 3 of 6
        // 0.5 -+ z sqrt(0.25 / 6 + z^2 / 144) / (1 + z^2 / 6) = 0.5 -+ 0.312384
        let [shares, failed] = match solved {
            0 => ["0 (0 to 0.39)", "1 (0.61 to 1)"],
            3 => ["0.5 (0.188 to 0.812)", "0.5 (0.188 to 0.812)"],
            other => panic!("{other} of {}", own.len()),
        };
        assert_eq!([&*cells[5], &*cells[6]], [shares, failed]);
    }
    // of the failures 12 have no problem and 6 too few iterations: of 24 the shares, and the most frequent first
    let kinds = table(&page, "Failures by kind");
    let kinds: Vec<[&str; 2]> = kinds[1..].iter().map(|cells| [&*cells[0], &*cells[1]]).collect();
    assert_eq!(kinds, [["no-problem", "12"], ["exhausted", "6"]]);
    // edges of 24 runs: the interval of the median is that of numbers 7 and 18 of 24, as tables of ranks have it
    run_in(at, &["sweep", "report", "all.parquet", "--by", "seed", "-o", "seed.html"]).done();
    let page = fs::read_to_string(at.join("seed.html")).unwrap();
    let by_seed = table(&page, "By seed");
    let edges = by_seed[0].iter().position(|head| head == "edges").unwrap();
    for cells in &by_seed[1..] {
        let mut numbers: Vec<u64> =
            rows.iter().filter(|row| row("seed") == cells[0]).map(|row| row("edges").parse().unwrap()).collect();
        numbers.sort_unstable();
        // of eight the least and the greatest: 2/256 < 0.05, and 18/256 is more
        assert!(cells[edges].ends_with(&format!(" [{} to {}]", numbers[0], numbers[7])), "{}", cells[edges]);
    }
    // a figure has a box for each combination
    run_in(at, &["sweep", "report", "all.parquet", "--by", "planner,seed", "-o", "by.svg"]).done();
    let svg = fs::read_to_string(at.join("by.svg")).unwrap();
    assert!(svg.contains("by planner, seed: rrt-connect, 7 "), "{}", &svg[..2000]);
    for (by, said) in [
        ("planner,plannr", "--by plannr: all.parquet has no such parameter"),
        ("seed,seed", "--by seed,seed: seed stands there twice"),
        ("planner,", "--by "),
    ] {
        let refused = run_in(at, &["sweep", "report", "all.parquet", "--by", by, "-o", "no.svg"]).failed(2);
        assert!(refused.contains(said), "{refused}");
    }
}
