//! Names on a world: labels that overlap neither one another nor the things they name.

use super::Atlas;
use super::taken::OccupiedAreas;
use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::configuration::{Kinds, RobotKind};
use motion_lab_core::geometry::{Aabb, Footprint, Part, Placed, Point2, Pose2, Segment, Shape, Vector2};
use motion_lab_core::num::{self, greater, lesser};
use motion_lab_core::picture::{Anchor, Drawing, Face, Item, Line, Role};
use motion_lab_core::worlds::{ObstacleKind, World};

/// Height of the letters, pixels.
const SIZE: f64 = 11.0;

/// Length of the arrow at a place, pixels.
const ARROW: f64 = 9.0;

/// Largest length of a leader inside its thing, pixels.
const INNER: f64 = 8.0;

/// Distances between a label and its thing, pixels. The nearest with room is used.
const GAPS: [f64; 7] = [3.0, 7.0, 12.0, 18.0, 26.0, 36.0, 48.0];

/// Number of directions in which a label is tried.
const WAYS: u32 = 24;

/// Largest number of things without a place in a layout; those after it are not tried.
const MAX_LEFT_OUT: usize = 200;

/// Largest number of layouts. Each new one puts the first name without a place at the front.
const ROUNDS: usize = 4;

/// A named thing of a world, and the points to which its label can lead.
#[derive(Clone, Debug, PartialEq)]
pub struct LabelledThing {
    /// The list of the world that holds it: `walls`, `obstacles`, `places`, `marks`, `robots`.
    pub list: &'static str,
    /// Its name.
    pub name: String,
    /// Points of it, the best first; a wall's lie along its pieces, the longest first. Never empty.
    pub at: Vec<Point2>,
}

/// Every named thing of a world in file order. Robots of the lab's kinds that drive are at their starts; other robots
/// are left out.
pub fn named(world: &World) -> Vec<LabelledThing> {
    named_with(world, &Kinds::default())
}

/// [`named`] with the robots of further kinds whose first two coordinates are a place.
pub fn named_with(world: &World, kinds: &Kinds) -> Vec<LabelledThing> {
    let mut out = Vec::new();
    let mut add = |list, name: &str, at: Vec<Point2>| {
        if !at.is_empty() {
            out.push(LabelledThing { list, name: name.to_owned(), at });
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
    for door in &world.doors {
        add("doors", &door.name, [0.5, 0.25, 0.75].map(|s| door.a + (door.b - door.a) * s).to_vec());
    }
    for place in &world.places {
        add("places", &place.name, vec![place.pose.position()]);
    }
    for mark in &world.marks {
        let middles = mark.points.windows(2).flat_map(|w| [0.5, 0.25, 0.75].map(|s| w[0] + (w[1] - w[0]) * s));
        add("marks", &mark.name, middles.collect());
    }
    for robot in &world.robots {
        if let (true, [x, y, ..]) = (kinds.of(&robot.kind).is_some_and(RobotKind::has_place), &robot.start[..]) {
            add("robots", &robot.name, vec![Point2::new(*x, *y)]);
        }
    }
    out
}

fn middle(placed: &Placed) -> Point2 {
    placed.bounds().centre()
}

fn size(placed: &Placed) -> f64 {
    let Aabb { min, max } = placed.bounds();
    num::hypot(max.x - min.x, max.y - min.y)
}

/// A label's box on the plane, metres: its middle and half its sides.
#[derive(Clone, Copy, Debug)]
struct Plate {
    middle: Point2,
    half: Vector2,
}

impl Plate {
    fn covers(&self, p: Point2) -> bool {
        let d = p - self.middle;
        d.x.abs() < self.half.x && d.y.abs() < self.half.y
    }

    fn inside(&self, bounds: &Aabb) -> bool {
        let (lo, hi) = (self.middle - self.half, self.middle + self.half);
        lo.x >= bounds.min.x && lo.y >= bounds.min.y && hi.x <= bounds.max.x && hi.y <= bounds.max.y
    }

    fn area(&self) -> Footprint {
        let (lo, hi) = (self.middle.coords - self.half, self.middle.coords + self.half);
        Footprint::rects([(Pose2::IDENTITY, Point2::from(lo), Point2::from(hi))])
    }

    /// The plate's nearest point to `p`, at which a leader ends.
    fn nearest_to(&self, p: Point2) -> Point2 {
        let clamp = |x: f64, m: f64, h: f64| greater(m - h, lesser(m + h, x));
        Point2::new(clamp(p.x, self.middle.x, self.half.x), clamp(p.y, self.middle.y, self.half.y))
    }
}

/// Everything that labels keep off: obstacles, robots' footprints, painted marks, the dots and arrows of places, and
/// other labels.
struct LabelObstacles {
    bounds: Aabb,
    px: f64,
    solid: Scene,
    marks: Scene,
    dots: Vec<Point2>,
    /// The labels placed so far, with their leaders.
    taken: OccupiedAreas,
}

/// A place for a label: its plate, and the leader to its thing.
struct LabelSpot {
    plate: Plate,
    leader: Segment,
}

impl LabelObstacles {
    /// The sheet without labels; a pixel of it is `px` metres.
    fn of(atlas: &Atlas, px: f64) -> Self {
        let world = atlas.world();
        let segments = world.marks.iter().flat_map(|m| m.points.windows(2).map(|w| Segment::new(w[0], w[1])));
        let dots = world.places.iter().flat_map(|p| {
            let (s, c) = num::sin_cos(p.pose.theta);
            [0.0, 0.5, 1.0].map(|part| p.pose.position() + Vector2::new(c, s) * (part * ARROW * px))
        });
        LabelObstacles {
            bounds: world.bounds,
            px,
            solid: super::teleport::crowd(world, atlas.standing()),
            marks: Scene::of_walls(&segments.collect::<Vec<_>>()),
            dots: dots.collect(),
            taken: OccupiedAreas::default(),
        }
    }

    fn is_free(&self, plate: &Plate) -> bool {
        // dots and arrowheads have a size
        let wide = Plate { half: plate.half + Vector2::new(3.0, 3.0) * self.px, ..*plate };
        plate.inside(&self.bounds)
            && !self.dots.iter().any(|d| wide.covers(*d))
            && !self.solid.intersects(&plate.area())
            && !self.marks.intersects(&plate.area())
            && !self.taken.intersects(&plate.area())
    }

    /// Whether a leader may go from a thing of this name to a plate. It may cross no other thing, label or leader, and
    /// marks only with `over_marks`.
    fn may_lead(&self, name: &str, leader: &Segment, over_marks: bool) -> bool {
        let line = |s: &Segment| Footprint::new([Part::new(Pose2::IDENTITY, Shape::Segment { a: s.a, b: s.b })]);
        // a mark may end where the leader begins
        let outer = Segment::new(leader.a + (leader.b - leader.a) * 0.25, leader.b);
        // the leader's end may touch the thing that stands there
        let at_end = self.solid.touched(&Footprint::disc(leader.a, 0.0));
        let past = |id| self.solid.obstacle_name(id).is_some_and(|other| other != name);
        !self.solid.touched(&line(leader)).into_iter().any(|id| past(id) && !at_end.contains(&id))
            && !self.taken.intersects(&line(leader))
            && (over_marks || !self.marks.intersects(&line(&outer)))
    }

    /// Marks a place as taken.
    fn take(&mut self, LabelSpot { plate, leader }: &LabelSpot) {
        let (min, max) =
            (Point2::from(plate.middle.coords - plate.half), Point2::from(plate.middle.coords + plate.half));
        let line = Shape::Segment { a: leader.a, b: leader.b };
        self.taken.add(vec![Shape::Rectangle { min, max }, line]);
    }

    /// The nearest free place for a label of this size, half its sides given.
    fn place_for(&self, thing: &LabelledThing, half: Vector2) -> Option<LabelSpot> {
        for over_marks in [false, true] {
            for gap in GAPS {
                for &at in &thing.at {
                    // to the right first, then around
                    let ways =
                        (0..WAYS).map(|k| num::sin_cos(f64::from(k) * (std::f64::consts::TAU / f64::from(WAYS))));
                    let mut spots = ways.map(|(s, c)| self.spot(&thing.name, at, Vector2::new(c, s), half, gap));
                    let good = |spot: &LabelSpot| {
                        self.is_free(&spot.plate) && self.may_lead(&thing.name, &spot.leader, over_marks)
                    };
                    if let Some(spot) = spots.find(good) {
                        return Some(spot);
                    }
                }
            }
        }
        None
    }

    /// The spot whose plate lies `gap` pixels beyond the thing's border, in the direction `way` from `at`.
    fn spot(&self, name: &str, at: Point2, way: Vector2, half: Vector2, gap: f64) -> LabelSpot {
        let border = at + way * self.way_out(name, at, way);
        // how far the plate reaches back from its middle
        let reach = lesser(half.x / greater(way.x.abs(), 1e-9), half.y / greater(way.y.abs(), 1e-9));
        let plate = Plate { middle: border + way * (gap * self.px + reach), half };
        // the leader to a large thing ends within it
        let inner = border - way * lesser((border - at).norm(), INNER * self.px);
        // words are narrower than the room kept for them: at its edge a leader would end short of them
        let words = Plate { half: Vector2::new(0.75 * (half.x - 4.0 * self.px), 0.5 * half.y), ..plate };
        LabelSpot { plate, leader: Segment::new(inner, words.nearest_to(border)) }
    }

    /// The distance from a point inside a thing to its border in the direction `way`, metres; 0 for a wall or a mark.
    fn way_out(&self, name: &str, at: Point2, way: Vector2) -> f64 {
        let inside = |p: Point2| {
            let touched = self.solid.touched(&Footprint::disc(p, 0.0));
            touched.into_iter().any(|id| self.solid.obstacle_name(id) == Some(name))
        };
        if !inside(at + way * self.px) {
            return 0.0;
        }
        // the distance is doubled until the point is outside, then bisected
        let (mut within, mut beyond) = (self.px, 2.0 * self.px);
        while inside(at + way * beyond) && beyond < 1e6 * self.px {
            (within, beyond) = (beyond, 2.0 * beyond);
        }
        while beyond - within > 0.5 * self.px {
            let middle = 0.5 * (within + beyond);
            if inside(at + way * middle) { within = middle } else { beyond = middle }
        }
        beyond
    }
}

/// Places for the names of these things, the first with the first choice, and the number of the first thing without a
/// place.
fn lay_out(mut sheet: LabelObstacles, things: &[LabelledThing]) -> (Vec<(LabelledThing, LabelSpot)>, Option<usize>) {
    let (mut spots, mut without) = (Vec::new(), Vec::new());
    for (number, thing) in things.iter().enumerate() {
        let width = 0.56 * SIZE * thing.name.chars().count() as f64 + 8.0;
        let half = Vector2::new(0.5 * width, 0.5 * (1.3 * SIZE + 5.0)) * sheet.px;
        match sheet.place_for(thing, half) {
            Some(spot) => {
                sheet.take(&spot);
                spots.push((thing.clone(), spot));
            }
            None if without.len() == MAX_LEFT_OUT => break,
            None => without.push(number),
        }
    }
    (spots, without.first().copied())
}

/// The value of a layout: 4 for each placed name of a robot or an obstacle, 2 for a place, 1 for a wall or a mark.
fn worth(spots: &[(LabelledThing, LabelSpot)]) -> usize {
    let of = |thing: &LabelledThing| match thing.list {
        "robots" | "obstacles" => 4,
        "places" => 2,
        _ => 1,
    };
    spots.iter().map(|(thing, _)| of(thing)).sum()
}

/// The names of everything in the world as items for a picture at this scale, pixels per metre. Each label stands
/// beside its thing, where it covers no obstacle, robot, mark or other label, and a leader joins the two. A name
/// without such a place nearby is left out; a larger picture has more room. After 200 names that are left out no
/// further one is tried. The order of choice is robots, obstacles,
/// places, walls, marks, each in file order.
pub fn names(atlas: &Atlas, px_per_metre: f64) -> Vec<Item> {
    let px = 1.0 / px_per_metre;
    let mut things = named_with(atlas.world(), atlas.kinds());
    let rank = |thing: &LabelledThing| {
        ["robots", "obstacles", "places", "walls", "marks"].iter().position(|l| *l == thing.list)
    };
    things.sort_by_key(rank);
    let mut best = Vec::new();
    for _ in 0..ROUNDS {
        let (spots, without) = lay_out(LabelObstacles::of(atlas, px), &things);
        if worth(&spots) > worth(&best) {
            best = spots;
        }
        // the first thing without a place has the first choice in the next round
        let Some(without) = without else { break };
        things[..=without].rotate_right(1);
    }
    let mut items = Vec::new();
    for (thing, LabelSpot { plate, leader }) in best {
        let id = format!("name/{}/{}", thing.list, thing.name);
        let line = Drawing::segment(leader.a, leader.b);
        items.push(Item::new(format!("{id}/leader"), &thing.name, Role::Muted, line).stroked(Line::solid(0.75)));
        let label = Drawing::Label {
            at: plate.middle,
            text: thing.name.clone(),
            anchor: Anchor::Centre,
            face: Face::Sans,
            size_px: SIZE,
            plate: true,
        };
        items.push(Item::new(id, thing.name, Role::Text, label));
    }
    // leaders are drawn below all words
    items.sort_by_key(|item| matches!(item.drawing, Drawing::Label { .. }));
    items
}

#[cfg(test)]
mod tests;
