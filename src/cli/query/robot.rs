//! The robots that can be asked about, by name.

use std::sync::Arc;

use clap::ValueEnum;
use motion_lab::collision::{Checker, Scene};
use motion_lab::configuration::{HitchCfg, Tn};
use motion_lab::geometry::{MAX_COORDINATE, Pose2};
use motion_lab::num::wrap;
use motion_lab::robots::{HITCH, RUSTY, Reach, Robot};

use super::Question;
use super::answer::{Answer, ask};
use super::line::Asked;

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

    /// The answer to a question about this robot.
    pub fn answer(self, scene: &Arc<Scene>, question: Question, asked: &Asked) -> Result<Answer, String> {
        let with_trailer = asked.q.len() == 4;
        match self {
            RobotName::Rusty => convert(scene, RUSTY, question, asked, rusty_pose),
            RobotName::Reach => convert(scene, Reach::workbench(), question, asked, angles),
            RobotName::Choset => convert(scene, Reach::choset(), question, asked, angles),
            RobotName::Reach3 => convert(scene, Reach::redundant(), question, asked, angles),
            RobotName::Hitch if with_trailer => convert(scene, HITCH.with_trailer(), question, asked, car),
            RobotName::Hitch => convert(scene, HITCH, question, asked, car),
        }
    }
}

fn convert<R: Robot>(
    scene: &Arc<Scene>,
    robot: R,
    question: Question,
    asked: &Asked,
    configuration: fn(&[f64]) -> Result<R::Configuration, String>,
) -> Result<Answer, String> {
    let q = configuration(&asked.q)?;
    let to = asked.to.as_deref().map(configuration).transpose().map_err(|reason| format!("`to`: {reason}"))?;
    ask(&Checker::new(Arc::clone(scene), robot), question, &q, to.as_ref())
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

/// Whether the numbers are finite and the first two, a place, are within the coordinates the lab computes with.
pub fn check_place(numbers: &[f64]) -> Result<(), String> {
    finite(numbers)?;
    match numbers.iter().take(2).find(|x| x.abs() > MAX_COORDINATE) {
        Some(x) => Err(format!("coordinate {x} m: at most {MAX_COORDINATE} m in size")),
        None => Ok(()),
    }
}

fn finite(numbers: &[f64]) -> Result<(), String> {
    match numbers.iter().find(|x| !x.is_finite()) {
        Some(x) => Err(format!("{x} is not a finite number")),
        None => Ok(()),
    }
}
