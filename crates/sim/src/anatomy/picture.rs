//! The anatomy as a picture: the world, the robot and the tab's answer.

use super::nearest::nearest_pairs;
use super::words::{figure, metres};
use super::{Anatomy, Feature, NearestPair, SweptMotion, Tab};
use motion_lab_core::collision::{Collision, EdgeVerdict, Scene};
use motion_lab_core::geometry::{Aabb, Footprint, Part, Point2, Pose2, Shape, Vector2};
use motion_lab_core::num::{self, lesser};
use motion_lab_core::picture::{
    Anchor, Dash, Drawing, Face, Fill, Gait, Glyph, Item, Line, Picture, RobotDrawing, Role, footprint, polygon_of,
    robot, trace, world,
};
use motion_lab_core::robots::Robot;

/// Distance of a name from its point, as a share of the picture: its plate keeps off the point's ring.
const BESIDE: f64 = 0.11;

/// Largest number of outlines of proven steps drawn.
const OUTLINES: usize = 48;

/// Number of equal intervals after the first contact; at their ends the footprints in contact are drawn.
const SAMPLES: u32 = 24;

impl Anatomy {
    /// The world and everything on it.
    pub fn picture(&self) -> Picture {
        self.backdrop().with(self.overlay().items)
    }

    /// The world alone, which changes only with the world.
    pub fn backdrop(&self) -> Picture {
        world(self.world())
    }

    /// Everything over the world: the robot, and the tab's answer.
    pub fn overlay(&self) -> Picture {
        self.overlay_in(self.world().bounds)
    }

    /// The overlay for a picture with these bounds: its words stand within them.
    pub(super) fn overlay_in(&self, bounds: Aabb) -> Picture {
        let mut items = Vec::new();
        if self.show_annulus {
            items.extend(annulus_items(self));
        }
        let footprint = self.footprint();
        let sweep = if self.tab == Tab::Swept { self.sweep().ok() } else { None };
        items.extend(sweep.iter().flat_map(|s| self.motion_items(s)));
        let (robot_model, q) = (self.checker().robot(), self.q());
        let touches = self.intersects();
        items.extend(robot(&RobotDrawing {
            name: robot_model.title(),
            footprint: &footprint,
            heading: robot_model.heading(&q),
            model: Some(*robot_model),
            gait: Gait::default(),
            in_contact: touches,
        }));
        let role = if touches { Role::Goal } else { Role::Robot };
        let handle = Drawing::Mark { at: robot_model.reference(&q), glyph: Glyph::Handle, radius_px: 5.0 };
        items.push(Item::new("handle/reference", "drag it", role, handle));
        match self.tab {
            Tab::Intersects => items.extend(self.nearest().first().filter(|p| p.witness.dist == 0.0).map(contact_item)),
            Tab::Distance | Tab::Witness => items.extend(self.nearest_items(&bounds)),
            Tab::Swept => {}
        }
        Picture::new(format!("{} in {}", self.tab.name(), self.world().name), bounds).with(items)
    }

    /// The nearest pairs; on the distance tab the witness alone.
    fn nearest_items(&self, bounds: &Aabb) -> Vec<Item> {
        let mut pairs = self.nearest();
        if self.tab == Tab::Distance {
            pairs.truncate(1);
        }
        let mut items = Vec::new();
        for (number, pair) in (1..).zip(&pairs) {
            if pair.witness.dist == 0.0 {
                items.push(contact_item(pair));
                continue;
            }
            items.extend(witness_items(number, pair, self.tab == Tab::Witness));
        }
        if let Some(pair) = pairs.first().filter(|p| p.witness.dist > 0.0) {
            let (a, b) = (pair.witness.on_robot, pair.witness.on_obstacle);
            let middle = a + (b - a) * 0.5;
            // the length hides neither the robot nor what it measures
            let line = |a, b| Footprint::new([Part::new(Pose2::IDENTITY, Shape::Segment { a, b })]);
            let off = [self.footprint(), line(a, b)];
            let plate = self.plate("witness/distance", bounds, middle, metres(pair.witness.dist), &off);
            let words = match plate[1].drawing {
                Drawing::Label { at, .. } => at,
                _ => middle,
            };
            items.extend(plate);
            // both names, where there is room for them
            if self.tab == Tab::Witness && pair.witness.dist > 0.1 * size_of(bounds) {
                // the names stand beside their points, off the robot, the obstacles, the segment and its length
                let wide = Vector2::new(0.16 * size_of(bounds), 0.0);
                let off = scene_of(bounds, &[self.footprint(), line(a, b), line(words - wide, words + wide)]);
                let beside = |p: Point2| {
                    let ways = (0..16).map(|k| num::sin_cos(f64::from(k) * std::f64::consts::FRAC_PI_8));
                    let places = ways.map(|(s, c)| p + Vector2::new(c, s) * (BESIDE * size_of(bounds)));
                    let room = |at: &Point2| {
                        let point = Footprint::disc(*at, 0.0);
                        lesser(self.checker().scene().distance(&point), off.distance(&point))
                    };
                    places.reduce(|best, at| if room(&at) > room(&best) + 1e-9 { at } else { best }).unwrap_or(p)
                };
                for (part, at, role) in [("a*", beside(a), Role::Robot), ("b*", beside(b), Role::Obstacle)] {
                    let (text, anchor, face) = (part.to_owned(), Anchor::Centre, Face::Sans);
                    let drawing = Drawing::Label { at, text, anchor, face, size_px: 14.0, plate: true };
                    items.push(Item::new(format!("witness/1/{part}"), part, role, drawing));
                }
            }
        }
        items
    }

    /// Words on a plate beside a point, where there is room, with a leader line.
    fn plate(&self, id: &str, bounds: &Aabb, at: Point2, text: String, off: &[Footprint]) -> [Item; 2] {
        let centre = roomy_place(self, bounds, at, off);
        let leader = Item::new(format!("{id}/leader"), &text, Role::Muted, Drawing::segment(at, centre))
            .stroked(Line::solid(0.75));
        let name = text.clone();
        let drawing =
            Drawing::Label { at: centre, text, anchor: Anchor::Centre, face: Face::Mono, size_px: 12.0, plate: true };
        [leader, Item::new(id, name, Role::Text, drawing)]
    }

    /// The motion of the swept tab: the proof's steps, the stretch in contact, and the end.
    fn motion_items(&self, sweep: &SweptMotion) -> Vec<Item> {
        let robot_model = self.checker().robot();
        let at = |s: f64| robot_model.footprint(&sweep.at(s));
        let ends: Vec<f64> = sweep.certificate.steps().iter().map(|step| step.to).collect();
        let every = ends.len().div_ceil(OUTLINES);
        // the words keep off these footprints
        let mut off = vec![at(0.0), at(1.0)];
        let mut items = Vec::new();
        for (number, s) in (1_usize..).zip(&ends) {
            if number.is_multiple_of(every) {
                let id = format!("step/{number}");
                items.push(outline_item(&id, "a proven step", &at(*s), Role::Free, Line::solid(0.75).at_opacity(0.8)));
            }
        }
        let end_role = if sweep.to_free { Role::Robot } else { Role::Goal };
        if let EdgeVerdict::Hit { contact_at, .. } = sweep.verdict {
            for k in 0..=SAMPLES {
                let s = contact_at + (1.0 - contact_at) * f64::from(k) / f64::from(SAMPLES);
                let ghost = at(s);
                if self.checker().scene().intersects(&ghost) {
                    let line = Line::solid(0.75).at_opacity(0.4);
                    items.push(outline_item(&format!("hit/later/{k}"), "in contact", &ghost, Role::Goal, line));
                }
            }
            let touching = at(contact_at);
            items.extend(footprint("hit", "the first contact", &touching, Role::Goal, 0.3));
            if let Some(w) = self.checker().scene().witness(&touching) {
                let words = format!("hits at s = {}", figure(contact_at, 4));
                off.push(touching);
                items.extend(self.plate("hit/words", &self.world().bounds, w.on_obstacle, words, &off));
            }
        }
        if let EdgeVerdict::Unresolved { free_until, .. } = sweep.verdict {
            let line = Line::solid(1.5).dashed(Dash::Dotted);
            items.push(outline_item("unresolved", "not known from here on", &at(free_until), Role::Unknown, line));
            let words = format!("not known from s = {}", figure(free_until, 4));
            let place = robot_model.reference(&sweep.at(free_until));
            off.push(at(free_until));
            items.extend(self.plate("unresolved/words", &self.world().bounds, place, words, &off));
        }
        let points: Vec<Point2> = (0..=64).map(|k| robot_model.reference(&sweep.at(f64::from(k) / 64.0))).collect();
        let way = trace("motion", "the way of the point that stands for the robot", &points);
        items.push(way.stroked(Line::solid(1.0).dashed(Dash::Dashed)));
        items.extend(footprint("second", "the second configuration", &at(1.0), end_role, 0.3));
        items
    }
}

/// The circles between which an arm's tip can be; empty for other robots.
pub(crate) fn annulus_items(anatomy: &Anatomy) -> Vec<Item> {
    let Some((base, radii)) = anatomy.checker().robot().annulus() else { return Vec::new() };
    let ring = |(name, radius): (&str, f64)| {
        let circle = Drawing::Disc { centre: base, radius };
        Item::new(format!("annulus/{name}"), format!("the {name} of the annulus"), Role::Muted, circle)
            .stroked(Line::solid(1.0).dashed(Dash::Dashed))
    };
    ["inner circle", "outer circle"].into_iter().zip(radii).filter(|(_, radius)| *radius > 0.0).map(ring).collect()
}

/// A cross at the point of contact.
fn contact_item(pair: &NearestPair) -> Item {
    let cross = Drawing::Mark { at: pair.witness.on_obstacle, glyph: Glyph::Cross, radius_px: 5.0 };
    Item::new("contact", "a point in common", Role::Goal, cross)
}

/// What is nearest to a footprint: each pair of nearest points with the segment between them, and the edge on which it
/// ends. Nothing where it touches, and where nothing is there.
pub fn nearest_items(scene: &Scene, footprint: &Footprint) -> Vec<Item> {
    let pairs = nearest_pairs(scene, footprint);
    let apart = (1..).zip(&pairs).filter(|(_, pair)| pair.witness.dist > 0.0);
    apart.flat_map(|(number, pair)| witness_items(number, pair, true)).collect()
}

/// The segment between two nearest points and its rings, each of the role of what it lies on; with `feature` also the
/// obstacle's edge on which it ends.
fn witness_items(number: usize, pair: &NearestPair, feature: bool) -> Vec<Item> {
    let w = &pair.witness;
    let item =
        |part: &str, name: &str, role, drawing| Item::new(format!("witness/{number}/{part}"), name, role, drawing);
    let mut items = Vec::new();
    if let (true, Feature::Edge(a, b)) = (feature, pair.on_obstacle) {
        items
            .push(item("edge", "the edge it lies on", Role::Witness, Drawing::segment(a, b)).stroked(Line::solid(3.0)));
    }
    let way = Drawing::segment(w.on_robot, w.on_obstacle);
    items.push(item("segment", "the shortest way", Role::Witness, way).stroked(Line::solid(2.0)));
    let ring = |at| Drawing::Mark { at, glyph: Glyph::Ring, radius_px: 3.5 };
    items.push(item("a", "a* on the robot", Role::Robot, ring(w.on_robot)));
    items.push(item("b", "b* on the obstacle", Role::Obstacle, ring(w.on_obstacle)));
    items
}

/// The outline of a footprint, one thin line per part.
fn outline_item(id: &str, name: &str, footprint: &Footprint, role: Role, line: Line) -> Item {
    let outline = footprint.parts().iter().map(|part| {
        let mut points = polygon_of(part.placed());
        if points.len() > 2 {
            points.extend(points.first().copied());
        }
        points
    });
    let region = Drawing::Region { pieces: Vec::new(), outline: outline.collect() };
    Item::new(id, name, role, region).filled(Fill::None).stroked(line)
}

/// The shorter side of a piece of the plane, metres.
fn size_of(bounds: &Aabb) -> f64 {
    lesser(bounds.max.y - bounds.min.y, bounds.max.x - bounds.min.x)
}

/// The place for words around a point with the most room among obstacles and these footprints, at least a tenth of the
/// picture away from the point.
fn roomy_place(anatomy: &Anatomy, bounds: &Aabb, at: Point2, off: &[Footprint]) -> Point2 {
    let size = size_of(bounds);
    let own = scene_of(bounds, off);
    let mut best = (-f64::INFINITY, at);
    for k in 0..48_u32 {
        let (s, c) = num::sin_cos(f64::from(k) * std::f64::consts::FRAC_PI_8);
        let far = [0.1, 0.15, 0.22][(k / 16) as usize];
        let place = at + Vector2::new(1.7 * c, s) * (far * size);
        let inside = [place.x - bounds.min.x, bounds.max.x - place.x, place.y - bounds.min.y, bounds.max.y - place.y];
        // room for half the words to either side
        let room = [-0.12, -0.06, 0.0, 0.06, 0.12].iter().fold(f64::INFINITY, |room, off| {
            let point = Footprint::disc(place + Vector2::new(*off * size, 0.0), 0.0);
            lesser(room, lesser(anatomy.checker().scene().distance(&point), own.distance(&point)))
        });
        let edge = inside.iter().fold(f64::INFINITY, |m, d| lesser(m, *d));
        // more room than the words need is no better; a plate at the picture's edge would be cut
        let score = lesser(room, 0.055 * size) + 10.0 * lesser(edge - 0.13 * size, 0.0);
        if score > best.0 + 1e-12 {
            best = (score, place);
        }
    }
    best.1
}

/// Footprints as a scene of their own.
fn scene_of(bounds: &Aabb, footprints: &[Footprint]) -> Scene {
    let parts = footprints.iter().flat_map(Footprint::parts);
    parts.fold(Scene::empty(*bounds), |scene, part| {
        let placed = part.placed();
        let shape = Shape::Hull { vertices: placed.core().into(), radius: placed.radius() };
        scene.with_obstacle_at("a robot", Pose2::IDENTITY, shape)
    })
}
