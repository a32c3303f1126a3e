//! `RunFigure`, the figure of a run, gathered while it runs.

use super::tour_figure::{RobotTour, TourPanel, tour_figure};
use crate::geometry::{Point2, Shape};
use crate::picture::Theme;
use crate::random::Seed;
use crate::recording::printed_configuration;
use crate::run::Digest;
use crate::simulation::RobotView;
use crate::tour::TourConfig;

/// What a figure needs of a run so far: where its robots went, stand and had contacts.
#[derive(Default)]
pub struct RunFigure {
    robots: Vec<Watched>,
}

struct Watched {
    world: u32,
    contacts: u32,
    tour: RobotTour,
}

impl RunFigure {
    /// Takes in the robots as they are at the next tick, from tick 0 on.
    pub fn watch(&mut self, robots: Vec<RobotView>) {
        if self.robots.is_empty() {
            self.robots = robots.iter().map(Watched::new).collect();
        }
        for (watched, robot) in self.robots.iter_mut().zip(robots) {
            watched.see(robot);
        }
    }

    /// The figure as SVG after `ticks` of the run with this digest.
    pub fn svg(&self, seed: Seed, config: &TourConfig, (ticks, digest): (u64, Digest), theme: Theme) -> String {
        let panels: Vec<TourPanel> = (0_u32..)
            .zip(&config.worlds)
            .map(|(number, world)| TourPanel {
                world,
                robots: self.robots.iter().filter(|r| r.world == number).map(|r| r.tour.clone()).collect(),
            })
            .collect();
        tour_figure(seed, (ticks, config.ticks), digest, &panels).svg(theme.palette())
    }
}

impl Watched {
    fn new(robot: &RobotView) -> Self {
        let tour = RobotTour {
            name: robot.name.clone(),
            trace: Vec::new(),
            start: robot.footprint.clone(),
            end: robot.footprint.clone(),
            end_heading: None,
            contacts: Vec::new(),
            readout: String::new(),
        };
        Watched { world: robot.world, contacts: 0, tour }
    }

    fn see(&mut self, robot: RobotView) {
        let at = reference(&robot);
        self.tour.trace.push(at);
        if robot.contacts > self.contacts {
            self.contacts = robot.contacts;
            self.tour.contacts.push(at);
        }
        // only a disc does not show which way it faces
        let is_disc = robot.footprint.parts().iter().all(|p| matches!(p.shape(), Shape::Disc { .. }));
        self.tour.end_heading = robot.coordinates.get(2).copied().filter(|_| is_disc);
        self.tour.readout = printed_configuration(&robot.kind, &robot.coordinates);
        self.tour.end = robot.footprint;
    }
}

/// The point that stands for a robot: an arm's tip, else the origin of its first part.
fn reference(robot: &RobotView) -> Point2 {
    robot.tip.unwrap_or_else(|| robot.footprint.parts().first().map_or(Point2::origin(), |part| part.pose().position()))
}
