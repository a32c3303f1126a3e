//! `world generate`: a world from a seed and a number of robots.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use motion_lab_core::random::Seed;
use motion_lab_core::worlds::Warehouse;

use crate::cli::support::input::is_dash;
use crate::cli::support::output::write_file;
use crate::cli::support::target::Target;
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure, Outcome};

/// Generate a world with many robots, the same for the same numbers on every machine.
///
/// A warehouse has aisles that rovers drive round, roads for cars about them, and cells with arms: of ten robots eight
/// rovers, an arm and a car. Rovers and cars follow routes, the drive mode `route`, and never meet; drive one yourself,
/// and they do.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab world generate warehouse --robots 1000 -o warehouse.ron
  motion-lab world generate warehouse --seed 7 --robots 100 --trailers > yard.ron")]
pub struct Generate {
    /// What to generate.
    #[arg(value_name = "WHAT")]
    what: What,
    /// Chooses speeds, starts, and which racks are missing.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The number of robots, 10 to 100,000.
    #[arg(long, value_name = "N")]
    robots: usize,
    /// Give every car a trailer.
    #[arg(long)]
    trailers: bool,
    /// The world file to write. [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum What {
    /// Aisles, shelves and docks.
    Warehouse,
}

impl Generate {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let What::Warehouse = self.what;
        let warehouse = Warehouse { seed: Seed(self.seed), robots: self.robots, trailers: self.trailers };
        let world = warehouse
            .world()
            .map_err(|error| Failure::usage(format!("--robots: {error}"), "Give another number of robots."))?;
        let text = world.to_ron();
        let Some(output) = self.output.as_deref().filter(|output| !is_dash(output)) else {
            data.text(&text)?;
            return Ok(Outcome::Done);
        };
        let target = Target::of(output)?;
        write_file(&target, text.as_bytes())?;
        let (robots, obstacles, routes) = (world.robots.len(), world.obstacles.len(), world.routes.len());
        target.wrote_with(&format!(
            " with {}, {} and {}",
            counted(robots, "robot"),
            counted(obstacles, "obstacle"),
            counted(routes, "route")
        ));
        Ok(Outcome::Done)
    }
}
