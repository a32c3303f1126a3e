//! What there is to draw of a world, for the axes of matplotlib.

use numpy::PyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use motion_lab_core::geometry::Point2;
use motion_lab_core::picture::{Dash, Drawing, Figure, Line, Theme, world as draw_world};
use motion_lab_core::worlds::World;

use crate::world::PyWorld;

/// Points in order, shape `(k, 2)`.
type Points<'py> = Bound<'py, PyArray2<f64>>;

/// An item of a world's picture: its name, its colour, convex pieces to fill, lines to stroke, their width in pixels,
/// and whether they are dashed.
type DrawnItem<'py> = (String, String, Vec<Points<'py>>, Vec<Points<'py>>, f64, bool);

/// The items of a world's picture, in the order in which they are drawn, metres.
#[pyfunction]
pub fn _drawing<'py>(py: Python<'py>, world: &Bound<'py, PyWorld>) -> PyResult<Vec<DrawnItem<'py>>> {
    let points = |points: &Vec<Point2>| {
        let rows: Vec<Vec<f64>> = points.iter().map(|p| vec![p.x, p.y]).collect();
        PyArray2::from_vec2(py, &rows).map_err(|error| PyValueError::new_err(error.to_string()))
    };
    let all = |lists: &[Vec<Point2>]| lists.iter().map(points).collect::<PyResult<Vec<_>>>();
    let palette = Theme::Light.palette();
    let items = draw_world(&world.get().world).items.into_iter().map(|item| {
        let (pieces, lines) = match &item.drawing {
            Drawing::Region { pieces, outline } => (all(pieces)?, all(outline)?),
            Drawing::Polyline(line) => (Vec::new(), vec![points(line)?]),
            // a world's picture has no other drawing
            _ => (Vec::new(), Vec::new()),
        };
        let Line { width_px, dash, .. } = item.line.unwrap_or(Line::solid(1.0));
        let colour = palette.colour(item.role).to_string();
        Ok((item.name, colour, pieces, lines, width_px, dash != Dash::Solid))
    });
    items.collect()
}

/// A world's figure as SVG.
pub fn world_svg(world: &World) -> String {
    Figure::of(draw_world(world)).svg(Theme::Light.palette())
}
