//! A quantity of a run's robots over its time, as a figure.

use std::ops::Range;

use super::chart::{MAX_LINES, PlotChart, PlotLine, PlotValues};
use super::{Captured, Note};
use crate::run::{DT, Quantity, Series};
use motion_lab_core::picture::Figure;
use motion_lab_core::random::Seed;

/// The room that a figure has beside its picture, pixels: its borders, and those within the picture's frame.
pub(in crate::capture) const BORDERS: f64 = 56.0;

/// The lines of a plot, and the run that they are of.
#[derive(Clone, Debug)]
pub struct RunPlot<'a> {
    /// What the lines show.
    pub quantity: Quantity,
    /// The lines; those beyond [`MAX_LINES`] are left out.
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
    let line = |series: &Series| PlotLine {
        name: series.name(),
        pieces: pieces(series, quantity.wraps()),
        contacts: series.contacts.iter().map(seconds_of).collect(),
    };
    let seconds = DT * *ticks as f64;
    let chart = PlotChart {
        up: quantity.title(),
        across: "time, s",
        span: [0.0, if *ticks == 0 { DT } else { seconds }],
        only: None,
        values: if quantity.wraps() { PlotValues::Angles } else { PlotValues::FromZero },
        lines: series.iter().take(MAX_LINES).map(line).collect(),
    };
    let mut figure = Figure::of(chart.picture(width_px - BORDERS));
    figure.title = format!("{} in a run of {seconds:.0} s at seed {seed}", quantity.title());
    let drawn = &series[..series.len().min(MAX_LINES)];
    let of_robots = drawn.chunk_by(|a, b| a.robot == b.robot).filter_map(|lines| contacts_sentence(&lines[0], *ticks));
    figure.description = drawn.iter().map(sentence).chain(of_robots).collect::<Vec<_>>().join(" ");
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

/// The times between which a robot was in contact, seconds.
fn seconds_of(contact: &Range<u64>) -> [f64; 2] {
    [contact.start, contact.end].map(|tick| DT * tick as f64)
}

/// When a robot was in contact, for readers who do not see the figure, in a run of `ticks` ticks; `None` for one that
/// never was.
fn contacts_sentence(series: &Series, ticks: u64) -> Option<String> {
    let times = |contact: &Range<u64>| match seconds_of(contact) {
        [from, _] if contact.end > ticks => format!("from {from:.2} s to the end"),
        [from, to] => format!("from {from:.2} s to {to:.2} s"),
    };
    let robot = &series.robot;
    Some(match &series.contacts[..] {
        [] => return None,
        [only] => format!("{robot} is in contact {}.", times(only)),
        [first, .., last] => {
            let count = series.contacts.len();
            format!("{robot} is in contact {count} times, first {}, last {}.", times(first), times(last))
        }
    })
}

/// The least and the greatest value of a line, for readers who do not see the figure.
fn sentence(series: &Series) -> String {
    let values = || series.points.iter().map(|(_, value)| *value);
    let Some(first) = values().next() else { return format!("{} has no values.", series.name()) };
    let (low, high) = values().fold((first, first), |(low, high), value| {
        (motion_lab_core::num::lesser(low, value), motion_lab_core::num::greater(high, value))
    });
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

    #[test]
    fn contacts_are_said_once_for_each_robot() {
        let series = |robot: &str, line, contacts| Series::new(robot, line, vec![(0, 1.0)]).with_contacts(contacts);
        let touches = vec![4..10, 20..21, 30..40];
        let all = [
            series("Reach", "theta1", touches.clone()),
            series("Reach", "theta2", touches),
            series("Rusty", "", std::iter::once(60..81).collect()),
            series("Hitch", "", vec![]),
        ];
        let (quantity, ticks, seed) = (Quantity::Speed, 80, Seed(7));
        let run = RunPlot { quantity, series: &all, ticks, seed, digest: String::new() };
        let said = plot(&run, 640.0).figure.description;
        let reach = "Reach is in contact 3 times, first from 0.20 s to 0.50 s, last from 1.50 s to 2.00 s.";
        assert!(said.ends_with(&format!("{reach} Rusty is in contact from 3.00 s to the end.")), "{said}");
        assert_eq!(said.matches(reach).count(), 1, "{said}");
    }
}
