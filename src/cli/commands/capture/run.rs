//! Widgets that show a run: at a tick, and over a span of them.

use crate::capture::{CaptureForm, CaptureSpan, Paper, Subject, at_tick_with_robots, film, write};
use motion_lab_core::names::did_you_mean;
use motion_lab_core::random::Seed;
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{Log, Script};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

use super::args::{Capture, RunArgs};
use crate::cli::commands::query::Chosen;
use crate::cli::support::choices::KINDS;
use crate::cli::support::log_source::{LogSource, read_full_log};
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::target::Target;
use crate::cli::support::world_source::find_world;
use crate::cli::{Failure, say};
use motion_lab_sim::manifest::Widget;

impl Capture {
    /// Writes what the widget shows of the run.
    pub(crate) fn of_run(&self, form: CaptureForm, paper: &Paper, target: &Target) -> Result<(), Failure> {
        let output = target.path();
        let log = log(&self.run)?;
        let subject = self.subject(&log)?;
        let last = log.ticks();
        let RunArgs { tick, from, to, every, .. } = self.run;
        let written = if form == CaptureForm::Gif {
            let span = CaptureSpan { from: from.unwrap_or(0), to: to.unwrap_or(last), every: every.unwrap_or(4) };
            let pictures = (span.to.saturating_sub(span.from)) / span.every + 1;
            let progress = CommandProgress::of(pictures, "pictures");
            film(&log, &subject, span, paper, output, |done, _| {
                progress.at(done);
                true
            })
        } else {
            let progress = CommandProgress::of(last, "ticks");
            let shown = |tick| progress.at(tick);
            at_tick_with_robots(&log, &subject, tick.unwrap_or(last), paper.width_px(), |_| {}, shown)
                .and_then(|captured| write(&captured, paper, form, output))
        };
        written.map_err(|error| self.failure(error))
    }

    fn subject(&self, log: &Log) -> Result<Subject, Failure> {
        let scene = &self.scene;
        let lives = |name: &String| log.recipe.config.robot_names().any(|robot| robot == name);
        let robot = scene.robot.clone().filter(lives);
        let kind = match (&scene.robot, &robot) {
            (Some(name), None) => Some(kind_of(name, log)?),
            _ => None,
        };
        let world = scene.world.as_deref().map(find_world).transpose()?;
        Ok(match self.widget {
            Widget::Cspace => {
                Subject::Cspace { world, robot, kind, finest: scene.cells.unwrap_or(7), annulus: scene.annulus }
            }
            Widget::Atlas => Subject::Atlas { world, names: self.run.names },
            Widget::Dashboard | Widget::Anatomy | Widget::Plan => {
                Subject::Dashboard { names: self.run.names, scan: self.run.scan, nearest: self.run.nearest }
            }
        })
    }
}

/// The kind of this name, of which a robot of the run is to be.
fn kind_of(name: &str, log: &Log) -> Result<String, Failure> {
    Chosen::kind(name).map(|kind| kind.kind_name().to_owned()).ok_or_else(|| {
        let there = log.recipe.config.robot_names().collect::<Vec<_>>().join(", ");
        let meant = did_you_mean(name, log.recipe.config.robot_names().chain(KINDS));
        let next = format!("{meant}The kinds are {}; in this run are {there}.", KINDS.join(", "));
        Failure::usage(format!("no robot is called {name:?}"), next)
    })
}

/// The log asked for: of a file, or of the tour at a seed.
fn log(args: &RunArgs) -> Result<Log, Failure> {
    if let Some(path) = &args.run {
        let LogSource { log, damage, .. } = read_full_log(path)?;
        if let Some(damage) = damage {
            say(damage);
        }
        return Ok(log);
    }
    let seed = args.seed.map_or(BOOK_SEED, Seed);
    Run::record(TourConfig::default(), (seed, Script::empty())).map_err(Failure::internal)
}
