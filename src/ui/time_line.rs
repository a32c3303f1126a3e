//! The time line: where the run stands, and a handle to any tick it has reached.

use bevy_egui::egui::{Slider, Ui, WidgetInfo};

use super::{Command, Dashboard};
use crate::run::DT;
use crate::simulation::TransportCommand;

/// Shows the line over the whole width. Pointing, dragging and, when it has the focus, the arrow keys seek.
pub fn time_line(ui: &mut Ui, model: &Dashboard, commands: &mut Vec<Command>) {
    let end = model.frontier.max(model.tick);
    let mut tick = model.tick;
    ui.spacing_mut().slider_width = ui.available_width();
    let line = Slider::new(&mut tick, 0..=end.max(1)).show_value(false).trailing_fill(true).step_by(1.0);
    let response = ui.add_enabled(end > 0, line);
    response.widget_info(|| WidgetInfo::slider(end > 0, model.tick as f64, "time line, in ticks"));
    let response = response.on_hover_text(format!("Drag to any of {end} ticks ({:.2} s)", DT * end as f64));
    if response.changed() && tick != model.tick {
        commands.push(Command::Transport(TransportCommand::Seek(tick.min(end))));
    }
}
