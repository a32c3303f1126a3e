//! The next of the hints of a widget, and the lesson under way, where a narrow screen has them above and under its
//! pictures.

use bevy_egui::egui::{
    Color32, Label, Rect, Response, RichText, Sense, Shape, Stroke, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo,
    WidgetType, vec2,
};

use super::super::touch::worded;
use super::tasks::{is_shown_here, suits};
use super::title::{misconception, rows_of_words};
use crate::window::ui::paint::style::ScreenTheme;
use crate::window::ui::{FrameColours, LessonState, UiState};
use motion_lab_core::picture::Role;
use motion_lab_sim::manifest::{Hint, Lesson, WidgetText};

/// Side of the box before a hint, points, and the gap after it.
const BOX: f32 = 10.0;
const AFTER: f32 = 5.0;

/// Shows the lesson under way, if it is one of the widget in front.
pub fn lesson(ui: &mut Ui, look: &FrameColours, state: &mut UiState) {
    if let Some(under_way) = state.lesson.clone().filter(|under_way| is_shown_here(under_way, state)) {
        task_or_learnt(ui, &under_way, look, state);
    }
}

/// Whether a lesson of the widget in front has been done.
pub fn is_done_here(state: &UiState) -> bool {
    state.lesson.as_ref().is_some_and(|on| on.took.is_some() && on.lesson.widget == state.widget)
}

/// Shows the next of the hints, for the words below the picture of a narrow screen. In a lesson, whose task stands
/// above, it shows once that is done what it removes.
pub fn next_hint(ui: &mut Ui, widget: &WidgetText, look: &FrameColours, state: &mut UiState) {
    if look.narrow && !look.low && is_done_here(state) {
        return misconception(ui, widget, look);
    }
    if !look.narrow || state.lesson.is_some() || state.settings.are_hints_away(state.widget) {
        return;
    }
    let is_open = |hint: &&Hint| !state.settings.is_ticked_off(hint.task);
    let hints: Vec<&Hint> = widget.hints.iter().filter(|hint| suits(hint, state)).collect();
    let (count, open) = (hints.len(), hints.iter().copied().filter(is_open).count());
    let next = hints.iter().copied().find(is_open).or(hints.last().copied());
    rows_of_words(ui, |ui| {
        ui.label(RichText::new("Try:").color(look.theme.colour(Role::Text)).strong());
        ui.weak(format!("{} of {count} done", count - open));
        if ui.link("Got it").on_hover_text("Put these hints away").clicked() {
            state.settings.put_hints_away(state.widget);
        }
    });
    if let Some(hint) = next
        && task(ui, &hint.text, open == 0, look).on_hover_text("Begin this task").clicked()
    {
        state.begin(Lesson { task: hint.task, widget: state.widget });
    }
    ui.add_space(4.0);
}

/// Shows the task of the lesson under way in place of the hints, and in place of the task, once it is done, what was
/// learnt.
fn task_or_learnt(ui: &mut Ui, under_way: &LessonState, look: &FrameColours, state: &mut UiState) {
    let (top, least) = (ui.cursor().top(), height_of_lesson(ui, under_way));
    rows_of_words(ui, |ui| {
        let (head, role) =
            under_way.took.map_or(("Task:".to_owned(), Role::Text), |took| (format!("{}:", done_in(took)), Role::Free));
        ui.label(RichText::new(head).color(look.theme.colour(role)).strong());
        let mut is_begun = match under_way.took {
            None => task(ui, under_way.lesson.text(), false, look).clicked(),
            Some(_) => {
                let learnt = RichText::new(&under_way.learnt).color(look.theme.colour(Role::Text));
                ui.add(Label::new(learnt).wrap());
                false
            }
        };
        let next = under_way.lesson.next().filter(|_| under_way.took.is_some());
        let goes_on = next.is_some() && ui.link("Next").on_hover_text("Begin the next task").clicked();
        is_begun |= ui.link("Again").on_hover_text("Begin this task anew").clicked();
        if ui.link("All tasks").clicked() {
            state.lesson = None;
            state.settings.show_hints(state.widget);
        } else if let Some(next) = next.filter(|_| goes_on) {
            state.begin(next);
        } else if is_begun {
            state.begin(under_way.lesson);
        }
    });
    // what is said in place of other words leaves the picture below where it is
    let missing = top + least - ui.cursor().top();
    if missing > 0.0 {
        ui.add_space(missing);
    }
}

/// How long a lesson took, in words.
pub(super) fn done_in(seconds: f64) -> String {
    format!("Done in {seconds:.0} s")
}

/// The height that the words of a lesson take at this width, before it is done or after, whichever is greater.
fn height_of_lesson(ui: &Ui, under_way: &LessonState) -> f32 {
    let (font, gap) = (TextStyle::Body.resolve(ui.style()), ui.spacing().item_spacing);
    // a point more, for rounding
    let width = |text: &str| {
        ui.painter().layout_no_wrap(text.to_owned(), font.clone(), Color32::PLACEHOLDER).size().x + gap.x + 1.0
    };
    let room = ui.available_width() + gap.x;
    let words = |text: &str| {
        let text = worded(ui, text);
        let wrap = ui.available_width() - BOX - AFTER;
        let lines = ui.painter().layout(text.clone(), font.clone(), Color32::PLACEHOLDER, wrap).rows.len() as u32;
        (lines, (width(&text) + BOX + AFTER).min(room))
    };
    let rows = |head: &str, (lines, across): (u32, f32), links: &[&str]| {
        let (mut rows, mut used) = (1, width(head));
        (rows, used) = if used + across > room { (rows + lines, across) } else { (rows, used + across) };
        for link in links.iter().map(|link| width(link)) {
            (rows, used) = if used + link > room { (rows + 1, link) } else { (rows, used + link) };
        }
        rows
    };
    let learnt = if under_way.took.is_some() { &under_way.learnt[..] } else { under_way.lesson.learnt() };
    let before = rows("Task:", words(under_way.lesson.text()), &["Again", "All tasks"]);
    let after =
        rows(&format!("{}:", done_in(under_way.took.unwrap_or(30.0))), words(learnt), &["Next", "Again", "All tasks"]);
    let row = ui.text_style_height(&TextStyle::Body) + 2.0;
    before.max(after) as f32 * (row + gap.y)
}

/// Shows a hint with a box before it, which is ticked once it has been done.
fn task(ui: &mut Ui, text: &str, done: bool, look: &FrameColours) -> Response {
    let text = worded(ui, text);
    let colour = look.theme.colour(if done { Role::Muted } else { Role::Text });
    let width = ui.max_rect().width() - BOX - AFTER;
    let galley = ui.painter().layout(text.clone(), TextStyle::Body.resolve(ui.style()), colour, width);
    let (rect, response) = ui.allocate_exact_size(galley.size() + vec2(BOX + AFTER, 0.0), Sense::click());
    let spoken = if done { format!("{text} Done.") } else { text };
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Link, true, &spoken));
    let middle = 0.5 * ui.text_style_height(&TextStyle::Body) + 1.0;
    let square = Rect::from_center_size(rect.min + vec2(0.5 * BOX, middle), Vec2::splat(BOX));
    ui.painter().rect_stroke(square, 0.0, Stroke::new(1.0, look.theme.colour(Role::Muted)), StrokeKind::Inside);
    if done {
        let tick = [vec2(2.0, 5.0), vec2(4.0, 7.5), vec2(8.5, 2.0)].map(|corner| square.min + corner);
        ui.painter().add(Shape::line(tick.to_vec(), Stroke::new(1.8, look.theme.colour(Role::Free))));
    }
    ui.painter().galley(rect.min + vec2(BOX + AFTER, 0.0), galley, colour);
    if response.hovered() || response.has_focus() {
        let line = Stroke::new(1.0, look.theme.colour(Role::Focus));
        ui.painter().hline(rect.left() + BOX + AFTER..=rect.right(), rect.bottom(), line);
    }
    response
}
