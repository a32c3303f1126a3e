//! The dashboard at one tick, and over a span of them.

use std::path::Path;
use std::sync::Arc;

use motion_lab::geometry::Shape;
use motion_lab::picture::{Figure, Panel, Picture, world};
use motion_lab::random::Seed;
use motion_lab::recording::{Recorder, Run};
use motion_lab::run::{DT, Log, Script};
use motion_lab::simulation::RobotView;
use motion_lab::tour::{BOOK_SEED, TourConfig};
use motion_lab::ui::{Cockpit, CockpitRobot, readout, readout_lines};

use super::RunArgs;
use super::paper::{Kind, Note, Paper};
use crate::cli::log_source::{LogSource, read_log};
use crate::cli::simulate::show;
use crate::cli::{Failure, say};

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
    let (from, to) = (args.from, args.to.unwrap_or(last));
    if from > to || to > last {
        return Err(beyond(if from > to { from } else { to }));
    }
    let mut film = paper.film((TICK_HUNDREDTHS * args.every) as u16, &notes(format!("{from} to {to}")))?;
    show(file, &log, |run, frame| {
        let wanted = (from..=to).contains(&frame.tick) && (frame.tick - from).is_multiple_of(args.every);
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

/// The cockpits as the window shows them, side by side.
fn figure(run: &Recorder, worlds: &[Arc<Picture>], log: &Log, tick: u64) -> Figure {
    let views = run.view();
    let cockpits = (0_u32..).zip(worlds).map(|(number, world)| Cockpit {
        world: Arc::clone(world),
        robots: views.iter().filter(|v| v.world == number).map(cockpit_robot).collect(),
    });
    let cockpits: Vec<Cockpit> = cockpits.collect();
    let panel = |cockpit: &Cockpit| Panel {
        picture: (*cockpit.world).clone().with(cockpit.robots_picture().items),
        heading: cockpit.heading(),
        readout: cockpit
            .robots
            .iter()
            .flat_map(|r| {
                let mut lines = readout_lines(&readout(&r.readout));
                lines.push(format!("contacts: {}", r.contacts));
                lines
            })
            .collect(),
    };
    let seconds = DT * tick as f64;
    Figure {
        title: format!("The lab at {seconds:.2} s, seed {}", log.seed.0),
        description: cockpits.iter().map(Cockpit::described).collect::<Vec<_>>().join(" "),
        panels: cockpits.iter().map(panel).collect(),
        caption: vec![format!("Seed {}, tick {tick} ({seconds:.2} s)", log.seed.0)],
    }
}

fn cockpit_robot(view: &RobotView) -> CockpitRobot {
    let is_disc = view.footprint.parts().iter().all(|p| matches!(p.shape(), Shape::Disc { .. }));
    CockpitRobot {
        name: view.name.clone(),
        readout: view.configuration.clone(),
        footprint: view.footprint.clone(),
        heading: view.coordinates.get(2).copied().filter(|_| is_disc),
        flash: view.flash > 0,
        contacts: view.contacts,
        manual: view.manual,
        drivable: true,
        trailer: None,
    }
}
