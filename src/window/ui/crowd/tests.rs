use std::sync::Arc;

use bevy_egui::egui::{Rect, pos2};

use super::heat::Heat;
use super::members::Members;
use super::robots::robots;
use super::state::CrowdState;
use super::values::{CrowdRobot, CrowdView, Stance};
use crate::window::ui::FrameColours;
use crate::window::ui::paint::camera::Camera;
use motion_lab_core::configuration::{Configuration as _, Coordinates};
use motion_lab_core::geometry::{Aabb, Footprint, Point2, Pose2, Vector2};
use motion_lab_core::num::greater;
use motion_lab_core::picture::{Fit, Role, ScreenRect, Theme};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::robots::{AnyRobot, Robot as _};
use motion_lab_sim::simulation::{Happening, TickMark};

const YARD: Aabb = Aabb::new(Point2::new(0.0, 0.0), Point2::new(40.0, 20.0));

/// Ten points a metre: the yard on 400 by 200 points.
fn whole() -> Fit {
    Fit::new(&YARD, ScreenRect { min: [0.0, 0.0], size: [400.0, 200.0] }, 0.0)
}

fn paper() -> Rect {
    Rect::from_min_max(pos2(0.0, 0.0), pos2(400.0, 200.0))
}

/// A robot: its footprint, its heading and its contacts.
type Robot = (Footprint, Option<f64>, u32);

fn rover(x: f64, y: f64, radius: f64) -> Robot {
    (Footprint::disc(Point2::new(x, y), radius), Some(0.0), 0)
}

fn over(robots: &[Robot]) -> Arc<Vec<CrowdRobot>> {
    let robot = |(footprint, heading, contacts): &Robot| {
        let stance = Stance::Over(Arc::new(footprint.clone()), *heading);
        CrowdRobot { stance, flash: false, contacts: *contacts }
    };
    Arc::new(robots.iter().map(robot).collect())
}

/// A crowd of robots of kinds that are not the lab's.
fn crowd(before: &[Robot], now: &[Robot], between: f64) -> CrowdView {
    let names = (0..now.len()).map(|i| format!("Rover {}", i + 7)).collect();
    let mut members = Members::default();
    now.iter().for_each(|_| members.push(None));
    CrowdView { first: 7, names, members: Arc::new(members), now: over(now), before: over(before), between }
}

/// A crowd of one robot of a kind of the lab's, on its way from one configuration to another.
fn one(kind: &str, before: &[f64], now: &[f64], between: f64) -> CrowdView {
    let mut members = Members::default();
    members.push(AnyRobot::of_kind(kind, now));
    let stands = |q: &[f64]| {
        let stance = Stance::In(Coordinates::from_slice(q));
        Arc::new(vec![CrowdRobot { stance, flash: false, contacts: 0 }])
    };
    let names = Arc::from(["one".to_owned()]);
    CrowdView { first: 0, names, members: Arc::new(members), now: stands(now), before: stands(before), between }
}

fn still(robots: &[Robot]) -> CrowdView {
    crowd(robots, robots, 1.0)
}

#[test]
fn what_is_under_the_pointer_stays_there_while_it_is_magnified() {
    let (whole, at) = (whole(), Point2::new(31.0, 4.0));
    let mut camera = Camera::default();
    let on_screen = |camera: &Camera| camera.fit(&whole, &YARD, 1.0).screen_from_world(at);
    let before = on_screen(&camera);
    for factor in [1.7, 2.5, 0.6, 3.0] {
        camera.zoom_at(at, factor, &whole, &YARD);
        let [x, y] = on_screen(&camera);
        assert!((x - before[0]).abs() <= 0.51 && (y - before[1]).abs() <= 0.51, "to the pixel: {x} {y} {before:?}");
    }
    assert!((camera.zoom - 1.7 * 2.5 * 0.6 * 3.0).abs() < 1e-9);
    camera.zoom_at(at, 1e9, &whole, &YARD);
    assert_eq!(camera.zoom * whole.px_per_metre(), 400.0, "no larger than 400 points a metre");
    camera.zoom_at(at, 1e-9, &whole, &YARD);
    assert_eq!(camera, Camera::default(), "no smaller than the whole world, which is centred again");
    // following in a world that is seen whole does not move it; in one that became smaller the middle is still in it
    camera.look_at(Point2::new(1.0, 1.0), &YARD);
    assert_eq!(camera.fit(&whole, &YARD, 1.0), whole);
    let mut near = Camera { zoom: 4.0, ..camera };
    near.look_at(Point2::new(39.0, 19.0), &YARD);
    let smaller = Aabb::new(Point2::new(0.0, 0.0), Point2::new(10.0, 5.0));
    assert_eq!(
        near.fit(&whole, &smaller, 1.0).screen_from_world(Point2::new(10.0, 5.0)),
        [200.0, 100.0],
        "on the paper"
    );
    camera.look_at(Point2::new(55.0, -3.0), &YARD);
    assert_eq!(camera.centre, Some(Point2::new(40.0, 0.0)), "the middle of the view is in the world");
}

#[test]
fn the_nearest_robot_is_that_whose_box_is_nearest() {
    let crowd = still(&[rover(5.0, 5.0, 2.0), rover(6.0, 5.0, 0.2), rover(20.0, 5.0, 0.2)]);
    let at = |x, y, reach| crowd.nearest(Point2::new(x, y), reach);
    assert_eq!(at(6.1, 5.0, 0.1), Some(8), "both boxes hold the point, and the middle of this one is nearer");
    assert_eq!(at(4.0, 5.0, 0.1), Some(7));
    assert_eq!(at(20.5, 5.0, 0.31), Some(9), "0.3 m from its box");
    assert_eq!(at(20.5, 5.0, 0.29), None);
    assert_eq!(crowd.name(8), Some("Rover 8"));
    assert_eq!([crowd.name(6), crowd.name(10)], [None, None], "ids of other crowds");
}

#[test]
fn a_crowd_is_one_mesh_of_what_the_paper_shows() {
    // 0.1 m are a point: too small for an outline
    let dots = still(&[rover(5.0, 5.0, 0.1), rover(39.0, 19.0, 0.1), rover(60.0, 5.0, 0.1)]);
    let look = FrameColours::from(Theme::Light);
    let mesh = robots(&dots, paper(), &whole(), &look, |_, _| Some(Role::Robot)).0;
    assert_eq!(mesh.vertices.len(), 8, "two squares; the third is beside the paper");
    assert!(mesh.vertices.iter().all(|v| v.color == look.colour(Role::Robot)));
    let corners = Rect::from_points(&mesh.vertices.iter().take(4).map(|v| v.pos).collect::<Vec<_>>());
    assert_eq!(
        corners,
        Rect::from_center_size(pos2(50.0, 150.0), bevy_egui::egui::Vec2::splat(2.0)),
        "2 m across is 2"
    );

    let without = robots(&dots, paper(), &whole(), &look, |id, _| (id != 8).then_some(Role::Robot)).0;
    assert_eq!(without.vertices.len(), 4, "one is left out");

    // a disc of ten points: within a tenth of a point of its circle, and the pointer on it
    let disc = still(&[rover(5.0, 5.0, 1.0)]);
    let mesh = robots(&disc, paper(), &whole(), &look, |id, _| (id == 7).then_some(Role::Goal)).0;
    let body: Vec<f32> = mesh
        .vertices
        .iter()
        .filter(|v| v.color == look.tint(Role::Goal, 0.85))
        .map(|v| (v.pos - pos2(50.0, 150.0)).length())
        .collect();
    assert!(body.len() >= 12 && body.iter().all(|r| (r - 9.5).abs() < 0.15), "half a point inside: {body:?}");
    assert!(mesh.vertices.iter().any(|v| v.color == look.tint(Role::Paper, 0.9)), "its heading");
}

#[test]
fn robots_are_drawn_on_their_way_and_not_while_they_leap() {
    let middle = |crowd: &CrowdView| {
        let mesh = robots(crowd, paper(), &whole(), &FrameColours::from(Theme::Dark), |_, _| Some(Role::Robot)).0;
        mesh.calc_bounds().center()
    };
    let on_the_way = crowd(&[rover(5.0, 5.0, 1.0)], &[rover(5.4, 5.2, 1.0)], 0.25);
    let at = middle(&on_the_way);
    assert!((at - pos2(51.0, 149.5)).length() < 1e-3, "a quarter of 0.4 m and 0.2 m: {at}");
    let leap = crowd(&[rover(5.0, 5.0, 1.0)], &[rover(9.0, 5.0, 1.0)], 0.25);
    assert!((middle(&leap) - pos2(90.0, 150.0)).length() < 1e-3, "it was put there");
    // a car turning: its corners are on the way too
    let car = |theta| {
        let at = Pose2::new(5.0, 5.0, theta);
        (Footprint::rects([(at, Point2::new(-1.0, -0.5), Point2::new(1.0, 0.5))]), None, 0)
    };
    let turning = crowd(&[car(0.0)], &[car(0.2)], 0.5);
    let mesh = robots(&turning, paper(), &whole(), &FrameColours::from(Theme::Dark), |_, _| Some(Role::Robot)).0;
    // the corner (1, 0.5) turned by 0.1, half of 0.2, is at (0.9451, 0.5973)
    let near = |v: &bevy_egui::egui::epaint::Vertex| (v.pos - pos2(59.45, 144.03)).length();
    assert!(mesh.vertices.iter().map(near).any(|gap| gap < 0.75));
}

#[test]
fn a_circle_holds_a_robot_of_the_labs_in_every_configuration() {
    let mut s = Stream::new(Seed(11), "circles");
    for (kind, start) in [
        ("rusty", &[0.0; 3][..]),
        ("reach", &[0.0; 2][..]),
        ("reach3", &[0.0; 3][..]),
        ("hitch", &[0.0; 3][..]),
        ("hitch", &[0.0; 4][..]),
    ] {
        let (robot, _) = AnyRobot::of_kind(kind, start).unwrap();
        let mut farthest = 0.0;
        for _ in 0..200 {
            let q = robot.sample(Point2::new(1.0, 2.0), Point2::new(9.0, 8.0), &mut s).coordinates();
            let crowd = one(kind, &q, &q, 1.0);
            let (spot, (footprint, _)) = (crowd.spot(0).unwrap(), crowd.footprint(0).unwrap());
            for part in footprint.parts() {
                for p in part.placed().core() {
                    farthest = greater(farthest, (p - spot.centre).norm() + part.placed().radius());
                }
            }
            assert!(farthest <= spot.radius + 1e-9, "{kind}: {farthest} of {}", spot.radius);
        }
        // it is no larger than it need be; a car's has room for a trailer
        let spot = one(kind, start, start, 1.0).spot(0).unwrap();
        assert!(farthest > 0.9 * spot.radius || start.len() == 3 && kind == "hitch", "{kind}: {farthest}");
    }
}

#[test]
fn a_robot_of_the_labs_is_drawn_on_its_way_in_its_chart() {
    // a car that turns through pi: its heading goes the short way
    let turning = one("hitch", &[3.0, 4.0, 3.1], &[3.2, 4.0, -3.1], 0.5);
    let pose = *turning.drawn(0).unwrap().0.parts()[0].pose();
    assert!((pose.x - 3.1).abs() < 1e-12 && (pose.theta.abs() - std::f64::consts::PI).abs() < 1e-12, "{pose:?}");
    assert!((turning.spot(0).unwrap().centre - Point2::new(3.1, 4.0)).norm() < 1e-12);
    // what was put there, or has a trailer since, is where it is
    let there = |crowd: &CrowdView| *crowd.drawn(0).unwrap().0.parts()[0].pose();
    assert_eq!(there(&one("hitch", &[3.0, 4.0, 0.0], &[3.6, 4.0, 0.0], 0.5)).x, 3.6);
    assert_eq!(there(&one("hitch", &[3.0, 4.0, 0.0], &[3.2, 4.0, 0.0, 0.0], 0.5)).x, 3.2);
    assert_eq!(there(&one("reach", &[0.1, 0.0], &[1.9, 0.0], 0.5)).theta, 1.9);
    assert!((there(&one("reach", &[0.1, 0.0], &[0.2, 0.0], 0.5)).theta - 0.15).abs() < 1e-12);
    // a car that was given its trailer in the run has it, although it began without
    let alone = [3.0, 4.0, 0.0];
    let towing = one("hitch", &[3.0, 4.0, 0.0, 0.2], &[3.0, 4.0, 0.0, 0.2], 1.0);
    let given = CrowdView { now: towing.now.clone(), ..one("hitch", &alone, &alone, 1.0) };
    assert_eq!(given.footprint(0), towing.footprint(0));
    assert!(given.footprint(0).unwrap().0.is_valid() && given.footprint(0).unwrap().0.parts().len() == 2);
    // a rover's pointer is no part of its footprint
    assert_eq!(one("rusty", &[1.0, 1.0, 0.2], &[1.0, 1.0, 0.2], 1.0).drawn(0).unwrap().1, Some(0.2));
    // the dot of a car is at its middle, and a trailer's length more behind
    let middle = |q: &[f64]| one("hitch", q, q, 1.0).middle(0);
    let ahead = middle(&[3.0, 4.0, 0.0]);
    assert!(ahead.x > 0.5 && ahead.y == 0.0, "the rear axle is behind the middle: {ahead}");
    let up = middle(&[3.0, 4.0, std::f64::consts::FRAC_PI_2]);
    assert!((up - Vector2::new(0.0, ahead.x)).norm() < 1e-12);
    assert!(middle(&[3.0, 4.0, 0.0, 0.0]).x < ahead.x);
}

#[test]
fn contacts_are_counted_where_they_began() {
    let mark = |tick, robot, x, what| TickMark { tick, robot, what, at: Point2::new(x, 1.0) };
    let marks = [
        mark(1, 7, 1.0, Happening::Contact),
        mark(2, 8, 1.1, Happening::Contact),
        mark(3, 7, 30.0, Happening::Contact),
        mark(3, 3, 30.0, Happening::Contact),
        mark(3, 7, 30.0, Happening::Takeover),
        mark(9, 7, 30.0, Happening::Contact),
    ];
    let heat = Heat::of(&marks, 3, 7..10, &YARD);
    assert_eq!(heat.counts.iter().sum::<u32>(), 3, "not those of others, of other kinds, or later ones");
    // 96 squares along 40 m, 4.17 points each
    let mesh = heat.squares(&whole(), &FrameColours::from(Theme::Light)).0;
    assert_eq!(mesh.vertices.len(), 8, "two squares");
    let square =
        |i: usize| Rect::from_points(&mesh.vertices[4 * i..4 * i + 4].iter().map(|v| v.pos).collect::<Vec<_>>());
    assert!(square(0).contains(pos2(10.0, 190.0)) && square(1).contains(pos2(300.0, 190.0)), "{:?}", square(0));
    let opacity = |i: usize| mesh.vertices[4 * i].color.a();
    assert!(opacity(0) > opacity(1) && opacity(1) > 60, "two contacts are fuller than one, which is seen");
}

#[test]
fn the_list_finds_by_name_and_by_contacts() {
    let mut robots = vec![rover(1.0, 1.0, 0.1); 12];
    robots[4].2 = 2;
    robots[5].2 = 1;
    let crowd = still(&robots);
    let mut state = CrowdState::default();
    assert_eq!(state.found(&crowd).len(), 12);
    state.search = " rOVER 1 ".into();
    assert_eq!(&state.found(&crowd)[..], [10, 11, 12, 13, 14, 15, 16, 17, 18]);
    state.with_contacts = true;
    assert_eq!(&state.found(&crowd)[..], [11, 12]);
    let mut other = still(&[rover(1.0, 1.0, 0.1)]);
    other.names = vec!["Rover 10 of another run".to_owned()].into();
    state.with_contacts = false;
    assert_eq!(&state.found(&other)[..], [7], "another run's names are searched again");
    state.pick(&crowd, Some(9));
    assert_eq!(state.picked_in(&crowd).map(|p| p.id), Some(9));
    assert_eq!(state.picked_in(&other), None, "it has no such robot");
}
