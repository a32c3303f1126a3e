//! `capture`: what a widget shows, without a display, as SVG, PNG or GIF.

mod dashboard;
mod paper;
mod widgets;

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::numbers::Numbers;
use super::query::RobotName;
use super::{Failure, Outcome, say};
use paper::{Kind, Paper};

/// Draw what a widget shows, without a display: a figure for a page, as SVG or PNG; the dashboard over a span of ticks as GIF.
///
/// The file's name tells the form. Seed and digest, or the world's content hash and the configuration, are in the file: in the
/// notes of a PNG, the metadata of an SVG, the comment of a GIF.
///
/// dashboard  the run of a log, or of --seed, at --tick
/// anatomy    the queries at a configuration: --tab, --robot, --q, --thick, --step
/// atlas      worlds with their names: --world, --grid, --teleport
/// cspace     the workspace and beside it the configuration space: --robot, --q, --cells, --step
#[derive(Debug, Args)]
#[command(verbatim_doc_comment)]
pub struct Capture {
    /// The widget.
    #[arg(long, value_enum)]
    widget: Widget,
    /// The file to write: .svg, .png or .gif.
    #[arg(short, long, visible_alias = "out", value_name = "FILE")]
    output: PathBuf,
    /// The paper's colours.
    #[arg(long, value_enum, default_value = "light")]
    theme: ThemeName,
    /// The sheet's greatest width, pixels: 420 to 640 for a column, 1280 for a page. Letters keep their size.
    #[arg(long, value_name = "PIXELS", default_value_t = 1280, value_parser = clap::value_parser!(u32).range(200..=4096))]
    width: u32,
    /// PNG and GIF: dots for each pixel of the sheet; 2 or 3 for print.
    #[arg(long, value_name = "TIMES", default_value_t = 1.0, value_parser = parse_scale)]
    scale: f32,
    #[command(flatten)]
    run: RunArgs,
    #[command(flatten)]
    scene: SceneArgs,
}

/// Which run the dashboard shows, and when.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// Dashboard: this log, instead of the run of --seed.
    #[arg(long, value_name = "FILE", conflicts_with = "seed")]
    log: Option<PathBuf>,
    /// Dashboard: the tour's seed.
    #[arg(long, value_name = "SEED")]
    seed: Option<u64>,
    /// Dashboard: the tick. [default: the last]
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
}

/// What the other widgets show.
#[derive(Debug, Args)]
pub struct SceneArgs {
    /// Anatomy: the tab; all four when left out.
    #[arg(long, value_enum)]
    tab: Option<TabName>,
    /// Anatomy and cspace: the robot. [default: choset]
    #[arg(long, value_enum)]
    robot: Option<RobotName>,
    /// Anatomy, atlas and cspace: a built-in world or the path of a world file. [default: the robot's home; atlas: all three]
    #[arg(long, value_name = "NAME|FILE")]
    world: Option<String>,
    /// Anatomy and cspace: the configuration, numbers joined by commas. [default: where the robot starts; choset: pi/4, pi/2]
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    q: Option<Numbers>,
    /// Anatomy and cspace: the step to the second configuration.
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    step: Option<Numbers>,
    /// Anatomy: draw the annulus of points that an arm's tip can reach.
    #[arg(long)]
    annulus: bool,
    /// Cspace: how often the plane is halved for the finest cells. [default: 9]
    #[arg(long, value_name = "LEVEL", value_parser = clap::value_parser!(u32).range(1..=12))]
    cells: Option<u32>,
    /// Cspace: stop after judging so many cells. [default: when all are proven or as fine as --cells says]
    #[arg(long, value_name = "N")]
    budget: Option<u32>,
    /// Atlas: the grid of this cell size over the world, shaded by its distance transform, metres.
    #[arg(long, value_name = "METRES")]
    grid: Option<f64>,
    /// Atlas: put the world's first robot there, numbers joined by commas; where it cannot be, what it would overlap is shown, and
    /// the nearest place that is free.
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    teleport: Option<Numbers>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Widget {
    Dashboard,
    Anatomy,
    Atlas,
    Cspace,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ThemeName {
    Light,
    Dark,
}

/// The anatomy's tabs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum TabName {
    Intersects,
    Distance,
    Witness,
    Swept,
}

fn parse_scale(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(scale) if (0.1..=8.0).contains(&scale) => Ok(scale),
        _ => Err("it must be a number from 0.1 to 8".into()),
    }
}

impl Capture {
    /// Runs the command.
    pub fn run(self) -> Result<Outcome, Failure> {
        let theme = match self.theme {
            ThemeName::Light => motion_lab::ui::Theme::Light,
            ThemeName::Dark => motion_lab::ui::Theme::Dark,
        };
        let paper = Paper::new(&self.output, theme, self.width, self.scale)?;
        if paper.kind() == Kind::Gif && self.widget != Widget::Dashboard {
            return Err(Failure::usage(
                "only the dashboard moves",
                "Name an .svg or .png file, or --widget dashboard.",
            ));
        }
        if let Some((option, place)) = self.astray(paper.kind()) {
            return Err(Failure::usage(format!("{option}: for {place} alone"), "Leave it out."));
        }
        match self.widget {
            Widget::Dashboard => dashboard::capture(&self.run, &paper)?,
            Widget::Anatomy => widgets::anatomy(&self.scene, &paper)?,
            Widget::Atlas => widgets::atlas(&self.scene, &paper)?,
            Widget::Cspace => widgets::cspace(&self.scene, &paper)?,
        }
        say(format!("wrote {}", self.output.display()));
        Ok(Outcome::Done)
    }

    /// The first option given that the widget, or the form, has no use for, and what it goes with.
    fn astray(&self, kind: Kind) -> Option<(&'static str, &'static str)> {
        use Widget::{Anatomy, Atlas, Cspace, Dashboard};
        let (run, scene) = (&self.run, &self.scene);
        let options: [(&str, bool, &[Widget], &str); 15] = [
            ("--log", run.log.is_some(), &[Dashboard], "the dashboard"),
            ("--seed", run.seed.is_some(), &[Dashboard], "the dashboard"),
            ("--tick", run.tick.is_some(), &[Dashboard], "the dashboard"),
            ("--from", run.from.is_some(), &[Dashboard], "the dashboard"),
            ("--to", run.to.is_some(), &[Dashboard], "the dashboard"),
            ("--every", run.every.is_some(), &[Dashboard], "the dashboard"),
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
        stray.map(|(option, .., place)| (option, place)).or_else(|| {
            let span = run.from.or(run.to).or(run.every).is_some();
            match kind {
                Kind::Gif => run.tick.map(|_| ("--tick", "SVG and PNG")),
                _ => span.then_some(("--from, --to and --every", "GIF")),
            }
        })
    }
}
