//! The log as a file: MCAP, unchunked and uncompressed. Programs that need chunks, as Rerun, take an export of it.
//!
//! The file is a sequence of pieces, each ended by a *seal*, a record with opcode 0x80, which other readers skip. It
//! holds the tick (64 bits), the offset of the seal itself (64 bits) and the xxh3-128 of every byte before it, all
//! little-endian.
//!
//! | piece | records |
//! |---|---|
//! | before the first tick | header; metadata `motion-lab`: format, program, seed, dt, ticks, generator and the content hash of each world; attachments `config.ron`, `worlds/0.ron` and so on, `script.ron`; schemas; channels; the messages of tick 0, the initial state; seal |
//! | each tick | its messages on `/input`, `/frame`, `/scan`, `/digest`; seal |
//! | the end | data end; summary: schemas, channels, statistics, indexes; footer; magic |
//!
//! A digest log is such a file without frames: its format is [`DIGEST_FORMAT_VERSION`], and its pieces are
//!
//! | piece | records |
//! |---|---|
//! | before the first tick | header, metadata and attachments as above; a digest record with the digest of tick 0; seal |
//! | each minute | a digest record: the digests of up to 60 seconds; seal |
//! | the end | the run's digest; seal; data end, summary, footer, magic |
//!
//! A digest record has opcode 0x81. It holds the tick of its last digest, 64 bits, then 64 bits a second, the lower
//! half of the run's digest so far. The record of the run's digest has opcode 0x82 and holds its 128 bits. A digest
//! record before the last of a log has 60 digests.
//!
//! A message's times are tick * 50 ms from zero. No clock is read, so the same run gives the same bytes.

mod digest_encoder;
mod digest_log;
mod digest_reader;
mod digest_writer;
mod encoder;
mod error;
mod message;
mod preamble;
mod read_log;
mod reader;
mod record;
mod record_writer;
mod sealed_output;
#[cfg(test)]
mod tests;
mod writer;

pub use digest_log::{DIGEST_TICKS, DigestLog, MOST_ROBOTS_IN_FULL, ReadDigestLog};
pub use digest_writer::DigestLogWriter;
pub use error::{DamageKind, DamagedDigestLog, DamagedLog, LogError};
pub use read_log::ReadLog;
pub use writer::LogWriter;

/// The version of the log format for a run that changes no world. The program reads this one and the next.
pub const FORMAT_VERSION: &str = "1";
/// The version of the log format for a run whose script changes worlds: frames hold obstacles, inputs name worlds.
pub const FORMAT_VERSION_WITH_CHANGES: &str = "2";
/// The version of the log format for a log without frames, a [`DigestLog`].
pub const DIGEST_FORMAT_VERSION: &str = "digest 1";
/// The generator of a run's random numbers: see [`Stream`](motion_lab_core::random::Stream).
pub const GENERATOR: &str = "chacha8, a stream per name, keyed by xxh3-128";
/// A tick's length in nanoseconds: [`DT`](crate::run::DT).
pub const TICK_NANOSECONDS: u64 = 50_000_000;
const PROFILE: &str = "motion-lab";
/// The profile in the header of an export: an MCAP file made from a log for viewers, which is not a log itself.
pub const EXPORT_PROFILE: &str = "motion-lab-export";
const MEDIA_TYPE: &str = "text/x-ron";

/// The topics and message types of the channels. The ids of channels and schemas count from 1.
const CHANNELS: [(&str, &str); 4] = [
    ("/input", "motion_lab.Input"),
    ("/frame", "motion_lab.Frame"),
    ("/scan", "motion_lab.Scan"),
    ("/digest", "motion_lab.Digest"),
];

/// The channels' ids.
mod channel {
    pub const INPUT: u16 = 1;
    pub const FRAME: u16 = 2;
    pub const SCAN: u16 = 3;
    pub const DIGEST: u16 = 4;
}
