//! `RobotKind`, the kinds of robots that worlds name: one table for files, figures, plots and the window.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use super::InputKind::{Drive, MoveTo, Release, SetTrailer, Teleport};
use super::{Configuration, Coordinates, HitchCfg, InputKind, R2, Sizes, T2, Tn};
use crate::geometry::Pose2;

/// A kind of robot, as worlds name it, and all that is not of its type: names, coordinates, formulas.
///
/// The lab's own are [`RobotKind::ALL`]. World files and grading know these by name. A program that adds a robot of its
/// own describes it by another one, which the simulator's plugin for the robot takes; views, formulas, plots, figures
/// and the atlas then show the robot by it. [`Kinds`](super::Kinds) holds the lab's and a program's own together.
///
/// ```
/// use motion_lab_core::configuration::RobotKind;
/// let car = RobotKind::of("hitch").unwrap();
/// assert_eq!(car.coordinates, ["x", "y", "theta", "psi"]);
/// assert_eq!(car.spaces.len(), 2); // without and with the trailer
/// assert!(car.drives && RobotKind::of("reach").is_some_and(|arm| !arm.drives));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct RobotKind {
    /// The name, which world files use.
    pub name: &'static str,
    /// The name of such a robot in the book.
    pub title: &'static str,
    /// The built-in world in which one lives, for the lab's own.
    pub home: Option<&'static str>,
    /// The coordinates of a configuration to begin with, where no world says another; `None` for a kind that has none
    /// without a place in a world.
    pub usual: Option<&'static [f64]>,
    /// What one is like that has no sizes of its own; `None` for a kind whose sizes no world says.
    pub sizes: Option<fn() -> Sizes>,
    /// The names of the chart coordinates, of the largest configuration.
    pub coordinates: &'static [&'static str],
    /// The number of leading coordinates that are lengths, metres; the others are angles, radians.
    pub lengths: usize,
    /// The start that a world file gives, in words: how many coordinates, and which.
    pub start: &'static str,
    /// The spaces of its configurations, by ascending number of coordinates.
    pub spaces: &'static [Space],
    /// Whether the first three coordinates are the pose of a body that drives forward and back.
    pub drives: bool,
    /// The inputs of a script that its robots take; any other is refused wherever the robot is.
    pub takes: &'static [InputKind],
    /// Whether it may carry a range sensor.
    pub senses: bool,
    /// Whether its wheels have encoders.
    pub has_encoders: bool,
    /// The chart difference of two configurations, angles the short way; `None` for coordinates that are none of its
    /// configurations, or of two different spaces.
    pub difference: fn(&[f64], &[f64]) -> Option<Coordinates>,
    /// A configuration as the last lines of a run show it; `None` for coordinates that are none.
    pub printed: fn(&[f64]) -> Option<String>,
}

/// A configuration space of a kind of robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Space {
    /// The number of coordinates of its configurations.
    pub coordinates: usize,
    /// The configuration and its space as mathematics; `_1` is a subscript, `^2` a superscript.
    pub formula: &'static str,
    /// Why the space is this one, in words.
    pub words: &'static str,
}

/// Kinds are the same when worlds name them the same.
impl PartialEq for RobotKind {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for RobotKind {}

fn difference<C: Configuration>(from: &[f64], to: &[f64]) -> Option<Coordinates> {
    C::from_coordinates(from)?.difference(&C::from_coordinates(to)?).ok()
}

impl RobotKind {
    /// Rusty, the disc rover.
    pub const RUSTY: RobotKind = RobotKind {
        name: "rusty",
        title: "Rusty",
        home: Some("apartment"),
        usual: None,
        sizes: Some(Sizes::of_rusty),
        coordinates: &["x", "y", "theta"],
        lengths: 2,
        start: "three: x, y, theta",
        spaces: &[Space {
            coordinates: 3,
            formula: "q = (x, y, \u{3b8}) \u{2208} SE(2)",
            words: "Position and heading. To the obstacles it is a point of the plane: a disc looks the same whichever way it faces.",
        }],
        drives: true,
        takes: &[Drive, Teleport, Release],
        senses: true,
        has_encoders: true,
        difference: difference::<Pose2>,
        printed: |q| Pose2::from_coordinates(q).map(|p| R2::new(p.x, p.y).to_string().replacen("R2", "Pose2", 1)),
    };

    /// Reach, the arm with two links.
    pub const REACH: RobotKind = RobotKind {
        name: "reach",
        title: "Reach",
        home: Some("workbench"),
        usual: Some(&[FRAC_PI_4, FRAC_PI_2]),
        sizes: Some(|| Sizes::of_arm([1.0, 1.0])),
        coordinates: &["theta1", "theta2"],
        lengths: 0,
        start: "two: th1, th2",
        spaces: &[Space {
            coordinates: 2,
            formula: "q = (\u{3b8}_1, \u{3b8}_2) \u{2208} T^2",
            words: "Two angles: a point of the torus, not the place of the tip.",
        }],
        drives: false,
        takes: &[MoveTo, Teleport, Release],
        senses: false,
        has_encoders: false,
        difference: difference::<T2>,
        printed: |q| T2::from_coordinates(q).map(|q| q.to_string()),
    };

    /// The redundant arm with three links.
    pub const REACH3: RobotKind = RobotKind {
        name: "reach3",
        usual: Some(&[0.5, 0.9, 0.7]),
        sizes: Some(|| Sizes::of_arm([0.6, 0.5, 0.4])),
        coordinates: &["theta1", "theta2", "theta3"],
        start: "three: th1, th2, th3",
        spaces: &[Space {
            coordinates: 3,
            formula: "q = (\u{3b8}_1, \u{3b8}_2, \u{3b8}_3) \u{2208} T^3",
            words: "Three angles for a tip with two coordinates: one to spare.",
        }],
        difference: difference::<Tn<3>>,
        printed: |q| Tn::<3>::from_coordinates(q).map(|q| q.to_string()),
        ..RobotKind::REACH
    };

    /// Hitch, the car that may pull a trailer.
    pub const HITCH: RobotKind = RobotKind {
        name: "hitch",
        title: "Hitch",
        home: Some("lot"),
        usual: None,
        sizes: Some(Sizes::of_hitch),
        coordinates: &["x", "y", "theta", "psi"],
        lengths: 2,
        start: "three: x, y, theta; or with a trailer four: x, y, theta, psi",
        spaces: &[
            Space {
                coordinates: 3,
                formula: "q = (x, y, \u{3b8}) \u{2208} SE(2)",
                words: "Position and heading: three numbers, though only two can be commanded.",
            },
            Space {
                coordinates: 4,
                formula: "q = (x, y, \u{3b8}, \u{3c8}) \u{2208} SE(2) \u{d7} S^1",
                words: "Position and heading of the car, and the trailer's heading psi.",
            },
        ],
        drives: true,
        takes: &[Drive, Teleport, SetTrailer, Release],
        senses: false,
        has_encoders: false,
        difference: difference::<HitchCfg>,
        printed: |q| {
            HitchCfg::from_coordinates(q).map(|q| match q.trailer {
                None => q.body.to_string(),
                Some(_) => q.to_string(),
            })
        },
    };

    /// The lab's kinds.
    pub const ALL: [&'static RobotKind; 4] =
        [&RobotKind::RUSTY, &RobotKind::REACH, &RobotKind::REACH3, &RobotKind::HITCH];

    /// The lab's kind of this name.
    pub fn of(name: &str) -> Option<&'static RobotKind> {
        RobotKind::ALL.into_iter().find(|kind| kind.name == name)
    }

    /// The space of configurations with this number of coordinates.
    pub fn space(&self, coordinates: usize) -> Option<&'static Space> {
        self.spaces.iter().find(|space| space.coordinates == coordinates)
    }

    /// Whether the first two coordinates are a place in the world: those of a body that drives, or any called x and y.
    pub fn has_place(&self) -> bool {
        self.drives || self.coordinates.starts_with(&["x", "y"])
    }

    /// The unit of a coordinate: `m` or `rad`.
    pub fn unit_of(&self, coordinate: usize) -> &'static str {
        if coordinate < self.lengths { "m" } else { "rad" }
    }

    /// Whether it is an arm: every coordinate is a joint angle.
    pub fn is_arm(&self) -> bool {
        self.lengths == 0 && !self.drives
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_space_fits_its_kind() {
        for kind in RobotKind::ALL {
            assert_eq!(RobotKind::of(kind.name).map(|k| k.name), Some(kind.name));
            let counts: Vec<usize> = kind.spaces.iter().map(|space| space.coordinates).collect();
            assert!(counts.is_sorted() && counts.last() == Some(&kind.coordinates.len()), "{}", kind.name);
            for &count in &counts {
                let q: Vec<f64> = (0..count).map(|k| 0.1 * k as f64).collect();
                assert!((kind.printed)(&q).is_some(), "{} of {count}", kind.name);
                let zero = (kind.difference)(&q, &q).unwrap();
                assert!(zero.len() == count && zero.iter().all(|d| *d == 0.0), "{}", kind.name);
            }
            assert!((kind.printed)(&[]).is_none() && kind.space(0).is_none());
        }
        assert!(RobotKind::of("tricycle").is_none());
        assert!(RobotKind::REACH3.is_arm() && !RobotKind::HITCH.is_arm());
        let sled = RobotKind { coordinates: &["x", "y"], ..RobotKind::REACH };
        assert!(RobotKind::HITCH.has_place() && !RobotKind::REACH.has_place() && sled.has_place());
    }
}
