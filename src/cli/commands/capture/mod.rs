//! `capture`: what a widget shows, without a display, as SVG, PNG or GIF.

mod args;
mod plan;
mod run;
mod widgets;

pub use args::Capture;
use motion_lab_sim::manifest::Widget;
use std::path::Path;

use crate::capture::{CaptureError, CaptureForm, Paper};

use crate::cli::support::input::is_dash;
use crate::cli::support::paper::{not_written, write_picture};
use crate::cli::support::simulate::not_shown;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome};

impl Capture {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let paper = self.paper.paper();
        let form = self.form()?;
        let of_run = match self.widget {
            Widget::Dashboard => true,
            Widget::Plan => false,
            _ => self.run.asked(form),
        };
        if self.widget == Widget::Anatomy && form == CaptureForm::Gif {
            return Err(self.failure(CaptureError::Frozen));
        }
        if let Some((option, place)) = self.astray(form, of_run) {
            return Err(Failure::usage(format!("{option} is only valid for {place}"), "Leave it out."));
        }
        let target = Target::of(&self.output)?;
        let outcome = if of_run {
            self.of_run(form, &paper, &target)?;
            Outcome::Done
        } else {
            self.of_scene(form, &paper, &target)?
        };
        target.finish(data)?;
        Ok(outcome)
    }

    /// Writes what a widget shows without a run.
    fn of_scene(&self, form: CaptureForm, paper: &Paper, target: &Target) -> Result<Outcome, Failure> {
        let captured = match self.widget {
            Widget::Plan => return self.of_plan(form, paper, target),
            Widget::Atlas => widgets::atlas(&self.scene, self.run.names, paper)?,
            Widget::Cspace => widgets::cspace(&self.scene)?,
            Widget::Anatomy | Widget::Dashboard => widgets::anatomy(&self.scene)?,
        };
        write_picture(&captured, paper, form, target)?;
        Ok(Outcome::Done)
    }

    /// The form: what was said, else what the output's name tells.
    fn form(&self) -> Result<CaptureForm, Failure> {
        let named = || if is_dash(&self.output) { Some(CaptureForm::Svg) } else { CaptureForm::of(&self.output) };
        self.format.or_else(named).ok_or_else(|| {
            let reason = format!("{}: its name does not tell the form", self.output.display());
            Failure::usage(reason, "Let it end in .svg, .png or .gif, or say --format.")
        })
    }

    /// A failure of the library as one of this program.
    fn failure(&self, error: CaptureError) -> Failure {
        match error {
            CaptureError::Run(error) => not_shown(self.run.run.as_deref().unwrap_or(Path::new("the run")), &error),
            error => match next(&error) {
                Some(next) => Failure::usage(&error, next),
                None => not_written(&self.output, error),
            },
        }
    }

    /// The first option given for which the widget or the file format has no use, and what it goes with.
    fn astray(&self, form: CaptureForm, of_run: bool) -> Option<(&'static str, &'static str)> {
        use Widget::{Anatomy, Atlas, Cspace, Dashboard, Plan};
        let (run, scene) = (&self.run, &self.scene);
        let runs: &[Widget] = &[Dashboard, Atlas, Cspace];
        let with_plan = "dashboard, atlas, cspace and plan";
        let options: [(&str, bool, &[Widget], &str); 19] = [
            ("--run", run.run.is_some(), runs, "dashboard, atlas and cspace"),
            ("--seed", run.seed.is_some(), &[Dashboard, Atlas, Cspace, Plan], with_plan),
            ("--tick", run.tick.is_some(), runs, "dashboard, atlas and cspace"),
            ("--from", run.from.is_some(), runs, "dashboard, atlas and cspace"),
            ("--to", run.to.is_some(), runs, "dashboard, atlas and cspace"),
            ("--every", run.every.is_some(), runs, "dashboard, atlas and cspace"),
            ("--names", run.names, &[Dashboard, Atlas], "dashboard and atlas"),
            ("--scan", run.scan, &[Dashboard], "the dashboard"),
            ("--nearest", run.nearest, &[Dashboard], "the dashboard"),
            ("--tab", scene.tab.is_some(), &[Anatomy], "the anatomy"),
            ("--robot", scene.robot.is_some(), &[Anatomy, Cspace, Plan], "anatomy, cspace and plan"),
            ("--q", scene.q.is_some(), &[Anatomy, Cspace, Plan], "anatomy, cspace and plan"),
            ("--step", scene.step.is_some(), &[Anatomy, Cspace], "anatomy and cspace"),
            ("--annulus", scene.annulus, &[Anatomy, Cspace], "anatomy and cspace"),
            ("--cells or --budget", scene.cells.or(scene.budget).is_some(), &[Cspace], "cspace"),
            ("--grid", scene.grid.is_some(), &[Atlas], "the atlas"),
            ("--teleport", scene.teleport.is_some(), &[Atlas], "the atlas"),
            ("--goal or --planner", scene.goal.is_some() || scene.planner.is_some(), &[Plan], "plan"),
            ("--world", scene.world.is_some(), &[Anatomy, Atlas, Cspace, Plan], "anatomy, atlas, cspace and plan"),
        ];
        let stray = options.into_iter().find(|(_, given, widgets, _)| *given && !widgets.contains(&self.widget));
        // a run has its robots' configurations already
        let still = [
            ("--q", scene.q.is_some()),
            ("--step", scene.step.is_some()),
            ("--teleport", scene.teleport.is_some()),
            ("--grid", scene.grid.is_some()),
            ("--budget", scene.budget.is_some()),
        ];
        let of_still = still
            .into_iter()
            .find(|(_, given)| of_run && *given)
            .map(|(option, _)| (option, "figures that do not show a run"));
        stray.map(|(option, .., place)| (option, place)).or(of_still).or_else(|| {
            let span = run.from.or(run.to).or(run.every).is_some();
            match form {
                CaptureForm::Gif => run.tick.map(|_| ("--tick", "SVG and PNG")),
                _ => span.then_some(("--from, --to and --every", "GIF")),
            }
        })
    }
}

/// Advice about an error of what was asked for; `None` for one of writing it.
fn next(error: &CaptureError) -> Option<&'static str> {
    Some(match error {
        CaptureError::NoTick { .. } => "Choose one of them.",
        CaptureError::Frozen => "Name an .svg or .png file, or --widget cspace to see a robot move beside its point.",
        CaptureError::NotInRun(_) => "Name a --run with it, or another --robot or --world.",
        _ => return None,
    })
}
