//! Where contacts began: squares over the world, the fuller the more contacts began in them.

use bevy_egui::egui::{Rect, pos2};

use crate::window::ui::FrameColours;
use crate::window::ui::paint::polygons::Polygons;
use motion_lab_core::geometry::{Aabb, Point2};
use motion_lab_core::num::{greater, lesser};
use motion_lab_core::picture::{Fit, Role};
use motion_lab_sim::simulation::{Happening, TickMark};

/// Number of squares along the longer side of a world.
const ALONG: f64 = 96.0;

/// Least side of a square, metres.
const MIN_SQUARE: f64 = 0.25;

/// Opacity of the square in which the most contacts began.
const FULL: f64 = 0.7;

/// The contacts that began in each square of a world.
#[derive(Clone, Debug, PartialEq)]
pub struct Heat {
    low: Point2,
    /// The side of a square, metres.
    side: f64,
    columns: usize,
    /// Row by row, the lowest first.
    pub counts: Vec<u32>,
}

impl Heat {
    /// The contacts up to `tick` of the robots with these ids, in a world within `bounds`.
    pub fn of(marks: &[TickMark], tick: u64, ids: std::ops::Range<u32>, bounds: &Aabb) -> Self {
        let (w, h) = (bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
        let side = greater(MIN_SQUARE, greater(w, h) / ALONG);
        let cells = |length: f64| (length / side).ceil().clamp(1.0, 2.0 * ALONG) as usize;
        let (columns, rows) = (cells(w), cells(h));
        let mut heat = Heat { low: bounds.min, side, columns, counts: vec![0; columns * rows] };
        let cell = |v: f64, n: usize| ((v / side).floor().clamp(0.0, 1e6) as usize).min(n - 1);
        for mark in marks.iter().take_while(|m| m.tick <= tick) {
            if mark.what == Happening::Contact && ids.contains(&mark.robot) {
                let (x, y) = (mark.at.x - heat.low.x, mark.at.y - heat.low.y);
                heat.counts[cell(y, rows) * columns + cell(x, columns)] += 1;
            }
        }
        heat
    }

    /// The squares in which contacts began, on the screen.
    pub fn squares(&self, fit: &Fit, look: &FrameColours) -> Polygons {
        let mut out = Polygons::default();
        let most = f64::from(self.counts.iter().copied().max().unwrap_or(0));
        let at = |column: usize, row: usize| {
            let p = Point2::new(self.low.x + self.side * column as f64, self.low.y + self.side * row as f64);
            let [x, y] = fit.screen_from_world(p);
            pos2(x as f32, y as f32)
        };
        for (i, count) in self.counts.iter().enumerate().filter(|(_, n)| **n > 0) {
            let (column, row) = (i % self.columns, i / self.columns);
            let rect = Rect::from_two_pos(at(column, row), at(column + 1, row + 1));
            // one contact beside a thousand is to be seen too
            let share = lesser(1.0, f64::from(*count) / most);
            out.rect(rect, look.tint(Role::Goal, FULL * (0.3 + 0.7 * share)));
        }
        out
    }
}
