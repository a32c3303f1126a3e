//! What to move where it is proven that there is no path: a button asks, and another opens the doors.

use bevy_egui::egui::Ui;

use super::racer::PlanStage;
use super::state::PlanState;
use crate::window::ui::dashboard::doors;
use crate::window::ui::paint::button::LabButton;
use crate::window::ui::paint::plate::refusal;
use crate::window::ui::{Command, Dashboard, FrameColours};
use motion_lab_core::planning::NoPath;
use motion_lab_sim::plans::{Blocker, Removal};

/// Shows the button that asks, and then what came of it.
pub fn what_to_move(
    ui: &mut Ui,
    look: &FrameColours,
    model: &Dashboard,
    plan: &mut PlanState,
    commands: &mut Vec<Command>,
) {
    let is_parted = matches!(plan.stage(), PlanStage::Ended(NoPath::Unreachable { .. }));
    let Some(work) = plan.racer().work.clone().filter(|_| is_parted) else { return };
    let Some(removal) = work.removal() else {
        let button = LabButton::new("What to move").show(ui, look);
        if button.on_hover_text("The fewest things without which there is a path").clicked() {
            work.find_removal(&plan.task);
        }
        return;
    };
    match removal {
        Ok(removal) => {
            let fewer = if removal.is_least { "" } else { " Whether fewer things would do is not known." };
            ui.label(format!("There is a path if you {}.{fewer}", Removal::to_do(&removal.blockers)));
            if let Some(doors) = removal.doors_alone() {
                let opened = Removal::to_do(doors).replacen("open", "Open", 1);
                if LabButton::new(&opened).show(ui, look).on_hover_text("In the plan, and in the run").clicked() {
                    open(doors, model, plan, commands);
                }
            }
        }
        Err(reason) => refusal(ui, &format!("What to move: {reason}."), look),
    }
}

/// Opens these doors in the world that is planned in, where the planner then goes on, and in the run's of that name.
fn open(blockers: &[Blocker], model: &Dashboard, plan: &mut PlanState, commands: &mut Vec<Command>) {
    let is_named = |name: &str| blockers.iter().any(|door| door.name == name);
    for cockpit in model.cockpits.iter().filter(|cockpit| cockpit.standing.name == plan.task.world.name) {
        let shut = cockpit.standing.doors.iter().filter(|door| !door.open && is_named(&door.name));
        doors::toggle(&cockpit.standing.name, shut, commands);
    }
    plan.take(plan.task.without_blockers(blockers));
    plan.playing = true;
}
