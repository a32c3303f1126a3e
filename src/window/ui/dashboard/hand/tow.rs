//! Towing a robot on wheels by its body: the pointer pulls, and the robot drives by its own commands.

use bevy_egui::egui::Ui;

use super::drive;
use super::held_tow::{Gripped, HeldTow};
use crate::window::ui::{CockpitRobot, Command, Grasp, UiState};
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::geometry::{Point2, Pose2};
use motion_lab_core::picture::{Anchor, Dash, Drawing, Face, Item, Line, Role};
use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::tow::{Tow, TowState, grip_at};

/// Radius of the ring at the pointer, metres: of a rover and of a car.
const RINGS: [f64; 2] = [0.08, 0.3];

/// Whether a robot can be towed: one of the lab's on wheels, driven by channels.
pub fn is_towable(robot: &CockpitRobot) -> bool {
    robot.drivable && as_model(robot).is_some_and(|(model, q)| grip_at(&model, &q, Point2::origin()).is_some())
}

fn as_model(robot: &CockpitRobot) -> Option<(AnyRobot, AnyConfiguration)> {
    Some((robot.model?, AnyRobot::of_kind(&robot.kind, &robot.coordinates)?.1))
}

/// What is gripped of a robot that was pressed here while it had these coordinates; `None` for one that is not towed.
pub fn gripped(robot: &CockpitRobot, coordinates: &[f64], pressed: Point2) -> Option<Gripped> {
    let (model, (_, q)) = robot.model.zip(AnyRobot::of_kind(&robot.kind, coordinates))?;
    let grip = grip_at(&model, &q, pressed)?;
    Some(Gripped { grip, off: Tow::new(grip, pressed).gripped(&model, &q)? - pressed })
}

/// Takes a robot in hand by its grip.
pub fn take(robot: &CockpitRobot, by: Gripped, state: &mut UiState, commands: &mut Vec<Command>) {
    if state.hand.armed.as_ref() != Some(&robot.name) {
        drive::let_go(state, commands);
        state.focus.next_grasp = Some(Grasp::Leave);
        state.hand.armed = Some(robot.name.clone());
    }
    state.hand.tow = Some(HeldTow::new(&robot.name, by));
}

/// Pulls a robot that is gripped toward the pointer: its channels are left in the state, where `drive` takes them.
/// Returns what there is to draw.
pub fn pull(ui: &Ui, robot: &CockpitRobot, pointer: Point2, state: &mut UiState) -> Vec<Item> {
    let tow = state.hand.tow.as_mut().filter(|tow| tow.robot == robot.name);
    let (Some(tow), Some((model, q))) = (tow, as_model(robot)) else { return Vec::new() };
    let line = tow.line_to(pointer);
    let Some(command) = line.command(&model, &q) else { return Vec::new() };
    tow.hold(command.channels);
    // sent by the next frame, and seen to have let go by the one after it
    ui.ctx().request_repaint();
    drawn(robot, &line, command.state)
}

/// The line by which a robot is towed, a ring where it is pulled to, and in words why it does not go there.
fn drawn(robot: &CockpitRobot, tow: &Tow, does: TowState) -> Vec<Item> {
    let Some(body) = robot.footprint.parts().first().map(|part| *part.pose()) else { return Vec::new() };
    let gripped = Pose2 { theta: robot.heading.unwrap_or(body.theta), ..body }.transform(Point2::new(tow.grip, 0.0));
    let dashed = |item: Item| item.stroked(Line::solid(1.5).dashed(Dash::Dashed));
    let radius = RINGS[usize::from(robot.trailer.is_some())];
    let line = Drawing::Polyline(vec![gripped, tow.aim]);
    let ring = Drawing::Disc { centre: tow.aim, radius };
    let mut items = vec![
        dashed(Item::new("tow/line", "the tow line", Role::Path, line)),
        dashed(Item::new("tow/ring", "where it is pulled to", Role::Path, ring)),
    ];
    let words = match does {
        TowState::OnlySteers => Some("abeam: the car can only steer"),
        TowState::Folded => Some("folded: pull it ahead first"),
        TowState::Goes | TowState::Rests => None,
    };
    items.extend(words.map(|words| {
        let at = Point2::new(tow.aim.x, tow.aim.y + radius);
        let (text, anchor, face) = (words.to_owned(), Anchor::Above, Face::Sans);
        Item::new("tow/why", words, Role::Text, Drawing::Label { at, text, anchor, face, size_px: 12.0, plate: true })
    }));
    items
}
