//! The types that record and hold runs may be sent to and shared between threads. If one could not, this file would not
//! compile.

use motion_lab_core::robots::{Hitch, Reach, Rusty};
use motion_lab_sim::recording::{Recorder, RunError};
use motion_lab_sim::run::{Divergence, Frame, Log, LogError, RunDigest, Script};
use motion_lab_sim::simulation::Replicas;
use motion_lab_sim::tour::TourConfig;

const fn shared<T: Send + Sync>() {}

const _: () = {
    shared::<(TourConfig, Script, Frame, Log, Divergence, RunDigest, Recorder)>();
    shared::<(LogError, RunError)>();
    shared::<(Replicas<Rusty>, Replicas<Reach<2>>, Replicas<Hitch>)>();
};
