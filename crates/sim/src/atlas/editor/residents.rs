//! Where the robots of a world under edit start, and how that is moved and turned.

use super::EditError;
use super::outline::tidy;
use motion_lab_core::configuration::{ArmSizes, Kinds, Sizes};
use motion_lab_core::geometry::{Point2, Pose2, Vector2};
use motion_lab_core::worlds::Resident;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stand {
    /// The base of an arm.
    Base(Point2),
    /// The place that its start begins with.
    Place(Point2),
    /// The pose that its start begins with.
    Pose(Pose2),
}

/// Where a robot starts; `None` for kinds that the editor does not know, and for those without a place.
pub(super) fn stand(robot: &Resident, kinds: &Kinds) -> Option<Stand> {
    let about = kinds.of(&robot.kind)?;
    if let Some(Sizes::Arm(arm)) = robot.sizes.clone().or_else(|| Sizes::of_kind(&robot.kind)) {
        return Some(Stand::Base(arm.base));
    }
    match robot.start[..] {
        [x, y, theta, ..] if about.drives => Some(Stand::Pose(Pose2 { x, y, theta })),
        [x, y, ..] if about.has_place() => Some(Stand::Place(Point2::new(x, y))),
        _ => None,
    }
}

impl Stand {
    pub(super) fn at(self) -> Point2 {
        match self {
            Stand::Base(at) | Stand::Place(at) => at,
            Stand::Pose(pose) => pose.position(),
        }
    }
}

/// Moves a robot's start, coordinates rounded to a nanometre.
pub(super) fn move_by(robot: &mut Resident, by: Vector2, kinds: &Kinds) -> Result<(), EditError> {
    let at = stand(robot, kinds).ok_or_else(|| EditError::NoShape(robot.name.clone()))?.at();
    put(robot, (at + by).map(tidy), None, kinds)
}

/// Puts a robot's start at a point, and turns it to a heading where one is given. A trailer turns with its car.
pub(super) fn put(robot: &mut Resident, at: Point2, heading: Option<f64>, kinds: &Kinds) -> Result<(), EditError> {
    let no_shape = || EditError::NoShape(robot.name.clone());
    let stand = stand(robot, kinds).ok_or_else(no_shape)?;
    if heading.is_some() && !matches!(stand, Stand::Pose(_)) {
        return Err(no_shape());
    }
    if let Stand::Base(_) = stand {
        let own = robot.sizes.take().or_else(|| Sizes::of_kind(&robot.kind));
        robot.sizes = own.map(|own| match own {
            Sizes::Arm(arm) => Sizes::Arm(ArmSizes { base: at, ..arm }),
            other => other,
        });
        return Ok(());
    }
    let stood = kinds.footprint(&robot.kind, &robot.start).is_some();
    (robot.start[0], robot.start[1]) = (at.x, at.y);
    if let (Some(heading), Stand::Pose(pose)) = (heading, stand) {
        robot.start[2] = heading;
        if let Some(psi) = robot.start.get_mut(3) {
            *psi += heading - pose.theta;
        }
    }
    if stood && kinds.footprint(&robot.kind, &robot.start).is_none() {
        return Err(EditError::NoConfiguration(robot.name.clone()));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::{Editor, Op};
    use super::*;
    use motion_lab_core::worlds::World;
    use std::f64::consts::FRAC_PI_2;

    fn p(x: f64, y: f64) -> Point2 {
        Point2::new(x, y)
    }

    fn drag(editor: &mut Editor, name: &str, handle: usize, to: Point2) {
        editor.apply(&Op::Drag { name: name.to_owned(), handle, to }).unwrap();
    }

    #[test]
    fn a_car_is_dragged_and_turned_by_its_handles_and_its_trailer_turns_with_it() {
        let mut world = World::lot();
        world.robots = vec![Resident::new("Hitch", "hitch", [6.5, 2.5, 0.0, 0.5])];
        let mut editor = Editor::new(world);
        // the heading's handle is a 20th of the Lot's shorter side ahead, 10 m
        let handles: Vec<Point2> = editor.handles("Hitch").iter().map(|h| h.at).collect();
        assert_eq!(handles, [p(6.5, 2.5), p(7.0, 2.5)]);
        drag(&mut editor, "Hitch", 0, p(7.0, 3.0));
        assert_eq!(editor.world().robots[0].start, [7.0, 3.0, 0.0, 0.5], "it keeps its heading");
        drag(&mut editor, "Hitch", 1, p(7.0, 4.0));
        assert_eq!(
            editor.world().robots[0].start,
            [7.0, 3.0, FRAC_PI_2, 0.5 + FRAC_PI_2],
            "and its angle at the hitch"
        );
        editor.apply(&Op::SetPose { name: "Hitch".into(), pose: Pose2 { x: 5.0, y: 4.0, theta: 0.0 } }).unwrap();
        assert_eq!(editor.world().robots[0].start, [5.0, 4.0, 0.0, 0.5]);
        assert_eq!(editor.selected_items("Hitch").len(), 3, "an outline and two handles");
    }

    #[test]
    fn an_arm_stands_on_its_base_which_its_world_says_once_it_is_moved() {
        let mut editor = Editor::new(World::workbench());
        let at = |editor: &Editor| editor.handles("Reach").iter().map(|h| h.at).collect::<Vec<_>>();
        assert_eq!(at(&editor), [p(0.0, 0.0)], "and no heading");
        editor.apply(&Op::Move { name: "Reach".into(), by: Vector2::new(0.1, -0.2) }).unwrap();
        assert_eq!(at(&editor), [p(0.1, -0.2)]);
        drag(&mut editor, "Reach", 0, p(0.5, 0.25));
        let Some(Sizes::Arm(arm)) = &editor.world().robots[0].sizes else { panic!("an arm") };
        assert_eq!((arm.base, &arm.lengths[..]), (p(0.5, 0.25), &[1.0, 1.0][..]), "as long as ever");
        assert_eq!(editor.world().robots[0].start, World::workbench().robots[0].start);
        let pose = Pose2 { x: 0.0, y: 0.0, theta: 1.0 };
        assert!(matches!(editor.apply(&Op::SetPose { name: "Reach".into(), pose }), Err(EditError::NoShape(_))));
    }
}
