//! Towing: the channels by which a robot on wheels follows a point that pulls at its body, such as the pointer.
//!
//! [`Tow::command`] is a pure function of the robot, its configuration and the [`Tow`]. It asks for nothing that a
//! driver could not ask for, [`RobotInput::Drive`](crate::run::RobotInput::Drive) carries it, and a run with a tow is
//! made again from its script like any other.
//!
//! A rover turns to the point and goes. A car follows the arc on which its grip comes there, ahead or backing up,
//! whichever is shorter: pure pursuit from the rear axle. Within the turning circle no arc does: abeam, the car only
//! steers.
//!
//! ```
//! use motion_lab_core::prelude::*;
//! use motion_lab_core::robots::AnyRobot;
//! use motion_lab_sim::tow::{Tow, TowState};
//!
//! let (car, q) = AnyRobot::of_kind("hitch", &[0.0, 0.0, 0.0]).unwrap();
//! let tow = |x, y| Tow::new(0.0, Point2::new(x, y)).command(&car, &q).unwrap();
//! assert_eq!(tow(5.0, 0.0).channels, [128, 0]); // ahead at full speed
//! assert!(tow(-5.0, 0.0).channels[0] < 0); // it backs up
//! assert_eq!((tow(0.0, 3.0).channels, tow(0.0, 3.0).state), ([0, 128], TowState::OnlySteers)); // no car slides
//! ```

mod car;
mod command;
mod line;
mod pull;
mod rover;
#[cfg(test)]
mod tests;

pub use command::{TowCommand, TowState};
pub use line::{Tow, grip_at};
