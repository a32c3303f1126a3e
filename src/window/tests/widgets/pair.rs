//! The pair: beside where the robot is, which point of its configuration space it is.

use super::*;
use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::configuration::{Configuration, Tn};
use motion_lab_core::cspace::CellState;
use motion_lab_core::geometry::{Point2, Vector2};
use motion_lab_core::picture::Picture;
use motion_lab_core::robots::{Reach, Robot};
use motion_lab_core::worlds::World;
use motion_lab_sim::atlas::Atlas;

/// Where a point of a chart is on the screen.
fn on_chart(harness: &Harness<'_, Lab>, still: &Picture, [x, y]: [f64; 2]) -> Pos2 {
    let paper = harness.get_by_label_contains("configuration space").rect();
    let [x, y] = crate::window::ui::paint::canvas::fit(still, paper).screen_from_world(Point2::new(x, y));
    pos2(x as f32, y as f32)
}

fn drag_between(harness: &mut Harness<'_, Lab>, from: Pos2, to: Pos2) {
    pointer(harness, from, Some(true));
    (1..=10).for_each(|i| pointer(harness, from.lerp(to, i as f32 / 10.0), None));
    pointer(harness, to, Some(false));
    harness.run_steps(2);
}

#[test]
fn the_point_beside_the_questions_is_the_robot_that_is_asked_about() {
    for size in [WIDE, TABLET, [600.0, 500.0]] {
        let mut harness = lab(size);
        click(&mut harness, "Query");
        click(&mut harness, "distance");
        let asked = interface(&harness).anatomy.anatomy.clone();
        let still = interface(&harness).cspace.still(&asked).expect("a chart").clone();
        let here = asked.q().coordinates();
        let [from, to] = [[here[0], here[1]], [0.3, -2.0]].map(|at| on_chart(&harness, &still, at));
        drag_between(&mut harness, from, to);
        let q = interface(&harness).anatomy.anatomy.q().coordinates();
        assert!((q[0] - 0.3).abs() < 0.03 && (q[1] + 2.0).abs() < 0.03, "{size:?}: {q:?}");
        // what is said is the distance of the arm with bare links on the Workbench there
        let bare = Reach::<2> { link_radius: 0.0, ..Reach::workbench() };
        let footprint = bare.footprint(&Tn([q[0], q[1]]));
        harness.get_by_label(&format!("distance: {:.4} m", Scene::workbench().distance(&footprint)));
    }
    // a phone has Space for it
    let mut harness = lab(PHONE);
    click(&mut harness, "Query");
    assert!(harness.query_by_label_contains("configuration space").is_none());
}

#[test]
fn a_thing_that_is_dragged_moves_its_region_of_the_space_while_it_is_held() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    let known = |harness: &Harness<'_, Lab>, at: [f64; 2]| {
        atlas(harness).space().map(|space| space.cells().map().state(at)).expect("Rusty lives there")
    };
    let (table, beside) = ([6.0, 6.75], [6.0, 5.5]);
    let is_free = |state: CellState| state == CellState::Free;
    assert_eq!([table, beside].map(|at| is_free(known(&harness, at))), [false, true]);
    let [from, to] = [table, beside].map(|p| at(&harness, p));
    pointer(&mut harness, from, Some(true));
    (1..=10).for_each(|i| pointer(&mut harness, from.lerp(to, i as f32 / 10.0), None));
    harness.run_steps(2);
    assert_eq!(*atlas(&harness).world(), World::apartment(), "it is only held there");
    assert_eq!([table, beside].map(|at| is_free(known(&harness, at))), [true, false]);
    harness.run_steps(20);
    let judged = atlas(&harness).space().map(|space| space.cells().map().progress());
    assert!(judged.is_some_and(|known| known.done), "held still, it is known to its finest cells");
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert_eq!([table, beside].map(|at| is_free(known(&harness, at))), [false, true]);
}

#[test]
fn a_robot_is_put_by_a_click_in_its_space_where_it_is_free() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    harness.run_steps(2);
    let still = Picture::clone(atlas(&harness).space().expect("Rusty lives there").cells().picture());
    let there = |harness: &Harness<'_, Lab>| atlas(harness).atlas().robots()[0].q.coordinates();
    let (start, free) = (there(&harness), on_chart(&harness, &still, [6.0, 4.2]));
    let table = on_chart(&harness, &still, [6.0, 6.75]);
    click_at(&mut harness, table);
    harness.run_steps(2);
    assert_eq!(there(&harness), start);
    assert!(atlas(&harness).refusal().is_some_and(|words| words.contains("B's round table")));
    click_at(&mut harness, free);
    harness.run_steps(2);
    let put = there(&harness);
    assert!((Vector2::new(put[0], put[1]) - Vector2::new(6.0, 4.2)).norm() < 0.1, "{put:?}");
    assert_eq!((put[2], atlas(&harness).refusal()), (start[2], None), "it keeps its heading");
    // while the world is edited, robots stand at their starts
    click(&mut harness, "Edit");
    click_at(&mut harness, free + egui::vec2(20.0, 0.0));
    harness.run_steps(2);
    assert_eq!((there(&harness), atlas(&harness).world()), (put, Atlas::new(World::apartment()).world()));
}

#[test]
fn a_small_window_has_the_task_in_sight_and_a_large_picture() {
    for (size, share) in [(PHONE, 0.28), ([600.0, 500.0], 0.4)] {
        let mut harness = lab(size);
        interface_mut(&mut harness).settings.hints_away.clear();
        for widget in motion_lab_sim::manifest::Widget::ALL {
            click(&mut harness, widget.text().short());
            let task = &widget.text().hints.first().expect("each has tasks").text;
            let first =
                task.split(' ').next().expect("a word").replace("Click", if size == PHONE { "Tap" } else { "Click" });
            let window = egui::Rect::from_min_size(Pos2::ZERO, size.into());
            let said = harness.get_all_by_role(egui::accesskit::Role::Link).any(|link| {
                let label = link.accesskit_node().label().unwrap_or_default();
                label.starts_with(&first) && window.contains_rect(link.rect())
            });
            assert!(said, "{size:?}, {widget:?}: {task}");
        }
        click(&mut harness, "Drive");
        let paper = paper(&harness, "Apartment");
        assert!(paper.height() >= share * size[1], "{size:?}: {paper}");
    }
}
