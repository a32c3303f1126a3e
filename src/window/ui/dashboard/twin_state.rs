//! `AskedTwin`, what was asked for with a robot's twin: another configuration at its position.

use crate::window::ui::Command;
use motion_lab_core::collision::Checker;
use motion_lab_core::configuration::{AnyConfiguration, Configuration};
use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::anatomy::{SweptMotion, straight_way};
use motion_lab_sim::run::{Quantized, RobotInput};
use motion_lab_sim::simulation::{RobotCommand, TransportCommand};

/// What was asked for with a robot's twin.
#[derive(Clone, Debug)]
pub struct AskedTwin {
    /// The robot's name.
    pub robot: String,
    /// The straight motion of an arm to its other elbow; `None` for a car, whose ghost is shown.
    pub way: Option<ElbowFlip>,
}

/// An arm's straight motion to its other elbow.
#[derive(Clone, Debug)]
pub struct ElbowFlip {
    /// What the arm may touch.
    pub checker: Checker<AnyRobot>,
    /// The motion with its verdict.
    pub sweep: SweptMotion,
    /// The ticks done of it.
    pub done: u32,
    /// The ticks that it takes; 0 of a way that is not free.
    pub ticks: u32,
    /// The tick by which the arm is where it was sent last.
    pub due: u64,
    /// Whether the run pauses again where it ends.
    pub pauses: bool,
    /// Whether it goes a tick in each frame, since a run as fast as possible plays many.
    pub steps: bool,
}

impl AskedTwin {
    /// Whether it is the motion of the arm with this name.
    pub fn is_way_of(&self, arm: &str) -> bool {
        self.robot == arm && self.way.is_some()
    }

    /// What blocks an arm's way to its other elbow, in words; `None` of a way that is free, or not an arm's.
    pub fn blocked(&self) -> Option<String> {
        self.way.as_ref().filter(|way| way.ticks == 0).map(ElbowFlip::verdict)
    }
}

impl ElbowFlip {
    /// The verdict on the motion in words.
    pub fn verdict(&self) -> String {
        straight_way(&self.checker, &self.sweep)
    }

    /// Where the arm was sent last.
    pub fn at(&self) -> AnyConfiguration {
        self.sweep.at(if self.ticks == 0 { 0.0 } else { f64::from(self.done) / f64::from(self.ticks) })
    }

    /// Asks for where the arm is sent now, by the next tick.
    pub fn send(&mut self, robot: &str, tick: u64, commands: &mut Vec<Command>) {
        let target: Option<Vec<Quantized>> =
            self.at().coordinates().iter().map(|angle| Quantized::try_new(*angle)).collect();
        let input = |target| RobotCommand { robot: robot.to_owned(), input: RobotInput::MoveTo(target) };
        commands.extend(target.map(|target| Command::from(input(target))));
        self.due = tick + 1;
        if self.steps {
            commands.push(Command::from(TransportCommand::Step));
        }
    }
}
