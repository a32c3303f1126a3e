//! Twins: configurations with one position, such as an arm's two elbows or a car's two headings.

use std::f64::consts::PI;

use super::SweptMotion;
use super::words::{figure, metres};
use motion_lab_core::collision::{Checker, Collision, EdgeVerdict, HitBy};
use motion_lab_core::configuration::{AnyConfiguration, Configuration};
use motion_lab_core::picture::{Drawing, Glyph, Item, Role, footprint};
use motion_lab_core::robots::{AnyRobot, Robot};

/// The other configuration at the same position: of an arm with two links the other elbow with its tip, of a car the
/// opposite heading with its rear axle there, its trailer turned with it. `None` for an arm that is straight or folded,
/// which is the only one with its tip, and for other robots.
pub fn twin(robot: &AnyRobot, q: &AnyConfiguration) -> Option<AnyConfiguration> {
    match (robot, q) {
        (AnyRobot::Reach(arm), AnyConfiguration::T2(now)) => {
            let [down, up] = arm.ik(arm.tip(now));
            let (down, up) = down.zip(up)?;
            Some(AnyConfiguration::T2(if now.th2() >= 0.0 { up } else { down }))
        }
        (AnyRobot::Hitch(_), AnyConfiguration::Hitch(_)) => {
            let turned = q.coordinates().into_iter().enumerate();
            Some(turned.skip(2).fold(*q, |q, (i, angle)| q.with(i, angle + PI)))
        }
        _ => None,
    }
}

/// Both configurations at the position of `q` in words, as [`twin`] finds the other: `(0.72, −0.25) and (0.48, 0.25)`.
pub fn both_configurations(robot: &AnyRobot, q: &AnyConfiguration) -> Option<String> {
    let said = |q: &AnyConfiguration| {
        let angles: Vec<String> = q.coordinates().iter().map(|x| figure(*x, 2)).collect();
        format!("({})", angles.join(", "))
    };
    Some(format!("{} and {}", said(&twin(robot, q)?), said(q)))
}

/// The other configuration at the position of `q`, drawn pale; empty where there is none.
pub fn twin_items(robot: &AnyRobot, q: &AnyConfiguration) -> Vec<Item> {
    let other = twin(robot, q).map(|other| robot.footprint(&other));
    let name = "the other arm with this tip";
    other.map_or_else(Vec::new, |there| footprint("other", name, &there, Role::Robot, 0.3))
}

/// The name of what a robot touches at `q`; `None` where it is free.
pub fn in_the_way(checker: &Checker<AnyRobot>, q: &AnyConfiguration) -> Option<String> {
    let touched = checker.scene().touched(&checker.robot().footprint(q));
    let name = touched.first().and_then(|id| checker.scene().obstacle_name(*id)).map(str::to_owned);
    name.or_else(|| (!checker.is_free(q)).then(|| "its own limits".to_owned()))
}

/// The verdict on a straight motion in one sentence: `the straight way hits the post at s = 0.41`.
pub fn straight_way(checker: &Checker<AnyRobot>, sweep: &SweptMotion) -> String {
    match sweep.verdict {
        EdgeVerdict::Free { clearance } => {
            format!("the straight way is free, at least {} clear", metres(clearance))
        }
        EdgeVerdict::Hit { contact_at, by, .. } => {
            let name = match by {
                HitBy::Obstacle(id) => checker.scene().obstacle_name(id).unwrap_or("an obstacle"),
                HitBy::Limit => "its own limits",
            };
            format!("the straight way hits {name} at s = {}", figure(contact_at, 2))
        }
        EdgeVerdict::Unresolved { free_until, .. } => {
            format!("the straight way is not proven free from s = {} on", figure(free_until, 2))
        }
    }
}

/// Where a straight motion hits first: the robot there, and a cross at the contact. Empty for any other motion.
pub fn contact_items(checker: &Checker<AnyRobot>, sweep: &SweptMotion) -> Vec<Item> {
    let EdgeVerdict::Hit { contact_at, .. } = sweep.verdict else { return Vec::new() };
    let there = checker.robot().footprint(&sweep.at(contact_at));
    let mut items = footprint("way/hit", "the first contact", &there, Role::Goal, 0.3);
    items.extend(checker.scene().witness(&there).map(|w| {
        let cross = Drawing::Mark { at: w.on_obstacle, glyph: Glyph::Cross, radius_px: 6.0 };
        Item::new("way/contact", "a point in common", Role::Goal, cross)
    }));
    items
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::collision::Scene;
    use motion_lab_core::configuration::{HitchCfg, T2};
    use motion_lab_core::geometry::Pose2;
    use motion_lab_core::num::wrap;
    use motion_lab_core::robots::{HITCH, Reach};

    fn bench() -> Checker<AnyRobot> {
        Checker::new(Scene::workbench(), AnyRobot::Reach(Reach::workbench()))
    }

    fn at(th1: f64, th2: f64) -> AnyConfiguration {
        AnyConfiguration::T2(T2::new(th1, th2))
    }

    #[test]
    fn the_other_elbow_has_the_same_tip_and_a_straight_arm_has_none() {
        let arm = *bench().robot();
        // for links of one length the other elbow is (th1 + th2, -th2)
        for (th1, th2) in [(0.3, 1.1), (-2.0, -0.4), (3.0, 2.5)] {
            let other = twin(&arm, &at(th1, th2)).unwrap();
            let AnyConfiguration::T2(found) = other else { panic!("an arm's") };
            assert!(wrap(found.th1() - th1 - th2).abs() < 1e-9 && (found.th2() + th2).abs() < 1e-9, "{other}");
            assert!((arm.reference(&other) - arm.reference(&at(th1, th2))).norm() < 1e-12);
        }
        let uneven = AnyRobot::Reach(Reach { lengths: [0.9, 0.4], ..Reach::workbench() });
        let other = twin(&uneven, &at(0.3, 1.1)).unwrap();
        assert!((uneven.reference(&other) - uneven.reference(&at(0.3, 1.1))).norm() < 1e-12 && other != at(0.3, 1.1));
        assert_eq!([0.0, PI].map(|th2| twin(&arm, &at(0.4, th2))), [None, None]);
        assert_eq!(twin(&AnyRobot::Reach3(Reach::redundant()), &at(0.3, 1.1)), None);
    }

    #[test]
    fn both_configurations_are_said_with_two_decimals() {
        let arm = *bench().robot();
        assert_eq!(both_configurations(&arm, &at(0.3, 1.1)).unwrap(), "(1.40, \u{2212}1.10) and (0.30, 1.10)");
        assert_eq!(both_configurations(&arm, &at(0.3, 0.0)), None);
    }

    #[test]
    fn a_car_turned_about_has_its_rear_axle_where_it_was() {
        let q = AnyConfiguration::Hitch(HitchCfg { body: Pose2::new(6.5, 2.5, 0.2), trailer: Some(-0.1) });
        let car = AnyRobot::Hitch(HITCH.with_trailer());
        let turned = twin(&car, &q).unwrap().coordinates();
        assert_eq!(turned[..2], [6.5, 2.5]);
        assert!((turned[2] - (0.2 - PI)).abs() < 1e-12 && (turned[3] - (PI - 0.1)).abs() < 1e-12, "{turned:?}");
        // a car's length from the west curb there is room in front of the axle, and none behind it
        let checker = Checker::new(Scene::of_world(&motion_lab_core::worlds::World::lot()), AnyRobot::Hitch(HITCH));
        let near = AnyConfiguration::Hitch(HitchCfg { body: Pose2::new(1.5, 2.5, 0.0), trailer: None });
        assert_eq!(in_the_way(&checker, &near), None);
        let about = twin(checker.robot(), &near).unwrap();
        assert_eq!(in_the_way(&checker, &about).as_deref(), Some("the west curb"));
    }

    #[test]
    fn the_straight_way_is_free_or_names_what_it_hits_and_where() {
        let checker = bench();
        let way = |a, b| SweptMotion::new(&checker, &a, &b).unwrap();
        // the chapter's: link 1 sweeps through the post, both ends are free
        let hit = way(at(2.0, 0.0), at(3.1, 0.0));
        let words = straight_way(&checker, &hit);
        let EdgeVerdict::Hit { contact_at, .. } = hit.verdict else { panic!("{words}") };
        assert_eq!(words, format!("the straight way hits the post at s = {contact_at:.2}"));
        let items = contact_items(&checker, &hit);
        let Some(Drawing::Mark { at: cross, .. }) = items.last().map(|item| &item.drawing) else { panic!("a cross") };
        // the post is [-0.7, -0.5] x [0.3, 0.5]
        assert!((-0.701..=-0.499).contains(&cross.x) && (0.299..=0.501).contains(&cross.y), "{cross}");
        let free = way(at(-0.5, 0.3), at(-0.4, -0.3));
        assert!(straight_way(&checker, &free).starts_with("the straight way is free, at least 0."));
        assert!(contact_items(&checker, &free).is_empty());
    }
}
