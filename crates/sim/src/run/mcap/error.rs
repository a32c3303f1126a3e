//! `LogError` and `DamagedLog`: why a log is refused, and what is left of a damaged one.

use std::fmt;

use super::ReadLog;
use crate::run::{Digest, LogKind, ScriptError};
use crate::tour::ConfigError;
use motion_lab_core::one_line::{OneLine, quoted};

/// Why a log can't be written, or a file can't be read as one.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LogError {
    /// The output failed.
    #[error("the log can't be written: {0}")]
    Io(#[from] std::io::Error),
    /// The run's settings are out of range.
    #[error("the configuration: {0}")]
    Config(#[from] ConfigError),
    /// The script is out of range, or names a robot that the run does not have.
    #[error("the script: {0}")]
    Script(#[from] ScriptError),
    /// A frame out of order.
    #[error("the frame of tick {found} came where that of tick {expected} belongs")]
    Order {
        /// The tick that is due.
        expected: u64,
        /// The frame's tick.
        found: u64,
    },
    /// A frame after the last tick of the run.
    #[error("tick {tick} lies beyond the run's {ticks} ticks")]
    Beyond {
        /// The frame's tick.
        tick: u64,
        /// The ticks configured.
        ticks: u64,
    },
    /// A frame whose robots are not the run's, by ascending id.
    #[error("tick {tick}: the frame's robots or scans are not those of the run's {robots} robots by ascending id")]
    Robots {
        /// The frame's tick.
        tick: u64,
        /// How many robots the run has.
        robots: usize,
    },
    /// A frame whose obstacles are not ones of the run's worlds in ascending order.
    #[error("tick {tick}: the frame's obstacles are not ones of the run's worlds by ascending number")]
    Obstacles {
        /// The frame's tick.
        tick: u64,
    },
    /// A NaN in a frame.
    #[error("tick {tick}, robot {robot}: {field} is not a number")]
    NotANumber {
        /// The frame's tick.
        tick: u64,
        /// The robot's id.
        robot: u32,
        /// The name of the value.
        field: String,
    },
    /// A log finished before its last tick.
    #[error("{recorded} of {ticks} ticks are recorded")]
    Incomplete {
        /// The ticks recorded.
        recorded: u64,
        /// The ticks configured.
        ticks: u64,
    },
    /// The file is not an MCAP file.
    #[error("this is not a run log: it does not begin as an MCAP file does")]
    NotALog,
    /// The file is an export for viewers, made from a log.
    #[error("this is an export for viewers, not the run log itself")]
    Export,
    /// A page that holds no run, or one that can't be read.
    #[error("this is a page, and {0}")]
    Page(&'static str),
    /// A log of digests, where one with frames is needed.
    #[error("this is a digest log, which holds no frames")]
    NoFrames,
    /// A log in a version of the format that this program does not read.
    #[error("the log has format version {}; this program reads versions {old:?}, {new:?} and {digests:?}",
        quoted(.0), old = super::FORMAT_VERSION, new = super::FORMAT_VERSION_WITH_CHANGES,
        digests = super::DIGEST_FORMAT_VERSION)]
    Version(String),
    /// The part before the first tick is sealed, but something in it is not valid.
    #[error("{item} in the log: {}", OneLine(.reason))]
    Content {
        /// The attachment or metadata entry.
        item: String,
        /// The reason.
        reason: String,
    },
    /// The part before the first tick is sealed, but not what this format prescribes.
    #[error("the log was not written by motion-lab: from byte {offset} on it is not what its own content prescribes")]
    Foreign {
        /// The first byte that differs.
        offset: u64,
    },
    /// The file was cut or changed after it was written. Everything sealed is recovered.
    #[error("{0}")]
    Damaged(Box<DamagedLog>),
    /// The file is whole, but its end seals the digest of another run.
    #[error("{0}")]
    OtherRun(Box<OtherRun>),
}

/// A log that was changed and sealed again, but for the run's digest in its end.
#[derive(Debug)]
#[non_exhaustive]
pub struct OtherRun {
    /// What the file holds.
    pub read: ReadLog,
    /// The digest that its end seals.
    pub sealed: Digest,
    /// The digest of what it holds.
    pub held: Digest,
}

impl fmt::Display for OtherRun {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let OtherRun { sealed, held, .. } = self;
        write!(f, "the log was changed after it was recorded: its end seals the run digest {sealed}, ")?;
        write!(f, "and the seed, settings, worlds, script and frames in it have {held}")
    }
}

/// What is left of a file that was cut or changed.
#[derive(Debug)]
#[non_exhaustive]
pub struct DamagedLog {
    /// The sealed beginning, equal to the original's to the last bit; `None` when the part before the first tick is
    /// damaged.
    pub recovered: Option<ReadLog>,
    /// The number of sealed ticks.
    pub sealed_ticks: u64,
    /// The offset at which the sealed bytes end. A run that was cut short resumes here.
    pub first_unsealed_offset: u64,
    /// What probably happened.
    pub kind: DamageKind,
}

/// What probably happened to a damaged file: a best guess.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DamageKind {
    /// The end is missing: recording was stopped, or the file was copied in part.
    Cut,
    /// Bytes were changed, or added at the end.
    Changed,
}

impl DamageKind {
    fn in_words(self) -> &'static str {
        match self {
            DamageKind::Cut => "is cut off",
            DamageKind::Changed => "has been changed",
        }
    }
}

impl fmt::Display for DamagedLog {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = self.recovered.as_ref().map(|read| read.log.kind());
        let what = if kind == Some(LogKind::Digests) { "the digest log" } else { "the log" };
        write!(f, "{what} {} after byte {}: ", self.kind.in_words(), self.first_unsealed_offset)?;
        match (&self.recovered, self.sealed_ticks) {
            (None, _) => write!(f, "the part before the first tick is not whole, so nothing can be recovered"),
            (Some(read), n) => {
                let of = if kind == Some(LogKind::Digests) { "the digests of " } else { "" };
                write!(f, "{of}{n} of {} ticks are whole", read.log.recipe.config.ticks)
            }
        }
    }
}
