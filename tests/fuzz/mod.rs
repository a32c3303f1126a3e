//! What fuzzing asks of the readers of files: one function for each format, which takes any bytes.
//!
//! Each calls the lab's public reader and asks more than that it returns: what is read and written again is the same,
//! what is read can be used, and what is refused is refused in one short line. A panic is a finding; so is a time or a
//! memory beyond the limits of `tests/all/fuzz`, which runs the functions by libFuzzer, through the crate `fuzz`. The
//! gate runs them over the files of `corpus`.

pub mod assignment;
pub mod digest_log;
pub mod link;
pub mod log;
pub mod map;
pub mod part;
pub mod path;
pub mod plan;
mod refusal;
#[cfg(test)]
mod replay;
pub mod script;
mod sealed;
mod standing;
pub mod svg;
pub mod world;

/// A format, and what is asked of its reader.
#[derive(Clone, Copy, Debug)]
pub struct FuzzTarget {
    /// The name: of the program in `fuzz/fuzz_targets`, and of the folder of the corpus.
    pub name: &'static str,
    /// Whether the reader takes the bytes. Panics where it does not do what it says.
    pub check: fn(&[u8]) -> bool,
}

/// All of them.
pub const TARGETS: [FuzzTarget; 11] = [
    FuzzTarget { name: "assignment", check: assignment::check },
    FuzzTarget { name: "digest_log", check: digest_log::check },
    FuzzTarget { name: "link", check: link::check },
    FuzzTarget { name: "log", check: log::check },
    FuzzTarget { name: "map", check: map::check },
    FuzzTarget { name: "part", check: part::check },
    FuzzTarget { name: "path", check: path::check },
    FuzzTarget { name: "plan", check: plan::check },
    FuzzTarget { name: "script", check: script::check },
    FuzzTarget { name: "svg", check: svg::check },
    FuzzTarget { name: "world", check: world::check },
];
