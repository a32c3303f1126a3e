//! `Maze`, the one way through a maze.

use super::error::{GeneratorError, within};
use super::generated::GeneratedProblem;
use super::site::{ProblemSite, angle, tidy, walled};
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::geometry::{Point2, Pose2, Shape};
use motion_lab_core::random::Stream;
use motion_lab_core::worlds::{Obstacle, ObstacleKind};
use serde::{Deserialize, Serialize};

/// A maze of square cells for a rover, from the lower left cell to the upper right one.
///
/// Its passages are a spanning tree of the cells, grown depth first at random, so there is one way between any two
/// cells. A closed maze has one wall more, across the way to the goal: there is no path, and the shortest way that a
/// planner hopes for leads far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Maze {
    /// Cells from left to right.
    pub columns: u32,
    /// Cells from bottom to top.
    pub rows: u32,
    /// The side of a cell, metres.
    pub cell: f64,
    /// Whether the way is closed.
    pub closed: bool,
}

impl Default for Maze {
    fn default() -> Self {
        Maze { columns: 8, rows: 8, cell: 1.0, closed: false }
    }
}

/// The passages of a maze. Cells are counted row by row from the lower left.
struct Passages {
    columns: usize,
    /// Whether a cell is joined to its right neighbour, and to the upper one.
    joined: Vec<[bool; 2]>,
    /// The cell from which each one was reached; the first cell's is itself.
    reached_from: Vec<usize>,
}

impl Passages {
    /// Grows the tree from the first cell, depth first.
    fn grown(columns: usize, rows: usize, draws: &mut Stream) -> Self {
        let cells = columns * rows;
        let mut passages = Passages { columns, joined: vec![[false; 2]; cells], reached_from: vec![usize::MAX; cells] };
        passages.reached_from[0] = 0;
        let mut way = vec![0];
        while let Some(&cell) = way.last() {
            let (column, row) = (cell % columns, cell / columns);
            let left = (column > 0).then(|| cell - 1);
            let right = (column + 1 < columns).then_some(cell + 1);
            let below = (row > 0).then(|| cell - columns);
            let above = (row + 1 < rows).then_some(cell + columns);
            let is_new = |next: &usize| passages.reached_from[*next] == usize::MAX;
            let new: Vec<usize> = [left, right, below, above].into_iter().flatten().filter(is_new).collect();
            if new.is_empty() {
                way.pop();
                continue;
            }
            let next = new[draws.below(new.len() as u64) as usize];
            passages.reached_from[next] = cell;
            passages.set(cell, next, true);
            way.push(next);
        }
        passages
    }

    /// Joins two neighbours, or parts them.
    fn set(&mut self, a: usize, b: usize, joined: bool) {
        self.joined[a.min(b)][usize::from(a.abs_diff(b) == self.columns)] = joined;
    }

    /// Puts a wall across the way from the first cell to the last one.
    fn close(&mut self, draws: &mut Stream) {
        let last = self.joined.len() - 1;
        let way: Vec<usize> = std::iter::successors(Some(last), |cell| Some(self.reached_from[*cell]))
            .take_while(|cell| *cell > 0)
            .collect();
        let cell = way[draws.below(way.len() as u64) as usize];
        self.set(self.reached_from[cell], cell, false);
    }

    /// The walls between the cells, each as its ends in cells, as long as they go on.
    fn walls(&self) -> Vec<[[usize; 2]; 2]> {
        let (columns, rows) = (self.columns, self.joined.len() / self.columns);
        let mut walls = Vec::new();
        // to the right of a column
        for column in 1..columns {
            let is_wall = |row: usize| !self.joined[row * columns + column - 1][0];
            walls.extend(runs(rows, is_wall).into_iter().map(|[from, to]| [[column, from], [column, to]]));
        }
        for row in 1..rows {
            let is_wall = |column: usize| !self.joined[(row - 1) * columns + column][1];
            walls.extend(runs(columns, is_wall).into_iter().map(|[from, to]| [[from, row], [to, row]]));
        }
        walls
    }
}

/// The longest ranges below `count` of which everything is so.
fn runs(count: usize, is_so: impl Fn(usize) -> bool) -> Vec<[usize; 2]> {
    let mut runs: Vec<[usize; 2]> = Vec::new();
    for i in (0..count).filter(|i| is_so(*i)) {
        match runs.last_mut() {
            Some([_, to]) if *to == i => *to = i + 1,
            _ => runs.push([i, i + 1]),
        }
    }
    runs
}

impl Maze {
    pub(super) fn check(&self) -> Result<(), GeneratorError> {
        for (field, count) in [("columns", self.columns), ("rows", self.rows)] {
            within(field, f64::from(count), [2.0, 200.0])?;
        }
        // wide enough for a rover with its usual tube and margin
        within("cell", self.cell, [0.4, 10.0])
    }

    pub(super) fn problem(&self, draws: &mut Stream, name: String) -> Result<GeneratedProblem, GeneratorError> {
        let Maze { columns, rows, cell, closed } = *self;
        let mut passages = Passages::grown(columns as usize, rows as usize, draws);
        if closed {
            passages.close(draws);
        }
        let mut world = walled(name, Point2::new(tidy(f64::from(columns) * cell), tidy(f64::from(rows) * cell)));
        let at = |[column, row]: [usize; 2]| Point2::new(tidy(column as f64 * cell), tidy(row as f64 * cell));
        for (number, [a, b]) in (1..).zip(passages.walls()) {
            let piece = (Pose2::IDENTITY, Shape::Segment { a: at(a), b: at(b) });
            world.obstacles.push(Obstacle::new(format!("wall {number}"), ObstacleKind::Wall, vec![piece]));
        }
        let site = ProblemSite::new(&RobotKind::RUSTY, world);
        let middle = |column: u32, row: u32| {
            move |draws: &mut Stream| {
                let [x, y] = [column, row].map(|count| tidy((f64::from(count) + 0.5) * cell));
                vec![x, y, angle(draws)]
            }
        };
        let start = site.free("start", draws, middle(0, 0))?;
        let goal = site.free("goal", draws, middle(columns - 1, rows - 1))?;
        Ok(GeneratedProblem { task: site.task([start, goal])?, has_path: Some(!closed) })
    }
}
