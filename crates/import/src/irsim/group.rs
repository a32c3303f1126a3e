//! `IrGroup`, the objects that one entry of a scene describes: how many there are, where they stand, where they go.

use std::f64::consts::{PI, TAU};

use super::context::{IrContext, IrRoom, unsupported};
use crate::yaml::{Fields, YamlNode, YamlValue};
use crate::{ImportError, ImportProblem};
use motion_lab_core::geometry::Pose2;
use motion_lab_core::num::{hypot, lesser, sin_cos};
use motion_lab_core::random::Stream;
use motion_lab_core::worlds::MAX_ITEMS;

/// Largest number of objects that are drawn at random: each keeps its distance from those before it.
const MAX_DRAWN: usize = 1000;

/// How often a place is drawn that is too near to another one, before it is taken all the same; as in IR-SIM.
const MAX_ATTEMPTS: usize = 1000;

/// Where IR-SIM puts an object without a state.
const USUAL_STATE: Pose2 = Pose2 { x: 1.0, y: 1.0, theta: 0.0 };

/// What IR-SIM keeps free along the borders, metres.
const MARGIN: f64 = 0.5;

/// The objects of an entry.
pub(crate) struct IrGroup {
    /// The pose of each.
    pub states: Vec<Pose2>,
    /// The goals that their distribution gives them; `None` for those that the entry names.
    pub goals: Option<Vec<Pose2>>,
}

impl IrGroup {
    /// Takes `number`, `distribution` and `state` of an entry in this line, and the room that its objects take.
    pub fn take(item: &str, line: usize, fields: &mut Fields, scene: &mut IrContext) -> Result<IrGroup, ImportError> {
        let at = format!("{item}.number");
        let node = fields.take("number");
        let number = node.map_or(Ok(1), |node| count(&at, node))?;
        let line = node.map_or(line, |node| node.line);
        scene.room.take_objects(number).map_err(|problem| ImportError::at(line, at, problem))?;
        let state = fields.take("state").filter(|node| !node.is_null());
        let at = format!("{item}.distribution");
        let Some(node) = fields.take("distribution").filter(|node| !node.is_null()) else {
            return manual(item, number, state, scene);
        };
        let mut distribution = node.fields(&at)?;
        if distribution.take("3d").is_some_and(|node| node.boolean(&at) == Ok(true)) {
            return Err(unsupported(node, at, "three dimensions"));
        }
        match distribution.need("name")?.text(&at)? {
            "manual" => manual(item, number, state, scene),
            "circle" => circle(&at, number, &mut distribution, scene),
            "random" if number > MAX_DRAWN => {
                Err(unsupported(node, at, format!("{number} at random; at most {MAX_DRAWN}")))
            }
            "random" => random(item, node.line, number, &mut distribution, scene),
            name => Err(unsupported(node, at, format!("{name}; known are manual, circle and random"))),
        }
    }
}

/// A whole number of objects.
fn count(item: &str, node: &YamlNode) -> Result<usize, ImportError> {
    let number = node.number(item)?;
    if (0.0..=MAX_ITEMS as f64).contains(&number) && number.fract() == 0.0 {
        return Ok(number as usize);
    }
    Err(node.wrong(item, "a whole number of objects, at most 100000"))
}

/// The first `number` of the states; the last of them again where there are fewer.
fn manual(item: &str, number: usize, state: Option<&YamlNode>, scene: &mut IrContext) -> Result<IrGroup, ImportError> {
    let Some(node) = state else {
        scene.draft.note(format!("{item} has no state: it stands at (1, 1), as in IR-SIM"));
        return Ok(IrGroup { states: vec![USUAL_STATE; number], goals: None });
    };
    let mut states = poses(&format!("{item}.state"), node)?;
    if states.len() > number {
        scene.draft.note(format!("{item}: the first {number} of its {} states are taken, as in IR-SIM", states.len()));
    }
    states.resize(number, states.last().copied().unwrap_or(USUAL_STATE));
    Ok(IrGroup { states, goals: None })
}

/// Objects on a circle, each facing the middle and heading for the other side.
fn circle(item: &str, number: usize, fields: &mut Fields, scene: &IrContext) -> Result<IrGroup, ImportError> {
    let [width, height] = scene.size;
    let radius = match fields.take("radius") {
        None => lesser(width, height) / 2.0 - MARGIN,
        Some(node) => node.number(&format!("{item}.radius"))?,
    };
    let centre = match fields.take("center") {
        None => vec![scene.min[0] + width / 2.0, scene.min[1] + height / 2.0],
        Some(node) => node.numbers(&format!("{item}.center"), 2..=3, "two or three numbers: x, y")?,
    };
    let pose = |i: usize, side: f64| {
        let theta = TAU * i as f64 / number as f64;
        let (sin, cos) = sin_cos(theta);
        Pose2::new(centre[0] + side * radius * cos, centre[1] + side * radius * sin, theta - PI)
    };
    let poses = |side: f64| (0..number).map(|i| pose(i, side)).collect::<Vec<_>>();
    Ok(IrGroup { states: poses(1.0), goals: Some(poses(-1.0)) })
}

/// Objects at random poses in a range.
fn random(
    item: &str,
    line: usize,
    number: usize,
    fields: &mut Fields,
    scene: &mut IrContext,
) -> Result<IrGroup, ImportError> {
    let [width, height] = scene.size;
    let [x, y] = scene.min;
    let mut corner = |key: &str, usual: [f64; 3]| {
        let Some(node) = fields.take(key) else { return Ok::<_, ImportError>(usual) };
        let numbers = node.numbers(&format!("{item}.distribution.{key}"), 2..=3, "three numbers: x, y, theta")?;
        Ok([numbers[0], numbers[1], numbers.get(2).copied().unwrap_or(0.0)])
    };
    let low = corner("range_low", [x + MARGIN, y + MARGIN, -PI])?;
    let high = corner("range_high", [x + width - MARGIN, y + height - MARGIN, PI])?;
    let apart = match fields.take("min_distance") {
        None => 1.0,
        Some(node) => node.number(&format!("{item}.distribution.min_distance"))?,
    };
    let objects = if number == 1 { "1 object is" } else { &format!("{number} objects are") };
    scene.draft.note(format!("{item}: {objects} drawn with seed {}; IR-SIM draws others", scene.options.seed));
    let streams = [scene.stream(item), scene.stream(&format!("{item}/goal"))];
    let draw = |stream| drawn(stream, number, [low, high], apart, &mut scene.room);
    let [states, goals] = streams.map(draw);
    let of_item = |problem| ImportError::at(line, format!("{item}.distribution"), problem);
    let (states, goals) = (states.map_err(of_item)?, goals.map_err(of_item)?);
    Ok(IrGroup { states, goals: Some(goals) })
}

/// Poses between two corners, at least so far apart if that can be had.
fn drawn(
    mut stream: Stream,
    number: usize,
    [low, high]: [[f64; 3]; 2],
    apart: f64,
    room: &mut IrRoom,
) -> Result<Vec<Pose2>, ImportProblem> {
    let mut poses: Vec<Pose2> = Vec::with_capacity(number);
    for _ in 0..number {
        let mut pose = Pose2::IDENTITY;
        for _ in 0..MAX_ATTEMPTS {
            let [x, y, theta] = [0, 1, 2].map(|i| stream.uniform(low[i], high[i]));
            pose = Pose2::new(x, y, theta);
            let near = poses.iter().position(|other| hypot(other.x - x, other.y - y) < apart);
            room.take_draw(near.map_or(poses.len(), |i| i + 1))?;
            if near.is_none() {
                break;
            }
        }
        poses.push(pose);
    }
    Ok(poses)
}

/// Reads one pose, or a list of poses: `[x, y]` or `[x, y, theta]`. A fourth number, a car's steering angle, is
/// ignored.
pub(crate) fn poses(item: &str, node: &YamlNode) -> Result<Vec<Pose2>, ImportError> {
    let nodes = node.list(item)?;
    let several = nodes.iter().any(|n| matches!(n.value, YamlValue::List(_)));
    let pose = |node: &YamlNode| {
        let numbers = node.numbers(item, 2..=4, "two to four numbers: x, y, theta")?;
        Ok(Pose2::new(numbers[0], numbers[1], numbers.get(2).copied().unwrap_or(0.0)))
    };
    if several { nodes.iter().map(pose).collect() } else { Ok(vec![pose(node)?]) }
}
