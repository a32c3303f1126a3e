//! `record`: run the simulation and keep what came of it.

mod args;
mod choice;
mod log_names;
mod many;
mod one;
mod paranoid;
mod resume;
mod seeds;
mod setup;
mod written;

pub use args::RecordArgs;

use motion_lab_sim::run::{LogKind, Recipe};
use motion_lab_sim::tour::TourConfig;

use crate::cli::support::console::note;
use crate::cli::support::interrupt;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome};

use one::Printed;
pub use one::{Ended, StopRule, run, write_run, write_run_watched};
pub use seeds::SeedRange;

impl RecordArgs {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        interrupt::listen();
        if let Some(output) = self.output.as_ref().filter(|_| self.resume.is_none()) {
            resume::name_unfinished(output);
        }
        if let Some(file) = &self.resume {
            return resume::resume(file, self.output.as_deref(), self.stop(), self.printed(), data);
        }
        let config = setup::config(&self)?;
        let script = setup::script(&self, &config)?;
        let recipe = Recipe::new(config, (setup::seed(&self), script));
        if let Some(seeds) = self.seeds {
            return many::record(&self, seeds, &recipe, data);
        }
        if self.paranoid
            && let Some(ended) = paranoid::check(&recipe)?
        {
            return Ok(ended);
        }
        let kind = self.kind(&recipe.config);
        let target = self.output.as_deref().map(Target::log).transpose()?;
        one::record(&recipe, kind, None, target.as_ref(), self.stop(), self.printed(), data)
    }

    /// What the log keeps. Where nobody said it, and it is not every frame, this is said.
    fn kind(&self, config: &TourConfig) -> LogKind {
        let kind = self.log.unwrap_or_else(|| LogKind::usual(config));
        if self.log.is_none() && kind == LogKind::Digests && self.output.is_some() {
            let robots = config.robot_names().count();
            note(format!(
                "{robots} robots: the log keeps a digest of each second and no frames; --log full keeps every frame"
            ));
        }
        kind
    }

    fn stop(&self) -> StopRule {
        StopRule { after: self.stop_after, unwatched: false, at_refusal: self.strict }
    }

    fn printed(&self) -> Printed {
        match (self.json, self.debug) {
            (true, _) => Printed::Json,
            (false, true) => Printed::Debug,
            (false, false) => Printed::Words,
        }
    }
}
