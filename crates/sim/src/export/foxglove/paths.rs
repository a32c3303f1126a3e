//! `RunPath`, where a robot goes in a whole run.

use super::frames;
use crate::recording::{Recorder, RunError};
use crate::run::{Frame, Log};
use crate::simulation::RobotView;
use motion_lab_core::geometry::Point2;

/// A robot is this far from the last point kept of its path before another one is, metres.
const APART: f64 = 0.01;

/// Where a robot's reference point goes in a run: an arm's tip, else the origin of its first part.
pub struct RunPath {
    /// The robot's name.
    pub robot: String,
    /// The frame of its world, in which the points are.
    pub frame: String,
    /// The place at tick 0, then each that is a centimetre or more from the one before.
    pub points: Vec<Point2>,
    /// Where the contacts began.
    pub contacts: Vec<Point2>,
    counted: u32,
}

impl RunPath {
    /// The paths of all robots of a log. `run` is its run, and is restored to each of its frames; `on_frame` is called
    /// after each.
    pub fn of_run<'a>(
        log: &Log,
        run: &mut Recorder,
        frames: impl Iterator<Item = &'a Frame>,
        mut on_frame: impl FnMut(),
    ) -> Result<Vec<RunPath>, RunError> {
        let mut paths: Vec<RunPath> = Vec::new();
        for frame in frames {
            run.restore(frame)?;
            let robots = run.view();
            if paths.is_empty() {
                paths = robots.iter().filter_map(|robot| RunPath::begin(log, robot)).collect();
            }
            for (path, robot) in paths.iter_mut().zip(&robots) {
                path.see(robot);
            }
            on_frame();
        }
        Ok(paths)
    }

    fn begin(log: &Log, robot: &RobotView) -> Option<RunPath> {
        let world = log.recipe.config.worlds.get(robot.world as usize)?;
        let (robot, frame) = (robot.name.clone(), frames::of_world(world));
        Some(RunPath { robot, frame, points: Vec::new(), contacts: Vec::new(), counted: 0 })
    }

    fn see(&mut self, robot: &RobotView) {
        let part = robot.footprint.parts().first();
        let Some(at) = robot.tip.or_else(|| part.map(|part| part.pose().position())) else { return };
        if self.points.last().is_none_or(|last| (at - *last).norm_squared() >= APART * APART) {
            self.points.push(at);
        }
        if robot.contacts > self.counted {
            self.counted = robot.contacts;
            self.contacts.push(at);
        }
    }
}
