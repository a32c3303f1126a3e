//! Draws a world as a picture.

use super::outline::{chains, outline, polygon_of};
use super::{Anchor, Dash, Drawing, Face, Fill, Glyph, Item, Line, Picture, Role};
use crate::geometry::{Point2, Vector2};
use crate::num;
use crate::worlds::{Door, Obstacle, ObstacleKind, Place, World};

/// How far the drawn corners of a route may stray from it, metres.
const STRAY: f64 = 0.01;

/// The picture of a world: routes and painted marks, then solid obstacles, then walls and closed doors, then open
/// doors.
///
/// An open door is its leaf, turned a quarter about its hinge, and a thin line over the gap; neither is an obstacle.
pub fn world(world: &World) -> Picture {
    let marks = world.marks.iter().map(|mark| {
        Item::new(format!("mark/{}", mark.name), &mark.name, Role::Muted, Drawing::Polyline(mark.points.clone()))
            .stroked(Line::solid(1.0))
    });
    let routes = world.routes.iter().filter_map(|route| {
        let outline = route.path().ok()?.outline(STRAY);
        let item = Item::new(format!("route/{}", route.name), &route.name, Role::Muted, Drawing::Polyline(outline));
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

/// The id of the item over a door's gap, the one to pick a door by.
pub fn door_id(name: &str) -> String {
    format!("door/{name}")
}

fn door(door: &Door) -> Vec<Item> {
    let item = |id: String, role, points| Item::new(id, &door.name, role, Drawing::Polyline(points));
    let closed = vec![door.a, door.b];
    if !door.open {
        return vec![item(door_id(&door.name), Role::Obstacle, closed).stroked(Line::solid(3.0))];
    }
    let along = door.b - door.a;
    let leaf = vec![door.a, door.a + Vector2::new(-along.y, along.x)];
    vec![
        item(door_id(&door.name), Role::Muted, closed).stroked(Line::solid(1.0).dashed(Dash::Dashed)),
        item(format!("{}/leaf", door_id(&door.name)), Role::Muted, leaf).stroked(Line::solid(1.5)),
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
    let id = format!("obstacle/{}", obstacle.name);
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
    let item =
        |part: &str, drawing| Item::new(format!("place/{}/{part}", place.name), &place.name, Role::Muted, drawing);
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
