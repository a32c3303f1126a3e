//! What is in the way of a plan: asked for, named, and opened by a click.

use super::*;
use crate::window::ui::plan::PlanStage;
use motion_lab_core::planning::NoPath;
use motion_lab_sim::run::{WorldChange, WorldEvent};

/// A rover is to get into room C, whose door is shut in the plan's world and in the run.
#[test]
fn the_door_that_is_in_the_way_is_named_and_one_click_opens_it_in_the_run_too() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    click(&mut harness, "close door C");
    click(&mut harness, "Step");
    click(&mut harness, "Plan");
    // the book's Apartment has all doors open, the run's is another choice
    for (list, name) in [("robot", "Rusty, Apartment, in the run"), ("planner", "Cell decomposition")] {
        harness.run_steps(20);
        harness.get_by_role_and_label(egui::accesskit::Role::ComboBox, list).click_accesskit();
        harness.run_steps(3);
        harness.get_by_label(name).click_accesskit();
        harness.run_steps(3);
    }
    assert!(!plan(&harness).task().world.door("door C").unwrap().open);
    harness.run_steps(2);
    assert!(harness.query_by_label("What to move").is_none(), "nothing is proven yet");
    play(&mut harness);
    harness.run_steps(2);
    let stage = plan(&harness).stage().clone();
    assert!(matches!(stage, PlanStage::Ended(NoPath::Unreachable { .. })), "{stage:?} {:?}", plan(&harness).effort());
    harness.get_by_label_contains("Marked: the cells that part the two");
    assert!(harness.query_by_label_contains("There is a path if").is_none(), "nobody asked");
    click(&mut harness, "What to move");
    harness.get_by_label("There is a path if you open \"door C\".");
    let changes = harness.state().script().changes.len();
    click(&mut harness, "Open \"door C\"");
    let tick = harness.state().transport().tick;
    let open = WorldEvent { tick: tick + 1, world: "Apartment".into(), change: WorldChange::Open("door C".into()) };
    assert_eq!(harness.state().script().changes[changes..], [open]);
    for _ in 0..200 {
        harness.run_steps(1);
    }
    assert_eq!(*plan(&harness).stage(), PlanStage::Solved, "with the door open the same planner has a path");
    assert!(harness.query_by_label_contains("What to move").is_none());
    // the path goes by the middles of cells, and so is no shortest one
    let (length, bound) = (plan(&harness).lengths().unwrap().length, plan(&harness).length_bound().unwrap());
    assert!(length > 1.02 * bound, "{length} {bound}");
    harness.get_by_label(&format!("within {} % of the best", (100.0 * (length / bound - 1.0)).ceil()));
    // one step to undo, in the run
    click(&mut harness, "Drive");
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert_eq!(harness.state().script().changes.len(), changes);
}
