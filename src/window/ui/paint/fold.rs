//! `fold`, a header that folds what is under it, `menu` and `form`: assistive technology hears whether they are open.

use bevy_egui::egui::containers::menu::{MenuButton, MenuConfig};
use bevy_egui::egui::{CollapsingHeader, PopupCloseBehavior, Response, ScrollArea, Ui};

/// Shows a header and, while it is open, what `show` shows under it. It begins open if `is_open`.
pub fn fold<R>(ui: &mut Ui, name: &str, is_open: bool, show: impl FnOnce(&mut Ui) -> R) {
    let shown = CollapsingHeader::new(name).default_open(is_open).show(ui, show);
    tell(&shown.header_response, shown.body_response.is_some());
}

/// As [`fold`], at first closed, and open whatever was done as long as it `has_to_be`.
pub fn unfolding<R>(ui: &mut Ui, name: &str, has_to_be: bool, show: impl FnOnce(&mut Ui) -> R) {
    let shown = CollapsingHeader::new(name).open(has_to_be.then_some(true)).show(ui, show);
    tell(&shown.header_response, shown.body_response.is_some());
}

/// Shows a button that opens a menu of what `show` shows, from its top. What has no room under the button is scrolled
/// to.
pub fn menu<R>(ui: &mut Ui, name: &str, show: impl FnOnce(&mut Ui) -> R) {
    let window = ui.ctx().content_rect();
    let under = window.bottom() - ui.cursor().top() - 2.0 * ui.spacing().interact_size.y;
    let most = under.max(0.5 * window.height());
    // opened anew, it is another area, which is not scrolled yet
    let count = ui.id().with(("opened", name));
    let opened: u32 = ui.data(|data| data.get_temp(count)).unwrap_or_default();
    let shown = ui.menu_button(name, |ui| {
        // egui gives a menu 400 points
        ui.set_max_height(most);
        ScrollArea::vertical().id_salt(opened).max_height(most).show(ui, show).inner
    });
    if shown.response.clicked() {
        ui.data_mut(|data| data.insert_temp(count, opened + 1));
    }
    tell(&shown.response, shown.inner.is_some());
}

/// As [`menu`], of fields as well: it stays while they are used, until something beside it is clicked or `show` closes
/// it.
pub fn form<R>(ui: &mut Ui, name: &str, show: impl FnOnce(&mut Ui) -> R) {
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let (response, shown) = MenuButton::new(name).config(config).ui(ui, show);
    tell(&response, shown.is_some());
}

fn tell(header: &Response, is_open: bool) {
    header.ctx.accesskit_node_builder(header.id, |node| node.set_expanded(is_open));
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use bevy_egui::egui::{CentralPanel, Context, Event, Key, Modifiers, RawInput};

    use super::*;

    /// Runs a pass with these events; returns whether each header that can be open is.
    fn pass(context: &Context, events: Vec<Event>) -> Vec<(String, bool)> {
        let shown = Cell::new(false);
        let mut output = context.run_ui(RawInput { events, ..RawInput::default() }, |ui| {
            CentralPanel::default().show(ui, |ui| {
                fold(ui, "Guess first", false, |ui| {
                    shown.set(true);
                    ui.label("words")
                });
                fold(ui, "Start", true, |ui| ui.label("numbers"));
                ui.button("Copy").clicked()
            });
        });
        output.textures_delta.clear();
        let update = output.platform_output.accesskit_update.expect("a tree");
        let all = update.nodes.iter().filter_map(|(_, node)| Some((node.label()?.to_owned(), node.is_expanded()?)));
        let mut all: Vec<(String, bool)> = all.collect();
        all.sort();
        assert_eq!(all.first().is_some_and(|(_, open)| *open), shown.get(), "what is open is shown");
        all
    }

    #[test]
    fn a_header_says_whether_it_is_open() {
        let context = Context::default();
        context.enable_accesskit();
        let of = |first| vec![("Guess first".to_owned(), first), ("Start".to_owned(), true)];
        assert_eq!(pass(&context, vec![]), of(false));
        let press =
            |key| Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE };
        pass(&context, vec![press(Key::Tab)]);
        pass(&context, vec![press(Key::Space)]);
        assert_eq!(pass(&context, vec![]), of(true));
    }
}
