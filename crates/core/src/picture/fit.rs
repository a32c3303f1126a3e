//! `Fit`, the map from a picture in metres to a screen in pixels, and the scale bar that shows its scale.

use crate::geometry::{Aabb, Point2};
use crate::num::lesser;

/// Free room around a picture in a page, pixels.
const PAGE_MARGIN: f64 = 8.0;

/// A point of the screen, pixels: x right, y down.
pub type ScreenPoint = [f64; 2];

/// A rectangle of the screen, pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScreenRect {
    /// The corner with the least coordinates.
    pub min: ScreenPoint,
    /// Width and height.
    pub size: [f64; 2],
}

/// The map from metres to pixels under which a piece of the plane just fits a rectangle of the screen, centred.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    px_per_metre: f64,
    centre: Point2,
    center_on_screen: ScreenPoint,
}

impl Fit {
    /// Fits `bounds` into the middle of `rect`, with `margin_px` free around it. The scale is never below a thousandth
    /// of a pixel per metre, however small the rectangle.
    pub fn new(bounds: &Aabb, rect: ScreenRect, margin_px: f64) -> Self {
        let (w, h) = (bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
        let scale = lesser((rect.size[0] - 2.0 * margin_px) / w, (rect.size[1] - 2.0 * margin_px) / h);
        Fit {
            // written so that NaN (a picture without extent) falls back too
            px_per_metre: if scale > 1e-3 && scale.is_finite() { scale } else { 1e-3 },
            centre: Point2::new(bounds.min.x + 0.5 * w, bounds.min.y + 0.5 * h),
            center_on_screen: [rect.min[0] + 0.5 * rect.size[0], rect.min[1] + 0.5 * rect.size[1]],
        }
    }

    /// Where a picture with these bounds lies in a part of a page of this size, pixels: see
    /// [`Picture::svg_in_page`](super::Picture::svg_in_page).
    pub fn in_page(bounds: &Aabb, size: [f64; 2]) -> Self {
        Fit::new(bounds, ScreenRect { min: [0.0; 2], size }, PAGE_MARGIN)
    }

    /// The same rectangle of the screen with `centre`, a point of the world, in its middle, at `zoom` times the scale.
    #[must_use]
    pub fn magnified(self, centre: Point2, zoom: f64) -> Self {
        Fit { px_per_metre: self.px_per_metre * zoom, centre, ..self }
    }

    /// Moved by half a pixel at most in x and in y, so that the world's origin lies on a corner of pixels, of which
    /// `scale` make a unit of the screen.
    #[must_use]
    pub fn on_pixels(self, scale: f64) -> Self {
        let origin = self.screen_from_world(Point2::origin());
        let [dx, dy] = origin.map(|v| (v * scale).round() / scale - v);
        let [x, y] = self.center_on_screen;
        Fit { center_on_screen: [x + dx, y + dy], ..self }
    }

    /// The piece of the world that a rectangle of the screen shows.
    pub fn shown_in(&self, rect: ScreenRect) -> Aabb {
        let [x, y] = rect.min;
        let low = self.world_from_screen([x, y + rect.size[1]]);
        Aabb { min: low, max: self.world_from_screen([x + rect.size[0], y]) }
    }

    /// The scale, pixels per metre.
    pub fn px_per_metre(&self) -> f64 {
        self.px_per_metre
    }

    /// Where a point of the world lies on the screen.
    pub fn screen_from_world(&self, p: Point2) -> ScreenPoint {
        let d = (p - self.centre) * self.px_per_metre;
        [self.center_on_screen[0] + d.x, self.center_on_screen[1] - d.y]
    }

    /// The point of the world at a point of the screen.
    pub fn world_from_screen(&self, p: ScreenPoint) -> Point2 {
        Point2::new(
            self.centre.x + (p[0] - self.center_on_screen[0]) / self.px_per_metre,
            self.centre.y - (p[1] - self.center_on_screen[1]) / self.px_per_metre,
        )
    }
}

/// A bar of a round length.
#[derive(Clone, Debug, PartialEq)]
pub struct ScaleBar {
    /// Its label, such as `2 m`.
    pub label: String,
    /// Its length on the screen, pixels.
    pub length_px: f64,
}

impl ScaleBar {
    /// The longest bar of 1, 2 or 5 times a power of ten metres, from a millimetre to 5 km, that is at most `most_px`
    /// long. If even the shortest is longer, that one.
    pub fn new(px_per_metre: f64, most_px: f64) -> Self {
        let mut best = (0.001, "1 mm".to_owned());
        for (unit, name, decades) in [(0.001, "mm", 3), (1.0, "m", 3), (1000.0, "km", 1)] {
            let mut power = 1;
            for _ in 0..decades {
                for digit in [1, 2, 5] {
                    let metres = f64::from(digit * power) * unit;
                    if metres * px_per_metre <= most_px {
                        best = (metres, format!("{} {name}", digit * power));
                    }
                }
                power *= 10;
            }
        }
        ScaleBar { label: best.1, length_px: best.0 * px_per_metre }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounds(w: f64, h: f64) -> Aabb {
        Aabb { min: Point2::new(1.0, -1.0), max: Point2::new(1.0 + w, -1.0 + h) }
    }

    #[test]
    fn a_picture_fits_in_the_middle_with_y_up() {
        let rect = ScreenRect { min: [100.0, 50.0], size: [320.0, 220.0] };
        let fit = Fit::new(&bounds(12.0, 8.0), rect, 10.0);
        assert_eq!(fit.px_per_metre(), 25.0, "8 m take the 200 px that are left");
        let low = fit.screen_from_world(Point2::new(1.0, -1.0));
        let high = fit.screen_from_world(Point2::new(1.0, 7.0));
        assert_eq!((low[1], high[1]), (260.0, 60.0), "up is up");
        assert_eq!(low[0], 110.0);
        let back = fit.world_from_screen(fit.screen_from_world(Point2::new(3.25, 2.5)));
        assert!((back - Point2::new(3.25, 2.5)).norm() < 1e-12);
        let none = Fit::new(&bounds(0.0, 0.0), rect, 10.0);
        assert!(none.screen_from_world(Point2::new(1.0, 2.0)).iter().all(|v| v.is_finite()));
    }

    #[test]
    fn a_magnified_fit_has_its_centre_in_the_middle_and_shows_less() {
        let rect = ScreenRect { min: [100.0, 50.0], size: [320.0, 220.0] };
        let fit = Fit::new(&bounds(12.0, 8.0), rect, 10.0).magnified(Point2::new(3.0, 4.0), 4.0);
        assert_eq!(fit.px_per_metre(), 100.0, "four times 25");
        assert_eq!(fit.screen_from_world(Point2::new(3.0, 4.0)), [260.0, 160.0]);
        let shown = fit.shown_in(rect);
        assert_eq!((shown.min, shown.max), (Point2::new(1.4, 2.9), Point2::new(4.6, 5.1)), "3.2 m by 2.2 m around it");
        let at = fit.screen_from_world(Point2::origin());
        assert_eq!(at, [-40.0, 560.0]);
        let odd = fit.magnified(Point2::new(3.003, 4.001), 1.0);
        let near = |fit: &Fit, at: [f64; 2]| {
            let origin = fit.screen_from_world(Point2::origin());
            (origin[0] - at[0]).abs() < 1e-9 && (origin[1] - at[1]).abs() < 1e-9
        };
        assert!(near(&odd, [-40.3, 560.1]));
        assert!(near(&odd.on_pixels(1.0), [-40.0, 560.0]));
        assert!(near(&odd.on_pixels(2.0), [-40.5, 560.0]), "two pixels a unit");
    }

    #[test]
    fn scale_bars_are_round_and_fit() {
        let bar = ScaleBar::new(33.0, 80.0);
        assert_eq!((bar.label.as_str(), bar.length_px), ("2 m", 66.0));
        assert_eq!(ScaleBar::new(0.1, 80.0).label, "500 m");
        assert_eq!(ScaleBar::new(900.0, 80.0).label, "50 mm");
        assert_eq!(ScaleBar::new(0.05, 80.0).label, "1 km");
    }
}
