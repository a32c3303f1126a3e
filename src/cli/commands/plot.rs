//! `plot`: a quantity of a run's robots over its time.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use motion_lab::capture::{self, CaptureError, Form, MOST_LINES, Paper, RunPlot};
use motion_lab::configuration::Kinds;
use motion_lab::run::{Quantity, Series, SeriesGatherer};

use crate::cli::commands::capture::parse_scale;
use crate::cli::support::choices::{RobotNames, ThemeName};
use crate::cli::support::log_kind::AnyLog;
use crate::cli::support::log_source::{AnySource, read_any_log};
use crate::cli::support::simulate::each_frame;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome, say};

/// Plot a quantity of a run's robots over its time, as SVG or PNG.
///
/// Seed and digest are in the file. Of a log with frames nothing is simulated; the run of a digest log is simulated
/// again first.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab plot run.mcap --what clearance -o clearance.svg
  motion-lab plot run.mcap --what joints --robot Reach --theme dark -o joints.png")]
pub struct PlotArgs {
    /// The log.
    file: PathBuf,
    /// What is plotted.
    #[arg(long, value_enum, value_name = "QUANTITY")]
    what: What,
    /// The file to write: .svg or .png.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Plot the robots named so only; may be given several times. [default: every robot that has the quantity, up to 8
    /// lines]
    #[arg(long, value_name = "NAME", value_parser = RobotNames, hide_possible_values = true)]
    robot: Vec<String>,
    /// The paper's colours.
    #[arg(long, value_enum, default_value = "light")]
    theme: ThemeName,
    /// The sheet's greatest width, pixels: 420 to 640 for a column, 1280 for a page. Letters keep their size.
    #[arg(long, value_name = "PIXELS", default_value_t = 1280, value_parser = clap::value_parser!(u32).range(200..=4096))]
    width: u32,
    /// PNG: dots for each pixel of the sheet; 2 or 3 for print.
    #[arg(long, value_name = "TIMES", default_value_t = 1.0, value_parser = parse_scale)]
    scale: f32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum What {
    /// The distance to the nearest obstacle, metres.
    Clearance,
    /// The speed, metres per second; of an arm its tip's.
    Speed,
    /// The joint angles of arms, radians.
    Joints,
    /// The distance by the encoders of rovers, and the distance driven, metres.
    Encoders,
}

impl PlotArgs {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let form = Form::of(&self.output).filter(|form| *form != Form::Gif).ok_or_else(|| {
            let reason = format!("{}: its name does not tell the form of a plot", self.output.display());
            Failure::usage(reason, "Let it end in .svg or .png.")
        })?;
        let AnySource { log, damage, .. } = read_any_log(&self.file)?;
        if let Some(damage) = &damage {
            say(format!("{damage}\nThis much is plotted; `motion-lab record --resume` makes it whole."));
        }
        let (series, difference) = self.series(&log)?;
        if let Some(difference) = &difference {
            say(format!("{}: the run does not repeat its recording: {difference}", self.file.display()));
        }
        let digest = match &log {
            AnyLog::Full(log) => log.digest().to_string(),
            AnyLog::Digest(log) => log.digest.map_or_else(|| "of an unfinished log".into(), |d| d.to_string()),
        };
        let plot =
            RunPlot { quantity: self.quantity(), series: &series, ticks: log.recorded(), seed: log.parts().0, digest };
        let paper = Paper { palette: self.theme.theme().palette(), width: self.width, scale: self.scale };
        let captured = capture::plot(&plot, paper.width_px());
        let target = Target::of(&self.output)?;
        capture::write(&captured, &paper, form, target.path()).map_err(|error| match error {
            CaptureError::Write(error) => Failure::output(&self.output, &error),
            CaptureError::Fault(reason) => Failure::internal(anyhow::anyhow!(reason)),
            error => Failure::usage(error, "Choose a smaller --width or --scale."),
        })?;
        target.finish(data)?;
        Ok(match (difference, damage) {
            (Some(_), _) => Outcome::Differs,
            (None, Some(_)) => Outcome::Recovered,
            (None, None) => Outcome::Done,
        })
    }

    fn quantity(&self) -> Quantity {
        match self.what {
            What::Clearance => Quantity::Clearance,
            What::Speed => Quantity::Speed,
            What::Joints => Quantity::Joints,
            What::Encoders => Quantity::Encoders,
        }
    }

    /// The lines to be drawn, and what differs where a run was simulated again.
    fn series(&self, log: &AnyLog) -> Result<(Vec<Series>, Option<String>), Failure> {
        let (_, config, script) = log.parts();
        let there = || config.robot_names().collect::<Vec<_>>().join(", ");
        if let Some(unknown) = self.robot.iter().find(|name| !config.robot_names().any(|known| known == *name)) {
            let reason = format!("--robot {unknown}: the run has no such robot");
            return Err(Failure::usage(reason, format!("It has {}.", there())));
        }
        let wants = |name: &str| self.robot.is_empty() || self.robot.iter().any(|wanted| wanted == name);
        let kinds = Kinds::default();
        let mut gatherer = SeriesGatherer::new(self.quantity(), config, script, &kinds, wants);
        match gatherer.lines() {
            0 => {
                let (what, next) = match self.what {
                    What::Joints => ("joints", "Name a run with an arm, or another --what."),
                    _ => ("encoders", "Name a run with a rover, or another --what."),
                };
                let file = self.file.display();
                return Err(Failure::usage(format!("{file}: no robot asked for has {what}"), next));
            }
            lines if lines > MOST_LINES => {
                say(format!("{lines} lines: the first {MOST_LINES} are drawn; choose others by --robot"));
                gatherer.truncate(MOST_LINES);
            }
            _ => {}
        }
        let difference = each_frame(log, |frame| gatherer.see(frame))?;
        Ok((gatherer.series(), difference))
    }
}
