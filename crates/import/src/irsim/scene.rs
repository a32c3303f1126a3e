//! Reads a subset of IR-SIM's YAML.

use super::context::{IrContext, IrRoom, IrsimOptions, objects, unsupported};
use super::obstacle::obstacles;
use super::robot::robots;
use crate::yaml::{self, YamlNode};
use crate::{ImportError, Imported, WorldDraft};

/// Keys that describe how a simulation runs or looks, not its geometry.
const IGNORED: [&str; 11] = [
    "name",
    "step_time",
    "sample_time",
    "step_mode",
    "control_mode",
    "collision_mode",
    "plot",
    "status",
    "mdownsample",
    "fog_map",
    "fog_map_resolution",
];

/// Reads a world of IR-SIM: `world` with `width`, `height` and `offset`; `obstacle` with the shapes `circle`,
/// `rectangle`, `polygon`, `linestring` and `compound`, `number` of them, each at its `state` or where the distribution
/// `circle` or `random` puts it; and `robot`.
///
/// A robot of the kinematics `diff` becomes a Rusty, the disc that covers its shape, one of `acker` a Hitch of the
/// sizes of its rectangle; their lidars become range sensors, their goals places. Speeds are this lab's own. An
/// `unobstructed` obstacle becomes a painted mark; an unobstructed circle is left out. Keys of time, behaviour and
/// looks are left out as well. Everything left out gets a note. Of a key that stands twice the last one counts, with a
/// note. `file` is the file's name in errors.
///
/// What is drawn at random, shapes too, follows from [`IrsimOptions::seed`] and the entry's number; IR-SIM draws other
/// numbers.
///
/// # Errors
/// [`ImportError`] names line and item: unknown keys and shapes; more than 100,000 objects and sensors in all, left out
/// or not; and, unless they are to be left out, obstacles that move, robots that drive otherwise, grid maps, and what
/// gives the obstacles more than 400,000 points or takes too many tries at random.
pub fn irsim(file: &str, text: &str, name: &str, options: IrsimOptions) -> Result<Imported, ImportError> {
    read(text, name, options).map_err(|error| error.of(file))
}

fn read(text: &str, name: &str, options: IrsimOptions) -> Result<Imported, ImportError> {
    let (tree, repeated) = yaml::read_as_python(text)?;
    let mut sections = tree.fields("")?;
    let world = sections.take("world").filter(|node| !node.is_null());
    let (mut draft, room) = (WorldDraft::default(), IrRoom::default());
    repeated.into_iter().for_each(|note| draft.note(note));
    let mut scene = IrContext { draft, options, min: [0.0; 2], size: [10.0; 2], room };
    if let Some(world) = world {
        bounds(world, &mut scene)?;
    }
    let (obstacle, robot) = (sections.take("obstacle"), sections.take("robot"));
    scene.note_ignored(&mut sections, "", &["gui"]);
    // before what stands in the world: without a size that is spelled right, all may lie outside
    scene.finish(sections, "", "world, robot and obstacle")?;
    for (item, node) in objects(obstacle, "obstacle") {
        let read = obstacles(&item, node, &mut scene);
        scene.or_left_out(&item, read)?;
    }
    for (item, node) in objects(robot, "robot") {
        let read = robots(&item, node, &mut scene);
        scene.or_left_out(&item, read)?;
    }
    let ([x, y], [width, height]) = (scene.min, scene.size);
    let line = world.map_or(0, |world| world.line);
    let finished = scene.draft.finish(name, (x, y), (x + width, y + height));
    finished.map_err(|problem| ImportError::at(line, "world", problem))
}

/// Reads where the world lies.
fn bounds(node: &YamlNode, scene: &mut IrContext) -> Result<(), ImportError> {
    let mut fields = node.fields("world")?;
    for (i, key) in ["width", "height"].into_iter().enumerate() {
        if let Some(node) = fields.take(key) {
            let at = format!("world.{key}");
            scene.size[i] = node.number(&at)?;
            if scene.size[i] <= 0.0 {
                return Err(node.wrong(&at, "above 0"));
            }
        }
    }
    if let Some(node) = fields.take("offset") {
        let offset = node.numbers("world.offset", 2..=2, "two numbers: x, y")?;
        scene.min = [offset[0], offset[1]];
    }
    if let Some(node) = fields.take("obstacle_map").filter(|node| !node.is_null()) {
        scene.or_left_out("world.obstacle_map", Err::<(), _>(unsupported(node, "world.obstacle_map", "a grid map")))?;
    }
    scene.note_ignored(&mut fields, "world.", &IGNORED);
    scene.finish(fields, "world.", "width, height and offset")
}
