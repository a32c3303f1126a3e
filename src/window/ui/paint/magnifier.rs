//! Magnifying a world: the wheel and two fingers magnify it, dragging moves it, and buttons stand on its paper.

use bevy_egui::egui::{
    Align, CursorIcon, Layout, Rect, Response, Ui, UiBuilder, Vec2, WidgetInfo, WidgetType, pos2, vec2,
};

use super::button::LabButton;
use super::camera::{Camera, STEP};
use crate::window::ui::FrameColours;
use motion_lab_core::geometry::{Aabb, Point2};
use motion_lab_core::num::exp;
use motion_lab_core::picture::Fit;

/// How a world lies on its paper as `camera` shows it, moved as the pointer asks. It lies whole there as `whole` says.
/// Two fingers that pinch and Ctrl with the wheel magnify it always, the wheel alone where that is asked for. Returns
/// also whether the pointer has moved it.
pub fn magnified(
    ui: &Ui,
    response: &Response,
    camera: &mut Camera,
    whole: &Fit,
    bounds: &Aabb,
    wheel: bool,
) -> (Fit, bool) {
    camera.settle(whole);
    let scale = f64::from(ui.pixels_per_point());
    let mut by = Vec2::ZERO;
    if camera.zoom > 1.0 && response.dragged() {
        by = response.drag_delta();
        let (centre, scale) = (camera.middle(bounds), whole.px_per_metre() * camera.zoom);
        camera.look_at(Point2::new(centre.x - f64::from(by.x) / scale, centre.y + f64::from(by.y) / scale), bounds);
        ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
    }
    // also where something on the paper is under the pointer
    let over = ui.input(|i| i.pointer.hover_pos()).filter(|_| ui.rect_contains_pointer(response.rect));
    if let Some(at) = over {
        let fingers = ui.input(|i| f64::from(i.zoom_delta()));
        // what magnifies does not also scroll what the paper lies in
        let wheel = if wheel { ui.input_mut(|i| std::mem::take(&mut i.smooth_scroll_delta.y)) } else { 0.0 };
        let factor = fingers * exp(f64::from(wheel) / 240.0);
        if factor != 1.0 {
            let fit = camera.fit(whole, bounds, scale);
            camera.zoom_at(fit.world_from_screen([f64::from(at.x), f64::from(at.y)]), factor, whole, bounds);
        }
    }
    (camera.fit(whole, bounds, scale), by != Vec2::ZERO)
}

/// Width that the buttons take, points: three of a fingertip's size.
pub const BUTTONS: f32 = 160.0;

/// Shows the buttons that magnify, in the paper's upper right corner, where they are asked for.
pub fn magnifier(
    ui: &mut Ui,
    paper: Rect,
    are_shown: bool,
    camera: &mut Camera,
    whole: &Fit,
    bounds: &Aabb,
    look: &FrameColours,
) {
    let side = ui.spacing().interact_size.y;
    let corner =
        Rect::from_min_max(paper.left_top() + vec2(8.0, 8.0), pos2(paper.right() - 8.0, paper.top() + 8.0 + side));
    let mut ui = ui.new_child(UiBuilder::new().max_rect(corner).layout(Layout::right_to_left(Align::Center)));
    camera.settle(whole);
    if !are_shown {
        // the room was made all the same: what comes later keeps its number, and with it the focus
        return;
    }
    let mut button = |label: &str, words: &str, width: f32| {
        let shown = LabButton::new(label).width(width).show(&mut ui, look);
        shown.widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, words));
        shown.on_hover_text(words).clicked()
    };
    if button("Fit", "show the whole world", 0.0) {
        *camera = Camera::default();
    }
    if button("\u{2212}", "show more of the world", side) {
        camera.magnify(1.0 / STEP, bounds);
    }
    if button("+", "magnify", side) {
        camera.magnify(STEP, bounds);
    }
    camera.settle(whole);
}
