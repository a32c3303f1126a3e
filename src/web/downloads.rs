//! Downloads: the files that a window would save by a dialog, given to the page.

use bevy::prelude::*;
use serde_json::json;

use super::listener::{tell, tell_with};
use crate::app::{Interface, SessionError, captured, path_text, save, shown_run};
use crate::capture::Paper;
use crate::simulation::Transport;
use crate::ui::{Notice, SessionCommand};

/// Carries out the commands that need a dialog in a window: gives the page the file to save, or asks it for one to
/// open.
pub fn files(world: &mut World) {
    let asked: Vec<SessionCommand> = world.resource_mut::<Messages<SessionCommand>>().drain().collect();
    for command in asked {
        let notice = match command {
            SessionCommand::Save => {
                let give = |bytes: &[u8], words: String| {
                    tell_with(&json!({ "kind": "file", "name": "run.mcap" }), Some(bytes));
                    Ok(Notice { text: format!("run.mcap: {words}"), is_error: false })
                };
                match save(world, Box::new(give)) {
                    Ok(Some(notice)) => Ok(notice.text),
                    Ok(None) => continue,
                    Err(error) => Err(error),
                }
            }
            SessionCommand::SaveWorld => {
                let atlas = &mut world.resource_mut::<Interface>().into_inner().0.atlas;
                tell_with(&json!({ "kind": "file", "name": "world.ron" }), Some(atlas.text().as_bytes()));
                atlas.mark_saved(std::path::Path::new("world.ron"));
                Ok("world.ron: saved".into())
            }
            SessionCommand::Open => {
                tell(&json!({ "kind": "ask", "accept": ".mcap" }));
                continue;
            }
            SessionCommand::OpenWorld => {
                tell(&json!({ "kind": "ask", "accept": ".ron" }));
                continue;
            }
            SessionCommand::SavePath => match path_text(world) {
                Some(text) => {
                    tell_with(&json!({ "kind": "file", "name": "path.json" }), Some(text.as_bytes()));
                    Ok("path.json: saved".into())
                }
                None => continue,
            },
            SessionCommand::OpenPath => {
                tell(&json!({ "kind": "ask", "accept": ".json" }));
                continue;
            }
            SessionCommand::Capture(order) => picture(world, order.width).map(|(name, svg)| {
                tell_with(&json!({ "kind": "file", "name": name }), Some(svg.as_bytes()));
                format!("{name}: saved")
            }),
            SessionCommand::PlayPath
            | SessionCommand::RunWorld
            | SessionCommand::RunFromHere
            | SessionCommand::PutRobot { .. }
            | SessionCommand::Links { .. } => continue,
        };
        let notice = match notice {
            Ok(text) => Notice { text, is_error: false },
            Err(error) => Notice { text: format!("not saved: {error}"), is_error: true },
        };
        world.resource_mut::<Interface>().0.say(notice);
    }
}

/// A picture of the widget in front as SVG, on a sheet of at most this width, pixels, and a name for its file.
pub fn picture(world: &World, width: u32) -> Result<(String, String), SessionError> {
    let Transport { tick, frontier, .. } = *world.resource::<Transport>();
    let run = shown_run(world, frontier);
    let ui = &world.resource::<Interface>().0;
    let paper = Paper { palette: ui.theme().palette(), width, scale: 1.0 };
    let figure = captured(ui, run, tick, paper.width_px())?;
    Ok((format!("{}.svg", ui.widget.id()), figure.svg(&paper)))
}
