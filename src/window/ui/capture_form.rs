//! The capture form: the choice of file format, size, and for a GIF the span of ticks.

use bevy_egui::egui::{
    Context, DragValue, Grid, Id, Key, Modal, Modifiers, RichText, TextStyle, Ui, WidgetInfo, WidgetType,
};

use super::paint::button::LabButton;
use super::paint::plate::refusal as refusal_words;
use super::{CaptureOrder, Command, Dashboard, FrameColours, SessionCommand, UiState};
use motion_lab_core::picture::Role;
use motion_lab_sim::capture::{CaptureError, CaptureForm, CaptureSpan};
use motion_lab_sim::manifest::Widget;
use motion_lab_sim::run::DT;

/// Label of the button that starts the capture. On the web the browser receives the file, so there is none to choose.
const SAVE: &str = if cfg!(target_family = "wasm") { "Save" } else { "Choose a file" };

/// Initial length of a GIF's span, ticks: ten seconds.
const SPAN: u64 = 200;

impl UiState {
    /// Opens the form. The proposed span of a GIF ends at the present tick, or at the last tick reached when that is 0.
    pub fn ask_for_capture(&mut self, model: &Dashboard) {
        let to = if model.tick > 0 { model.tick } else { model.frontier };
        self.capture.order.span = CaptureSpan { from: to.saturating_sub(SPAN), to, ..self.capture.order.span };
        self.capture.open = true;
    }
}

/// Shows the form over everything else while it is open. Esc, its button or a click beside it closes it.
pub fn capture_form(
    ctx: &Context,
    model: &Dashboard,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    if !state.capture.open {
        return;
    }
    let title = &state.widget.text().title;
    let order = &mut state.capture.order;
    let refusal = refusal(state.widget, order, model);
    let modal = Modal::new(Id::new("capture")).show(ctx, |ui| {
        ui.set_max_width((ctx.content_rect().width() - 48.0).clamp(40.0, 400.0));
        ui.label(RichText::new(format!("Capture: {title}")).text_style(TextStyle::Heading));
        ui.add_space(6.0);
        Grid::new("capture").num_columns(2).spacing([16.0, 8.0]).show(ui, |ui| choices(ui, model, look, order));
        ui.add_space(4.0);
        match &refusal {
            Some(words) => refusal_words(ui, words, look),
            None => drop(ui.label(RichText::new(holds(state.widget, order)).color(look.colour(Role::Muted)))),
        }
        ui.add_space(8.0);
        ui.horizontal(|ui| {
            let chosen = LabButton::new(SAVE).enabled(refusal.is_none()).show(ui, look).clicked();
            if chosen {
                commands.push(Command::Session(SessionCommand::Capture(*order)));
            }
            let chosen = chosen | copy(ui, look, order, commands);
            (chosen, LabButton::new("Cancel").show(ui, look).clicked())
        })
        .inner
    });
    let (chosen, cancelled) = modal.inner;
    let escape = ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape));
    if chosen || cancelled || modal.backdrop_response.clicked() || escape {
        state.capture.open = false;
    }
}

/// Shows the button that copies the widget as it stands, whatever the form. Returns whether it was pressed.
pub(super) fn copy(ui: &mut Ui, look: &FrameColours, order: &CaptureOrder, commands: &mut Vec<Command>) -> bool {
    let button = LabButton::new("Copy picture").show(ui, look);
    let pressed = button.on_hover_text("puts the picture as it stands on the clipboard").clicked();
    if pressed {
        commands.push(Command::Session(SessionCommand::CopyPicture(*order)));
    }
    pressed
}

fn choices(ui: &mut Ui, model: &Dashboard, look: &FrameColours, order: &mut CaptureOrder) {
    ui.label("form");
    ui.horizontal(|ui| {
        for form in CaptureForm::ALL {
            if LabButton::new(form.name()).selected(order.form == form).show(ui, look).clicked() {
                order.form = form;
            }
        }
    });
    ui.end_row();
    ui.label("width");
    ui.horizontal(|ui| {
        for (width, name) in [(640, "column, 640"), (1280, "page, 1280")] {
            if LabButton::new(name).selected(order.width == width).show(ui, look).clicked() {
                order.width = width;
            }
        }
    });
    ui.end_row();
    if order.form != CaptureForm::Svg {
        ui.label("dots a pixel");
        ui.horizontal(|ui| {
            for scale in 1..=3 {
                if LabButton::new(&format!("{scale}\u{d7}")).selected(order.scale == scale).show(ui, look).clicked() {
                    order.scale = scale;
                }
            }
        });
        ui.end_row();
    }
    if order.form == CaptureForm::Gif {
        ui.label("ticks");
        ui.horizontal(|ui| {
            let CaptureSpan { from, to, every } = &mut order.span;
            for (name, value, least, most) in
                [("from", from, 0, model.frontier), ("to", to, 0, model.frontier), ("every", every, 1, 1000)]
            {
                ui.label(name);
                let spoken = if name == "every" {
                    "GIF: ticks between pictures".to_owned()
                } else {
                    format!("GIF: {name} tick")
                };
                let field = ui.add(DragValue::new(value).range(least..=most));
                field.widget_info(|| WidgetInfo::labeled(WidgetType::DragValue, true, &spoken));
            }
        });
        ui.end_row();
    }
}

/// The reason why the order cannot be carried out; `None` if it can.
fn refusal(widget: Widget, order: &CaptureOrder, model: &Dashboard) -> Option<String> {
    if order.form != CaptureForm::Gif {
        return None;
    }
    if widget == Widget::Anatomy {
        return Some(format!("{}. Choose PNG or SVG.", CaptureError::Frozen));
    }
    order.span.within(model.frontier).err().map(|error| match model.frontier {
        0 => "nothing has been run yet: press Play first".into(),
        _ => error.to_string(),
    })
}

/// A line about what the file will hold.
fn holds(widget: Widget, order: &CaptureOrder) -> String {
    if order.form == CaptureForm::Gif {
        let (pictures, seconds) = (order.span.pictures(), DT * (order.span.to - order.span.from) as f64);
        return format!("{pictures} pictures, {seconds:.2} s of the run; seed, digest and ticks in its comment");
    }
    let what = if widget == Widget::Dashboard {
        "seed, digest and tick"
    } else {
        "the world's content hash and the configuration"
    };
    format!("{what} in its metadata")
}
