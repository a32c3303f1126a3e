//! Reads a subset of IR-SIM's YAML.

use super::shape::IrShape;
use crate::error::wrong_value;
use crate::yaml::{self, Fields, YamlNode, YamlValue};
use crate::{ImportError, ImportProblem, Imported, WorldDraft};
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::geometry::Pose2;

/// Keys that describe how a simulation runs or looks, not its geometry.
const IGNORED_OF_WORLD: [&str; 7] =
    ["step_time", "sample_time", "step_mode", "control_mode", "collision_mode", "plot", "status"];
const IGNORED_OF_OBSTACLE: [&str; 4] = ["color", "plot", "description", "role"];
const OBSTACLE_KEYS: &str =
    "shape, state, number, distribution, name, unobstructed, and color, plot, description, role";

/// Reads a world of IR-SIM: `world` with `width`, `height` and `offset`; `obstacle` with the shapes `circle`,
/// `rectangle`, `polygon` and `linestring`, each at its `state`, one of them or `number` of them in the distribution
/// `manual`; and `robot`.
///
/// A robot of the kinematics `diff` becomes a Rusty, one of `acker` a Hitch, with this lab's own shape and speed; its
/// goal becomes a place. An `unobstructed` obstacle becomes a painted mark; an unobstructed circle is left out. Keys of
/// time, behaviour and looks are left out as well. Everything left out gets a note. `file` is the file's name in
/// errors.
///
/// # Errors
/// [`ImportError`] names line and item: unknown keys, shapes and kinematics, random distributions, obstacles that move
/// or can be pushed, grid maps.
pub fn irsim(file: &str, text: &str, name: &str) -> Result<Imported, ImportError> {
    read(text, name).map_err(|error| error.of(file))
}

fn read(text: &str, name: &str) -> Result<Imported, ImportError> {
    let tree = yaml::read(text)?;
    let mut sections = tree.fields("")?;
    let mut draft = WorldDraft::default();
    let world = sections.need("world")?;
    let [min, max] = bounds(world, &mut draft)?;
    for (item, node) in objects(sections.take("obstacle"), "obstacle") {
        obstacles(&item, node, &mut draft)?;
    }
    for (item, node) in objects(sections.take("robot"), "robot") {
        robots(&item, node, &mut draft)?;
    }
    note_ignored(&mut sections, "", &["gui"], &mut draft);
    sections.finish("world, robot and obstacle")?;
    draft.finish(name, min, max).map_err(|problem| ImportError::at(world.line, "world", problem))
}

/// The corners of the world.
fn bounds(node: &YamlNode, draft: &mut WorldDraft) -> Result<[(f64, f64); 2], ImportError> {
    let mut fields = node.fields("world")?;
    let mut side = |key: &'static str| match fields.take(key) {
        None => Ok(10.0), // IR-SIM's own default
        Some(node) => match node.number(key)? {
            side if side > 0.0 => Ok(side),
            _ => Err(node.wrong(&format!("world.{key}"), "above 0")),
        },
    };
    let (width, height) = (side("width")?, side("height")?);
    let offset = match fields.take("offset") {
        None => vec![0.0, 0.0],
        Some(node) => node.numbers("world.offset", 2..=2, "two numbers: x, y")?,
    };
    note_ignored(&mut fields, "world.", &IGNORED_OF_WORLD, draft);
    fields.finish("width, height and offset")?;
    Ok([(offset[0], offset[1]), (offset[0] + width, offset[1] + height)])
}

/// The objects of a section: a list of them, or one by itself.
fn objects<'a>(section: Option<&'a YamlNode>, name: &str) -> Vec<(String, &'a YamlNode)> {
    match section {
        None => Vec::new(),
        Some(YamlNode { value: YamlValue::List(nodes), .. }) => {
            nodes.iter().enumerate().map(|(i, node)| (format!("{name}[{i}]"), node)).collect()
        }
        Some(node) => vec![(name.to_owned(), node)],
    }
}

/// Takes the keys that are left out and adds a note for each.
fn note_ignored(fields: &mut Fields, item: &str, keys: &[&str], draft: &mut WorldDraft) {
    for key in keys {
        if fields.take(key).is_some() {
            draft.note(format!("{item}{key} is left out"));
        }
    }
}

fn obstacles(item: &str, node: &YamlNode, draft: &mut WorldDraft) -> Result<(), ImportError> {
    let mut fields = node.fields(item)?;
    for (key, what) in [
        ("kinematics", "an obstacle that moves"),
        ("behavior", "an obstacle that moves"),
        ("mass", "an obstacle that can be pushed"),
    ] {
        if let Some(node) = fields.take(key) {
            return Err(ImportError::at(node.line, format!("{item}.{key}"), ImportProblem::Unsupported(what.into())));
        }
    }
    let states = states(item, &mut fields)?;
    let shape = fields.need("shape")?;
    let shapes = match &shape.value {
        YamlValue::List(nodes) if !nodes.is_empty() => nodes.iter().collect(),
        _ => vec![shape],
    };
    let shapes =
        shapes.iter().map(|node| IrShape::read(&format!("{item}.shape"), node)).collect::<Result<Vec<_>, _>>()?;
    let painted = match fields.take("unobstructed") {
        None => false,
        Some(node) => match node.text(item)? {
            "True" | "true" => true,
            "False" | "false" => false,
            _ => return Err(node.wrong(&format!("{item}.unobstructed"), "True or False")),
        },
    };
    let name = fields.take("name").map(|node| node.text(&format!("{item}.name"))).transpose()?;
    note_ignored(&mut fields, "obstacle.", &IGNORED_OF_OBSTACLE, draft);
    fields.finish(OBSTACLE_KEYS)?;
    for (i, state) in states.iter().enumerate() {
        // with fewer shapes than states, the last shape is used again
        let shape = &shapes[i.min(shapes.len() - 1)];
        let name = match name {
            Some(name) => draft.world.claim(name),
            None => draft.world.numbered(shape.stem(painted)),
        };
        shape.put(state, painted, name, draft).map_err(|problem| ImportError::at(node.line, item, problem))?;
    }
    Ok(())
}

fn robots(item: &str, node: &YamlNode, draft: &mut WorldDraft) -> Result<(), ImportError> {
    let mut fields = node.fields(item)?;
    let kinematics = fields.need("kinematics")?;
    let mut model = kinematics.fields(&format!("{item}.kinematics"))?;
    let model_name = model.need("name")?;
    let kind = match model_name.text("name")? {
        "diff" => RobotKind::RUSTY.name,
        "acker" => RobotKind::HITCH.name,
        _ => return Err(model_name.wrong(&format!("{item}.kinematics.name"), "diff or acker")),
    };
    let states = states(item, &mut fields)?;
    if let Some(goal) = fields.take("goal") {
        let goals = poses(&format!("{item}.goal"), goal)?;
        for goal in goals {
            let name = draft.world.numbered("goal");
            draft.world.place(name, goal).map_err(|problem| ImportError::at(node.line, item, problem))?;
        }
    }
    while let Some((key, _)) = fields.rest() {
        draft.note(format!("robot.{key} is left out"));
    }
    for pose in states {
        draft
            .robot(kind, vec![pose.x, pose.y, pose.theta])
            .map_err(|problem| ImportError::at(node.line, item, problem))?;
    }
    Ok(())
}

/// Reads the states of an object. A `number`, if given, must be the number of states.
fn states(item: &str, fields: &mut Fields) -> Result<Vec<Pose2>, ImportError> {
    let states = match fields.take("state") {
        None => vec![Pose2::IDENTITY],
        Some(node) => poses(&format!("{item}.state"), node)?,
    };
    if let Some(node) = fields.take("distribution") {
        let at = format!("{item}.distribution");
        let mut distribution = node.fields(&at)?;
        let name = distribution.need("name")?;
        if name.text(&at)? != "manual" {
            return Err(name.wrong(&at, "manual: what is drawn at random is nowhere yet"));
        }
        distribution.finish("name")?;
    }
    let Some(node) = fields.take("number") else { return Ok(states) };
    let at = format!("{item}.number");
    let number = node.number(&at)?;
    if number == states.len() as f64 {
        return Ok(states);
    }
    let found = format!("{number} with {} states", states.len());
    Err(ImportError::at(node.line, at, wrong_value(found, "the number of its states")))
}

/// Reads one pose, or a list of poses: `[x, y]` or `[x, y, theta]`. A fourth number, a car's steering angle, is
/// ignored.
fn poses(item: &str, node: &YamlNode) -> Result<Vec<Pose2>, ImportError> {
    let nodes = node.list(item)?;
    let several = nodes.iter().any(|n| matches!(n.value, YamlValue::List(_)));
    let pose = |node: &YamlNode| {
        let numbers = node.numbers(item, 2..=4, "two to four numbers: x, y, theta")?;
        Ok(Pose2::new(numbers[0], numbers[1], numbers.get(2).copied().unwrap_or(0.0)))
    };
    if several { nodes.iter().map(pose).collect() } else { Ok(vec![pose(node)?]) }
}
