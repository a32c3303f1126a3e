//! Captures of widgets that move with a run, at any of its ticks.

use std::sync::Arc;

use bevy::app::App;

use super::space::RobotSpace;
use super::{CaptureError, Captured, Note};
use crate::anatomy::nearest_items;
use crate::atlas::{Atlas, names};
use crate::manifest::Widget;
use crate::recording::{Recorder, Run};
use crate::run::{DT, Log};
use crate::simulation::{RobotView, SensorView};
use crate::tour::TourConfig;
use motion_lab_core::collision::Scene;
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::geometry::Shape;
use motion_lab_core::picture::{
    Drawing, Figure, Item, Panel, Picture, RobotDrawing, ScanDrawing, fan_scan, places, readout, readout_lines, robot,
    scan_id, world as draw_world,
};

use motion_lab_core::worlds::World;

/// Largest number of characters in a line of a readout.
const READOUT: usize = 48;

/// The view of a run that is drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum Subject {
    /// The cockpits side by side.
    Dashboard {
        /// Whether the names of obstacles, places and marks are shown.
        names: bool,
        /// Whether the scans are drawn.
        scan: bool,
        /// Whether what is nearest to each robot is drawn.
        nearest: bool,
    },
    /// A robot's workspace, and beside it its configuration space with its path since tick 0; both with the world as it
    /// stands, doors open or closed and obstacles where they are.
    Cspace {
        /// The world it lives in; any when left out.
        world: Option<World>,
        /// Its name; any when left out.
        robot: Option<String>,
        /// Its kind; when left out, the first robot of one of the lab's kinds.
        kind: Option<String>,
        /// Number of halvings of the slice down to the finest cells.
        finest: u32,
        /// Whether the annulus of points that an arm's tip can reach is drawn.
        annulus: bool,
    },
    /// The atlas, with the robots at their present configurations.
    Atlas {
        /// The world; all of the run's when left out.
        world: Option<World>,
        /// Whether the names of obstacles, places and marks are shown.
        names: bool,
    },
}

impl Subject {
    /// Checks that a run of this configuration has the world and the robot to be drawn.
    ///
    /// # Errors
    /// [`CaptureError::NotInRun`] names what is missing.
    pub fn check(&self, config: &TourConfig) -> Result<(), CaptureError> {
        if let Some(world) = self.world().filter(|world| !config.worlds.contains(world)) {
            return Err(CaptureError::NotInRun(format!("world {} as it is here: run this world first", world.name)));
        }
        let Subject::Cspace { robot: name, kind, .. } = self else { return Ok(()) };
        let mut robots = config.worlds.iter().filter(|w| self.shows(w)).flat_map(|w| &w.robots);
        if robots.any(|robot| self.wants(&robot.name, &robot.kind)) {
            return Ok(());
        }
        let of_kind = kind.as_deref().map_or("robot of the lab's".to_owned(), |kind| format!("robot of kind {kind}"));
        let wanted = name.as_deref().map_or(of_kind, |name| format!("robot {name}"));
        let place = self.world().map_or_else(String::new, |world| format!(" in {}", world.name));
        Err(CaptureError::NotInRun(wanted + &place))
    }

    /// The same without names, which leaves the text under the pictures as it is.
    pub(super) fn unnamed(&self) -> Subject {
        match self.clone() {
            Subject::Dashboard { scan, nearest, .. } => Subject::Dashboard { names: false, scan, nearest },
            Subject::Atlas { world, .. } => Subject::Atlas { world, names: false },
            space => space,
        }
    }

    /// The one world to be drawn; `None` for all.
    fn world(&self) -> Option<&World> {
        match self {
            Subject::Dashboard { .. } => None,
            Subject::Cspace { world, .. } | Subject::Atlas { world, .. } => world.as_ref(),
        }
    }

    /// Whether a robot of this name and kind is one of the lab's, and the one to be drawn as far as these tell.
    fn wants(&self, name: &str, kind: &str) -> bool {
        let Subject::Cspace { robot, kind: wanted, .. } = self else { return false };
        RobotKind::of(kind).is_some()
            && robot.as_deref().is_none_or(|robot| robot == name)
            && wanted.as_deref().is_none_or(|wanted| wanted == kind)
    }

    /// Whether this world of the run is drawn.
    fn shows(&self, world: &World) -> bool {
        self.world().is_none_or(|only| only == world)
    }
}

/// A span of ticks, with a picture every `every` ticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CaptureSpan {
    /// The first tick.
    pub from: u64,
    /// The last.
    pub to: u64,
    /// Ticks from picture to picture, at least 1.
    pub every: u64,
}

impl CaptureSpan {
    /// The span, if the run has it.
    ///
    /// # Errors
    /// [`CaptureError::NoTick`] names the tick that is beyond `last`, or after the end of the span.
    pub fn within(self, last: u64) -> Result<CaptureSpan, CaptureError> {
        let CaptureSpan { from, to, every } = self;
        if from > to || to > last {
            return Err(CaptureError::NoTick { tick: if from > to { from } else { to }, last });
        }
        Ok(CaptureSpan { from, to, every: std::cmp::max(every, 1) })
    }

    /// Whether there is a picture for a tick.
    pub fn has(&self, tick: u64) -> bool {
        (self.from..=self.to).contains(&tick) && (tick - self.from).is_multiple_of(self.every)
    }

    /// The note of a file over this span.
    pub(super) fn note(&self) -> Note {
        ("Tick", format!("{} to {}", self.from, self.to))
    }

    /// Number of pictures.
    pub fn pictures(&self) -> u64 {
        (self.to - self.from) / self.every + 1
    }
}

/// The run of a log after `tick`, for a sheet of this width, pixels.
///
/// # Errors
/// [`CaptureError`] names what the run does not have.
pub fn at_tick(log: &Log, subject: &Subject, tick: u64, width_px: f64) -> Result<Captured, CaptureError> {
    at_tick_with_robots(log, subject, tick, width_px, |_| {}, |_| {})
}

/// [`at_tick`] of a run with kinds of robots that a program added: `add` adds them. `on_tick` is called with each tick
/// of the log that has been shown.
///
/// # Errors
/// [`CaptureError`] names what the run does not have.
pub fn at_tick_with_robots(
    log: &Log,
    subject: &Subject,
    tick: u64,
    width_px: f64,
    add: impl FnOnce(&mut App),
    mut on_tick: impl FnMut(u64),
) -> Result<Captured, CaptureError> {
    let mut drawn = None;
    let mut moving = Moving::new(log, subject.clone(), width_px)?;
    Run::show_with_robots(log, add, |run| {
        moving.see(run)?;
        if run.frame().tick == tick {
            drawn = Some(moving.captured(run, true)?);
        }
        on_tick(run.frame().tick);
        Ok::<_, CaptureError>(())
    })?;
    let last = log.ticks();
    let Captured { figure, mut notes } = drawn.ok_or(CaptureError::NoTick { tick, last })?;
    notes.push(("Tick", tick.to_string()));
    Ok(Captured { figure, notes })
}

/// The parts of a world's picture that only a change of the world changes.
struct Backdrop {
    number: u32,
    /// The world as it is drawn; `None` for the world at the start.
    standing: Option<Arc<World>>,
    world: Arc<Picture>,
    /// The names of everything and the dots of the places.
    names: Vec<Item>,
}

impl Backdrop {
    /// Draws the world anew where its obstacles or doors have changed.
    fn stand(&mut self, now: &Arc<World>) {
        if self.standing.as_ref().is_none_or(|old| !Arc::ptr_eq(old, now)) {
            self.world = Arc::new(draw_world(now));
            self.standing = Some(Arc::clone(now));
        }
    }

    /// What of the world is nearest to each of these robots.
    fn nearest(&self, robots: &[&RobotView]) -> Vec<Item> {
        let Some(scene) = self.standing.as_ref().map(|world| Scene::of_world(world)) else { return Vec::new() };
        robots.iter().flat_map(|robot| nearest_items(&scene, &robot.footprint)).collect()
    }
}

/// A subject under way. It is shown the run tick by tick, and draws any of them.
pub(super) struct Moving<'a> {
    pub(super) log: &'a Log,
    digest: String,
    subject: Subject,
    backdrops: Vec<Backdrop>,
    space: Option<RobotSpace>,
}

impl<'a> Moving<'a> {
    /// The subject before the first tick, for a sheet of this width.
    pub fn new(log: &'a Log, subject: Subject, width_px: f64) -> Result<Self, CaptureError> {
        subject.check(&log.recipe.config)?;
        let named = match &subject {
            Subject::Dashboard { names, .. } | Subject::Atlas { names, .. } => *names,
            Subject::Cspace { .. } => false,
        };
        let shown: Vec<(u32, &World)> =
            (0..).zip(&log.recipe.config.worlds).filter(|(_, w)| subject.shows(w)).collect();
        let pictures: Vec<Arc<Picture>> = shown.iter().map(|(_, w)| Arc::new(draw_world(w))).collect();
        let bare = |picture: &Arc<Picture>| Panel {
            picture: Picture::new("", picture.bounds),
            heading: String::new(),
            readout: Vec::new(),
        };
        let panels = pictures.iter().map(bare).collect();
        let blank = Figure { title: String::new(), description: String::new(), panels, caption: Vec::new() };
        let named = |(&(number, model), (world, scale)): (&(u32, &World), (&Arc<Picture>, f64))| {
            // robots move, so they are not named
            let standing = Atlas::new(World { robots: Vec::new(), ..model.clone() });
            let dots = places(&model.places).into_iter().filter(|i| !matches!(i.drawing, Drawing::Label { .. }));
            let names = if named { dots.chain(names(&standing, scale)).collect() } else { Vec::new() };
            Backdrop { number, standing: None, world: Arc::clone(world), names }
        };
        let backdrops = shown.iter().zip(pictures.iter().zip(blank.px_per_metre(width_px))).map(named).collect();
        Ok(Moving {
            log,
            digest: log.digest().map_or_else(String::new, |digest| digest.to_string()),
            subject,
            backdrops,
            space: None,
        })
    }

    /// Shows it the next tick.
    pub fn see(&mut self, run: &Recorder) -> Result<(), CaptureError> {
        let Subject::Cspace { finest, annulus, .. } = &self.subject else { return Ok(()) };
        let (views, standing) = (run.view(), run.standing_worlds());
        if self.space.is_none() {
            let fits = |v: &&RobotView| {
                self.subject.wants(&v.name, &v.kind) && self.backdrops.iter().any(|b| b.number == v.world)
            };
            let nobody = || CaptureError::NotInRun("such robot".into());
            let view = views.iter().find(fits).ok_or_else(nobody)?;
            let world = standing.get(view.world as usize).ok_or_else(nobody)?;
            self.space = Some(RobotSpace::new(Arc::clone(world), view, *finest, *annulus)?);
        }
        let Some(space) = &mut self.space else { return Ok(()) };
        let view = views.iter().find(|view| view.id == space.robot);
        view.zip(standing.get(space.world as usize)).map_or(Ok(()), |(view, world)| space.see(world, view))
    }

    /// The figure of the last tick seen. Without `drawn` it has only words and sizes.
    pub fn captured(&mut self, run: &Recorder, drawn: bool) -> Result<Captured, CaptureError> {
        let tick = run.frame().tick;
        let seed = self.log.recipe.seed.0;
        let when = format!("Seed {seed}, tick {tick} ({:.2} s)", DT * tick as f64);
        let notes: Vec<Note> = vec![("Seed", seed.to_string()), ("Digest", self.digest.clone())];
        if let Some(space) = &mut self.space {
            let mut captured = space.captured(drawn)?;
            captured.figure.caption.push(when);
            return Ok(Captured { notes, ..captured });
        }
        let standing = run.standing_worlds();
        for backdrop in &mut self.backdrops {
            if let Some(now) = standing.get(backdrop.number as usize) {
                backdrop.stand(now);
            }
        }
        let views = run.view();
        let in_atlas = matches!(self.subject, Subject::Atlas { .. });
        let panels = self.backdrops.iter().map(|b| self.panel(b, run, &views, drawn)).collect();
        let sentences =
            views.iter().map(|v| format!("{} is at {}, contacts: {}.", v.name, v.configuration, v.contacts));
        let mut caption = vec![when];
        if in_atlas {
            caption.insert(0, Widget::Atlas.text().misconception.clone());
        }
        let seconds = DT * tick as f64;
        let figure = Figure {
            title: format!("{} at {seconds:.2} s, seed {seed}", if in_atlas { "World atlas" } else { "The lab" }),
            description: sentences.collect::<Vec<_>>().join(" "),
            panels,
            caption,
        };
        Ok(Captured { figure, notes })
    }

    fn panel(&self, backdrop: &Backdrop, run: &Recorder, views: &[RobotView], drawn: bool) -> Panel {
        let world = &backdrop.world;
        let residents: Vec<&RobotView> = views.iter().filter(|v| v.world == backdrop.number).collect();
        let names: Vec<&str> = residents.iter().map(|v| v.name.as_str()).collect();
        let heading = match names.len() {
            0 => world.name.clone(),
            1..=3 => format!("{} \u{b7} {}", names.join(", "), world.name),
            n => format!("{n} robots \u{b7} {}", world.name),
        };
        let counts = matches!(self.subject, Subject::Dashboard { .. });
        let readout = residents.iter().flat_map(|v| {
            let mut lines = readout_lines(&readout(&v.configuration), READOUT);
            lines.extend(counts.then(|| format!("contacts: {}", v.contacts)));
            lines
        });
        let readout = readout.collect();
        if !drawn {
            return Panel { heading, readout, picture: Picture::new(&world.name, world.bounds) };
        }
        let mut picture = (**world).clone().with(backdrop.names.iter().cloned());
        if let Subject::Dashboard { scan: true, .. } = self.subject {
            picture = picture.with(seen(run, &residents));
        }
        if let Subject::Dashboard { nearest: true, .. } = self.subject {
            picture = picture.with(backdrop.nearest(&residents));
        }
        Panel { heading, readout, picture: picture.with(residents.iter().flat_map(|v| drawing(v))) }
    }
}

/// The scans of these robots' range sensors.
fn seen(run: &Recorder, views: &[&RobotView]) -> Vec<Item> {
    let item = |sensor: &SensorView| {
        let robot = views.iter().find(|view| view.id == sensor.robot)?;
        let SensorView { pose, rays, ranges, .. } = sensor;
        let drawing = ScanDrawing { pose: *pose, field_of_view: rays.field_of_view, ranges };
        Some(fan_scan(&scan_id(&robot.name, &sensor.name), "scan", &drawing))
    };
    run.sensors().iter().filter_map(item).collect()
}

/// A robot as its cockpit shows it, red while its flash holds.
fn drawing(view: &RobotView) -> Vec<Item> {
    let is_disc = view.footprint.parts().iter().all(|p| matches!(p.shape(), Shape::Disc { .. }));
    robot(&RobotDrawing {
        name: &view.name,
        footprint: &view.footprint,
        heading: view.coordinates.get(2).copied().filter(|_| is_disc),
        model: view.model,
        gait: view.gait(),
        in_contact: view.flash > 0,
    })
}

#[cfg(test)]
mod tests;
