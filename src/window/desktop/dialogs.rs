//! The dialogs that ask for a file, and files dropped on the window.

use std::path::PathBuf;

use bevy::prelude::*;
use bevy::window::FileDragAndDrop;
use bevy_egui::egui;

use super::capture::{capture, check, not_captured};
use super::files::{PATH, WORLD, open_any, open_path, open_run, open_world, save_path, save_run, save_world};
use crate::window::error::SessionError;
use crate::window::ui::paint::style::ScreenTheme;
use crate::window::ui::{CaptureOrder, Interface, Notice, SessionCommand, UiState};
use egui_file_dialog::{DialogMode, DialogState, FileDialog, FileDialogLabels};
use motion_lab_core::picture::Role;
use motion_lab_core::random::Seed;
use motion_lab_sim::manifest::Widget;
use motion_lab_sim::simulation::{Playback, RunConfig, Transport};

/// File extension of the lab's logs.
const EXTENSION: &str = "mcap";

/// Width and height of a dialog, points: a name of thirty letters beside the choice of the form, and in a window of
/// 800 x 600 all of it. A smaller window has a smaller one.
const SIZE: [f32; 2] = [720.0, 420.0];

/// The dialogs, and whether a file hovers over the window.
#[derive(Resource)]
pub struct Dialogs {
    runs: FileDialog,
    worlds: FileDialog,
    paths: FileDialog,
    /// The dialog for a capture's file, and the order.
    picture: Option<(FileDialog, CaptureOrder)>,
    /// Whether a file hovers over the window, on its way to be dropped.
    hovered: bool,
}

impl Default for Dialogs {
    fn default() -> Self {
        Dialogs {
            runs: dialog("run", "Runs (*.mcap)", EXTENSION, "run.mcap"),
            worlds: dialog("world", "Worlds (*.ron)", WORLD, "world.ron"),
            paths: dialog("path", "Paths (*.json)", PATH, "path.json"),
            picture: None,
            hovered: false,
        }
    }
}

impl Dialogs {
    /// Whether one of them is open.
    fn are_open(&self) -> bool {
        let picture = self.picture.iter().map(|(dialog, _)| dialog);
        [&self.runs, &self.worlds, &self.paths]
            .into_iter()
            .chain(picture)
            .any(|dialog| *dialog.state() == DialogState::Open)
    }
}

/// The dialog for a capture of the widget in front.
fn picture_dialog(state: &UiState, order: &CaptureOrder, seed: Seed, tick: u64) -> FileDialog {
    let (extension, name) = (order.form.extension(), order.form.name());
    let widget = state.widget.id();
    let file = if state.widget == Widget::Dashboard {
        format!("{widget}-{seed}-{tick}.{extension}")
    } else {
        format!("{widget}.{extension}")
    };
    dialog("picture", &format!("{name} (*.{extension})"), extension, &file)
}

fn dialog(what: &'static str, filter: &str, extension: &'static str, file: &str) -> FileDialog {
    let labels = FileDialogLabels {
        title_select_file: format!("Open a {what}"),
        title_save_file: format!("Save the {what}"),
        ..default()
    };
    FileDialog::new()
        .id(what)
        .labels(labels)
        .add_file_filter_extensions(filter, vec![extension])
        .default_file_filter(filter)
        .add_save_extension(what, extension)
        .default_save_extension(what)
        .default_file_name(file)
        .show_search(false)
        .show_menu_button(false)
        .default_size(SIZE)
        .anchor(egui::Align2::CENTER_CENTER, [0.0, 0.0])
}

/// Opens the dialog that a command asks for, and pauses the run.
pub fn ask(
    mut asked: MessageReader<SessionCommand>,
    mut dialogs: ResMut<Dialogs>,
    mut transport: ResMut<Transport>,
    mut interface: ResMut<Interface>,
    config: Option<Res<RunConfig>>,
) {
    let Some(config) = config else { return };
    for command in asked.read() {
        match command {
            SessionCommand::Save if transport.frontier() == 0 => {
                // before a file is named for it
                interface.0.say(Notice { text: SessionError::NotRun.to_string(), is_error: true });
                continue;
            }
            SessionCommand::Save => {
                dialogs.runs.config_mut().default_file_name = format!("run-{}.{EXTENSION}", transport.seed());
                dialogs.runs.save_file();
            }
            SessionCommand::Open => dialogs.runs.pick_file(),
            SessionCommand::SaveWorld => {
                dialogs.worlds.config_mut().default_file_name = interface.0.atlas.file_name();
                dialogs.worlds.save_file();
            }
            SessionCommand::OpenWorld => dialogs.worlds.pick_file(),
            SessionCommand::SavePath => dialogs.paths.save_file(),
            SessionCommand::OpenPath => dialogs.paths.pick_file(),
            SessionCommand::Capture(order) => {
                if let Err(error) = check(config.config(), &interface.0, order) {
                    interface.0.say(not_captured(&error));
                    continue;
                }
                let mut dialog = picture_dialog(&interface.0, order, transport.seed(), transport.tick());
                dialog.save_file();
                dialogs.picture = Some((dialog, *order));
            }
            SessionCommand::PlayPath
            | SessionCommand::Why
            | SessionCommand::PlayWayOut
            | SessionCommand::RunWorld
            | SessionCommand::ThreeRobots
            | SessionCommand::RunFromHere
            | SessionCommand::PutRobot { .. }
            | SessionCommand::OpenRecent(_)
            | SessionCommand::CopyPicture(_)
            | SessionCommand::Links { .. } => continue,
        }
        transport.playback = Playback::Paused;
    }
    interface.0.focus.dialog = dialogs.are_open();
}

/// Opens what was dropped: a world in the atlas, a path in the plan, any other file as a run.
pub fn dropped(world: &mut World) {
    let events: Vec<FileDragAndDrop> = world.resource_mut::<Messages<FileDragAndDrop>>().drain().collect();
    for event in events {
        let hovered = matches!(event, FileDragAndDrop::HoveredFile { .. });
        world.resource_mut::<Dialogs>().hovered = hovered;
        if let FileDragAndDrop::DroppedFile { path_buf, .. } = event
            && let Some(notice) = open_any(world, &path_buf)
        {
            world.resource_mut::<Interface>().0.say(notice);
        }
    }
}

/// Shows the dialogs while they are open, and carries out what was chosen in them.
pub fn show(world: &mut World, ctx: &egui::Context) {
    // the dialogs write the name of the file that is selected in the colour that lies behind what is selected
    let (before, theme) = (ctx.global_style(), world.resource::<Interface>().0.theme());
    let selection = egui::style::Selection {
        bg_fill: theme.colour(Role::Focus),
        stroke: egui::Stroke::new(1.0, theme.colour(Role::Paper)),
    };
    if world.resource::<Dialogs>().are_open() {
        ctx.global_style_mut(|style| style.visuals.selection = selection);
    }
    let (run, model, plan, picture) = {
        let dialogs = world.resource_mut::<Dialogs>().into_inner();
        if dialogs.hovered {
            egui::Area::new("drop".into()).anchor(egui::Align2::CENTER_CENTER, [0.0, 0.0]).show(ctx, |ui| {
                egui::Frame::popup(ui.style()).show(ui, |ui| ui.heading("Drop a run, a world or a path to open it"));
            });
        }
        let picture = dialogs.picture.as_mut().and_then(|(dialog, order)| Some((picked(dialog, ctx)?.1, *order)));
        (picked(&mut dialogs.runs, ctx), picked(&mut dialogs.worlds, ctx), picked(&mut dialogs.paths, ctx), picture)
    };
    ctx.set_global_style(before);
    if let Some((path, order)) = picture {
        capture(world, &order, &path);
        ctx.request_repaint();
    }
    let are_open = world.resource::<Dialogs>().are_open();
    world.resource_mut::<Interface>().0.focus.dialog = are_open;
    let of_run = run.and_then(|(save, path)| if save { save_run(world, &path) } else { open_run(world, &path) });
    let of_world = model.map(|(save, path)| if save { save_world(world, &path) } else { open_world(world, &path) });
    let of_plan =
        plan.and_then(|(save, path)| if save { save_path(world, &path) } else { Some(open_path(world, &path)) });
    if let Some(notice) = of_run.or(of_world).or(of_plan) {
        world.resource_mut::<Interface>().0.say(notice);
        ctx.request_repaint();
    }
}

/// Shows a dialog while it is open. Returns the file chosen in it, and whether to save there.
fn picked(dialog: &mut FileDialog, ctx: &egui::Context) -> Option<(bool, PathBuf)> {
    dialog.update(ctx);
    let save = dialog.mode() == DialogMode::SaveFile;
    dialog.take_picked().map(|path| (save, path))
}
