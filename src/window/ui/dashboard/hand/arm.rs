//! The geometry of an arm's handles: pure functions of its footprint and its joint angles.

use motion_lab_core::configuration::Coordinates;
use motion_lab_core::geometry::{Footprint, Part, Point2, Segment, Vector2};
use motion_lab_core::num::{atan2, sin_cos, wrap};

/// The points of an arm from base to tip, read from its footprint of capsules or segments; empty for other robots.
pub fn joints(footprint: &Footprint) -> Vec<Point2> {
    let ends = |part: &Part| match part.placed().core() {
        [a, b] => Some((*a, *b)),
        _ => None,
    };
    let links: Option<Vec<_>> = footprint.parts().iter().map(ends).collect();
    let links = links.unwrap_or_default();
    links.first().map(|l| l.0).into_iter().chain(links.iter().map(|l| l.1)).collect()
}

/// The name of the handle at the end of link `link` of `links`.
pub fn handle_name(link: usize, links: usize) -> String {
    match (link + 1 == links, links) {
        (true, _) => "tip".into(),
        (false, 2) => "elbow".into(),
        (false, _) => format!("joint {}", link + 2),
    }
}

/// The joint angles after the end of link `link` was dragged toward `pointer`.
///
/// That link's joint turns to the pointer's bearing, and all other (relative) angles are kept. So the elbow takes the
/// whole arm along, and the tip turns on a circle about the last joint, but for the lab's own arms, whose tip follows
/// the pointer. A pointer on the joint itself turns nothing, because it has no bearing.
pub fn dragged(coordinates: &[f64], joints: &[Point2], link: usize, pointer: Point2) -> Coordinates {
    let mut angles = Coordinates::from_slice(coordinates);
    let Some(away) = joints.get(link).map(|joint| pointer - joint).filter(|v| *v != Vector2::zeros()) else {
        return angles;
    };
    let before: f64 = coordinates.iter().take(link).sum();
    if let Some(angle) = angles.get_mut(link) {
        *angle = wrap(atan2(away.y, away.x) - before);
    }
    angles
}

/// The footprint of the arm `like` turned to other joint angles.
pub fn turned(like: &Footprint, coordinates: &[f64]) -> Footprint {
    let points = joints(like);
    let radius = like.parts().first().map_or(0.0, |p| p.placed().radius());
    let Some(&base) = points.first() else { return like.clone() };
    let mut at = base;
    let mut bearing = 0.0;
    let lengths = points.windows(2).map(|w| (w[1] - w[0]).norm());
    let links: Vec<Segment> = lengths
        .zip(coordinates)
        .map(|(length, angle)| {
            bearing += angle;
            let (s, c) = sin_cos(bearing);
            let from = at;
            at += Vector2::new(c, s) * length;
            Segment::new(from, at)
        })
        .collect();
    Footprint::capsules(links, radius)
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::configuration::{T2, Tn};
    use motion_lab_core::num::{cos, sin};
    use motion_lab_core::robots::{Reach, Robot};

    const Q: [f64; 2] = [0.5, 1.0];

    fn arm(q: [f64; 2]) -> Footprint {
        Reach::<2>::workbench().footprint(&T2::new(q[0], q[1]))
    }

    #[test]
    fn the_elbow_turns_the_first_joint_and_the_tip_goes_on_a_circle_about_the_base() {
        let points = joints(&arm(Q));
        let pointer = Point2::new(-0.7, 2.0);
        let to = dragged(&Q, &points, 0, pointer);
        assert_eq!(to[1], Q[1], "theta2 is kept");
        assert!((to[0] - atan2(2.0, -0.7)).abs() < 1e-15);
        let after = joints(&turned(&arm(Q), &to));
        assert!((after[2].coords.norm() - points[2].coords.norm()).abs() < 1e-12);
        let along = (after[1] - after[0]).normalize();
        assert!((along - pointer.coords.normalize()).norm() < 1e-12);
    }

    #[test]
    fn the_tip_turns_the_second_joint_only_on_a_circle_about_the_elbow() {
        let points = joints(&arm(Q));
        let pointer = Point2::new(-2.0, -2.0);
        let to = dragged(&Q, &points, 1, pointer);
        assert_eq!(to[0], Q[0]);
        let after = joints(&turned(&arm(Q), &to));
        assert_eq!(after[1], points[1]);
        assert!(((after[2] - after[1]).norm() - 1.0).abs() < 1e-12);
        assert!(((after[2] - after[1]).normalize() - (pointer - points[1]).normalize()).norm() < 1e-12);
        assert_eq!(&dragged(&Q, &points, 1, points[1])[..], Q, "no bearing, no turn");
    }

    #[test]
    fn a_turned_arm_is_the_arm_there() {
        for q in [[0.1, -2.0], [3.0, 3.0]] {
            let (ours, its) = (joints(&turned(&arm(Q), &q)), joints(&arm(q)));
            assert!(ours.iter().zip(&its).all(|(a, b)| (a - b).norm() < 1e-12));
        }
        let three = Reach::<3>::redundant().footprint(&Tn([0.1, 0.2, 0.3]));
        assert_eq!(joints(&three).len(), 4);
        assert_eq!([0, 1].map(|i| handle_name(i, 2)), ["elbow", "tip"]);
        assert_eq!([0, 1, 2].map(|i| handle_name(i, 3)), ["joint 2", "joint 3", "tip"]);
    }

    #[test]
    fn a_dragged_link_points_at_the_pointer_and_takes_along_what_hangs_on_it() {
        let (base, lengths, q) = (Point2::new(0.5, -0.25), [0.6, 0.5, 0.4], [0.4, -1.1, 2.0]);
        let arm = Reach { base, lengths, link_radius: 0.03 };
        // the joints by the angles summed up
        let points = |q: &[f64]| {
            let (mut at, mut bearing, mut all) = (base, 0.0, vec![base]);
            for (angle, length) in q.iter().zip(lengths) {
                bearing += angle;
                at += Vector2::new(cos(bearing), sin(bearing)) * length;
                all.push(at);
            }
            all
        };
        let before = points(&q);
        let shown = joints(&arm.footprint(&Tn(q)));
        assert!(shown.iter().zip(&before).all(|(a, b)| (a - b).norm() < 1e-12), "{shown:?}");
        for pointer in [Point2::new(2.0, 1.0), Point2::new(-1.0, 0.7), Point2::new(0.2, -3.0)] {
            for link in 0..3 {
                let to = dragged(&q, &shown, link, pointer);
                let after = points(&to);
                let (along, wanted) = (after[link + 1] - after[link], pointer - after[link]);
                assert!((along.normalize() - wanted.normalize()).norm() < 1e-12, "link {link} to {pointer}");
                assert!(
                    after[..=link].iter().zip(&before).all(|(a, b)| (a - b).norm() < 1e-12),
                    "what carries it stays"
                );
                assert!((0..3).all(|k| k == link || to[k] == q[k]), "no other joint turns: {to:?}");
            }
        }
    }
}
