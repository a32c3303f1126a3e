//! What the screen shows and which keys mean what.

use super::*;

#[test]
fn the_first_hints_are_put_away_for_good() {
    let mut harness = lab(WIDE);
    harness.state_mut().app.world_mut().resource_mut::<Interface>().0.settings.hints_away.clear();
    harness.run_steps(2);
    harness.get_by_label("Drag a robot on wheels, or drive by keys or pad.");
    click(&mut harness, "Got it");
    assert!(harness.query_by_label("Drag a robot on wheels, or drive by keys or pad.").is_none());
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
    let lit = |h: &Harness<'_, Lab>| h.state().app.world().resource::<Interface>().0.pointer.lit;
    assert_eq!(lit(&harness), Some(motion_lab_core::picture::Role::Obstacle));
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
    click(&mut harness, "scan");
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
    let handle = harness.get_by_label("Reach: tip, θ₂ in radians").rect();
    assert!(handle.width() >= 44.0, "as large as a fingertip");
    click(&mut harness, "Menu");
    click(&mut harness, "Plots");
    assert!(harness.state().app.world().resource::<Interface>().0.settings.plots);
}

#[test]
fn all_widgets_are_on_the_rail_of_the_narrowest_screen() {
    // 352 points: a phone's page at 400 %, with the 32 points that it may scroll sideways
    let harness = lab([352.0, 640.0]);
    for widget in motion_lab_sim::manifest::Widget::ALL {
        let rect = harness.get_by_label(widget.text().short()).rect();
        assert!(rect.right() <= 352.0 && rect.width() > 44.0, "{}: {rect:?}", widget.id());
    }
}

/// How much the world in front is magnified, and where the middle of its paper is.
fn magnified(harness: &Harness<'_, Lab>) -> (f64, Option<motion_lab_core::geometry::Point2>) {
    interface(harness).cameras.get("Apartment").map_or((1.0, None), |camera| (camera.zoom, camera.centre))
}

pub fn wheel(harness: &mut Harness<'_, Lab>, at: Pos2, points: f32) {
    pointer(harness, at, None);
    let (unit, phase, modifiers) = (egui::MouseWheelUnit::Point, egui::TouchPhase::Move, Modifiers::NONE);
    harness.event(Event::MouseWheel { unit, delta: egui::vec2(0.0, points), phase, modifiers });
    // egui smooths the wheel
    harness.run_steps(20);
}

pub fn keys(harness: &mut Harness<'_, Lab>, key: Key, times: usize) {
    for _ in 0..times {
        harness.key_press(key);
        harness.run_steps(2);
    }
}

#[test]
fn the_world_in_front_is_magnified_moved_and_fitted() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    let paper_of = |h: &Harness<'_, Lab>| paper(h, "Apartment");
    let (rect, at) = (paper_of(&harness), paper_of(&harness).center() + egui::vec2(120.0, 60.0));
    // seen whole, the paper does not move under the pointer
    let drag = |h: &mut Harness<'_, Lab>, by: egui::Vec2| {
        pointer(h, at, Some(true));
        (1..=4).for_each(|i| pointer(h, at + by * (i as f32 / 4.0), None));
        pointer(h, at + by, Some(false));
    };
    drag(&mut harness, egui::vec2(80.0, 0.0));
    assert_eq!(magnified(&harness).0, 1.0);
    assert!(harness.query_by_label("show the whole world").is_none(), "nothing to fit");
    wheel(&mut harness, at, 240.0);
    let (zoom, centre) = magnified(&harness);
    assert!((zoom - std::f64::consts::E).abs() < 0.05, "240 points are e times: {zoom}");
    // what is under the pointer has stayed: the middle has gone toward it by (1 - 1/e) of the way
    let scale = f64::from(rect.width() - 16.0) / 12.0;
    let toward = (1.0 - 1.0 / zoom) * 120.0 / scale;
    assert!((centre.unwrap().x - (6.0 + toward)).abs() < 0.02, "{centre:?}");
    // dragged by 80 points to the right, the middle goes as far to the left
    drag(&mut harness, egui::vec2(80.0, 0.0));
    let moved = magnified(&harness).1.unwrap().x - centre.unwrap().x;
    assert!((moved + 80.0 / (scale * zoom)).abs() < 0.2 * 80.0 / (scale * zoom), "{moved}");
    assert_eq!(interface(&harness).hand.armed, None, "a drag is no click");
    click(&mut harness, "show the whole world");
    assert_eq!(magnified(&harness).0, 1.0);
    // by keys, and by a double click
    keys(&mut harness, Key::Plus, 2);
    assert!((magnified(&harness).0 - 2.25).abs() < 1e-9);
    keys(&mut harness, Key::Minus, 1);
    assert!((magnified(&harness).0 - 1.5).abs() < 1e-9);
    keys(&mut harness, Key::Num0, 1);
    assert_eq!(magnified(&harness).0, 1.0);
    keys(&mut harness, Key::Equals, 30);
    let largest = magnified(&harness).0 * scale;
    assert!((largest - 400.0).abs() < 0.1, "no larger than 400 points a metre: {largest}");
    let corner = rect.left_bottom() + egui::vec2(30.0, -30.0);
    (0..2).for_each(|_| {
        pointer(&mut harness, corner, Some(true));
        pointer(&mut harness, corner, Some(false));
    });
    harness.run_steps(2);
    assert_eq!(magnified(&harness).0, 1.0, "a double click fits");
    assert_eq!(interface(&harness).hand.armed, None, "and takes nobody in hand");
}

#[test]
fn a_handle_off_the_magnified_paper_takes_no_click_beside_it() {
    let mut harness = lab(WIDE);
    bring(&mut harness, "Reach");
    pause(&mut harness);
    keys(&mut harness, Key::Plus, 5);
    let sheet = paper(&harness, "Workbench");
    for handle in ["Reach: elbow, θ₁ in radians", "Reach: tip, θ₂ in radians"] {
        let rect = harness.get_by_label(handle).rect();
        assert!(sheet.expand(0.5).contains_rect(rect), "{handle}: {rect:?} on {sheet:?}");
    }
    // the tip, two metres from the base, is far off the paper: nothing of it can be hit
    let tip = harness.get_by_label("Reach: tip, θ₂ in radians").rect();
    assert_eq!(tip.area(), 0.0, "{tip:?}");
}

#[test]
fn an_embedded_lab_leaves_the_wheel_to_the_page() {
    let mut harness = lab(WIDE);
    interface_mut(&mut harness).screen.embedded = true;
    harness.run_steps(2);
    let at = paper(&harness, "Apartment").center();
    wheel(&mut harness, at, 240.0);
    assert_eq!(magnified(&harness).0, 1.0);
    harness.event(Event::Zoom(2.0));
    harness.run_steps(3);
    assert!((magnified(&harness).0 - 2.0).abs() < 0.01, "two fingers are the lab's");
    keys(&mut harness, Key::Period, 6);
    harness.run_steps(60);
    let lanes = harness.get_by_label_contains(" so far: a click goes to one").rect();
    wheel(&mut harness, lanes.center(), 240.0);
    assert_eq!(interface(&harness).span.part, None, "nor is it the time line's");
}

#[test]
fn one_key_fills_the_window_with_the_world_in_front() {
    for size in [WIDE, PHONE] {
        let mut harness = lab(size);
        let before = paper(&harness, "Apartment").area();
        keys(&mut harness, Key::M, 1);
        let filled = paper(&harness, "Apartment");
        assert!(filled.area() > 1.05 * before || size == PHONE && filled.area() >= before, "{before} {filled:?}");
        assert!(harness.query_by_label("Query").is_none() && harness.query_by_label("Menu").is_none(), "{size:?}");
        assert!(harness.query_by_label_contains("Bring Reach").is_none());
        harness.get_by_label("Pause");
        click(&mut harness, "Show all");
        harness.get_by_label("Query");
    }
    let mut harness = lab(WIDE);
    // another world by its key; plots bring all back; elsewhere the key does nothing
    keys(&mut harness, Key::M, 1);
    keys(&mut harness, Key::Num2, 1);
    paper(&harness, "Workbench");
    keys(&mut harness, Key::Escape, 1);
    keys(&mut harness, Key::P, 1);
    assert!(!interface(&harness).screen.fills && interface(&harness).settings.plots);
    click(&mut harness, "Query");
    keys(&mut harness, Key::M, 1);
    assert!(!interface(&harness).screen.fills);
}

#[test]
fn hints_are_ticked_off_as_they_are_done_and_come_back_by_a_key() {
    let mut harness = lab(WIDE);
    let (first, hint) = ("Drag a robot on wheels, or drive by keys or pad.", "Reset: the same seed, the same run.");
    assert!(harness.query_by_label(first).is_none(), "put away");
    keys(&mut harness, Key::H, 1);
    harness.get_by_label(first);
    // the first as the sentence, the others as dots
    let size = |h: &Harness<'_, Lab>, name: &str| h.get_by_label(name).rect().size();
    assert!(size(&harness, first).x > 300.0 && size(&harness, hint).x < 30.0);
    let done = |h: &Harness<'_, Lab>| interface(h).settings.done.clone();
    harness.run_steps(20);
    assert_eq!(done(&harness), Vec::<String>::new(), "nothing is done by itself");
    keys(&mut harness, Key::R, 1);
    harness.get_by_label(&format!("{hint} Done."));
    // driven at the end of what the run has reached, and then from an earlier tick
    harness.run_steps(80);
    arm_rusty(&mut harness);
    keys(&mut harness, Key::ArrowUp, 1);
    assert_eq!(done(&harness), ["Reset", "Drive"]);
    assert!(size(&harness, &format!("{first} Done.")).x < 30.0, "the next one is said");
    keys(&mut harness, Key::Escape, 1);
    keys(&mut harness, Key::Space, 1);
    keys(&mut harness, Key::Home, 1);
    assert!(harness.state().transport().tick == 0);
    arm_rusty(&mut harness);
    keys(&mut harness, Key::ArrowUp, 1);
    assert_eq!(done(&harness), ["Reset", "Drive", "DriveOn"]);
    keys(&mut harness, Key::Escape, 1);
    bring(&mut harness, "Reach");
    drag(&mut harness, "Reach: tip, θ₂ in radians", [0.9, 0.9]);
    assert_eq!(done(&harness), ["Reset", "Drive", "DriveOn", "MoveArm"]);
    keys(&mut harness, Key::H, 1);
    assert!(harness.query_by_label_contains(hint).is_none());
}

/// Guesses the distance with links of 3 cm.
fn guess(harness: &mut Harness<'_, Lab>, text: &str) {
    if harness.query_by_label_contains("the links are given a radius of 3 cm").is_none() {
        click(harness, "Guess first");
    }
    harness.get_by_label_contains("the links are given a radius of 3 cm").focus();
    harness.run_steps(2);
    harness.event(Event::Text(text.into()));
    harness.step();
    harness.key_press(Key::Enter);
    harness.run_steps(3);
}

#[test]
fn what_is_no_number_is_no_guess() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Query");
    guess(&mut harness, "a lot");
    harness.get_by_label_contains("is no number");
    assert_eq!(interface(&harness).settings.done, Vec::<String>::new());
}

#[test]
fn each_widget_ticks_off_its_own() {
    let mut harness = lab(WIDE);
    let done = |h: &Harness<'_, Lab>| interface(h).settings.done.clone();
    let change = |h: &mut Harness<'_, Lab>, of: &dyn Fn(&mut UiState)| {
        of(interface_mut(h));
        h.run_steps(3);
    };
    click(&mut harness, "Query");
    click(&mut harness, "swept");
    assert_eq!(done(&harness), Vec::<String>::new(), "the chapter's motion hits the block: nobody made it");
    click(&mut harness, "distance");
    guess(&mut harness, "0.05");
    assert_eq!(done(&harness), ["Guess"]);
    // the tip is dragged into the block, whose corner is at (0.9, 0.9) of the chapter's exercise
    click(&mut harness, "distance");
    let sheet = harness.get_by_label_contains("Reach at T2").rect();
    let fit = crate::window::ui::paint::canvas::fit(interface(&harness).anatomy.backdrop(), sheet);
    let at = |x: f64, y: f64| {
        let [x, y] = fit.screen_from_world(motion_lab_core::geometry::Point2::new(x, y));
        pos2(x as f32, y as f32)
    };
    let (from, to) = (at(0.0, std::f64::consts::SQRT_2), at(0.7, 1.2));
    pointer(&mut harness, from, Some(true));
    (1..=8).for_each(|i| pointer(&mut harness, from.lerp(to, i as f32 / 8.0), None));
    pointer(&mut harness, to, Some(false));
    assert!(interface(&harness).anatomy.anatomy.intersects(), "{}", interface(&harness).anatomy.anatomy.q());
    assert_eq!(done(&harness), ["Guess", "Touch"]);
    click(&mut harness, "Space");
    assert_eq!(done(&harness).len(), 2);
    let at = harness.get_by_label_contains("configuration space. The robot").rect().center() + egui::vec2(40.0, 30.0);
    click_at(&mut harness, at);
    assert_eq!(done(&harness)[2..], ["MovePoint"]);
    click(&mut harness, "Atlas");
    change(&mut harness, &|state| state.open_world(crate::window::ui::AtlasState::default()));
    assert_eq!(done(&harness).len(), 3);
    change(&mut harness, &|state| state.atlas.set_resolution(0.5));
    assert_eq!(done(&harness)[3..], ["Coarsen"]);
    let gone = motion_lab_sim::atlas::Op::Delete { name: "D's front wall".into() };
    change(&mut harness, &|state| state.atlas.change(&gone, None));
    assert_eq!(done(&harness).len(), 4, "the world without the wall is not run yet");
    ["Edit", "Run this world"].into_iter().for_each(|name| click(&mut harness, name));
    assert_eq!(done(&harness)[4..], ["EditWorld"]);
    click(&mut harness, "Plan");
    keys(&mut harness, Key::ArrowRight, 1);
    assert_eq!(done(&harness)[5..], ["StepPlanner"]);
    change(&mut harness, &|state| {
        let goal = state.plan.end_at(1);
        state.plan.move_end(1, goal.with(0, 3.0));
    });
    assert_eq!(done(&harness).len(), 6, "it is not planned anew yet");
    change(&mut harness, &|state| {
        (0..500).for_each(|_| state.plan.step());
    });
    assert_eq!(done(&harness)[6..], ["FindPath", "MoveGoal"]);
    click(&mut harness, "Play it");
    assert_eq!(done(&harness)[8..], ["PlayPath"]);
}

#[test]
fn the_wheel_shows_less_of_the_time() {
    let mut harness = lab(WIDE);
    keys(&mut harness, Key::Period, 6);
    harness.run_steps(60);
    pause(&mut harness);
    let end = harness.state().transport().tick;
    assert!(end > 200, "{end}");
    keys(&mut harness, Key::ArrowLeft, 1);
    let lanes = harness.get_by_label_contains(" so far: a click goes to one").rect();
    assert_eq!(interface(&harness).span.part, None);
    // at the right end, so that the last tick stays
    wheel(&mut harness, lanes.right_center(), 240.0);
    let span = interface(&harness).span.part.unwrap();
    assert_eq!(span.to, end);
    let share = (span.to - span.from) as f64 * std::f64::consts::E / end as f64;
    assert!((share - 1.0).abs() < 0.05, "240 points are e times less: {span:?} of {end}");
    // a click goes to the tick that is shown there
    click_at(&mut harness, lanes.left_center() + egui::vec2(1.0, 0.0));
    let tick = harness.state().transport().tick;
    assert!(tick.abs_diff(span.from) <= 8, "{tick} {span:?}");
    wheel(&mut harness, lanes.center(), -600.0);
    assert_eq!(interface(&harness).span.part, None);
}

#[test]
fn four_worlds_scroll_and_an_arm_that_scrolled_away_harms_nothing() {
    let mut harness = lab([1280.0, 480.0]);
    let mut config = motion_lab_sim::tour::TourConfig::default();
    let yard =
        motion_lab_core::worlds::Warehouse { seed: motion_lab_core::random::Seed(1), robots: 10, trailers: false };
    config.worlds.push(yard.world().unwrap());
    let world = harness.state_mut().app.world_mut();
    world.resource_mut::<Transport>().playback = Playback::Paused;
    crate::window::session::new_run(world, motion_lab_sim::run::Recipe::new(config, motion_lab_sim::tour::BOOK_SEED))
        .unwrap();
    harness.run_steps(3);
    let before = paper(&harness, "Workbench");
    wheel(&mut harness, before.center(), -4000.0);
    let after = paper(&harness, "Workbench");
    assert!(after.top() < before.top() - 80.0, "the wheel over a paper scrolls: {before:?} {after:?}");
    assert!(interface(&harness).cameras.values().all(|camera| camera.zoom == 1.0), "and magnifies nothing");
    let tip = harness.get_by_label("Reach: tip, θ₂ in radians").rect();
    assert_eq!(tip.area(), 0.0, "nothing of the arm is seen: {tip:?} {after:?}");
    // what is in hand is in front: its world is magnified and fills the window
    interface_mut(&mut harness).hand.armed = Some("Hitch".into());
    keys(&mut harness, Key::Plus, 1);
    let zoom = |name: &str| interface(&harness).cameras.get(name).map(|camera| camera.zoom);
    assert_eq!((zoom("Lot"), zoom("Apartment")), (Some(1.5), Some(1.0)));
    keys(&mut harness, Key::M, 1);
    paper(&harness, "Lot");
    assert!(harness.query_by_label_contains("Apartment. Rusty").is_none());
}
