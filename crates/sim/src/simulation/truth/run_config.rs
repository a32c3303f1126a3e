//! `RunConfig`, the configuration of the run under way.

use std::sync::Arc;

use bevy::prelude::*;

use crate::tour::TourConfig;

/// The configuration of the run under way. It follows from the run's entities as long as the run stands at tick 0, and
/// is fixed from then on.
#[derive(Resource, Debug)]
pub struct RunConfig(pub(crate) Arc<TourConfig>);

impl RunConfig {
    /// The configuration.
    pub fn config(&self) -> &Arc<TourConfig> {
        &self.0
    }
}
