//! Shapes: worlds out of arrays, and arrays out of worlds.

use numpy::prelude::*;
use numpy::{PyArray2, PyArrayDyn, PyReadonlyArrayDyn};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use motion_lab_core::cspace::rectangles::rectangles;
use motion_lab_core::geometry::{Aabb, Placed, Point2};
use motion_lab_core::worlds::{Grid, ShapeText, World, WorldBuilder, WorldProblem};

use crate::arrays::{borrowed, numbers_of, shape_text};
use crate::errors::nowhere_in_a_world;

/// A world under construction out of arrays.
#[derive(Default)]
pub struct Shapes {
    world: WorldBuilder,
    /// The box around all cells.
    cells: Option<Aabb>,
}

/// Rows of numbers of one width.
struct Table<'py> {
    array: PyReadonlyArrayDyn<'py, f64>,
    width: usize,
}

impl<'py> Table<'py> {
    /// An array of rows of this width, or of pairs of points.
    fn read(name: &'static str, given: &Bound<'py, PyAny>, width: usize, what: &str) -> PyResult<Self> {
        let array = numbers_of(name, given)?;
        let fits = match *array.shape() {
            [_, n] => n == width,
            [_, 2, 2] => width == 4,
            // an empty list has no rows
            [0] => true,
            _ => false,
        };
        if !fits {
            let shape = shape_text(array.shape());
            return Err(PyValueError::new_err(format!("{name} has shape {shape}, not (n, {width}): {what}")));
        }
        Ok(Table { array: borrowed(name, &array)?, width })
    }

    fn rows(&self) -> PyResult<impl Iterator<Item = &[f64]>> {
        let numbers = self.array.as_slice().map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(numbers.chunks_exact(self.width))
    }
}

impl Shapes {
    /// Adds segments.
    pub fn segments(&mut self, given: &Bound<'_, PyAny>) -> PyResult<()> {
        let table = Table::read("segments", given, 4, "x0, y0, x1, y1")?;
        for (i, row) in table.rows()?.enumerate() {
            let &[x0, y0, x1, y1] = row else { continue };
            let name = self.world.numbered("segment");
            let added = self.world.wall(name, vec![(x0, y0), (x1, y1)], false);
            added.map_err(|problem| refused(given.py(), "segments", i, &problem))?;
        }
        Ok(())
    }

    /// Adds boxes.
    pub fn boxes(&mut self, given: &Bound<'_, PyAny>) -> PyResult<()> {
        let table = Table::read("boxes", given, 4, "min x, min y, max x, max y")?;
        for (i, row) in table.rows()?.enumerate() {
            let &[x0, y0, x1, y1] = row else { continue };
            self.solid("boxes", "box", i, given.py(), ShapeText::Box { min: (x0, y0), max: (x1, y1) })?;
        }
        Ok(())
    }

    /// Adds discs.
    pub fn discs(&mut self, given: &Bound<'_, PyAny>) -> PyResult<()> {
        let table = Table::read("discs", given, 3, "x, y, radius")?;
        for (i, row) in table.rows()?.enumerate() {
            let &[x, y, radius] = row else { continue };
            self.solid("discs", "disc", i, given.py(), ShapeText::Disc { center: (x, y), radius })?;
        }
        Ok(())
    }

    /// Adds polygons.
    pub fn polygons(&mut self, given: &Bound<'_, PyAny>) -> PyResult<()> {
        for (i, polygon) in given.try_iter()?.enumerate() {
            let table = Table::read("a polygon", &polygon?, 2, "x, y")?;
            let points = table.rows()?.filter_map(|row| Some((*row.first()?, *row.get(1)?))).collect();
            self.solid("polygons", "polygon", i, given.py(), ShapeText::Polygon(points))?;
        }
        Ok(())
    }

    fn solid(&mut self, list: &str, stem: &str, i: usize, py: Python<'_>, shape: ShapeText) -> PyResult<()> {
        py.check_signals()?;
        let name = self.world.numbered(stem);
        self.world.solid(name, shape).map_err(|problem| refused(py, list, i, &problem))
    }

    /// Adds the occupied cells of a grid, as boxes that cover them.
    pub fn occupancy(&mut self, given: &Bound<'_, PyAny>, resolution: Option<f64>, (x, y): (f64, f64)) -> PyResult<()> {
        let py = given.py();
        let wrong = |words: String| Err(PyValueError::new_err(words));
        let Ok(array) = given.cast::<PyArrayDyn<bool>>() else {
            return wrong(
                "occupancy is no array of bool: say which cells are occupied, as `grid > 0.5` does".to_owned(),
            );
        };
        let Some(resolution) = resolution else {
            return wrong("occupancy needs a resolution, the length of a cell's side in metres".to_owned());
        };
        let (rows, columns) = match *array.shape() {
            [rows, columns] => (rows, columns),
            _ => return wrong(format!("occupancy has shape {}, not (rows, columns)", shape_text(array.shape()))),
        };
        let occupied = array.to_owned_array().into_iter().collect::<Vec<bool>>();
        let counts = u32::try_from(columns).ok().zip(u32::try_from(rows).ok());
        let grid = counts
            .and_then(|(columns, rows)| Grid::of_cells(Point2::new(x, y), resolution, columns, rows, occupied.clone()));
        let Some(grid) = grid else {
            return wrong(format!("occupancy has shape {}: it has no cells, or too many", shape_text(array.shape())));
        };
        for (i, cells) in rectangles(&occupied, grid.columns(), |here| *here).into_iter().enumerate() {
            let min = grid.square(cells.left, cells.low).min;
            let max = grid.square(cells.right - 1, cells.high - 1).max;
            let shape = ShapeText::Box { min: (min.x, min.y), max: (max.x, max.y) };
            self.solid("the boxes of occupancy", "cells", i, py, shape)?;
        }
        let (low, high) = (grid.square(0, 0), grid.square(grid.columns() - 1, grid.rows() - 1));
        self.cells = Some(low.merged(&high));
        Ok(())
    }

    /// The world, with these bounds, or with the box around everything in it.
    pub fn finish(self, py: Python<'_>, name: &str, bounds: Option<(f64, f64, f64, f64)>) -> PyResult<World> {
        let refused = |problem: WorldProblem| nowhere_in_a_world(py, format!("bounds: {problem}"));
        if let Some((x0, y0, x1, y1)) = bounds {
            return self.world.finish(name, (x0, y0), (x1, y1)).map_err(refused);
        }
        let cells = self.cells;
        // any bounds will do until the shapes say theirs
        let mut world = self.world.finish(name, (0.0, 0.0), (1.0, 1.0)).map_err(refused)?;
        let around = world.obstacles.iter().flat_map(|obstacle| obstacle.placed()).map(|piece| piece.bounds());
        let Some(Aabb { min, max }) = around.chain(cells).reduce(|a, b| a.merged(&b)) else {
            return Err(PyValueError::new_err("a world without a shape needs bounds"));
        };
        world.bounds = WorldBuilder::default().finish(name, (min.x, min.y), (max.x, max.y)).map_err(refused)?.bounds;
        Ok(world)
    }
}

fn refused(py: Python<'_>, list: &str, i: usize, problem: &WorldProblem) -> PyErr {
    nowhere_in_a_world(py, format!("{list}[{i}]: {problem}"))
}

/// Convex pieces as tuples of Python: `Shape(vertices, radius)`.
pub fn pieces<'py>(py: Python<'py>, placed: impl Iterator<Item = Placed>) -> PyResult<Bound<'py, PyTuple>> {
    let class = py.import("motion_lab._answers")?.getattr("Shape")?;
    let mut shapes = Vec::new();
    for piece in placed {
        let vertices: Vec<Vec<f64>> = piece.core().iter().map(|p| vec![p.x, p.y]).collect();
        let vertices = PyArray2::from_vec2(py, &vertices).map_err(|error| PyValueError::new_err(error.to_string()))?;
        shapes.push(class.call1((vertices, piece.radius()))?);
    }
    PyTuple::new(py, shapes)
}
