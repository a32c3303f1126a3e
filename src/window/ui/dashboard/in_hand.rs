//! The robot of a pane that is in hand: how it is taken, driven, dragged and let go.

use bevy_egui::egui::{Id, Pos2, Rect, TextStyle, Ui, Vec2, pos2, vec2};

use super::hand::{drive, pad};
use crate::window::ui::paint::style::ScreenTheme;
use crate::window::ui::paint::touch::touched;
use crate::window::ui::{Cockpit, CockpitRobot, Command, FrameColours, Grasp, Notice, UiState};
use motion_lab_core::collision::{Collision, Scene, footprint_distance};
use motion_lab_core::geometry::{Footprint, Part, Pose2, Shape};
use motion_lab_core::picture::{Fit, Role};

/// The robot of a pane that can be taken in hand: the first that is driven by channels, else the first arm.
pub fn in_reach(cockpit: &Cockpit) -> Option<&CockpitRobot> {
    let robots = || cockpit.robots.iter();
    robots().find(|r| r.drivable).or_else(|| robots().find(|r| r.is_arm))
}

/// The robot of a pane that is in hand, or was last; else the one that can be taken.
pub fn chosen<'a>(cockpit: &'a Cockpit, state: &UiState) -> Option<&'a CockpitRobot> {
    let named = |name: &Option<String>| cockpit.robots.iter().find(|robot| name.as_ref() == Some(&robot.name));
    [&state.hand.armed, &state.focus.nudged, &state.hand.last_held]
        .into_iter()
        .find_map(named)
        .or_else(|| in_reach(cockpit))
}

/// Takes a robot of a pane in hand, of an arm its first handle; lets go of it if it was in hand already. Says so where
/// there is none.
pub fn take_in_hand(cockpit: &Cockpit, robot: Option<&CockpitRobot>, state: &mut UiState, commands: &mut Vec<Command>) {
    let again = robot.is_some_and(|r| [&state.hand.armed, &state.focus.nudged].contains(&&Some(r.name.clone())));
    drive::let_go(state, commands);
    state.focus.next_grasp = Some(Grasp::Leave);
    match robot {
        Some(_) if again => {}
        Some(robot) if robot.is_arm || robot.drivable => {
            state.hand.last_held = Some(robot.name.clone());
            if robot.is_arm {
                state.focus.next_grasp = Some(Grasp::Take(robot.name.clone()));
            } else {
                state.hand.armed = Some(robot.name.clone());
            }
        }
        _ => {
            let text = format!("no robot of {} can be driven", cockpit.world.name);
            state.say(Notice { text, is_error: false });
        }
    }
}

/// What of an arm is dragged: `drag its elbow or tip`.
pub fn joints_to_drag(arm: &CockpitRobot) -> &'static str {
    if arm.coordinates.len() == 2 { "drag its elbow or tip" } else { "drag its joints or tip" }
}

/// What of a paper is free for words.
pub struct Free<'a> {
    /// Width that something else takes at the right, points.
    pub taken: f32,
    /// The cockpit and how its world lies on the paper, if words are to keep off its obstacles.
    pub of: Option<(&'a Cockpit, &'a Fit)>,
}

/// Shows on the paper of the robot in hand how to drive it, and for a finger the pad.
pub fn in_hand(ui: &mut Ui, robot: &CockpitRobot, paper: Rect, free: Free, look: &FrameColours, state: &mut UiState) {
    let Free { taken, of } = free;
    let sideways = robot.trailer.is_some() && state.hand.held.0 == 0 && state.hand.held.1 != 0;
    let touched = touched(ui);
    let words = if robot.is_arm {
        let finely = if touched { "" } else { "; arrows turn the joint, with Shift finely, Esc lets go" };
        format!("{}{finely}", joints_to_drag(robot))
    } else if state.hand.tow.as_ref().is_some_and(|tow| tow.robot == robot.name) {
        "towed by its own commands; let go, and it stands".to_owned()
    } else if sideways {
        "steering alone moves nothing: driven, no car slides sideways".to_owned()
    } else if touched {
        "the pad drives, a tap beside it lets go".to_owned()
    } else {
        "arrows drive, Esc lets go".to_owned()
    };
    let font = TextStyle::Body.resolve(ui.style());
    let galley = ui.painter().layout(words, font, look.colour(Role::Text), paper.width() - 24.0 - taken);
    let size = galley.size() + vec2(8.0, 4.0);
    // it stays as long as it is free
    let id = Id::new((&robot.name, "hint"));
    let before = ui.data(|data| data.get_temp(id));
    let rect = of.and_then(|(cockpit, fit)| {
        free_place(&state.linked.scene_of(&cockpit.atlas), &cockpit.robots, fit, (paper, before), size)
    });
    rect.map(|rect| ui.data_mut(|data| data.insert_temp(id, rect.min)));
    let rect = rect.unwrap_or(Rect::from_min_size(paper.min + vec2(4.0, 6.0), size));
    // opaque and square: rounded corners of a tint leave dots
    ui.painter().rect_filled(rect, 0.0, look.theme.colour(Role::Paper));
    ui.painter().galley(rect.min + vec2(4.0, 2.0), galley, look.colour(Role::Text));
    if touched && robot.drivable {
        let place = state.hand.pad_place.take().unwrap_or(pad::corner(paper));
        pad::pad(ui, &robot.name, place, look, state);
    }
}

/// The place of this size that begins at `before`, else the first along the upper edge of a paper, then along its lower
/// edge, where no obstacle and no robot is, nor the name of what one touches.
fn free_place(
    scene: &Scene,
    robots: &[CockpitRobot],
    fit: &Fit,
    (paper, before): (Rect, Option<Pos2>),
    size: Vec2,
) -> Option<Rect> {
    const STEP: f32 = 12.0;
    const NAME: f64 = 40.0;
    let away = NAME / fit.px_per_metre();
    let room = paper.shrink(STEP);
    let world = |at: Pos2| fit.world_from_screen([f64::from(at.x), f64::from(at.y)]);
    let columns = ((room.width() - size.x) / STEP).max(0.0) as u16;
    let rows = [room.top(), room.bottom() - size.y];
    let places = rows.into_iter().flat_map(|y| (0..=columns).map(move |k| pos2(room.left() + STEP * f32::from(k), y)));
    let before = before.filter(|at| room.contains_rect(Rect::from_min_size(*at, size)));
    before.into_iter().chain(places).map(|at| Rect::from_min_size(at, size)).find(|place| {
        let shape = Shape::Rectangle { min: world(place.left_bottom()), max: world(place.right_top()) };
        let place = Footprint::new([Part::new(Pose2::IDENTITY, shape)]);
        let is_off = |robot: &CockpitRobot| footprint_distance(&place, &robot.footprint) > away;
        robots.iter().all(is_off) && !scene.intersects(&place)
    })
}
