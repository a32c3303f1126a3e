//! The words of a pane: name, space, readout and counts of its robots, and links for what can be done with them.

use bevy_egui::egui::{
    Align, Id, Label, Layout, Link, Rect, RichText, ScrollArea, Sense, TextStyle, TextWrapMode, Ui, UiBuilder,
};

use super::goal::{sideways, trailer_of};
use super::hand::handles;
use super::{doors, twins};
use crate::window::ui::paint::frame;
use crate::window::ui::paint::scale_bar::scale_bar;
use crate::window::ui::{
    Cockpit, CockpitRobot, Command, FrameColours, Notice, ParkingExercise, SessionCommand, UiState,
};
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::picture::{Fit, Role, readout, readout_lines};
use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::manifest::{Formula, Widget};
use motion_lab_sim::run::{Quantized, RobotInput};
use motion_lab_sim::simulation::{RobotCommand, TransportCommand};

/// Height of a robot's words before they have been laid out, points.
const USUAL: f32 = 80.0;

/// Width of a row that has room for a name, who drives, and the scale, points.
const BOTH: f32 = 390.0;

/// Shows in `rect` what there is to say of a cockpit, whose world lies on the screen as `fit` says.
pub fn words_in(
    ui: &mut Ui,
    rect: Rect,
    cockpit: &Cockpit,
    fit: &Fit,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let mut ui = rows(ui, rect);
    heading(&mut ui, cockpit, fit, look);
    scrolled(&mut ui, cockpit, |ui| words(ui, cockpit, look, state, commands));
}

/// As [`words_in`], in two rooms: what can be done with the one robot, its formulas and the scale in `foot`, under the
/// world; the rest in `rect`.
pub fn words_apart(
    ui: &mut Ui,
    [rect, foot]: [Rect; 2],
    cockpit: &Cockpit,
    fit: &Fit,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    scrolled(&mut rows(ui, rect), cockpit, |ui| {
        for robot in &cockpit.robots {
            twins::offer(ui, cockpit, robot, look, state);
            values(ui, robot, look, state, commands);
        }
    });
    let mut ui = rows(ui, foot);
    heading(&mut ui, cockpit, fit, look);
    for robot in &cockpit.robots {
        links(&mut ui, robot, Some(cockpit), look, state, commands);
        ui.horizontal_wrapped(|ui| formulas(ui, robot, look, state));
    }
}

/// The height that the words of a cockpit take in a room of this width, as far as it is known. It never shrinks, so
/// that nothing moves to and fro as words come and go.
pub fn height_of(ui: &Ui, cockpit: &Cockpit, width: f32) -> f32 {
    let known: Option<(u32, f32)> = ui.data(|data| data.get_temp(room_of(cockpit)));
    known.filter(|(of, _)| *of == width as u32).map_or(USUAL, |(_, height)| height)
}

/// The key by which the height of a cockpit's words is kept. A car with a trailer has other words than one without.
fn room_of(cockpit: &Cockpit) -> Id {
    let coordinates: usize = cockpit.robots.iter().map(|robot| robot.coordinates.len()).sum();
    Id::new(("room of words", &cockpit.world.name, coordinates))
}

/// A column of words, whose rows are not as high as buttons.
fn rows(ui: &mut Ui, rect: Rect) -> Ui {
    let mut ui = ui.new_child(UiBuilder::new().max_rect(rect).layout(Layout::top_down(Align::Min)));
    ui.spacing_mut().interact_size.y = 0.0;
    ui
}

/// Shows words that scroll where they need more room than there is, so that none is lost, and notes their height.
fn scrolled(ui: &mut Ui, cockpit: &Cockpit, add: impl FnOnce(&mut Ui)) {
    let (top, width) = (ui.max_rect().top(), ui.max_rect().width());
    let before = height_of(ui, cockpit, width);
    let words_of = Id::new(("words", &cockpit.world.name));
    let above = ui.cursor().top() - top;
    let shown = ScrollArea::vertical().id_salt(words_of).auto_shrink(false).show(ui, add);
    let height = above + shown.content_size.y;
    if height > before + 0.5 {
        ui.data_mut(|data| data.insert_temp(room_of(cockpit), (width as u32, height)));
        ui.ctx().request_repaint();
    }
}

/// Shows who is seen, and at the right end the scale.
fn heading(ui: &mut Ui, cockpit: &Cockpit, fit: &Fit, look: &FrameColours) {
    let name = match &cockpit.robots[..] {
        [robot] => by_whom(robot, cockpit.heading()),
        _ => cockpit.heading(),
    };
    let name = RichText::new(name).color(look.colour(Role::Text));
    if ui.available_width() < BOTH {
        ui.label(name);
        ui.horizontal(|ui| scale_bar(ui, fit.px_per_metre(), look));
        return;
    }
    ui.horizontal(|ui| {
        ui.label(name);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| scale_bar(ui, fit.px_per_metre(), look));
    });
}

/// A heading with what drives the robot, if it is not on its tour.
pub fn by_whom(robot: &CockpitRobot, heading: String) -> String {
    match (robot.manual, robot.along_path) {
        (false, _) => heading,
        (true, false) => format!("{heading} \u{b7} driven by hand"),
        (true, true) => format!("{heading} \u{b7} on its path"),
    }
}

fn formulas(ui: &mut Ui, robot: &CockpitRobot, look: &FrameColours, state: &mut UiState) {
    if let Some(about) = robot.about {
        frame::formulas(ui, &format!("{}.{}", about.name, robot.coordinates.len()), look, state);
    }
}

fn words(ui: &mut Ui, cockpit: &Cockpit, look: &FrameColours, state: &mut UiState, commands: &mut Vec<Command>) {
    if cockpit.robots.is_empty() && cockpit.crowd.is_none() {
        ui.label("No robot lives here. Edit in the Atlas adds one.");
    }
    if let [robot] = &cockpit.robots[..] {
        twins::offer(ui, cockpit, robot, look, state);
        // where the words scroll, what can be done comes first
        if look.narrow {
            links(ui, robot, Some(cockpit), look, state, commands);
            values(ui, robot, look, state, commands);
        } else {
            values(ui, robot, look, state, commands);
            links(ui, robot, Some(cockpit), look, state, commands);
        }
        formulas(ui, robot, look, state);
    } else {
        // where robots share the room, what can be done with each of them comes first
        for robot in &cockpit.robots {
            ui.label(RichText::new(by_whom(robot, robot.name.clone())).strong());
            robot_words(ui, robot, look, state, commands);
            ui.add_space(6.0);
        }
        doors::row(ui, cockpit, commands);
    }
    if look.narrow {
        let words = Widget::Dashboard.text();
        ui.add_space(10.0);
        frame::name(ui, words, look);
        frame::misconception(ui, words, look);
        frame::key_row(ui, words, look, state);
    }
}

/// Shows a robot's space, its configuration, what was counted of it, and links for what can be done with it.
pub fn robot_words(
    ui: &mut Ui,
    robot: &CockpitRobot,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    values(ui, robot, look, state, commands);
    links(ui, robot, None, look, state, commands);
}

/// Shows a robot's space, its configuration, and what was counted of it.
fn values(ui: &mut Ui, robot: &CockpitRobot, look: &FrameColours, state: &mut UiState, commands: &mut Vec<Command>) {
    // the exercise under way comes first
    if let Some((_, goal)) = state.goal.as_ref().filter(|(name, _)| *name == robot.name) {
        ui.add(Label::new(RichText::new(goal.words(&robot.footprint, robot.reversals)).strong()).wrap());
        if let Some(AnyRobot::Hitch(car)) = robot.model {
            let far = sideways(car.tightest(), 0.5);
            let words = format!(
                "Ahead in two arcs of 0.5 rad, left and right, and straight back takes the car {far:.2} m aside."
            );
            ui.add(Label::new(RichText::new(words).color(look.colour(Role::Muted))).wrap());
        }
    }
    if let Some(space) = robot.about.and_then(|about| about.space(robot.coordinates.len())) {
        frame::formula(ui, &Formula::of(space), space.words, look, state);
    }
    readouts(ui, robot, look);
    counts(ui, robot, look);
    if robot.is_arm {
        handles::numbers(ui, robot, look, state, commands);
    }
}

/// Shows the configuration as its type prints it. A click copies every digit.
fn readouts(ui: &mut Ui, robot: &CockpitRobot, look: &FrameColours) {
    let figure = TextStyle::Monospace.resolve(ui.style());
    let width = ui.ctx().fonts_mut(|f| f.glyph_width(&figure, '0'));
    for line in readout_lines(&readout(&robot.readout), (ui.available_width() / width) as usize) {
        let text = RichText::new(line).monospace().color(look.colour(Role::Text));
        let response = ui.add(Label::new(text).sense(Sense::click()));
        if response.clicked() {
            ui.ctx().copy_text(robot.in_full.clone());
        }
        response.on_hover_text("Click to copy every digit");
    }
}

fn counts(ui: &mut Ui, robot: &CockpitRobot, look: &FrameColours) {
    let muted = |text: String| RichText::new(text).monospace().color(look.colour(Role::Muted));
    // in a row of its own, so that no row wraps when the other grows
    if let Some(tip) = robot.tip {
        ui.label(muted(readout(&format!("tip: ({:.3}, {:.3})", tip.x, tip.y))));
    }
    if let (Some(clearance), Some(AnyRobot::Rusty(rusty))) = (&robot.clearance, robot.model) {
        let hover = match clearance.held_before {
            Some(_) => "Its next step would touch it: a robot on wheels is held before what it drives against.",
            None => "How far the nearest obstacle is. Other robots do not count.",
        };
        let row = Label::new(muted(clearance.words(rusty.body_radius)));
        // what is below does not move when a robot touches something with a long name
        let row = if clearance.held_before.is_some() { row.truncate() } else { row };
        ui.add(row).on_hover_text(hover);
    }
    let mut text = format!("contacts: {}", robot.contacts);
    if robot.trailer.is_some() {
        text += &format!("  reversals: {}", robot.reversals);
    }
    let held = "Since the start. A robot on wheels is held a tenth of a millimetre off what it drives against.";
    let of_arm = "Since the start. An arm is not held by what it touches: its contacts are counted.";
    let counted = if robot.is_arm { of_arm } else { held };
    ui.label(muted(text)).on_hover_text(counted);
}

/// Shows a link. Where there is a reason why it can't be used now it is grey, and the reason is said on hover and by a
/// click. Returns whether it was clicked and can be used.
fn link(ui: &mut Ui, words: &str, why_not: Option<String>, look: &FrameColours, state: &mut UiState) -> bool {
    let Some(text) = why_not else { return ui.link(words).clicked() };
    let grey = Link::new(RichText::new(words).color(look.colour(Role::Muted)));
    if ui.add(grey).on_hover_text(&text).clicked() {
        state.say(Notice { text, is_error: false });
    }
    false
}

/// Shows links for what can be done with a robot besides driving it, and with the doors of the cockpit that it has to
/// itself.
fn links(
    ui: &mut Ui,
    robot: &CockpitRobot,
    alone_in: Option<&Cockpit>,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let goal = state.goal.clone().filter(|(name, _)| *name == robot.name);
    // rows that wrap are as high as their words
    ui.spacing_mut().interact_size.y = ui.text_style_height(&TextStyle::Body);
    ui.horizontal_wrapped(|ui| {
        ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
        let put_in = |commands: &mut Vec<Command>, input| {
            commands.push(Command::from(TransportCommand::Checkpoint));
            commands.push(Command::from(RobotCommand { robot: robot.name.clone(), input }));
        };
        // what comes and goes while the run plays keeps its place, so that no link moves away from the pointer
        if let Some(on) = robot.trailer {
            let words = if on { "take the trailer off" } else { "put a trailer on" };
            let why_not = robot.no_room.as_ref().map(|why| format!("no room for a trailer: {why}"));
            if link(ui, words, why_not, look, state) {
                put_in(commands, RobotInput::SetTrailer(!on));
            }
        }
        if !robot.sees.is_empty() {
            ui.checkbox(&mut state.settings.scan, "scan");
        }
        ui.checkbox(&mut state.settings.nearest, "nearest points");
        // a program's own arm has the links that it has
        let own = [RobotKind::REACH.name, RobotKind::REACH3.name].contains(&robot.kind.as_str());
        if robot.is_arm && own {
            let (words, links) = if robot.coordinates.len() == 2 { ("three links", 3) } else { ("two links", 2) };
            let link = ui.link(words).on_hover_text("Start a new run with this arm");
            if link.clicked() {
                commands.push(Command::Session(SessionCommand::Links { robot: robot.name.clone(), links }));
            }
        }
        if let Some(cockpit) = alone_in {
            doors::buttons(ui, cockpit, commands);
        }
        match (&goal, trailer_of(&robot.footprint).filter(|_| robot.trailer == Some(true))) {
            (Some((_, goal)), trailer) => {
                if ui.link("drop the goal").clicked() {
                    state.goal = None;
                }
                let start: Option<Vec<Quantized>> = goal.start.iter().map(|x| Quantized::try_new(*x)).collect();
                if let (Some(start), Some(_)) = (start, trailer)
                    && ui.link("again").on_hover_text("Put the car back where the exercise began").clicked()
                {
                    put_in(commands, RobotInput::Teleport(start));
                    // it does not drive on by itself
                    let input = RobotInput::Drive(0, 0);
                    commands.push(Command::from(RobotCommand { robot: robot.name.clone(), input }));
                    state.goal = Some((robot.name.clone(), goal.again()));
                }
            }
            (None, Some(_)) => {
                let link = ui.link("goal: one metre to the left");
                if link.on_hover_text("The trailer is to end one metre left of here, facing the same way").clicked() {
                    let set = ParkingExercise::left_of(&robot.footprint, &robot.coordinates, robot.reversals);
                    state.goal = set.map(|goal| (robot.name.clone(), goal));
                }
            }
            (None, None) => {}
        }
        // behind all else, where it moves nothing as it comes and goes
        if robot.manual && ui.link("resume tour").clicked() {
            put_in(commands, RobotInput::Release);
        }
    });
}
