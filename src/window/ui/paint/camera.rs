//! `Camera`, what part of a world is shown, and how large.

use motion_lab_core::geometry::{Aabb, Point2};
use motion_lab_core::num::{greater, lesser};
use motion_lab_core::picture::Fit;

/// Largest scale, points per metre.
const LARGEST: f64 = 400.0;

/// How much a key or a button magnifies.
pub const STEP: f64 = 1.5;

/// Length of what is shown across when a robot is followed at first, metres.
const AROUND: f64 = 16.0;

/// What part of a world is shown. By default all of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The point of the world in the middle of the paper; `None` for the middle of the world.
    pub centre: Option<Point2>,
    /// The scale, as a multiple of that at which the world just fits; at least 1.
    pub zoom: f64,
}

impl Default for Camera {
    fn default() -> Self {
        Camera { centre: None, zoom: 1.0 }
    }
}

impl Camera {
    /// How the world lies on paper on which it lies whole as `whole` says. `scale` pixels are a point. Shown whole, it
    /// is centred; otherwise the middle is in the world, also in one that has become smaller since.
    pub fn fit(&self, whole: &Fit, bounds: &Aabb, scale: f64) -> Fit {
        match self.centre {
            Some(centre) if self.zoom > 1.0 => whole.magnified(inside(centre, bounds), self.zoom).on_pixels(scale),
            _ => whole.magnified(bounds.centre(), 1.0),
        }
    }

    /// Magnifies by `factor` so that the point `at` of the world stays where it is on the screen. The scale stays in
    /// its range, and the whole world is centred.
    pub fn zoom_at(&mut self, at: Point2, factor: f64, whole: &Fit, bounds: &Aabb) {
        let zoom = greater(1.0, lesser(largest_magnification(whole), self.zoom * factor));
        let centre = self.middle(bounds);
        if zoom <= 1.0 {
            *self = Camera::default();
        } else if zoom != self.zoom {
            self.look_at(at + (centre - at) * (self.zoom / zoom), bounds);
            self.zoom = zoom;
        }
    }

    /// Magnifies by `factor`; the middle stays.
    pub fn magnify(&mut self, factor: f64, bounds: &Aabb) {
        let zoom = self.zoom * factor;
        *self = if zoom > 1.0 { Camera { centre: Some(self.middle(bounds)), zoom } } else { Camera::default() };
    }

    /// Keeps the scale in its range, for paper on which the world lies whole as `whole` says.
    pub fn settle(&mut self, whole: &Fit) {
        self.zoom = lesser(self.zoom, largest_magnification(whole));
    }

    /// The point of the world in the middle of the paper.
    pub fn middle(&self, bounds: &Aabb) -> Point2 {
        self.centre.unwrap_or_else(|| bounds.centre())
    }

    /// Puts a point of the world into the middle, or the nearest one that is in the world.
    pub fn look_at(&mut self, centre: Point2, bounds: &Aabb) {
        self.centre = Some(inside(centre, bounds));
    }

    /// Comes so near that some metres are seen, for a paper `across` points across; does nothing if it is nearer.
    pub fn approach(&mut self, across: f64, whole: &Fit) {
        self.zoom = greater(self.zoom, across / (AROUND * whole.px_per_metre()));
    }
}

/// The largest magnification of a world that lies whole as `whole` says.
fn largest_magnification(whole: &Fit) -> f64 {
    greater(1.0, LARGEST / whole.px_per_metre())
}

/// The point of a box that is nearest to a point.
fn inside(p: Point2, bounds: &Aabb) -> Point2 {
    let within = |v, min, max| greater(min, lesser(max, v));
    let Aabb { min, max } = bounds;
    Point2::new(within(p.x, min.x, max.x), within(p.y, min.y, max.y))
}
