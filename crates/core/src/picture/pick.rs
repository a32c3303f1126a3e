//! Finds the item of a picture at a point of the screen.

use super::{Fit, Item, Picture, Primitive, ScreenPoint, resolve};
use crate::num::{hypot, sqrt};

/// The topmost item that is drawn at `at` or within `reach_px` of it. Words are ignored.
pub fn pick<'a>(picture: &'a Picture, fit: &Fit, at: ScreenPoint, reach_px: f64) -> Option<&'a Item> {
    picture.items.iter().rev().find(|item| resolve(item, fit).iter().any(|p| touches(p, at, reach_px)))
}

fn touches(primitive: &Primitive, at: ScreenPoint, reach: f64) -> bool {
    let from = |p: &ScreenPoint| hypot(p[0] - at[0], p[1] - at[1]);
    match primitive {
        Primitive::Area { corners, .. } => contains(corners, at),
        Primitive::Dots { centres, radius, .. } => centres.iter().any(|c| from(c) <= radius + reach),
        Primitive::Circle { centre, radius, .. } => (from(centre) - radius).abs() <= reach,
        Primitive::Lines { lines, .. } => {
            lines.iter().flat_map(|l| l.windows(2)).any(|l| distance(at, l[0], l[1]) <= reach)
        }
        Primitive::Text { .. } => false,
    }
}

/// Whether a convex polygon, in either orientation, holds a point.
fn contains(corners: &[ScreenPoint], at: ScreenPoint) -> bool {
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    let turns = sides.map(|(a, b)| (b[0] - a[0]) * (at[1] - a[1]) - (b[1] - a[1]) * (at[0] - a[0]));
    let (left, right) = turns.fold((true, true), |(l, r), t| (l && t >= 0.0, r && t <= 0.0));
    corners.len() > 2 && (left || right)
}

fn distance(p: ScreenPoint, a: ScreenPoint, b: ScreenPoint) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length2 = dx * dx + dy * dy;
    let t = if length2 > 0.0 { ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length2 } else { 0.0 };
    let t = t.clamp(0.0, 1.0);
    let (ex, ey) = (a[0] + t * dx - p[0], a[1] + t * dy - p[1]);
    sqrt(ex * ex + ey * ey)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Aabb;
    use crate::geometry::Point2;
    use crate::picture::{Drawing, Fill, Line, Role, ScreenRect};

    #[test]
    fn the_topmost_item_under_the_pointer_is_found() {
        let p = Point2::new;
        let bounds = Aabb { min: p(0.0, 0.0), max: p(10.0, 10.0) };
        let square = [p(1.0, 1.0), p(5.0, 1.0), p(5.0, 5.0), p(1.0, 5.0)].to_vec();
        let picture = Picture::new("Yard", bounds).with([
            Item::new("box", "the box", Role::Obstacle, Drawing::Polygon(square)).filled(Fill::Hatch),
            Item::new("wall", "the wall", Role::Obstacle, Drawing::segment(p(0.0, 9.0), p(10.0, 9.0)))
                .stroked(Line::solid(2.0)),
            Item::new("robot", "Rusty", Role::Robot, Drawing::Disc { centre: p(5.0, 3.0), radius: 1.0 })
                .filled(Fill::Tint(0.9)),
        ]);
        let fit = Fit::new(&bounds, ScreenRect { min: [0.0, 0.0], size: [100.0, 100.0] }, 0.0);
        let at = |x, y| pick(&picture, &fit, fit.screen_from_world(p(x, y)), 3.0).map(|i| i.id.as_str());
        assert_eq!(at(2.0, 2.0), Some("box"));
        assert_eq!(at(4.5, 3.0), Some("robot"), "it lies over the box");
        assert_eq!(at(7.0, 9.2), Some("wall"), "two pixels off");
        assert_eq!(at(7.0, 8.6), None);
        assert_eq!(at(8.0, 3.0), None);
    }
}
