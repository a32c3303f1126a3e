//! The versions of the address format, and what an address may hold.

use percent_encoding::{AsciiSet, CONTROLS};

/// The version of the address format in which inputs are in the script.
pub const LINK_VERSION: u32 = 1;

/// The version of the address format with the field `inputs`.
pub const LINK_VERSION_WITH_INPUTS: u32 = 2;

/// The version of the address format with the fields `file` and `sensor`.
pub const LINK_VERSION_WITH_FILES: u32 = 3;

/// Largest number of characters of a name in a world of a link. Whoever makes a link may want its names to be read as
/// the lab's own words.
pub const MAX_NAME: usize = 32;

/// Largest length of a query that servers take, bytes. A longer one stands behind a `#`: what is there is never sent.
pub const MAX_QUERY: usize = 8000;

/// Largest length of a link, bytes.
pub const MAX_LINK: usize = 32_000;

/// Length of a link, bytes, from which the inputs are written in few bytes rather than to be read.
pub const LONG: usize = 2000;

/// Most coordinates of a configuration.
pub const MAX_COORDINATES: usize = 16;

/// Largest seed of a planner's samples: what its field in the window takes.
pub const MAX_PLANNER_SEED: u64 = u32::MAX as u64;

/// Largest tick of a link: an hour. Opening a link simulates its run up to that tick.
pub const MAX_LINK_TICK: u64 = 72_000;

/// Least number of ticks that a link's run is taken for: a minute, since it is played.
pub const TICKS_AHEAD: u64 = 1200;

/// The most work that the run of a link may be: rays, and pairs of a robot and what it may meet, over all its ticks.
/// The tour's hour, the longest link of it, is a tenth.
pub const MAX_LINK_WORK: u64 = 400_000_000;

/// Characters to escape: those with a meaning in a query, and those at which programs that find addresses in text stop.
pub const ESCAPED: &AsciiSet = &{
    let marks = CONTROLS.add(b' ').add(b'"').add(b'#').add(b'%').add(b'&').add(b'+').add(b'<').add(b'>');
    marks.add(b'[').add(b']').add(b'`').add(b'{').add(b'|').add(b'}').add(b'\\').add(b'^')
};
