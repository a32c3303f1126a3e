//! Recording and replaying runs: the headless app, running the one schedule.
//!
//! ```
//! use motion_lab_core::prelude::*;
//! use motion_lab_sim::recording::Run;
//! use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
//!
//! let config = TourConfig { ticks: 20, ..TourConfig::default() };
//! let log = Run::record(config, BOOK_SEED)?;
//! assert_eq!(Run::replay(&log)?, log.frames()); // every f64 to the last bit
//! # Ok::<(), motion_lab_sim::recording::RunError>(())
//! ```

mod final_lines;
mod frame_list;
mod paranoid;
mod recorder;
mod run;
mod run_parts;
mod tick_digests;
mod verification;

pub use crate::run::RunInput;
pub use final_lines::{final_lines, final_lines_with, printed_as, printed_configuration};
pub use frame_list::{FrameList, FramesError, MAX_FRAME_BYTES};
pub use paranoid::{ParanoidRun, UnrepeatedControl, UnrepeatedTick};
pub use recorder::{Recorder, RunError};
pub use run::Run;
pub use run_parts::{PartsError, RunParts};
pub use tick_digests::TickDigests;
pub use verification::{Verification, verify, verify_with_robots};
