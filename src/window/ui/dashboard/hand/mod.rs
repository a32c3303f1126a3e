//! What a hand does with a robot: drags it or its joints, drives it by keys or by the pad.

pub(crate) mod arm;
pub(crate) mod bodies;
pub(crate) mod drive;
pub(crate) mod handles;
pub(crate) mod pad;
