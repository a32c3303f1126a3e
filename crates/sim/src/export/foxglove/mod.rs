//! `write_foxglove` and `write_rerun`, MCAP files that viewers show by themselves: the log's own channels, and beside
//! them Foxglove's.

mod cloud;
mod events;
mod frames;
mod message;
mod moment;
mod paths;
mod scene;
mod writer;

use std::io::{self, Write};
use std::sync::Arc;

use bevy::app::App;
use mcap::read::{LinearReader, Options};
use mcap::records::Record;

use super::error::ExportError;
use super::every_frame::every_frame;
use crate::recording::Recorder;
use crate::run::Log;
use crate::simulation::RobotView;
use message::{FrameTransforms, level};
use moment::Moment;
use motion_lab_core::worlds::World;
use paths::RunPath;
use writer::ViewerFile;

/// The programs that files are written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Viewer {
    Foxglove,
    Rerun,
}

/// Writes a log for Foxglove and Lichtblick: an MCAP file with the log's own messages and, by Foxglove's schemas, the
/// messages below. It is not a log that [`Log::read_mcap`] reads. Nothing is simulated.
///
/// | topic | schema | when |
/// |---|---|---|
/// | `/viewer/transforms` | `foxglove.FrameTransforms` | each tick: worlds in `lab`, robots and parts in their worlds |
/// | `/viewer/worlds` | `foxglove.SceneUpdate` | at the start, and again when obstacles or doors change |
/// | `/viewer/robots` | `foxglove.SceneUpdate` | at the start, in the parts' frames; again when a part comes or goes |
/// | `/viewer/paths` | `foxglove.SceneUpdate` | at the start: the whole run's paths, a cross where a contact began |
/// | `/viewer/contacts` | `foxglove.SceneUpdate` | when a contact begins or ceases to flash: what flashes, in red |
/// | `/viewer/scan/NAME` | `foxglove.LaserScan` | each tick of a robot with the run's range sensor |
/// | `/viewer/scan/NAME/SENSOR` | `foxglove.LaserScan` | each tick, for a sensor of the robot's own |
/// | `/viewer/log` | `foxglove.Log` | contacts, takeovers, refusals |
///
/// In a topic, `/` in a name is `%2F` and `%` is `%25`, so that no two names make one topic.
///
/// A message is whole: it shows all of its topic, so that a viewer may begin anywhere. The messages lie in chunks with
/// an index. With the feature `cli` the chunks are compressed by LZ4.
///
/// `add` adds the kinds of robots that the log names and the lab does not have, as with [`Run::show_with_robots`];
/// `|_| {}` adds none.
///
/// [`Run::show_with_robots`]: crate::recording::Run::show_with_robots
///
/// # Errors
/// [`ExportError`]: `out` fails, a kind is missing, or a frame is none of this run.
///
/// ```
/// use motion_lab_sim::export::write_foxglove;
/// use motion_lab_sim::recording::Run;
/// use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
/// let log = Run::record(TourConfig { ticks: 2, ..TourConfig::default() }, BOOK_SEED)?;
/// let mut file = Vec::new();
/// write_foxglove(&log, &mut file, |_| {})?;
/// assert!(file.starts_with(b"\x89MCAP0\r\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_foxglove(log: &Log, out: impl Write, add: impl FnOnce(&mut App)) -> Result<(), ExportError> {
    write_foxglove_of_file(&file_of(log)?, log, out, add, || {})
}

/// [`write_foxglove`] of a log that was read from a file with the bytes `file`, whose records are copied as they are:
/// another version of this program may have written them. The file may be cut off after the log's last tick.
///
/// `on_frame` is called twice for each frame of the log, tick 0 among them: once for the paths, which are drawn first,
/// and once when it is written.
///
/// # Errors
/// As [`write_foxglove`], and when the file ends before the log or its records cannot be copied.
pub fn write_foxglove_of_file(
    file: &[u8],
    log: &Log,
    out: impl Write,
    add: impl FnOnce(&mut App),
    on_frame: impl FnMut(),
) -> Result<(), ExportError> {
    write(Viewer::Foxglove, LoggedFile { file, log }, out, add, on_frame)
}

/// Writes a log for Rerun, as [`write_foxglove`] does for Foxglove. Rerun draws no scene entities and no laser scans,
/// so worlds, robots, paths and scans are clouds of coloured points, each in its frame.
///
/// | topic | schema | when |
/// |---|---|---|
/// | `/viewer/transforms` | `foxglove.FrameTransforms` | each tick: worlds in `lab`, robots and parts in their worlds |
/// | `/viewer/worlds/WORLD` | `foxglove.PointCloud` | at the start, and again when obstacles or doors change |
/// | `/viewer/robots/NAME/PART` | `foxglove.PointCloud` | as for Foxglove, a part each, red while a contact flashes |
/// | `/viewer/paths/NAME` | `foxglove.PointCloud` | at the start: the whole run's path |
/// | `/viewer/contacts/NAME` | `foxglove.PointCloud` | at the start: where the run's contacts begin |
/// | `/viewer/scan/NAME` | `foxglove.PointCloud` | each tick: what the run's range sensor hits |
/// | `/viewer/scan/NAME/SENSOR` | `foxglove.PointCloud` | each tick, for a sensor of the robot's own |
/// | `/viewer/log` | `foxglove.Log` | contacts, takeovers, refusals |
///
/// # Errors
/// As [`write_foxglove`].
///
/// ```
/// use motion_lab_sim::export::write_rerun;
/// use motion_lab_sim::recording::Run;
/// use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
/// let log = Run::record(TourConfig { ticks: 2, ..TourConfig::default() }, BOOK_SEED)?;
/// let mut file = Vec::new();
/// write_rerun(&log, &mut file, |_| {})?;
/// assert!(file.starts_with(b"\x89MCAP0\r\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_rerun(log: &Log, out: impl Write, add: impl FnOnce(&mut App)) -> Result<(), ExportError> {
    write_rerun_of_file(&file_of(log)?, log, out, add, || {})
}

/// [`write_rerun`] of a log that was read from a file with the bytes `file`, as [`write_foxglove_of_file`] takes it.
///
/// # Errors
/// As [`write_foxglove_of_file`].
pub fn write_rerun_of_file(
    file: &[u8],
    log: &Log,
    out: impl Write,
    add: impl FnOnce(&mut App),
    on_frame: impl FnMut(),
) -> Result<(), ExportError> {
    write(Viewer::Rerun, LoggedFile { file, log }, out, add, on_frame)
}

/// The bytes of the file that a log is written as.
fn file_of(log: &Log) -> Result<Vec<u8>, ExportError> {
    let mut file = Vec::new();
    log.write_mcap(&mut file)?;
    Ok(file)
}

/// A log with the bytes of its file.
struct LoggedFile<'a> {
    file: &'a [u8],
    log: &'a Log,
}

/// Writes a log for a viewer.
fn write(
    viewer: Viewer,
    LoggedFile { file, log }: LoggedFile<'_>,
    out: impl Write,
    add: impl FnOnce(&mut App),
    mut on_frame: impl FnMut(),
) -> Result<(), ExportError> {
    let mut original = Original { records: LinearReader::new_with_options(file, Options::IgnoreEndMagic.into()).ok() };
    let mut out = ViewerFile::begin(out)?;
    let mut run = Recorder::of_with_robots(&log.recipe, add)?.without_keyframes();
    let paths = RunPath::of_run(log, &mut run, every_frame(log), &mut on_frame)?;
    let mut viewed = Viewed { viewer, log, paths, before: Vec::new(), shown: Vec::new() };
    for frame in every_frame(log) {
        run.restore(frame)?;
        original.copy_tick(frame.tick, &mut out)?;
        viewed.tick(frame.tick, &run, &mut out)?;
        on_frame();
    }
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

/// A run as a viewer sees it.
struct Viewed<'a> {
    viewer: Viewer,
    log: &'a Log,
    /// The paths of the whole run.
    paths: Vec<RunPath>,
    /// The robots after the previous tick.
    before: Vec<RobotView>,
    /// The worlds as they were shown last.
    shown: Vec<Arc<World>>,
}

impl Viewed<'_> {
    fn tick(&mut self, tick: u64, run: &Recorder, out: &mut ViewerFile<impl Write>) -> Result<(), ExportError> {
        let (worlds, robots, standing) = (&self.log.recipe.config.worlds, run.view(), run.standing_worlds());
        if tick == 0 {
            let digest = self.log.digest().map_or_else(String::new, |digest| format!(", digest {digest}"));
            let run = format!("seed {}, {} ticks{digest}", self.log.recipe.seed, self.log.ticks());
            out.message("/viewer/log", "foxglove.Log", 0, &events::message_of(0, level::INFO, "motion-lab", run))?;
        }
        let mut transforms = frames::worlds(tick, worlds);
        for robot in &robots {
            let world = worlds.get(robot.world as usize);
            transforms.extend(world.map(|world| frames::robot(tick, world, robot)).into_iter().flatten());
        }
        out.message("/viewer/transforms", "foxglove.FrameTransforms", tick, &FrameTransforms { transforms })?;
        let moment = Moment {
            tick,
            worlds,
            standing: &standing,
            shown: &self.shown,
            robots: &robots,
            before: &self.before,
            paths: &self.paths,
            sensors: &run.sensors(),
        };
        match self.viewer {
            Viewer::Foxglove => moment.write_scene(out)?,
            Viewer::Rerun => moment.write_clouds(out)?,
        }
        for message in events::news(tick, &self.before, &robots) {
            out.message("/viewer/log", "foxglove.Log", tick, &message)?;
        }
        (self.before, self.shown) = (robots, standing);
        Ok(())
    }
}
