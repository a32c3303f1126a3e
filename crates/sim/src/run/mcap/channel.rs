//! The channels of a log, and what names its format.

/// The version of the log format for a run that changes no world. The program reads this one and the next two.
pub const FORMAT_VERSION: &str = "1";

/// The version of the log format for a run whose script changes worlds: frames hold obstacles, inputs name worlds.
pub const FORMAT_VERSION_WITH_CHANGES: &str = "2";

/// The version of the log format for a run whose script changes worlds more than [`MAX_REPEATED_CHANGES`] times: a
/// frame holds the obstacles that are not as they were after the tick before.
pub const FORMAT_VERSION_WITH_MANY_CHANGES: &str = "3";

/// Largest number of changes of a script in whose log each frame repeats all obstacles that are not as at the start.
pub const MAX_REPEATED_CHANGES: usize = 256;

/// The version of the log format for a log of digests.
pub const DIGEST_FORMAT_VERSION: &str = "digest 1";

/// The generator of a run's random numbers: see [`Stream`](motion_lab_core::random::Stream).
pub const GENERATOR: &str = "chacha8, a stream per name, keyed by xxh3-128";

/// A tick's length in nanoseconds: [`DT`](crate::run::DT).
pub const TICK_NANOSECONDS: u64 = 50_000_000;

pub(super) const PROFILE: &str = "motion-lab";

/// The profile in the header of an export: an MCAP file made from a log for viewers, which is not a log itself.
pub const EXPORT_PROFILE: &str = "motion-lab-export";

pub(super) const MEDIA_TYPE: &str = "text/x-ron";

/// The topics and message types of the channels. The ids of channels and schemas count from 1.
pub(super) const CHANNELS: [(&str, &str); 4] = [
    ("/input", "motion_lab.Input"),
    ("/frame", "motion_lab.Frame"),
    ("/scan", "motion_lab.Scan"),
    ("/digest", "motion_lab.Digest"),
];

/// The ids of the channels.
pub(super) const INPUT: u16 = 1;
pub(super) const FRAME: u16 = 2;
pub(super) const SCAN: u16 = 3;
pub(super) const DIGEST: u16 = 4;
