//! `Moment`, what a viewer is shown after a tick.

use std::io::Write;
use std::sync::Arc;

use super::message::{LaserScan, Pose, Timestamp};
use super::paths::RunPath;
use super::writer::ViewerFile;
use super::{cloud, frames, scene};
use crate::export::ExportError;
use crate::simulation::{RobotView, SensorView};
use motion_lab_core::worlds::World;

const SCENE: &str = "foxglove.SceneUpdate";
const CLOUD: &str = "foxglove.PointCloud";

/// A tick of a run, with what was shown before it.
pub struct Moment<'a> {
    pub tick: u64,
    /// The worlds of the run's configuration.
    pub worlds: &'a [World],
    /// The worlds as they stand, and as they were shown last.
    pub standing: &'a [Arc<World>],
    pub shown: &'a [Arc<World>],
    /// The robots, and as they were after the previous tick.
    pub robots: &'a [RobotView],
    pub before: &'a [RobotView],
    /// The paths of the whole run.
    pub paths: &'a [RunPath],
    pub sensors: &'a [SensorView],
}

impl Moment<'_> {
    /// Writes scene entities and laser scans.
    pub fn write_scene(&self, out: &mut ViewerFile<impl Write>) -> Result<(), ExportError> {
        let Moment { tick, before, robots, .. } = *self;
        if let Some(update) = scene::changed_worlds(tick, self.shown, self.standing) {
            out.message("/viewer/worlds", SCENE, tick, &update)?;
        }
        if let Some(update) = scene::changed_robots(tick, before, robots) {
            out.message("/viewer/robots", SCENE, tick, &update)?;
        }
        if tick == 0 {
            out.message("/viewer/paths", SCENE, tick, &scene::paths(self.paths))?;
        }
        if let Some(update) = scene::changed_flashes(tick, before, robots) {
            out.message("/viewer/contacts", SCENE, tick, &update)?;
        }
        for SensorReading { topic, sensor, robot, world } in self.readings() {
            let mut scan = laser_scan(tick, sensor);
            if sensor.name.is_empty() {
                scan.frame_id = frames::of_robot(&robot.name);
            } else {
                (scan.frame_id, scan.pose) = (frames::of_world(world), Some(Pose::of(&sensor.pose)));
            }
            out.message(&topic, "foxglove.LaserScan", tick, &scan)?;
        }
        Ok(())
    }

    /// Writes clouds of points.
    pub fn write_clouds(&self, out: &mut ViewerFile<impl Write>) -> Result<(), ExportError> {
        let Moment { tick, before, robots, .. } = *self;
        for (number, world) in self.standing.iter().enumerate() {
            if !self.shown.get(number).is_some_and(|old| Arc::ptr_eq(old, world)) {
                out.message(
                    &format!("/viewer/worlds/{}", segment(&world.name)),
                    CLOUD,
                    tick,
                    &cloud::world(tick, world),
                )?;
            }
        }
        for (number, robot) in robots.iter().enumerate() {
            let old = before.get(number);
            let parts = |robot: &RobotView| robot.footprint.parts().len();
            for k in 0..parts(robot).max(old.map_or(0, parts)) {
                if cloud::look(robot, k) != old.and_then(|old| cloud::look(old, k)) {
                    let topic = format!("/viewer/robots/{}/{k}", segment(&robot.name));
                    out.message(&topic, CLOUD, tick, &cloud::part(tick, robot, k))?;
                }
            }
        }
        for path in self.paths.iter().filter(|_| tick == 0) {
            let robot = segment(&path.robot);
            out.message(&format!("/viewer/paths/{robot}"), CLOUD, tick, &cloud::path(path))?;
            out.message(&format!("/viewer/contacts/{robot}"), CLOUD, tick, &cloud::contacts(path))?;
        }
        for SensorReading { topic, sensor, world, .. } in self.readings() {
            out.message(&topic, CLOUD, tick, &cloud::scan(tick, sensor, world))?;
        }
        Ok(())
    }

    /// The sensors, each with its topic.
    fn readings(&self) -> impl Iterator<Item = SensorReading<'_>> {
        self.sensors.iter().filter_map(|sensor| {
            let robot = self.robots.get(sensor.robot as usize).filter(|robot| robot.id == sensor.robot)?;
            let world = self.worlds.get(robot.world as usize)?;
            let mut topic = format!("/viewer/scan/{}", segment(&robot.name));
            if !sensor.name.is_empty() {
                topic = format!("{topic}/{}", segment(&sensor.name));
            }
            Some(SensorReading { topic, sensor, robot, world })
        })
    }
}

/// A name as one segment of a topic: `/` as `%2F` and `%` as `%25`, so that no two names make one topic.
fn segment(name: &str) -> String {
    name.replace('%', "%25").replace('/', "%2F")
}

/// A sensor with its robot.
struct SensorReading<'a> {
    topic: String,
    sensor: &'a SensorView,
    robot: &'a RobotView,
    world: &'a World,
}

/// The scan of a sensor, from the middle of a frame that is still to be named.
fn laser_scan(tick: u64, sensor: &SensorView) -> LaserScan {
    let SensorView { rays, ranges, .. } = sensor;
    LaserScan {
        timestamp: Some(Timestamp::of_tick(tick)),
        frame_id: String::new(),
        pose: Some(Pose::raised(0.0)),
        start_angle: rays.bearing(0),
        end_angle: rays.bearing(rays.sensor.n_rays.saturating_sub(1)),
        ranges: ranges.to_vec(),
    }
}
