//! Runs as data: the input script, the frames, the log.

mod frame;
mod log;
mod script;

pub use frame::{Digest, Frame, RobotScan, RobotState};
pub use log::{DT, Log};
pub use script::{Event, Quantized, RobotInput, SCRIPT_VERSION, Script};
