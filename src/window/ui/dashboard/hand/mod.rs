//! What a hand does with a robot: tows it, puts it elsewhere or drags its joints, drives it by keys or by the
//! pad.

pub(crate) mod arm;
pub(crate) mod bodies;
pub(crate) mod drive;
pub(crate) mod handles;
pub(crate) mod held_tow;
pub(crate) mod pad;
pub(crate) mod tow;
