//! `StatsColumn`, a number that is known of each robot of a run, by its name.

use super::RobotStats;

/// A number of a robot's stats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StatsNumber {
    /// A count.
    Whole(u64),
    /// A measure.
    Measure(f64),
}

impl StatsNumber {
    /// The number as a float; counts are exact up to 2^53.
    pub fn value(self) -> f64 {
        match self {
            StatsNumber::Whole(count) => count as f64,
            StatsNumber::Measure(value) => value,
        }
    }
}

impl std::fmt::Display for StatsNumber {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            StatsNumber::Whole(count) => write!(f, "{count}"),
            StatsNumber::Measure(value) => write!(f, "{value:?}"),
        }
    }
}

/// A column of the stats of robots: its name, which ends with its unit, and its number.
#[derive(Clone, Copy, Debug)]
pub struct StatsColumn {
    /// The name.
    pub name: &'static str,
    of: fn(&RobotStats) -> Option<StatsNumber>,
}

impl PartialEq for StatsColumn {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl StatsColumn {
    /// All columns, in the order in which `motion-lab stats --json` has them.
    pub const ALL: [StatsColumn; 7] = [
        StatsColumn { name: "contacts", of: |robot| Some(StatsNumber::Whole(robot.contacts.into())) },
        StatsColumn { name: "contact_ticks", of: |robot| Some(StatsNumber::Whole(robot.contact_ticks)) },
        StatsColumn { name: "contact_s", of: |robot| Some(StatsNumber::Measure(robot.contact_seconds())) },
        StatsColumn { name: "path_m", of: |robot| robot.path_length.map(StatsNumber::Measure) },
        StatsColumn {
            name: "least_clearance_m",
            of: |robot| robot.least_clearance.map(|least| StatsNumber::Measure(least.metres)),
        },
        StatsColumn {
            name: "least_clearance_tick",
            of: |robot| robot.least_clearance.map(|least| StatsNumber::Whole(least.tick)),
        },
        StatsColumn { name: "refusals", of: |robot| Some(StatsNumber::Whole(robot.refusals.into())) },
    ];

    /// The column of this name.
    pub fn named(name: &str) -> Option<Self> {
        StatsColumn::ALL.into_iter().find(|column| column.name == name)
    }

    /// The number of a robot; `None` where it is not known.
    pub fn number(self, robot: &RobotStats) -> Option<StatsNumber> {
        (self.of)(robot)
    }

    /// Whether it is known only where clearances are measured.
    pub fn needs_clearance(self) -> bool {
        self.name.starts_with("least_clearance")
    }
}
