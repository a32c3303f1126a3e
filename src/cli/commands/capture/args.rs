//! `Capture`, what `capture` is asked for.

use crate::capture::CaptureForm;
use crate::cli::commands::plan::planners::planner_name;
use crate::cli::support::choices::{NumberList, RobotsAndKinds, WorldNames, form, one_of};
use crate::cli::support::paper::PaperArgs;
use clap::Args;
use motion_lab_sim::anatomy::Tab;
use motion_lab_sim::manifest::Widget;
use motion_lab_sim::plans::PlannerName;
use std::path::PathBuf;

/// Draw what a widget shows, without a display: a figure for a page, as SVG or PNG; as GIF a run over a span of ticks,
/// or how a planner grows
///
/// The file's name tells the form, or --format. Seed and digest, or the world's content hash and the configuration, are
/// in the file: in the notes of a PNG, the metadata of an SVG, the comment of a GIF.
///
/// dashboard  the run of a log, or of --seed, at --tick
/// anatomy    the queries at a configuration: --tab, --robot, --q, --step
/// atlas      worlds and their robots: --world, --grid, --teleport; of a run: --seed or --run, its robots where they
///            are
/// cspace     the workspace and beside it the configuration space: --robot, --q, --cells, --step; of a run: --seed or
///            --run, a robot of it with its way
/// plan       a path and what its planner has grown: --robot from --q to --goal, --planner, --seed
#[derive(Debug, Args)]
#[command(
    verbatim_doc_comment,
    after_help = "\
Examples:
  motion-lab capture --widget anatomy --tab witness -o witness.png
  motion-lab capture --widget dashboard --run run.mcap --tick 300 --names -o run.svg
  motion-lab capture --widget cspace --robot reach --theme dark -o - > space.svg
  motion-lab capture --widget dashboard --from 0 --to 200 -o start.gif
  motion-lab capture --widget plan --robot rusty --goal 9.75,6.25 --planner rrt -o growth.gif"
)]
pub struct Capture {
    /// The widget.
    #[arg(long, value_parser = one_of(Widget::ALL.map(|widget| (widget.id(), widget, ""))))]
    pub(super) widget: Widget,
    /// The file to write: .svg, .png or .gif. `-` is standard output.
    #[arg(short, long, alias = "out", value_name = "FILE")]
    pub(super) output: PathBuf,
    /// The form. [default: by the output's name; svg for `-`]
    #[arg(long, value_parser = form(CaptureForm::ALL))]
    pub(super) format: Option<CaptureForm>,
    #[command(flatten)]
    pub(super) paper: PaperArgs,
    #[command(flatten)]
    pub(super) run: RunArgs,
    #[command(flatten)]
    pub(super) scene: SceneArgs,
}

/// Which run is shown, and when.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// The run of this log, instead of that of --seed; `-` is standard input.
    #[arg(long, alias = "log", value_name = "FILE", conflicts_with = "seed")]
    pub(super) run: Option<PathBuf>,
    /// The tour of this seed; plan: the seed of the planner's samples. [default: 2005, where a run is shown]
    #[arg(long, value_name = "SEED")]
    pub(super) seed: Option<u64>,
    /// SVG and PNG of a run: the tick. [default: the last]
    #[arg(long, value_name = "TICK")]
    pub(super) tick: Option<u64>,
    /// GIF: the first tick. [default: 0]
    #[arg(long, value_name = "TICK")]
    pub(super) from: Option<u64>,
    /// GIF: the last tick. [default: the last]
    #[arg(long, value_name = "TICK")]
    pub(super) to: Option<u64>,
    /// GIF: a picture for every N ticks. [default: 4]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1000))]
    pub(super) every: Option<u64>,
    /// Dashboard and atlas: everything that stands still with its name.
    #[arg(long)]
    pub(super) names: bool,
    /// Dashboard: what the range sensors see.
    #[arg(long)]
    pub(super) scan: bool,
    /// Dashboard: what is nearest to each robot.
    #[arg(long)]
    pub(super) nearest: bool,
}

impl RunArgs {
    /// Whether a run is asked for, of a widget that need not show one.
    pub(super) fn asked(&self, form: CaptureForm) -> bool {
        form == CaptureForm::Gif || self.run.is_some() || self.seed.is_some() || self.tick.is_some()
    }
}

/// What the other widgets show.
#[derive(Debug, Args)]
pub struct SceneArgs {
    /// Anatomy: the tab; all four when left out.
    #[arg(long, value_parser = one_of(Tab::ALL.map(|tab| (tab.name(), tab, ""))))]
    pub(super) tab: Option<Tab>,
    /// Anatomy, cspace and plan: the robot, a resident of the world by its name, or one of a kind: rusty, reach,
    /// choset, reach3, hitch. [default: choset; plan: Reach; of a run its first]
    #[arg(long, value_name = "NAME|KIND", value_parser = RobotsAndKinds, hide_possible_values = true)]
    pub(super) robot: Option<String>,
    /// Anatomy, atlas, cspace and plan: a built-in world or the path of a world file. [default: the robot's home;
    /// atlas: all three]
    #[arg(long, value_name = "NAME|FILE", value_parser = WorldNames, hide_possible_values = true)]
    pub(super) world: Option<String>,
    /// Anatomy and cspace: the configuration, numbers joined by commas; plan: where the path begins. [default: where
    /// the robot starts; choset: pi/4, pi/2]
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    pub(super) q: Option<NumberList>,
    /// Anatomy and cspace: the step to the second configuration.
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    pub(super) step: Option<NumberList>,
    /// Anatomy: draw the annulus of points that an arm's tip can reach.
    #[arg(long)]
    pub(super) annulus: bool,
    /// Cspace: how often the plane is halved for the finest cells. [default: 9; of a run 7]
    #[arg(long, value_name = "LEVEL", value_parser = clap::value_parser!(u32).range(1..=12))]
    pub(super) cells: Option<u32>,
    /// Cspace: stop after judging this number of cells. [default: when all are proven or as fine as --cells says]
    #[arg(long, value_name = "N")]
    pub(super) budget: Option<u32>,
    /// Plan: where the path ends. [default: of Reach round the post, 3.1,0 from 2.0,0]
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    pub(super) goal: Option<NumberList>,
    /// Plan: the planner. [default: hybrid-a-star for a car, rrt-connect for any other robot]
    #[arg(long, value_name = "PLANNER", value_parser = planner_name())]
    pub(super) planner: Option<PlannerName>,
    /// Atlas: the grid of this cell size over the world, shaded by its distance transform, metres.
    #[arg(long, value_name = "METRES")]
    pub(super) grid: Option<f64>,
    /// Atlas: put the world's first robot there, numbers joined by commas; where it cannot be, what it would overlap is
    /// shown, and the nearest place that is free.
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    pub(super) teleport: Option<NumberList>,
}
