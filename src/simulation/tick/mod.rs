//! The systems of a tick: input, drive, cut, settle, sense.

pub(crate) mod drive;
pub(crate) mod hold;
pub(crate) mod input;
pub(crate) mod sense;
pub(crate) mod settle;
pub(crate) mod starts;
pub(crate) mod sweep;
