//! An MCAP file that viewers show by themselves: the log's own channels, and beside them Foxglove's.
//!
//! | topic | schema | when |
//! |---|---|---|
//! | `/viewer/transforms` | `foxglove.FrameTransforms` | each tick: worlds in `lab`, robots and parts in their worlds |
//! | `/viewer/worlds` | `foxglove.SceneUpdate` | at the start, and a world again at each change of its obstacles or doors |
//! | `/viewer/robots` | `foxglove.SceneUpdate` | each tick, all of it, so that a viewer may begin anywhere |
//! | `/viewer/scan/NAME` | `foxglove.LaserScan` | each tick of a robot with a range sensor |
//! | `/viewer/log` | `foxglove.Log` | contacts, takeovers, refusals |

mod events;
mod frames;
mod message;
mod scene;
mod writer;

use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::path::Path;
use std::sync::Arc;

use mcap::read::{LinearReader, Options};
use mcap::records::Record;
use motion_lab::recording::Recorder;
use motion_lab::run::{Frame, Log};
use motion_lab::simulation::RobotView;
use motion_lab::worlds::World;

use crate::cli::Failure;
use crate::cli::support::input::read_bytes;
use crate::cli::support::log_source::MAX_LOG;
use crate::cli::support::simulate::show;
use message::{FrameTransforms, LaserScan, Pose, Timestamp, level};
use writer::ViewerFile;

/// Writes the log that was read from `file` for viewers.
pub fn write(file: &Path, log: &Log, output: &Path) -> Result<(), Failure> {
    let bytes = read_bytes(file, MAX_LOG)?;
    let mut original =
        Original { records: LinearReader::new_with_options(&bytes, Options::IgnoreEndMagic.into()).ok() };
    let mut out = ViewerFile::create(output)?;
    let mut run = Viewed { log, before: Vec::new(), parts: BTreeSet::new(), shown: Vec::new() };
    show(file, log, |recorder, frame| {
        original.copy_tick(frame.tick, &mut out)?;
        run.tick(frame, recorder, &mut out)
    })?;
    out.finish()
}

/// The log's records, as they lie in its file.
struct Original<'a> {
    records: Option<LinearReader<'a>>,
}

impl Original<'_> {
    /// Copies all records up to the digest that is the last message of a tick.
    fn copy_tick(&mut self, tick: u64, out: &mut ViewerFile) -> Result<(), Failure> {
        for record in self.records.iter_mut().flatten() {
            let record = record.map_err(Failure::internal)?;
            let ends_tick = matches!(&record, Record::Message { header, .. } if out.is_digest(header));
            out.copy(record)?;
            if ends_tick {
                return Ok(());
            }
        }
        Err(Failure::internal(anyhow::anyhow!("the log's own messages end before tick {tick}")))
    }
}

/// A run as viewers see it.
struct Viewed<'a> {
    log: &'a Log,
    /// The robots after the previous tick.
    before: Vec<RobotView>,
    /// The parts shown so far.
    parts: BTreeSet<String>,
    /// The worlds as they were shown last.
    shown: Vec<Arc<World>>,
}

impl Viewed<'_> {
    fn tick(&mut self, frame: &Frame, recorder: &Recorder, out: &mut ViewerFile) -> Result<(), Failure> {
        let (tick, worlds, robots) = (frame.tick, &self.log.config.worlds, recorder.view());
        let standing = recorder.standing_worlds();
        if let Some(update) = scene::changed_worlds(tick, &self.shown, &standing) {
            out.message("/viewer/worlds", "foxglove.SceneUpdate", tick, &update)?;
        }
        self.shown = standing;
        if tick == 0 {
            let run = format!("seed {}, {} ticks, digest {}", self.log.seed, self.log.frames.len(), self.log.digest());
            out.message("/viewer/log", "foxglove.Log", 0, &events::message_of(0, level::INFO, "motion-lab", run))?;
        }
        let world_of = |robot: &RobotView| -> Option<&World> { worlds.get(robot.world as usize) };
        let mut transforms = frames::worlds(tick, worlds);
        for robot in &robots {
            transforms.extend(world_of(robot).map(|world| frames::robot(tick, world, robot)).into_iter().flatten());
        }
        out.message("/viewer/transforms", "foxglove.FrameTransforms", tick, &FrameTransforms { transforms })?;
        let scene = scene::robots(tick, &robots, &mut self.parts);
        out.message("/viewer/robots", "foxglove.SceneUpdate", tick, &scene)?;
        for scan in &frame.scans {
            if let Some(robot) = robots.iter().find(|robot| robot.id == scan.robot) {
                let topic = format!("/viewer/scan/{}", robot.name);
                out.message(&topic, "foxglove.LaserScan", tick, &laser_scan(tick, &robot.name, &scan.ranges))?;
            }
        }
        for message in events::news(tick, &self.before, &robots) {
            out.message("/viewer/log", "foxglove.Log", tick, &message)?;
        }
        self.before = robots;
        Ok(())
    }
}

/// Ray k of n points at bearing 2 pi k / n from the robot's heading.
fn laser_scan(tick: u64, robot: &str, ranges: &[f64]) -> LaserScan {
    let n = ranges.len() as f64;
    LaserScan {
        timestamp: Some(Timestamp::of_tick(tick)),
        frame_id: frames::of_robot(robot),
        pose: Some(Pose::raised(0.0)),
        start_angle: 0.0,
        end_angle: TAU * (n - 1.0) / n,
        ranges: ranges.to_vec(),
    }
}
