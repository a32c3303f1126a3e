//! `PlanTargets`, the files that `plan` writes.

use super::args::PlanArgs;
use crate::cli::Failure;
use crate::cli::support::target::Target;

/// The files that were asked for, claimed before the first is written.
pub struct PlanTargets {
    /// The path, as JSON.
    pub path: Option<Target>,
    /// The script that plays it.
    pub script: Option<Target>,
    /// The log of the run that it drives.
    pub record: Option<Target>,
    /// A picture.
    pub picture: Option<Target>,
    /// A film of the planner's growth.
    pub film: Option<Target>,
    /// The proof that there is no path, as JSON.
    pub barrier: Option<Target>,
}

impl PlanTargets {
    /// The targets of a command line.
    pub fn of(args: &PlanArgs) -> Result<Self, Failure> {
        Ok(PlanTargets {
            path: args.output.as_deref().map(Target::of).transpose()?,
            script: args.script.as_deref().map(Target::of).transpose()?,
            record: args.record.as_deref().map(Target::log).transpose()?,
            picture: args.svg.as_deref().map(Target::of).transpose()?,
            film: args.gif.as_deref().map(Target::of).transpose()?,
            barrier: args.barrier.as_deref().map(Target::of).transpose()?,
        })
    }
}
