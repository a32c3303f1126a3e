//! Tests of lenses: expectations by hand on the chapter's arm.

use super::{Lens, LensPaper};
use crate::anatomy::{Anatomy, Tab};
use crate::manifest::{HintTask, Lesson, Widget};
use motion_lab_core::configuration::{AnyConfiguration, Configuration, T2};
use motion_lab_core::geometry::Point2;
use motion_lab_core::num::sin_cos;
use std::f64::consts::PI;

const SIZE: [f64; 2] = [400.0, 400.0];

fn at(th1: f64, th2: f64) -> AnyConfiguration {
    AnyConfiguration::T2(T2::new(th1, th2))
}

fn space() -> Lens {
    let mut lens = Lens::new(Widget::Cspace, Anatomy::default()).unwrap();
    while lens.refine(5_000) {}
    lens
}

#[test]
fn what_moves_by_itself_or_is_edited_does_not_stand_still() {
    let is_lens = |widget| Lens::new(widget, Anatomy::default()).is_some();
    assert_eq!(Widget::ALL.map(is_lens), [false, true, true, false, false]);
    let anatomy = Lens::new(Widget::Anatomy, Anatomy::default()).unwrap();
    assert_eq!(anatomy.bounds(LensPaper::Space), None);
    assert_eq!(anatomy.still(LensPaper::Space, SIZE) + &anatomy.moving(LensPaper::Space, SIZE), "");
}

#[test]
fn a_tip_that_is_dragged_comes_to_the_point_under_the_pointer() {
    let mut lens = Lens::new(Widget::Anatomy, Anatomy::default()).unwrap();
    // the Workbench is as high as it is wide, and its middle is the paper's
    let bounds = lens.bounds(LensPaper::World).unwrap();
    let middle = Point2::new(0.5 * (bounds.min.x + bounds.max.x), 0.5 * (bounds.min.y + bounds.max.y));
    let scale = (SIZE[0] - 16.0) / (bounds.max.x - bounds.min.x);
    let wanted = Point2::new(middle.x + 0.9, middle.y + 0.6);
    let under = lens.point(LensPaper::World, SIZE, [200.0 + 0.9 * scale, 200.0 - 0.6 * scale]).unwrap();
    assert!((under - wanted).norm() < 1e-12, "{under}");
    lens.drag(LensPaper::World, under);
    let [x, y] = lens.handle(LensPaper::World, SIZE).unwrap();
    assert!((x - (200.0 + 0.9 * scale)).abs() < 1e-6 && (y - (200.0 - 0.6 * scale)).abs() < 1e-6, "{x} {y}");
    let AnyConfiguration::T2(q) = lens.anatomy().q() else { panic!("an arm's") };
    // the chapter's links are a metre long, from a base at the origin
    let [(s1, c1), (s12, c12)] = [q.th1(), q.th1() + q.th2()].map(sin_cos);
    let tip = Point2::new(c1 + c12, s1 + s12);
    assert!((tip - wanted).norm() < 1e-9, "{tip}");
}

#[test]
fn a_lesson_is_done_when_the_hand_lets_go() {
    let mut lens = Lens::new(Widget::Anatomy, Lesson::of("near").unwrap().scene(None)).unwrap();
    assert_eq!(lens.anatomy().tab, Tab::Witness);
    // at 1.42 rad of the elbow it is 7 mm off the block, at 1.39 it touches
    lens.change(|anatomy| anatomy.set_coordinate(1, 1.42));
    assert_eq!(lens.take_done(), [], "the hand may only pass through");
    lens.change(|anatomy| anatomy.set_coordinate(1, 1.5));
    lens.let_go();
    assert_eq!(lens.take_done(), []);
    lens.change(|anatomy| anatomy.set_coordinate(1, 1.42));
    lens.let_go();
    assert_eq!((lens.take_done(), lens.take_done()), (vec![HintTask::Near], vec![]), "once");
    lens.let_go();
    assert_eq!(lens.take_done(), [], "nothing was held");
}

#[test]
fn the_point_goes_over_an_edge_of_the_torus_and_two_points_with_one_tip_are_seen() {
    let mut lens = space();
    lens.drag(LensPaper::Space, Point2::new(PI + 0.2, 0.4));
    let q = lens.anatomy().q().coordinates();
    assert!((q[0] - (0.2 - PI)).abs() < 1e-12 && q[1] == 0.4, "{q:?}");
    assert_eq!(lens.take_done(), [HintTask::MovePoint, HintTask::OverEdge]);
    lens.drag(LensPaper::Space, Point2::new(0.4, 0.9));
    assert_eq!(lens.take_done(), [HintTask::MovePoint]);
    // for links of equal length the other elbow is (th1 + th2, -th2)
    lens.drag(LensPaper::Space, Point2::new(1.3, -0.9));
    assert_eq!(lens.take_done(), [HintTask::TwoPoints, HintTask::MovePoint]);
    assert_eq!(lens.trace(), [at(0.2 - PI, 0.4), at(0.4, 0.9), at(1.3, -0.9)]);
}

#[test]
fn keys_go_over_the_edge_too_and_what_a_page_sets_is_no_task() {
    let mut lens = space();
    lens.set(|anatomy| anatomy.set_coordinate(0, 3.12));
    lens.nudge(1, 0.05);
    assert_eq!(lens.take_done(), [HintTask::MovePoint]);
    lens.nudge(0, 0.05);
    assert_eq!(lens.take_done(), [HintTask::MovePoint, HintTask::OverEdge]);
    assert!((lens.anatomy().q().coordinates()[0] - (3.17 - 2.0 * PI)).abs() < 1e-12);
    lens.nudge(7, 0.05);
    assert_eq!(lens.take_done(), [], "it has two coordinates");
    let mut near = Lens::new(Widget::Anatomy, Anatomy::default().with_tab(Tab::Witness)).unwrap();
    near.change(|anatomy| anatomy.set_coordinate(1, 1.5));
    near.set(|anatomy| anatomy.set_coordinate(1, 1.42));
    near.let_go();
    assert_eq!(near.take_done(), []);
}

#[test]
fn who_presses_at_the_axes_takes_no_point() {
    let lens = space();
    // the chart's left edge is an eighth of the picture in: names and figures stand before it
    let handle = lens.handle(LensPaper::Space, SIZE).unwrap();
    assert!(lens.takes(LensPaper::Space, SIZE, handle) && lens.takes(LensPaper::Space, SIZE, [200.0, 200.0]));
    assert!(!lens.takes(LensPaper::Space, SIZE, [10.0, 200.0]) && !lens.takes(LensPaper::Space, SIZE, [200.0, 396.0]));
    assert!(lens.takes(LensPaper::World, SIZE, [10.0, 200.0]));
    let anatomy = Lens::new(Widget::Anatomy, Anatomy::default()).unwrap();
    assert!(!anatomy.takes(LensPaper::Space, SIZE, [200.0, 200.0]));
}

#[test]
fn cells_are_judged_anew_for_other_links_and_the_trace_of_the_old_ones_goes() {
    let mut lens = space();
    lens.drag(LensPaper::Space, Point2::new(0.4, 0.9));
    let blocked = |lens: &Lens| lens.cells().unwrap().map().progress().blocked;
    let bare = blocked(&lens);
    lens.change(|anatomy| anatomy.set_thick_links(true));
    while lens.refine(5_000) {}
    assert!(blocked(&lens) > bare, "thick links are in the way more often");
    assert_eq!(lens.trace(), []);
}

#[test]
fn words_are_those_of_the_lens() {
    let witness = Lens::new(Widget::Anatomy, Anatomy::default().with_tab(Tab::Witness)).unwrap().words();
    // the chapter's distance
    assert_eq!((witness.answer.as_str(), witness.touches), ("|a* \u{2212} b*| = 0.0607 m", false));
    assert_eq!(
        witness.sliders.iter().map(|s| (s.value, s.least, s.most)).collect::<Vec<_>>(),
        [(PI / 4.0, -PI, PI), (PI / 2.0, -PI, PI)]
    );
    assert!(witness.steps.is_empty() && witness.thick == Some((0.03, false)) && witness.annulus == Some(false));
    let swept = Lens::new(Widget::Anatomy, Anatomy::default().with_tab(Tab::Swept)).unwrap().words();
    assert_eq!(swept.steps.iter().map(|s| (s.value, s.most)).collect::<Vec<_>>(), [(-PI / 2.0, PI), (0.0, PI)]);
    assert!(swept.steps[0].name.starts_with("step of "), "{:?}", swept.steps);
    let known = space().words();
    assert!((known.question, known.answer.as_str()) == ("", "free, 0.0607 m") && known.steps.is_empty());
    assert!(known.details.iter().any(|line| line.starts_with("proven free ")), "{:?}", known.details);
}
