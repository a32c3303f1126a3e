//! A contact as a picture: what is touched, where, and its name.

use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::geometry::{Aabb, Footprint, Point2};
use motion_lab_core::num::greater;
use motion_lab_core::picture::{Anchor, Drawing, Face, Glyph, Item, Line, Role, polygon_of};

/// Gap up to which a footprint counts as held by an obstacle, metres: a rover stops a hair short of a wall.
const HELD: f64 = 1e-3;

/// What a footprint touches, or is held by: each such obstacle's edge, a ring at the nearest point, and there the
/// obstacle's name, once, on its far side if that is near. Nothing where it touches nothing.
pub fn touching_items(scene: &Scene, footprint: &Footprint) -> Vec<Item> {
    let Some(nearest) = scene.witness(footprint).filter(|w| w.dist <= HELD) else { return Vec::new() };
    let mut touched = scene.touched(footprint);
    if touched.is_empty() {
        touched.push(nearest.obstacle);
    }
    let edge = |(number, piece): (usize, _)| {
        let mut corners = polygon_of(piece);
        corners.extend(corners.first().copied());
        let item = Item::new(format!("touched/{number}"), "what is touched", Role::Goal, Drawing::Polyline(corners));
        item.stroked(Line::solid(2.0))
    };
    let pieces = scene.pieces().filter(|(obstacle, _)| touched.contains(obstacle)).map(|(_, piece)| piece);
    let mut items: Vec<Item> = (1..).zip(pieces).map(edge).collect();
    let at = nearest.on_obstacle;
    if let Some(name) = scene.obstacle_name(nearest.obstacle) {
        let anchor = away_from(footprint, at);
        let own = scene.pieces().filter(|(obstacle, _)| *obstacle == nearest.obstacle).map(|(_, piece)| piece.bounds());
        let beyond = own.reduce(|one, other| one.merged(&other)).map(|own| far_side(&own, anchor, at));
        // beyond what is larger than the robot, words would be too far off
        let near = footprint.bounds().map_or(0.0, |b| greater(b.max.x - b.min.x, b.max.y - b.min.y));
        let label = Drawing::Label {
            at: beyond.filter(|place| (place - at).norm() <= near).unwrap_or(at),
            text: name.to_owned(),
            anchor,
            face: Face::Sans,
            size_px: 12.0,
            plate: true,
        };
        items.push(Item::new("touched/name", name, Role::Text, label));
    }
    // over the edge of the plate, and smaller than the gap before its letters
    let ring = Drawing::Mark { at, glyph: Glyph::Ring, radius_px: 5.5 };
    items.push(Item::new("touched/at", "where it is touched", Role::Goal, ring));
    items
}

/// The obstacle that holds a footprint, which is at most a millimetre off it and does not touch it: its next step
/// would. `None` where nothing is that near, and where it touches something.
pub fn held_before<'a>(scene: &'a Scene, footprint: &Footprint) -> Option<&'a str> {
    let nearest = scene.witness(footprint).filter(|w| w.dist > 0.0 && w.dist <= HELD)?;
    scene.obstacle_name(nearest.obstacle)
}

/// The side of a contact that is farther from the footprint: words there hide neither.
fn away_from(footprint: &Footprint, at: Point2) -> Anchor {
    let Some(off) = footprint.bounds().map(|bounds| at - bounds.centre()) else { return Anchor::Above };
    match (off.x.abs() > off.y.abs(), off.x > 0.0, off.y > 0.0) {
        (true, true, _) => Anchor::Right,
        (true, false, _) => Anchor::Left,
        (false, _, true) => Anchor::Above,
        (false, _, false) => Anchor::Below,
    }
}

/// The point across a box from one at its edge, on this side of it.
fn far_side(of: &Aabb, side: Anchor, at: Point2) -> Point2 {
    match side {
        Anchor::Right => Point2::new(of.max.x, at.y),
        Anchor::Left => Point2::new(of.min.x, at.y),
        Anchor::Above => Point2::new(at.x, of.max.y),
        Anchor::Below => Point2::new(at.x, of.min.y),
        Anchor::Centre => at,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::geometry::{Pose2, Shape};

    fn boxes() -> Scene {
        let side = |x: f64| Shape::Rectangle { min: Point2::new(x, 0.0), max: Point2::new(x + 1.0, 1.0) };
        Scene::empty(Aabb::new(Point2::new(0.0, 0.0), Point2::new(9.0, 9.0)))
            .with_obstacle("the left box", side(1.0))
            .with_obstacle("the right box", side(3.0))
            .with_obstacle_at("a stone", Pose2::new(7.0, 7.0, 0.0), Shape::Disc { radius: 0.5 })
    }

    /// The ids of the items, and the words of their labels.
    fn told(items: &[Item]) -> (Vec<&str>, Vec<&str>) {
        let names = items.iter().filter_map(|item| match &item.drawing {
            Drawing::Label { text, .. } => Some(text.as_str()),
            _ => None,
        });
        (items.iter().map(|item| item.id.as_str()).collect(), names.collect())
    }

    fn side_of_name(items: &[Item]) -> Anchor {
        let side = items.iter().find_map(|item| match &item.drawing {
            Drawing::Label { anchor, .. } => Some(*anchor),
            _ => None,
        });
        side.expect("a name")
    }

    #[test]
    fn what_is_touched_is_outlined_and_named_once() {
        let scene = boxes();
        let disc = |x: f64, radius| Footprint::disc(Point2::new(x, 0.5), radius);
        assert_eq!(touching_items(&scene, &disc(2.5, 0.45)), [], "5 cm from both");
        // half a tenth of a millimetre from the left box, as a rover is that drove against it
        let held = touching_items(&scene, &disc(2.5, 0.5 - 5e-5));
        assert_eq!(told(&held).0.len(), 3);
        assert_eq!(held_before(&scene, &disc(2.5, 0.5 - 5e-5)), Some("the left box"));
        let others = [disc(2.5, 0.45), disc(2.5, 0.5 - 2e-3), disc(2.5, 0.5), disc(2.5, 0.6)];
        assert!(others.iter().all(|other| held_before(&scene, other).is_none()), "far off, touching, and within");
        // between both boxes and into them
        let both = touching_items(&scene, &disc(2.5, 0.6));
        let (ids, names) = told(&both);
        assert_eq!(ids, ["touched/1", "touched/2", "touched/name", "touched/at"], "the ring over its name's plate");
        assert_eq!(names.len(), 1);
        assert!(["the left box", "the right box"].contains(&names[0]));
        let stone = touching_items(&scene, &Footprint::disc(Point2::new(7.0, 6.0), 0.6));
        assert_eq!(told(&stone).1, ["a stone"]);
        let Drawing::Polyline(edge) = &stone[0].drawing else { panic!("an outline") };
        assert_eq!(side_of_name(&stone), Anchor::Above, "away from the robot under it");
        let from_right = touching_items(&scene, &Footprint::disc(Point2::new(8.0, 7.0), 0.6));
        assert_eq!(side_of_name(&from_right), Anchor::Left, "away from the robot at its right");
        let off = edge
            .iter()
            .map(|p| ((p - Point2::new(7.0, 7.0)).norm() - 0.5).abs())
            .fold(0.0, motion_lab_core::num::greater);
        assert!(edge.first() == edge.last() && off < 0.02, "the stone's own edge: {off}");
    }

    #[test]
    fn a_name_stands_beyond_what_is_smaller_than_the_robot_and_at_the_contact_with_what_is_larger() {
        let scene = boxes();
        let place = |robot: Footprint| {
            let items = touching_items(&scene, &robot);
            let at = items.iter().find_map(|item| match &item.drawing {
                Drawing::Label { at, .. } => Some(*at),
                _ => None,
            });
            at.expect("a name")
        };
        // the stone is a metre across, with its middle at (7, 7); the robots are 1.2 m and 0.4 m across
        let at = place(Footprint::disc(Point2::new(7.0, 5.95), 0.6));
        assert!((at.y - 7.5).abs() < 1e-9 && (at.x - 7.0).abs() < 0.2, "above the stone: {at}");
        let at = place(Footprint::disc(Point2::new(8.05, 7.0), 0.6));
        assert!((at.x - 6.5).abs() < 1e-9 && (at.y - 7.0).abs() < 0.2, "left of it: {at}");
        let at = place(Footprint::disc(Point2::new(7.0, 6.35), 0.2));
        assert!((at - Point2::new(7.0, 6.5)).norm() < 0.2, "where it is touched: {at}");
    }
}
