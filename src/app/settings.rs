//! Settings kept in a file from one start to the next.

use std::time::Duration;

use bevy::prelude::*;
use bevy::settings::{ReflectSettingsGroup, SaveSettingsDeferred, SaveSettingsSync, SettingsGroup, SettingsPlugin};

use crate::ui;
use crate::ui::Interface;

/// The name of the folder that the system keeps the settings in.
const PROGRAM: &str = "motion-lab";

/// Restores the settings at the start, and writes them a second after they change and at the end.
pub struct KeepSettingsPlugin;

impl Plugin for KeepSettingsPlugin {
    fn build(&self, app: &mut App) {
        app.register_type::<Kept>()
            .add_plugins(SettingsPlugin::new(PROGRAM))
            .init_resource::<Kept>()
            .add_systems(PreStartup, restore)
            .add_systems(PostUpdate, keep)
            .add_systems(Last, keep_at_the_end);
    }
}

/// The settings as they are written.
#[derive(Resource, SettingsGroup, Reflect, Clone, Default, PartialEq)]
#[reflect(Resource, SettingsGroup, Default)]
#[settings_group(group = "window")]
struct Kept {
    settings: ui::Settings,
}

fn restore(kept: Res<Kept>, mut interface: ResMut<Interface>) {
    interface.0.settings = kept.settings.clone();
}

fn keep(interface: Res<Interface>, mut kept: ResMut<Kept>, mut commands: Commands) {
    if interface.0.settings != kept.settings {
        kept.settings = interface.0.settings.clone();
        commands.queue(SaveSettingsDeferred(Duration::from_secs(1)));
    }
}

fn keep_at_the_end(mut exits: MessageReader<AppExit>, mut commands: Commands) {
    if exits.read().count() > 0 {
        commands.queue(SaveSettingsSync::IfChanged);
    }
}
