//! Histograms of many runs' numbers, side by side as a figure.

use super::chart::{Chart, ChartLine};
use super::{Captured, Note};
use crate::picture::{Figure, Panel};

/// A number of many runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution {
    /// What it is, with its unit.
    pub name: String,
    /// Its values, in any order. Those that are not finite are left out.
    pub values: Vec<f64>,
}

/// Largest number of bins.
const MOST_BINS: usize = 40;

/// The width of one histogram, pixels.
const WIDTH: f64 = 400.0;

/// Histograms as a figure with this title, a panel each; distributions without values have none.
///
/// The bins are equally wide, from the least to the greatest value: as many as the square root of the number of values,
/// 40 at most.
pub fn histograms(title: &str, distributions: &[Distribution], notes: Vec<Note>) -> Captured {
    let (mut panels, mut sentences) = (Vec::new(), Vec::new());
    for Distribution { name, values } in distributions {
        let mut values: Vec<f64> = values.iter().copied().filter(|x| x.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        let (Some(&low), Some(&high)) = (values.first(), values.last()) else { continue };
        let bins = bins(&values);
        let span = [bins[0].from, bins[bins.len() - 1].to];
        let line = ChartLine { name: "runs".into(), pieces: vec![outline(&bins)], contacts: vec![] };
        let chart = Chart { up: "runs", across: name, span, angles: false, lines: vec![line] };
        let median = values[values.len() / 2];
        panels.push(Panel { picture: chart.picture(WIDTH), heading: name.clone(), readout: Vec::new() });
        sentences.push(format!("{name} of {} runs goes from {low:.3} to {high:.3}, median {median:.3}.", values.len()));
    }
    let (title, description) = (title.to_owned(), sentences.join(" "));
    Captured { figure: Figure { title, description, panels, caption: Vec::new() }, notes }
}

/// An interval of values, and how many lie in it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Bin {
    from: f64,
    to: f64,
    count: u64,
}

/// The bins of ascending values, at least one.
fn bins(values: &[f64]) -> Vec<Bin> {
    let (low, high) = (values.first().copied().unwrap_or(0.0), values.last().copied().unwrap_or(0.0));
    if low == high {
        return vec![Bin { from: low - 0.5, to: low + 0.5, count: values.len() as u64 }];
    }
    let bins = (1..MOST_BINS).find(|n| n * n >= values.len()).unwrap_or(MOST_BINS);
    let edge = |i: usize| low + (high - low) * (i as f64 / bins as f64);
    let mut all: Vec<Bin> = (0..bins).map(|i| Bin { from: edge(i), to: edge(i + 1), count: 0 }).collect();
    for x in values {
        let i = ((x - low) / (high - low) * bins as f64) as usize;
        all[i.min(bins - 1)].count += 1;
    }
    all
}

/// The line around the bins, left to right.
fn outline(bins: &[Bin]) -> Vec<[f64; 2]> {
    let corners = |bin: &Bin| {
        let top = bin.count as f64;
        [[bin.from, 0.0], [bin.from, top], [bin.to, top], [bin.to, 0.0]]
    };
    bins.iter().flat_map(corners).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_is_in_one_bin_and_the_ends_are_in_the_first_and_the_last() {
        let values: Vec<f64> = (0..=100).map(|i| f64::from(i) / 10.0).collect();
        let all = bins(&values);
        // 11 bins of 10/11 m for 101 values
        assert_eq!((all.len(), all.iter().map(|bin| bin.count).sum::<u64>()), (11, 101));
        assert!(all.iter().all(|bin| (9..=10).contains(&bin.count)), "{all:?}");
        assert_eq!((all[0].from, all[10].to), (0.0, 10.0));
        for bin in &all[..10] {
            let inside = values.iter().filter(|x| (bin.from..bin.to).contains(*x)).count() as u64;
            assert!(bin.count.abs_diff(inside) <= 1, "rounding moves one value at most: {bin:?} {inside}");
        }
        assert_eq!(bins(&[3.0; 7]), [Bin { from: 2.5, to: 3.5, count: 7 }]);
        assert_eq!(outline(&bins(&[3.0; 7])), [[2.5, 0.0], [2.5, 7.0], [3.5, 7.0], [3.5, 0.0]]);
    }

    #[test]
    fn a_figure_has_a_panel_for_each_distribution_with_values() {
        let of = |name: &str, values: &[f64]| Distribution { name: name.into(), values: values.into() };
        let all = [of("path, m", &[3.0, 1.0, 2.0, f64::INFINITY]), of("empty, s", &[]), of("contacts", &[0.0, 0.0])];
        let figure = histograms("a sweep", &all, Vec::new()).figure;
        assert_eq!(
            figure.panels.iter().map(|panel| panel.heading.as_str()).collect::<Vec<_>>(),
            ["path, m", "contacts"]
        );
        assert!(figure.description.starts_with("path, m of 3 runs goes from 1.000 to 3.000, median 2.000."));
    }
}
