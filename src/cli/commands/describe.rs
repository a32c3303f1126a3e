//! `describe`: the widgets' words, formulas and colours, for pages about the lab.

use clap::Args;
use serde_json::{Map, Value, json};

use crate::cli::{Data, Failure, Outcome};
use motion_lab::configuration::RobotKind;
use motion_lab::manifest::{ChapterFormula, Formula, Lesson, Widget};
use motion_lab::picture::{Rgb, Role, Theme};

/// Print what a page about the lab needs, as JSON: each widget's words, the formulas of the configuration spaces in
/// MathML, and the colours of the roles on light and on dark paper.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab describe > words.json")]
pub struct Describe {}

impl Describe {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let widgets: Vec<Value> = Widget::ALL
            .into_iter()
            .map(|widget| {
                let w = widget.text();
                let key: Vec<Value> =
                    w.key.iter().map(|k| json!({ "role": k.role().name(), "text": k.text })).collect();
                json!({
                    "id": w.id, "title": w.title, "misconception": w.misconception, "description": w.description,
                    "key": key, "hints": w.hints.iter().map(|h| &h.text).collect::<Vec<_>>(),
                    "lessons": Lesson::all().filter(|lesson| lesson.widget == widget).map(Lesson::id).collect::<Vec<_>>(),
                })
            })
            .collect();
        let spaces = RobotKind::ALL.into_iter().flat_map(|kind| kind.spaces.iter().map(move |space| (kind, space)));
        let formulas: Vec<Value> = spaces
            .map(|(kind, space)| {
                json!({
                    "robot": kind.name, "trailer": space.coordinates > 3, "mathml": Formula::of(space).mathml(),
                    "spoken": space.words,
                })
            })
            .collect();
        let told = ChapterFormula::all().iter().map(|told| {
            json!({
                "at": told.at(), "mathml": told.formula.mathml(), "spoken": told.spoken, "code": told.code,
            })
        });
        let all = json!({
            "widgets": widgets,
            "formulas": formulas,
            "chapter": told.collect::<Vec<Value>>(),
            "colours": { "light": colours(Theme::Light), "dark": colours(Theme::Dark) },
        });
        data.data_line(serde_json::to_string_pretty(&all).map_err(Failure::internal)?)?;
        Ok(Outcome::Done)
    }
}

/// The colours by role, `#rrggbb`.
fn colours(theme: Theme) -> Map<String, Value> {
    let hex = |Rgb([r, g, b]): Rgb| format!("#{r:02x}{g:02x}{b:02x}").into();
    Role::ALL.into_iter().map(|role| (role.name().to_owned(), hex(theme.palette().colour(role)))).collect()
}
