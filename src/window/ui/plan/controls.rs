//! The transport of a planner: begin anew, play and pause, one iteration, the pace.

use bevy_egui::egui::{ComboBox, Ui, WidgetInfo, WidgetType};

use super::paces::PACES;
use super::state::PlanState;
use crate::window::ui::FrameColours;
use crate::window::ui::keys::TimeAction;
use crate::window::ui::paint::button::LabButton;
use crate::window::ui::paint::icon::Icon;
use motion_lab_core::random::Seed;
use motion_lab_sim::manifest::HintTask;

/// Width of the button that plays, points.
const PLAY_WIDTH: f32 = 56.0;

/// Carries out an action that moves the planner.
pub fn act(action: TimeAction, plan: &mut PlanState) {
    match action {
        TimeAction::PlayPause if plan.playing => plan.playing = false,
        TimeAction::PlayPause => play(plan),
        TimeAction::Step => {
            plan.playing = false;
            plan.tasks_done.extend(plan.goes_on().then_some(HintTask::StepPlanner));
            plan.step();
        }
        TimeAction::Start | TimeAction::Reset => plan.restart(),
        TimeAction::ReRoll => plan.set_seed(Seed(plan.seed().0.wrapping_add(1))),
        TimeAction::Slower => plan.pace = plan.pace.saturating_sub(1),
        TimeAction::Faster => plan.pace = (plan.pace + 1).min(PACES.len() - 1),
        // a planner goes on only, and has no contacts
        TimeAction::StepBack
        | TimeAction::End
        | TimeAction::NextContact
        | TimeAction::Why
        | TimeAction::Loop
        | TimeAction::Continue => {}
    }
}

/// Lets the planner go on by itself; one that has ended, or has its path and improves it no more, begins anew.
fn play(plan: &mut PlanState) {
    if !plan.goes_on() {
        plan.restart();
    }
    plan.playing = plan.goes_on();
}

/// Width of the choice of pace, points.
const PACE: f32 = 112.0;

/// Shows the buttons and the choice of pace.
pub fn controls(ui: &mut Ui, look: &FrameColours, plan: &mut PlanState) {
    let play =
        if plan.playing { LabButton::new("Pause").icon(Icon::Pause) } else { LabButton::new("Play").icon(Icon::Play) };
    let buttons = [
        (LabButton::new("Begin anew").icon(Icon::ToStart), TimeAction::Start, "begin anew (Home)"),
        (play.width(PLAY_WIDTH), TimeAction::PlayPause, "grow, or pause (Space)"),
        (LabButton::new("Step").icon(Icon::Step).enabled(plan.goes_on()), TimeAction::Step, "one iteration (\u{2192})"),
        (LabButton::new("Next seed").icon(Icon::Die), TimeAction::ReRoll, "the next seed (G)"),
    ];
    for (button, action, words) in buttons {
        if button.show(ui, look).on_hover_text(words).clicked() {
            act(action, plan);
        }
    }
    ui.add_space(6.0);
    if ui.layout().main_wrap && ui.available_size_before_wrap().x < PACE {
        ui.end_row();
    }
    let selected = PACES[plan.pace.min(PACES.len() - 1)].1;
    let choice = ComboBox::from_id_salt("pace").width(PACE).selected_text(selected).show_ui(ui, |ui| {
        for (pace, (_, name)) in PACES.iter().enumerate() {
            if ui.selectable_label(plan.pace == pace, *name).clicked() {
                plan.pace = pace;
            }
        }
    });
    choice.response.widget_info(|| WidgetInfo {
        current_text_value: Some(selected.into()),
        ..WidgetInfo::labeled(WidgetType::ComboBox, true, "iterations a second")
    });
    choice.response.on_hover_text("Iterations a second (, and .)");
}
