//! The obstacles of a scene.

use super::context::{IrContext, unsupported};
use super::group::IrGroup;
use super::shape::IrShape;
use crate::ImportError;
use crate::yaml::{Fields, YamlNode, YamlValue};

/// Keys that describe how an obstacle looks, or how it would move if it did.
const IGNORED: [&str; 21] = [
    "color",
    "plot",
    "description",
    "role",
    "behavior",
    "group_behavior",
    "goal",
    "goal_threshold",
    "velocity",
    "vel_min",
    "vel_max",
    "acce",
    "angle_range",
    "arrive_mode",
    "group",
    "group_name",
    "state_dim",
    "vel_dim",
    "fov",
    "fov_radius",
    "sensors",
];

/// The keys that are known, for errors.
const KNOWN: &str = "shape, state, number, distribution, name, unobstructed, and color, plot, description, role";

/// Adds the obstacles of an entry.
pub(crate) fn obstacles(item: &str, node: &YamlNode, scene: &mut IrContext) -> Result<(), ImportError> {
    let mut fields = node.fields(item)?;
    refuse_moving(item, &mut fields)?;
    let group = IrGroup::take(item, node.line, &mut fields, scene)?;
    let shapes = shapes(item, &mut fields, group.states.len())?;
    let painted = fields.take("unobstructed");
    let painted = painted.map_or(Ok(false), |node| node.boolean(&format!("{item}.unobstructed")))?;
    let name = fields.take("name").filter(|node| !node.is_null());
    scene.note_ignored(&mut fields, "obstacle.", &IGNORED);
    scene.finish(fields, "obstacle.", KNOWN)?;
    let refuse = |problem| ImportError::at(node.line, item, problem);
    scene.room.take_points(points(&shapes, group.states.len())).map_err(refuse)?;
    if shapes.iter().any(IrShape::is_random) {
        let seed = scene.options.seed;
        scene.draft.note(format!("{item}: its shapes are drawn with seed {seed}; IR-SIM draws others"));
    }
    let mut stream = scene.stream(&format!("{item}/shape"));
    for (i, state) in group.states.iter().enumerate() {
        let shape = of(&shapes, i).drawn(&mut stream, &mut scene.room).map_err(refuse)?;
        if painted && !shape.is_line() {
            let kind = shape.kind();
            scene.draft.note(format!("{item}, a {kind} that nothing collides with, is left out"));
            continue;
        }
        let name = match name {
            Some(name) => scene.draft.world.claim(name.each(i).text(&format!("{item}.name"))?),
            None => scene.draft.world.numbered(shape.stem(painted)),
        };
        shape.put(state, painted, name, scene).map_err(|problem| ImportError::at(node.line, item, problem))?;
    }
    Ok(())
}

/// The shape of object number `i`: with fewer shapes than objects, the last one again.
fn of(shapes: &[IrShape], i: usize) -> &IrShape {
    shapes.get(i).or(shapes.last()).unwrap_or(&IrShape::USUAL)
}

/// The points of `number` objects, in time by the shapes: the last one may stand for any number of objects.
fn points(shapes: &[IrShape], number: usize) -> usize {
    let own = shapes.iter().take(number).map(IrShape::points).fold(0, usize::saturating_add);
    let again = number.saturating_sub(shapes.len());
    of(shapes, number).points().saturating_mul(again).saturating_add(own)
}

/// The shapes of the first objects, at most `number`.
fn shapes(item: &str, fields: &mut Fields, number: usize) -> Result<Vec<IrShape>, ImportError> {
    let Some(node) = fields.take("shape").filter(|node| !node.is_null()) else { return Ok(vec![IrShape::USUAL]) };
    let at = format!("{item}.shape");
    match &node.value {
        YamlValue::List(nodes) if !nodes.is_empty() => {
            nodes.iter().take(number.max(1)).map(|node| IrShape::read(&at, node)).collect()
        }
        _ => Ok(vec![IrShape::read(&at, node)?]),
    }
}

/// Refuses obstacles that move: those with kinematics that are not static.
fn refuse_moving(item: &str, fields: &mut Fields) -> Result<(), ImportError> {
    let is_static = fields.take("static").map_or(Ok(false), |node| node.boolean(&format!("{item}.static")))?;
    let Some(node) = fields.take("kinematics").filter(|node| !node.is_null()) else { return Ok(()) };
    let at = format!("{item}.kinematics");
    let name = node.each(0).fields(&at)?.take("name").map(|name| name.text(&at)).transpose()?;
    if is_static || name.is_none_or(|name| name == "static") {
        return Ok(());
    }
    Err(unsupported(node, at, "an obstacle that moves"))
}
