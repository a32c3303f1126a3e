//! The list of a crowd's robots: searched by name, and a click picks.

use bevy_egui::egui::{
    Align, Button, Layout, RichText, ScrollArea, TextEdit, TextStyle, Ui, WidgetInfo, WidgetType, vec2,
};

use super::values::CrowdView;
use crate::window::ui::dashboard::hand::drive;
use crate::window::ui::dashboard::values::thousands;
use crate::window::ui::paint::frame::row_height;
use crate::window::ui::{Command, FrameColours, UiState};
use motion_lab_core::picture::Role;

/// Shows the search and the robots found, in `height` points. Only the rows that are seen are laid out.
pub fn list(
    ui: &mut Ui,
    crowd: &CrowdView,
    height: f32,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let top = ui.cursor().top();
    let field = TextEdit::singleline(&mut state.crowd.search).hint_text("Find a robot").desired_width(f32::INFINITY);
    let field = field.vertical_align(Align::Center).min_size(vec2(0.0, ui.spacing().interact_size.y));
    ui.add(field).widget_info(|| WidgetInfo::labeled(WidgetType::TextEdit, true, "find a robot"));
    ui.checkbox(&mut state.crowd.with_contacts, "with contacts only");
    let found = state.crowd.found(crowd);
    let (all, some) = (thousands(crowd.names.len() as u64), thousands(found.len() as u64));
    let words =
        if found.len() == crowd.names.len() { format!("{all} robots") } else { format!("{some} of {all} robots") };
    ui.label(RichText::new(words).small().color(look.colour(Role::Muted)));
    let row = row_height(ui);
    let left = height - (ui.cursor().top() - top);
    let width = ui.available_width();
    ui.spacing_mut().item_spacing.y = 0.0;
    ui.spacing_mut().button_padding.y = 0.0;
    ScrollArea::vertical()
        .id_salt(("robots", crowd.first))
        .max_height(left.clamp(2.0 * row, 4000.0))
        .auto_shrink(false)
        .show_rows(ui, row, found.len(), |ui, rows| {
            ui.set_width(width);
            for id in found.get(rows).unwrap_or_default() {
                entry(ui, crowd, *id, row, look, state, commands);
            }
        });
}

/// Shows a robot's row: its name, and at the right end how often it touched something.
fn entry(
    ui: &mut Ui,
    crowd: &CrowdView,
    id: u32,
    row: f32,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let (Some(name), Some(robot)) = (crowd.name(id), crowd.place(id).and_then(|place| crowd.now.get(place))) else {
        return;
    };
    let is_picked = state.crowd.picked_in(crowd).is_some_and(|p| p.id == id);
    ui.horizontal(|ui| {
        ui.spacing_mut().interact_size.y = row;
        let button = Button::selectable(is_picked, name).min_size(vec2(0.0, row));
        if ui.add(button).clicked() {
            drive::let_go(state, commands);
            state.crowd.pick(crowd, Some(id).filter(|_| !is_picked));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_space(12.0);
            if robot.contacts > 0 {
                let role = if robot.flash { Role::Goal } else { Role::Muted };
                let text = RichText::new(thousands(robot.contacts.into())).text_style(TextStyle::Monospace);
                ui.label(text.color(look.colour(role))).on_hover_text("contacts so far");
            }
        });
    });
}
