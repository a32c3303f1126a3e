//! `PlanArgs`, what `plan` is asked for.

use super::planners::planner_name;
use crate::capture::CaptureForm;
use crate::cli::commands::record::SeedRange;
use crate::cli::support::choices::{NumberList, RobotsAndKinds, WorldNames, checker, form};
use crate::cli::support::paper::PaperArgs;
use clap::Args;
use motion_lab_sim::plans::{CheckerName, PlannerName};
use std::path::PathBuf;

/// Plan a path that is proven free along its whole length, or say why there is none.
///
/// A path is certified: every leg has the steps that prove it free, and a verifier of its own has checked them before
/// the path is printed. Where no path is found within the bound on iterations, where the start or the goal is in
/// contact, or where a planner has searched all that it looks at, that is said, and the exit code is 4. Where
/// cell-decomposition proves that there is no path, it is 7; --barrier writes the proof, and --what-blocks says what to
/// move. --bound says how short a path may be at all.
///
/// With -o the path goes to a file as JSON, with --script to an input script that plays it, with --record to the log of
/// the run in which the script plays it, with --svg to a picture, with --gif to a film of the planner's growth. What
/// can't be played is refused when the script is made. One of them may be `-`, standard output; what else is said then
/// goes to standard error.
///
/// With --checker parry the planner asks the book's black box instead. Nothing of its path is proven: it may lead
/// through a wall, and can't be played.
///
/// With --compare several planners work on the same problem, or by --problems on all of a file, at several seeds; --csv
/// has a row for each attempt, --ompl the same for OMPL's tools.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab plan --robot reach --from 2.0,0 --to 3.1,0 --svg path.svg --gif growth.gif
  motion-lab plan --planner rrt-connect --robot reach --from 2.0,0 --to 3.1,0 --seed 7 -o path.json --script out.ron
  motion-lab plan --robot hitch --from 6.5,2.5,0,0 --to 6.75,7,-1.5707963,-1.5707963 --record parked.mcap
  motion-lab plan --robot Rusty --to 9.75,6.25 --planner tangent-graph --bound
  motion-lab plan --robot Rusty --world shut.ron --to 9.75,6.25 --barrier proof.json
  motion-lab plan --robot Rusty --world shut.ron --to 9.75,6.25 --what-blocks
  motion-lab plan --compare rrt-connect,prm,a-star --robot rusty --to 9.75,6.25 --seeds 0..20 --csv planners.csv
  motion-lab plan --compare rrt-connect,a-star --robot rusty --world arena.ron --problems arena.scen --csv all.csv
  motion-lab plan --compare rrt-connect,prm --problems mazes.ron --seeds 0..10 --csv all.csv
  motion-lab plan --problems mazes.ron --problem 3 --svg third.svg")]
pub struct PlanArgs {
    /// The planner. [default: hybrid-a-star for a car, rrt-connect for any other robot]
    #[arg(long, value_name = "PLANNER", value_parser = planner_name(), conflicts_with = "compare")]
    pub(super) planner: Option<PlannerName>,
    /// The robot: a resident of the world by its name, with the sizes that the world says; else one of a kind: rusty
    /// (x,y), reach (th1,th2), choset (the same arm without thickness), reach3 (th1,th2,th3), hitch (x,y,theta;
    /// with the trailer x,y,theta,psi).
    /// Of a problem file the problems of this robot or kind.
    #[arg(long, value_name = "NAME|KIND", value_parser = RobotsAndKinds, hide_possible_values = true)]
    #[arg(required_unless_present = "problems")]
    pub(super) robot: Option<String>,
    /// A built-in world or the path of a world file; the robot's home when left out.
    #[arg(long, value_name = "NAME|FILE", value_parser = WorldNames, hide_possible_values = true)]
    pub(super) world: Option<String>,
    /// Where the path begins: numbers joined by commas, in metres and radians. [default: where the robot starts]
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    pub(super) from: Option<NumberList>,
    /// Where the path ends.
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true, required_unless_present = "problems")]
    pub(super) to: Option<NumberList>,
    /// The seed of the planner's samples, and of the run that plays the path.
    #[arg(long, default_value_t = 2005, conflicts_with = "compare")]
    pub(super) seed: u64,
    /// The greatest number of iterations. With it rrt-star, informed-rrt-star and prm go on to that number and shorten
    /// their path, in a comparison too; without it the first path is taken. [default: 20000 for hybrid-a-star, 100000
    /// for any other planner]
    #[arg(long, value_name = "N")]
    pub(super) iterations: Option<u64>,
    /// A rover is planned this much larger, metres, so that its script may stray from the path by as much: 0 to 1.
    #[arg(long, value_name = "METRES", default_value_t = 0.02)]
    pub(super) tube: f64,
    /// The clearance that the path keeps from every obstacle, beside the tube, metres: 0 to 100. Start and goal are to
    /// have it too. With 0 the path touches nothing, and may come as near as a proof can tell. [default: 0.001 for
    /// rrt-connect, rrt, rrt-star, informed-rrt-star and prm, if start and goal have it; 0 for any other planner]
    #[arg(long, value_name = "METRES", allow_hyphen_values = true)]
    pub(super) clearance: Option<f64>,
    /// Who answers the planner's questions. With parry, the book's black box, nothing is proven: what is printed and
    /// written says so, and adds what the exact checker finds along the path.
    #[arg(long, value_name = "CHECKER", value_parser = checker(), default_value = "exact", conflicts_with = "compare")]
    pub(super) checker: CheckerName,
    /// Write the path to this file, as JSON.
    #[arg(short, long, value_name = "FILE", conflicts_with = "compare")]
    pub(super) output: Option<PathBuf>,
    /// Write what the planner has grown to the path's file too.
    #[arg(long, requires = "output")]
    pub(super) growth: bool,
    /// Write the script that plays the path to this file.
    #[arg(long, value_name = "FILE", conflicts_with = "compare")]
    pub(super) script: Option<PathBuf>,
    /// Play the path, and write the log of the run to this file.
    #[arg(long, value_name = "FILE", conflicts_with = "compare")]
    pub(super) record: Option<PathBuf>,
    /// Write a picture of the path and of what the planner has grown to this file, as SVG, or as PNG if its
    /// name ends so.
    #[arg(long, value_name = "FILE", conflicts_with = "compare")]
    pub(super) svg: Option<PathBuf>,
    /// The form of the picture. [default: by its name; svg]
    #[arg(long, requires = "svg", value_parser = form([CaptureForm::Svg, CaptureForm::Png]))]
    pub(super) format: Option<CaptureForm>,
    /// Write how the planner grows, in the workspace and in the configuration space, to this file as GIF.
    #[arg(long, value_name = "FILE", conflicts_with = "compare")]
    pub(super) gif: Option<PathBuf>,
    /// Where there is no path, write the proof to this file, as JSON: blocked cells of the configuration space that
    /// part the start from the goal. By cell-decomposition, which then need not be named.
    #[arg(long, value_name = "FILE", conflicts_with = "compare")]
    pub(super) barrier: Option<PathBuf>,
    /// Where there is no path, say what to move: the least set of doors to open and obstacles to take away for which a
    /// proven path appears. By cell-decomposition, which then need not be named.
    #[arg(long, conflicts_with = "compare")]
    pub(super) what_blocks: bool,
    /// Shorten the path by shortcuts and cut corners once there is one; it is as certified as before. A car's path and
    /// the film of --gif stay as they are.
    #[arg(long, conflicts_with = "compare")]
    pub(super) shorten: bool,
    /// Say a length that no path undercuts, --tube and, if it is given, --clearance kept: of a rover that of the
    /// shortest path, by tangents and arcs; of an arm or a car one that cells prove, which is shorter. Where there
    /// is no path at all it proves that, and the exit code is 7.
    #[arg(long, conflicts_with = "compare")]
    pub(super) bound: bool,
    /// Print the result as JSON.
    #[arg(long)]
    pub(super) json: bool,
    /// Compare these planners, joined by commas.
    #[arg(long, value_parser = planner_name(), value_delimiter = ',', value_name = "PLANNERS")]
    pub(super) compare: Vec<PlannerName>,
    /// Take the problems of this file: a problem file, which ends in .ron and says worlds, robots, starts and goals, or
    /// a MovingAI scenario, whose world is that of its map. With --compare all of them, else the one of --problem.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["from", "to"])]
    pub(super) problems: Option<PathBuf>,
    /// The number of one of these problems, from 1; `motion-lab problems` lists them.
    #[arg(long, value_name = "N", requires = "problems", conflicts_with = "compare")]
    pub(super) problem: Option<u64>,
    /// The seeds of a comparison, without the last. [default: 0..100; of a file's problems 0..1]
    #[arg(long, value_name = "A..B", requires = "compare")]
    pub(super) seeds: Option<SeedRange>,
    /// Write a row for each attempt of a comparison to this file: as Parquet if its name ends so, else as CSV.
    #[arg(long, value_name = "FILE", requires = "compare")]
    pub(super) csv: Option<PathBuf>,
    /// Write the lengths of a comparison's paths as they fell to this file: after how many iterations each attempt had
    /// its first path, and each shorter one, as read every 500 iterations, as CSV; or the medians of each planner as a
    /// picture, if its name ends in .svg or .png.
    #[arg(long, value_name = "FILE", requires = "compare")]
    pub(super) costs: Option<PathBuf>,
    /// Write a comparison to this file in the grammar of OMPL's benchmark logs, which ompl_benchmark_statistics.py and
    /// Planner Arena read: an experiment of one problem. Of several problems each has a file of its own, with the
    /// problem's number before the ending.
    #[arg(long, value_name = "FILE", requires = "compare")]
    pub(super) ompl: Option<PathBuf>,
    #[command(flatten)]
    pub(super) paper: PaperArgs,
}
