//! A robot of a run in its configuration space, tick by tick.

use std::sync::Arc;

use super::{CaptureError, Captured, cspace};
use crate::anatomy::{Anatomy, Tab, WorldSource};
use crate::simulation::RobotView;
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::cspace::{CellMap, Slice};
use motion_lab_core::robots::{AnyRobot, ConfigurationError, Robot};
use motion_lab_core::worlds::World;

/// A robot of a run, its configuration space and its path in it.
pub(super) struct RobotSpace {
    /// The robot's id in the run.
    pub robot: u32,
    /// The number of its world in the run.
    pub world: u32,
    /// The world as it stands.
    standing: Arc<World>,
    anatomy: Anatomy,
    finest: u32,
    map: Option<CellMap>,
    trace: Vec<AnyConfiguration>,
}

impl RobotSpace {
    /// The robot at its present configuration in its world as it stands. An error for a kind that is not the lab's.
    pub fn new(standing: Arc<World>, view: &RobotView, finest: u32, annulus: bool) -> Result<Self, CaptureError> {
        let mut anatomy = anatomy(&standing, view)?;
        anatomy.show_annulus = annulus;
        Ok(RobotSpace { robot: view.id, world: view.world, standing, anatomy, finest, map: None, trace: Vec::new() })
    }

    /// Adds the robot's configuration at the next tick, in its world as it then stands.
    pub fn see(&mut self, standing: &Arc<World>, view: &RobotView) -> Result<(), CaptureError> {
        if !Arc::ptr_eq(&self.standing, standing) {
            // a door or an obstacle was changed
            let show_annulus = self.anatomy.show_annulus;
            self.anatomy = anatomy(standing, view)?;
            self.anatomy.show_annulus = show_annulus;
            (self.standing, self.map) = (Arc::clone(standing), None);
        }
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

fn anatomy(world: &World, view: &RobotView) -> Result<Anatomy, CaptureError> {
    let (robot, q) = here(view)?;
    let anatomy = Anatomy::new(world.clone(), WorldSource::Unsaved, robot, q);
    anatomy.map_err(|e| CaptureError::Fault(e.to_string()))
}

fn here(view: &RobotView) -> Result<(AnyRobot, AnyConfiguration), CaptureError> {
    let known = view.model.and_then(|model| {
        let (_, q) = AnyRobot::of_kind(model.kind(), &view.coordinates)?;
        Some((model.fitted(&q), q))
    });
    known.ok_or_else(|| CaptureError::NotInRun(format!("configuration space for {}, a {}", view.name, view.kind)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::Recorder;
    use crate::tour::{BOOK_SEED, TourConfig};

    #[test]
    fn a_world_that_changes_between_two_pictures_changes_the_second() {
        let config = TourConfig { worlds: vec![World::workbench()], ticks: 1, sensor: None };
        let view = Recorder::new(config, BOOK_SEED).unwrap().view().remove(0);
        let full = Arc::new(World::workbench());
        let cleared = Arc::new(World { obstacles: Vec::new(), ..World::workbench() });
        let mut space = RobotSpace::new(Arc::clone(&full), &view, 3, true).unwrap();
        let mut seen = |world: &Arc<World>| {
            space.see(world, &view).unwrap();
            let panels = space.captured(true).unwrap().figure.panels;
            assert!(panels[0].picture.items.iter().any(|item| item.id.starts_with("annulus")), "it stays");
            (
                panels[0].picture.items.iter().filter(|i| i.id.starts_with("obstacle/")).count(),
                panels[1].readout[1].clone(),
            )
        };
        let (obstacles, known) = seen(&full);
        assert_eq!(obstacles, 3);
        // an arm without obstacles is free everywhere
        assert_eq!(seen(&cleared), (0, "proven free 100.0 %, proven blocked 0.0 %".to_owned()));
        assert_eq!(seen(&full), (3, known));
    }
}
