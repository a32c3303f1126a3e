//! From options to a run's seed, configuration and script.

use motion_lab_core::random::Seed;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_sim::run::{DT, Script};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

use super::args::RecordArgs;
use super::choice::choose;
use crate::cli::Failure;
use crate::cli::support::input::read_text;
use crate::cli::support::words::{parse_script, unfit};
use crate::cli::support::world_source::find_world;

/// The seed.
pub fn seed(options: &RecordArgs) -> Seed {
    options.seed.map_or(BOOK_SEED, Seed)
}

/// The configuration: the default tour with what the options change.
pub fn config(options: &RecordArgs) -> Result<TourConfig, Failure> {
    let mut config = TourConfig::default();
    if !options.world.is_empty() {
        config.worlds = options.world.iter().map(|name| find_world(name)).collect::<Result<_, _>>()?;
    }
    choose(&mut config.worlds, &options.robot, &options.place)?;
    config.ticks = ticks(options)?.unwrap_or(config.ticks);
    let RangeSensor { n_rays, max_range } = config.sensor.unwrap_or(RangeSensor { n_rays: 360, max_range: 4.0 });
    config.sensor = (!options.no_sensor).then_some(RangeSensor {
        n_rays: options.rays.unwrap_or(n_rays),
        max_range: options.range.unwrap_or(max_range),
    });
    Ok(config)
}

fn ticks(options: &RecordArgs) -> Result<Option<u64>, Failure> {
    let Some(seconds) = options.seconds else { return Ok(options.ticks) };
    let ticks = (seconds / DT).round();
    // written so that NaN is refused
    if !(0.0..1e15).contains(&ticks) || (ticks * DT - seconds).abs() > 1e-9 {
        return Err(Failure::usage(
            format!("--seconds {seconds}: not a whole number of ticks of {DT} s"),
            "Give a multiple of 0.05 s from 0 on, or --ticks.",
        ));
    }
    Ok(Some(ticks as u64))
}

/// The script, checked against the run: its robots, and where --strict is given, that they take their inputs.
pub fn script(options: &RecordArgs, config: &TourConfig) -> Result<Script, Failure> {
    config.validate().map_err(|error| Failure::usage(error, "See `motion-lab record --help`."))?;
    let Some(path) = &options.script else { return Ok(Script::empty()) };
    let (name, text) = (path.display().to_string(), read_text(path)?);
    let script = parse_script(path, &text)?;
    let names: Vec<&str> = config.robot_names().collect();
    let checked = if options.strict { script.check_for(config) } else { script.check_robots(&names) };
    checked.map_err(|error| unfit(error.located(&name, &text), config))?;
    Ok(script)
}
