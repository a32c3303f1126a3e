//! Names on a world: labels that overlap neither one another nor what they name.

use super::Atlas;
use crate::collision::{Collision, Scene};
use crate::geometry::{Footprint, Part, Placed, Point2, Pose2, Segment, Shape, Vector2};
use crate::num::{self, greater, lesser};
use crate::picture::{Anchor, Drawing, Face, Item, Line, Role};
use crate::robots::Robot;
use crate::worlds::{Bounds, ObstacleKind, World};

/// Height of the letters, pixels.
const SIZE: f64 = 11.0;

/// A named thing of a world, and the points that its name can belong to.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// The list it stands in: `walls`, `obstacles`, `places`, `marks`, `robots`.
    pub list: &'static str,
    /// Its name.
    pub name: String,
    /// Points of it, the best first: a wall's are along its pieces, the longest first. Never none.
    pub at: Vec<Point2>,
}

/// Every named thing of a world in file order. A robot is at its start, an arm at none: it is left out.
pub fn named(world: &World) -> Vec<Named> {
    let mut out = Vec::new();
    let mut add = |list, name: &str, at: Vec<Point2>| {
        if !at.is_empty() {
            out.push(Named { list, name: name.to_owned(), at });
        }
    };
    for obstacle in &world.obstacles {
        if obstacle.kind == ObstacleKind::Wall {
            let mut pieces: Vec<Placed> = obstacle.placed().collect();
            pieces.sort_by(|a, b| size(b).total_cmp(&size(a)));
            let along = pieces.iter().filter_map(|p| Some((*p.core().first()?, *p.core().last()?)));
            add("walls", &obstacle.name, along.flat_map(|(a, b)| [0.5, 0.25, 0.75].map(|s| a + (b - a) * s)).collect());
        } else {
            let largest = obstacle.placed().reduce(|a, b| if size(&b) > size(&a) { b } else { a });
            add("obstacles", &obstacle.name, largest.iter().map(middle).collect());
        }
    }
    for place in &world.places {
        add("places", &place.name, vec![place.pose.position()]);
    }
    for mark in &world.marks {
        let middles = mark.points.windows(2).flat_map(|w| [0.5, 0.25, 0.75].map(|s| w[0] + (w[1] - w[0]) * s));
        add("marks", &mark.name, middles.collect());
    }
    for robot in &world.robots {
        if let ("rusty" | "hitch", [x, y, ..]) = (robot.kind.as_str(), &robot.start[..]) {
            add("robots", &robot.name, vec![Point2::new(*x, *y)]);
        }
    }
    out
}

fn middle(placed: &Placed) -> Point2 {
    let (lo, hi) = placed.bounds();
    lo + (hi - lo) * 0.5
}

fn size(placed: &Placed) -> f64 {
    let (lo, hi) = placed.bounds();
    num::hypot(hi.x - lo.x, hi.y - lo.y)
}

/// A label's box on the plane, metres: its middle and half its sides.
#[derive(Clone, Copy, Debug)]
struct Plate {
    middle: Point2,
    half: Vector2,
}

impl Plate {
    fn overlaps(&self, other: &Plate) -> bool {
        let d = self.middle - other.middle;
        d.x.abs() < self.half.x + other.half.x && d.y.abs() < self.half.y + other.half.y
    }

    fn covers(&self, p: Point2) -> bool {
        let d = p - self.middle;
        d.x.abs() < self.half.x && d.y.abs() < self.half.y
    }

    fn inside(&self, bounds: &Bounds) -> bool {
        let (lo, hi) = (self.middle - self.half, self.middle + self.half);
        lo.x >= bounds.min.x && lo.y >= bounds.min.y && hi.x <= bounds.max.x && hi.y <= bounds.max.y
    }

    fn area(&self) -> Footprint {
        let (lo, hi) = (self.middle.coords - self.half, self.middle.coords + self.half);
        Footprint::rects([(Pose2::IDENTITY, Point2::from(lo), Point2::from(hi))])
    }

    /// The point of it that is nearest to `p`: where a leader ends.
    fn nearest_to(&self, p: Point2) -> Point2 {
        let clamp = |x: f64, m: f64, h: f64| greater(m - h, lesser(m + h, x));
        Point2::new(clamp(p.x, self.middle.x, self.half.x), clamp(p.y, self.middle.y, self.half.y))
    }
}

/// What labels must keep off: what collides, robots' footprints, painted marks, dots of places, and one another.
struct Sheet {
    bounds: Bounds,
    solid: Scene,
    marks: Scene,
    dots: Vec<Point2>,
    plates: Vec<Plate>,
}

impl Sheet {
    fn of(atlas: &Atlas) -> Self {
        let world = atlas.world();
        let standing = atlas.robots().iter().fold(Scene::of_world(world), |scene, r| {
            super::teleport::with_robot(scene, &r.name, &r.robot.footprint(&r.q))
        });
        let segments = world.marks.iter().flat_map(|m| m.points.windows(2).map(|w| Segment::new(w[0], w[1])));
        Sheet {
            bounds: world.bounds,
            solid: standing,
            marks: Scene::of_walls(&segments.collect::<Vec<_>>()),
            dots: world.places.iter().map(|p| p.pose.position()).collect(),
            plates: Vec::new(),
        }
    }

    fn is_free(&self, plate: &Plate, over_marks: bool) -> bool {
        plate.inside(&self.bounds)
            && !self.dots.iter().any(|d| plate.covers(*d))
            && !self.plates.iter().any(|other| other.overlaps(plate))
            && !self.solid.intersects(&plate.area())
            && (over_marks || !self.marks.intersects(&plate.area()))
    }

    /// Whether a line may lead from a plate to a point of the thing of this name: past no other thing and no other label.
    fn may_lead(&self, name: &str, from: Point2, to: Point2) -> bool {
        let line = Footprint::new([Part::new(Pose2::IDENTITY, Shape::Segment { a: from, b: to })]);
        let past = |id| self.solid.obstacle_name(id).is_some_and(|other| other != name);
        // its own end may touch what stands there
        let end = Footprint::disc(to, 0.0);
        let at_end = self.solid.touched(&end);
        !self.solid.touched(&line).into_iter().any(|id| past(id) && !at_end.contains(&id))
            && (0..=16).all(|k| {
                let p = from + (to - from) * (f64::from(k) / 16.0);
                !self.plates.iter().any(|plate| plate.covers(p))
            })
    }

    /// The nearest place for a label of this size that is good, and where its leader goes.
    fn place_for(&self, thing: &Named, half: Vector2, px_per_metre: f64) -> Option<(Plate, Point2)> {
        for over_marks in [false, true] {
            for gap in [4.0, 8.0, 13.0, 20.0, 30.0, 42.0, 56.0].map(|px| px / px_per_metre) {
                for &at in &thing.at {
                    for k in 0..16 {
                        // to the right first, then around
                        let (s, c) = num::sin_cos(f64::from(k) * std::f64::consts::FRAC_PI_8);
                        // from an obstacle's middle the way out of it comes first
                        let out = self.way_out(&thing.name, at, Vector2::new(c, s));
                        let away = Vector2::new(c * (half.x + gap), s * (half.y + gap)) + out;
                        let plate = Plate { middle: at + away, half };
                        let end = plate.nearest_to(at);
                        if self.is_free(&plate, over_marks) && self.may_lead(&thing.name, end, at) {
                            return Some((plate, at));
                        }
                    }
                }
            }
        }
        None
    }

    /// How far it is from a point inside a thing to its border this way; nothing from a wall.
    fn way_out(&self, name: &str, at: Point2, way: Vector2) -> Vector2 {
        let inside = |p: Point2| {
            let touched = self.solid.touched(&Footprint::disc(p, 0.0));
            touched.into_iter().any(|id| self.solid.obstacle_name(id) == Some(name))
        };
        let step = 0.02 * lesser(self.bounds.max.x - self.bounds.min.x, self.bounds.max.y - self.bounds.min.y);
        let steps = (0..25).take_while(|k| inside(at + way * (f64::from(*k) * step))).count();
        way * (step * (steps as f64 - 1.0).clamp(0.0, 25.0))
    }
}

/// The names of everything in the world as items for a picture at this scale, pixels per metre: each label beside its thing where
/// it covers no obstacle, no robot and no other label, with a line that leads to it past nothing else. A name for which there is no
/// such place near by is left out: it is shown when the picture is larger.
pub fn names(atlas: &Atlas, px_per_metre: f64) -> Vec<Item> {
    let mut sheet = Sheet::of(atlas);
    let mut items = Vec::new();
    let mut things = named(atlas.world());
    // what has the fewest places for its name comes first
    things.sort_by_key(|thing| thing.at.len());
    for thing in things {
        let width = 0.56 * SIZE * thing.name.chars().count() as f64 + 8.0;
        let half = Vector2::new(0.5 * width, 0.5 * (1.3 * SIZE + 5.0)) / px_per_metre;
        let Some((plate, at)) = sheet.place_for(&thing, half, px_per_metre) else { continue };
        sheet.plates.push(plate);
        let id = format!("name/{}/{}", thing.list, thing.name);
        let leader = Drawing::segment(at, plate.nearest_to(at));
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
            let items = names(&Atlas::new(world.clone()), scale);
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
        assert!(all.iter().all(|n| !n.at.is_empty() && n.at.iter().all(|p| p.x.is_finite())));
    }
}
