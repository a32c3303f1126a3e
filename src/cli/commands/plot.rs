//! `plot`: a quantity of a run's robots over its time.

use std::path::PathBuf;

use crate::capture::{CaptureForm, MAX_LINES, RunPlot, plot};
use clap::Args;
use motion_lab_core::configuration::Kinds;
use motion_lab_core::names::did_you_mean;
use motion_lab_sim::run::{Difference, Log, Quantity, Recipe, Series, SeriesGatherer};

use crate::cli::support::choices::{RobotNames, form, one_of};
use crate::cli::support::input::{is_dash, shown};
use crate::cli::support::log_source::{LogSource, read_log, say_damage};
use crate::cli::support::paper::{PaperArgs, write_picture};
use crate::cli::support::simulate::each_frame;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome, say};

/// Plot a quantity of a run's robots over its time, as SVG or PNG.
///
/// Where a robot was in contact, the time is shaded, and its line is broad in the colour of contacts.
///
/// Seed and digest are in the file. Of a log with frames nothing is simulated; the run of a digest log is simulated
/// again first.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab plot run.mcap --what clearance -o clearance.svg
  motion-lab plot run.mcap --what speed --format png -o - > speed.png
  motion-lab plot run.mcap --what joints --robot Reach --theme dark -o joints.png")]
pub struct PlotArgs {
    /// The log; `-` is standard input.
    file: PathBuf,
    /// What is plotted.
    #[arg(long, value_parser = one_of(QUANTITIES), value_name = "QUANTITY")]
    what: Quantity,
    /// The file to write: .svg or .png. `-` is standard output.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The form. [default: by the output's name; svg for `-`]
    #[arg(long, value_parser = form([CaptureForm::Svg, CaptureForm::Png]))]
    format: Option<CaptureForm>,
    /// Plot the robots named so only; may be given several times. [default: every robot that has the quantity, up to 8
    /// lines]
    #[arg(long, value_name = "NAME", value_parser = RobotNames, hide_possible_values = true)]
    robot: Vec<String>,
    #[command(flatten)]
    paper: PaperArgs,
}

/// The quantities, by name.
const QUANTITIES: [(&str, Quantity, &str); 4] = [
    ("clearance", Quantity::Clearance, "The distance to the nearest obstacle, metres"),
    ("speed", Quantity::Speed, "The speed, metres per second; of an arm its tip's"),
    ("joints", Quantity::Joints, "The joint angles of arms, radians"),
    ("encoders", Quantity::Encoders, "The distance by the encoders of rovers, and the distance driven, metres"),
];

impl PlotArgs {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let form = self.form()?;
        let LogSource { log, damage, .. } = read_log(&self.file)?;
        say_damage(damage.as_ref(), "plotted");
        let (series, difference) = self.series(&log)?;
        if let Some(difference) = &difference {
            say(format!("{}: the run does not repeat its recording: {difference}", shown(&self.file)));
        }
        let digest = log.digest().map_or_else(|| "of an unfinished log".into(), |digest| digest.to_string());
        let (ticks, seed) = (log.ticks(), log.recipe.seed);
        let run = RunPlot { quantity: self.what, series: &series, ticks, seed, digest };
        let paper = self.paper.paper();
        let captured = plot(&run, paper.width_px());
        let target = Target::of(&self.output)?;
        write_picture(&captured, &paper, form, &target)?;
        target.finish(data)?;
        Ok(match (difference, damage) {
            (Some(_), _) => Outcome::Differs,
            (None, Some(_)) => Outcome::Recovered,
            (None, None) => Outcome::Done,
        })
    }

    /// The form: what was said, else what the output's name tells.
    fn form(&self) -> Result<CaptureForm, Failure> {
        let of_name = || CaptureForm::of(&self.output).filter(|form| *form != CaptureForm::Gif);
        let named = || if is_dash(&self.output) { Some(CaptureForm::Svg) } else { of_name() };
        self.format.or_else(named).ok_or_else(|| {
            let reason = format!("{}: its name does not tell the form of a plot", self.output.display());
            Failure::usage(reason, "Let it end in .svg or .png, or say --format.")
        })
    }

    /// The lines to be drawn, and what differs where a run was simulated again.
    fn series(&self, log: &Log) -> Result<(Vec<Series>, Option<Difference>), Failure> {
        let Recipe { config, script, .. } = &log.recipe;
        let there = || config.robot_names().collect::<Vec<_>>().join(", ");
        if let Some(unknown) = self.robot.iter().find(|name| !config.robot_names().any(|known| known == *name)) {
            let reason = format!("--robot {unknown}: the run has no such robot");
            let meant = did_you_mean(unknown, config.robot_names());
            return Err(Failure::usage(reason, format!("{meant}It has {}.", there())));
        }
        let wants = |name: &str| self.robot.is_empty() || self.robot.iter().any(|wanted| wanted == name);
        let kinds = Kinds::default();
        let mut gatherer = SeriesGatherer::new(self.what, config, script, &kinds, wants);
        match gatherer.lines() {
            0 => {
                let (what, next) = match self.what {
                    Quantity::Joints => ("joints", "Name a run with an arm, or another --what."),
                    _ => ("encoders", "Name a run with a rover, or another --what."),
                };
                let file = shown(&self.file);
                return Err(Failure::usage(format!("{file}: no robot asked for has {what}"), next));
            }
            lines if lines > MAX_LINES => {
                say(format!("{lines} lines: the first {MAX_LINES} are drawn; choose others by --robot"));
                gatherer.truncate(MAX_LINES);
            }
            _ => {}
        }
        let difference = each_frame(log, |frame| gatherer.see(frame))?;
        Ok((gatherer.series(), difference))
    }
}
