//! `capture`: what a widget shows, without a display, as SVG, PNG or GIF.

mod run;
mod widgets;

use motion_lab::anatomy::Tab;
use motion_lab::manifest::Widget;
use std::path::{Path, PathBuf};

use clap::Args;
use motion_lab::capture::{CaptureError, CaptureForm};

use crate::cli::support::choices::{NumberList, RobotsAndKinds, WorldNames, form, one_of};
use crate::cli::support::input::is_dash;
use crate::cli::support::paper::{PaperArgs, not_written, write_picture};
use crate::cli::support::simulate::not_shown;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome};

/// Draw what a widget shows, without a display: a figure for a page, as SVG or PNG; a run over a span of ticks as GIF
///
/// The file's name tells the form, or --format. Seed and digest, or the world's content hash and the configuration, are
/// in the file: in the notes of a PNG, the metadata of an SVG, the comment of a GIF.
///
/// dashboard  the run of a log, or of --seed, at --tick
/// anatomy    the queries at a configuration: --tab, --robot, --q, --step
/// atlas      worlds with their names: --world, --grid, --teleport; of a run: --seed or --run, its robots where they
///            are
/// cspace     the workspace and beside it the configuration space: --robot, --q, --cells, --step; of a run: --seed or
///            --run, a robot of it with its way
#[derive(Debug, Args)]
#[command(
    verbatim_doc_comment,
    after_help = "\
Examples:
  motion-lab capture --widget anatomy --tab witness -o witness.png
  motion-lab capture --widget dashboard --run run.mcap --tick 300 --names -o run.svg
  motion-lab capture --widget cspace --robot reach --theme dark -o - > space.svg
  motion-lab capture --widget dashboard --from 0 --to 200 -o start.gif"
)]
pub struct Capture {
    /// The widget.
    #[arg(long, value_parser = one_of(WIDGETS.map(|widget| (widget.id(), widget, ""))))]
    widget: Widget,
    /// The file to write: .svg, .png or .gif. `-` is standard output.
    #[arg(short, long, alias = "out", value_name = "FILE")]
    output: PathBuf,
    /// The form. [default: by the output's name; svg for `-`]
    #[arg(long, value_parser = form(CaptureForm::ALL))]
    format: Option<CaptureForm>,
    #[command(flatten)]
    paper: PaperArgs,
    #[command(flatten)]
    run: RunArgs,
    #[command(flatten)]
    scene: SceneArgs,
}

/// Which run is shown, and when.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// The run of this log, instead of that of --seed; `-` is standard input.
    #[arg(long, alias = "log", value_name = "FILE", conflicts_with = "seed")]
    run: Option<PathBuf>,
    /// The tour of this seed. [default: 2005, where a run is shown]
    #[arg(long, value_name = "SEED")]
    seed: Option<u64>,
    /// SVG and PNG of a run: the tick. [default: the last]
    #[arg(long, value_name = "TICK")]
    tick: Option<u64>,
    /// GIF: the first tick. [default: 0]
    #[arg(long, value_name = "TICK")]
    from: Option<u64>,
    /// GIF: the last tick. [default: the last]
    #[arg(long, value_name = "TICK")]
    to: Option<u64>,
    /// GIF: a picture for every N ticks. [default: 4]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1000))]
    every: Option<u64>,
    /// Dashboard: everything that stands still with its name.
    #[arg(long)]
    names: bool,
    /// Dashboard: what the range sensors see.
    #[arg(long)]
    scan: bool,
}

impl RunArgs {
    /// Whether a run is asked for, of a widget that need not show one.
    fn asked(&self, form: CaptureForm) -> bool {
        form == CaptureForm::Gif || self.run.is_some() || self.seed.is_some() || self.tick.is_some()
    }
}

/// What the other widgets show.
#[derive(Debug, Args)]
pub struct SceneArgs {
    /// Anatomy: the tab; all four when left out.
    #[arg(long, value_parser = one_of(Tab::ALL.map(|tab| (tab.name(), tab, ""))))]
    tab: Option<Tab>,
    /// Anatomy and cspace: the robot, a resident of the world by its name, or one of a kind: rusty, reach, choset,
    /// reach3, hitch. [default: choset; of a run its first]
    #[arg(long, value_name = "NAME|KIND", value_parser = RobotsAndKinds, hide_possible_values = true)]
    robot: Option<String>,
    /// Anatomy, atlas and cspace: a built-in world or the path of a world file. [default: the robot's home; atlas: all
    /// three]
    #[arg(long, value_name = "NAME|FILE", value_parser = WorldNames, hide_possible_values = true)]
    world: Option<String>,
    /// Anatomy and cspace: the configuration, numbers joined by commas. [default: where the robot starts; choset: pi/4,
    /// pi/2]
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    q: Option<NumberList>,
    /// Anatomy and cspace: the step to the second configuration.
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    step: Option<NumberList>,
    /// Anatomy: draw the annulus of points that an arm's tip can reach.
    #[arg(long)]
    annulus: bool,
    /// Cspace: how often the plane is halved for the finest cells. [default: 9; of a run 7]
    #[arg(long, value_name = "LEVEL", value_parser = clap::value_parser!(u32).range(1..=12))]
    cells: Option<u32>,
    /// Cspace: stop after judging this number of cells. [default: when all are proven or as fine as --cells says]
    #[arg(long, value_name = "N")]
    budget: Option<u32>,
    /// Atlas: the grid of this cell size over the world, shaded by its distance transform, metres.
    #[arg(long, value_name = "METRES")]
    grid: Option<f64>,
    /// Atlas: put the world's first robot there, numbers joined by commas; where it cannot be, what it would overlap is
    /// shown, and the nearest place that is free.
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    teleport: Option<NumberList>,
}

/// The widgets that can be captured without a window.
const WIDGETS: [Widget; 4] = [Widget::Dashboard, Widget::Anatomy, Widget::Atlas, Widget::Cspace];

impl Capture {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let paper = self.paper.paper();
        let form = self.form()?;
        let of_run = self.widget == Widget::Dashboard || self.run.asked(form);
        if self.widget == Widget::Anatomy && form == CaptureForm::Gif {
            return Err(self.failure(CaptureError::Frozen));
        }
        if let Some((option, place)) = self.astray(form, of_run) {
            return Err(Failure::usage(format!("{option} is only valid for {place}"), "Leave it out."));
        }
        let target = Target::of(&self.output)?;
        if of_run {
            self.of_run(form, &paper, target.path())?;
        } else {
            let captured = match self.widget {
                Widget::Atlas => widgets::atlas(&self.scene, &paper)?,
                Widget::Cspace => widgets::cspace(&self.scene)?,
                // `plan` is not among the names: `motion-lab plan` draws its own
                Widget::Anatomy | Widget::Dashboard | Widget::Plan => widgets::anatomy(&self.scene)?,
            };
            write_picture(&captured, &paper, form, target.path())?;
        }
        target.finish(data)?;
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
        use Widget::{Anatomy, Atlas, Cspace, Dashboard};
        let (run, scene) = (&self.run, &self.scene);
        let runs: &[Widget] = &[Dashboard, Atlas, Cspace];
        let options: [(&str, bool, &[Widget], &str); 17] = [
            ("--run", run.run.is_some(), runs, "dashboard, atlas and cspace"),
            ("--seed", run.seed.is_some(), runs, "dashboard, atlas and cspace"),
            ("--tick", run.tick.is_some(), runs, "dashboard, atlas and cspace"),
            ("--from", run.from.is_some(), runs, "dashboard, atlas and cspace"),
            ("--to", run.to.is_some(), runs, "dashboard, atlas and cspace"),
            ("--every", run.every.is_some(), runs, "dashboard, atlas and cspace"),
            ("--names", run.names, &[Dashboard], "the dashboard"),
            ("--scan", run.scan, &[Dashboard], "the dashboard"),
            ("--tab", scene.tab.is_some(), &[Anatomy], "the anatomy"),
            ("--robot", scene.robot.is_some(), &[Anatomy, Cspace], "anatomy and cspace"),
            ("--q", scene.q.is_some(), &[Anatomy, Cspace], "anatomy and cspace"),
            ("--step", scene.step.is_some(), &[Anatomy, Cspace], "anatomy and cspace"),
            ("--annulus", scene.annulus, &[Anatomy, Cspace], "anatomy and cspace"),
            ("--cells or --budget", scene.cells.or(scene.budget).is_some(), &[Cspace], "cspace"),
            ("--grid", scene.grid.is_some(), &[Atlas], "the atlas"),
            ("--teleport", scene.teleport.is_some(), &[Atlas], "the atlas"),
            ("--world", scene.world.is_some(), &[Anatomy, Atlas, Cspace], "anatomy, atlas and cspace"),
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
