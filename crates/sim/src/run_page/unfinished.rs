//! `UnfinishedPage`, the page of a run that is being simulated for it.

use base64::prelude::{BASE64_STANDARD, Engine};

use super::RunPageError;
use super::gzip::gzip;
use super::template::{PageTemplate, RunInPage};
use crate::capture::RunFigure;
use crate::recording::Recorder;
use crate::run::{Comparison, Digest, Log, LogKind, LogWriter, Recipe};
use motion_lab_core::picture::Theme;

/// The page of a run that is being simulated for it, tick by tick.
pub struct UnfinishedPage<'a> {
    template: &'a PageTemplate,
    recipe: Recipe,
    run: Recorder,
    figure: RunFigure,
    log: LogWriter<Vec<u8>>,
    /// With the log that the run is recorded in.
    comparison: Option<Comparison<&'a Log>>,
}

impl<'a> UnfinishedPage<'a> {
    /// The page of a run at tick 0.
    ///
    /// # Errors
    /// [`RunPageError`] when the run can't start, or be logged.
    pub fn of_run(template: &'a PageTemplate, recipe: Recipe) -> Result<Self, RunPageError> {
        let run = Recorder::of(&recipe)?.without_keyframes();
        let log = LogWriter::new(Vec::new(), &recipe, LogKind::Digests, run.frame())?;
        let mut figure = RunFigure::default();
        figure.watch(run.view());
        Ok(UnfinishedPage { template, recipe, run, figure, log, comparison: None })
    }

    /// The page of what is recorded in a log, with which the run is compared.
    ///
    /// # Errors
    /// As [`of_run`](Self::of_run).
    pub fn of_log(template: &'a PageTemplate, log: &'a Log) -> Result<Self, RunPageError> {
        let page = Self::of_run(template, log.recorded_recipe())?;
        let comparison = Some(Comparison::begin(log, page.run.frame()));
        Ok(UnfinishedPage { comparison, ..page })
    }

    /// The tick up to which it is simulated.
    pub fn tick(&self) -> u64 {
        self.run.frame().tick
    }

    /// Simulates the next tick. Returns whether there was one.
    ///
    /// # Errors
    /// [`RunPageError`] when it can't be logged.
    pub fn go_on(&mut self) -> Result<bool, RunPageError> {
        if self.tick() >= self.recipe.config.ticks {
            return Ok(false);
        }
        let frame = self.run.step();
        self.log.tick(frame)?;
        if let Some(comparison) = &mut self.comparison {
            comparison.tick(frame);
        }
        self.figure.watch(self.run.view());
        Ok(true)
    }

    /// Simulates what is left of the run. Returns the page.
    ///
    /// # Errors
    /// [`RunPageError`] when the run can't be logged, or is not the recorded one.
    pub fn page(mut self) -> Result<String, RunPageError> {
        while self.go_on()? {}
        if let Some(difference) = self.comparison.as_ref().and_then(Comparison::difference) {
            return Err(RunPageError::Differs(Box::new(difference.clone())));
        }
        let (ticks, digest): (u64, Digest) = (self.recipe.config.ticks, self.log.digest());
        let svg = |theme| self.figure.svg(&self.recipe, ticks, digest, theme);
        let figures = [Theme::Light, Theme::Dark].map(|theme| BASE64_STANDARD.encode(svg(theme)));
        let log = BASE64_STANDARD.encode(gzip(&self.log.finish()?));
        let [seed, ticks, digest] = [self.recipe.seed.to_string(), ticks.to_string(), digest.to_string()];
        Ok(self.template.filled(&RunInPage { seed, ticks, digest, figures, log }))
    }
}
