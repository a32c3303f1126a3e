//! The marks on a car and its trailer: corners rounded, windscreen, wheels, drawbar.

use super::Gait;
use super::frame::{placed, rectangle, rounded};
use crate::geometry::{Aabb, Footprint, Point2, Pose2, Shape};
use crate::picture::{Drawing, Fill, Item, Line, Role};
use crate::robots::Hitch;

/// Radius of the drawn corners, in widths.
const CORNER: f64 = 0.2;

/// Half the length and half the width of a wheel, in widths of its body.
const WHEEL: [f64; 2] = [0.17, 0.06];

/// A car in its footprint: the body, and with a trailer its box, with rounded corners that count for nothing.
pub fn bodies(id: &str, name: &str, footprint: &Footprint, role: Role) -> Vec<Item> {
    let parts = footprint.parts().iter().enumerate();
    let body = |(i, part): (usize, &crate::geometry::Part)| {
        let Shape::Rectangle { min, max } = part.shape() else { return None };
        let drawn = rounded(part.pose(), *min, *max, CORNER * (max.y - min.y));
        Some(Item::new(format!("{id}/body {i}"), name, role, drawn).filled(Fill::Tint(0.85)))
    };
    parts.filter_map(body).collect()
}

/// What is seen on a car and its trailer: windscreen and wheels, the front ones at the steering angle, and the drawbar.
pub fn marks(id: &str, name: &str, car: &Hitch, footprint: &Footprint, role: Role, gait: &Gait) -> Vec<Item> {
    let mut items = Vec::new();
    let mut parts = footprint.parts().iter();
    if let Some(body) = parts.next() {
        let (pose, Aabb { min, max }) = (body.pose(), car.body.rectangle());
        let wheel = Wheels { pose, width: car.body.width };
        items.extend(wheel.pair(id, name, "rear wheel", 0.0, 0.0));
        items.extend(wheel.pair(id, name, "front wheel", car.wheelbase, gait.steering));
        let along = |share: f64| min.x + share * (max.x - min.x);
        let half = 0.5 * car.body.width;
        let glass = [(0.6, -0.6), (0.72, -0.75), (0.72, 0.75), (0.6, 0.6)].map(|(x, y)| (along(x), y * half));
        let glass = Drawing::Polygon(placed(pose, &glass));
        items.push(Item::new(format!("{id}/windscreen"), name, Role::Paper, glass).filled(Fill::Tint(0.8)));
    }
    if let (Some(trailer), Some(hitch_len)) = (parts.next(), car.with_trailer().hitch_len) {
        let front = car.trailer_body.rectangle(hitch_len).max.x;
        let drawbar = Drawing::Polyline(placed(trailer.pose(), &[(0.0, 0.0), (front, 0.0)]));
        items.insert(0, Item::new(format!("{id}/drawbar"), name, role, drawbar).stroked(Line::solid(2.5)));
        let wheels = Wheels { pose: trailer.pose(), width: car.trailer_body.width };
        items.extend(wheels.pair(id, name, "trailer wheel", -hitch_len, 0.0));
    }
    items
}

/// A body that has wheels.
struct Wheels<'a> {
    pose: &'a Pose2,
    width: f64,
}

impl Wheels<'_> {
    /// The two wheels of the axle at `x` in the body's frame, turned by `steering`. Straight ahead they are flush with
    /// the body's sides.
    fn pair(&self, id: &str, name: &str, kind: &str, x: f64, steering: f64) -> [Item; 2] {
        let [along, across] = WHEEL.map(|share| share * self.width);
        let y = 0.5 * self.width - across;
        [("left", y), ("right", -y)].map(|(side, y)| {
            let at = self.pose.transform(Point2::new(x, y));
            let at = Pose2::new(at.x, at.y, self.pose.theta + steering);
            Item::new(format!("{id}/{side} {kind}"), name, Role::Text, rectangle(&at, [along, across]))
                .filled(Fill::Tint(0.85))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::configuration::HitchCfg;
    use crate::num;
    use crate::robots::{HITCH, Robot};

    fn centre(item: &Item) -> Point2 {
        let Drawing::Polygon(p) = &item.drawing else { panic!("a wheel") };
        p[0] + (p[2] - p[0]) * 0.5
    }

    fn find<'a>(items: &'a [Item], id: &str) -> &'a Item {
        items.iter().find(|item| item.id == id).unwrap_or_else(|| panic!("{id}"))
    }

    #[test]
    fn wheels_stand_on_the_axles_and_the_front_ones_point_where_the_car_steers() {
        let car = HITCH.with_trailer();
        let footprint = car.footprint(&HitchCfg { body: Pose2::IDENTITY, trailer: Some(0.0) });
        let gait = Gait { rolled: [0.0; 2], steering: 0.4 };
        let items = marks("h", "h", &car, &footprint, Role::Robot, &gait);
        // HITCH: wheelbase 2.5 m, width 1.7 m; its trailer's axle two metres behind, 1.5 m wide
        for (id, x, half) in
            [("h/left rear wheel", 0.0, 0.85), ("h/left front wheel", 2.5, 0.85), ("h/left trailer wheel", -2.0, 0.75)]
        {
            let at = centre(find(&items, id));
            assert!((at.x - x).abs() < 1e-12 && (0.8 * half..half).contains(&at.y), "{id}: {at}");
        }
        for (id, steering) in [("h/right rear wheel", 0.0), ("h/right front wheel", 0.4)] {
            let Drawing::Polygon(p) = &find(&items, id).drawing else { panic!("a wheel") };
            let along = p[0] - p[1];
            assert!((num::atan2(along.y, along.x) - steering).abs() < 1e-12, "{id}");
        }
        // the windscreen is ahead of the middle, and the bar ends at the box, one metre ahead of its axle
        assert!(centre(find(&items, "h/windscreen")).x > 1.25);
        let Drawing::Polyline(bar) = &find(&items, "h/drawbar").drawing else { panic!("a line") };
        assert_eq!(bar[..], [Point2::origin(), Point2::new(-1.0, 0.0)]);
    }

    #[test]
    fn rounded_bodies_lie_within_what_counts() {
        let car = HITCH.with_trailer();
        let pose = Pose2::new(3.0, 1.0, 0.6);
        let footprint = car.footprint(&HitchCfg { body: pose, trailer: Some(0.2) });
        let bodies = bodies("h", "h", &footprint, Role::Goal);
        assert_eq!(bodies.len(), 2);
        for (item, part) in bodies.iter().zip(footprint.parts()) {
            assert_eq!(item.role, Role::Goal);
            let Drawing::Polygon(points) = &item.drawing else { panic!("a body") };
            let Shape::Rectangle { min, max } = part.shape() else { panic!("a rectangle") };
            let own: Vec<Point2> = points.iter().map(|p| part.pose().inverse().transform(*p)).collect();
            let within = |p: &Point2| {
                (min.x - 1e-9..=max.x + 1e-9).contains(&p.x) && (min.y - 1e-9..=max.y + 1e-9).contains(&p.y)
            };
            assert!(own.iter().all(within));
            // all four sides are reached, no corner is
            assert!(own.iter().any(|p| p.x > max.x - 1e-6) && own.iter().any(|p| p.y < min.y + 1e-6));
            assert!(own.iter().all(|p| num::hypot(p.x - max.x, p.y - max.y) > 0.05));
        }
    }
}
