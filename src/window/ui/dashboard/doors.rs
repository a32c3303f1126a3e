//! The doors of a pane's world: found under the pointer, and opened and closed.

use bevy_egui::egui::{Button, RichText, TextStyle, TextWrapMode, Ui, WidgetInfo, WidgetType, vec2};

use crate::window::ui::paint::touch::touched;
use crate::window::ui::{Cockpit, Command};
use motion_lab_core::geometry::{Point2, Segment};
use motion_lab_core::picture::{Anchor, Drawing, Face, Fit, Item, Line, Role, ScreenPoint};
use motion_lab_core::worlds::Door;
use motion_lab_sim::run::WorldChange;
use motion_lab_sim::simulation::{TransportCommand, WorldCommand};

/// Distance within which the pointer is at a door, points: with a mouse, and for a finger.
const REACH: f64 = 7.0;
const TOUCH: f64 = 18.0;

/// About the widths of the word before the doors' letters and of a letter's button, points.
const WORD: f32 = 44.0;
const LETTER: f32 = 22.0;

/// Width of a door's button under a finger, points.
const FINGER: f32 = 36.0;

/// The distance within which the pointer is at a door, points: for a finger farther.
pub fn reach(is_touched: bool) -> f64 {
    if is_touched { TOUCH } else { REACH }
}

/// The door nearest to a point of the screen, within `reach` points of its gap.
pub fn door_at<'a>(cockpit: &'a Cockpit, fit: &Fit, at: ScreenPoint, reach: f64) -> Option<&'a Door> {
    let on_screen = |p| {
        let [x, y] = fit.screen_from_world(p);
        Point2::new(x, y)
    };
    let away = |door: &Door| {
        let at = Point2::new(at[0], at[1]);
        (Segment::new(on_screen(door.a), on_screen(door.b)).closest_point(at) - at).norm()
    };
    let doors = cockpit.atlas.world().doors.iter().map(|door| (away(door), door));
    doors.filter(|(away, _)| *away <= reach).min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, door)| door)
}

/// What a door is called in short: its letter, or its whole name.
fn letter(door: &Door) -> &str {
    door.name.strip_prefix("door ").unwrap_or(&door.name)
}

/// The letters of the doors, each in the middle of its gap: as the buttons under the paper have them.
pub fn letters(cockpit: &Cockpit) -> Vec<Item> {
    let item = |door: &Door| {
        let label = Drawing::Label {
            at: door.a + 0.5 * (door.b - door.a),
            text: letter(door).to_owned(),
            anchor: Anchor::Centre,
            face: Face::Sans,
            size_px: 11.0,
            plate: true,
        };
        Item::new(format!("letter/{}", door.name), door.name.as_str(), Role::Text, label)
    };
    cockpit.atlas.world().doors.iter().map(item).collect()
}

/// Marks the doors that open or close with the next tick, across their gaps.
pub fn pending_doors(cockpit: &Cockpit) -> Vec<Item> {
    let doors = cockpit.atlas.world().doors.iter().filter(|door| to_come(cockpit, door).is_some());
    let mark = |door: &Door| {
        let gap = Drawing::segment(door.a, door.b);
        Item::new(format!("pending/{}", door.name), door.name.as_str(), Role::Focus, gap).stroked(Line::solid(3.0))
    };
    doors.map(mark).collect()
}

/// Whether a door is open after the next tick, if that is what it is asked for in a pause.
fn to_come(cockpit: &Cockpit, door: &Door) -> Option<bool> {
    cockpit.doors.iter().find(|(name, _)| *name == door.name).map(|(_, is_open)| *is_open)
}

/// What can be done with a door: `close door A`.
pub fn words(door: &Door) -> String {
    format!("{} {}", if door.open { "close" } else { "open" }, door.name)
}

/// Asks for doors to be opened or closed, as one step to undo.
pub fn toggle<'a>(world: &str, doors: impl IntoIterator<Item = &'a Door>, commands: &mut Vec<Command>) {
    commands.push(Command::from(TransportCommand::Checkpoint));
    for door in doors {
        let change = if door.open { WorldChange::Close } else { WorldChange::Open }(door.name.clone());
        commands.push(Command::Run(WorldCommand { world: world.to_owned(), change }.into()));
    }
}

/// Shows a row with a button for each door.
pub fn row(ui: &mut Ui, cockpit: &Cockpit, commands: &mut Vec<Command>) {
    if cockpit.atlas.world().doors.is_empty() {
        return;
    }
    ui.spacing_mut().interact_size.y = ui.text_style_height(&TextStyle::Body);
    ui.horizontal_wrapped(|ui| {
        ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
        buttons(ui, cockpit, commands);
    });
}

/// Shows a button for each door, framed where it is closed, in the row that is being laid out; of one that is to
/// change, what comes.
pub fn buttons(ui: &mut Ui, cockpit: &Cockpit, commands: &mut Vec<Command>) {
    let world = cockpit.atlas.world();
    let width = if touched(ui) { FINGER } else { 0.0 };
    if !world.doors.is_empty() {
        // few of them stay in one row
        let room = WORD + world.doors.len() as f32 * (width.max(LETTER) + ui.spacing().item_spacing.x);
        if room <= ui.max_rect().width() && ui.available_size_before_wrap().x < room {
            ui.end_row();
        }
        ui.label("doors");
    }
    // in a row of words they stand on its line
    ui.spacing_mut().button_padding = vec2(6.0, 0.0);
    for door in &world.doors {
        match to_come(cockpit, door) {
            Some(true) => _ = ui.weak(format!("{} opens", door.name)),
            Some(false) => _ = ui.weak(format!("{} closes", door.name)),
            None => {
                let colour = if door.open { ui.visuals().hyperlink_color } else { ui.visuals().strong_text_color() };
                let text = RichText::new(letter(door)).color(colour);
                let button = Button::selectable(!door.open, text).min_size(vec2(width, 0.0));
                let button = ui.add(button).on_hover_text(words(door));
                button.widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, words(door)));
                if button.clicked() {
                    toggle(&world.name, [door], commands);
                }
            }
        }
    }
}
