//! The plan of a warehouse: how many bays there are, where each stands, and who lives there. All lengths are metres.

use crate::geometry::{Aabb, Point2};

/// Robots of a full bay: 64 rovers, 8 arms, 8 cars.
const BAY_ROBOTS: usize = 80;

pub(super) const AISLES: usize = 4;
/// Arms in each of a bay's two rows of cells.
pub(super) const ROW_ARMS: usize = 4;

/// Width of what a bay's road goes about.
pub(super) const INNER_WIDTH: f64 = 9.8;
/// Height of what a bay's road goes about: a row of cells, the aisles, a row of cells.
pub(super) const INNER_HEIGHT: f64 = 15.0;
/// From what the road goes about to its middle. A car with its trailer cuts into a corner by 0.8 m.
pub(super) const TO_ROAD: f64 = 1.25;
/// From the middle of a bay's road to that of the next bay's. The front of a car swings out of a corner by 0.9 m.
const ROAD_APART: f64 = 2.0;
/// From the middle of a road to the hall's wall.
const TO_WALL: f64 = 1.75;
/// From the middle of a road to the south wall, where the docks are.
const TO_SOUTH_WALL: f64 = 4.0;

/// From a bay to the next one.
pub(super) const PITCH: [f64; 2] =
    [INNER_WIDTH + 2.0 * TO_ROAD + ROAD_APART, INNER_HEIGHT + 2.0 * TO_ROAD + ROAD_APART];

/// How many bays there are and how they stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    pub(super) bays: usize,
    pub(super) columns: usize,
    pub(super) rows: usize,
    rovers: usize,
    arms: usize,
    cars: usize,
}

/// The robots of a bay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Crew {
    pub(super) rovers: usize,
    pub(super) arms: usize,
    pub(super) cars: usize,
}

/// A number to the millimetre, whose text is short.
pub(super) fn tidy(x: f64) -> f64 {
    (x * 1e3).round() / 1e3 + 0.0
}

/// A point to the millimetre.
pub(super) fn point(x: f64, y: f64) -> Point2 {
    Point2::new(tidy(x), tidy(y))
}

/// Part number `i` of `total`, dealt out in `parts` parts that differ by at most one.
pub(super) fn share(total: usize, parts: usize, i: usize) -> usize {
    total * (i + 1) / parts - total * i / parts
}

impl Layout {
    pub(super) fn of(robots: usize) -> Self {
        let bays = robots.div_ceil(BAY_ROBOTS);
        let tenth = (robots + 5) / 10;
        let columns = columns(bays);
        let rows = bays.div_ceil(columns);
        Layout { bays, columns, rows, rovers: robots - 2 * tenth, arms: tenth, cars: tenth }
    }

    pub(super) fn crew(&self, bay: usize) -> Crew {
        let share = |total| share(total, self.bays, bay);
        Crew { rovers: share(self.rovers), arms: share(self.arms), cars: share(self.cars) }
    }

    /// The lower left corner of what the road of bay number `bay` goes about. Bays stand row by row from the
    /// south-west.
    pub(super) fn corner(&self, bay: usize) -> Point2 {
        let (column, row) = (bay % self.columns, bay / self.columns);
        point(TO_ROAD + TO_WALL + column as f64 * PITCH[0], TO_ROAD + TO_SOUTH_WALL + row as f64 * PITCH[1])
    }

    /// The hall within its walls.
    pub(super) fn hall(&self) -> Aabb {
        let end = self.corner(self.columns * self.rows - 1);
        let beyond = TO_ROAD + TO_WALL;
        Aabb { min: Point2::new(0.0, 0.0), max: point(end.x + INNER_WIDTH + beyond, end.y + INNER_HEIGHT + beyond) }
    }
}

/// The number of columns for this many bays: few places are left empty, and the hall is about 1.4 times as wide as
/// high.
fn columns(bays: usize) -> usize {
    let cost = |columns: usize| {
        let rows = bays.div_ceil(columns);
        let ratio = PITCH[0] * columns as f64 / (PITCH[1] * rows as f64) / 1.4;
        let empty = (columns * rows - bays) as f64 / bays as f64;
        let off = if ratio < 1.0 { 1.0 / ratio } else { ratio };
        empty + 0.3 * (off - 1.0)
    };
    // beyond this the hall is more than twice as long as it should be
    let most = (1..).find(|n| n * n >= 8 * bays).unwrap_or(1).min(bays);
    (1..=most).min_by(|a, b| cost(*a).total_cmp(&cost(*b))).unwrap_or(1)
}
