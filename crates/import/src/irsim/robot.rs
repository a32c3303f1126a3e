//! The robots of a scene.

use super::context::{IrContext, unsupported};
use super::group::{IrGroup, poses};
use super::shape::IrShape;
use crate::ImportError;
use crate::draft::DraftRobot;
use crate::yaml::{Fields, YamlNode, YamlValue};
use motion_lab_core::configuration::{CarSizes, DiscSizes, RobotKind, Sizes};
use motion_lab_core::geometry::{Point2, Pose2};
use motion_lab_core::num::wrap;
use motion_lab_core::worlds::{BeamModel, FanSensor, OutsideError, RangeSensor, ResidentSensor};
use std::f64::consts::{PI, TAU};

/// Adds the robots of an entry, and their goals as places.
pub(crate) fn robots(item: &str, node: &YamlNode, scene: &mut IrContext) -> Result<(), ImportError> {
    let mut fields = node.fields(item)?;
    let kind = kind(item, node, &mut fields)?;
    let group = IrGroup::take(item, node.line, &mut fields, scene)?;
    let goal = fields.take("goal").filter(|node| !node.is_null());
    let goals = match (&group.goals, goal) {
        (Some(goals), _) => goals.clone(),
        (None, Some(node)) => goals(&format!("{item}.goal"), node, group.states.len())?,
        (None, None) => vec![],
    };
    let shape = fields.take("shape").filter(|node| !node.is_null());
    let shapes = (0..group.states.len().min(shape.map_or(1, entries)))
        .map(|i| shape.map_or(Ok(IrShape::USUAL), |node| IrShape::read(&format!("{item}.shape"), node.each(i))))
        .collect::<Result<Vec<_>, _>>()?;
    let sensors = fields.take("sensors").filter(|node| !node.is_null());
    let sensors = sensors.map_or(Ok(vec![]), |node| sensors_of(item, node, scene))?;
    let put = |problem| ImportError::at(node.line, item, problem);
    scene.room.take_objects(group.states.len().saturating_mul(sensors.len())).map_err(put)?;
    let name = fields.take("name").filter(|node| !node.is_null());
    while let Some((key, _)) = fields.rest() {
        scene.draft.note(format!("robot.{key} is left out"));
    }
    let sizes: Vec<Option<Sizes>> = shapes.iter().map(|shape| sizes(item, kind, shape, scene)).collect();
    for goal in goals {
        let name = scene.draft.world.numbered("goal");
        scene.draft.world.place(name, goal).map_err(put)?;
    }
    let bounds = scene.bounds();
    for (i, pose) in group.states.iter().enumerate() {
        // IR-SIM lets robots drive in from outside of what it draws
        let within = OutsideError::check("start", pose.position(), &bounds);
        let within = within.map_err(|outside| unsupported(node, item, outside.to_string()));
        if scene.or_left_out(item, within)?.is_none() {
            continue;
        }
        let sizes = sizes.get(i).or(sizes.last()).cloned().flatten();
        let start = vec![pose.x, pose.y, pose.theta];
        let name = name.map(|node| node.each(i).text(&format!("{item}.name"))).transpose()?;
        scene.draft.robot(name, DraftRobot { kind, start, sizes, sensors: &sensors }).map_err(put)?;
    }
    Ok(())
}

/// The number of a list's entries, 1 for anything else.
fn entries(node: &YamlNode) -> usize {
    match &node.value {
        YamlValue::List(nodes) => nodes.len(),
        _ => 1,
    }
}

/// The kind of robot that drives as this one: Rusty for `diff`, Hitch for `acker`.
fn kind(item: &str, node: &YamlNode, fields: &mut Fields) -> Result<&'static str, ImportError> {
    let at = format!("{item}.kinematics");
    let stands = || unsupported(node, &at, "a robot that does not drive");
    let kinematics = fields.take("kinematics").filter(|node| !node.is_null()).ok_or_else(stands)?.each(0);
    let name = kinematics.fields(&at)?.need("name")?;
    match name.text(&at)? {
        "diff" => Ok(RobotKind::RUSTY.name),
        "acker" => Ok(RobotKind::HITCH.name),
        "static" => Err(stands()),
        other => Err(unsupported(
            name,
            format!("{at}.name"),
            format!("a robot that drives as {other}; known are diff and acker"),
        )),
    }
}

/// Reads the goals of `number` robots: a pose for all, a pose for each, or a list of poses for each.
fn goals(item: &str, node: &YamlNode, number: usize) -> Result<Vec<Pose2>, ImportError> {
    let is_list = |node: &YamlNode| matches!(node.value, YamlValue::List(_));
    let nodes = node.list(item)?;
    if !nodes.iter().any(is_list) {
        return poses(item, node);
    }
    nodes.iter().take(number).map(|node| poses(item, node)).collect::<Result<Vec<_>, _>>().map(|all| all.concat())
}

/// The sizes of a robot of this shape, with a note where they are not just that. `None` for the kind's own.
fn sizes(item: &str, kind: &str, shape: &IrShape, scene: &mut IrContext) -> Option<Sizes> {
    let found = if kind == RobotKind::RUSTY.name {
        let radius = shape.reach();
        let is_disc = matches!(shape, IrShape::Circle { centre, .. } if *centre == Point2::origin());
        if !is_disc {
            scene.draft.note(format!("{item}: its {} becomes the disc of {radius} m about its middle", shape.kind()));
        }
        let usual = DiscSizes::RUSTY;
        let scale = radius / usual.radius;
        Some(Sizes::Disc(DiscSizes { radius, track: usual.track * scale, wheel_radius: usual.wheel_radius * scale }))
    } else if let IrShape::Rectangle { length, width, wheelbase: Some(wheelbase) } = *shape {
        let rear_overhang = (length - wheelbase) / 2.0;
        Some(Sizes::Car(CarSizes { wheelbase, length, width, rear_overhang, ..CarSizes::HITCH }))
    } else {
        None
    };
    let sizes = found.filter(|sizes| sizes.check().is_ok());
    if sizes.is_none() {
        scene.draft.note(format!("{item}: its {} is left out; it has {kind}'s own shape", shape.kind()));
    }
    sizes
}

/// Reads the sensors of an entry's robots.
fn sensors_of(item: &str, node: &YamlNode, scene: &mut IrContext) -> Result<Vec<ResidentSensor>, ImportError> {
    let at = format!("{item}.sensors");
    let mut sensors: Vec<ResidentSensor> = Vec::new();
    let nodes = match &node.value {
        YamlValue::List(nodes) => nodes.iter().collect(),
        _ => vec![node],
    };
    for (i, node) in nodes.into_iter().enumerate() {
        // a list of lists gives each robot its own: all get those of the first
        let node = node.each(0);
        let mut fields = node.fields(&at)?;
        let named = fields.take("name").or(fields.take("type"));
        let name = named.map_or(Ok("lidar2d"), |node| node.text(&at))?;
        if !matches!(name, "lidar2d" | "fmcw_lidar2d") {
            let item = format!("{at}[{i}]");
            let unknown = format!("a sensor {name}; known are lidar2d and fmcw_lidar2d");
            scene.or_left_out(&item, Err::<(), _>(unsupported(node, &item, unknown)))?;
            continue;
        }
        let mut number = |key: &str, usual: f64| {
            fields.take(key).filter(|n| !n.is_null()).map_or(Ok(usual), |node| node.number(&format!("{at}.{key}")))
        };
        let (rays, range, angle) = (number("number", 100.0)?, number("range_max", 10.0)?, number("angle_range", PI)?);
        let sigma_hit = number("std", 0.2)?;
        let noise = fields.take("noise").map_or(Ok(false), |node| node.boolean(&format!("{at}.noise")))?;
        let offset = fields.take("offset").filter(|node| !node.is_null());
        let offset = offset.map(|node| poses(&format!("{at}.offset"), node)).transpose()?;
        let mount = offset.and_then(|poses| poses.first().copied()).unwrap_or(Pose2::IDENTITY);
        // as IR-SIM wraps it; a full turn stays one
        let turn = if angle > 0.0 && angle <= TAU { angle } else { wrap(angle - PI) + PI };
        let sensor = RangeSensor { n_rays: rays as u32, max_range: range };
        let count = sensors.len() + 1;
        let name = if count == 1 { name.to_owned() } else { format!("{name} {count}") };
        let noise = noise.then_some(BeamModel { sigma_hit, ..BeamModel::EXACT });
        let sensor = ResidentSensor { name, rays: FanSensor { sensor, field_of_view: turn }, mount, noise };
        sensors.push(sensor);
        while let Some((key, _)) = fields.rest() {
            if !matches!(key, "plot" | "alpha" | "type") {
                scene.draft.note(format!("robot.sensors.{key} is left out"));
            }
        }
    }
    Ok(sensors)
}
