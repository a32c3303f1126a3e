//! Widgets that show a run: at a tick, and over a span of them.

use motion_lab::capture::{Form, Paper, Span, Subject, at_tick, film, write};
use motion_lab::random::Seed;
use motion_lab::recording::Run;
use motion_lab::run::{Log, Script};
use motion_lab::tour::{BOOK_SEED, TourConfig};

use super::{Capture, RunArgs, Widget};
use crate::cli::support::log_source::{LogSource, read_log};
use crate::cli::support::world_source::find_world;
use crate::cli::{Failure, say};

impl Capture {
    /// Writes what the widget shows of the run.
    pub(crate) fn of_run(&self, form: Form, paper: &Paper) -> Result<(), Failure> {
        let subject = self.subject()?;
        let log = log(&self.run)?;
        let last = log.frames.len() as u64;
        let RunArgs { tick, from, to, every, .. } = self.run;
        let written = if form == Form::Gif {
            let span = Span { from: from.unwrap_or(0), to: to.unwrap_or(last), every: every.unwrap_or(4) };
            film(&log, &subject, span, paper, &self.output, |_, _| true)
        } else {
            at_tick(&log, &subject, tick.unwrap_or(last), paper.width_px())
                .and_then(|captured| write(&captured, paper, form, &self.output))
        };
        written.map_err(|error| self.failure(error))
    }

    fn subject(&self) -> Result<Subject, Failure> {
        let scene = &self.scene;
        let world = scene.world.as_deref().map(find_world).transpose()?;
        Ok(match self.widget {
            Widget::Cspace => Subject::Cspace {
                world,
                kind: scene.robot.map(|robot| robot.kind().to_owned()),
                finest: scene.cells.unwrap_or(7),
                annulus: scene.annulus,
            },
            Widget::Atlas => Subject::Atlas { world, names: true },
            Widget::Dashboard | Widget::Anatomy => Subject::Dashboard { names: self.run.names, scan: self.run.scan },
        })
    }
}

/// The log asked for: of a file, or of the tour at a seed.
fn log(args: &RunArgs) -> Result<Log, Failure> {
    if let Some(path) = &args.log {
        let LogSource { read, damage } = read_log(path)?;
        if let Some(damage) = damage {
            say(damage);
        }
        return Ok(read.log);
    }
    let seed = args.seed.map_or(BOOK_SEED, Seed);
    Run::record(TourConfig::default(), (seed, Script::empty())).map_err(Failure::internal)
}
