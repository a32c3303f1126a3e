//! A robot of a run in its configuration space, tick by tick.

use super::{CaptureError, Captured, cspace};
use crate::anatomy::{Anatomy, Tab, WorldSource};
use crate::configuration::AnyConfiguration;
use crate::cspace::{CellMap, Slice};
use crate::robots::{AnyRobot, ConfigurationError, Robot};
use crate::simulation::RobotView;
use crate::worlds::World;

/// A robot of a run, its configuration space and its path in it.
pub(super) struct Space {
    /// The robot's id in the run.
    pub robot: u32,
    anatomy: Anatomy,
    finest: u32,
    map: Option<CellMap>,
    trace: Vec<AnyConfiguration>,
}

impl Space {
    /// The robot at its present configuration. An error for a kind that is not the lab's.
    pub fn new(world: &World, view: &RobotView, finest: u32, annulus: bool) -> Result<Self, CaptureError> {
        let (robot, q) = here(view)?;
        let anatomy = Anatomy::new(world.clone(), WorldSource::Unsaved, robot, q);
        let mut anatomy = anatomy.map_err(|e| CaptureError::Fault(e.to_string()))?;
        anatomy.show_annulus = annulus;
        Ok(Space { robot: view.id, anatomy, finest, map: None, trace: Vec::new() })
    }

    /// Adds the robot's configuration at the next tick.
    pub fn see(&mut self, view: &RobotView) -> Result<(), CaptureError> {
        let (robot, q) = here(view)?;
        if *self.anatomy.checker().robot() != robot {
            // a trailer was attached or removed
            self.anatomy = self.anatomy.with_robot(robot);
            self.map = None;
        }
        self.anatomy.set_q(q).map_err(|e| CaptureError::Fault(e.to_string()))?;
        let same_space = self.trace.last().is_none_or(|last| robot.check(last).is_ok());
        if !same_space {
            self.trace.clear();
        }
        self.trace.push(q);
        Ok(())
    }

    /// The present workspace and configuration space. Without `drawn` the figure has only words and sizes.
    pub fn captured(&mut self, drawn: bool) -> Result<Captured, CaptureError> {
        let q = self.anatomy.q();
        let fault = |error: ConfigurationError| CaptureError::Fault(error.to_string());
        let shown = self.anatomy.clone().with_tab(Tab::Intersects);
        if !drawn {
            let slice = Slice::through(shown.checker(), &q).map_err(fault)?;
            return Ok(cspace(&shown, &CellMap::new(slice, 1), Vec::new()));
        }
        let map = match self.map.take().filter(|map| map.slice().holds(&q)) {
            Some(map) => map,
            None => {
                let mut map = CellMap::new(Slice::through(shown.checker(), &q).map_err(fault)?, self.finest);
                map.refine(u32::MAX);
                map
            }
        };
        let captured = cspace(&shown, &map, self.trace.clone());
        self.map = Some(map);
        Ok(captured)
    }
}

fn here(view: &RobotView) -> Result<(AnyRobot, AnyConfiguration), CaptureError> {
    let known = view.model.and_then(|model| {
        let (_, q) = AnyRobot::of_kind(model.kind(), &view.coordinates)?;
        Some((model.fitted(&q), q))
    });
    known.ok_or_else(|| CaptureError::NotInRun(format!("configuration space for {}, a {}", view.name, view.kind)))
}
