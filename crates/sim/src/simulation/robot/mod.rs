//! Kinds of robots in the simulation.

pub(crate) mod contact;
pub(crate) mod describe;
pub(crate) mod driven;
pub(crate) mod kinds;
pub(crate) mod ops;
pub(crate) mod plugin;
pub(crate) mod refusal;
pub(crate) mod registry;
pub(crate) mod replicas;
pub(crate) mod request;
pub(crate) mod simulated;
pub(crate) mod spawn;
pub(crate) mod view;
