//! The dashboard at one tick, and over a span of them.

use std::path::Path;
use std::sync::Arc;

use motion_lab::geometry::Shape;
use motion_lab::picture::{Figure, Item, Panel, Picture, RobotDrawing, robot, world};
use motion_lab::random::Seed;
use motion_lab::recording::{Recorder, Run};
use motion_lab::run::{DT, Log, Script};
use motion_lab::simulation::RobotView;
use motion_lab::tour::{BOOK_SEED, TourConfig};
use motion_lab::ui::{readout, readout_lines};

use super::RunArgs;
use super::paper::{Kind, Note, Paper};
use crate::cli::log_source::{LogSource, read_log};
use crate::cli::simulate::show;
use crate::cli::{Failure, say};

/// The most characters to a line of a readout.
const READOUT: usize = 48;

/// Hundredths of a second in a tick.
const TICK_HUNDREDTHS: u64 = 5;

/// Writes what the dashboard shows.
pub fn capture(args: &RunArgs, paper: &Paper) -> Result<(), Failure> {
    let log = log(args)?;
    let last = log.frames.len() as u64;
    let beyond =
        |tick: u64| Failure::usage(format!("there is no tick {tick}: they are 0 to {last}"), "Choose one of them.");
    let worlds: Vec<Arc<Picture>> = log.config.worlds.iter().map(|w| Arc::new(world(w))).collect();
    let file = args.log.as_deref().unwrap_or(Path::new("the run"));
    let notes = |ticks: String| -> Vec<Note> {
        vec![("Seed", log.seed.0.to_string()), ("Digest", log.digest().to_string()), ("Tick", ticks)]
    };
    if paper.kind() != Kind::Gif {
        let tick = args.tick.unwrap_or(last);
        let mut drawn = None;
        show(file, &log, |run, frame| {
            if frame.tick == tick {
                drawn = Some(figure(run, &worlds, &log, tick));
            }
            Ok(())
        })?;
        return paper.write(&drawn.ok_or_else(|| beyond(tick))?, &notes(tick.to_string()));
    }
    let (from, to, every) = (args.from.unwrap_or(0), args.to.unwrap_or(last), args.every.unwrap_or(4));
    if from > to || to > last {
        return Err(beyond(if from > to { from } else { to }));
    }
    let mut film = paper.film((TICK_HUNDREDTHS * every) as u16, &notes(format!("{from} to {to}")))?;
    show(file, &log, |run, frame| {
        let wanted = (from..=to).contains(&frame.tick) && (frame.tick - from).is_multiple_of(every);
        if wanted { film.add(&figure(run, &worlds, &log, frame.tick)) } else { Ok(()) }
    })?;
    film.finish()
}

/// The log asked for: of a file, or of the tour at a seed, as long as it is needed.
fn log(args: &RunArgs) -> Result<Log, Failure> {
    if let Some(path) = &args.log {
        let LogSource { read, damage } = read_log(path)?;
        if let Some(damage) = damage {
            say(damage);
        }
        return Ok(read.log);
    }
    let seed = args.seed.map_or(BOOK_SEED, Seed);
    let whole = TourConfig::default();
    Run::record(whole, (seed, Script::empty())).map_err(Failure::internal)
}

/// The cockpits side by side.
fn figure(run: &Recorder, worlds: &[Arc<Picture>], log: &Log, tick: u64) -> Figure {
    let views = run.view();
    let panel = |(number, world): (u32, &Arc<Picture>)| {
        let residents: Vec<&RobotView> = views.iter().filter(|v| v.world == number).collect();
        let names: Vec<&str> = residents.iter().map(|v| v.name.as_str()).collect();
        let heading = match names.len() {
            0 => world.name.clone(),
            1..=3 => format!("{} \u{b7} {}", names.join(", "), world.name),
            n => format!("{n} robots \u{b7} {}", world.name),
        };
        let readout = residents.iter().flat_map(|v| {
            let mut lines = readout_lines(&readout(&v.configuration), READOUT);
            lines.push(format!("contacts: {}", v.contacts));
            lines
        });
        let drawn = residents.iter().flat_map(|v| drawing(v));
        Panel { heading, readout: readout.collect(), picture: (**world).clone().with(drawn) }
    };
    let seconds = DT * tick as f64;
    let told = views.iter().map(|v| format!("{} is at {}, contacts: {}.", v.name, v.configuration, v.contacts));
    Figure {
        title: format!("The lab at {seconds:.2} s, seed {}", log.seed.0),
        description: told.collect::<Vec<_>>().join(" "),
        panels: (0_u32..).zip(worlds).map(panel).collect(),
        caption: vec![format!("Seed {}, tick {tick} ({seconds:.2} s)", log.seed.0)],
    }
}

/// A robot as its cockpit shows it: red while its flash holds.
fn drawing(view: &RobotView) -> Vec<Item> {
    let is_disc = view.footprint.parts().iter().all(|p| matches!(p.shape(), Shape::Disc { .. }));
    robot(&RobotDrawing {
        name: &view.name,
        footprint: &view.footprint,
        heading: view.coordinates.get(2).copied().filter(|_| is_disc),
        in_contact: view.flash > 0,
    })
}
