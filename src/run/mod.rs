//! Runs as data: the input script, the frames, the log.

mod frame;
mod script;

pub use frame::{Digest, Frame, RobotState};
pub use script::{Event, Quantized, RobotInput, SCRIPT_VERSION, Script};
