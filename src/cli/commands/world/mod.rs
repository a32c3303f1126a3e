//! `world`: check world files, list and print worlds, read them from other formats and write them in others.

mod check;
mod export;
mod generate;
mod import;

use std::path::PathBuf;

use clap::{Args, Subcommand};
use motion_lab_core::worlds::World;
use serde::Serialize;

use crate::cli::support::choices::WorldNames;
use crate::cli::support::input::for_each_file;
use crate::cli::support::output::write_text;
use crate::cli::support::simulate::unknown_kind;
use crate::cli::support::words::counted;
use crate::cli::support::world_source::{find_world, read_world};
use crate::cli::{Data, Failure, Outcome, say};
use export::WorldExport;
use generate::Generate;
use import::Import;

/// Check world files; list and print worlds; read them from other formats and write them in others.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab world list
  motion-lab world show lot -o yard.ron
  motion-lab world check yard.ron")]
pub struct WorldArgs {
    #[command(subcommand)]
    command: WorldSubcommand,
}

#[derive(Debug, Subcommand)]
enum WorldSubcommand {
    /// Read world files and say what is in them, or what is wrong with them: what they are written like, robots that
    /// start in contact with something or with one another, obstacles outside the bounds. Every file is read; one that
    /// is wrong makes the exit code 3.
    #[command(after_help = "\
Examples:
  motion-lab world check yard.ron
  motion-lab world check --json worlds/*.ron")]
    Check {
        /// The world files.
        #[arg(required = true, value_name = "FILE")]
        files: Vec<PathBuf>,
        /// One line of JSON for each file that is right.
        #[arg(long)]
        json: bool,
    },
    /// List the built-in worlds.
    #[command(after_help = "\
Examples:
  motion-lab world list
  motion-lab world list --json")]
    List {
        /// One line of JSON for each.
        #[arg(long)]
        json: bool,
    },
    /// Print a world as a world file: a start for one of your own.
    #[command(after_help = "\
Examples:
  motion-lab world show apartment
  motion-lab world show apartment -o mine.ron")]
    Show {
        /// A built-in world's name, or the path of a world file.
        #[arg(value_name = "NAME|FILE", value_parser = WorldNames, hide_possible_values = true)]
        world: String,
        /// Write to this file; standard output when there is none.
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
    Import(Box<Import>),
    Export(WorldExport),
    Generate(Generate),
}

/// From this many robots on, a summary in words says how many there are, not their names.
const MANY: usize = 20;

/// The summary of a world.
#[derive(Serialize)]
struct WorldReport<'a> {
    /// The name or file by which it was asked for.
    source: &'a str,
    name: &'a str,
    content_hash: String,
    obstacles: usize,
    places: usize,
    marks: usize,
    robots: Vec<&'a str>,
}

impl WorldArgs {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        match self.command {
            WorldSubcommand::Check { files, json } => check(&files, json, data),
            WorldSubcommand::List { json } => {
                for name in World::built_in_names() {
                    summarise(name, &find_world(name)?, json, data)?;
                }
                Ok(Outcome::Done)
            }
            WorldSubcommand::Show { world, output } => {
                write_text(output.as_deref(), &find_world(&world)?.to_ron(), data)?;
                Ok(Outcome::Done)
            }
            WorldSubcommand::Import(import) => import.run(data),
            WorldSubcommand::Export(export) => export.run(data),
            WorldSubcommand::Generate(generate) => generate.run(data),
        }
    }
}

fn check(files: &[PathBuf], json: bool, data: &mut Data) -> Result<Outcome, Failure> {
    for_each_file(files, data, |file, data| {
        let (source, world) = (file.display().to_string(), read_world(file)?);
        let problems = check::problems(&world);
        if !problems.is_empty() {
            return Err(Failure::input(
                format!("{source}: {}", problems.join("; ")),
                "Move them apart, or make the bounds larger.",
            ));
        }
        summarise(&source, &world, json, data)?;
        if let Some(unknown) = check::unknown(&world) {
            data.flush()?;
            say(format!("{source}: {unknown}\n{}", unknown_kind()));
        }
        if world.robots.is_empty() {
            data.flush()?;
            say(format!("{source}: no robot lives there: only worlds with robots can be run"));
        }
        Ok(())
    })
}

fn summarise(source: &str, world: &World, json: bool, data: &mut Data) -> Result<(), Failure> {
    let summary = WorldReport {
        source,
        name: &world.name,
        content_hash: format!("{:032x}", world.content_hash()),
        obstacles: world.obstacles.len(),
        places: world.places.len(),
        marks: world.marks.len(),
        robots: world.robots.iter().map(|r| r.name.as_str()).collect(),
    };
    if json {
        return data.json(&summary);
    }
    let WorldReport { name, content_hash, obstacles, places, marks, .. } = &summary;
    let robots = match summary.robots.len() {
        0 => "none".to_owned(),
        many @ MANY.. => many.to_string(),
        _ => summary.robots.join(", "),
    };
    let [obstacles, places, marks] =
        [(obstacles, "obstacle"), (places, "place"), (marks, "mark")].map(|(count, what)| counted(*count, what));
    data.line(format!("{source}: {name}, content {content_hash}, {obstacles}, {places}, {marks}, robots: {robots}"))
}
