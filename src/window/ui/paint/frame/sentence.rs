//! The sentence under the pictures of a wide window: the task at hand, what it taught, or the misconception that the
//! widget removes.

use std::sync::Arc;

use bevy_egui::egui::{
    Align, Color32, FontId, Frame, Galley, Layout, Margin, Panel, Pos2, Rect, Response, RichText, Sense, Shape, Stroke,
    TextStyle, Ui, UiBuilder, Vec2, WidgetInfo, WidgetType, vec2,
};

use super::super::touch::worded;
use super::hints::done_in;
use super::tasks::{has_its_robot, is_shown_here, is_true_of, mode_of, suits};
use crate::window::ui::keys::{self, SessionAction};
use crate::window::ui::paint::style::ScreenTheme;
use crate::window::ui::{Dashboard, FrameColours, LessonState, UiState};
use motion_lab_core::picture::Role;
use motion_lab_sim::manifest::{Hint, Lesson, Widget};

/// Height of the sentence's room, points. Whatever is said in it, the pictures above stay where they are.
const HEIGHT: f32 = 56.0;

/// Sizes of its type, points: the largest with which it fits.
const SIZES: [f32; 3] = [20.0, 16.0, 14.0];

/// Width of a dot's target and radius of the dot, points.
const TARGET: f32 = 24.0;
const DOT: f32 = 4.0;

/// What the sentence says.
struct Sentence {
    words: String,
    role: Role,
    /// The lesson that a click on it begins.
    begins: Option<Lesson>,
}

/// Shows in a room at the bottom of `ui` the sentence of the widget in front, and beside it a dot for each of its
/// tasks. The misconception is shown only where it [is true](is_true_of) of what is in front.
pub fn sentence(ui: &mut Ui, model: &Dashboard, side: i8, look: &FrameColours, state: &mut UiState) {
    let (widget, is_true) = (state.widget.text(), is_true_of(model, state));
    let under_way = state.lesson.clone().filter(|under_way| is_shown_here(under_way, state));
    let are_hints_shown = !state.settings.are_hints_away(state.widget);
    let is_possible = |hint: &&Hint| suits(hint, state) && has_its_robot(hint.task, model);
    let hints: Vec<&Hint> = widget.hints.iter().filter(is_possible).collect();
    let open = || hints.iter().filter(|hint| are_hints_shown && !state.settings.is_ticked_off(hint.task));
    // of the tasks of the atlas first those of what a click does there now
    let is_at_hand = |hint: &&&Hint| state.widget != Widget::Atlas || mode_of(hint.task) == state.atlas.mode;
    let next = open().find(is_at_hand).or_else(|| open().next());
    let said = match (&under_way, next) {
        (Some(under_way), _) if under_way.took.is_some() => {
            Sentence { words: under_way.learnt.clone(), role: Role::Text, begins: None }
        }
        (Some(under_way), _) => {
            let words = worded(ui, under_way.lesson.text());
            Sentence { words, role: Role::Text, begins: Some(under_way.lesson) }
        }
        (None, Some(hint)) => {
            let begins = Some(Lesson { task: hint.task, widget: state.widget });
            Sentence { words: worded(ui, &hint.text), role: Role::Text, begins }
        }
        (None, None) if is_true => Sentence { words: widget.misconception.clone(), role: Role::Muted, begins: None },
        (None, None) => return,
    };
    let frame = Frame::NONE.inner_margin(Margin::symmetric(side, 0));
    Panel::bottom("sentence").exact_size(HEIGHT).frame(frame).show_separator_line(false).show(ui, |ui| {
        let room = ui.max_rect();
        let width = (hints.len() as f32 * TARGET).max(links_width(ui, under_way.is_some())) + TARGET;
        let (rest, right) = room.split_left_right_at_x((room.right() - width).max(room.left()));
        let layout = Layout::top_down(Align::Max);
        let mut beside = ui.new_child(UiBuilder::new().max_rect(right).layout(layout));
        dots(&mut beside, &hints, &said, under_way.as_ref(), look, state);
        let response = words(ui, rest, &said, look);
        if let Some(lesson) = said.begins.filter(|_| response.clicked()) {
            state.begin(lesson);
        }
    });
}

/// The words of the links, of a lesson under way or of the hints.
const OF_LESSON: [&str; 3] = ["Next", "Again", "All tasks"];
const OF_HINTS: [&str; 2] = ["Got it", "Tasks"];

/// The longest of a lesson's usual times, for the room that it takes, seconds.
const LONG: f64 = 100.0;

/// The width of the links at their widest.
fn links_width(ui: &Ui, in_lesson: bool) -> f32 {
    let font = TextStyle::Body.resolve(ui.style());
    let width = |words: String| {
        let galley = ui.painter().layout_no_wrap(words, font.clone(), Color32::PLACEHOLDER);
        galley.size().x + ui.spacing().item_spacing.x
    };
    let links: &[&str] = if in_lesson { &OF_LESSON } else { &OF_HINTS };
    let links: f32 = links.iter().map(|words| width((*words).to_owned())).sum();
    links + if in_lesson { width(done_in(LONG)) } else { 0.0 }
}

/// Shows the words, in the middle of their room's height. Returns the response of what a click begins.
fn words(ui: &mut Ui, room: Rect, said: &Sentence, look: &FrameColours) -> Response {
    let colour = look.theme.colour(said.role);
    let galley = fitting(ui, &said.words, colour, room.size());
    let at = Pos2::new(room.left(), room.center().y - 0.5 * galley.size().y);
    let rect = Rect::from_min_size(at, galley.size());
    let sense = if said.begins.is_some() { Sense::click() } else { Sense::hover() };
    let response = ui.allocate_rect(rect, sense);
    let kind = if said.begins.is_some() { WidgetType::Link } else { WidgetType::Label };
    response.widget_info(|| WidgetInfo::labeled(kind, true, &said.words));
    if said.begins.is_some() && (response.hovered() || response.has_focus()) {
        let line = Stroke::new(1.0, look.theme.colour(Role::Focus));
        ui.painter().hline(rect.x_range(), rect.bottom(), line);
    }
    ui.painter_at(room.expand(2.0)).galley(at, galley, colour);
    if said.begins.is_some() { response.on_hover_text("Begin this task") } else { response }
}

/// The words laid out in the largest type with which they fit a room, else in the smallest.
fn fitting(ui: &Ui, words: &str, colour: Color32, room: Vec2) -> Arc<Galley> {
    let family = TextStyle::Body.resolve(ui.style()).family;
    let laid = SIZES.map(|size| {
        let font = FontId::new(size, family.clone());
        ui.painter().layout(words.to_owned(), font, colour, room.x)
    });
    let last = Arc::clone(&laid[SIZES.len() - 1]);
    laid.into_iter().find(|galley| galley.size().y <= room.y).unwrap_or(last)
}

/// Shows a dot for each task, filled once it has been done, and under them links.
fn dots(
    ui: &mut Ui,
    hints: &[&Hint],
    said: &Sentence,
    under_way: Option<&LessonState>,
    look: &FrameColours,
    state: &mut UiState,
) {
    let mut begun = None;
    let at_hand = under_way.map(|under_way| under_way.lesson).or(said.begins);
    ui.add_space(4.0);
    ui.allocate_ui_with_layout(vec2(ui.available_width(), TARGET), Layout::right_to_left(Align::Center), |ui| {
        if under_way.is_none() && state.settings.are_hints_away(state.widget) {
            return;
        }
        ui.spacing_mut().item_spacing.x = 0.0;
        // from the right, which is where the row begins
        for hint in hints.iter().rev() {
            let lesson = Lesson { task: hint.task, widget: state.widget };
            let is_done = state.settings.is_ticked_off(hint.task);
            let is_at_hand = at_hand == Some(lesson);
            // what the sentence says is a link already
            let sense = if is_at_hand && said.begins.is_some() { Sense::hover() } else { Sense::click() };
            let (rect, response) = ui.allocate_exact_size(Vec2::splat(TARGET), sense);
            dot(ui, rect, is_done, is_at_hand, look);
            if sense == Sense::hover() {
                continue;
            }
            let text = worded(ui, &hint.text);
            let spoken = if is_done { format!("{text} Done.") } else { text };
            response.widget_info(|| WidgetInfo::labeled(WidgetType::Link, true, &spoken));
            if response.on_hover_text(spoken).clicked() {
                begun = Some(lesson);
            }
        }
    });
    ui.allocate_ui_with_layout(vec2(ui.available_width(), 20.0), Layout::right_to_left(Align::Center), |ui| {
        ui.spacing_mut().interact_size.y = 20.0;
        let Some(under_way) = under_way else {
            let are_away = state.settings.are_hints_away(state.widget);
            let what = if are_away { "Show what there is to try" } else { "Put what there is to try away" };
            let hover = format!("{what}: {}", keys::hint(SessionAction::Hints));
            if ui.link(OF_HINTS[usize::from(are_away)]).on_hover_text(hover).clicked() {
                state.settings.toggle_hints(state.widget);
            }
            return;
        };
        let [next, again, all] = OF_LESSON;
        if ui.link(all).clicked() {
            state.lesson = None;
            state.settings.show_hints(state.widget);
        }
        if ui.link(again).on_hover_text("Begin this task anew").clicked() {
            begun = Some(under_way.lesson);
        }
        let follows = under_way.lesson.next().filter(|_| under_way.took.is_some());
        if follows.is_some() && ui.link(next).on_hover_text("Begin the next task").clicked() {
            begun = follows;
        }
        if let Some(took) = under_way.took {
            ui.label(RichText::new(done_in(took)).color(look.theme.colour(Role::Free)));
        }
    });
    if let Some(lesson) = begun {
        state.begin(lesson);
    }
}

/// Paints the dot of a task: a ring, filled once it has been done, and larger while it is at hand.
fn dot(ui: &Ui, rect: Rect, is_done: bool, is_at_hand: bool, look: &FrameColours) {
    let role = if is_done { Role::Free } else { Role::Muted };
    let (centre, colour) = (rect.center(), look.theme.colour(role));
    let radius = if is_at_hand { 1.5 * DOT } else { DOT };
    let painter = ui.painter();
    if is_done {
        painter.circle_filled(centre, radius, colour);
        // not by colour alone
        let tick = [vec2(-1.8, 0.0), vec2(-0.5, 1.5), vec2(1.9, -1.5)].map(|corner| centre + corner);
        painter.add(Shape::line(tick.to_vec(), Stroke::new(1.2, look.theme.colour(Role::Paper))));
    } else {
        let width = if is_at_hand { 2.0 } else { 1.0 };
        let colour = if is_at_hand { look.theme.colour(Role::Text) } else { colour };
        painter.circle_stroke(centre, radius, Stroke::new(width, colour));
    }
}
