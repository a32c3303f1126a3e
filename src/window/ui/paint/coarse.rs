//! What is left out of a still picture that is drawn small.

use motion_lab_core::geometry::{Aabb, Point2, Segment};
use motion_lab_core::num::greater;
use motion_lab_core::picture::{Dash, Drawing, Fill, Fit, Item};

/// Size on the screen below which a hatched area is tinted instead, without an edge, points.
const HATCHED: f64 = 14.0;

/// Scale below which dashed lines are solid and thin, points per metre: their dashes are as long whatever the scale.
const DASHED: f64 = 8.0;

/// How far such a line may stray from its own points on the screen, points.
const STRAYS: f64 = 0.3;

/// The item without what is too fine to be seen.
pub fn coarse(mut item: Item, fit: &Fit) -> Item {
    let scale = fit.px_per_metre();
    let size = |b: Aabb| greater(b.max.x - b.min.x, b.max.y - b.min.y) * scale;
    if item.fill == Fill::Hatch && item.drawing.bounds().is_some_and(|b| size(b) < HATCHED) {
        (item.fill, item.line) = (Fill::Tint(0.6), None);
    }
    if let Some(line) = item.line.as_mut().filter(|line| line.dash != Dash::Solid && scale < DASHED) {
        (line.dash, line.opacity) = (Dash::Solid, 0.5 * line.opacity);
        if let Drawing::Polyline(points) = &mut item.drawing {
            *points = simplified(points, STRAYS / scale);
        }
    }
    item
}

/// Some of a line's points, its ends among them, from whose line those left out are no farther than `strays`, metres.
fn simplified(points: &[Point2], strays: f64) -> Vec<Point2> {
    let mut kept: Vec<Point2> = points.first().copied().into_iter().collect();
    let mut last = 0;
    for (i, ends) in points.windows(2).enumerate().skip(1) {
        let line = Segment { a: points[last], b: ends[1] };
        if points[last + 1..=i].iter().any(|p| (line.closest_point(*p) - *p).norm() > strays) {
            kept.push(points[i]);
            last = i;
        }
    }
    kept.extend(points.last().filter(|_| points.len() > 1));
    kept
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use motion_lab_core::num::{cos, lesser, sin};
    use motion_lab_core::picture::{Line, Role, ScreenRect};

    #[test]
    fn what_is_too_fine_to_be_seen_is_left_out() {
        let p = Point2::new;
        let bounds = Aabb::new(p(0.0, 0.0), p(100.0, 100.0));
        let fit = |points| Fit::new(&bounds, ScreenRect { min: [0.0, 0.0], size: [points, points] }, 0.0);
        let square = Drawing::Polygon(vec![p(0.0, 0.0), p(2.0, 0.0), p(2.0, 2.0), p(0.0, 2.0)]);
        let rack = Item::new("a", "a", Role::Obstacle, square).filled(Fill::Hatch).stroked(Line::solid(1.5));
        // 2 m are 13.8 points, then 14
        let small = coarse(rack.clone(), &fit(690.0));
        assert_eq!((small.fill, small.line), (Fill::Tint(0.6), None));
        assert_eq!(coarse(rack.clone(), &fit(700.0)), rack);
        // a metre along the floor, a quarter of a circle, and a metre up, by points 0.1 m apart and less
        let along = (0..10).map(|i| p(0.1 * f64::from(i), 0.0));
        let turn = (0..=30).map(|i| FRAC_PI_2 * f64::from(i) / 30.0).map(|a| p(1.0 + sin(a), 1.0 - cos(a)));
        let points: Vec<Point2> = along.chain(turn).chain((1..=10).map(|i| p(2.0, 1.0 + 0.1 * f64::from(i)))).collect();
        let dashed = Line::solid(1.0).dashed(Dash::Dashed);
        let route = Item::new("b", "b", Role::Muted, Drawing::Polyline(points.clone())).stroked(dashed);
        // a metre is 5 points, so nothing strays farther than 0.06 m; a chord of a quarter circle's third does by 0.034
        let thin = coarse(route.clone(), &fit(500.0));
        let Drawing::Polyline(left) = &thin.drawing else { panic!("a line") };
        assert_eq!((left.first(), left.last()), (points.first(), points.last()));
        assert!(left.len() <= 6 && left.iter().all(|p| points.contains(p)), "{left:?}");
        let sides: Vec<Segment> = left.windows(2).map(|w| Segment { a: w[0], b: w[1] }).collect();
        for p in &points {
            let off = sides.iter().map(|side| (side.closest_point(*p) - *p).norm()).fold(f64::INFINITY, lesser);
            assert!(off <= 0.06, "{p} is {off} m off");
        }
        assert_eq!(thin.line.map(|l| (l.dash, l.opacity)), Some((Dash::Solid, 0.5)));
        assert_eq!(coarse(route.clone(), &fit(800.0)), route);
    }
}
