//! Scenes of IR-SIM.

pub(crate) mod scene;
pub(crate) mod shape;
