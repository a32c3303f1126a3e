//! Blending between ticks: the view moves smoothly, the simulation does not.

use motion_lab_core::geometry::{Footprint, Part, Pose2};
use motion_lab_core::num::wrap;

/// The footprint a fraction `s` of the way from one tick's to the next's, for display only.
///
/// Every part's frame moves in a straight line while it turns the short way. The later footprint is returned unblended
/// where the two do not match (a trailer was just attached), or where a part jumped farther than `leap` metres (a
/// teleport).
pub fn blend(from: &Footprint, to: &Footprint, s: f64, leap: f64) -> Footprint {
    let pairs = || from.parts().iter().zip(to.parts());
    let matches = from.parts().len() == to.parts().len() && pairs().all(|(a, b)| a.shape() == b.shape());
    let near = |(a, b): (&Part, &Part)| (b.pose().position() - a.pose().position()).norm() <= leap;
    if !matches || !pairs().all(near) {
        return to.clone();
    }
    Footprint::new(pairs().map(|(a, b)| Part::new(pose_between(a.pose(), b.pose(), s), b.shape().clone())))
}

/// The pose a fraction `s` of the way from one to another, turned the short way.
pub fn pose_between(a: &Pose2, b: &Pose2, s: f64) -> Pose2 {
    Pose2::new(a.x + s * (b.x - a.x), a.y + s * (b.y - a.y), angle_between(a.theta, b.theta, s))
}

/// The angle a fraction `s` of the short way from one to another, radians.
pub fn angle_between(from: f64, to: f64, s: f64) -> f64 {
    from + s * wrap(to - from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::configuration::HitchCfg;
    use motion_lab_core::robots::{HITCH, Robot};

    fn car(x: f64, theta: f64, trailer: Option<f64>) -> Footprint {
        let robot = if trailer.is_some() { HITCH.with_trailer() } else { HITCH };
        robot.footprint(&HitchCfg { body: Pose2::new(x, 0.0, theta), trailer })
    }

    #[test]
    fn halfway_lies_halfway_the_short_way_round() {
        let middle = blend(&car(0.0, 3.0, None), &car(0.1, -3.0, None), 0.5, 1.0);
        let pose = middle.parts()[0].pose();
        assert!((pose.x - 0.05).abs() < 1e-12);
        assert!((pose.theta.abs() - std::f64::consts::PI).abs() < 1e-12, "through pi, not through 0");
    }

    #[test]
    fn leaps_and_changed_shapes_are_not_smeared() {
        let far = car(5.0, 0.0, None);
        assert_eq!(blend(&car(0.0, 0.0, None), &far, 0.5, 1.0), far);
        let towing = car(0.1, 0.0, Some(0.0));
        assert_eq!(blend(&car(0.0, 0.0, None), &towing, 0.5, 1.0), towing);
    }
}
