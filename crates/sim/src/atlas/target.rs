//! The configuration that a click or a drag on the plane asks for.

use super::{Atlas, TeleportRefusal};
use motion_lab_core::configuration::{AnyConfiguration, Configuration};
use motion_lab_core::geometry::Point2;
use motion_lab_core::num::{hypot, wrap};

impl Atlas {
    /// The configuration of robot number `index` for a click at `to`, or for a drag from there to a heading, radians.
    ///
    /// - An arm's tip goes there, by inverse kinematics: on its present elbow side if that is free, else on the other
    ///   side if that is free, else on the present one. The heading is ignored.
    /// - Other robots' reference points go there; a trailer turns with its car.
    ///
    /// The configuration may be in contact: [`teleport`](Atlas::teleport) checks that. `None` for an unknown robot.
    ///
    /// # Errors
    /// [`TeleportRefusal::OutOfReach`] for a point that an arm's tip cannot reach.
    pub fn target(
        &self,
        index: usize,
        to: Point2,
        heading: Option<f64>,
    ) -> Option<Result<AnyConfiguration, TeleportRefusal>> {
        let resident = self.robots().get(index)?;
        let (robot, q) = (resident.robot, resident.q);
        if let Some((base, [least, most])) = robot.annulus() {
            let elbow_down = q.coordinates().last().is_none_or(|angle| *angle >= 0.0);
            let sides = [elbow_down, !elbow_down].map(|side| robot.dragged(&q, to, side));
            // a point out of reach was clamped
            let off = robot.reference(&sides[0]) - to;
            if hypot(off.x, off.y) > 1e-9 {
                let away = to - base;
                return Some(Err(TeleportRefusal::OutOfReach { least, most, wanted: hypot(away.x, away.y) }));
            }
            let checker = self.checker(index)?;
            return Some(Ok(sides.into_iter().find(|side| checker.is_free(side)).unwrap_or(sides[0])));
        }
        let moved = robot.dragged(&q, to, true);
        let Some(heading) = heading.filter(|h| h.is_finite()) else { return Some(Ok(moved)) };
        let turn = wrap(heading - q.coordinates()[2]);
        let turned = moved.with(2, heading);
        Some(Ok(match q.coordinates().get(3) {
            Some(psi) => turned.with(3, psi + turn),
            None => turned,
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::worlds::{Resident, World};

    #[test]
    fn an_arms_tip_is_clicked_onto_the_free_side() {
        let atlas = Atlas::new(World::workbench());
        let resident = &atlas.robots()[0];
        // at the post's height on the left the arm passes near the post with its elbow down, but not with its elbow up
        let mut both = 0;
        for k in 0..200 {
            let (s, c) = motion_lab_core::num::sin_cos(f64::from(k) * 0.1);
            let to = Point2::new(1.3 * c, 1.3 * s);
            let q = atlas.target(0, to, None).unwrap().unwrap();
            assert!((resident.robot.reference(&q) - to).norm() < 1e-9);
            let checker = atlas.checker(0).unwrap();
            let sides = [true, false].map(|side| checker.is_free(&resident.robot.dragged(&resident.q, to, side)));
            assert_eq!(checker.is_free(&q), sides[0] || sides[1], "{to}: free if either is");
            both += u32::from(!sides[0] && sides[1]);
        }
        assert!(both > 0, "somewhere only the other side is free");
        let refusal = atlas.target(0, Point2::new(2.0, 1.0), None).unwrap().unwrap_err();
        assert_eq!(refusal.to_string(), "out of reach: 2.24 m from the base, and the tip gets from 0.00 to 2.00 m");
        assert!(atlas.target(1, Point2::origin(), None).is_none());
    }

    #[test]
    fn a_car_turns_with_its_trailer() {
        let mut world = World::lot();
        world.robots = vec![Resident::new("Hitch", "hitch", [6.5, 2.5, 0.2, 0.5])];
        let atlas = Atlas::new(world);
        let q = atlas.target(0, Point2::new(8.0, 3.0), Some(-3.0)).unwrap().unwrap();
        let c = q.coordinates();
        assert_eq!((c[0], c[1], c[2]), (8.0, 3.0, -3.0));
        assert!((wrap(c[3] - c[2]) - 0.3).abs() < 1e-12, "the angle at the hitch stays");
        let kept = atlas.target(0, Point2::new(8.0, 3.0), None).unwrap().unwrap();
        assert_eq!(&kept.coordinates()[2..], [0.2, 0.5]);
    }
}
