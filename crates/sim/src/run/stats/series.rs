//! `Series`, a quantity of a robot over the ticks of a run.

use std::ops::Range;

use super::gauge::{Gauge, GaugeReading};
use crate::run::{DT, Frame, RobotState, Script};
use crate::tour::TourConfig;
use motion_lab_core::configuration::{Kinds, RobotKind};

/// A quantity of robots that changes with time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The distance to the nearest obstacle of its world, metres; 0 in contact.
    Clearance,
    /// The speed, metres per second: of a body that drives with its sign, negative for backward; of an arm its tip's.
    Speed,
    /// The joint angles of an arm, radians, in (-pi, pi].
    Joints,
    /// The distance by the wheels' encoders and the distance driven, metres, of a robot that has encoders.
    Encoders,
}

impl Quantity {
    /// Its name and unit, as an axis has them.
    pub const fn title(self) -> &'static str {
        match self {
            Quantity::Clearance => "distance to the nearest obstacle, m",
            Quantity::Speed => "speed, m/s",
            Quantity::Joints => "joint angles, rad",
            Quantity::Encoders => "encoders against true travel, m",
        }
    }

    /// Whether its values are angles in (-pi, pi], so that a line is broken where they wrap.
    pub const fn wraps(self) -> bool {
        matches!(self, Quantity::Joints)
    }

    /// The lines of a robot of this kind: each one's name beside the robot's, empty for the only one.
    fn lines(self, about: Option<&RobotKind>) -> Vec<&'static str> {
        match self {
            Quantity::Clearance | Quantity::Speed => vec![""],
            Quantity::Joints => about.filter(|kind| kind.is_arm()).map_or_else(Vec::new, |k| k.coordinates.to_vec()),
            Quantity::Encoders if about.is_some_and(|kind| kind.has_encoders) => vec!["encoders", "true"],
            Quantity::Encoders => Vec::new(),
        }
    }
}

/// A quantity of a robot over the ticks of a run.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Series {
    /// The robot's name.
    pub robot: String,
    /// Which of the robot's lines it is, `theta1` or `encoders`; empty for the only one.
    pub line: &'static str,
    /// The ticks and the values, by ascending tick; ticks without a value are left out.
    pub points: Vec<(u64, f64)>,
    /// When the robot was in contact, by ascending tick: from the first tick that ended in contact to the first one
    /// after it that did not.
    pub contacts: Vec<Range<u64>>,
}

impl Series {
    /// A series of these points, by ascending tick, of a robot that touches nothing.
    pub fn new(robot: impl Into<String>, line: &'static str, points: Vec<(u64, f64)>) -> Self {
        Series { robot: robot.into(), line, points, contacts: Vec::new() }
    }

    /// The series with these contacts, by ascending tick.
    #[must_use]
    pub fn with_contacts(self, contacts: Vec<Range<u64>>) -> Self {
        Series { contacts, ..self }
    }

    /// The name of the line: the robot's, and which of its lines it is.
    pub fn name(&self) -> String {
        format!("{} {}", self.robot, self.line).trim_end().to_owned()
    }
}

/// Gathers a quantity of the robots of a run frame by frame.
pub struct SeriesGatherer<'a> {
    quantity: Quantity,
    gauge: Gauge<'a>,
    /// The series, with the number of their robots and of the robot's lines.
    series: Vec<(usize, usize, Series)>,
    /// The signed distance that each robot has driven, metres.
    travelled: Vec<f64>,
}

impl<'a> SeriesGatherer<'a> {
    /// A gatherer for the robots of a run that `wants` takes, with these kinds of robots.
    pub fn new(
        quantity: Quantity,
        config: &TourConfig,
        script: &'a Script,
        kinds: &'a Kinds,
        wants: impl Fn(&str) -> bool,
    ) -> Self {
        let residents = || config.worlds.iter().flat_map(|w| &w.robots);
        let series =
            residents().enumerate().filter(|(_, resident)| wants(&resident.name)).flat_map(|(robot, resident)| {
                let lines = quantity.lines(kinds.of(&resident.kind)).into_iter().enumerate();
                lines.map(move |(number, line)| (robot, number, Series::new(&resident.name, line, Vec::new())))
            });
        let series = series.collect();
        let gauge = Gauge::new(config, script, kinds, quantity == Quantity::Clearance);
        SeriesGatherer { quantity, gauge, series, travelled: vec![0.0; residents().count()] }
    }

    /// The number of lines.
    pub fn lines(&self) -> usize {
        self.series.len()
    }

    /// Leaves out the lines beyond the first `most`.
    pub fn truncate(&mut self, most: usize) {
        self.series.truncate(most);
    }

    /// Sees the next frame; the first one is that of tick 0.
    pub fn see(&mut self, frame: &Frame) {
        let readings = self.gauge.read(frame);
        for (travelled, reading) in self.travelled.iter_mut().zip(&readings) {
            *travelled += reading.step.unwrap_or(0.0);
        }
        for (robot, line, series) in &mut self.series {
            let (Some(reading), Some(state)) = (readings.get(*robot), frame.robots.get(*robot)) else { continue };
            if state.in_contact {
                match series.contacts.last_mut().filter(|contact| contact.end == frame.tick) {
                    Some(contact) => contact.end += 1,
                    None => series.contacts.push(frame.tick..frame.tick + 1),
                }
            }
            let travelled = self.travelled.get(*robot).copied();
            if let Some(value) = value(self.quantity, *line, reading, state, travelled).filter(|v| v.is_finite()) {
                series.points.push((frame.tick, value));
            }
        }
    }

    /// The series so far, robot by robot.
    pub fn series(self) -> Vec<Series> {
        self.series.into_iter().map(|(_, _, series)| series).collect()
    }
}

fn value(
    quantity: Quantity,
    line: usize,
    reading: &GaugeReading,
    state: &RobotState,
    travelled: Option<f64>,
) -> Option<f64> {
    match quantity {
        Quantity::Clearance => reading.clearance,
        Quantity::Speed => reading.step.map(|step| step / DT),
        Quantity::Joints => state.configuration.get(line).copied(),
        Quantity::Encoders if line == 0 => reading.encoders,
        Quantity::Encoders => travelled,
    }
}
