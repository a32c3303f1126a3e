//! What a stranger tripped over: fading, hints, notices, refusals, the seed, plots, sizes down to a point.

mod random_input;

use super::*;
use crate::window::ui::Settings;
use crate::window::ui::paint::style::ScreenTheme;
use motion_lab_core::picture::{Role, Theme};
use motion_lab_sim::manifest::Widget;

fn ui(harness: &mut Harness<'_, Lab>, change: impl FnOnce(&mut crate::window::ui::UiState)) {
    change(&mut harness.state_mut().app.world_mut().resource_mut::<Interface>().0);
    harness.run_steps(3);
}

fn lit(harness: &Harness<'_, Lab>) -> Option<Role> {
    harness.state().app.world().resource::<Interface>().0.pointer.lit
}

/// All words as painted, in this order: their text, where their ink is, and what of it the screen shows.
pub(super) fn words(harness: &Harness<'_, Lab>) -> Vec<(String, egui::Rect, egui::Rect)> {
    fn collect(shape: &egui::Shape, clip: egui::Rect, out: &mut Vec<(String, egui::Rect, egui::Rect)>) {
        match shape {
            egui::Shape::Text(egui::epaint::TextShape { galley, pos, .. }) => {
                let ink = galley.mesh_bounds.translate(pos.to_vec2());
                let text = galley.text().to_owned() + &"\u{2026}".repeat(galley.elided.into());
                out.push((text, ink, ink.intersect(clip)));
            }
            egui::Shape::Vec(shapes) => shapes.iter().for_each(|s| collect(s, clip, out)),
            _ => {}
        }
    }
    let (page, mut out) = (egui::Rect::from_min_size(Pos2::ZERO, harness.ctx.content_rect().size()), Vec::new());
    harness.output().shapes.iter().for_each(|s| collect(&s.shape, s.clip_rect.intersect(page), &mut out));
    out
}

/// Asserts that words are on the screen in whole and that nothing is written over them. Returns where they are.
pub(super) fn read_whole(harness: &Harness<'_, Lab>, wanted: &str) -> egui::Rect {
    let words = words(harness);
    let i = words.iter().position(|(text, ..)| text.contains(wanted));
    let i = i.unwrap_or_else(|| panic!("{wanted:?} is not on the screen"));
    let (text, ink, shown) = &words[i];
    assert!(shown.expand(0.5).contains_rect(*ink), "{text:?} at {ink} is cut to {shown}");
    for (other, there, _) in &words[i + 1..] {
        assert!(!there.shrink(1.0).intersects(*ink), "{other:?} at {there} is written over {text:?} at {ink}");
    }
    *ink
}

/// Whether something is painted in a colour, as an area.
fn paints(harness: &Harness<'_, Lab>, colour: egui::Color32) -> bool {
    harness.output().shapes.iter().any(|s| matches!(&s.shape, egui::Shape::Path(path) if path.fill == colour))
}

#[test]
fn pointing_at_the_drawing_or_the_words_under_it_fades_nothing() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    let rusty = harness.state().robot(0).footprint.parts()[0].pose().position();
    let paper = paper(&harness, "Apartment");
    let shown = harness.state().app.world().resource::<ShownDashboard>().0.cockpits[0].world.clone();
    let [x, y] = crate::window::ui::paint::canvas::fit(&shown, paper).screen_from_world(rusty);
    let readout = words(&harness).into_iter().find(|(text, ..)| text.starts_with("Pose2 {")).unwrap().1.center();
    for place in [pos2(x as f32, y as f32), paper.center(), paper.left_center() + egui::vec2(9.0, 0.0), readout] {
        pointer(&mut harness, place, None);
        harness.run_steps(40);
        assert_eq!(lit(&harness), None, "{place}");
    }
    for widget in ["Query", "Space", "Atlas"] {
        click(&mut harness, widget);
        let papers = harness.query_all_by_label_contains(match widget {
            "Query" => "In the",
            "Space" => "workspace. ",
            _ => "World Apartment",
        });
        let Some(middle) = papers.map(|n| n.rect().center()).next() else { continue };
        for off in [0.0, 25.0, 60.0, 120.0] {
            pointer(&mut harness, middle + egui::vec2(off, -off), None);
            harness.run_steps(20);
            assert_eq!(lit(&harness), None, "{widget}, {off}");
        }
    }
}

#[test]
fn nothing_fades_while_a_robot_is_in_hand_a_drag_or_a_refusal_is_on() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    ui(&mut harness, |ui| ui.pointer.page_lit = Some((ui.widget, Role::Obstacle)));
    harness.run_steps(10);
    assert_eq!(lit(&harness), Some(Role::Obstacle), "what the page points at");
    arm_rusty(&mut harness);
    assert_eq!(lit(&harness), None, "in hand");
    harness.key_press(Key::Escape);
    harness.run_steps(10);
    assert_eq!(lit(&harness), Some(Role::Obstacle));
    bring(&mut harness, "Reach");
    let handle = harness.get_by_label("Reach: elbow, θ₁ in radians").rect().center();
    pointer(&mut harness, handle, Some(true));
    pointer(&mut harness, handle + egui::vec2(20.0, 5.0), None);
    pointer(&mut harness, handle + egui::vec2(30.0, 9.0), None);
    harness.run_steps(10);
    assert_eq!(lit(&harness), None, "a drag");
    pointer(&mut harness, handle, Some(false));
    click(&mut harness, "Atlas");
    harness.run_steps(10);
    assert_eq!(lit(&harness), None, "what a page lit in another widget");
    ui(&mut harness, |ui| ui.pointer.page_lit = Some((ui.widget, Role::Obstacle)));
    harness.run_steps(10);
    assert_eq!(lit(&harness), Some(Role::Obstacle));
    ui(&mut harness, |ui| ui.atlas.ask(motion_lab_core::geometry::Point2::new(6.0, 6.75), None, true));
    harness.run_steps(10);
    assert_eq!(lit(&harness), None, "a refusal");
}

/// Asks for what is refused: `there is no nobody`.
fn be_refused(harness: &mut Harness<'_, Lab>) {
    let command = SessionCommand::Links { robot: "nobody".into(), links: 3 };
    carry_out(harness.state_mut().app.world_mut(), vec![crate::window::ui::Command::Session(command)]);
    harness.run_steps(4);
}

#[test]
fn a_notice_moves_nothing_and_stays_with_its_widget() {
    for size in [WIDE, PHONE] {
        let mut harness = lab(size);
        pause(&mut harness);
        let before = (paper(&harness, "Apartment"), harness.get_by_label("Step").rect());
        be_refused(&mut harness);
        read_whole(&harness, "there is no nobody");
        assert_eq!((paper(&harness, "Apartment"), harness.get_by_label("Step").rect()), before, "{size:?}");
        click(&mut harness, "Atlas");
        assert!(harness.query_by_label("there is no nobody").is_none(), "it speaks of the run");
        click(&mut harness, "Drive");
        read_whole(&harness, "there is no nobody");
        click(&mut harness, "Dismiss");
        assert!(harness.query_by_label("there is no nobody").is_none());
    }
}

#[test]
fn a_seed_that_is_none_is_kept_for_mending_and_the_reason_stands_at_its_field() {
    for size in [WIDE, [800.0, 600.0], PHONE] {
        let mut harness = lab(size);
        pause(&mut harness);
        if size == PHONE {
            click(&mut harness, "More");
        }
        let field = harness.get_by_label("seed").rect();
        let put = |harness: &mut Harness<'_, Lab>, text: &str| {
            harness.get_by_label("seed").focus();
            harness.run_steps(2);
            harness.key_combination_modifiers(Modifiers::COMMAND, &[Key::A]);
            harness.step();
            harness.event(Event::Text(text.into()));
            harness.step();
            harness.key_press(Key::Enter);
            harness.run_steps(4);
        };
        let value =
            |harness: &Harness<'_, Lab>| harness.get_by_label("seed").accesskit_node().value().unwrap_or_default();
        put(&mut harness, "12.5");
        assert_eq!(value(&harness), "12.5", "{size:?}: kept");
        let reason = read_whole(&harness, "a whole number from 0 to 18446744073709551615");
        let gap = reason.distance_to_pos(field.clamp(reason.center()));
        assert!(gap < 34.0, "{size:?}: {gap} from its field, of which half the height is 14");
        // in the menu the reason has a row of its own
        let is_same = harness.get_by_label("seed").rect() == field;
        assert!(is_same || size == PHONE, "nothing moved");
        harness.run_steps(40);
        read_whole(&harness, "a whole number from 0 to");
        // mended by one key: without the point and what follows it
        harness.get_by_label("seed").focus();
        harness.run_steps(2);
        for _ in 0..2 {
            harness.key_press(Key::Backspace);
            harness.run_steps(2);
        }
        assert!(harness.query_by_label_contains("a whole number from 0 to").is_none(), "gone when mended");
        harness.key_press(Key::Enter);
        harness.run_steps(4);
        assert_eq!(harness.state().transport().seed.0, 12);
        put(&mut harness, "a cat");
        read_whole(&harness, "a whole number from 0 to");
        harness.get_by_label("seed").focus();
        harness.run_steps(2);
        harness.key_press(Key::Escape);
        harness.run_steps(3);
        if size == PHONE {
            click(&mut harness, "More");
        }
        assert_eq!(value(&harness), "12", "Escape puts the present seed back");
        assert!(harness.query_by_label_contains("a whole number from 0 to").is_none());
    }
}

#[test]
fn refusals_are_read_whole_on_any_screen() {
    for size in [WIDE, [1000.0, 700.0], PHONE] {
        let mut harness = lab(size);
        pause(&mut harness);
        ui(&mut harness, |ui| ui.settings.world = 2);
        let to = [1.2, 2.5, 0.0].map(|v| motion_lab_sim::run::Quantized::try_new(v).unwrap()).to_vec();
        let input = RobotInput::Teleport(to);
        let command = motion_lab_sim::simulation::RobotCommand { robot: "Hitch".into(), input };
        harness.state_mut().app.world_mut().write_message(RunCommand::from(command));
        harness.run_steps(3);
        ["Step", "put a trailer on"].into_iter().for_each(|name| click(&mut harness, name));
        read_whole(&harness, "no room for a trailer: would overlap the west curb");
        ui(&mut harness, |ui| ui.settings.world = 0);
        click(&mut harness, "Atlas");
        ui(&mut harness, |ui| ui.atlas.ask(motion_lab_core::geometry::Point2::new(6.0, 6.75), None, true));
        read_whole(&harness, "would overlap B's round table");
        read_whole(&harness, "click the ring for the nearest free place");
        let long = format!("the {} shelf", "very ".repeat(20));
        let rename = motion_lab_sim::atlas::Op::Rename { name: "B's round table".into(), to: long.clone() };
        ui(&mut harness, |ui| ui.atlas.change(&rename, None));
        ui(&mut harness, |ui| ui.atlas.ask(motion_lab_core::geometry::Point2::new(6.0, 6.75), None, true));
        read_whole(&harness, "click the ring for the nearest free place");
    }
}

#[test]
fn the_arm_says_how_it_is_driven_when_its_key_or_its_paper_is_pressed() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    let says = |harness: &Harness<'_, Lab>| {
        words(harness).iter().any(|(text, ..)| text.contains("drag its elbow or tip") && text.contains("arrows turn"))
    };
    assert!(!says(&harness));
    harness.key_press(Key::Num2);
    harness.run_steps(3);
    assert!(says(&harness), "the key");
    let before = harness.state().robot(1).coordinates;
    harness.key_press(Key::ArrowUp);
    harness.run_steps(3);
    harness.key_press(Key::Num2);
    harness.run_steps(3);
    assert!(!says(&harness), "the key again lets go");
    click(&mut harness, "Step");
    let after = harness.state().robot(1).coordinates;
    assert!((after[0] - before[0] - 0.02).abs() < 1e-5 && (after[1] - before[1]).abs() < 1e-5, "{before:?} {after:?}");
    let corner = paper(&harness, "Workbench").left_bottom() + egui::vec2(12.0, -12.0);
    click_at(&mut harness, corner);
    assert!(says(&harness), "a click on its paper");
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(!says(&harness), "Escape lets go");
    // another robot is taken in hand instead
    harness.key_press(Key::Num2);
    harness.run_steps(3);
    harness.key_press(Key::Num1);
    harness.run_steps(3);
    assert!(!says(&harness));
    assert_eq!(harness.state().app.world().resource::<Interface>().0.hand.armed.as_deref(), Some("Rusty"));
    harness.key_press(Key::Num2);
    harness.run_steps(3);
    assert!(says(&harness) && harness.state().app.world().resource::<Interface>().0.hand.armed.is_none());
}

#[test]
fn a_paused_arm_is_red_only_while_it_is_in_contact() {
    let mut harness = lab(WIDE);
    let red = Theme::Light.tint(Role::Goal, 0.85);
    let mut seen = [0, 0];
    pause(&mut harness);
    while seen[0] < 3 || seen[1] < 3 {
        let alone = harness.state().robot(0).flash == 0 && harness.state().robot(2).flash == 0;
        let arm = harness.state().robot(1);
        if alone && arm.flash > 0 && seen[usize::from(arm.in_contact)] < 3 {
            seen[usize::from(arm.in_contact)] += 1;
            // longer than a flash waits for its change
            harness.run_steps(16);
            assert_eq!(paints(&harness, red), arm.in_contact, "tick {}", harness.state().transport().tick);
        }
        harness.key_press(Key::ArrowRight);
        harness.step();
        assert!(harness.state().transport().tick < 1200, "{seen:?}");
    }
}

#[test]
fn a_paused_drag_shows_one_configuration_everywhere() {
    let mut harness = lab(WIDE);
    harness.run_steps(30);
    pause(&mut harness);
    bring(&mut harness, "Reach");
    let said = |harness: &Harness<'_, Lab>| {
        let of_arm = |text: &String| text.starts_with("T2 {") || text.contains("tip: (");
        let lines: Vec<String> = words(harness).into_iter().map(|(text, ..)| text).filter(of_arm).collect();
        assert_eq!(lines.len(), 2, "{lines:?}");
        // whose input it is becomes true with the tick
        let lines: Vec<String> = lines.iter().map(|line| line.replace("  driven by hand", "")).collect();
        let fields: Vec<String> = ["Reach: θ₁", "Reach: θ₂"]
            .map(|name| format!("{:.3}", harness.get_by_label(name).accesskit_node().numeric_value().unwrap()))
            .to_vec();
        let at = ["Reach: elbow, θ₁ in radians", "Reach: tip, θ₂ in radians"]
            .map(|handle| harness.get_by_label(handle).rect().center().round());
        (lines, fields, at)
    };
    let before = said(&harness);
    let contacts = harness.state().robot(1).contacts;
    drag(&mut harness, "Reach: elbow, θ₁ in radians", [-0.6, 0.9]);
    let dragged = said(&harness);
    harness.get_by_label("comes with the next tick");
    for (now, then) in [(&dragged.0[0], &before.0[0]), (&dragged.0[1], &before.0[1])] {
        assert_ne!(now, then, "the readout is where the ghost is");
    }
    assert!(dragged.0[0].contains(&dragged.1[0]), "{dragged:?}");
    click(&mut harness, "Step");
    assert_eq!(harness.state().robot(1).contacts, contacts, "the test compares a line with the count in it");
    assert_eq!(said(&harness), dragged, "what was shown is what comes");
    assert!(harness.query_by_label("comes with the next tick").is_none());
}

#[test]
fn every_plot_has_ticks_and_a_legend_at_every_size() {
    for size in [WIDE, [800.0, 600.0], [1000.0, 600.0], [1920.0, 1080.0], PHONE] {
        let mut harness = lab(size);
        ui(&mut harness, |ui| (ui.settings.plots, ui.hidden_plots) = (true, vec![1, 2]));
        harness.run_steps(200);
        pause(&mut harness);
        harness.run_steps(20);
        let titles = ["Distance to the nearest obstacle, m", "Joint angles, rad"];
        let names = [&["Rusty", "Reach", "Hitch"][..], &["Reach theta1", "Reach theta2"]];
        let all = words(&harness);
        let bar = harness.get_by_label("time line, in ticks").rect().top();
        let tops: Vec<f32> = titles
            .iter()
            .map(|title| {
                let found = all.iter().filter(|(text, ink, _)| text == title && ink.height() < 14.0);
                found.map(|(_, ink, _)| ink.bottom()).fold(0.0, f32::max)
            })
            .chain([bar])
            .collect();
        for (i, names) in names.iter().enumerate() {
            let here = |ink: &egui::Rect| ink.top() > tops[i] - 2.0 && ink.bottom() < tops[i + 1] - 2.0;
            for name in *names {
                let known = all.iter().find(|(text, ink, _)| text.ends_with(name) && ink.bottom() < tops[i + 1]);
                let (text, ink, shown) = known.unwrap_or_else(|| panic!("{size:?}: {name} in {}", titles[i]));
                assert!(shown.expand(0.5).contains_rect(*ink), "{size:?}: {text} is cut");
            }
            let left = if size[0] < 720.0 { 0.0 } else { size[0] - 345.0 };
            let numbers = all.iter().filter(|(text, ink, shown)| {
                let number = text.replace('\u{2212}', "-").trim_end_matches(" s").parse::<f64>().is_ok();
                number && here(ink) && ink.left() > left && shown.expand(0.5).contains_rect(*ink)
            });
            let numbers: Vec<(&str, egui::Rect)> = numbers.map(|(text, ink, _)| (text.as_str(), *ink)).collect();
            let foot = numbers.iter().map(|(_, ink)| ink.center().y).fold(0.0, f32::max);
            let (across, up): (Vec<_>, Vec<_>) =
                numbers.iter().copied().partition(|(_, ink)| foot - ink.center().y < 4.0);
            assert!(across.len() >= 3 && up.len() >= 3, "{size:?}, {}: {across:?} {up:?}", titles[i]);
        }
    }
}

#[test]
fn no_size_is_too_small() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    ui(&mut harness, |ui| ui.settings = Settings::default());
    let sizes = [1.0, 2.0, 7.0, 20.0, 40.0, 60.0, 80.0, 100.0];
    let states: [fn(&mut crate::window::ui::UiState); 5] = [
        |_| {},
        |ui| ui.settings.plots = true,
        |ui| ui.help = true,
        |ui| (ui.help, ui.capture.open) = (false, true),
        |ui| (ui.capture.open, ui.settings.plots, ui.settings.labels, ui.settings.scan) = (false, false, true, true),
    ];
    for widget in Widget::ALL {
        for state in states {
            ui(&mut harness, |ui| ui.widget = widget);
            ui(&mut harness, state);
            for width in sizes {
                for height in sizes {
                    harness.set_size(egui::vec2(width, height));
                    harness.run_steps(2);
                }
            }
        }
    }
}
