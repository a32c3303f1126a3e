//! The planners of the program.

use std::sync::OnceLock;

use clap::builder::TypedValueParser;

use crate::cli::support::choices::one_of;
use motion_lab_sim::plans::{PlannerName, Planners};

static PLANNERS: OnceLock<Planners> = OnceLock::new();

/// Says which planners the program has, before its command line is read; the first word counts.
pub fn have(planners: Planners) {
    _ = PLANNERS.set(planners);
}

/// The planners that the program has.
pub fn planners() -> &'static Planners {
    PLANNERS.get_or_init(Planners::default)
}

/// Reads the name of a planner.
pub fn planner_name() -> impl TypedValueParser<Value = PlannerName> {
    one_of(planners().all().map(|name| (name.id(), name, name.words())))
}
