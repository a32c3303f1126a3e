//! `RunFigure`, the figure of a run, gathered while it runs.

use bevy::app::App;

use super::CaptureError;
use super::tour_figure::{RobotTour, TourPanel, tour_figure};
use crate::atlas::{Atlas, names};
use crate::recording::{Run, printed_as};
use crate::run::{Digest, Log, Recipe};
use crate::simulation::RobotView;
use motion_lab_core::geometry::{Point2, Shape};
use motion_lab_core::picture::{Drawing, Figure, Theme, places};
use motion_lab_core::worlds::World;

/// The data of a run's figure: each robot's trace, present footprint and contacts.
#[derive(Default)]
pub struct RunFigure {
    robots: Vec<FigureRun>,
}

struct FigureRun {
    world: u32,
    contacts: u32,
    tour: RobotTour,
}

impl RunFigure {
    /// Adds the robots of the next tick. The first call is for tick 0.
    pub fn watch(&mut self, robots: Vec<RobotView>) {
        if self.robots.is_empty() {
            self.robots = robots.iter().map(FigureRun::new).collect();
        }
        for (watched, robot) in self.robots.iter_mut().zip(robots) {
            watched.see(robot);
        }
    }

    /// The figure as SVG after `ticks` of the run with this digest.
    pub fn svg(&self, recipe: &Recipe, ticks: u64, digest: Digest, theme: Theme) -> String {
        self.figure(recipe, ticks, digest).svg(theme.palette())
    }

    /// The figure after `ticks` of the run with this digest, a panel for each world.
    pub fn figure(&self, recipe: &Recipe, ticks: u64, digest: Digest) -> Figure {
        let panels: Vec<TourPanel> = (0_u32..)
            .zip(&recipe.config.worlds)
            .map(|(number, world)| TourPanel {
                world,
                robots: self.robots.iter().filter(|r| r.world == number).map(|r| r.tour.clone()).collect(),
            })
            .collect();
        tour_figure(recipe.seed, ticks, recipe.config.ticks, digest, &panels)
    }
}

/// The figure with the names of obstacles, places and marks, for a sheet of this width, pixels. Its panels are those of
/// the worlds, in their order. Robots are not named; a name without room is left out.
pub fn with_names(mut figure: Figure, worlds: &[World], width_px: f64) -> Figure {
    let scales = figure.px_per_metre(width_px);
    for ((panel, world), scale) in figure.panels.iter_mut().zip(worlds).zip(scales) {
        let standing = Atlas::new(World { robots: Vec::new(), ..world.clone() });
        let dots = places(&world.places).into_iter().filter(|item| !matches!(item.drawing, Drawing::Label { .. }));
        panel.picture.items.extend(dots.chain(names(&standing, scale)));
    }
    figure
}

/// The figure of a log's run after `tick`, as SVG: traces, ends and contacts in its worlds. Nothing is simulated. `add`
/// adds the kinds of robots that the log names and the lab does not have.
///
/// # Errors
/// [`CaptureError::NoTick`] when the log ends before, [`CaptureError::Run`] when the run cannot start.
pub fn run_svg(log: &Log, tick: u64, theme: Theme, add: impl FnOnce(&mut App)) -> Result<String, CaptureError> {
    let last = log.ticks();
    let digest = log.digest().filter(|_| tick <= last).ok_or(CaptureError::NoTick { tick, last })?;
    let mut figure = RunFigure::default();
    Run::show_with_robots(log, add, |run| {
        if run.frame().tick <= tick {
            figure.watch(run.view());
        }
        Ok::<_, CaptureError>(())
    })?;
    Ok(figure.svg(&log.recipe, tick, digest, theme))
}

impl FigureRun {
    fn new(robot: &RobotView) -> Self {
        let tour = RobotTour {
            name: robot.name.clone(),
            trace: Vec::new(),
            start: robot.footprint.clone(),
            end: robot.footprint.clone(),
            end_heading: None,
            model: robot.model,
            gait: robot.gait(),
            contacts: Vec::new(),
            readout: String::new(),
        };
        FigureRun { world: robot.world, contacts: 0, tour }
    }

    fn see(&mut self, robot: RobotView) {
        let at = reference(&robot);
        self.tour.trace.push(at);
        if robot.contacts > self.contacts {
            self.contacts = robot.contacts;
            self.tour.contacts.push(at);
        }
        // only a disc's outline does not show its heading
        let is_disc = robot.footprint.parts().iter().all(|p| matches!(p.shape(), Shape::Disc { .. }));
        self.tour.end_heading = robot.coordinates.get(2).copied().filter(|_| is_disc);
        self.tour.readout = printed_as(robot.about, &robot.coordinates);
        (self.tour.model, self.tour.gait) = (robot.model, robot.gait());
        self.tour.end = robot.footprint;
    }
}

/// The reference point of a robot: an arm's tip, else the origin of its first part.
fn reference(robot: &RobotView) -> Point2 {
    robot.tip.unwrap_or_else(|| robot.footprint.parts().first().map_or(Point2::origin(), |part| part.pose().position()))
}
