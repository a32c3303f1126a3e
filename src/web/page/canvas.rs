//! The plugins of the page: those of Bevy that a canvas needs which egui alone paints. The page keeps the settings, and
//! the browser has a console.
//!
//! Bevy's own list also brings pipelines for three dimensions, visibility, meshes and their shaders: a tenth of the
//! lab's code, of which the page runs nothing.

use std::path::Path;

use bevy::a11y::AccessibilityPlugin;
use bevy::app::{PanicHandlerPlugin, TaskPoolPlugin};
use bevy::asset::AssetPlugin;
use bevy::asset::io::embedded::EmbeddedAssetRegistry;
use bevy::core_pipeline::blit::BlitPlugin;
use bevy::core_pipeline::schedule::camera_driver;
use bevy::core_pipeline::upscaling::{UpscalingPlugin, upscaling};
use bevy::core_pipeline::{Core2d, Core2dSystems, FullscreenShader};
use bevy::diagnostic::FrameCountPlugin;
use bevy::image::ImagePlugin;
use bevy::input::InputPlugin;
use bevy::prelude::*;
use bevy::render::extract_component::ExtractComponentPlugin;
use bevy::render::renderer::{PendingCommandBuffers, RenderGraph, RenderGraphSystems, RenderQueue};
use bevy::render::{RenderApp, RenderPlugin};
use bevy::time::TimePlugin;
use bevy::winit::WinitPlugin;

/// Adds the plugins, with this one for the window.
pub fn add_plugins(app: &mut App, window: WindowPlugin) {
    app.add_plugins((
        PanicHandlerPlugin,
        TaskPoolPlugin::default(),
        FrameCountPlugin,
        TimePlugin,
        InputPlugin,
        window,
        AccessibilityPlugin,
        AssetPlugin::default(),
        WinitPlugin::default(),
        RenderPlugin::default(),
        ImagePlugin::default(),
        CanvasPlugin,
    ));
}

/// Where Bevy's pipelines look for the vertex shader of a triangle that covers the canvas.
const COVER: &str = "bevy_core_pipeline/fullscreen_vertex_shader/fullscreen.wgsl";

/// Brings what a camera's view has been painted with to the canvas.
struct CanvasPlugin;

impl Plugin for CanvasPlugin {
    fn build(&self, app: &mut App) {
        let shader = include_bytes!("canvas.wgsl");
        app.world().resource::<EmbeddedAssetRegistry>().insert_asset(COVER.into(), Path::new(COVER), &shader[..]);
        // the renderer asks for meshes, of which there are none
        app.init_asset::<Mesh>().init_resource::<ClearColor>().add_plugins((
            ExtractComponentPlugin::<Camera2d>::default(),
            BlitPlugin,
            UpscalingPlugin,
        ));
        let Some(renderer) = app.get_sub_app_mut(RenderApp) else { return };
        renderer
            .init_resource::<FullscreenShader>()
            .add_schedule(Core2d::base_schedule())
            .add_systems(Core2d, upscaling.after(Core2dSystems::PostProcess))
            .add_systems(
                RenderGraph,
                (camera_driver.in_set(RenderGraphSystems::Render), submit.in_set(RenderGraphSystems::Submit)),
            );
    }
}

/// Gives the graphics what the camera's systems have recorded.
fn submit(mut pending: ResMut<PendingCommandBuffers>, queue: Res<RenderQueue>) {
    let recorded = pending.take();
    if !recorded.is_empty() {
        queue.submit(recorded);
    }
}
