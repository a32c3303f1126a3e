//! A contact as a picture: what is touched, where, and its name.

use crate::collision::{Collision, Scene};
use crate::geometry::{Footprint, Point2};
use crate::picture::{Anchor, Drawing, Face, Glyph, Item, Line, Role, polygon_of};

/// Gap up to which a footprint counts as held by an obstacle, metres: a rover stops a hair short of a wall.
const HELD: f64 = 1e-3;

/// What a footprint touches, or is held by: each such obstacle's edge, a ring at the nearest point, and there the
/// obstacle's name, once. Nothing where it touches nothing.
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
        let label = Drawing::Label {
            at,
            text: name.to_owned(),
            anchor: away_from(footprint, at),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Aabb, Pose2, Shape};

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
        let off = edge.iter().map(|p| ((p - Point2::new(7.0, 7.0)).norm() - 0.5).abs()).fold(0.0, crate::num::greater);
        assert!(edge.first() == edge.last() && off < 0.02, "the stone's own edge: {off}");
    }
}
