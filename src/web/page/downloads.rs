//! Downloads: the files that a window would save by a dialog, given to the page.

use bevy::prelude::*;
use serde_json::json;

use super::listener::{tell, tell_with};
use crate::window::for_page::{Interface, SessionError, captured, path_text, save, shown_run, subject};
use crate::window::ui::capture_state::MAX_PICTURES;
use crate::window::ui::{CaptureOrder, Notice, SessionCommand};
use motion_lab_sim::capture::{CaptureError, CaptureForm, Film, Paper, TICK_HUNDREDTHS};
use motion_lab_sim::simulation::Transport;

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
            // the page has no files of its own
            SessionCommand::OpenRecent(_) | SessionCommand::CopyPicture(_) => continue,
            SessionCommand::OpenPath => {
                tell(&json!({ "kind": "ask", "accept": ".json" }));
                continue;
            }
            SessionCommand::Capture(order) => capture(world, &order),
            SessionCommand::PlayPath
            | SessionCommand::Why
            | SessionCommand::PlayWayOut
            | SessionCommand::RunWorld
            | SessionCommand::ThreeRobots
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

/// Gives the page the widget in front as ordered: as SVG, or as the sheets that it paints a PNG or a GIF from. Returns
/// what is said of it.
fn capture(world: &World, order: &CaptureOrder) -> Result<String, SessionError> {
    let ui = &world.resource::<Interface>().0;
    let CaptureOrder { form, width, scale, span } = *order;
    let name = format!("{}.{}", ui.widget.id(), form.extension());
    let Some(subject) = subject(ui, form)?.filter(|_| form == CaptureForm::Gif) else {
        let svg = picture(world, width)?;
        let dots = (form == CaptureForm::Png).then_some(scale);
        tell_with(&json!({ "kind": "file", "name": name, "scale": dots }), Some(svg.as_bytes()));
        return Ok(format!("{name}: captured"));
    };
    let pictures = span.pictures();
    if pictures > MAX_PICTURES {
        return Err(CaptureError::TooMany { pictures, most: MAX_PICTURES }.into());
    }
    let run = shown_run(world, world.resource::<Transport>().frontier());
    let kinds = run.kinds.clone();
    let (log, paper) = (run.record()?, paper(world, width));
    Film::try_new(&log, &subject, span)?.pictures(
        paper.width_px(),
        |app| kinds.add_to(app),
        |captured| {
            tell_with(&json!({ "kind": "sheet" }), Some(captured.svg(&paper).as_bytes()));
            Ok(())
        },
    )?;
    tell(&json!({
        "kind": "film", "name": name, "scale": scale, "hundredths": TICK_HUNDREDTHS * span.every,
    }));
    Ok(format!("{name}: captured, {pictures} pictures"))
}

fn paper(world: &World, width: u32) -> Paper {
    Paper { palette: world.resource::<Interface>().0.theme().palette(), width, scale: 1.0 }
}

/// A picture of the widget in front as SVG, on a sheet of at most this width, pixels.
pub fn picture(world: &World, width: u32) -> Result<String, SessionError> {
    let transport = world.resource::<Transport>();
    let (tick, frontier) = (transport.tick(), transport.frontier());
    let run = shown_run(world, frontier);
    let paper = paper(world, width);
    let figure = captured(&world.resource::<Interface>().0, run, tick, paper.width_px())?;
    Ok(figure.svg(&paper))
}
