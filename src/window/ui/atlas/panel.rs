//! The editor's panel: what can be added, the numbers of what is selected, and the list of everything.

use std::cell::RefCell;

use bevy_egui::egui::{
    ComboBox, DragValue, Grid, Key, PointerButton, Response, RichText, ScrollArea, TextEdit, TextStyle, Ui, WidgetInfo,
    WidgetType,
};

use super::field::{NumberField, TypedText};
use crate::window::ui::keys::{AtlasAction, SessionAction, hint};
use crate::window::ui::paint::button::LabButton;
use crate::window::ui::paint::fold::fold;
use crate::window::ui::paint::frame::row_height;
use crate::window::ui::paint::plate::refusal;
use crate::window::ui::paint::sheet::steady;
use crate::window::ui::paint::touch::worded;
use crate::window::ui::{AtlasState, FrameColours};
use motion_lab_core::picture::Role;
use motion_lab_sim::atlas::{Number, Op, Template};

/// The most numbers of one thing that have fields; the others are dragged on the paper.
const MAX_FIELDS: usize = 120;

/// The most letters of a name that leaves room for another number beside its own.
const SHORT: usize = 7;

/// The least number of things for which there is something to look them up with.
const LONG: usize = 12;

/// Largest height of the list of everything, points.
const LIST: f32 = 240.0;

pub(super) fn edit_panel(ui: &mut Ui, look: &FrameColours, atlas: &mut AtlasState) {
    ui.horizontal(|ui| {
        let [back, again] = atlas.can_undo();
        if LabButton::new("Undo").enabled(back).show(ui, look).on_hover_text(hint(SessionAction::Undo)).clicked() {
            atlas.undo(true);
        }
        if LabButton::new("Redo").enabled(again).show(ui, look).on_hover_text(hint(SessionAction::Redo)).clicked() {
            atlas.undo(false);
        }
        // a world as it came is in no file of the reader's, and needs none
        if atlas.is_saved() {
            ui.label("saved");
        } else if back {
            ui.label("not saved in a file");
        }
    });
    ui.label(worded(ui, "Drag a thing or its handles; Alt leaves out the snapping."));
    add_buttons(ui, look, atlas);
    // room for a warning of two lines: buttons and fields stay where they are
    let two = 2.0 * ui.text_style_height(&TextStyle::Body);
    let of = format!("warnings of {}", atlas.world().name);
    steady(ui, &of, two, |ui| {
        for warning in atlas.warnings() {
            refusal(ui, warning, look);
        }
    });
    if atlas.selected.is_some() {
        thing(ui, look, atlas);
    } else {
        world(ui, atlas);
    }
    if let Some(words) = atlas.drops() {
        ui.label(RichText::new(words).color(look.colour(Role::Muted)));
    }
    ui.add_space(8.0);
    everything(ui, look, atlas);
}

/// Shows a button for each thing that can be added, and a list of the robots.
fn add_buttons(ui: &mut Ui, look: &FrameColours, atlas: &mut AtlasState) {
    ui.horizontal_wrapped(|ui| {
        ui.label("Add");
        for template in Template::THINGS {
            let (title, words) = (template.title(), format!("Add {}", template.title()));
            let button = LabButton::new(&title).spoken(&words).selected(atlas.placing == Some(template));
            let response = button.show(ui, look);
            asked_for(&response, template, atlas);
        }
        let robots = ComboBox::from_id_salt("new robot").selected_text("robot");
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

/// Whether a field was left by Escape in this frame.
fn was_escaped(response: &Response) -> bool {
    response.lost_focus() && response.ctx.input(|i| i.key_pressed(Key::Escape))
}

/// Shows a field for the name of what is selected, or of the world.
fn name_field(ui: &mut Ui, atlas: &mut AtlasState, words: &str) {
    let label = ui.label(words);
    let field = TextEdit::singleline(&mut atlas.name_text).desired_width(140.0);
    let response = ui.add(field).labelled_by(label.id);
    atlas.is_naming |= response.changed();
    if was_escaped(&response) {
        atlas.forget_name();
    } else if atlas.is_naming && !response.has_focus() {
        atlas.enter();
    }
}

/// Shows the name and the numbers of what is selected.
fn thing(ui: &mut Ui, look: &FrameColours, atlas: &mut AtlasState) {
    ui.horizontal(|ui| {
        name_field(ui, atlas, "name");
        if LabButton::new("Delete").show(ui, look).on_hover_text(hint(AtlasAction::Delete)).clicked() {
            atlas.delete();
        }
    });
    // it may have another name by now, or be gone
    let Some(name) = atlas.selected.clone() else { return };
    if let Some(door) = atlas.world().door(&name) {
        let mut open = door.open;
        if ui.checkbox(&mut open, "open at the start").changed() {
            atlas.change(&Op::SetOpen { name: name.clone(), open }, Some(name.clone()));
        }
    }
    // a field is its thing's own: what is typed into it is never another's
    ui.push_id(&name, |ui| fields(ui, atlas, &name));
}

/// Shows the name of the world and the part of the plane that it shows.
fn world(ui: &mut Ui, atlas: &mut AtlasState) {
    ui.horizontal(|ui| name_field(ui, atlas, "name of the world"));
    let name = atlas.world().name.clone();
    fields(ui, atlas, &name);
}

/// Shows a field for each number of what is selected, or of the world.
fn fields(ui: &mut Ui, atlas: &mut AtlasState, of: &str) {
    let numbers = atlas.numbers();
    let thing = atlas.selected.clone();
    // short ones stand in pairs: x beside y
    let is_short = numbers.iter().all(|number| number.name.len() <= SHORT);
    let mut is_held = false;
    let mut is_typed = false;
    Grid::new("numbers").show(ui, |ui| {
        for (i, number) in numbers.iter().enumerate().take(MAX_FIELDS) {
            let own = NumberField { thing: thing.clone(), number: i };
            field(ui, atlas, of, number, &own);
            is_typed |= atlas.typed.as_ref().is_some_and(|typed| typed.field == own);
            is_held |= atlas.held.as_ref() == Some(&own);
            if !is_short || i % 2 == 1 {
                ui.end_row();
            }
        }
    });
    if numbers.iter().any(|number| number.name == "x 2") {
        ui.label(worded(ui, "A ring on an edge makes a corner; a corner dragged onto the next goes away."));
    }
    if numbers.len() > MAX_FIELDS {
        ui.label(format!("{} more: drag its corners.", numbers.len() - MAX_FIELDS));
    }
    // a field may have gone, and what was done in it goes on no longer
    if !is_typed {
        atlas.enter_number();
    }
    if !is_held && atlas.held.is_some() {
        atlas.drop_drag();
    }
}

/// Shows a number as a field to type into or to drag. `of` names the thing for screen readers. Typed text changes the
/// world when the field loses the focus; Escape discards it. A drag is shown as it goes, and changes the world when the
/// pointer is released.
fn field(ui: &mut Ui, atlas: &mut AtlasState, of: &str, number: &Number, own: &NumberField) {
    let label = ui.label(&number.name);
    let (mut value, format) = (number.value, ui.style().number_formatter.clone());
    let (shown, text) = (RefCell::new(String::new()), RefCell::new(None));
    let show = |value, decimals| {
        let words = format.format(value, decimals);
        shown.replace(words.clone());
        words
    };
    // egui would enter a text that was left untouched, and one after Escape: the text is kept here instead
    let keep = |typed: &str| {
        text.replace(Some(typed.to_owned()));
        None
    };
    let drag = DragValue::new(&mut value).speed(0.01).max_decimals(9).custom_formatter(show).custom_parser(keep);
    let response = ui.add(drag.suffix(format!(" {}", number.unit))).labelled_by(label.id);
    response.widget_info(|| WidgetInfo {
        label: Some(format!("{of}: {}", number.name)),
        ..WidgetInfo::new(WidgetType::DragValue)
    });
    let (shown, text) = (shown.into_inner(), text.into_inner());
    if atlas.typed.as_ref().is_some_and(|typed| typed.field == *own && typed.was != number.value) {
        atlas.typed = None;
    }
    if let Some(text) = text.filter(|_| response.changed()) {
        let typed = TypedText { field: own.clone(), text, was: number.value };
        // a text that was brought back to what is shown changes nothing
        atlas.typed = Some(typed).filter(|typed| typed.text != shown);
    }
    if response.drag_started() {
        atlas.hold(own.clone());
    }
    let is_held = atlas.held.as_ref() == Some(own);
    if response.dragged() {
        if is_held && value != number.value {
            // rounded to what a screen can show of it
            atlas.try_out(atlas.setting(own, (value * 1e3).round() / 1e3));
        }
    } else if value != number.value {
        atlas.typed = None;
        atlas.change(&atlas.setting(own, value), atlas.selected.clone());
    }
    if response.drag_stopped() && is_held {
        atlas.settle();
    }
    if atlas.typed.as_ref().is_some_and(|typed| typed.field == *own) && !response.has_focus() {
        if ui.input(|i| i.key_pressed(Key::Escape)) {
            atlas.typed = None;
        } else {
            atlas.enter_number();
        }
    }
}

/// Shows the list of everything that the world holds. A click selects.
fn everything(ui: &mut Ui, look: &FrameColours, atlas: &mut AtlasState) {
    let count = atlas.editor.things().len();
    fold(ui, "Everything here", !look.narrow, |ui| {
        // what is looked for stays in sight while it leaves things out
        if count >= LONG || !atlas.search.is_empty() {
            let field = TextEdit::singleline(&mut atlas.search).hint_text("Find a thing").desired_width(f32::INFINITY);
            let response = ui.add(field);
            response.widget_info(|| WidgetInfo::labeled(WidgetType::TextEdit, true, "find a thing"));
            if was_escaped(&response) {
                atlas.search.clear();
            }
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
            atlas.pick(Some(&name));
        }
    });
}
