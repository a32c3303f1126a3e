//! Runs as data: the input script, the frames, their digests, where two runs differ, and the log as a file.

mod comparison;
mod difference;
mod digest;
mod divergence;
mod field;
#[cfg(test)]
pub(crate) mod fixture;
mod frame;
mod log;
mod mcap;
mod quantized;
mod recipe;
mod script;
mod script_check;
mod script_error;
mod script_text;
mod stats;
mod world_change;

pub use comparison::{Comparison, Difference, DifferingSecond};
pub use difference::SetupDifference;
pub use digest::{Digest, DigestError, RunDigest};
pub use divergence::{Divergence, DivergingScan, first_divergence};
pub use field::Value;
pub(crate) use frame::ObstacleDifference;
pub use frame::{DT, Frame, ObstacleState, ObstacleStates, RobotScan, RobotState, seconds};
pub use log::{DIGEST_TICKS, Log, LogKind, MAX_ROBOTS_IN_FULL, Recorded, SecondDigests};
pub(crate) use mcap::check_recordable;
pub use mcap::{
    DIGEST_FORMAT_VERSION, DamageKind, DamagedLog, EXPORT_PROFILE, FORMAT_VERSION, FORMAT_VERSION_WITH_CHANGES,
    FORMAT_VERSION_WITH_MANY_CHANGES, GENERATOR, LogError, LogWriter, MAX_REPEATED_CHANGES, OtherRun, ReadLog,
    TICK_NANOSECONDS,
};
pub use quantized::Quantized;
pub use recipe::{Recipe, RunInput};
pub use script::{Event, RobotInput, SCRIPT_VERSION, SCRIPT_VERSION_WITH_CHANGES, Script};
pub(crate) use script_check::ChangedWorlds;
#[doc(hidden)]
pub use script_check::check_target;
pub use script_error::{
    MAX_CHANGED_SHAPES, MAX_CHANNEL, MAX_COORDINATES, MAX_EVENTS, ScriptError, ScriptProblem, UnfitInput,
};
pub use stats::{
    LeastClearance, Quantity, RobotStats, RunStats, Series, SeriesGatherer, StatsColumn, StatsGatherer, StatsNumber,
};
pub use world_change::{WorldChange, WorldEvent};
