//! A quantity of a run's robots over its time, as a figure.

use super::chart::{Chart, ChartLine, MOST_LINES};
use super::{Captured, Note};
use crate::picture::Figure;
use crate::random::Seed;
use crate::run::{DT, Quantity, Series};

/// The room that a figure has beside its picture, pixels: its borders, and those within the picture's frame.
const BORDERS: f64 = 56.0;

/// The lines of a plot, and the run that they are of.
#[derive(Clone, Debug)]
pub struct RunPlot<'a> {
    /// What the lines show.
    pub quantity: Quantity,
    /// The lines; those beyond [`MOST_LINES`] are left out.
    pub series: &'a [Series],
    /// The last tick.
    pub ticks: u64,
    /// The run's seed.
    pub seed: Seed,
    /// The run's digest, as it prints.
    pub digest: String,
}

/// A plot as a figure for a sheet of this width, pixels.
pub fn plot(plot: &RunPlot<'_>, width_px: f64) -> Captured {
    let RunPlot { quantity, series, ticks, seed, digest } = plot;
    let line = |series: &Series| ChartLine { name: series.name(), pieces: pieces(series, quantity.wraps()) };
    let seconds = DT * *ticks as f64;
    let chart = Chart {
        up: quantity.title(),
        across: "time, s",
        span: [0.0, if *ticks == 0 { DT } else { seconds }],
        angles: quantity.wraps(),
        lines: series.iter().take(MOST_LINES).map(line).collect(),
    };
    let mut figure = Figure::of(chart.picture(width_px - BORDERS));
    figure.title = format!("{} in a run of {seconds:.0} s at seed {seed}", quantity.title());
    figure.description = series.iter().take(MOST_LINES).map(sentence).collect::<Vec<_>>().join(" ");
    figure.caption = vec![format!("Seed {seed}, {ticks} ticks ({seconds:.2} s)."), format!("Digest {digest}")];
    let notes: Vec<Note> = vec![
        ("Seed", seed.to_string()),
        ("Digest", digest.clone()),
        ("Ticks", ticks.to_string()),
        ("Quantity", quantity.title().to_owned()),
    ];
    Captured { figure, notes }
}

/// The line in pieces, times in seconds: broken where ticks have no value, and where an angle wraps.
fn pieces(series: &Series, wraps: bool) -> Vec<Vec<[f64; 2]>> {
    let joined =
        |a: &(u64, f64), b: &(u64, f64)| b.0 == a.0 + 1 && !(wraps && (b.1 - a.1).abs() >= std::f64::consts::PI);
    let piece = |points: &[(u64, f64)]| points.iter().map(|(tick, value)| [DT * *tick as f64, *value]).collect();
    series.points.chunk_by(joined).map(piece).collect()
}

/// The least and the greatest value of a line, for readers who do not see the figure.
fn sentence(series: &Series) -> String {
    let values = || series.points.iter().map(|(_, value)| *value);
    let Some(first) = values().next() else { return format!("{} has no values.", series.name()) };
    let (low, high) = values()
        .fold((first, first), |(low, high), value| (crate::num::lesser(low, value), crate::num::greater(high, value)));
    format!("{} goes from {low:.3} to {high:.3}.", series.name())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_break_where_values_are_missing_and_where_angles_wrap() {
        let points = vec![(0, 3.0), (1, 3.1), (2, -3.1), (3, -3.0), (7, -2.0), (8, 1.5)];
        let series = Series::new("Reach", "theta1", points);
        let lengths = |wraps| pieces(&series, wraps).iter().map(Vec::len).collect::<Vec<_>>();
        assert_eq!(lengths(true), [2, 2, 1, 1]);
        assert_eq!(lengths(false), [4, 2]);
        assert_eq!(pieces(&series, false)[1], [[7.0 * DT, -2.0], [8.0 * DT, 1.5]]);
        assert_eq!(sentence(&series), "Reach theta1 goes from -3.100 to 3.100.");
    }
}
