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
//! | the end | the run's digest; seal; data end; summary: schemas, channels, statistics, indexes; footer; magic |
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
//! In a log of more than [`MAX_REPEATED_CHANGES`] changes of worlds a frame holds the obstacles that are not as they
//! were after the tick before: its format is [`FORMAT_VERSION_WITH_MANY_CHANGES`]. Such logs of before are of the
//! format of fewer changes, and are read as ever. The digests are of whole frames in both.
//!
//! Logs with frames of before had no digest in their end, and are read as ever. The digest covers what the frames do
//! not tell, such as a range that no ray has reached. Whoever can seal a file again can compute it, too.
//!
//! A message's times are tick * 50 ms from zero. No clock is read, so the same run gives the same bytes.

mod channel;
mod encoder;
mod error;
mod frame_messages;
mod message;
mod page;
mod preamble;
mod read_log;
mod reader;
mod record;
mod record_writer;
mod sealed_output;
mod sealer;
#[cfg(test)]
mod tests;
mod writer;

pub use channel::{
    DIGEST_FORMAT_VERSION, EXPORT_PROFILE, FORMAT_VERSION, FORMAT_VERSION_WITH_CHANGES,
    FORMAT_VERSION_WITH_MANY_CHANGES, GENERATOR, MAX_REPEATED_CHANGES, TICK_NANOSECONDS,
};
pub use error::{DamageKind, DamagedLog, LogError, OtherRun};
pub(crate) use preamble::check_recordable;
pub use read_log::ReadLog;
pub use writer::LogWriter;
