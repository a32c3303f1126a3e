//! The configuration space, behaviour by behaviour.

use super::*;
use crate::window::ui::paint::style::ScreenTheme;
use motion_lab_core::configuration::Configuration;
use motion_lab_core::cspace::{CellMap, Overlay, Slice, cspace_picture};
use motion_lab_sim::anatomy::Anatomy;

fn ui(harness: &Harness<'_, Lab>) -> crate::window::ui::UiState {
    harness.state().app.world().resource::<Interface>().0.clone()
}

fn anatomy(harness: &Harness<'_, Lab>) -> Anatomy {
    ui(harness).anatomy.anatomy
}

/// What a capture shows on the right: the picture of the configuration space.
fn shown(harness: &Harness<'_, Lab>) -> motion_lab_core::picture::Picture {
    let captured = ui(harness).cspace.captured(&anatomy(harness)).unwrap();
    captured.figure.panels.last().unwrap().picture.clone()
}

/// Where a point of the torus is on the screen.
fn at(harness: &Harness<'_, Lab>, [x, y]: [f64; 2]) -> Pos2 {
    let paper = harness.get_by_label_contains("configuration space. The robot is the point").rect();
    let anatomy = anatomy(harness);
    let slice = Slice::through(anatomy.checker(), &anatomy.q()).unwrap();
    let fit =
        crate::window::ui::paint::canvas::fit(&cspace_picture(&CellMap::new(slice, 1), &Overlay::default()), paper);
    let [x, y] = fit.screen_from_world(motion_lab_core::geometry::Point2::new(x, y));
    pos2(x as f32, y as f32)
}

fn lines(picture: &motion_lab_core::picture::Picture, id: &str) -> Option<usize> {
    let item = picture.items.iter().find(|i| i.id == id)?;
    match &item.drawing {
        motion_lab_core::picture::Drawing::Region { outline, .. } => Some(outline.len()),
        _ => None,
    }
}

#[test]
fn dragging_the_point_moves_the_arm_leaves_a_trace_and_goes_over_the_edge() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Space");
    harness.run_steps(3);
    assert_eq!(lines(&shown(&harness), "trace"), None);
    let (from, to) = (at(&harness, [2.6, 0.4]), at(&harness, [3.5, 0.4]));
    pointer(&mut harness, from, Some(true));
    for i in 1..=12 {
        pointer(&mut harness, from.lerp(to, i as f32 / 12.0), None);
    }
    pointer(&mut harness, to, Some(false));
    harness.run_steps(3);
    let q = anatomy(&harness).q().coordinates();
    // 3.5 less a whole turn
    assert!((q[0] + 2.783).abs() < 0.02 && (q[1] - 0.4).abs() < 0.02, "on the other side: {q:?}");
    let picture = shown(&harness);
    assert!(lines(&picture, "trace") >= Some(2), "a trace in pieces, and none goes across the square");
    let trace = picture.items.iter().find(|i| i.id == "trace").unwrap();
    let motion_lab_core::picture::Drawing::Region { outline, .. } = &trace.drawing else { panic!("lines") };
    assert!(outline.iter().flat_map(|l| l.windows(2)).all(|w| (w[1] - w[0]).norm() < 1.0), "{outline:?}");
    // the arm is dragged too, and its point goes along
    let paper = harness.get_by_label_contains("workspace. Reach").rect();
    click_at(&mut harness, paper.center() + egui::vec2(40.0, -60.0));
    assert_ne!(anatomy(&harness).q().coordinates(), q);
}

#[test]
fn far_off_the_edge_the_point_goes_on_from_the_other_one() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Space");
    harness.run_steps(3);
    let is_ticked = |h: &Harness<'_, Lab>| interface(h).settings.done.iter().any(|task| task == "OverEdge");
    let (from, to) = (at(&harness, [-2.6, 0.4]), at(&harness, [-4.5, 0.4]));
    pointer(&mut harness, from, Some(true));
    pointer(&mut harness, from.lerp(to, 0.2), None);
    assert!(!is_ticked(&harness), "it is on the square still");
    (1..=8).for_each(|i| pointer(&mut harness, from.lerp(to, 0.2 + 0.1 * i as f32), None));
    // a whole turn on from -4.5
    let q = anatomy(&harness).q().coordinates();
    assert!((q[0] - (std::f64::consts::TAU - 4.5)).abs() < 0.02 && (q[1] - 0.4).abs() < 0.02, "{q:?}");
    assert!(is_ticked(&harness));
    pointer(&mut harness, to, Some(false));
}

#[test]
fn one_tip_is_two_points_and_the_annulus_and_the_chart_line_come_on_demand() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Space");
    harness.run_steps(3);
    let picture = shown(&harness);
    let rings = picture.items.iter().filter(|i| i.id.starts_with("solution/")).count();
    assert_eq!(rings, 2);
    let tip = |q| anatomy(&harness).checker().robot().reference(&q);
    let solutions = anatomy(&harness).solutions();
    assert!(solutions.len() == 2 && (tip(solutions[0]) - tip(solutions[1])).norm() < 1e-9);
    assert_eq!(lines(&picture, "line"), None);
    let has = |h: &Harness<'_, Lab>, id: &str| anatomy(h).overlay().items.iter().any(|i| i.id == id);
    assert!(!has(&harness, "annulus/outer circle"));
    click(&mut harness, "the tip's reach");
    assert!(has(&harness, "annulus/outer circle"));
    click(&mut harness, "Query's motion");
    assert_eq!(lines(&shown(&harness), "line"), Some(1));
    // a motion over the edge of the square is a line in two pieces
    let state = &mut harness.state_mut().app.world_mut().resource_mut::<Interface>().into_inner().0;
    state.anatomy.anatomy.set_coordinate(0, -3.0);
    state.anatomy.anatomy.set_step(0, -0.6);
    harness.run_steps(2);
    assert_eq!(lines(&shown(&harness), "line"), Some(2));
}

#[test]
fn no_ghost_is_drawn_over_the_arm_itself() {
    use std::f64::consts::PI;
    let mut harness = lab(WIDE);
    click(&mut harness, "Space");
    let colour =
        format!("{:?}", motion_lab_core::picture::Theme::Light.tint(motion_lab_core::picture::Role::Robot, 0.5));
    let is_painted =
        |harness: &Harness<'_, Lab>| harness.output().shapes.iter().any(|s| format!("{:?}", s.shape).contains(&colour));
    for (bend, has_ghost) in [(1.2, true), (0.0, false), (-0.7, true), (PI, false), (-PI, false)] {
        interface_mut(&mut harness).anatomy.anatomy.set_coordinate(1, bend);
        harness.run_steps(3);
        assert_eq!(is_painted(&harness), has_ghost, "bent by {bend}");
    }
}

#[test]
fn a_press_beside_the_chart_takes_no_point() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Space");
    harness.run_steps(3);
    let q = anatomy(&harness).q();
    let done = interface(&harness).settings.done.clone();
    // the figures at the axes stand in the margin, left of -pi and below it
    for from in [[-3.6, 0.4], [0.4, -3.5]] {
        let (from, to) = (at(&harness, from), at(&harness, [0.4, 0.4]));
        pointer(&mut harness, from, Some(true));
        (1..=8).for_each(|i| pointer(&mut harness, from.lerp(to, i as f32 / 8.0), None));
        assert_eq!(anatomy(&harness).q(), q, "dragged into the chart");
        pointer(&mut harness, to, Some(false));
        click_at(&mut harness, from);
        assert_eq!(anatomy(&harness).q(), q, "clicked in the margin");
    }
    harness.run_steps(3);
    assert_eq!(interface(&harness).settings.done, done, "no task is done");
    let on_chart = at(&harness, [0.4, 0.4]);
    click_at(&mut harness, on_chart);
    assert_ne!(anatomy(&harness).q(), q);
}

#[test]
fn the_key_names_both_arms_only_of_an_arm_that_has_them() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Space");
    for (name, has_two) in
        [("Reach, three links", false), ("Rusty", false), ("Reach, 3 cm links", true), ("Hitch", false)]
    {
        let robot = Anatomy::choices().into_iter().find(|(choice, _)| *choice == name).unwrap().1;
        let state = &mut interface_mut(&mut harness).anatomy;
        state.anatomy = state.anatomy.at_home(robot);
        harness.run_steps(3);
        let named = |words: &str| harness.query_by_label_contains(words).is_some();
        assert_eq!(named("colour key: both arms with this tip"), has_two, "{name}");
        assert!(named("colour key: robot"));
    }
}
