//! Histograms of many runs' numbers, side by side as a figure.

use super::quartiles::Quartiles;
use crate::capture::captured::{Captured, Note};
use crate::capture::chart::{PlotChart, PlotLine, PlotValues};
use motion_lab_core::picture::{Figure, Panel};

/// One quantity with its values in many runs, to be drawn as a histogram.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution {
    /// What it is, with its unit.
    pub name: String,
    /// Its values, in any order. Those that are not finite are left out.
    pub values: Vec<f64>,
}

const MAX_BINS: usize = 40;

/// The width of one histogram, pixels.
const WIDTH: f64 = 400.0;

/// Histograms as a figure with this title, a panel each; distributions without values have none.
///
/// The bins are equally wide, from the least to the greatest value: as many as the square root of the number of values,
/// 40 at most. Where all values are one, a single bar has it beneath.
pub fn histograms(title: &str, distributions: &[Distribution], notes: Vec<Note>) -> Captured {
    let (mut panels, mut sentences) = (Vec::new(), Vec::new());
    for Distribution { name, values } in distributions {
        let mut values: Vec<f64> = values.iter().copied().filter(|x| x.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        let (Some(&low), Some(&high)) = (values.first(), values.last()) else { continue };
        let Some(Quartiles { count, median, .. }) = Quartiles::of(values.iter().copied()) else { continue };
        let (bins, span, only) = if low == high {
            // a third of the axis, whatever the value
            (vec![Bin { from: 1.0, to: 2.0, count: count as u64 }], [0.0, 3.0], Some(low.to_string()))
        } else {
            (bins(&values), [low, high], None)
        };
        sentences.push(match &only {
            Some(value) => format!("{name} is {value} in all of {count} runs."),
            None => format!("{name} of {count} runs goes from {low:.3} to {high:.3}, median {median:.3}."),
        });
        let line = PlotLine { name: "runs".into(), pieces: vec![outline(&bins)], contacts: vec![] };
        let chart = PlotChart { up: "runs", across: name, span, only, values: PlotValues::FromZero, lines: vec![line] };
        panels.push(Panel { picture: chart.picture(WIDTH), heading: name.clone(), readout: Vec::new() });
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

/// The bins of ascending values, two of which differ.
fn bins(values: &[f64]) -> Vec<Bin> {
    let (low, high) = (values.first().copied().unwrap_or(0.0), values.last().copied().unwrap_or(0.0));
    let bins = (1..MAX_BINS).find(|n| n * n >= values.len()).unwrap_or(MAX_BINS);
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
    use motion_lab_core::picture::{Drawing, Picture};

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
        assert_eq!(bins(&[3.0, 5.0]), [Bin { from: 3.0, to: 4.0, count: 1 }, Bin { from: 4.0, to: 5.0, count: 1 }]);
        assert_eq!(outline(&bins(&[3.0, 5.0]))[2..6], [[4.0, 1.0], [4.0, 0.0], [4.0, 0.0], [4.0, 1.0]]);
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
        assert!(figure.description.ends_with(" contacts is 0 in all of 2 runs."));
    }

    #[test]
    fn one_value_is_one_bar_with_its_name_and_no_panel_has_a_legend() {
        let of = |values: &[f64]| Distribution { name: "time, s".into(), values: values.into() };
        let picture = |values: &[f64]| {
            let mut figure = histograms("a sweep", &[of(values)], Vec::new()).figure;
            figure.panels.remove(0).picture
        };
        let (one, many) = (picture(&[0.35; 4]), picture(&[0.35, 0.4]));
        let across = |picture: &Picture| {
            let ids = picture.items.iter().filter_map(|item| item.id.strip_prefix("across/"));
            ids.filter(|id| *id != "name").map(str::to_owned).collect::<Vec<_>>()
        };
        assert_eq!(across(&one), ["0.35"], "the value alone, and not -0.15 to 0.85");
        assert!(across(&many).len() > 1);
        let bar = one.items.iter().find(|item| item.id == "line/runs").unwrap();
        let Drawing::Region { outline, .. } = &bar.drawing else { panic!("a bar") };
        let mark = one.items.iter().find(|item| item.id == "tick/0.35").unwrap();
        let Drawing::Polyline(mark) = &mark.drawing else { panic!("a mark") };
        let [left, right] = [outline[0][0].x, outline[0][3].x];
        assert!((0.5 * (left + right) - mark[0].x).abs() < 1e-9 && right - left > 50.0, "the value is its middle");
        for picture in [one, many] {
            assert!(picture.items.iter().all(|item| !item.id.starts_with("legend/")), "`runs` is the axis's title");
        }
    }
}
