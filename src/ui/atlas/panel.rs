//! The editor's panel: what can be added, the numbers of what is selected, and the list of everything.

use bevy_egui::egui::{
    CollapsingHeader, ComboBox, DragValue, Grid, Key, PointerButton, Response, RichText, ScrollArea, TextEdit, Ui,
    WidgetInfo, WidgetType,
};

use crate::atlas::{Number, Op, Template};
use crate::picture::Role;
use crate::ui::keys::{Action, hint};
use crate::ui::paint::button::LabButton;
use crate::ui::paint::frame::row_height;
use crate::ui::paint::plate::refusal;
use crate::ui::{AtlasState, Look};

/// The most numbers of one thing that have fields; the others are dragged on the paper.
const MOST_FIELDS: usize = 120;

/// The most letters of a name that leaves room for another number beside its own.
const SHORT: usize = 7;

/// The least number of things for which there is something to look them up with.
const LONG: usize = 12;

/// Largest height of the list of everything, points.
const LIST: f32 = 240.0;

/// Shows the panel.
pub(super) fn edit_panel(ui: &mut Ui, look: &Look, atlas: &mut AtlasState) {
    ui.horizontal(|ui| {
        let [back, again] = atlas.can_undo();
        if LabButton::new("Undo").enabled(back).show(ui, look).on_hover_text(hint(Action::Undo)).clicked() {
            atlas.undo(true);
        }
        if LabButton::new("Redo").enabled(again).show(ui, look).on_hover_text(hint(Action::Redo)).clicked() {
            atlas.undo(false);
        }
        ui.label(if atlas.is_saved() { "saved" } else { "not saved in a file" });
    });
    for warning in atlas.warnings() {
        refusal(ui, warning, look);
    }
    ui.label("Click a thing, and drag it or its handles; Alt leaves out the snapping. A ring on an edge makes a corner; a corner dragged onto the next goes away.");
    add_buttons(ui, look, atlas);
    ui.add_space(8.0);
    match atlas.selected.clone() {
        Some(selected) => thing(ui, look, atlas, &selected),
        None => world(ui, atlas),
    }
    if let Some(words) = atlas.drops() {
        ui.label(RichText::new(words).color(look.colour(Role::Muted)));
    }
    ui.add_space(8.0);
    everything(ui, look, atlas);
}

/// Shows a button for each thing that can be added, and a list of the robots.
fn add_buttons(ui: &mut Ui, look: &Look, atlas: &mut AtlasState) {
    ui.horizontal_wrapped(|ui| {
        for template in Template::THINGS {
            let words = format!("Add {}", template.title());
            let response = LabButton::new(&words).selected(atlas.placing == Some(template)).show(ui, look);
            asked_for(&response, template, atlas);
        }
        let robots = ComboBox::from_id_salt("new robot").selected_text("Add robot");
        let robots = robots.show_ui(ui, |ui| {
            for template in Template::robots() {
                let response = ui.selectable_label(atlas.placing == Some(template), template.title());
                asked_for(&response, template, atlas);
            }
        });
        robots.response.widget_info(|| WidgetInfo::labeled(WidgetType::ComboBox, true, "add a robot"));
    });
}

/// Adds a thing where the paper is clicked next. Pressed by a key, the button has no pointer to follow: the thing goes
/// to the middle of the world.
fn asked_for(response: &Response, template: Template, atlas: &mut AtlasState) {
    if response.clicked_by(PointerButton::Primary) {
        atlas.placing = Some(template).filter(|_| atlas.placing != Some(template));
    } else if response.clicked() {
        atlas.add(template, atlas.middle());
    }
}

/// Shows a field for the name of what is selected, or of the world. Returns the name that it was given.
fn name_field(ui: &mut Ui, atlas: &mut AtlasState, words: &str, present: &str) -> Option<String> {
    let label = ui.label(words);
    let field = TextEdit::singleline(&mut atlas.name_text).desired_width(140.0);
    let response = ui.add(field).labelled_by(label.id);
    let done = response.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter)) && atlas.name_text != present;
    done.then(|| atlas.name_text.trim().to_owned())
}

/// Shows the name and the numbers of what is selected.
fn thing(ui: &mut Ui, look: &Look, atlas: &mut AtlasState, selected: &str) {
    let name = selected.to_owned();
    ui.horizontal(|ui| {
        if let Some(to) = name_field(ui, atlas, "name", selected) {
            atlas.change(&Op::Rename { name: name.clone(), to: to.clone() }, Some(to));
        }
        if LabButton::new("Delete").show(ui, look).on_hover_text(hint(Action::Delete)).clicked() {
            atlas.delete();
        }
    });
    if let Some(door) = atlas.world().door(selected) {
        let mut open = door.open;
        if ui.checkbox(&mut open, "open at the start").changed() {
            atlas.change(&Op::SetOpen { name: name.clone(), open }, Some(name.clone()));
        }
    }
    let numbers = atlas.seen().numbers(selected);
    // a field is its thing's own: what is typed into it is never another's
    ui.push_id(selected, |ui| {
        fields(ui, atlas, selected, &numbers, |number, to| Op::SetNumber { name: name.clone(), number, to });
    });
}

/// Shows the name of the world and the part of the plane that it shows.
fn world(ui: &mut Ui, atlas: &mut AtlasState) {
    let present = atlas.world().name.clone();
    ui.horizontal(|ui| {
        if let Some(to) = name_field(ui, atlas, "name of the world", &present) {
            atlas.change(&Op::RenameWorld(to), None);
        }
    });
    let bounds = atlas.seen().bounds();
    fields(ui, atlas, &present, &bounds, |number, to| Op::SetBounds { number, to });
}

/// Shows a field for each number. What is typed changes the world when it is done, what is dragged when it is let go.
fn fields(ui: &mut Ui, atlas: &mut AtlasState, of: &str, numbers: &[Number], op: impl Fn(usize, f64) -> Op) {
    // short ones stand in pairs: x beside y
    let is_short = numbers.iter().all(|number| number.name.len() <= SHORT);
    Grid::new("numbers").show(ui, |ui| {
        for (i, number) in numbers.iter().enumerate().take(MOST_FIELDS) {
            let label = ui.label(&number.name);
            let mut value = number.value;
            let field = DragValue::new(&mut value).speed(0.01).max_decimals(9).update_while_editing(false);
            let response = ui.add(field.suffix(format!(" {}", number.unit))).labelled_by(label.id);
            response.widget_info(|| WidgetInfo {
                label: Some(format!("{of}: {}", number.name)),
                ..WidgetInfo::new(WidgetType::DragValue)
            });
            if response.changed() && response.dragged() {
                // rounded to what a screen can show of it
                atlas.try_out(op(i, (value * 1e3).round() / 1e3));
            } else if response.changed() {
                atlas.change(&op(i, value), atlas.selected.clone());
            }
            if response.drag_stopped() {
                atlas.settle();
            }
            if !is_short || i % 2 == 1 {
                ui.end_row();
            }
        }
    });
    if numbers.len() > MOST_FIELDS {
        ui.label(format!("{} more: drag its corners.", numbers.len() - MOST_FIELDS));
    }
}

/// Shows the list of everything that the world holds. A click selects.
fn everything(ui: &mut Ui, look: &Look, atlas: &mut AtlasState) {
    let count = atlas.editor.things().len();
    CollapsingHeader::new("Everything here").default_open(!look.narrow).show(ui, |ui| {
        if count >= LONG {
            let field = TextEdit::singleline(&mut atlas.search).hint_text("Find a thing").desired_width(f32::INFINITY);
            ui.add(field).widget_info(|| WidgetInfo::labeled(WidgetType::TextEdit, true, "find a thing"));
        }
        let wanted = atlas.search.trim().to_lowercase();
        let things = atlas.editor.things();
        let is_wanted = |(kind, name): &(&str, &str)| kind.contains(&wanted) || name.to_lowercase().contains(&wanted);
        let found: Vec<(&str, &str)> = things.into_iter().filter(is_wanted).collect();
        let mut chosen = None;
        let row = row_height(ui);
        ui.spacing_mut().interact_size.y = row;
        ui.spacing_mut().item_spacing.y = 0.0;
        ui.spacing_mut().button_padding.y = 0.0;
        ScrollArea::vertical().id_salt("everything").max_height(LIST).show_rows(ui, row, found.len(), |ui, rows| {
            for (kind, name) in found.get(rows).unwrap_or_default() {
                let is_selected = atlas.selected.as_deref() == Some(*name);
                if ui.selectable_label(is_selected, format!("{name} \u{b7} {kind}")).clicked() {
                    chosen = Some((*name).to_owned());
                }
            }
        });
        if found.is_empty() {
            ui.label(if count == 0 { "Nothing yet." } else { "Nothing of that name." });
        }
        if let Some(name) = chosen {
            atlas.select(Some(&name));
        }
    });
}
