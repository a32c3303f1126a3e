//! The widget in front as a figure, for captures.

use super::run_files::ShownRun;
use crate::window::ui::UiState;
use motion_lab_sim::capture::{CaptureError, CaptureForm, Captured, Subject, anatomy, at_tick_with_robots};
use motion_lab_sim::manifest::Widget;

/// The widget in front as a figure of this width, pixels. The dashboard shows the run at `tick`; the other widgets do
/// not depend on the run.
///
/// # Errors
/// [`CaptureError`], when the run or the scene can't be drawn.
pub fn captured(state: &UiState, run: ShownRun, tick: u64, width_px: f64) -> Result<Captured, CaptureError> {
    match subject(state, CaptureForm::Svg)? {
        None => scene(state, width_px),
        Some(subject) => {
            let kinds = run.kinds.clone();
            at_tick_with_robots(&run.record()?, &subject, tick, width_px, |app| kinds.add_to(app), |_| {})
        }
    }
}

/// The subject of a capture of the widget in front; `None` where the figure does not depend on the run.
pub fn subject(state: &UiState, form: CaptureForm) -> Result<Option<Subject>, CaptureError> {
    let moves = form == CaptureForm::Gif;
    let (names, scan, nearest) = (state.settings.labels, state.settings.scan, state.settings.nearest);
    Ok(match state.widget {
        Widget::Dashboard => Some(Subject::Dashboard { names, scan, nearest }),
        Widget::Anatomy if moves => return Err(CaptureError::Frozen),
        Widget::Cspace if moves => {
            let anatomy = &state.anatomy.anatomy;
            let kind = Some(anatomy.checker().robot().kind().to_owned());
            let robot = anatomy.resident().map(|resident| resident.name.clone());
            let world = Some((**anatomy.world()).clone());
            Some(Subject::Cspace { world, robot, kind, finest: 7, annulus: anatomy.show_annulus })
        }
        Widget::Atlas if moves => Some(Subject::Atlas { world: Some(state.atlas.world().clone()), names }),
        Widget::Plan if moves => return Err(CaptureError::Frozen),
        Widget::Anatomy | Widget::Cspace | Widget::Atlas | Widget::Plan => None,
    })
}

/// The widget in front as a figure that does not depend on the run, for a sheet of this width, pixels.
fn scene(state: &UiState, width_px: f64) -> Result<Captured, CaptureError> {
    let shown = &state.anatomy.anatomy;
    match state.widget {
        Widget::Cspace => state.cspace.captured(shown).map_err(|error| CaptureError::Fault(error.to_string())),
        Widget::Plan => Ok(state.plan.captured()),
        Widget::Atlas => Ok(state.atlas.captured(state.settings.labels, width_px)),
        Widget::Anatomy | Widget::Dashboard => Ok(anatomy(shown, &[shown.tab])),
    }
}
