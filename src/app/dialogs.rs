//! The dialogs that ask for a file, and files dropped on the window.

use std::path::PathBuf;

use bevy::prelude::*;
use bevy::window::FileDragAndDrop;
use bevy_egui::egui;
use egui_file_dialog::{DialogMode, FileDialog, FileDialogLabels};

use super::files::{open_run, save_run};
use super::session::Interface;
use crate::simulation::{Playback, Transport};
use crate::ui::SessionCommand;

/// What the lab's logs are called.
const EXTENSION: &str = "mcap";

/// The dialog, and whether something hovers over the window.
#[derive(Resource)]
pub struct Dialogs {
    dialog: FileDialog,
    /// Whether a file hovers over the window, on its way to be dropped.
    hovered: bool,
}

impl Default for Dialogs {
    fn default() -> Self {
        let labels = FileDialogLabels {
            title_select_file: "Open a run".into(),
            title_save_file: "Save the run".into(),
            ..default()
        };
        let dialog = FileDialog::new()
            .labels(labels)
            .add_file_filter_extensions("Runs (*.mcap)", vec![EXTENSION])
            .default_file_filter("Runs (*.mcap)")
            .add_save_extension("Run", EXTENSION)
            .default_save_extension("Run")
            .default_file_name("run.mcap")
            .show_search(false)
            .default_size([560.0, 380.0])
            .anchor(egui::Align2::CENTER_CENTER, [0.0, 0.0]);
        Dialogs { dialog, hovered: false }
    }
}

/// Opens the dialog that a command asks for. The run pauses meanwhile.
pub fn ask(mut asked: MessageReader<SessionCommand>, mut dialogs: ResMut<Dialogs>, mut transport: ResMut<Transport>) {
    for command in asked.read() {
        match command {
            SessionCommand::Save => dialogs.dialog.save_file(),
            SessionCommand::Open => dialogs.dialog.pick_file(),
            SessionCommand::Links { .. } => continue,
        }
        transport.playback = Playback::Paused;
    }
}

/// Takes what was dropped.
pub fn dropped(world: &mut World) {
    let events: Vec<FileDragAndDrop> = world.resource_mut::<Messages<FileDragAndDrop>>().drain().collect();
    for event in events {
        let hovered = matches!(event, FileDragAndDrop::HoveredFile { .. });
        world.resource_mut::<Dialogs>().hovered = hovered;
        if let FileDragAndDrop::DroppedFile { path_buf, .. } = event {
            let notice = open_run(world, &path_buf);
            world.resource_mut::<Interface>().0.notice = Some(notice);
        }
    }
}

/// Shows the dialog while it is open, and does what was chosen in it.
pub fn show(world: &mut World, ctx: &egui::Context) {
    let picked: Option<(DialogMode, PathBuf)> = {
        let mut dialogs = world.resource_mut::<Dialogs>();
        dialogs.dialog.update(ctx);
        if dialogs.hovered {
            egui::Area::new("drop".into()).anchor(egui::Align2::CENTER_CENTER, [0.0, 0.0]).show(ctx, |ui| {
                egui::Frame::popup(ui.style()).show(ui, |ui| ui.heading("Drop a run to open it"));
            });
        }
        let mode = dialogs.dialog.mode();
        dialogs.dialog.take_picked().map(|path| (mode, path))
    };
    let Some((mode, path)) = picked else { return };
    let notice = if mode == DialogMode::SaveFile { save_run(world, &path) } else { open_run(world, &path) };
    world.resource_mut::<Interface>().0.notice = Some(notice);
    ctx.request_repaint();
}
