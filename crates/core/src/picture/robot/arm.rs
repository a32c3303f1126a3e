//! The marks on an arm: its base plate, its joints, its gripper.

use super::frame::{placed, rectangle};
use crate::geometry::{Footprint, Part, Point2, Pose2};
use crate::num;
use crate::picture::{Drawing, Fill, Glyph, Item, Line, Role};

/// Half the side of the base plate, and the size of the gripper, in lengths of the arm.
const PLATE: f64 = 0.045;
const GRIPPER: f64 = 0.03;

/// The links of a footprint: its parts that are segments or capsules.
fn links(footprint: &Footprint) -> impl Iterator<Item = &Part> {
    footprint.parts().iter().filter(|part| part.placed().core().len() == 2)
}

fn reach(footprint: &Footprint) -> f64 {
    links(footprint).map(|link| ends(link).map_or(0.0, |[a, b]| (b - a).norm())).sum()
}

fn ends(link: &Part) -> Option<[Point2; 2]> {
    match link.placed().core() {
        [a, b] => Some([*a, *b]),
        _ => None,
    }
}

/// The plate that an arm stands on. It is drawn below the links and counts for nothing.
pub fn plate(id: &str, name: &str, footprint: &Footprint) -> Option<Item> {
    let base = links(footprint).next()?.pose().position();
    let plate = rectangle(&Pose2::new(base.x, base.y, 0.0), [PLATE * reach(footprint); 2]);
    Some(Item::new(format!("{id}/plate"), name, Role::Muted, plate).filled(Fill::Tint(0.35)).stroked(Line::solid(1.0)))
}

/// The joints, and at the tip the gripper, whose jaws end where the arm does.
pub fn marks(id: &str, name: &str, footprint: &Footprint, role: Role) -> Vec<Item> {
    let item = |part: &str, drawn| Item::new(format!("{id}/{part}"), name, role, drawn);
    let ring = |(i, link): (usize, &Part)| {
        let radius_px = if i == 0 { 5.0 } else { 4.0 };
        item(&format!("joint {}", i + 1), Drawing::Mark { at: link.pose().position(), glyph: Glyph::Ring, radius_px })
    };
    let mut items: Vec<Item> = links(footprint).enumerate().map(ring).collect();
    if let Some([a, b]) = links(footprint).last().and_then(ends) {
        let at = Pose2::new(b.x, b.y, num::atan2(b.y - a.y, b.x - a.x));
        let size = GRIPPER * reach(footprint);
        let jaws = placed(&at, &[(0.0, size), (-size, size), (-size, -size), (0.0, -size)]);
        items.push(item("gripper", Drawing::Polyline(jaws)).stroked(Line::solid(2.5)));
        items.push(item("tip", Drawing::Mark { at: b, glyph: Glyph::Dot, radius_px: 2.5 }));
    }
    items
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::configuration::T2;
    use crate::robots::{Reach, Robot};

    #[test]
    fn the_jaws_end_at_the_tip_and_open_the_way_the_last_link_points() {
        let arm = Reach::<2> { base: Point2::new(1.0, 1.0), lengths: [2.0, 1.0], link_radius: 0.0 };
        // the first link ahead, the second up: the tip is at (3, 2)
        let footprint = arm.footprint(&T2::new(0.0, FRAC_PI_2));
        let items = marks("a", "a", &footprint, Role::Robot);
        let Drawing::Polyline(jaws) = &items.iter().find(|i| i.id == "a/gripper").unwrap().drawing else {
            panic!("jaws")
        };
        // the arm is 3 m long: the jaws are 0.09 m deep and 0.18 m apart
        let wanted = [(2.91, 2.0), (2.91, 1.91), (3.09, 1.91), (3.09, 2.0)].map(|(x, y)| Point2::new(x, y));
        assert!(jaws.iter().zip(wanted).all(|(a, b)| (*a - b).norm() < 1e-12), "{jaws:?}");
        let Some(Item { drawing: Drawing::Polygon(plate), .. }) = plate("a", "a", &footprint) else { panic!("plate") };
        assert!((plate[0] - Point2::new(1.135, 1.135)).norm() < 1e-12, "{plate:?}");
    }
}
