//! `Scenario`, the problems of the MovingAI benchmarks: a start and a goal each, on a map of cells.

use super::lines::numbered_lines;
use crate::error::wrong_value;
use crate::{ImportError, ImportProblem, Imported};
use motion_lab_core::geometry::{Aabb, Pose2};
use motion_lab_core::worlds::{MAX_ITEMS, Place, World, WorldProblem};

/// Largest number of problems of one file.
const MAX_PROBLEMS: usize = MAX_ITEMS / 2;

/// By how much a map and a world's bounds may differ where they are the same but for rounding, as a share.
const ROUNDING: f64 = 1e-9;

/// The columns of a problem's line.
const COLUMNS: &str = "bucket, map, width, height, start x, start y, goal x, goal y, length";

/// A cell of a MovingAI map, both numbers from 0: x from the left, y from the top row down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MapCell {
    /// The column.
    pub x: u64,
    /// The row, counted from the top.
    pub y: u64,
}

/// A problem of a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenarioProblem {
    /// The line that it stands in, from 1.
    pub line: usize,
    /// The number of its bucket: problems of like lengths share one.
    pub bucket: u64,
    /// The cell to start in.
    pub start: MapCell,
    /// The cell to reach.
    pub goal: MapCell,
    /// The length of the shortest way over the map's cells in eight directions, in cells, as the file says it.
    pub length: f64,
}

/// A scenario of the MovingAI benchmarks, its problems in the order of the file. All are on one map.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// The map, as the file names it: often by the path of whoever made the benchmark.
    pub map: String,
    /// The map's columns.
    pub width: u64,
    /// The map's rows.
    pub height: u64,
    /// The problems.
    pub problems: Vec<ScenarioProblem>,
}

impl Scenario {
    /// Reads a scenario: the line `version 1` and a line for each problem, with tabs or blanks between its columns.
    /// `file` is its name in errors.
    ///
    /// # Errors
    /// [`ImportError`] names line and column: another version, a missing or malformed number, a cell beyond the map,
    /// problems on several maps or sizes, none at all, or more than 50,000.
    ///
    /// ```
    /// use motion_lab_import::Scenario;
    /// let text = "version 1\n0\tyard.map\t3\t2\t0\t0\t2\t1\t2.41421356\n";
    /// let yard = Scenario::parse("yard.map.scen", text)?;
    /// let start = yard.pose(yard.problems[0].start, 1.0);
    /// assert_eq!((start.x, start.y), (0.5, 1.5)); // the middle of the upper left cell
    /// # Ok::<(), motion_lab_import::ImportError>(())
    /// ```
    pub fn parse(file: &str, text: &str) -> Result<Scenario, ImportError> {
        read(text).map_err(|error| error.of(file))
    }

    /// The middle of a cell, metres, facing along x, for cells of this size. The map's lower left corner is the origin:
    /// of a map of `height` rows cell (x, y) has its middle at `(x + 0.5, height - y - 0.5)` cells.
    pub fn pose(&self, cell: MapCell, metres_per_cell: f64) -> Pose2 {
        let (x, y) = (cell.x as f64 + 0.5, self.height as f64 - cell.y as f64 - 0.5);
        Pose2::new(x * metres_per_cell, y * metres_per_cell, 0.0)
    }

    /// The size of a cell in a world whose bounds the map fills, metres: every world that is made of a map is so.
    ///
    /// # Errors
    /// [`ImportError`] if the bounds have other proportions than the map. `file` is the scenario's name in errors.
    pub fn metres_per_cell(&self, file: &str, bounds: &Aabb) -> Result<f64, ImportError> {
        let (width, height) = (bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
        let scale = width / self.width as f64;
        if (height - scale * self.height as f64).abs() <= ROUNDING * height {
            return Ok(scale);
        }
        let cells = format!("{} x {} cells", self.width, self.height);
        let problem = ImportProblem::Syntax(format!("{cells} do not fill the world's bounds, {width} x {height} m"));
        Err(ImportError::at(0, "", problem).of(file))
    }

    /// The scenario as a text that [`parse`](Self::parse) reads, with tabs between its columns.
    pub fn to_text(&self) -> String {
        let line = |problem: &ScenarioProblem| {
            let ScenarioProblem { bucket, start, goal, length, .. } = problem;
            let cells = [start.x, start.y, goal.x, goal.y].map(|n| n.to_string()).join("\t");
            format!("{bucket}\t{}\t{}\t{}\t{cells}\t{length}\n", self.map, self.width, self.height)
        };
        "version 1\n".to_owned() + &self.problems.iter().map(line).collect::<String>()
    }

    /// Adds the places `start 1`, `goal 1`, `start 2` and so on to the world of its map, which has this size.
    ///
    /// # Errors
    /// [`ImportError`] if the map has another number of cells, or a place lies where no world has one. `file` is the
    /// scenario's name in errors.
    pub fn put_places(&self, file: &str, cells: [u64; 2], scale: f64, world: &mut Imported) -> Result<(), ImportError> {
        if cells != [self.width, self.height] {
            let found = format!("{} x {} cells", self.width, self.height);
            let problem = ImportProblem::Syntax(format!("{found}: the map has {} x {}", cells[0], cells[1]));
            return Err(ImportError::at(0, "", problem).of(file));
        }
        for (i, problem) in (1..).zip(&self.problems) {
            for (name, cell) in [("start", problem.start), ("goal", problem.goal)] {
                let place = put_place(&mut world.world, format!("{name} {i}"), self.pose(cell, scale));
                place.map_err(|reason| ImportError::at(problem.line, name, reason).of(file))?;
            }
        }
        Ok(())
    }
}

fn put_place(world: &mut World, name: String, pose: Pose2) -> Result<(), WorldProblem> {
    if world.places.len() >= MAX_ITEMS {
        return Err(WorldProblem::TooMany { what: "places" });
    }
    world.places.push(Place { name, pose });
    Ok(())
}

fn read(text: &str) -> Result<Scenario, ImportError> {
    let mut scenario: Option<Scenario> = None;
    let mut lines = numbered_lines(text).filter(|(_, text)| !text.trim().is_empty()).peekable();
    if let Some((line, text)) = lines.next_if(|(_, text)| text.trim_start().starts_with("version")) {
        let version = text.trim().trim_start_matches("version").trim();
        if version.parse() != Ok(1.0) {
            return Err(ImportError::at(line, "version", wrong_value(version, "1")));
        }
    }
    for (line, text) in lines {
        let problem = ScenarioLine::read(line, text)?;
        let scenario = scenario.get_or_insert_with(|| Scenario {
            map: problem.map.to_owned(),
            width: problem.size[0],
            height: problem.size[1],
            problems: vec![],
        });
        if (scenario.map.as_str(), [scenario.width, scenario.height]) != (problem.map, problem.size) {
            let reason = format!("{} of {:?}: one map and size for all problems is read", problem.map, problem.size);
            return Err(ImportError::at(line, "map", ImportProblem::Unsupported(reason)));
        }
        if scenario.problems.len() == MAX_PROBLEMS {
            let reason = format!("more than {MAX_PROBLEMS} problems");
            return Err(ImportError::at(line, "", ImportProblem::Unsupported(reason)));
        }
        scenario.problems.push(problem.problem);
    }
    scenario.ok_or_else(|| ImportProblem::Missing("a problem").into())
}

/// A line of a scenario.
struct ScenarioLine<'a> {
    map: &'a str,
    size: [u64; 2],
    problem: ScenarioProblem,
}

impl ScenarioLine<'_> {
    fn read(line: usize, text: &str) -> Result<ScenarioLine<'_>, ImportError> {
        let columns: Vec<&str> = if text.contains('\t') {
            text.split('\t').map(str::trim).collect()
        } else {
            text.split_whitespace().collect()
        };
        let [bucket, map, width, height, start_x, start_y, goal_x, goal_y, length] = columns[..] else {
            let found = format!("{} columns", columns.len());
            return Err(ImportError::at(
                line,
                "",
                ImportProblem::Syntax(format!("{found}: there must be 9: {COLUMNS}")),
            ));
        };
        let whole = |item: &str, text: &str, least: u64| {
            let number = text.parse::<u64>().ok().filter(|number| *number >= least);
            number.ok_or_else(|| ImportError::at(line, item, wrong_value(text, "a whole number")))
        };
        let bucket = whole("bucket", bucket, 0)?;
        let size = [whole("width", width, 1)?, whole("height", height, 1)?];
        let cell = |name: &str, x: &str, y: &str| {
            let cell = MapCell { x: whole(&format!("{name} x"), x, 0)?, y: whole(&format!("{name} y"), y, 0)? };
            if cell.x < size[0] && cell.y < size[1] {
                return Ok(cell);
            }
            let found = format!("cell ({}, {}) of {} x {}", cell.x, cell.y, size[0], size[1]);
            Err(ImportError::at(line, name, wrong_value(found, "on the map; x and y count from 0")))
        };
        let (start, goal) = (cell("start", start_x, start_y)?, cell("goal", goal_x, goal_y)?);
        let length = length
            .parse::<f64>()
            .ok()
            .filter(|length| length.is_finite() && *length >= 0.0)
            .ok_or_else(|| ImportError::at(line, "length", wrong_value(length, "a finite number from 0 on")))?;
        Ok(ScenarioLine { map, size, problem: ScenarioProblem { line, bucket, start, goal, length } })
    }
}
