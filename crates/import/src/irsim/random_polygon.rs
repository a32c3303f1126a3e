//! Polygons at random, by the rule that IR-SIM has them from.

use std::f64::consts::TAU;

use crate::ImportError;
use crate::yaml::Fields;
use motion_lab_core::geometry::Point2;
use motion_lab_core::num::sin_cos;
use motion_lab_core::random::Stream;

/// Largest number of vertices of a polygon that is drawn.
const MAX_DRAWN_VERTICES: f64 = 1000.0;

/// The ranges that a polygon is drawn from; a range's end is not drawn.
#[derive(Clone, Copy)]
pub(crate) struct RandomPolygon {
    /// Of the centre: least x and y, greatest x and y.
    centre: [f64; 4],
    radius: [f64; 2],
    /// How much the angles between vertices differ, from 0 to 1.
    irregularity: [f64; 2],
    /// How much the vertices' distances from the centre differ, from 0 to 1.
    spikeyness: [f64; 2],
    vertices: [f64; 2],
}

impl RandomPolygon {
    /// Takes the ranges of a shape, with IR-SIM's where they are left out. Errors name the shape `item`.
    pub fn take(item: &str, fields: &mut Fields, is_convex: bool) -> Result<RandomPolygon, ImportError> {
        let centre = match fields.take("center_range") {
            None => [0.0; 4],
            Some(node) => {
                let four = node.numbers(&format!("{item}.center_range"), 4..=4, "four numbers: x, y, x, y")?;
                [four[0], four[1], four[2], four[3]]
            }
        };
        let mut range = |key: &str, usual: [f64; 2], least: f64, most: f64| match fields.take(key) {
            None => Ok(usual),
            Some(node) => {
                let at = format!("{item}.{key}");
                let two = node.numbers(&at, 2..=2, "two numbers: a range")?;
                let is_range = least <= two[0] && two[0] <= two[1] && two[1] <= most;
                if is_range { Ok([two[0], two[1]]) } else { Err(node.wrong(&at, "a range of numbers that fit it")) }
            }
        };
        Ok(RandomPolygon {
            centre,
            radius: range("avg_radius_range", [0.1, 1.0], 0.0, f64::MAX)?,
            irregularity: range("irregularity_range", [0.0, 1.0], 0.0, 1.0)?,
            spikeyness: range("spikeyness_range", [0.0, if is_convex { 0.0 } else { 1.0 }], 0.0, 1.0)?,
            vertices: range("num_vertices_range", [4.0, 10.0], 3.0, MAX_DRAWN_VERTICES)?,
        })
    }

    /// The largest number of vertices that are drawn.
    pub fn max_vertices(&self) -> usize {
        self.vertices[1] as usize
    }

    /// Draws a polygon: vertices round a centre, at steps of the angle and at distances that differ.
    pub fn draw(&self, stream: &mut Stream) -> Vec<Point2> {
        let [left, low, right, high] = self.centre;
        let centre = Point2::new(stream.uniform(left, right), stream.uniform(low, high));
        let mut of = |[from, to]: [f64; 2]| stream.uniform(from, to);
        let (radius, irregularity, spikeyness) = (of(self.radius), of(self.irregularity), of(self.spikeyness));
        let [least, end] = self.vertices.map(|n| n as u64);
        let count = least + stream.below(end.saturating_sub(least));
        let step = TAU / count as f64;
        let steps: Vec<f64> =
            (0..count).map(|_| stream.uniform(step * (1.0 - irregularity), step * (1.0 + irregularity))).collect();
        let turn = TAU / steps.iter().sum::<f64>();
        let mut angle = stream.uniform(0.0, TAU);
        let vertex = |step: f64| {
            let distance = (radius + spikeyness * radius * stream.normal()).clamp(0.0, 2.0 * radius);
            let (sin, cos) = sin_cos(angle);
            angle += step * turn;
            Point2::new(centre.x + distance * cos, centre.y + distance * sin)
        };
        steps.into_iter().map(vertex).collect()
    }
}
