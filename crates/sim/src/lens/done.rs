//! What hints ask for that is done in a lens which stands still.

use std::sync::Arc;

use crate::anatomy::{Anatomy, Tab};
use crate::manifest::HintTask;
use motion_lab_core::collision::EdgeVerdict;
use motion_lab_core::configuration::{AnyConfiguration, Configuration};
use motion_lab_core::geometry::Point2;
use motion_lab_core::num::sin;

/// Distance within which two tips are one, metres.
const ONE_TIP: f64 = 0.05;

/// Distance from which on a robot is near an obstacle, metres.
const NEAR: f64 = 0.02;

/// Sine of the elbow's angle from which on an arm is bent to a side.
const MIN_BEND: f64 = 0.15;

/// What the reader has done between two moments of the query anatomy, a press and its release or a frame and the next:
/// the robot was moved until it touches, the motion changed until it hits. Another world, robot or tab is no task.
pub fn done_between(before: &Anatomy, now: &Anatomy) -> Vec<HintTask> {
    let is_same = Arc::ptr_eq(before.world(), now.world()) && before.checker().robot() == now.checker().robot();
    let hits = || now.sweep().is_ok_and(|sweep| matches!(sweep.verdict, EdgeVerdict::Hit { .. }));
    let is_moved = is_same && before.q() != now.q();
    let touch = is_moved && now.intersects();
    let is_near = || now.nearest().first().is_some_and(|pair| pair.witness.dist > 0.0 && pair.witness.dist <= NEAR);
    let near = is_moved && before.tab == Tab::Witness && now.tab == Tab::Witness && is_near();
    let is_swept = before.tab == Tab::Swept && now.tab == Tab::Swept;
    let is_stepped = is_same && before.step() != now.step();
    let hit = is_swept && is_stepped && hits();
    let has_free_ends = || now.sweep().is_ok_and(|sweep| sweep.from_free && sweep.to_free);
    let free_ends = is_swept && (is_stepped || is_moved) && hits() && has_free_ends();
    let done =
        [(touch, HintTask::Touch), (near, HintTask::Near), (hit, HintTask::Hit), (free_ends, HintTask::FreeEnds)];
    done.into_iter().filter(|(is_done, _)| *is_done).map(|(_, task)| task).collect()
}

/// Whether the last point of a trace has the tip of an earlier one that is another point of the torus.
pub fn have_one_tip(anatomy: &Anatomy, trace: &[AnyConfiguration]) -> bool {
    let robot = anatomy.checker().robot();
    let tip = |q: &AnyConfiguration| -> Point2 { robot.reference(q) };
    let Some((last, earlier)) = trace.split_last().filter(|(last, _)| matches!(last, AnyConfiguration::T2(_))) else {
        return false;
    };
    // where the arm is straight or folded, a little to either side has nearly one tip
    let bend = |q: &AnyConfiguration| q.coordinates().last().map_or(0.0, |angle| sin(*angle));
    let are_two = |a: f64, b: f64| a * b < 0.0 && a.abs() > MIN_BEND && b.abs() > MIN_BEND;
    earlier.iter().any(|q| are_two(bend(q), bend(last)) && (tip(q) - tip(last)).norm() < ONE_TIP)
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::configuration::T2;

    #[test]
    fn two_points_with_one_tip_are_two_bends_of_the_elbow() {
        let anatomy = Anatomy::default();
        let at = |th1: f64, th2: f64| AnyConfiguration::T2(T2::new(th1, th2));
        // for links of equal length the other elbow is (th1 + th2, -th2)
        let (one, other) = (at(0.4, 0.9), at(1.3, -0.9));
        assert!(have_one_tip(&anatomy, &[one, at(0.0, 0.1), other]));
        assert!(!have_one_tip(&anatomy, &[other, at(0.0, 0.1), one, at(0.2, 0.9)]), "only where it has come to");
        assert!(!have_one_tip(&anatomy, &[one, one]) && !have_one_tip(&anatomy, &[one, at(1.3, -0.7)]));
        assert!(!have_one_tip(&anatomy, &[at(0.4, 0.02), at(0.4, -0.02)]), "it has only passed a straight arm");
        assert!(!have_one_tip(&anatomy, &[]));
    }

    #[test]
    fn a_task_is_done_by_the_reader_and_not_by_a_scene() {
        // the chapter's motion hits the block, and its arm touches it where the elbow is bent less
        let start = Anatomy::default();
        let swept = start.clone().with_tab(Tab::Swept);
        assert_eq!(done_between(&start, &swept), [], "the tab was only opened");
        let with = |of: &dyn Fn(&mut Anatomy)| {
            let mut anatomy = swept.clone();
            of(&mut anatomy);
            anatomy
        };
        assert_eq!(done_between(&swept, &with(&|a| a.set_step(0, -1.0))), [HintTask::Hit, HintTask::FreeEnds]);
        assert_eq!(done_between(&swept, &with(&|a| a.set_step(0, -0.4))), [HintTask::Hit], "it ends in contact");
        assert_eq!(done_between(&swept, &with(&|a| a.set_step(0, 0.01))), [], "a step that is free");
        assert_eq!(done_between(&swept, &with(&|a| a.set_coordinate(1, 1.2))), [HintTask::Touch]);
        assert_eq!(done_between(&start, &start.clone().with_tab(Tab::Witness)), []);
        let witness = start.clone().with_tab(Tab::Witness);
        let bent = |th2: f64| {
            let mut anatomy = witness.clone();
            anatomy.set_coordinate(1, th2);
            anatomy
        };
        // it touches below 1.4009: at 1.42 it is 7 mm off, at pi/2 61 mm
        assert_eq!(done_between(&witness, &bent(1.42)), [HintTask::Near]);
        assert_eq!(done_between(&witness, &bent(1.5)), []);
        assert_eq!(done_between(&witness, &bent(1.39)), [HintTask::Touch]);
        let thick = with(&|a| a.set_thick_links(true));
        assert_eq!(done_between(&thick, &with(&|a| a.set_coordinate(1, 1.2))), [], "another robot");
    }
}
