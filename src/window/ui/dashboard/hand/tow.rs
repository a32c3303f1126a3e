//! Towing a robot on wheels by its body: the pointer pulls, and the robot drives by its own commands.

use bevy_egui::egui::Ui;

use super::drive;
use crate::window::ui::{CockpitRobot, Command, Grasp, UiState};
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::geometry::{Point2, Pose2, Vector2};
use motion_lab_core::num::greater;
use motion_lab_core::picture::{Anchor, Dash, Drawing, Face, Item, Line, Role};
use motion_lab_core::robots::{AnyRobot, TICK};
use motion_lab_sim::tow::{Tow, TowState, grip_at};

/// Radius of the ring at the pointer, metres: of a rover and of a car.
const RINGS: [f64; 2] = [0.08, 0.3];

/// A robot that the pointer tows.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldTow {
    /// The robot's name.
    pub robot: String,
    /// The channels that the robot is to hold, from -128 to 128, the maximum.
    pub channels: (i16, i16),
    /// Whether the robot has been driven since the drag began: what can be undone of it is noted.
    pub has_driven: bool,
    /// Where on its axis the robot is gripped, metres ahead of its reference point.
    grip: f64,
    /// From where the body was pressed to its axis, metres: as far from the pointer is the place that it comes to.
    off: Vector2,
    /// Whether the pointer held it in the last frame.
    is_held: bool,
    /// The tick of the last frame, and how many passed before it.
    tick: Option<u64>,
    passed: u64,
}

impl HeldTow {
    /// The tow in the next frame, at `tick`; `None` where the pointer has let go, or the run has gone back.
    pub fn go_on(self, tick: u64) -> Option<HeldTow> {
        let has_gone_back = self.tick.is_some_and(|before| tick < before);
        let passed = self.tick.map_or(0, |before| tick.saturating_sub(before));
        let next = HeldTow { is_held: false, tick: Some(tick), passed, ..self };
        (self.is_held && !has_gone_back).then_some(next)
    }

    /// How long a command is held, seconds. It takes effect a frame after the robot was seen.
    fn held(&self) -> f64 {
        TICK * greater(2.0 * self.passed as f64 - 1.0, 1.0)
    }
}

/// Whether a robot can be towed: one of the lab's on wheels, driven by channels.
pub fn is_towable(robot: &CockpitRobot) -> bool {
    robot.drivable && as_model(robot).is_some_and(|(model, q)| grip_at(&model, &q, Point2::origin()).is_some())
}

fn as_model(robot: &CockpitRobot) -> Option<(AnyRobot, AnyConfiguration)> {
    Some((robot.model?, AnyRobot::of_kind(&robot.kind, &robot.coordinates)?.1))
}

/// Grips a robot whose body was pressed here, in the robot's frame at the coordinates `from`. It is then in hand.
pub fn grip(robot: &CockpitRobot, from: &[f64], pressed: Point2, state: &mut UiState, commands: &mut Vec<Command>) {
    let gripped = robot.model.zip(AnyRobot::of_kind(&robot.kind, from)).and_then(|(model, (_, q))| {
        let grip = grip_at(&model, &q, pressed)?;
        Some((grip, Tow::new(grip, pressed).gripped(&model, &q)? - pressed))
    });
    let Some((grip, off)) = gripped else { return };
    if state.armed.as_ref() != Some(&robot.name) {
        drive::let_go(state, commands);
        state.next_grasp = Some(Grasp::Leave);
        state.armed = Some(robot.name.clone());
    }
    let (robot, channels) = (robot.name.clone(), (0, 0));
    state.tow = Some(HeldTow { robot, channels, has_driven: false, grip, off, is_held: true, tick: None, passed: 0 });
}

/// Pulls a robot that is gripped toward the pointer: its channels are left in the state, where `drive` takes them.
/// Returns what there is to draw.
pub fn pull(ui: &Ui, robot: &CockpitRobot, pointer: Point2, state: &mut UiState) -> Vec<Item> {
    let tow = state.tow.as_mut().filter(|tow| tow.robot == robot.name);
    let (Some(tow), Some((model, q))) = (tow, as_model(robot)) else { return Vec::new() };
    let line = Tow { grip: tow.grip, aim: pointer + tow.off, held: tow.held() };
    let Some(command) = line.command(&model, &q) else { return Vec::new() };
    let [ahead, left] = command.channels;
    tow.is_held = true;
    tow.channels = (ahead, left);
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
