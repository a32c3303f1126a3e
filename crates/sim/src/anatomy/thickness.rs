//! How thick the links of a two-link arm are when they are not bare.

use motion_lab_core::robots::{AnyRobot, Reach};
use motion_lab_core::worlds::World;

/// The radius of a two-link arm's links when they are thick, metres: its own, else that of the resident with its base
/// and lengths. `None` for another robot, and where neither has one.
pub(super) fn of_links(world: &World, robot: &AnyRobot) -> Option<f64> {
    let bare = |arm: &Reach<2>| Reach { link_radius: 0.0, ..*arm };
    let own = |robot: &AnyRobot| match robot {
        AnyRobot::Reach(arm) if arm.link_radius > 0.0 => Some(*arm),
        _ => None,
    };
    let AnyRobot::Reach(arm) = robot else { return None };
    let mut residents = world.robots.iter().filter_map(|r| own(&AnyRobot::model(&r.kind, r.sizes.as_ref())?));
    let thick = own(robot).or_else(|| residents.find(|resident| bare(resident) == bare(arm)));
    thick.map(|arm| arm.link_radius)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::{Anatomy, WorldSource};

    /// A world with a two-link arm 7 cm thick, a metre below a wall, and one of the lab's size.
    fn bench(radius: f64) -> World {
        let text = format!(
            "World(version: 1, name: \"bench\", bounds: (min: (-3, -3), max: (3, 3)),
            walls: [(name: \"the wall\", points: [(-3, 1), (3, 1)])],
            robots: [
                (name: \"Thick\", kind: \"reach\", start: [0, 0],
                    arm: (base: (-1, 0), lengths: [0.75, 0.5], radius: {radius})),
                (name: \"Reach\", kind: \"reach\", start: [0, 0]),
            ])"
        );
        World::parse("bench.ron", &text).unwrap()
    }

    #[test]
    fn links_are_bare_or_as_thick_as_the_residents_own() {
        let own = Anatomy::of_world(bench(0.07), WorldSource::Unsaved).unwrap();
        assert_eq!((own.thick_links(), own.thickness()), (Some(true), Some(0.07)));
        assert!((own.distance() - 0.93).abs() < 1e-12);
        let mut arm = own.clone();
        arm.set_thick_links(true);
        assert_eq!(arm.checker().robot(), own.checker().robot());
        arm.set_thick_links(false);
        assert_eq!((arm.thick_links(), arm.distance()), (Some(false), 1.0));
        assert_eq!(arm.resident(), None, "bare links are not the resident's");
        // the same arm in another world keeps its own radius, bare or not
        let mut elsewhere = arm.in_world(World::workbench(), WorldSource::BuiltIn("workbench"));
        assert_eq!((elsewhere.thick_links(), elsewhere.thickness()), (Some(false), Some(0.07)));
        elsewhere.set_thick_links(true);
        assert_eq!(elsewhere.checker().robot(), own.checker().robot());
        let AnyRobot::Reach(bare_arm) = *arm.checker().robot() else { panic!("an arm") };
        // a bare arm that was never thick is as thick as the resident with its base and lengths
        let mut bare = own.with_robot(*arm.checker().robot());
        assert_eq!((bare.thick_links(), bare.thickness()), (Some(false), Some(0.07)));
        bare.set_thick_links(true);
        assert_eq!(bare.resident().map(|r| r.name.as_str()), Some("Thick"));
        // the lab's own, and one that no resident is, or whose resident is bare itself
        let lab = own.with_robot(AnyRobot::Reach(Reach::choset()));
        let other = own.with_robot(AnyRobot::Reach(Reach { lengths: [0.75, 0.25], ..Reach::choset() }));
        let of_bare = Anatomy::of_world(bench(0.0), WorldSource::Unsaved).unwrap();
        for anatomy in [lab, other, of_bare, Anatomy::default(), Anatomy::exercise_3()] {
            assert_eq!((anatomy.thick_links(), anatomy.thickness()), (Some(false), Some(0.03)));
        }
        // a thick arm is as thick as it is, whatever the resident with its base and lengths
        let other_radius = AnyRobot::Reach(Reach { link_radius: 0.04, ..bare_arm });
        assert_eq!(own.with_robot(other_radius).thickness(), Some(0.04));
        assert_eq!(own.with_robot(AnyRobot::Reach3(Reach::redundant())).thickness(), None);
    }
}
