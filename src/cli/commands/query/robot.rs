//! The robots that can be asked about, by name.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use std::sync::Arc;

use clap::ValueEnum;
use motion_lab::collision::{Checker, Scene};
use motion_lab::configuration::{AnyConfiguration, HitchCfg, RobotKind, Tn};
use motion_lab::geometry::Pose2;
use motion_lab::num::wrap;
use motion_lab::robots::{AnyRobot, HITCH, RUSTY, Reach};
use motion_lab::worlds::World;

use super::dimensions::Measured;
use super::inquiry::Inquiry;
use super::line::{Asked, check_place, finite};

/// A robot by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum RobotName {
    /// The disc of radius 0.11 m: x, y or x, y, theta.
    Rusty,
    /// The two-link arm with 3 cm capsule links: th1, th2.
    Reach,
    /// The same arm without thickness: th1, th2.
    Choset,
    /// The three-link arm: th1, th2, th3.
    Reach3,
    /// The car: x, y, theta; with the trailer x, y, theta, psi.
    Hitch,
}

impl RobotName {
    /// The names, for messages.
    pub fn list() -> String {
        let names = Self::value_variants().iter().filter_map(|r| r.to_possible_value());
        names.map(|v| v.get_name().to_owned()).collect::<Vec<_>>().join(", ")
    }

    /// The built-in world it lives in.
    pub fn home(self) -> &'static str {
        match self {
            RobotName::Rusty => "apartment",
            RobotName::Reach | RobotName::Choset | RobotName::Reach3 => "workbench",
            RobotName::Hitch => "lot",
        }
    }

    /// Its kind, as worlds name it.
    pub fn kind(self) -> &'static str {
        match self {
            RobotName::Rusty => RobotKind::RUSTY.name,
            RobotName::Reach | RobotName::Choset => RobotKind::REACH.name,
            RobotName::Reach3 => RobotKind::REACH3.name,
            RobotName::Hitch => RobotKind::HITCH.name,
        }
    }

    /// The robot with a configuration: these numbers.
    ///
    /// Without numbers, arms of two links take the book's configuration. Other robots start where the world's resident
    /// of their kind does; where there is none, the arm of three links takes a default and the others are refused.
    pub fn at(self, numbers: Option<&[f64]>, world: &World) -> Result<(AnyRobot, AnyConfiguration), String> {
        let kind = self.kind();
        let resident = world.robots.iter().find(|r| r.kind == kind).map(|r| r.start.clone());
        let numbers = match (numbers, self) {
            (Some([x, y]), RobotName::Rusty) => vec![*x, *y, 0.0],
            (Some(numbers), _) => numbers.to_vec(),
            (None, RobotName::Reach | RobotName::Choset) => vec![FRAC_PI_4, FRAC_PI_2],
            (None, RobotName::Reach3) => resident.unwrap_or(vec![0.5, 0.9, 0.7]),
            (None, _) => resident.ok_or_else(|| format!("no {kind} lives there: give its configuration with --q"))?,
        };
        if matches!(self, RobotName::Rusty | RobotName::Hitch) {
            check_place(&numbers)?;
        }
        let (robot, q) =
            AnyRobot::of_kind(kind, &numbers).ok_or_else(|| format!("{numbers:?} is no configuration of a {kind}"))?;
        let robot = if self == RobotName::Choset { AnyRobot::Reach(Reach::choset()) } else { robot };
        Ok((robot, q))
    }

    /// The robot, of its kind's own sizes.
    pub fn model(self) -> AnyRobot {
        match self {
            RobotName::Rusty => AnyRobot::Rusty(RUSTY),
            RobotName::Reach => AnyRobot::Reach(Reach::workbench()),
            RobotName::Choset => AnyRobot::Reach(Reach::choset()),
            RobotName::Reach3 => AnyRobot::Reach3(Reach::redundant()),
            RobotName::Hitch => AnyRobot::Hitch(HITCH),
        }
    }
}

/// The answer to an inquiry about a robot. A car has its trailer if it is asked about four coordinates.
pub(super) fn ask_about<I: Inquiry>(
    model: &AnyRobot,
    scene: &Arc<Scene>,
    inquiry: &I,
    asked: &Asked,
) -> Result<I::Answer, String> {
    match *model {
        AnyRobot::Rusty(rover) => convert(scene, rover, inquiry, asked, rusty_pose),
        AnyRobot::Reach(arm) => convert(scene, arm, inquiry, asked, angles),
        AnyRobot::Reach3(arm) => convert(scene, arm, inquiry, asked, angles),
        AnyRobot::Hitch(towing) if asked.q.len() == 4 => convert(scene, towing.with_trailer(), inquiry, asked, car),
        AnyRobot::Hitch(alone) => convert(scene, alone.without_trailer(), inquiry, asked, car),
    }
}

fn convert<R: Measured, I: Inquiry>(
    scene: &Arc<Scene>,
    robot: R,
    inquiry: &I,
    asked: &Asked,
    configuration: fn(&[f64]) -> Result<R::Configuration, String>,
) -> Result<I::Answer, String> {
    let q = configuration(&asked.q)?;
    let to = asked.to.as_deref().map(configuration).transpose().map_err(|reason| format!("`to`: {reason}"))?;
    inquiry.ask(&Checker::new(Arc::clone(scene), robot), &q, to.as_ref())
}

fn angles<const N: usize>(numbers: &[f64]) -> Result<Tn<N>, String> {
    let angles = numbers.try_into().map_err(|_| format!("{} numbers: this arm has {N} joint angles", numbers.len()))?;
    finite(numbers)?;
    Ok(Tn(angles).wrapped())
}

fn rusty_pose(numbers: &[f64]) -> Result<Pose2, String> {
    let pose = match *numbers {
        [x, y] => Pose2::new(x, y, 0.0),
        [x, y, theta] => Pose2::new(x, y, theta),
        _ => return Err(format!("{} numbers: a rusty has x, y or x, y, theta", numbers.len())),
    };
    check_place(numbers)?;
    Ok(pose)
}

fn car(numbers: &[f64]) -> Result<HitchCfg, String> {
    let (body, trailer) = match *numbers {
        [x, y, theta] => (Pose2::new(x, y, theta), None),
        [x, y, theta, psi] => (Pose2::new(x, y, theta), Some(wrap(psi))),
        _ => {
            return Err(format!(
                "{} numbers: a hitch has x, y, theta or, with the trailer, x, y, theta, psi",
                numbers.len()
            ));
        }
    };
    check_place(numbers)?;
    Ok(HitchCfg { body, trailer })
}
