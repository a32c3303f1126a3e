//! `Keep`, the runs whose full logs a sweep keeps.

use clap::ValueEnum;

/// The runs whose full logs are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Keep {
    /// None.
    None,
    /// Those with contacts.
    Contacts,
    /// Those that failed, where they could be run at all.
    Failures,
    /// All.
    All,
}
