//! `script`: check, print and make input scripts.

mod table;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use motion_lab_sim::run::Script;
use motion_lab_sim::tour::TourConfig;
use serde::Serialize;

use crate::cli::support::choices::WorldNames;
use crate::cli::support::console::note;
use crate::cli::support::input::{for_each_file, read_bytes_if, read_text};
use crate::cli::support::log_source::read_log;
use crate::cli::support::output::write_text;
use crate::cli::support::words::{changes_in_words, counted, none, parse_script, unfit};
use crate::cli::support::world_source::find_world;
use crate::cli::{Data, Failure, Outcome, say};

/// Check and print input scripts; make one from a table
///
/// A script, with each input once; ticks ascend, and 20 of them are a second:
///
/// Script(version: 1, events: [
///     (tick: 1, robot: "Hitch", input: Drive(128, -64)),
///     (tick: 1, robot: "Reach", input: MoveTo([1048576, 524288])),
///     (tick: 9, robot: "Rusty", input: Teleport([2359296, 6553600, 0])),
///     (tick: 20, robot: "Hitch", input: SetTrailer(true)),
///     (tick: 90, robot: "Hitch", input: Release)])
///
/// Drive holds two channels, from -128 to 128, the maximum: a rover's speed and turn rate, a car's speed and steering
/// angle. The coordinates of MoveTo and Teleport are whole numbers in units of 2^-20 m or rad: 1048576 is 1, 524288 a
/// half. `script convert` makes them of a table in metres and radians. Release gives the robot back to its tour.
#[derive(Debug, Args)]
#[command(verbatim_doc_comment)]
#[command(after_help = "\
Examples:
  motion-lab script check drive.ron --world apartment
  motion-lab script print run.mcap -o drive.ron
  motion-lab script convert drive.csv -o drive.ron")]
pub struct ScriptArgs {
    #[command(subcommand)]
    command: ScriptCommand,
}

#[derive(Debug, Subcommand)]
enum ScriptCommand {
    /// Read scripts and say what is in them, or what is wrong with them. Every file is read; one that is wrong makes
    /// the exit code 3.
    #[command(after_help = "\
Examples:
  motion-lab script check drive.ron
  motion-lab script check --world apartment --json scripts/*.ron")]
    Check {
        /// The scripts.
        #[arg(required = true, value_name = "FILE")]
        files: Vec<PathBuf>,
        /// Check the inputs against their world as well: a built-in world or a world file that the robots live in; may
        /// be given several times. A robot must be there and take the input: a rover or a car takes no MoveTo, an arm
        /// no Drive, only a car SetTrailer.
        #[arg(long, value_name = "NAME|FILE", value_parser = WorldNames, hide_possible_values = true)]
        world: Vec<String>,
        /// One line of JSON for each file that is right.
        #[arg(long)]
        json: bool,
    },
    /// Print a script in its canonical form: an event a line.
    #[command(after_help = "\
Examples:
  motion-lab script print run.mcap -o drive.ron
  motion-lab script print - < run.mcap")]
    Print {
        /// A script, or a log with one.
        file: PathBuf,
        /// Write to this file; standard output when there is none.
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
    /// Make a script from a table of comma-separated values.
    ///
    /// A row is `tick,robot,input` and the input's values: `1,Rusty,Drive,64,-20` (parts in 128 of the maximum),
    /// `5,Reach,MoveTo,0.785,90deg` and `7,Rusty,Teleport,2.25,6.25,0` (metres, and radians or degrees, rounded to
    /// 2^-20), `9,Hitch,SetTrailer,on`, `12,Rusty,Release`. Ticks ascend. A first row that begins with `tick` is a
    /// heading; empty rows and rows that begin with # are left out. Semicolons, tabs or bars may stand between the
    /// values, numbers may then have decimal commas; whole numbers may end in `.0`, `on` may be `TRUE`. Any line ends
    /// will do.
    #[command(after_help = "\
Examples:
  motion-lab script convert drive.csv -o drive.ron")]
    Convert {
        /// The table.
        #[arg(value_name = "FILE.csv")]
        file: PathBuf,
        /// Check the inputs against their world, as `script check` does; may be given several times.
        #[arg(long, value_name = "NAME|FILE")]
        world: Vec<String>,
        /// Write to this file; standard output when there is none.
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
}

/// The summary of a script.
#[derive(Serialize)]
struct ScriptSummary<'a> {
    source: String,
    events: usize,
    /// Changes of worlds; left out where there are none.
    #[serde(skip_serializing_if = "none")]
    changes: usize,
    /// The ticks of the first and the last event or change.
    first: Option<u64>,
    last: Option<u64>,
    /// The robots in the order of their first events.
    robots: Vec<&'a str>,
}

impl ScriptArgs {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        match self.command {
            ScriptCommand::Check { files, world, json } => check(&files, &world, json, data),
            ScriptCommand::Print { file, output } => print(&file, output.as_deref(), data),
            ScriptCommand::Convert { file, world, output } => {
                let config = config(&world)?;
                let text = read_text(&file)?;
                let (script, turns) = table::script(&text, config.as_ref()).map_err(|error| {
                    Failure::input(
                        format!("{}:{error}", file.display()),
                        "Correct it there; `motion-lab script convert --help` tells the form.",
                    )
                })?;
                turns.iter().for_each(|turns| note(format!("{}:{turns}", file.display())));
                if script.events.is_empty() {
                    say(format!("{}: no events: the script is empty", file.display()));
                }
                write_text(output.as_deref(), &script.to_ron(), data)?;
                Ok(Outcome::Done)
            }
        }
    }
}

fn read_script(file: &Path) -> Result<Script, Failure> {
    parse_script(file, &read_text(file)?)
}

fn print(file: &Path, output: Option<&Path>, data: &mut Data) -> Result<Outcome, Failure> {
    // a log begins with a byte that begins no text
    if read_bytes_if(file, 0, |_| false)?.first() != Some(&0x89) {
        write_text(output, &read_script(file)?.to_ron(), data)?;
        return Ok(Outcome::Done);
    }
    let source = read_log(file)?;
    write_text(output, &source.log.recipe.script.to_ron(), data)?;
    Ok(match source.damage {
        None => Outcome::Done,
        Some(damage) => {
            say(format!("{damage}\nThe script is whole all the same."));
            Outcome::Recovered
        }
    })
}

/// A run of these worlds; `None` without any.
fn config(worlds: &[String]) -> Result<Option<TourConfig>, Failure> {
    let worlds = worlds.iter().map(|name| find_world(name)).collect::<Result<Vec<_>, _>>()?;
    Ok((!worlds.is_empty()).then_some(TourConfig { worlds, ticks: 0, sensor: None }))
}

fn check(files: &[PathBuf], worlds: &[String], json: bool, data: &mut Data) -> Result<Outcome, Failure> {
    let config = config(worlds)?;
    for_each_file(files, data, |file, data| {
        let (name, text) = (file.display().to_string(), read_text(file)?);
        let script = parse_script(file, &text)?;
        if let Some(config) = &config {
            script.check_for(config).map_err(|error| unfit(error.located(&name, &text), config))?;
        }
        summarise(file, &script, json, data)
    })
}

fn summarise(file: &Path, script: &Script, json: bool, data: &mut Data) -> Result<(), Failure> {
    // in the order in which they come
    let mut seen = BTreeSet::new();
    let robots: Vec<&str> = script.events.iter().map(|e| e.robot.as_str()).filter(|name| seen.insert(*name)).collect();
    let ticks = || script.events.iter().map(|e| e.tick).chain(script.changes.iter().map(|c| c.tick));
    let summary = ScriptSummary {
        source: file.display().to_string(),
        events: script.events.len(),
        changes: script.changes.len(),
        first: ticks().min(),
        last: ticks().max(),
        robots,
    };
    if json {
        return data.json(&summary);
    }
    let ScriptSummary { source, events, changes, robots, .. } = &summary;
    let changes = changes_in_words(*changes);
    match (summary.first, summary.last) {
        (Some(first), Some(last)) => {
            let robots = robots.join(", ");
            let ticks = if first == last { format!("tick {first}") } else { format!("ticks {first} to {last}") };
            data.line(format!("{source}: {}{changes}, {ticks}, robots: {robots}", counted(*events, "event")))
        }
        _ => data.line(format!("{source}: no events")),
    }
}
