//! The table of a log: a row for each tick and robot. The CSV prints it; here are its columns as data.

use super::columns::{Columns, StateList, residents};
use super::every_frame::every_frame;
use crate::run::{DT, Frame, Log, RobotState};
use motion_lab_core::configuration::Kinds;

/// A column of the table of a log.
#[derive(Clone, Debug, PartialEq)]
pub struct LogColumn {
    /// Its name, with its unit: `x_m`, `contacts`.
    pub name: String,
    /// Its cells, row by row.
    pub cells: LogCells,
}

/// The cells of a [`LogColumn`].
#[derive(Clone, Debug, PartialEq)]
pub enum LogCells {
    /// Ticks, ids, channels and counts.
    Integers(Vec<i64>),
    /// Metres, radians, seconds; NaN where a robot has no such number, which the CSV leaves empty.
    Numbers(Vec<f64>),
    /// Yes or no.
    Flags(Vec<bool>),
    /// The robots' names.
    Names(Vec<String>),
}

/// The table that [`write_csv`](super::write_csv) writes, as columns: a row for each tick from 0 on and each robot by
/// id. A log of digests has no rows.
///
/// ```
/// use motion_lab_sim::export::{LogCells, table};
/// use motion_lab_sim::recording::Run;
/// use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
///
/// let log = Run::record(TourConfig { ticks: 2, ..TourConfig::default() }, BOOK_SEED)?;
/// let columns = table(&log, false);
/// assert_eq!((&*columns[0].name, &columns[0].cells), ("tick", &LogCells::Integers(vec![0, 0, 0, 1, 1, 1, 2, 2, 2])));
/// # Ok::<(), motion_lab_sim::recording::RunError>(())
/// ```
pub fn table(log: &Log, ranges: bool) -> Vec<LogColumn> {
    let head = TableHead::of(log, &Kinds::default(), ranges);
    let names: Vec<&str> = log.recipe.config.robot_names().collect();
    let mut table = GatheredTable::of(head.names());
    for frame in every_frame(log) {
        for (number, (name, robot)) in names.iter().zip(&frame.robots).enumerate() {
            table.begin_row();
            head.cells(frame, NamedRobot { number, name }, robot, |cell| table.take(cell));
        }
    }
    table.columns
}

/// The rows of the robot of this id, and of the columns those that its kind has, without its ranges. Empty where the
/// log has no such robot.
pub fn table_of_robot(log: &Log, id: usize) -> Vec<LogColumn> {
    let head = TableHead::of(log, &Kinds::default(), false);
    let Some(name) = log.recipe.config.robot_names().nth(id) else { return Vec::new() };
    let mut table = GatheredTable::of(head.names());
    for (frame, robot) in every_frame(log).filter_map(|frame| Some((frame, frame.robots.get(id)?))) {
        table.begin_row();
        head.cells(frame, NamedRobot { number: id, name }, robot, |cell| table.take(cell));
    }
    table.columns.retain(|column| head.has(id, &column.name));
    table.columns
}

/// A cell of the table.
pub(super) enum LogCell<'a> {
    Integer(i64),
    Number(Option<f64>),
    Flag(bool),
    Name(&'a str),
}

/// A robot's number by id, and its name.
#[derive(Clone, Copy)]
pub(super) struct NamedRobot<'a> {
    pub number: usize,
    pub name: &'a str,
}

/// The columns of a log.
pub(super) struct TableHead {
    configuration: Columns,
    extra: Columns,
    target: Columns,
    /// The number of rays of each of a robot's sensors, from the first on: the largest in the log.
    ranges: Vec<usize>,
}

impl TableHead {
    pub fn of(log: &Log, kinds: &Kinds, ranges: bool) -> Self {
        let mut widths = [StateList::Configuration, StateList::Extra, StateList::Target]
            .map(|list| (list, vec![0; residents(log).count()]));
        let mut of_sensors: Vec<usize> = Vec::new();
        for frame in every_frame(log) {
            for (list, widths) in &mut widths {
                for (width, robot) in widths.iter_mut().zip(&frame.robots) {
                    *width = (*width).max(list.of(robot).len());
                }
            }
            for scans in frame.scans.chunk_by(|a, b| a.robot == b.robot).filter(|_| ranges) {
                of_sensors.resize(of_sensors.len().max(scans.len()), 0);
                for (width, scan) in of_sensors.iter_mut().zip(scans) {
                    *width = (*width).max(scan.ranges.len());
                }
            }
        }
        let [configuration, extra, target] = widths.map(|(list, widths)| Columns::new(list, log, kinds, &widths));
        TableHead { configuration, extra, target, ranges: of_sensors }
    }

    /// The columns' names, in order.
    pub fn names(&self) -> Vec<String> {
        let mut names = ["tick", "time_s", "id", "robot"].map(str::to_owned).to_vec();
        names.extend(self.configuration.names.iter().chain(&self.extra.names).cloned());
        names.extend(["channel0", "channel1"].map(str::to_owned));
        names.extend(self.target.names.iter().cloned());
        names.extend(["manual", "in_contact", "contacts", "flash", "refusals"].map(str::to_owned));
        for (sensor, width) in self.ranges.iter().enumerate() {
            names.extend((0..*width).map(|i| match sensor {
                0 => format!("range{i}_m"),
                _ => format!("scan{}_range{i}_m", sensor + 1),
            }));
        }
        names
    }

    /// Calls `take` with the cells of a row, one for each of the [names](Self::names).
    pub fn cells<'a>(
        &self,
        frame: &Frame,
        NamedRobot { number, name }: NamedRobot<'a>,
        robot: &RobotState,
        mut take: impl FnMut(LogCell<'a>),
    ) {
        // taken apart by name, so that a field added later can't be forgotten here
        let RobotState {
            id,
            configuration: _,
            extra: _,
            channels,
            target: _,
            manual,
            in_contact,
            contacts,
            flash,
            refusals,
        } = robot;
        let Frame { tick, .. } = frame;
        // a run has at most 2^32 ticks, so the sign stays
        take(LogCell::Integer(tick.cast_signed()));
        take(LogCell::Number(Some(*tick as f64 * DT)));
        take(LogCell::Integer(i64::from(*id)));
        take(LogCell::Name(name));
        self.configuration.numbers(number, robot).for_each(|x| take(LogCell::Number(x)));
        self.extra.numbers(number, robot).for_each(|x| take(LogCell::Number(x)));
        channels.iter().for_each(|channel| take(LogCell::Integer(i64::from(*channel))));
        self.target.numbers(number, robot).for_each(|x| take(LogCell::Number(x)));
        [manual, in_contact].into_iter().for_each(|flag| take(LogCell::Flag(*flag)));
        [contacts, flash, refusals].into_iter().for_each(|count| take(LogCell::Integer(i64::from(*count))));
        let mut scans = frame.scans.iter().filter(|scan| scan.robot == *id);
        for width in &self.ranges {
            let ranges = scans.next().map_or(&[][..], |scan| &scan.ranges);
            (0..*width).for_each(|i| take(LogCell::Number(ranges.get(i).copied())));
        }
    }

    /// Whether the column of this name is one that robot number `number` has numbers for.
    fn has(&self, number: usize, name: &str) -> bool {
        [&self.configuration, &self.extra, &self.target].into_iter().all(|list| list.has(number, name) != Some(false))
    }
}

/// The columns while they are gathered.
struct GatheredTable {
    columns: Vec<LogColumn>,
    /// The number of the column that the next cell goes to.
    next: usize,
}

impl GatheredTable {
    fn of(names: Vec<String>) -> Self {
        // the first cell says what the others are
        let column = |name| LogColumn { name, cells: LogCells::Numbers(Vec::new()) };
        GatheredTable { columns: names.into_iter().map(column).collect(), next: 0 }
    }

    fn begin_row(&mut self) {
        self.next = 0;
    }

    fn take(&mut self, cell: LogCell<'_>) {
        let Some(column) = self.columns.get_mut(self.next) else { return };
        self.next += 1;
        let cells = &mut column.cells;
        match (cell, &mut *cells) {
            (LogCell::Number(x), LogCells::Numbers(all)) => all.push(x.unwrap_or(f64::NAN)),
            (LogCell::Integer(x), LogCells::Integers(all)) => all.push(x),
            (LogCell::Flag(x), LogCells::Flags(all)) => all.push(x),
            (LogCell::Name(x), LogCells::Names(all)) => all.push(x.to_owned()),
            (LogCell::Number(x), _) => *cells = LogCells::Numbers(vec![x.unwrap_or(f64::NAN)]),
            (LogCell::Integer(x), _) => *cells = LogCells::Integers(vec![x]),
            (LogCell::Flag(x), _) => *cells = LogCells::Flags(vec![x]),
            (LogCell::Name(x), _) => *cells = LogCells::Names(vec![x.to_owned()]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::{csv_cell, write_csv};
    use crate::recording::Run;
    use crate::tour::{BOOK_SEED, TourConfig};
    use motion_lab_core::random::Seed;

    /// A cell as the CSV has it.
    fn printed(cells: &LogCells, row: usize) -> String {
        match cells {
            LogCells::Integers(all) => all[row].to_string(),
            LogCells::Numbers(all) if all[row].is_nan() => String::new(),
            LogCells::Numbers(all) => format!("{:?}", all[row]),
            LogCells::Flags(all) => all[row].to_string(),
            LogCells::Names(all) => csv_cell(&all[row]),
        }
    }

    #[test]
    fn the_columns_are_those_of_the_csv_cell_by_cell() {
        let log = Run::record(TourConfig { ticks: 30, ..TourConfig::default() }, Seed(7)).unwrap();
        for ranges in [false, true] {
            let mut text = Vec::new();
            write_csv(&log, ranges, &mut text).unwrap();
            let text = String::from_utf8(text).unwrap();
            let columns = table(&log, ranges);
            let names: Vec<&str> = columns.iter().map(|column| &*column.name).collect();
            assert_eq!(text.lines().next().unwrap(), names.join(","));
            for (row, line) in text.lines().skip(1).enumerate() {
                let cells: Vec<String> = columns.iter().map(|column| printed(&column.cells, row)).collect();
                assert_eq!(cells.join(","), line);
            }
            assert_eq!(text.lines().count(), 1 + 31 * 3);
        }
    }

    #[test]
    fn a_robot_alone_has_its_rows_and_its_kind_s_columns() {
        let log = Run::record(TourConfig { ticks: 4, ..TourConfig::default() }, BOOK_SEED).unwrap();
        let all = table(&log, false);
        for (id, own) in [
            (0, "x_m y_m theta_rad left_wheel_rad right_wheel_rad waypoint"),
            (1, "theta1_rad theta2_rad target_theta1_rad target_theta2_rad"),
            (2, "x_m y_m theta_rad psi_rad"),
        ] {
            let columns = table_of_robot(&log, id);
            let names: Vec<&str> = columns.iter().map(|column| &*column.name).collect();
            let of_numbers = |name: &&&str| name.ends_with("_m") || name.ends_with("_rad") || **name == "waypoint";
            assert_eq!(names.iter().filter(of_numbers).copied().collect::<Vec<_>>().join(" "), own);
            for column in &columns {
                let whole = all.iter().find(|whole| whole.name == column.name).unwrap();
                let rows = (0..5).map(|tick| printed(&whole.cells, 3 * tick + id));
                assert_eq!((0..5).map(|row| printed(&column.cells, row)).collect::<Vec<_>>(), rows.collect::<Vec<_>>());
            }
        }
        assert_eq!(table_of_robot(&log, 3), []);
    }
}
