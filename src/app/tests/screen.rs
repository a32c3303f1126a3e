//! What the screen shows and which keys mean what.

use super::*;

#[test]
fn the_first_hints_are_put_away_for_good() {
    let mut harness = lab(WIDE);
    harness.state_mut().app.world_mut().resource_mut::<Interface>().0.settings.hints_away.clear();
    harness.run_steps(2);
    harness.get_by_label("Bring the arm to the front, and drag it.");
    click(&mut harness, "Got it");
    assert!(harness.query_by_label("Bring the arm to the front, and drag it.").is_none());
    let kept = harness.state().app.world().resource::<Interface>().0.settings.hints_away.clone();
    assert_eq!(kept, ["dashboard"], "the settings keep it");
}

#[test]
fn letters_are_words_while_words_are_typed() {
    let mut harness = lab(WIDE);
    harness.get_by_label("seed").focus();
    harness.run_steps(2);
    harness.key_press(Key::P);
    harness.key_press(Key::G);
    harness.run_steps(2);
    let settings = harness.state().app.world().resource::<Interface>().0.settings.clone();
    assert!(!settings.plots && harness.state().transport().seed.0 == 2005);
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    harness.key_press(Key::P);
    harness.run_steps(2);
    assert!(harness.state().app.world().resource::<Interface>().0.settings.plots);
}

#[test]
fn the_colour_key_lights_its_role_and_the_list_of_keys_opens() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    harness.get_by_label("colour key: obstacle").focus();
    harness.run_steps(3);
    let lit = |h: &Harness<'_, Lab>| h.state().app.world().resource::<Interface>().0.lit;
    assert_eq!(lit(&harness), Some(crate::picture::Role::Obstacle));
    harness.get_by_label("Menu").focus();
    harness.run_steps(12);
    assert_eq!(lit(&harness), None, "the fade ends");
    harness.key_press(Key::Questionmark);
    harness.run_steps(3);
    harness.get_by_label("loop on or off");
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(harness.query_by_label("loop on or off").is_none());
}

#[test]
fn every_corner_that_is_painted_is_a_number() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Names");
    click(&mut harness, "show the scan");
    for _ in 0..20 {
        harness.run_steps(10);
        let primitives = harness.ctx.tessellate(harness.output().shapes.clone(), 1.0);
        let meshes = primitives.iter().filter_map(|p| match &p.primitive {
            egui::epaint::Primitive::Mesh(mesh) => Some(mesh),
            egui::epaint::Primitive::Callback(_) => None,
        });
        let corners: Vec<Pos2> = meshes.flat_map(|m| m.vertices.iter().map(|v| v.pos)).collect();
        assert!(corners.len() > 5000 && corners.iter().all(|p| p.x.is_finite() && p.y.is_finite()));
    }
}

#[test]
fn a_phone_shows_one_pane_at_a_time_and_all_can_be_reached() {
    let mut harness = lab(PHONE);
    assert!(harness.query_by_label_contains("Workbench. Reach").is_none());
    click(&mut harness, "Reach");
    assert!(harness.query_by_label_contains("Workbench. Reach").is_some());
    let handle = harness.get_by_label("Reach: tip, theta2 in radians").rect();
    assert!(handle.width() >= 44.0, "as large as a fingertip");
    click(&mut harness, "Menu");
    click(&mut harness, "Plots");
    assert!(harness.state().app.world().resource::<Interface>().0.settings.plots);
}

#[test]
fn all_widgets_are_on_the_rail_of_the_narrowest_screen() {
    // 352 points: a phone's page at 400 %, with the 32 points that it may scroll sideways
    let harness = lab([352.0, 640.0]);
    for widget in crate::ui::Widget::ALL {
        let rect = harness.get_by_label(widget.text().short()).rect();
        assert!(rect.right() <= 352.0 && rect.width() > 44.0, "{}: {rect:?}", widget.id());
    }
}
