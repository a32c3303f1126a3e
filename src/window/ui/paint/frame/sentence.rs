//! The sentence under the pictures: the task at hand, what it taught, or the misconception that the widget removes.

use std::sync::Arc;

use bevy_egui::egui::{
    Align, Color32, FontId, Frame, Galley, Layout, Margin, Panel, Pos2, Rect, RichText, Sense, Shape, Stroke,
    TextStyle, Ui, UiBuilder, Vec2, WidgetInfo, WidgetType, vec2,
};

use super::super::touch::worded;
use super::tasks::{has_its_robot, is_shown_here, is_true_of, mode_of, suits};
use super::title::rows_of_words;
use crate::window::ui::keys::{self, SessionAction};
use crate::window::ui::paint::style::ScreenTheme;
use crate::window::ui::{Dashboard, FrameColours, LessonState, UiState};
use motion_lab_core::picture::Role;
use motion_lab_sim::manifest::{Hint, Lesson, Widget};

/// Height of the sentence's room on a wide screen and on a narrow one, points. Whatever is said in it, the pictures
/// above stay where they are.
const HEIGHT: f32 = 56.0;
const NARROW: f32 = 58.0;

/// Height of the words of a narrow screen's sentence, points: two lines of its largest type.
const NARROW_WORDS: f32 = 36.0;

/// Sizes of its type, points: the largest with which it fits.
const SIZES: [f32; 3] = [20.0, 16.0, 14.0];

/// Height of its links, points.
const LINKS: f32 = 20.0;

/// Width of a dot's target and radius of the dot, points.
const TARGET: f32 = 24.0;
const DOT: f32 = 4.0;

/// What the sentence says.
struct Sentence {
    words: String,
    role: Role,
    /// The lesson that a click on it begins.
    begins: Option<Lesson>,
    /// The lesson under way, if it is the widget's in front.
    under_way: Option<LessonState>,
    /// The tasks that can be followed here.
    hints: Vec<&'static Hint>,
}

impl Sentence {
    /// The sentence of the widget in front. The misconception is said only where it [is true](is_true_of) of what is in
    /// front; `None` where nothing is left to say.
    fn of(ui: &Ui, model: &Dashboard, state: &UiState) -> Option<Self> {
        let widget = state.widget.text();
        let under_way = state.lesson.clone().filter(|under_way| is_shown_here(under_way, state));
        let are_hints_shown = !state.settings.are_hints_away(state.widget);
        let is_possible = |hint: &&Hint| suits(hint, state) && has_its_robot(hint.task, model);
        let hints: Vec<&Hint> = widget.hints.iter().filter(is_possible).collect();
        let open = || hints.iter().filter(|hint| are_hints_shown && !state.settings.is_ticked_off(hint.task));
        // of the tasks of the atlas first those of what a click does there now
        let is_at_hand = |hint: &&&Hint| state.widget != Widget::Atlas || mode_of(hint.task) == state.atlas.mode;
        let next = open().find(is_at_hand).or_else(|| open().next());
        let (words, role, begins) = match (&under_way, next) {
            (Some(under_way), _) if under_way.took.is_some() => (under_way.learnt.clone(), Role::Text, None),
            (Some(under_way), _) => (worded(ui, under_way.lesson.text()), Role::Text, Some(under_way.lesson)),
            (None, Some(hint)) => {
                let begins = Lesson { task: hint.task, widget: state.widget };
                (worded(ui, &hint.text), Role::Text, Some(begins))
            }
            (None, None) if is_true_of(model, state) => (widget.misconception.clone(), Role::Muted, None),
            (None, None) => return None,
        };
        Some(Sentence { words, role, begins, under_way, hints })
    }
}

/// Shows the sentence in a room at the bottom of `ui`, and beside it a dot for each of the widget's tasks; on a narrow
/// screen links alone, under it.
pub fn sentence(ui: &mut Ui, model: &Dashboard, side: i8, look: &FrameColours, state: &mut UiState) {
    let Some(said) = Sentence::of(ui, model, state) else { return };
    let frame = Frame::NONE.inner_margin(Margin::symmetric(side, 0));
    let panel = Panel::bottom("sentence").frame(frame).show_separator_line(false);
    if look.narrow {
        // a page around has words of its own; what is removed stands with the other words
        let is_asked = said.under_way.is_some() || said.begins.is_some() && !state.screen.embedded;
        if is_asked {
            panel.exact_size(NARROW).show(ui, |ui| rows(ui, &said, look, state));
        }
        return;
    }
    panel.exact_size(HEIGHT).show(ui, |ui| {
        let room = ui.max_rect();
        let width = (said.hints.len() as f32 * TARGET).max(links_width(ui, said.under_way.is_some())) + TARGET;
        let (rest, right) = room.split_left_right_at_x((room.right() - width).max(room.left()));
        let layout = Layout::top_down(Align::Max);
        let mut beside = ui.new_child(UiBuilder::new().max_rect(right).layout(layout));
        let mut begun = dots(&mut beside, &said, look, state);
        let row = vec2(beside.available_width(), LINKS);
        beside.allocate_ui_with_layout(row, Layout::right_to_left(Align::Center), |ui| {
            ui.spacing_mut().interact_size.y = LINKS;
            begun = links(ui, said.under_way.as_ref(), look, state).or(begun);
        });
        let fit = fitting(ui, &said, &SIZES, rest.size(), look);
        let at = Pos2::new(rest.left(), rest.center().y - 0.5 * fit.size().y);
        begun = words(ui, &said, fit, at, look).or(begun);
        if let Some(lesson) = begun {
            state.begin(lesson);
        }
    });
}

/// Shows the sentence and its links among the words of a low room, if there is a task to say.
pub fn sentence_in_rows(ui: &mut Ui, model: &Dashboard, look: &FrameColours, state: &mut UiState) {
    let said = Sentence::of(ui, model, state);
    if let Some(said) = said.filter(|said| said.begins.is_some() || said.under_way.is_some()) {
        rows(ui, &said, look, state);
        ui.add_space(4.0);
    }
}

/// Shows the sentence over its links.
fn rows(ui: &mut Ui, said: &Sentence, look: &FrameColours, state: &mut UiState) {
    let fit = fitting(ui, said, &SIZES[1..], vec2(ui.available_width(), NARROW_WORDS), look);
    let at = ui.cursor().min;
    let mut begun = words(ui, said, fit, at, look);
    rows_of_words(ui, |ui| {
        if said.under_way.is_none() {
            let done = said.hints.iter().filter(|hint| state.settings.is_ticked_off(hint.task)).count();
            ui.weak(format!("{done} of {} done", said.hints.len()));
        }
        begun = links(ui, said.under_way.as_ref(), look, state).or(begun);
    });
    if let Some(lesson) = begun {
        state.begin(lesson);
    }
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

/// Shows the words at a place. Returns the lesson that a click on them begins.
fn words(ui: &mut Ui, said: &Sentence, galley: Arc<Galley>, at: Pos2, look: &FrameColours) -> Option<Lesson> {
    let rect = Rect::from_min_size(at, galley.size());
    let sense = if said.begins.is_some() { Sense::click() } else { Sense::hover() };
    let response = ui.allocate_rect(rect, sense);
    let kind = if said.begins.is_some() { WidgetType::Link } else { WidgetType::Label };
    response.widget_info(|| WidgetInfo::labeled(kind, true, &said.words));
    if said.begins.is_some() && (response.hovered() || response.has_focus()) {
        let line = Stroke::new(1.0, look.theme.colour(Role::Focus));
        ui.painter().hline(rect.x_range(), rect.bottom(), line);
    }
    ui.painter().galley(at, galley, look.theme.colour(said.role));
    let begins = said.begins?;
    response.on_hover_text("Begin this task").clicked().then_some(begins)
}

/// The words laid out in the largest type with which they fit a room, else in the smallest.
fn fitting(ui: &Ui, said: &Sentence, sizes: &[f32], room: Vec2, look: &FrameColours) -> Arc<Galley> {
    let family = TextStyle::Body.resolve(ui.style()).family;
    let laid = |size: f32| {
        let font = FontId::new(size, family.clone());
        ui.painter().layout(said.words.clone(), font, look.theme.colour(said.role), room.x)
    };
    let least = sizes.last().copied().unwrap_or(HEIGHT);
    sizes.iter().map(|size| laid(*size)).find(|galley| galley.size().y <= room.y).unwrap_or_else(|| laid(least))
}

/// Shows a dot for each task, filled once it has been done. Returns the lesson that a click begins.
fn dots(ui: &mut Ui, said: &Sentence, look: &FrameColours, state: &UiState) -> Option<Lesson> {
    let mut begun = None;
    let at_hand = said.under_way.as_ref().map(|under_way| under_way.lesson).or(said.begins);
    ui.add_space(4.0);
    ui.allocate_ui_with_layout(vec2(ui.available_width(), TARGET), Layout::right_to_left(Align::Center), |ui| {
        if said.under_way.is_none() && state.settings.are_hints_away(state.widget) {
            return;
        }
        ui.spacing_mut().item_spacing.x = 0.0;
        // from the right, which is where the row begins
        for hint in said.hints.iter().rev() {
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
    begun
}

/// Shows the links of a lesson under way, or else the one that puts the tasks away or brings them back; last to first
/// where the row begins at the right. Returns the lesson that one begins.
fn links(ui: &mut Ui, under_way: Option<&LessonState>, look: &FrameColours, state: &mut UiState) -> Option<Lesson> {
    let Some(under_way) = under_way else {
        let are_away = state.settings.are_hints_away(state.widget);
        let what = if are_away { "Show what there is to try" } else { "Put what there is to try away" };
        let hover = format!("{what}: {}", keys::hint(SessionAction::Hints));
        if ui.link(OF_HINTS[usize::from(are_away)]).on_hover_text(hover).clicked() {
            state.settings.toggle_hints(state.widget);
        }
        return None;
    };
    let [next, again, all] = OF_LESSON;
    let follows = under_way.lesson.next().filter(|_| under_way.took.is_some());
    let took = under_way.took.map(done_in);
    let mut shown: Vec<&str> = took.iter().map(String::as_str).collect();
    shown.extend(follows.map(|_| next));
    shown.extend([again, all]);
    if ui.layout().prefer_right_to_left() {
        shown.reverse();
    }
    let mut begun = None;
    for words in shown {
        if Some(words) == took.as_deref() {
            ui.label(RichText::new(words).color(look.theme.colour(Role::Free)));
        } else if words == next && ui.link(next).on_hover_text("Begin the next task").clicked() {
            begun = follows;
        } else if words == again && ui.link(again).on_hover_text("Begin this task anew").clicked() {
            begun = Some(under_way.lesson);
        } else if words == all && ui.link(all).clicked() {
            state.lesson = None;
            state.settings.show_hints(state.widget);
        }
    }
    begun
}

/// How long a lesson took, in words.
fn done_in(seconds: f64) -> String {
    format!("Done in {seconds:.0} s")
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
