//! Draws a world as a picture.

use std::fmt;

use super::outline::{chains, outline, polygon_of};
use super::{Anchor, Dash, Drawing, Face, Fill, Glyph, Item, Line, Picture, Role};
use crate::geometry::{Point2, Vector2};
use crate::num;
use crate::worlds::{Door, Obstacle, ObstacleKind, Place, World};

/// How far the drawn corners of a route may stray from it, metres.
const STRAY: f64 = 0.01;

/// A thing of a world that items are drawn for, by its name. It prints as the id of its first item; the ids of others
/// go on after a slash.
///
/// ```
/// use motion_lab_core::picture::{Thing, world};
/// use motion_lab_core::worlds::World;
/// let lot = world(&World::lot());
/// let pillar = lot.items.iter().find(|item| Thing::of(item) == Some(Thing::Obstacle("the west pillar"))).unwrap();
/// assert_eq!(pillar.id, Thing::Obstacle("the west pillar").to_string());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Thing<'a> {
    /// A wall or a solid obstacle.
    Obstacle(&'a str),
    /// A door: its first item lies over its gap, the one to pick it by.
    Door(&'a str),
    /// A named place.
    Place(&'a str),
    /// A painted mark.
    Mark(&'a str),
    /// A route.
    Route(&'a str),
    /// A robot.
    Robot(&'a str),
}

/// A kind of things, as ids begin.
type ThingKind = (&'static str, for<'a> fn(&'a str) -> Thing<'a>);

const THING_KINDS: [ThingKind; 6] = [
    ("obstacle", |name| Thing::Obstacle(name)),
    ("door", |name| Thing::Door(name)),
    ("place", |name| Thing::Place(name)),
    ("mark", |name| Thing::Mark(name)),
    ("route", |name| Thing::Route(name)),
    ("robot", |name| Thing::Robot(name)),
];

impl<'a> Thing<'a> {
    /// The thing that an item is drawn for; `None` for an item of anything else.
    pub fn of(item: &'a Item) -> Option<Self> {
        let (kind, _) = item.id.split_once('/')?;
        THING_KINDS.iter().find(|(known, _)| *known == kind).map(|(_, thing)| thing(&item.name))
    }

    /// Its name.
    pub const fn name(self) -> &'a str {
        match self {
            Thing::Obstacle(name)
            | Thing::Door(name)
            | Thing::Place(name)
            | Thing::Mark(name)
            | Thing::Route(name)
            | Thing::Robot(name) => name,
        }
    }
}

impl fmt::Display for Thing<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = THING_KINDS.iter().find(|(_, thing)| thing(self.name()) == *self).map_or("", |(kind, _)| kind);
        write!(f, "{kind}/{}", self.name())
    }
}

/// The picture of a world: routes and painted marks, then solid obstacles, then walls and closed doors, then open
/// doors.
///
/// An open door is its leaf, turned a quarter about its hinge, and a thin line over the gap; neither is an obstacle.
pub fn world(world: &World) -> Picture {
    let marks = world.marks.iter().map(|mark| {
        Item::new(Thing::Mark(&mark.name).to_string(), &mark.name, Role::Muted, Drawing::Polyline(mark.points.clone()))
            .stroked(Line::solid(1.0))
    });
    let routes = world.routes.iter().filter_map(|route| {
        let outline = route.path().ok()?.outline(STRAY);
        let item =
            Item::new(Thing::Route(&route.name).to_string(), &route.name, Role::Muted, Drawing::Polyline(outline));
        Some(item.stroked(Line::solid(1.0).dashed(Dash::Dashed)))
    });
    let of_kind = |kind| world.obstacles.iter().filter(move |o| o.kind == kind).map(obstacle);
    Picture::new(&world.name, world.bounds)
        .with(routes)
        .with(marks)
        .with(of_kind(ObstacleKind::Solid))
        .with(of_kind(ObstacleKind::Wall))
        .with(world.doors.iter().flat_map(door))
}

fn door(door: &Door) -> Vec<Item> {
    let item = |id: String, role, points| Item::new(id, &door.name, role, Drawing::Polyline(points));
    let (id, closed) = (Thing::Door(&door.name), vec![door.a, door.b]);
    if !door.open {
        return vec![item(id.to_string(), Role::Obstacle, closed).stroked(Line::solid(3.0))];
    }
    let along = door.b - door.a;
    let leaf = vec![door.a, door.a + Vector2::new(-along.y, along.x)];
    vec![
        item(id.to_string(), Role::Muted, closed).stroked(Line::solid(1.0).dashed(Dash::Dashed)),
        item(format!("{id}/leaf"), Role::Muted, leaf).stroked(Line::solid(1.5)),
    ]
}

fn obstacle(obstacle: &Obstacle) -> Item {
    let placed: Vec<Vec<Point2>> = obstacle.pieces.iter().map(|(pose, shape)| polygon_of(&shape.place(pose))).collect();
    let (lines, pieces): (Vec<_>, Vec<_>) = placed.into_iter().partition(|p| p.len() == 2);
    let segments: Vec<(Point2, Point2)> = lines.iter().map(|l| (l[0], l[1])).collect();
    let mut edges = chains(&segments);
    edges.extend(outline(&pieces));
    let width = match obstacle.kind {
        ObstacleKind::Wall => 2.0,
        ObstacleKind::Solid => 1.5,
    };
    let id = Thing::Obstacle(&obstacle.name).to_string();
    Item::new(id, &obstacle.name, Role::Obstacle, Drawing::Region { pieces, outline: edges })
        .filled(Fill::Hatch)
        .stroked(Line::solid(width))
}

/// The items of a world's named places: for each a dot, a short arrow along its heading, and its name below.
pub fn places(places: &[Place]) -> Vec<Item> {
    places.iter().flat_map(place).collect()
}

fn place(place: &Place) -> [Item; 3] {
    let at = place.pose.position();
    let (s, c) = num::sin_cos(place.pose.theta);
    let id = Thing::Place(&place.name);
    let item = |part: &str, drawing| Item::new(format!("{id}/{part}"), &place.name, Role::Muted, drawing);
    let text = place.name.clone();
    [
        item("way", Drawing::Arrow { from: at, along: Vector2::new(c, s) * 1e-3, min_px: 9.0 })
            .stroked(Line::solid(1.0)),
        item("dot", Drawing::Mark { at, glyph: Glyph::Dot, radius_px: 2.0 }),
        item("name", Drawing::Label { at, text, anchor: Anchor::Below, face: Face::Sans, size_px: 11.0, plate: true }),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Aabb;
    use crate::geometry::{Pose2, Shape};
    use crate::worlds::{Mark, Route};

    #[test]
    fn an_item_says_what_it_is_drawn_for() {
        let named = [
            Thing::Obstacle("a/b"),
            Thing::Door("d"),
            Thing::Place("p"),
            Thing::Mark("m"),
            Thing::Route("r"),
            Thing::Robot("R"),
        ];
        let ids = ["obstacle/a/b", "door/d", "place/p", "mark/m", "route/r", "robot/R"];
        assert_eq!(named.map(|thing| thing.to_string()), ids);
        let dot = |id: String, name: &str| Item::new(id, name, Role::Muted, Drawing::Polyline(vec![]));
        for thing in named {
            // a part of it is drawn for it too
            for id in [thing.to_string(), format!("{thing}/part")] {
                assert_eq!(Thing::of(&dot(id, thing.name())), Some(thing));
            }
        }
        assert_eq!([Thing::of(&dot("obstacle".into(), "a")), Thing::of(&dot("grid/lines".into(), "a"))], [None; 2]);
    }

    #[test]
    fn everything_named_is_drawn_once_under_its_name() {
        let p = Point2::new;
        let wall = |a, b| (Pose2::IDENTITY, Shape::try_segment(a, b).unwrap());
        let model = World {
            name: "Yard".into(),
            bounds: Aabb { min: p(0.0, 0.0), max: p(4.0, 4.0) },
            obstacles: vec![
                Obstacle::new(
                    "the fence",
                    ObstacleKind::Wall,
                    vec![wall(p(0.0, 0.0), p(4.0, 0.0)), wall(p(4.0, 0.0), p(4.0, 4.0))],
                ),
                Obstacle::new(
                    "the box",
                    ObstacleKind::Solid,
                    vec![(Pose2::IDENTITY, Shape::try_rectangle(p(1.0, 1.0), p(2.0, 2.0)).unwrap())],
                ),
            ],
            doors: vec![],
            routes: vec![],
            places: vec![Place { name: "the gate".into(), pose: Pose2::IDENTITY }],
            marks: vec![Mark { name: "the line".into(), points: vec![p(0.0, 3.0), p(4.0, 3.0)] }],
            robots: vec![],
        };
        let picture = world(&model);
        let names: Vec<&str> = picture.items.iter().map(|i| i.name.as_str()).collect();
        assert_eq!(names, ["the line", "the box", "the fence"], "walls on top, marks below");
        let Drawing::Region { pieces, outline } = &picture.items[2].drawing else { panic!("a region") };
        assert!(pieces.is_empty());
        assert_eq!(outline, &[vec![p(0.0, 0.0), p(4.0, 0.0), p(4.0, 4.0)]], "one line with a corner");
        let Drawing::Region { pieces, .. } = &picture.items[1].drawing else { panic!("a region") };
        assert_eq!(pieces[0].len(), 4);
        assert!(places(&model.places).iter().all(|i| i.name == "the gate"));
    }

    #[test]
    fn a_route_is_drawn_closed_and_rounded_below_everything() {
        let p = Point2::new;
        let points = vec![p(0.0, 0.0), p(4.0, 0.0), p(4.0, 4.0), p(0.0, 4.0)];
        let route = Route { name: "round".into(), points: points.clone(), radius: 1.0, speed: 1.0 };
        let line = Mark { name: "the line".into(), points: points.clone() };
        let empty = World::empty("Yard", Aabb { min: points[0], max: points[2] });
        let picture = world(&World { routes: vec![route], marks: vec![line], ..empty });
        let ids: Vec<&str> = picture.items.iter().map(|i| i.id.as_str()).collect();
        assert_eq!(ids, ["route/round", "mark/the line"]);
        let Drawing::Polyline(drawn) = &picture.items[0].drawing else { panic!("a line") };
        assert_eq!(drawn.first(), drawn.last());
        // a quarter circle of radius 1 strays by 1 cm or less from 6 chords or more
        assert!(drawn.len() > 4 * 6 && drawn.iter().all(|q| points.iter().all(|c| (q - c).norm() > 0.41)), "{drawn:?}");
    }
}
