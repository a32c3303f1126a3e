//! The menu of the files opened or saved last.

use bevy_egui::egui::Ui;

use super::paint::button::LabButton;
use super::{Command, FrameColours, Recent, SessionCommand};

/// Shows the list as a menu of its own, by the names of the files, with their folders on hover. Without files there is
/// none.
pub fn recent_menu(ui: &mut Ui, recent: &Recent, look: &FrameColours, commands: &mut Vec<Command>) {
    if recent.files().is_empty() {
        return;
    }
    ui.menu_button("Recent files", |ui| {
        for path in recent.files() {
            let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
            let folder = path.parent().map(|folder| folder.display().to_string()).unwrap_or_default();
            // two files of one name in two folders have their folders in the list
            let is_alone = recent.files().iter().filter(|other| other.file_name() == path.file_name()).count() == 1;
            let label = if is_alone { name.into_owned() } else { path.display().to_string() };
            if LabButton::new(&label).show(ui, look).on_hover_text(folder).clicked() {
                commands.push(Command::Session(SessionCommand::OpenRecent(path.clone())));
            }
        }
    });
}
