//! Query anatomy: one frozen scene, four questions.

use std::sync::Arc;

use bevy_egui::egui::{
    ComboBox, DragValue, Id, Label, Response, RichText, ScrollArea, Slider, TextEdit, TextStyle, Ui, WidgetInfo,
    WidgetType,
};

use super::in_front::PutInRun;
use super::loupe::loupe;
use super::state::Guesses;
use crate::window::ui::cspace::chart::{ChartNames, chart, remember};
use crate::window::ui::number::{NumberInput, TypedKind};
use crate::window::ui::paint::button::LabButton;
use crate::window::ui::paint::fold::{fold, unfolding};
use crate::window::ui::paint::frame::{formulas, headline};
use crate::window::ui::paint::sheet::{sheet, split, split_chart, steady, two_columns};
use crate::window::ui::{AnatomyState, Command, Dashboard, FrameColours, Notice, UiState};
use motion_lab_core::configuration::Configuration;
use motion_lab_core::picture::{Role, in_signs, true_minus};
use motion_lab_core::worlds::World;
use motion_lab_sim::anatomy::{Anatomy, LENGTHS, PromptSeries, Tab, WorldSource};
use motion_lab_sim::lens::done_between;
use motion_lab_sim::manifest::{HintTask, Widget};

/// Width of the panel beside the paper, points.
const SIDE: f32 = 380.0;

/// Width of the panel from which it has two columns, points.
const TWO: f32 = 600.0;

/// Width of a slider's number and name, points.
const FIELD: f32 = 120.0;

/// Largest share of the height for the chart above the panel.
const ABOVE: f32 = 0.4;

/// Difference of two lengths from which on they are unequal, metres.
const UNEQUAL: f64 = 0.05;

/// The least room for a name and its list, points.
const CHOOSER: f32 = 150.0;

/// Shows the widget.
pub fn anatomy_view(
    ui: &mut Ui,
    model: &Dashboard,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let words = Widget::Anatomy.text();
    if !look.low {
        crate::window::ui::menu::head(ui, words, model, look, state, commands);
    }
    let before = state.anatomy.anatomy.clone();
    let room = ui.available_rect_before_wrap();
    let (paper, beside) = split(&state.anatomy.backdrop, room, look, SIDE);
    let (space, beside) = split_chart(paper, beside, state.cspace.still(&state.anatomy.anatomy), ABOVE, look);
    let shown = &state.anatomy;
    let (backdrop, overlay) = (Arc::clone(&shown.backdrop), shown.anatomy.overlay());
    let spoken = shown.anatomy.described();
    let on = sheet(ui, paper, spoken, &backdrop, &overlay, look);
    if let Some(to) = on.held().filter(|_| on.response.dragged() || on.response.clicked()) {
        state.anatomy.anatomy.drag(to);
        remember(state);
    }
    if !look.narrow {
        loupe(ui, &on, &state.anatomy.anatomy, look);
    }
    if let Some(space) = space {
        chart(ui, space, ChartNames::Spoken, look, state);
    }
    state.pointer.over = on.pointed_at(&overlay).or_else(|| on.pointed_at(&backdrop));
    // a hint for who has not dragged it yet: words at the pointer hide the contact
    let known = Id::new("the robot was dragged");
    if on.response.dragged() {
        ui.data_mut(|data| data.insert_temp(known, true));
    }
    if !ui.data(|data| data.get_temp(known).unwrap_or(false)) {
        on.response.on_hover_text_at_pointer("Drag the robot: an arm by its tip");
    }
    ui.scope_builder(bevy_egui::egui::UiBuilder::new().max_rect(beside), |ui| {
        ScrollArea::vertical().id_salt("anatomy").auto_shrink(false).show(ui, |ui| {
            if look.low {
                crate::window::ui::menu::head(ui, words, model, look, state, commands);
            }
            if ui.available_width() >= TWO {
                let half = 0.5 * (ui.available_width() - 20.0);
                two_columns(ui, half, |ui, i| {
                    if i == 0 {
                        asked(ui, look, state);
                    } else {
                        more(ui, model, look, state, commands);
                    }
                });
            } else {
                asked(ui, look, state);
                more(ui, model, look, state, commands);
            }
            crate::window::ui::menu::foot(ui, words, look, state);
        });
    });
    let shown = &mut state.anatomy;
    if ui.input(|i| i.pointer.any_down()) {
        // what a drag only passes through is no task
        _ = shown.pressed.get_or_insert(before);
    } else {
        let before = shown.pressed.take().unwrap_or(before);
        state.did.extend(done_between(&before, &shown.anatomy));
    }
}

/// Shows the question, its answer, and the configuration.
fn asked(ui: &mut Ui, look: &FrameColours, state: &mut UiState) {
    ui.horizontal_wrapped(|ui| {
        for tab in Tab::ALL {
            if LabButton::new(tab.name()).selected(state.anatomy.anatomy.tab == tab).show(ui, look).clicked() {
                state.anatomy.anatomy.tab = tab;
            }
        }
    });
    ui.label(state.anatomy.anatomy.question());
    formulas(ui, state.anatomy.anatomy.tab.name(), look, state);
    let anatomy = &mut state.anatomy.anatomy;
    let role = if anatomy.intersects() && anatomy.tab != Tab::Swept { Role::Goal } else { Role::Text };
    let (answer, details) = anatomy.answer();
    // each question's answers have their own room
    let row = ui.spacing().item_spacing.y;
    let least = ui.text_style_height(&TextStyle::Heading) + row + ui.text_style_height(&TextStyle::Monospace);
    steady(ui, anatomy.tab.name(), least, |ui| {
        headline(ui, &answer, look.colour(role));
        for line in details {
            ui.label(RichText::new(true_minus(&line)).monospace().color(look.colour(role)));
        }
    });
    ui.add_space(4.0);
    sliders(ui, state);
    let anatomy = &mut state.anatomy.anatomy;
    if let Some((thick, radius)) = anatomy.thick_links().zip(anatomy.thickness()) {
        let mut on = thick;
        if ui.checkbox(&mut on, format!("{} cm capsule links", (1e5 * radius).round() / 1e3)).changed() {
            anatomy.set_thick_links(on);
        }
    }
}

/// Shows a guess, and what can be copied or chosen.
fn more(ui: &mut Ui, model: &Dashboard, look: &FrameColours, state: &mut UiState, commands: &mut Vec<Command>) {
    let lesson = state.lesson.as_ref().filter(|under_way| under_way.took.is_none());
    let is_asked = lesson.is_some_and(|under_way| under_way.lesson.task == HintTask::Guess);
    unfolding(ui, "Guess first", is_asked, |ui| {
        prompts(ui, PromptSeries::Queries, state);
    });
    ui.horizontal_wrapped(|ui| {
        if LabButton::new("Copy as Rust").show(ui, look).clicked() {
            ui.ctx().copy_text(state.anatomy.anatomy.copy_as_rust());
            state.say(Notice { text: "copied: a program that asks the same".into(), is_error: false });
        }
        let command = state.anatomy.anatomy.copy_as_command();
        if LabButton::new("Copy as command").enabled(command.is_some()).show(ui, look).clicked() {
            ui.ctx().copy_text(command.unwrap_or_default());
            state.say(Notice { text: "copied: a command that asks the same".into(), is_error: false });
        }
        if LabButton::new("Reset").show(ui, look).clicked() {
            state.anatomy = AnatomyState::default();
        }
        PutInRun::of_query(&state.anatomy.anatomy).show(ui, model, look, commands);
    });
    fold(ui, "Any robot, any world", false, |ui| any(ui, state));
}

/// Shows sliders for the configuration; on the swept tab also for the step to the second configuration.
fn sliders(ui: &mut Ui, state: &mut UiState) {
    let names = state.anatomy.anatomy.q().coordinate_names();
    ui.spacing_mut().slider_width = (ui.available_width() - FIELD).clamp(60.0, 180.0);
    for (i, name) in names.iter().enumerate() {
        coordinate(ui, state, i, name);
    }
    if state.anatomy.anatomy.tab == Tab::Swept {
        ui.label("and the step of the motion:");
        for (i, name) in names.iter().enumerate() {
            let anatomy = &mut state.anatomy.anatomy;
            let mut step = anatomy.step()[i];
            let most = anatomy.step_range(i);
            let takes = if anatomy.q().is_angle(i) { TypedKind::Turn } else { TypedKind::Plain };
            let name = format!("step of {}", in_signs(name));
            let typed = NumberInput::new(ui, -most..=most, takes);
            let slider = exact(Slider::new(&mut step, -most..=most), 3, &typed).text(&name);
            let response = ui.add(slider);
            response.widget_info(|| WidgetInfo::slider(true, step, &name));
            if response.changed() {
                anatomy.set_step(i, step);
            }
            state.refuse(typed.refused(&response));
        }
    }
}

/// Shows a series of prompts one by one: each asks for a guess before it shows the number.
pub(crate) fn prompts(ui: &mut Ui, series: PromptSeries, state: &mut UiState) {
    let prompt = series.prompt(state.anatomy.guesses[series as usize].number);
    let label = ui.label(prompt.question);
    if prompt.shown().checker().robot().title() != state.anatomy.anatomy.checker().robot().title() {
        ui.weak("It asks of another robot than the one shown: it has a scene of its own.");
    }
    ui.horizontal(|ui| {
        let guesses = &mut state.anatomy.guesses[series as usize];
        let field = TextEdit::singleline(&mut guesses.typed).desired_width(80.0).hint_text(prompt.unit);
        let field = ui.add(field).labelled_by(label.id);
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(bevy_egui::egui::Key::Enter));
        if ui.button("Check").clicked() || entered {
            let checked = prompt.check_text(&guesses.typed);
            if checked.is_ok() && prompt.id == "thick links" {
                state.did.push(HintTask::Guess);
            }
            guesses.is_answered = checked.is_ok();
            guesses.said = Some(checked.map_or_else(|none| none.to_string(), |guess| prompt.words(guess)));
        }
        if guesses.is_answered {
            let (show, next) = (ui.button("Show").clicked(), ui.button("Next question").clicked());
            if next {
                *guesses = Guesses { number: (guesses.number + 1) % series.count(), ..Guesses::default() };
            }
            if show {
                state.anatomy.set(prompt.shown().clone());
            }
        }
    });
    if let Some(said) = &state.anatomy.guesses[series as usize].said {
        ui.add(Label::new(RichText::new(said).strong()).wrap());
    }
}

/// Shows the choice of robot and world, and the annulus's check box.
fn any(ui: &mut Ui, state: &mut UiState) {
    robot_choice(ui, state);
    world_choice(ui, state);
    ui.horizontal_wrapped(|ui| annulus(ui, state));
}

/// Shows a chooser behind its name.
pub(crate) fn chooser(ui: &mut Ui, name: &str, list: ComboBox, choices: impl FnOnce(&mut Ui)) -> Response {
    let show = |ui: &mut Ui| {
        let label = ui.label(name);
        let shown = list.show_ui(ui, choices).response.labelled_by(label.id);
        shown.widget_info(|| WidgetInfo::labeled(WidgetType::ComboBox, true, name));
        shown
    };
    // name and list stay together
    if ui.layout().main_wrap && ui.available_size_before_wrap().x < CHOOSER {
        ui.end_row();
    }
    // in a row that wraps, a row within it would not
    if ui.layout().main_wrap { show(ui) } else { ui.horizontal(show).inner }
}

/// Shows the choice of robot.
pub(crate) fn robot_choice(ui: &mut Ui, state: &mut UiState) {
    let anatomy = state.anatomy.anatomy.clone();
    let present = *anatomy.checker().robot();
    let mut choices = anatomy.residents();
    choices.extend(Anatomy::choices().map(|(name, robot)| (name.to_owned(), robot)));
    let name =
        choices.iter().find(|(_, robot)| *robot == present).map_or(present.title(), |(n, _)| n.as_str()).to_owned();
    chooser(ui, "robot", ComboBox::from_id_salt("robot").selected_text(name), |ui| {
        for (name, robot) in choices {
            if ui.selectable_label(present == robot, name).clicked() {
                state.anatomy.set(anatomy.at_home(robot));
            }
        }
    });
}

/// Shows the choice of world: the built-in ones, and the atlas's world if it is none of them.
pub(crate) fn world_choice(ui: &mut Ui, state: &mut UiState) {
    let anatomy = state.anatomy.anatomy.clone();
    let books =
        World::built_in_names().into_iter().filter_map(|n| Some((World::built_in(n)?, WorldSource::BuiltIn(n))));
    let mut worlds: Vec<(String, World, WorldSource)> = books.map(|(w, source)| (w.name.clone(), w, source)).collect();
    let atlas = state.atlas.world();
    if worlds.iter().all(|(_, world, _)| world != atlas) {
        worlds.push((format!("{}, in the atlas", atlas.name), atlas.clone(), state.atlas.source()));
    }
    chooser(ui, "world", ComboBox::from_id_salt("world").selected_text(anatomy.world().name.as_str()), |ui| {
        for (name, world, source) in worlds {
            if ui.selectable_label(**anatomy.world() == world, name).clicked() {
                state.anatomy.set(anatomy.in_world(world, source));
            }
        }
    });
}

/// Shows the check box of the annulus, the points that the tip of an arm can reach, and fields for the lengths of an
/// arm's two links; nothing for other robots.
pub(crate) fn annulus(ui: &mut Ui, state: &mut UiState) {
    for (link, mut length) in state.anatomy.anatomy.lengths().into_iter().flatten().enumerate() {
        let anatomy = &mut state.anatomy.anatomy;
        let typed = NumberInput::new(ui, LENGTHS, TypedKind::Plain);
        // its name is in the field, so that no row parts them
        let field = DragValue::new(&mut length).range(LENGTHS).speed(0.01).fixed_decimals(2);
        let field = field.custom_parser(|text| typed.read(text)).update_while_editing(false);
        let response = ui.add(field.prefix(format!("L{} ", link + 1)).suffix("\u{a0}m"));
        response.widget_info(|| WidgetInfo {
            label: Some(format!("length of link {}", link + 1)),
            ..WidgetInfo::new(WidgetType::DragValue)
        });
        if response.changed() {
            anatomy.set_length(link, length);
            anatomy.show_annulus = true;
            if anatomy.lengths().is_some_and(|[one, two]| (one - two).abs() >= UNEQUAL) {
                state.did.push(HintTask::UnequalLinks);
            }
        }
        state.refuse(typed.refused(&response));
    }
    let anatomy = &mut state.anatomy.anatomy;
    if anatomy.checker().robot().annulus().is_some() {
        ui.checkbox(&mut anatomy.show_annulus, "the tip's reach");
    }
}

/// A slider that shows `decimals` decimals and keeps its value in full: `fixed_decimals` would round the value itself.
/// What is typed beside it is entered when it is left.
pub(crate) fn exact<'a>(slider: Slider<'a>, decimals: usize, typed: &'a NumberInput) -> Slider<'a> {
    let shown = move |value: f64, _| true_minus(&format!("{value:.decimals$}"));
    slider.custom_formatter(shown).custom_parser(move |text| typed.read(text)).update_while_editing(false)
}

/// A slider for a coordinate of the configuration.
pub(crate) fn coordinate(ui: &mut Ui, state: &mut UiState, index: usize, name: &str) {
    let anatomy = &mut state.anatomy.anatomy;
    // another robot may have been chosen in this very frame
    let Some(mut value) = anatomy.q().coordinates().get(index).copied() else { return };
    let [least, most] = anatomy.range(index);
    let name = in_signs(name);
    let typed = NumberInput::new(ui, least..=most, TypedKind::of(anatomy.q().is_angle(index)));
    let response = ui.add(exact(Slider::new(&mut value, least..=most), 4, &typed).text(&name));
    response.widget_info(|| WidgetInfo::slider(true, value, &name));
    if response.changed() {
        anatomy.set_coordinate(index, value);
    }
    state.refuse(typed.refused(&response));
}
