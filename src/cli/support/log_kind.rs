//! Logs with frames and logs of digests alone: read, written and compared by the same commands.

use std::io::Write;

use clap::ValueEnum;
use motion_lab::random::Seed;
use motion_lab::run::{
    Comparison, Digest, DigestComparison, DigestLog, DigestLogWriter, Frame, Log, LogError, LogWriter,
    MOST_ROBOTS_IN_FULL, RunDigest, Script,
};
use motion_lab::tour::TourConfig;

/// What a log keeps of its run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LogKind {
    /// Every frame to the last bit. The default up to 100 robots.
    Full,
    /// A digest of each second instead of the frames, for `verify`. The default above 100 robots.
    Digest,
}

impl LogKind {
    /// The kind for a run of which nobody said it.
    pub fn of(config: &TourConfig) -> Self {
        if config.robot_names().count() > MOST_ROBOTS_IN_FULL { LogKind::Digest } else { LogKind::Full }
    }
}

/// A log of either kind.
#[derive(Clone, Debug)]
pub enum AnyLog {
    Full(Log),
    Digest(DigestLog),
}

impl AnyLog {
    /// The seed, the configuration and the script.
    pub fn parts(&self) -> (Seed, &TourConfig, &Script) {
        match self {
            AnyLog::Full(Log { seed, config, script, .. }) => (*seed, config, script),
            AnyLog::Digest(DigestLog { seed, config, script, .. }) => (*seed, config, script),
        }
    }

    /// The kind.
    pub fn kind(&self) -> LogKind {
        match self {
            AnyLog::Full(_) => LogKind::Full,
            AnyLog::Digest(_) => LogKind::Digest,
        }
    }

    /// The number of recorded ticks.
    pub fn recorded(&self) -> u64 {
        match self {
            AnyLog::Full(log) => log.frames.len() as u64,
            AnyLog::Digest(log) => log.ticks,
        }
    }
}

/// A run compared with a log of either kind.
pub enum AnyComparison<'a> {
    Full(Comparison<'a>),
    Digest(DigestComparison<'a>),
}

impl<'a> AnyComparison<'a> {
    /// A comparison with a log, from tick 0 on.
    pub fn with(log: &'a AnyLog) -> Self {
        match log {
            AnyLog::Full(log) => AnyComparison::Full(Comparison::with(log)),
            AnyLog::Digest(log) => AnyComparison::Digest(DigestComparison::with(log)),
        }
    }

    /// Compares the next frame; `run` is the run's digest with it. Returns whether all agree so far.
    pub fn frame(&mut self, frame: &Frame, run: &RunDigest) -> bool {
        match self {
            AnyComparison::Full(comparison) => comparison.frame(frame),
            AnyComparison::Digest(comparison) => comparison.tick(frame.tick, run),
        }
    }

    /// The number of recorded ticks.
    pub fn recorded(&self) -> u64 {
        match self {
            AnyComparison::Full(comparison) => comparison.recorded(),
            AnyComparison::Digest(comparison) => comparison.recorded(),
        }
    }

    /// The number of them that the run equals, from the first on.
    pub fn identical(&self) -> u64 {
        match self {
            AnyComparison::Full(comparison) => comparison.identical(),
            AnyComparison::Digest(comparison) => comparison.identical(),
        }
    }

    /// What differs first in a run of this configuration, in words.
    pub fn difference(&self, config: &TourConfig) -> Option<String> {
        match self {
            AnyComparison::Full(comparison) => comparison.divergence().map(|d| d.clone().named(config).to_string()),
            AnyComparison::Digest(comparison) => comparison.difference().map(ToString::to_string),
        }
    }
}

/// A log of either kind under way.
pub enum AnyWriter<W: Write> {
    Full(LogWriter<W>),
    Digest(DigestLogWriter<W>),
}

impl<W: Write> AnyWriter<W> {
    /// Starts a log; `run` is the digest before tick 1.
    pub fn new(
        out: W,
        kind: LogKind,
        (seed, config, script): (Seed, &TourConfig, &Script),
        initial: &Frame,
        run: &RunDigest,
    ) -> Result<Self, LogError> {
        Ok(match kind {
            LogKind::Full => AnyWriter::Full(LogWriter::new(out, seed, config, script, initial)?),
            LogKind::Digest => AnyWriter::Digest(DigestLogWriter::new(out, seed, config, script, run)?),
        })
    }

    /// Writes the next tick; `run` is the run's digest with it.
    pub fn tick(&mut self, frame: &Frame, run: &RunDigest) -> Result<(), LogError> {
        match self {
            AnyWriter::Full(writer) => writer.tick(frame).map(|_| ()),
            AnyWriter::Digest(writer) => writer.tick(frame, run),
        }
    }

    /// Flushes the output.
    pub fn flush(&mut self) -> Result<(), LogError> {
        match self {
            AnyWriter::Full(writer) => writer.flush(),
            AnyWriter::Digest(writer) => writer.flush(),
        }
    }

    /// Writes what is not written yet of a run that stops early, with this digest so far.
    pub fn stop(&mut self, run: Digest) -> Result<(), LogError> {
        match self {
            AnyWriter::Full(writer) => writer.flush(),
            AnyWriter::Digest(writer) => writer.stop(run),
        }
    }

    /// Writes the end; `run` is the whole run's digest.
    pub fn end(&mut self, run: Digest) -> Result<(), LogError> {
        match self {
            AnyWriter::Full(writer) => writer.end(),
            AnyWriter::Digest(writer) => writer.end(run),
        }
    }

    /// The output.
    pub fn into_inner(self) -> W {
        match self {
            AnyWriter::Full(writer) => writer.into_inner(),
            AnyWriter::Digest(writer) => writer.into_inner(),
        }
    }
}
