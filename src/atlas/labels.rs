//! Names on a world: labels that overlap neither one another nor what they name.

use crate::collision::{Collision, Scene};
use crate::geometry::{Footprint, Point2, Pose2, Vector2};
use crate::num::{self, greater, lesser};
use crate::picture::{Anchor, Drawing, Face, Item, Line, Role};
use crate::worlds::{Bounds, World};

/// Height of the letters, pixels.
const SIZE: f64 = 11.0;

/// A named thing of a world, and the point its name belongs to.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// The list it stands in: `walls`, `obstacles`, `places`, `marks`, `robots`.
    pub list: &'static str,
    /// Its name.
    pub name: String,
    /// A point of it, metres.
    pub at: Point2,
}

/// Every named thing of a world in file order. A robot is at its start where its kind has a place, else left out.
pub fn named(world: &World) -> Vec<Named> {
    let mut out = Vec::new();
    for obstacle in &world.obstacles {
        let list = match obstacle.kind {
            crate::worlds::ObstacleKind::Wall => "walls",
            crate::worlds::ObstacleKind::Solid => "obstacles",
        };
        // the middle of its longest piece
        let pieces = obstacle.placed().map(|p| (middle(&p), reach(&p)));
        if let Some((at, _)) = pieces.reduce(|a, b| if b.1 > a.1 { b } else { a }) {
            out.push(Named { list, name: obstacle.name.clone(), at });
        }
    }
    out.extend(world.places.iter().map(|p| Named { list: "places", name: p.name.clone(), at: p.pose.position() }));
    for mark in &world.marks {
        if let Some(pair) = mark.points.windows(2).next() {
            let at = pair[0] + (pair[1] - pair[0]) * 0.5;
            out.push(Named { list: "marks", name: mark.name.clone(), at });
        }
    }
    for robot in &world.robots {
        if let ("rusty" | "hitch", [x, y, ..]) = (robot.kind.as_str(), &robot.start[..]) {
            out.push(Named { list: "robots", name: robot.name.clone(), at: Point2::new(*x, *y) });
        }
    }
    out
}

fn middle(placed: &crate::geometry::Placed) -> Point2 {
    let (lo, hi) = placed.bounds();
    lo + (hi - lo) * 0.5
}

fn reach(placed: &crate::geometry::Placed) -> f64 {
    let (lo, hi) = placed.bounds();
    num::hypot(hi.x - lo.x, hi.y - lo.y)
}

/// A label's box on the plane, metres: its middle and half its sides.
#[derive(Clone, Copy)]
struct Plate {
    middle: Point2,
    half: Vector2,
}

impl Plate {
    fn overlaps(&self, other: &Plate) -> bool {
        let d = self.middle - other.middle;
        d.x.abs() < self.half.x + other.half.x && d.y.abs() < self.half.y + other.half.y
    }

    fn inside(&self, bounds: &Bounds) -> bool {
        let (lo, hi) = (self.middle - self.half, self.middle + self.half);
        lo.x >= bounds.min.x && lo.y >= bounds.min.y && hi.x <= bounds.max.x && hi.y <= bounds.max.y
    }
}

/// The names of everything in a world as items for a picture at this scale, pixels per metre: each label beside its thing where it
/// covers no obstacle and no other label, with a line that leads to it. A name for which there is no such place within reach is
/// left out: it is shown when the picture is larger.
pub fn names(world: &World, px_per_metre: f64) -> Vec<Item> {
    let scene = Scene::of_world(world);
    let mut placed: Vec<Plate> = Vec::new();
    let dots: Vec<Point2> = world.places.iter().map(|p| p.pose.position()).collect();
    let mut items = Vec::new();
    for thing in named(world) {
        let half =
            Vector2::new(0.5 * (0.56 * SIZE * thing.name.chars().count() as f64 + 8.0), 0.5 * (1.3 * SIZE + 2.0));
        let half = half / px_per_metre;
        let Some(plate) = place_for(&thing, half, px_per_metre, world, &scene, &placed, &dots) else { continue };
        placed.push(plate);
        let end = nearest_of(&plate, thing.at);
        let id = format!("name/{}/{}", thing.list, thing.name);
        let leader = Drawing::segment(thing.at, end);
        items.push(Item::new(format!("{id}/leader"), &thing.name, Role::Muted, leader).stroked(Line::solid(0.75)));
        let label = Drawing::Label {
            at: plate.middle,
            text: thing.name.clone(),
            anchor: Anchor::Center,
            face: Face::Sans,
            size_px: SIZE,
            plate: true,
        };
        items.push(Item::new(id, thing.name, Role::Text, label));
    }
    // the lines below all the words
    items.sort_by_key(|item| matches!(item.drawing, Drawing::Label { .. }));
    items
}

/// The nearest place for a label that is good.
fn place_for(
    thing: &Named,
    half: Vector2,
    px_per_metre: f64,
    world: &World,
    scene: &Scene,
    placed: &[Plate],
    dots: &[Point2],
) -> Option<Plate> {
    for ring in 1..8 {
        let gap = 5.0 * f64::from(ring * ring) / px_per_metre;
        for k in 0..16 {
            // to the right first, then around
            let (s, c) = num::sin_cos(f64::from(k) * std::f64::consts::FRAC_PI_8);
            let away = Vector2::new(c * (half.x + gap), s * (half.y + gap));
            let plate = Plate { middle: thing.at + away, half };
            let lo = Point2::from(plate.middle.coords - half);
            let hi = Point2::from(plate.middle.coords + half);
            let covers_dot = dots.iter().any(|d| d.x > lo.x && d.x < hi.x && d.y > lo.y && d.y < hi.y);
            let area = Footprint::rects([(Pose2::IDENTITY, lo, hi)]);
            if plate.inside(&world.bounds)
                && !covers_dot
                && !placed.iter().any(|other| other.overlaps(&plate))
                && !scene.intersects(&area)
            {
                return Some(plate);
            }
        }
    }
    None
}

/// The point of a plate nearest to `p`: where a leader ends.
fn nearest_of(plate: &Plate, p: Point2) -> Point2 {
    let clamp = |x: f64, m: f64, h: f64| greater(m - h, lesser(m + h, x));
    Point2::new(clamp(p.x, plate.middle.x, plate.half.x), clamp(p.y, plate.middle.y, plate.half.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plates(items: &[Item], px_per_metre: f64) -> Vec<(String, Plate)> {
        let plates = items.iter().filter_map(|item| match &item.drawing {
            Drawing::Label { at, text, size_px, .. } => {
                let half =
                    Vector2::new(0.5 * 0.5 * size_px * text.chars().count() as f64, 0.5 * size_px) / px_per_metre;
                Some((text.clone(), Plate { middle: *at, half }))
            }
            _ => None,
        });
        plates.collect()
    }

    #[test]
    fn names_overlap_neither_one_another_nor_what_they_name() {
        for (world, most_missing) in [(World::apartment(), 5), (World::workbench(), 0), (World::lot(), 0)] {
            let scale = 560.0 / (world.bounds.max.y - world.bounds.min.y);
            let items = names(&world, scale);
            let plates = plates(&items, scale);
            let all = named(&world);
            assert!(plates.len() + most_missing >= all.len(), "{}: {} of {}", world.name, plates.len(), all.len());
            let scene = Scene::of_world(&world);
            for (i, (name, plate)) in plates.iter().enumerate() {
                let corners =
                    (Point2::from(plate.middle.coords - plate.half), Point2::from(plate.middle.coords + plate.half));
                assert!(!scene.intersects(&Footprint::rects([(Pose2::IDENTITY, corners.0, corners.1)])), "{name}");
                for (other, p) in &plates[..i] {
                    assert!(!plate.overlaps(p), "{name} and {other}");
                }
            }
        }
    }

    #[test]
    fn every_named_thing_is_found() {
        let world = World::lot();
        let all = named(&world);
        let count = world.obstacles.len() + world.places.len() + world.marks.len() + world.robots.len();
        assert_eq!(all.len(), count);
        assert!(all.iter().all(|n| n.at.x.is_finite()));
    }
}
