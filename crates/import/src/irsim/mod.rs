//! Scenes of IR-SIM.

pub(crate) mod context;
pub(crate) mod group;
pub(crate) mod obstacle;
pub(crate) mod random_polygon;
pub(crate) mod robot;
pub(crate) mod scene;
pub(crate) mod shape;
