//! `describe`: the widgets' words, formulas, colours and assignments, for pages about the lab.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::{Map, Value, json};

use super::grade::read_assignment;
use crate::cli::{Data, Failure, Outcome};
use motion_lab_core::configuration::{Configuration, RobotKind};
use motion_lab_core::picture::{Rgb, Role, Theme, in_signs};
use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::course::Assignment;
use motion_lab_sim::manifest::{ChapterFormula, Formula, Lesson, Widget};
use motion_lab_sim::run::{Event, Quantized, RobotInput, Script, seconds};

/// Print what a page about the lab needs, as JSON: each widget's words, the formulas of the configuration spaces in
/// MathML, the colours of the roles on light and on dark paper, and what assignments ask for.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab describe > words.json
  motion-lab describe book/assignments/back_in.ron > words.json")]
pub struct Describe {
    /// Assignments, as `grade` reads them, to tell what they ask for.
    #[arg(value_name = "ASSIGNMENT")]
    assignments: Vec<PathBuf>,
}

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
            "assignments": self.assignments.iter().map(|path| assignment_json(path)).collect::<Result<Vec<_>, _>>()?,
        });
        data.data_line(serde_json::to_string_pretty(&all).map_err(Failure::internal)?)?;
        Ok(Outcome::Done)
    }
}

/// What an assignment asks for, with the file's name for its `id`, and the script by which its robot stands from the
/// first tick on, as it does where it is graded.
fn assignment_json(path: &Path) -> Result<Value, Failure> {
    let (world, assignment) = read_assignment(path)?;
    let resident = &assignment.world().robots[assignment.robot()];
    let (goal, limits) = (assignment.goal(), assignment.limits());
    let start = AnyRobot::of_resident(resident).map(|(_, q)| q.coordinate_names()).unwrap_or_default();
    let names: Vec<String> = start.iter().map(|name| in_signs(name)).collect();
    let lengths = assignment.about().map_or(goal.at.len(), |about| about.lengths);
    let script = Script::new(vec![Event { tick: 1, robot: resident.name.clone(), input: rest(&assignment) }], vec![]);
    Ok(json!({
        "id": path.file_stem().unwrap_or_default().to_string_lossy(),
        "world": world, "robot": resident.name, "names": names,
        "at": goal.at, "within": goal.within, "is_angle": (0..goal.at.len()).map(|i| i >= lengths).collect::<Vec<_>>(),
        "hold": assignment.hold(), "ticks": limits.ticks, "seconds": seconds(limits.ticks), "contacts": limits.contacts,
        "script": script.to_line(),
    }))
}

/// The input by which the robot of an assignment stands where it is.
fn rest(assignment: &Assignment) -> RobotInput {
    let start = &assignment.world().robots[assignment.robot()].start;
    match assignment.about() {
        Some(about) if about.lengths == 0 => {
            RobotInput::MoveTo(start.iter().filter_map(|x| Quantized::try_new(*x)).collect())
        }
        _ => RobotInput::Drive(0, 0),
    }
}

/// The colours by role, `#rrggbb`.
fn colours(theme: Theme) -> Map<String, Value> {
    let hex = |Rgb([r, g, b]): Rgb| format!("#{r:02x}{g:02x}{b:02x}").into();
    Role::ALL.into_iter().map(|role| (role.name().to_owned(), hex(theme.palette().colour(role)))).collect()
}
