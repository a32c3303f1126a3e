//! Formulas of the chapter, whose terms light what they name.

use std::ops::Range;
use std::sync::Arc;

use bevy_egui::egui::{
    FontId, Galley, Rect, Response, RichText, Sense, Stroke, TextFormat, TextStyle, Ui, WidgetInfo, WidgetType,
    text::{CCursor, LayoutJob},
};

use super::title::points_at;
use crate::window::ui::paint::style::ScreenTheme;
use crate::window::ui::{FrameColours, UiState};
use motion_lab_core::picture::Role;
use motion_lab_sim::manifest::{ChapterFormula, Formula, Level, Term};

/// Shows a formula in rows that wrap, its terms in the colours of their roles. Pointing at a term lights its role, and
/// so does the focus on it; pointing at a part of the picture underlines its terms.
pub fn formula(
    ui: &mut Ui,
    formula: &Formula,
    spoken: &str,
    look: &FrameColours,
    state: &mut UiState,
) -> Option<Response> {
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
        let term = ui.interact(place, response.id.with(("term", i)), Sense::click());
        term.widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, format!("{text}: {}", role.name())));
        points_at(state, &term, role);
        if state.pointer.over == Some(role) || term.has_focus() {
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
pub fn formulas(ui: &mut Ui, name: &str, look: &FrameColours, state: &mut UiState) {
    for entry in ChapterFormula::of(name) {
        let shown = formula(ui, &entry.formula, &entry.spoken, look, state);
        shown.map(|response| response.on_hover_text(RichText::new(entry.code).monospace()));
    }
}

/// The words of a formula.
fn job(ui: &Ui, formula: &Formula, look: &FrameColours) -> LayoutJob {
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
