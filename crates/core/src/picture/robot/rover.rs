//! The marks on a rover: its wheels, which turn, and its nose.

use super::Gait;
use super::frame::{placed, rectangle};
use crate::geometry::{Point2, Pose2};
use crate::num;
use crate::picture::{Drawing, Fill, Item, Line, Role};
use crate::robots::Rusty;

/// Half a wheel's width, in radii of the rover.
const HALF_WIDTH: f64 = 0.13;

/// Number of lugs around a wheel.
const LUGS: f64 = 6.0;

/// The wheels of a rover at `pose`, which have rolled as `gait` says.
pub fn wheels(id: &str, name: &str, rover: &Rusty, pose: &Pose2, gait: &Gait) -> Vec<Item> {
    let radius = rover.body_radius;
    let (half_track, half_width) = (0.5 * rover.track, HALF_WIDTH * radius);
    // a wheel's corners stay within the disc, which is all that counts
    let reach = num::lesser(half_track + half_width, 0.95 * radius);
    let room = (0.96 * radius * radius - reach * reach).sqrt();
    let half_length = num::lesser(rover.wheel_radius, room);
    let sides = [("left", 1.0), ("right", -1.0)].into_iter().zip(gait.rolled);
    let wheel = |((side, sign), rolled): ((&'static str, f64), f64)| {
        let at = pose.transform(Point2::new(0.0, sign * (reach - half_width)));
        let at = Pose2 { x: at.x, y: at.y, theta: pose.theta };
        let tyre = Item::new(format!("{id}/{side} wheel"), name, Role::Text, rectangle(&at, [half_length, half_width]));
        let lugs = lugs(rolled).map(move |(k, along)| {
            let along = half_length * along;
            let lug = Drawing::Polyline(placed(&at, &[(along, -half_width), (along, half_width)]));
            Item::new(format!("{id}/{side} lug {k}"), name, Role::Paper, lug).stroked(Line::solid(1.0))
        });
        [tyre.filled(Fill::Tint(0.85))].into_iter().chain(lugs)
    };
    sides.flat_map(wheel).collect()
}

/// The lugs on the upper half of a wheel that has rolled by `rolled` radians: their numbers, and where they are seen
/// from above along the wheel, from -1 to 1.
fn lugs(rolled: f64) -> impl Iterator<Item = (u32, f64)> {
    let lug = move |k: u32| {
        let (s, c) = num::sin_cos(rolled + std::f64::consts::TAU * f64::from(k) / LUGS);
        (c > 0.0).then_some((k, s))
    };
    (0..LUGS as u32).filter_map(lug)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_6;

    use super::*;
    use crate::geometry::Footprint;
    use crate::robots::RUSTY;

    fn seen(rolled: f64) -> Vec<i32> {
        let mut along: Vec<i32> = lugs(rolled).map(|(_, along)| (1e6 * along).round() as i32).collect();
        along.sort_unstable();
        along
    }

    #[test]
    fn lugs_go_forward_with_a_wheel_that_rolls_forward() {
        // six lugs a sixth of a turn apart: from above, the sines of -60, 0 and 60 degrees
        assert_eq!(seen(0.0), [-866_025, 0, 866_025]);
        // a twelfth of a turn on: those of -30, 30 and 90
        assert_eq!(seen(FRAC_PI_6)[..2], [-500_000, 500_000]);
        assert_eq!(seen(0.1), seen(0.1 + 2.0 * FRAC_PI_6), "a sixth of a turn shows the same");
        let ahead = |rolled| lugs(rolled).find(|(k, _)| *k == 0).unwrap().1;
        assert!(ahead(0.1) > ahead(0.0), "above the axle a wheel moves the way it rolls");
    }

    #[test]
    fn wheels_stay_within_the_disc_and_stand_on_their_sides() {
        let pose = Pose2::new(1.0, 2.0, 0.7);
        let disc = Footprint::disc(pose.position(), RUSTY.body_radius);
        for rover in [RUSTY, Rusty { track: 0.3, wheel_radius: 0.2, ..RUSTY }] {
            let items = wheels("w", "w", &rover, &pose, &Gait { rolled: [0.3, -2.0], steering: 0.0 });
            let mut corners = 0;
            for item in &items {
                let (Drawing::Polygon(points) | Drawing::Polyline(points)) = &item.drawing else { panic!("a wheel") };
                let left = item.id.contains("left");
                for p in points {
                    let own = pose.inverse().transform(*p);
                    assert!((own.y > 0.0) == left, "{} at {own}", item.id);
                    assert!((*p - disc.parts()[0].pose().position()).norm() < RUSTY.body_radius, "{}", item.id);
                    corners += 1;
                }
            }
            assert!(corners >= 2 * (4 + 2 * 2), "{corners}");
        }
    }
}
