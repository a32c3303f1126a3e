//! `OccupancyMap`, a map of cells, and its conversion to a world.

use super::trace::{BorderCorner, trace};
use crate::{ImportError, ImportProblem, Imported, WorldDraft};
use motion_lab_core::geometry::{MIN_FEATURE, Point2, Pose2};
use motion_lab_core::num::{greater, lesser};
use motion_lab_core::worlds::{Grid, MAX_CELLS, MAX_ITEMS, ShapeText, WorldProblem, Xy};

/// What occupied cells become.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CellStyle {
    /// Boxes that cover them, interior included.
    #[default]
    Solid,
    /// Closed walls along their borders, with collinear edges joined. The interior holds no obstacle: nothing can
    /// enter, but a robot placed inside touches nothing. A note of the world says so.
    Hollow,
}

#[derive(Clone, Copy)]
struct Rectangle {
    low: BorderCorner,
    /// Its upper right corner.
    high: BorderCorner,
}

/// A map of occupied cells.
#[derive(Clone, Debug, PartialEq)]
pub struct OccupancyMap {
    /// The cells.
    pub grid: Grid,
    /// The pose of the grid's frame in the world. If it is the identity, the cells' corners are the grid's own, to the
    /// bit.
    pub frame: Pose2,
    /// Notes for the reader.
    pub notes: Vec<String>,
}

impl OccupancyMap {
    /// Creates a world in which the occupied cells are obstacles. Its bounds enclose the map, and every edge of an
    /// obstacle lies on borders of cells. Without an occupied cell it is empty, with a note.
    ///
    /// # Errors
    /// [`ImportError`] if there are too many edges or boxes for a world, coordinates are too large, or cells are
    /// smaller than [`MIN_FEATURE`]. `file` is the map's name in errors.
    pub fn world(&self, file: &str, name: &str, style: CellStyle) -> Result<Imported, ImportError> {
        let mut draft = WorldDraft::default();
        self.notes.iter().for_each(|note| draft.note(note));
        let obstacles = match style {
            CellStyle::Solid => self.boxes(&mut draft),
            CellStyle::Hollow => self.walls(&mut draft),
        };
        let imported = obstacles.and_then(|()| {
            let (min, max) = self.bounds();
            if draft.world.is_empty() {
                draft.note("no cell of the map is an obstacle");
            }
            draft.finish(name, min, max)
        });
        imported.map_err(|problem| ImportError::at(0, "", problem).of(file))
    }

    fn walls(&self, draft: &mut WorldDraft) -> Result<(), WorldProblem> {
        let lines = trace(&self.grid);
        if !lines.is_empty() {
            draft.note("the occupied cells are hollow: a robot put inside their walls touches nothing");
        }
        lines.iter().try_for_each(|line| {
            let name = draft.world.numbered("wall");
            draft.world.wall(name, line.iter().map(|&c| self.corner(c)).collect(), true)
        })
    }

    fn boxes(&self, draft: &mut WorldDraft) -> Result<(), WorldProblem> {
        for Rectangle { low, high } in rectangles(&self.grid) {
            let shape = if self.frame == Pose2::IDENTITY {
                ShapeText::Box { min: self.corner(low), max: self.corner(high) }
            } else {
                let corners = [low, BorderCorner { row: low.row, ..high }, high, BorderCorner { row: high.row, ..low }];
                ShapeText::Polygon(corners.map(|c| self.corner(c)).to_vec())
            };
            let name = draft.world.numbered("box");
            draft.world.solid(name, shape)?;
        }
        Ok(())
    }

    /// A corner of cells in the world.
    fn corner(&self, of: BorderCorner) -> Xy {
        let at = self.grid.corner(of.column, of.row);
        let at = if self.frame == Pose2::IDENTITY { at } else { self.frame.transform(at) };
        (at.x, at.y)
    }

    fn bounds(&self) -> (Xy, Xy) {
        let (right, top) = (self.grid.columns(), self.grid.rows());
        let [first, rest @ ..] =
            [(0, 0), (right, 0), (right, top), (0, top)].map(|(column, row)| self.corner(BorderCorner { column, row }));
        rest.iter().fold((first, first), |(min, max), p| {
            ((lesser(p.0, min.0), lesser(p.1, min.1)), (greater(p.0, max.0), greater(p.1, max.1)))
        })
    }
}

/// Covers the occupied cells with rectangles that do not overlap. They are grown along the rows first, and along the
/// columns first; the smaller set is returned.
fn rectangles(grid: &Grid) -> Vec<Rectangle> {
    let along = grown(grid.columns(), grid.rows(), |column, row| grid.is_occupied(column, row));
    let mut up = grown(grid.rows(), grid.columns(), |row, column| grid.is_occupied(column, row));
    if along.len() <= up.len() {
        return along;
    }
    for Rectangle { low, high } in &mut up {
        for corner in [low, high] {
            *corner = BorderCorner { column: corner.row, row: corner.column };
        }
    }
    up
}

/// Rectangles that cover the occupied cells of a grid of this size: each as wide as possible, then as high as possible.
fn grown(columns: u32, rows: u32, is_occupied: impl Fn(u32, u32) -> bool) -> Vec<Rectangle> {
    let index = |column: u32, row: u32| row as usize * columns as usize + column as usize;
    let mut left: Vec<bool> = (0..rows)
        .flat_map(|row| (0..columns).map(move |column| (column, row)))
        .map(|(c, r)| is_occupied(c, r))
        .collect();
    let mut found = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            if !left[index(column, row)] {
                continue;
            }
            let end = (column..columns).find(|&c| !left[index(c, row)]).unwrap_or(columns);
            let is_full = |r: u32| left[index(column, r)..index(end - 1, r) + 1].iter().all(|&l| l);
            let top = (row + 1..rows).find(|&r| !is_full(r)).unwrap_or(rows);
            for r in row..top {
                left[index(column, r)..index(end - 1, r) + 1].fill(false);
            }
            found.push(Rectangle { low: BorderCorner { column, row }, high: BorderCorner { column: end, row: top } });
            if found.len() > MAX_ITEMS {
                return found; // more than a world holds
            }
        }
    }
    found
}

/// Creates a grid from cells given by rows from the top. Checks their number and size.
pub(crate) fn grid_of(
    origin: Point2,
    resolution: f64,
    columns: u64,
    rows: u64,
    cells: impl FnOnce() -> Result<Vec<bool>, ImportError>,
) -> Result<Grid, ImportError> {
    check_size(columns, rows).map_err(|problem| ImportError::at(0, "", problem))?;
    if !(resolution.is_finite() && resolution >= MIN_FEATURE) {
        let problem = crate::error::wrong_value(resolution, "a cell's size in metres, finite and at least 0.001");
        return Err(ImportError::at(0, "resolution", problem));
    }
    let mut cells = cells()?;
    let found = cells.len() as u64;
    // a grid's rows start at the bottom: reverse all cells, then each row
    cells.reverse();
    cells.chunks_mut(columns as usize).for_each(<[bool]>::reverse);
    Grid::of_cells(origin, resolution, columns as u32, rows as u32, cells)
        .ok_or_else(|| ImportError::at(0, "", ImportProblem::Count { what: "cells", found, expected: columns * rows }))
}

/// Refuses a map with more than `MAX_CELLS` cells.
pub(crate) fn check_size(columns: u64, rows: u64) -> Result<(), ImportProblem> {
    match columns.checked_mul(rows) {
        Some(cells) if cells <= MAX_CELLS => Ok(()),
        _ => Err(ImportProblem::TooManyCells { columns, rows }),
    }
}
