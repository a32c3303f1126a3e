//! The frame of a widget: its title, the misconception it removes, its colour key and the first hints.

use std::ops::Range;
use std::sync::Arc;

use bevy_egui::egui::{
    Color32, FontId, Galley, Label, Rect, Response, RichText, Sense, Shape, Stroke, StrokeKind, TextFormat, TextStyle,
    TextWrapMode, Ui, Vec2, WidgetInfo, WidgetType,
    text::{CCursor, LayoutJob},
    vec2,
};

use super::touch::worded;
use crate::window::ui::keys::{self, SessionAction};
use crate::window::ui::paint::style::ScreenTheme;
use crate::window::ui::{LessonState, Look, UiState, WidgetText};
use motion_lab_core::picture::Role;
use motion_lab_sim::manifest::{Deed, Formula, Hint, Lesson, Level, Term, Told, Widget};

/// Largest number of hints shown at once.
const FEW: usize = 4;

/// Side of the box before a hint, points, and the gap after it.
const BOX: f32 = 10.0;
const AFTER: f32 = 5.0;

/// Shows title and misconception. They do not fade when a role is lit.
pub fn title(ui: &mut Ui, widget: &WidgetText, look: &Look) {
    name(ui, widget, look);
    misconception(ui, widget, look);
}

/// Shows the title alone.
pub fn name(ui: &mut Ui, widget: &WidgetText, look: &Look) {
    let heading =
        ui.label(RichText::new(&widget.title).text_style(TextStyle::Heading).color(look.theme.colour(Role::Text)));
    // the widget's description, for screen readers
    heading.widget_info(|| {
        WidgetInfo::labeled(WidgetType::Label, true, format!("{}. {}", widget.title, widget.description))
    });
}

/// Shows the misconception that a widget removes.
pub fn misconception(ui: &mut Ui, widget: &WidgetText, look: &Look) {
    ui.add(Label::new(RichText::new(&widget.misconception).color(look.theme.colour(Role::Muted))).wrap());
}

/// Shows the number that matters, large.
pub fn headline(ui: &mut Ui, words: &str, colour: Color32) {
    ui.add(Label::new(RichText::new(words).text_style(TextStyle::Heading).color(colour)).wrap());
}

/// Shows the colour key in a row of its own.
pub fn key_row(ui: &mut Ui, widget: &WidgetText, look: &Look, state: &mut UiState) {
    ui.add_space(2.0);
    rows_of_words(ui, |ui| key(ui, widget, look, state));
}

/// Lays out rows that wrap and are as high as their words, not as buttons.
pub fn rows_of_words<R>(ui: &mut Ui, add: impl FnOnce(&mut Ui) -> R) -> R {
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = ui.text_style_height(&TextStyle::Body) + 2.0;
        ui.horizontal_wrapped(add).inner
    })
    .inner
}

/// Shows the colour key. Pointing at an entry, or stepping to it by Tab, lights its role.
fn key(ui: &mut Ui, widget: &WidgetText, look: &Look, state: &mut UiState) {
    ui.spacing_mut().item_spacing.x = 12.0;
    for entry in &widget.key {
        let role = entry.role();
        let text = ui.painter().layout_no_wrap(entry.text.clone(), small(ui), look.colour(Role::Text));
        let size = vec2(text.size().x + 16.0, text.size().y + 4.0);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click());
        response.widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, format!("colour key: {}", entry.text)));
        swatch(ui, role, rect.left_center() + vec2(5.0, 0.0), look);
        ui.painter().galley(rect.left_center() + vec2(16.0, -0.5 * text.size().y), text, look.colour(Role::Text));
        if response.has_focus() {
            ui.painter().rect_stroke(
                rect.expand(2.0),
                2.0,
                Stroke::new(1.0, look.colour(Role::Focus)),
                StrokeKind::Outside,
            );
        }
        points_at(state, &response, role);
    }
}

/// Paints a role's sample as the pictures draw it, so that not only colour tells roles apart.
fn swatch(ui: &Ui, role: Role, at: bevy_egui::egui::Pos2, look: &Look) {
    let (painter, colour) = (ui.painter(), look.colour(role));
    let line = Stroke::new(1.5, colour);
    let square = bevy_egui::egui::Rect::from_center_size(at, Vec2::splat(9.0));
    match role {
        Role::Obstacle => {
            painter.rect(square, 0.0, look.tint(role, 0.12), line, StrokeKind::Inside);
            for offset in [-3.0, 0.0, 3.0] {
                let d = 4.5 - f32::abs(offset);
                let c = at + vec2(offset, offset) * 0.5;
                painter.line_segment([c + vec2(-d, d) * 0.7, c + vec2(d, -d) * 0.7], Stroke::new(1.0, colour));
            }
        }
        Role::Sensor => {
            for dy in [-4.0, 0.0, 4.0] {
                painter.line_segment([at - vec2(5.0, 0.0), at + vec2(4.0, dy)], Stroke::new(1.0, colour));
                painter.circle_filled(at + vec2(4.0, dy), 1.2, colour);
            }
        }
        Role::Free => drop(painter.rect(square, 0.0, look.tint(role, 0.3), line, StrokeKind::Inside)),
        Role::Unknown => {
            for x in [-3.0, 0.0, 3.0] {
                for y in [-3.0, 0.0, 3.0] {
                    painter.circle_filled(at + vec2(x, y), 0.9, colour);
                }
            }
        }
        Role::Focus => drop(painter.rect_stroke(square, 0.0, Stroke::new(2.0, colour), StrokeKind::Inside)),
        Role::Goal => {
            // a contact is a ring in one picture, a cross in another
            painter.circle_stroke(at, 5.0, Stroke::new(1.2, colour));
            painter.line_segment([at - vec2(2.2, 2.2), at + vec2(2.2, 2.2)], line);
            painter.line_segment([at + vec2(-2.2, 2.2), at + vec2(2.2, -2.2)], line);
        }
        Role::Path | Role::Witness => drop(painter.line_segment([at - vec2(5.0, 0.0), at + vec2(5.0, 0.0)], line)),
        _ => drop(painter.circle_filled(at, 4.5, colour)),
    }
}

/// Lights a role in the next frame if something of it is pointed at or has the focus.
pub fn points_at(state: &mut UiState, response: &bevy_egui::egui::Response, role: Role) {
    if response.hovered() && rests(response) || response.has_focus() {
        state.pointed = Some(role);
    }
}

/// Whether the pointer has come to rest. Things that it only passes over light nothing.
pub fn rests(response: &bevy_egui::egui::Response) -> bool {
    const REST_SECONDS: f32 = 0.3;
    let still = response.ctx.input(|i| i.pointer.time_since_last_movement());
    if still < REST_SECONDS {
        response.ctx.request_repaint_after_secs(REST_SECONDS - still);
    }
    still >= REST_SECONDS
}

/// Shows a formula in rows that wrap, its terms in the colours of their roles. Pointing at a term lights its role, and
/// so does the focus on it; pointing at a part of the picture underlines its terms.
pub fn formula(ui: &mut Ui, formula: &Formula, spoken: &str, look: &Look, state: &mut UiState) -> Option<Response> {
    if formula.0.is_empty() {
        return None;
    }
    let mut job = job(ui, formula, look);
    // in a row it goes to the next one as a whole
    job.wrap.max_width = if ui.layout().main_wrap { ui.max_rect().width() } else { ui.available_width() };
    let galley = ui.fonts_mut(|fonts| fonts.layout_job(job));
    let (rect, response) = ui.allocate_exact_size(galley.size(), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Label, true, spoken));
    ui.painter().galley(rect.min, Arc::clone(&galley), look.colour(Role::Muted));
    let mut end = 0;
    // a term and its scripts are one
    for (i, piece) in formula.0.chunk_by(|_, next| next.level != Level::Base).enumerate() {
        let begin = end;
        end += piece.iter().map(|term| term.text.chars().count()).sum::<usize>();
        let text: String = piece.iter().map(spelled).collect();
        let Some(role) = piece.first().and_then(|term| term.role) else { continue };
        let place = span(&galley, begin..end).translate(rect.min.to_vec2());
        let term = ui.interact(place, response.id.with(i), Sense::click());
        term.widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, format!("{text}: {}", role.name())));
        points_at(state, &term, role);
        if state.over == Some(role) || term.has_focus() {
            let stroke = Stroke::new(1.5, look.theme.colour(role));
            ui.painter().hline(place.x_range(), place.bottom(), stroke);
        }
        term.on_hover_text(spoken);
    }
    Some(response.on_hover_text(spoken))
}

/// The text of a term in a line of plain letters, where a subscript has its own digits.
fn spelled(term: &Term) -> String {
    let lowered = |c: char| c.to_digit(10).and_then(|digit| char::from_u32(0x2080 + digit)).unwrap_or(c);
    if term.level == Level::Sub { term.text.chars().map(lowered).collect() } else { term.text.to_owned() }
}

/// Where these characters stand. Those of a later row than the first are left out.
fn span(galley: &Galley, characters: Range<usize>) -> Rect {
    let at = |character: usize| galley.pos_from_cursor(CCursor::new(character));
    let first = at(characters.start);
    let row =
        characters.map(|character| at(character + 1)).filter(|end| end.center().y - first.center().y < first.height());
    row.fold(first, Rect::union)
}

/// Shows the chapter's formulas of this name, each in rows of its own. Pointing at one names the code that computes it.
pub fn formulas(ui: &mut Ui, name: &str, look: &Look, state: &mut UiState) {
    for told in Told::of(name) {
        let shown = formula(ui, &told.formula, &told.spoken, look, state);
        shown.map(|response| response.on_hover_text(RichText::new(told.code).monospace()));
    }
}

/// The words of a formula.
fn job(ui: &Ui, formula: &Formula, look: &Look) -> LayoutJob {
    let body = TextStyle::Body.resolve(ui.style());
    let mut job = LayoutJob::default();
    for term in &formula.0 {
        let (size, valign) = match term.level {
            Level::Base => (body.size, bevy_egui::egui::Align::Center),
            Level::Sub => (0.7 * body.size, bevy_egui::egui::Align::BOTTOM),
            Level::Sup => (0.7 * body.size, bevy_egui::egui::Align::TOP),
        };
        let color = look.colour(term.role.unwrap_or(Role::Muted));
        let font_id = FontId::new(size, body.family.clone());
        job.append(term.text, 0.0, TextFormat { font_id, color, valign, ..TextFormat::default() });
    }
    job
}

/// Whether a hint can be followed with the robot that the widget in front shows.
fn suits(hint: &Hint, state: &UiState) -> bool {
    !hint.arm || state.anatomy.anatomy.lengths().is_some()
}

/// Shows what a new reader may try first in the widget in front, until its hints are put away.
pub fn hints(ui: &mut Ui, widget: &WidgetText, look: &Look, state: &mut UiState) {
    // what ends on the dashboard, such as a world that is run, says there that it is done
    let leads_on = |under_way: &LessonState| matches!(under_way.lesson.deed, Deed::EditWorld | Deed::PlayPath);
    let is_here = |under_way: &LessonState| {
        let ended = under_way.took.is_some() && state.widget == Widget::Dashboard && leads_on(under_way);
        under_way.lesson.widget == state.widget || ended
    };
    if let Some(under_way) = state.lesson.clone().filter(is_here) {
        return lesson(ui, &under_way, look, state);
    }
    if state.settings.are_hints_away(state.widget) {
        return;
    }
    let (top, least) = (ui.cursor().top(), rows_of_hints(ui, widget));
    rows_of_words(ui, |ui| {
        // a hint goes to the next row as a whole
        ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
        ui.label(RichText::new("Try:").color(look.theme.colour(Role::Text)).strong());
        let is_done = |hint: &&Hint| state.settings.is_ticked_off(hint.deed);
        let hints: Vec<&Hint> = widget.hints.iter().filter(|hint| suits(hint, state)).collect();
        let (count, done) = (hints.len(), hints.iter().copied().filter(is_done).count());
        // before the hints, where no row leaves them alone
        ui.weak(format!("{done} of {count}"));
        let hover = format!("Put these hints away: {}", keys::hint(SessionAction::Hints));
        let is_put_away = ui.link("Got it").on_hover_text(hover).clicked();
        // of more than fit a row, the one done last and those that come next
        let last = state.settings.done.iter().rev().find_map(|id| hints.iter().copied().find(|h| h.deed.id() == *id));
        let mut open = 0;
        let mut begun = None;
        for hint in hints {
            let is_done = is_done(&hint);
            open += usize::from(!is_done);
            let is_shown = count <= FEW || (if is_done { last == Some(hint) } else { open < FEW });
            if is_shown && task(ui, &hint.text, is_done, look).on_hover_text("Begin this task").clicked() {
                begun = Some(Lesson { deed: hint.deed, widget: state.widget });
            }
        }
        if is_put_away {
            state.settings.put_hints_away(state.widget);
        }
        if let Some(lesson) = begun {
            state.begin(lesson);
        }
    });
    // what stands below does not move when a hint gives way to a shorter one
    let missing = top + least + ui.spacing().item_spacing.y - ui.cursor().top();
    if missing > 0.0 {
        ui.add_space(missing);
    }
}

/// Whether a lesson of the widget in front has been done.
pub fn is_done_here(state: &UiState) -> bool {
    state.lesson.as_ref().is_some_and(|on| on.took.is_some() && on.lesson.widget == state.widget)
}

/// Shows the next of the hints, for the words below the picture of a narrow screen. In a lesson, whose task stands
/// above, it shows once that is done what it removes.
pub fn next_hint(ui: &mut Ui, widget: &WidgetText, look: &Look, state: &mut UiState) {
    if look.narrow && !look.low && is_done_here(state) {
        return misconception(ui, widget, look);
    }
    if !look.narrow || state.lesson.is_some() || state.settings.are_hints_away(state.widget) {
        return;
    }
    let is_open = |hint: &&Hint| !state.settings.is_ticked_off(hint.deed);
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
        state.begin(Lesson { deed: hint.deed, widget: state.widget });
    }
    ui.add_space(4.0);
}

/// Shows the task of the lesson under way in place of the hints, and once it is done what it removes.
fn lesson(ui: &mut Ui, under_way: &LessonState, look: &Look, state: &mut UiState) {
    let widget = under_way.lesson.widget.text();
    rows_of_words(ui, |ui| {
        // what is said in place of other words leaves the picture below where it is
        let (head, role) = match under_way.took {
            None => ("Task:".to_owned(), Role::Text),
            Some(took) => (format!("Done in {took:.0} s:"), Role::Free),
        };
        ui.label(RichText::new(head).color(look.theme.colour(role)).strong());
        let mut is_begun = task(ui, under_way.lesson.text(), under_way.took.is_some(), look).clicked();
        // in its own widget it stands above already, or on a narrow screen below the picture
        if under_way.took.is_some() && under_way.lesson.widget != state.widget {
            misconception(ui, widget, look);
        }
        is_begun |= ui.link("Again").on_hover_text("Begin this task anew").clicked();
        if ui.link("All tasks").clicked() {
            state.lesson = None;
            state.settings.show_hints(state.widget);
        } else if is_begun {
            state.begin(under_way.lesson);
        }
    });
}

/// The greatest height that the hints of a widget take at this width, whatever is done of them.
fn rows_of_hints(ui: &Ui, widget: &WidgetText) -> f32 {
    let font = TextStyle::Body.resolve(ui.style());
    let width = |text: &str| ui.painter().layout_no_wrap(text.to_owned(), font.clone(), Color32::PLACEHOLDER).size().x;
    let gap = ui.spacing().item_spacing;
    // a point more, for rounding
    let head = ["Try:", "0 of 0", "Got it"].map(|word| width(word) + gap.x + 1.0).iter().sum();
    let hints: Vec<f32> = widget.hints.iter().map(|hint| width(&hint.text) + BOX + AFTER + gap.x + 1.0).collect();
    let rows = most_rows(&hints, head, ui.available_width() + gap.x);
    let row = ui.text_style_height(&TextStyle::Body) + 2.0;
    rows as f32 * (row + gap.y) - gap.y
}

/// The largest number of rows for hints of these widths behind a head, over all that may be done and be done last.
fn most_rows(hints: &[f32], head: f32, room: f32) -> u32 {
    let sets = 1_u32 << hints.len().min(10);
    let is_in = |set: u32, i: usize| set >> i & 1 == 1;
    let rows = |done: u32, last: Option<usize>| {
        let (mut rows, mut used, mut open) = (1, head, 0);
        for (i, hint) in hints.iter().enumerate() {
            open += usize::from(!is_in(done, i));
            let is_shown = hints.len() <= FEW || (if is_in(done, i) { last == Some(i) } else { open < FEW });
            if !is_shown {
                continue;
            }
            (rows, used) = if used + hint > room { (rows + 1, *hint) } else { (rows, used + hint) };
        }
        rows
    };
    let states = (0..sets).flat_map(|done| (0..=hints.len()).map(move |last| (done, last)));
    states.map(|(done, last)| rows(done, Some(last).filter(|i| is_in(done, *i)))).max().unwrap_or(1)
}

/// Shows a hint with a box before it, which is ticked once it has been done.
fn task(ui: &mut Ui, text: &str, done: bool, look: &Look) -> Response {
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

fn small(ui: &Ui) -> FontId {
    TextStyle::Small.resolve(ui.style())
}

/// Height of a row of a list, points: for a mouse, or for a finger where controls are that high.
pub fn row_height(ui: &Ui) -> f32 {
    if ui.spacing().interact_size.y > 40.0 { 44.0 } else { 22.0 }
}
