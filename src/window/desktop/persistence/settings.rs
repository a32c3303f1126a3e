//! Settings kept in a file from one start to the next.

use std::ops::RangeInclusive;
use std::time::Duration;

use bevy::prelude::*;
use bevy::settings::{ReflectSettingsGroup, SaveSettingsDeferred, SaveSettingsSync, SettingsGroup, SettingsPlugin};
use bevy::window::PrimaryWindow;

use crate::window::ui;
use crate::window::ui::{Interface, Recent};

/// The name of the folder that the system keeps all of it in.
pub const PROGRAM: &str = "motion-lab";

/// Restores the settings at the start, and writes them a second after they change and at the end.
pub struct PersistSettingsPlugin;

impl Plugin for PersistSettingsPlugin {
    fn build(&self, app: &mut App) {
        app.register_type::<StoredSettings>()
            .add_plugins(SettingsPlugin::new(PROGRAM))
            .init_resource::<StoredSettings>()
            .add_systems(PreStartup, restore)
            .add_systems(PostUpdate, keep)
            .add_systems(Last, keep_at_the_end);
    }
}

/// The settings as they are written.
#[derive(Resource, SettingsGroup, Reflect, Clone, Default, PartialEq)]
#[reflect(Resource, SettingsGroup, Default)]
#[settings_group(group = "window")]
struct StoredSettings {
    settings: ui::Settings,
    /// Width and height of the window, points; 0 where none is kept yet.
    size: UVec2,
    /// The files opened or saved last, the newest first.
    recent: Vec<String>,
}

/// Least and largest width and height of a window that is kept, points. A screen is no larger.
const SIZES: RangeInclusive<u32> = 360..=16_384;

/// Whether a window of this size can be made again. A window put away as an icon has none.
fn can_be_made_again(size: UVec2) -> bool {
    SIZES.contains(&size.x) && SIZES.contains(&size.y)
}

fn restore(
    kept: Res<StoredSettings>,
    mut interface: ResMut<Interface>,
    mut windows: Query<&mut Window, With<PrimaryWindow>>,
) {
    interface.0.settings = kept.settings.clone();
    interface.0.recent = Recent::of(&kept.recent);
    for mut window in windows.iter_mut().filter(|_| can_be_made_again(kept.size)) {
        window.resolution.set(kept.size.x as f32, kept.size.y as f32);
    }
}

fn keep(
    interface: Res<Interface>,
    windows: Query<&Window, With<PrimaryWindow>>,
    mut kept: ResMut<StoredSettings>,
    mut commands: Commands,
) {
    let size =
        windows.iter().map(|window| window.resolution.size().round().as_uvec2()).find(|size| can_be_made_again(*size));
    let (settings, recent) = (interface.0.settings.clone(), interface.0.recent.saved());
    let new = StoredSettings { settings, size: size.unwrap_or(kept.size), recent };
    if new != *kept {
        *kept = new;
        commands.queue(SaveSettingsDeferred(Duration::from_secs(1)));
    }
}

fn keep_at_the_end(mut exits: MessageReader<AppExit>, mut commands: Commands) {
    if exits.read().count() > 0 {
        commands.queue(SaveSettingsSync::IfChanged);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An app with one window of this size, to which settings are restored.
    fn restored(size: UVec2) -> App {
        let mut app = App::new();
        app.init_resource::<Interface>().add_systems(PreStartup, restore).add_systems(PostUpdate, keep);
        app.insert_resource(StoredSettings { size, ..default() });
        app.world_mut().spawn((Window::default(), PrimaryWindow));
        app.update();
        app
    }

    #[test]
    fn recent_files_are_there_again_and_kept_as_they_change() {
        let mut app = restored(UVec2::ZERO);
        let interface = app.world_mut().resource_mut::<Interface>().into_inner();
        interface.0.recent.put_first(std::path::Path::new("/runs/b.mcap"));
        app.update();
        assert_eq!(app.world().resource::<StoredSettings>().recent, ["/runs/b.mcap"]);
        let mut again = App::new();
        again.init_resource::<Interface>().add_systems(PreStartup, restore).add_systems(PostUpdate, keep);
        again.insert_resource(app.world().resource::<StoredSettings>().clone());
        again.update();
        assert_eq!(again.world().resource::<Interface>().0.recent.saved(), ["/runs/b.mcap"]);
        assert_eq!(again.world().resource::<StoredSettings>().recent, ["/runs/b.mcap"]);
    }

    fn window(app: &mut App) -> Mut<'_, Window> {
        app.world_mut().query::<&mut Window>().single_mut(app.world_mut()).unwrap()
    }

    #[test]
    fn the_window_has_the_size_it_had() {
        let mut app = restored(uvec2(900, 700));
        assert_eq!(window(&mut app).resolution.size(), vec2(900.0, 700.0));
        window(&mut app).resolution.set(1000.0, 640.0);
        app.update();
        assert_eq!(app.world().resource::<StoredSettings>().size, uvec2(1000, 640));
        // put away as an icon it has no size, and the last one stays
        window(&mut app).resolution.set(1.0, 1.0);
        app.update();
        assert_eq!(app.world().resource::<StoredSettings>().size, uvec2(1000, 640));
        // what no screen has is not restored
        let usual = Window::default().resolution.size();
        for size in [UVec2::ZERO, uvec2(100, 700), uvec2(900, 1_000_000)] {
            assert_eq!(window(&mut restored(size)).resolution.size(), usual, "{size}");
        }
    }
}
