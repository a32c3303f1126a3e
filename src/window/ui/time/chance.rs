//! `ShownChance`, the last chance to avoid a contact, on the time line.

use std::sync::Arc;

use bevy_egui::egui::{CursorIcon, Rect, Sense, Shape, Stroke, Ui, WidgetInfo, WidgetType, pos2, vec2};

use crate::window::ui::FrameColours;
use motion_lab_core::picture::Role;
use motion_lab_sim::avoid::Evasion;
use motion_lab_sim::run::seconds;
use motion_lab_sim::tour::TourConfig;

/// Half the width of the flag, points, and of what is pointed at.
const HALF: f32 = 4.5;
const POINTED: f32 = 10.0;

/// The last chance to avoid a contact of the run on the screen.
#[derive(Clone, Debug)]
pub struct ShownChance {
    /// The robot's id.
    pub robot: u32,
    /// The first tick in contact.
    pub contact: u64,
    /// The way out: by going on where there is one, else by stopping.
    pub way_out: Option<Evasion>,
    /// What is known of it, in words.
    pub text: String,
    /// The settings of the run.
    pub config: Arc<TourConfig>,
    /// Whether its way out is asked for.
    pub is_asked: bool,
}

impl ShownChance {
    /// Shows the ticks from the last chance to the contact as a band of a lane, with a flag at the last chance; `x` is
    /// where a tick is. Returns whether the way out is asked for.
    pub fn show(&self, ui: &Ui, lane: Rect, x: impl Fn(u64) -> f32, look: &FrameColours) -> bool {
        let Some(way_out) = &self.way_out else { return false };
        let (from, to) = (x(way_out.tick), x(self.contact));
        let band = Rect::from_x_y_ranges(from..=to, lane.center().y - 1.5..=lane.center().y + 1.5);
        ui.painter().rect_filled(band.intersect(lane), 0.0, look.tint(Role::Goal, 0.5));
        if !lane.x_range().contains(from) {
            return false;
        }
        // a triangle that points on, as the sign that plays
        let at = pos2(from, lane.center().y);
        let corners = [vec2(-HALF, -HALF), vec2(HALF, 0.0), vec2(-HALF, HALF)].map(|d| at + d);
        ui.painter().add(Shape::convex_polygon(corners.to_vec(), look.colour(Role::Free), Stroke::NONE));
        let pointed = Rect::from_center_size(at, vec2(POINTED, lane.height()));
        let response = ui.interact(pointed, ui.id().with("way out"), Sense::click());
        let words = format!("play the way out, from {:.2} s on", seconds(way_out.tick));
        response.widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, &words));
        response.on_hover_cursor(CursorIcon::PointingHand).on_hover_text(words.clone()).clicked()
    }
}
