//! `HeldTow`, the robot that the pointer tows.

use motion_lab_core::geometry::{Point2, Vector2};
use motion_lab_core::num::greater;
use motion_lab_core::robots::TICK;
use motion_lab_sim::tow::Tow;

/// What of a robot is gripped by a press of its body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gripped {
    /// Where on its axis, metres ahead of its reference point.
    pub grip: f64,
    /// From where it was pressed to there, metres: as far from the pointer is the place that it is pulled to.
    pub off: Vector2,
}

/// A robot that the pointer tows.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldTow {
    /// The robot's name.
    pub robot: String,
    /// The channels that the robot is to hold, from -128 to 128, the maximum.
    pub channels: (i16, i16),
    /// Whether the robot has been driven since the drag began: what can be undone of it is noted.
    pub has_driven: bool,
    by: Gripped,
    /// Whether the pointer held it in the last frame.
    is_held: bool,
    /// The tick of the last frame, and how many passed before it.
    tick: Option<u64>,
    passed: u64,
}

impl HeldTow {
    /// A robot that was gripped just now.
    pub fn new(robot: &str, by: Gripped) -> Self {
        let (robot, channels) = (robot.to_owned(), (0, 0));
        HeldTow { robot, channels, has_driven: false, by, is_held: true, tick: None, passed: 0 }
    }

    /// The line by which the pointer pulls.
    pub fn line_to(&self, pointer: Point2) -> Tow {
        Tow { grip: self.by.grip, aim: pointer + self.by.off, held: self.held() }
    }

    /// The pointer is still there: the robot is to hold these channels.
    pub fn hold(&mut self, [ahead, left]: [i16; 2]) {
        self.channels = (ahead, left);
        self.is_held = true;
    }

    /// Whether the run has gone back since the last frame.
    pub fn has_gone_back(&self, tick: u64) -> bool {
        self.tick.is_some_and(|before| tick < before)
    }

    /// The tow in the next frame, at `tick`; `None` where the pointer has let go, or the run has gone back.
    pub fn go_on(self, tick: u64) -> Option<HeldTow> {
        let has_gone_back = self.has_gone_back(tick);
        let passed = self.tick.map_or(0, |before| tick.saturating_sub(before));
        let next = HeldTow { is_held: false, tick: Some(tick), passed, ..self };
        (self.is_held && !has_gone_back).then_some(next)
    }

    /// How long a command is held, seconds. It takes effect a frame after the robot was seen.
    fn held(&self) -> f64 {
        TICK * greater(2.0 * self.passed as f64 - 1.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tow_ends_where_the_pointer_lets_go_or_the_run_goes_back() {
        let by = Gripped { grip: 1.0, off: Vector2::new(0.0, 0.5) };
        let mut tow = HeldTow::new("Hitch", by).go_on(10).expect("gripped just now");
        assert_eq!(tow.line_to(Point2::new(3.0, 4.0)), Tow { grip: 1.0, aim: Point2::new(3.0, 4.5), held: 0.05 });
        assert_eq!(tow.clone().go_on(11), None, "the pointer let go");
        tow.hold([3, -4]);
        assert_eq!(tow.channels, (3, -4));
        assert_eq!(tow.clone().go_on(9), None, "the run has gone back");
        // of three ticks a frame, five pass from one look at the robot to the next command's end
        let later = tow.go_on(13).expect("held");
        assert!((later.line_to(Point2::origin()).held - 0.25).abs() < 1e-12);
    }
}
