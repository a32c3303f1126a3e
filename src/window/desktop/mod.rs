//! What only a window on a desktop has: files, dialogs, the clipboard, and what is kept from one start to the next.

pub(super) mod capture;
pub(super) mod clipboard;
pub(super) mod dialogs;
pub(super) mod files;
mod idle;
pub(super) mod persistence;
pub(super) mod window;

use bevy::prelude::*;
use bevy::window::WindowTheme;

use super::lab_systems::LabSystems;
use crate::window::ui::{Interface, SessionCommand};
use motion_lab_core::picture::Theme;

pub use window::{Opened, WindowError, open_in_window, run_window, run_window_with};

/// Carries out a command that only a desktop has; others are left to those who ask for a file.
pub(super) fn carry_out(world: &mut World, command: SessionCommand) {
    match command {
        SessionCommand::OpenRecent(path) => files::open_recent(world, &path),
        SessionCommand::CopyPicture(order) => capture::copy_picture(world, &order),
        command => _ = world.write_message(command),
    }
}

/// Restores the settings, before the window is made.
pub(super) fn add_settings(app: &mut App) {
    app.add_plugins(persistence::settings::PersistSettingsPlugin);
}

/// Adds what a desktop has.
pub(super) fn add(app: &mut App) {
    // on the web, the page sends the system's theme, and says when somebody touches the lab
    app.add_systems(Update, system_theme)
        .init_resource::<dialogs::Dialogs>()
        .init_resource::<capture::Capturing>()
        .init_resource::<clipboard::Clipboard>()
        .add_plugins(persistence::autosave::AutosavePlugin::default())
        .add_systems(Update, window::close)
        .add_systems(Last, idle::sleep)
        .add_systems(Update, (dialogs::ask, dialogs::dropped, capture::follow).chain().before(LabSystems::Read));
}

/// Adds Bevy's own plugins, with this one for the window.
pub(super) fn add_default_plugins(app: &mut App, window: WindowPlugin) {
    app.add_plugins(DefaultPlugins.set(window).set(quiet_log()));
}

/// The log without the graphics layers, whose long messages `run_window` replaces by one line.
fn quiet_log() -> bevy::log::LogPlugin {
    let filter = "wgpu_hal=off,wgpu_core=off,naga=off".into();
    bevy::log::LogPlugin { level: bevy::log::Level::ERROR, filter, ..default() }
}

/// Follows the system from light to dark and back. The theme is light where the system does not say.
fn system_theme(windows: Query<&Window, Changed<Window>>, mut interface: ResMut<Interface>) {
    for window in &windows {
        let theme = match window.window_theme {
            Some(WindowTheme::Dark) => Theme::Dark,
            _ => Theme::Light,
        };
        if interface.0.screen.system_theme != theme {
            interface.0.screen.system_theme = theme;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_terminal_shows_errors_only() {
        let plugin = quiet_log();
        assert_eq!(plugin.level, bevy::log::Level::ERROR);
        let loud: Vec<&str> = plugin.filter.split(',').filter(|part| !part.ends_with("=off")).collect();
        assert!(loud.is_empty(), "{loud:?}");
    }
}
