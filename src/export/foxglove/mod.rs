//! `write_foxglove`, an MCAP file that viewers show by themselves: the log's own channels, and beside them Foxglove's.

mod events;
mod frames;
mod message;
mod scene;
mod writer;

use std::collections::BTreeSet;
use std::io::{self, Write};
use std::sync::Arc;

use bevy::app::App;
use mcap::read::{LinearReader, Options};
use mcap::records::Record;

use super::ExportError;
use crate::recording::{Recorder, Run};
use crate::run::{Frame, Log};
use crate::simulation::{RobotView, SensorView};
use crate::worlds::World;
use message::{FrameTransforms, LaserScan, Pose, Timestamp, level};
use writer::ViewerFile;

/// Writes a log for Foxglove, Lichtblick and Rerun: an MCAP file with the log's own messages and, by Foxglove's
/// schemas, the messages below. It is not a log that [`Log::read_mcap`] reads. Nothing is simulated.
///
/// | topic | schema | when |
/// |---|---|---|
/// | `/viewer/transforms` | `foxglove.FrameTransforms` | each tick: worlds in `lab`, robots and parts in their worlds |
/// | `/viewer/worlds` | `foxglove.SceneUpdate` | at the start, and a world again when obstacles or doors change |
/// | `/viewer/robots` | `foxglove.SceneUpdate` | each tick, all of it, so that a viewer may begin anywhere |
/// | `/viewer/scan/NAME` | `foxglove.LaserScan` | each tick of a robot with the run's range sensor |
/// | `/viewer/scan/NAME/SENSOR` | `foxglove.LaserScan` | each tick, for a sensor of the robot's own |
/// | `/viewer/log` | `foxglove.Log` | contacts, takeovers, refusals |
///
/// `add` adds the kinds of robots that the log names and the lab does not have, as with [`Run::show_with_robots`];
/// `|_| {}` adds none.
///
/// # Errors
/// [`ExportError`]: `out` fails, a kind is missing, or a frame is none of this run.
///
/// ```
/// use motion_lab::export::write_foxglove;
/// use motion_lab::recording::Run;
/// use motion_lab::tour::{BOOK_SEED, TourConfig};
/// let log = Run::record(TourConfig { ticks: 2, ..TourConfig::default() }, BOOK_SEED)?;
/// let mut file = Vec::new();
/// write_foxglove(&log, &mut file, |_| {})?;
/// assert!(file.starts_with(b"\x89MCAP0\r\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_foxglove(log: &Log, out: impl Write, add: impl FnOnce(&mut App)) -> Result<(), ExportError> {
    let mut file = Vec::new();
    log.write_mcap(&mut file)?;
    write_foxglove_of_file(&file, log, out, add)
}

/// [`write_foxglove`] of a log that was read from a file with the bytes `file`, whose records are copied as they are:
/// another version of this program may have written them. The file may be cut off after the log's last tick.
///
/// # Errors
/// As [`write_foxglove`], and when the file ends before the log or its records cannot be copied.
pub fn write_foxglove_of_file(
    file: &[u8],
    log: &Log,
    out: impl Write,
    add: impl FnOnce(&mut App),
) -> Result<(), ExportError> {
    let mut original = Original { records: LinearReader::new_with_options(file, Options::IgnoreEndMagic.into()).ok() };
    let mut out = ViewerFile::begin(out)?;
    let mut run = Viewed { log, before: Vec::new(), parts: BTreeSet::new(), shown: Vec::new() };
    Run::show_with_robots(log, add, |recorder| {
        let frame = recorder.frame();
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
    fn copy_tick(&mut self, tick: u64, out: &mut ViewerFile<impl Write>) -> Result<(), ExportError> {
        for record in self.records.iter_mut().flatten() {
            let record = record.map_err(|error| ExportError::Records(io::Error::other(error)))?;
            let ends_tick = matches!(&record, Record::Message { header, .. } if out.is_digest(header));
            out.copy(record)?;
            if ends_tick {
                return Ok(());
            }
        }
        Err(ExportError::Ends(tick))
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
    fn tick(
        &mut self,
        frame: &Frame,
        recorder: &Recorder,
        out: &mut ViewerFile<impl Write>,
    ) -> Result<(), ExportError> {
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
        for sensor in &recorder.sensors() {
            let Some(robot) = robots.iter().find(|robot| robot.id == sensor.robot) else { continue };
            let Some(world) = world_of(robot) else { continue };
            let mut topic = format!("/viewer/scan/{}", robot.name);
            let mut scan = laser_scan(tick, sensor);
            if sensor.name.is_empty() {
                scan.frame_id = frames::of_robot(&robot.name);
            } else {
                topic = format!("{topic}/{}", sensor.name);
                (scan.frame_id, scan.pose) = (frames::of_world(world), Some(Pose::of(&sensor.pose)));
            }
            out.message(&topic, "foxglove.LaserScan", tick, &scan)?;
        }
        for message in events::news(tick, &self.before, &robots) {
            out.message("/viewer/log", "foxglove.Log", tick, &message)?;
        }
        self.before = robots;
        Ok(())
    }
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
        ranges: ranges.clone(),
    }
}
