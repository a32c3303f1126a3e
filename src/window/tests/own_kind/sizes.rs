//! Residents with sizes of their own in the window.

use super::super::*;
use crate::window::session::new_run;
use motion_lab_core::random::Seed;
use motion_lab_core::robots::AnyRobot;
use motion_lab_core::worlds::World as WorldModel;
use motion_lab_sim::anatomy::{Anatomy, WorldSource};
use motion_lab_sim::manifest::Widget;
use motion_lab_sim::run::Recipe;
use motion_lab_sim::tour::TourConfig;

/// A wall 4 m behind a lorry whose trailer reaches 5 m behind its rear axle, and an arm with a base of its own.
fn yard() -> WorldModel {
    let text = r#"World(version: 1, name: "Yard", bounds: (min: (0, 0), max: (20, 12)),
        walls: [(name: "the wall", points: [(2, 0), (2, 12)])],
        robots: [
            (name: "Lorry", kind: "hitch", start: [6, 8, 0], car: (trailer: (hitch_len: 4, rear_overhang: 1))),
            (name: "Short", kind: "reach", start: [0, 0], arm: (base: (12, 3), lengths: [0.5, 0.4], radius: 0.02)),
        ])"#;
    WorldModel::parse("yard.ron", text).unwrap()
}

#[test]
fn what_is_shown_and_asked_is_the_residents_own() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    let config = TourConfig { worlds: vec![yard()], ..TourConfig::default() };
    new_run(harness.state_mut().app.world_mut(), Recipe::new(config, Seed(1))).unwrap();
    harness.run_steps(3);
    // the kind's own trailer would reach 2.8 m back and not touch it
    click(&mut harness, "put a trailer on");
    harness.get_by_label("no room for a trailer: would overlap the wall");
    let tip = harness.state().robot(1).tip.unwrap();
    assert!((tip.x - 12.9).abs() < 1e-12 && (tip.y - 3.0).abs() < 1e-12, "{tip}");
    // three links instead of two: another arm at the same base, as thick
    click(&mut harness, "three links");
    let arm = harness.state().robot(1);
    let Some(AnyRobot::Reach3(model)) = arm.model else { panic!("{:?}", arm.model) };
    assert_eq!((model.base.x, model.base.y, model.link_radius), (12.0, 3.0, 0.02));
    // its tip stays while its first joint walks
    let tip = arm.tip.unwrap();
    let slider = harness.get_by_label("tip kept:").rect();
    click_at(&mut harness, slider.left_center() + egui::vec2(0.8 * slider.width(), 0.0));
    click(&mut harness, "Step");
    let walked = harness.state().robot(1);
    assert!((walked.coordinates[0] - arm.coordinates[0]).abs() > 0.05, "{:?}", walked.coordinates);
    assert!((walked.tip.unwrap() - tip).norm() < 1e-5);
}

#[test]
fn the_residents_of_the_world_are_to_be_chosen() {
    let mut harness = lab(WIDE);
    let shown = Anatomy::of_world(yard(), WorldSource::Unsaved).unwrap();
    let mut interface = harness.state_mut().app.world_mut().resource_mut::<Interface>();
    interface.0.widget = Widget::Cspace;
    interface.0.anatomy.set(shown);
    harness.run_steps(3);
    harness.get_by_role_and_label(egui::accesskit::Role::ComboBox, "robot").click();
    harness.run_steps(3);
    click(&mut harness, "Short");
    let anatomy = &harness.state().app.world().resource::<Interface>().0.anatomy.anatomy;
    assert_eq!(anatomy.resident().map(|r| r.name.as_str()), Some("Short"));
}

#[test]
fn an_arms_links_are_bare_or_as_thick_as_its_own() {
    let mut harness = lab(WIDE);
    let shown = Anatomy::of_world(yard(), WorldSource::Unsaved).unwrap();
    let short = shown.residents().into_iter().find(|(name, _)| name == "Short").unwrap().1;
    let mut interface = harness.state_mut().app.world_mut().resource_mut::<Interface>();
    interface.0.widget = Widget::Anatomy;
    interface.0.anatomy.set(shown.with_robot(short));
    harness.run_steps(3);
    let radius = |harness: &Harness<'_, Lab>| {
        let anatomy = &harness.state().app.world().resource::<Interface>().0.anatomy.anatomy;
        let AnyRobot::Reach(arm) = *anatomy.checker().robot() else { panic!("an arm") };
        arm.link_radius
    };
    for expected in [0.0, 0.02] {
        click(&mut harness, "2 cm capsule links");
        assert_eq!(radius(&harness), expected);
    }
}
