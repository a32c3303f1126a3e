//! Runs as data: the input script, the frames, their digests, where two runs differ, and the log as a file.

mod comparison;
mod difference;
mod digest;
mod divergence;
mod field;
#[cfg(test)]
mod fixture;
mod frame;
mod log;
mod mcap;
mod script;
mod script_text;

pub use comparison::Comparison;
pub use difference::SetupDifference;
pub use digest::{Digest, RunDigest};
pub use divergence::{Divergence, first_divergence};
pub use field::Value;
pub use frame::{DT, Frame, RobotScan, RobotState};
pub use log::Log;
pub use mcap::{
    DamageKind, DamagedLog, EXPORT_PROFILE, FORMAT_VERSION, GENERATOR, LogError, LogWriter, ReadLog, TICK_NANOSECONDS,
};
pub use script::{Event, Quantized, RobotInput, SCRIPT_VERSION, Script};
pub use script_text::{MAX_CHANNEL, MAX_COORDINATES, MAX_EVENTS, ScriptError, ScriptProblem};
