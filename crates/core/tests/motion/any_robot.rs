//! `AnyRobot` answers every method of `Robot` as the robot that it is, bit for bit.

use motion_lab_core::collision::Certificate;
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{AnyRobot, Motion};

/// The methods of `Robot` that are compared below.
const COMPARED: [&str; 11] = [
    "check",
    "footprint",
    "edge_rates",
    "sample",
    "position",
    "disc_line",
    "edge_linkage",
    "jacobian",
    "is_within_limits",
    "edge_leaves",
    "edge",
];

#[test]
fn every_method_of_a_robot_is_compared() {
    let source = include_str!("../../src/robots/robot.rs");
    let robot = source.split("\npub trait Robot:").nth(1).and_then(|rest| rest.split("\n}\n").next()).unwrap();
    let methods = robot.lines().filter_map(|line| line.strip_prefix("    fn ")?.split(['(', '<']).next());
    assert!(methods.eq(COMPARED), "a method of the trait is missing here");
}

/// A value to its last bit: `Debug` writes every number so that it reads back the same, zeros with their signs.
fn bits(value: impl std::fmt::Debug) -> String {
    format!("{value:?}")
}

/// Compares every method at many pairs of configurations, and what a checker makes of them.
fn compare<R: Robot<Configuration: Into<AnyConfiguration>>>(scene: &Scene, robot: &R, any: &AnyRobot) {
    let (min, max) = (scene.bounds().min, scene.bounds().max);
    let (mut of_robot, mut of_any) = (Stream::new(Seed(7), "any"), Stream::new(Seed(7), "any"));
    let (typed, dynamic) = (Checker::new(scene.clone(), robot.clone()), Checker::new(scene.clone(), *any));
    for _ in 0..300 {
        let [a, b] = [0, 1].map(|_| {
            let (own, same) = (robot.sample(min, max, &mut of_robot), any.sample(min, max, &mut of_any));
            assert_eq!(bits(own.into()), bits(same), "sample");
            own
        });
        let (any_a, any_b) = (a.into(), b.into());
        assert_eq!(robot.check(&a), any.check(&any_a), "check");
        assert_eq!(bits(robot.footprint(&a)), bits(any.footprint(&any_a)), "footprint");
        assert_eq!(bits(robot.edge_rates(&a, &b)), bits(any.edge_rates(&any_a, &any_b)), "edge_rates");
        assert_eq!(robot.position(&a), any.position(&any_a), "position");
        assert_eq!(robot.position(&a).is_none(), any.annulus().is_some(), "an arm stays where it is");
        assert_eq!(bits(robot.disc_line(&a, &b)), bits(any.disc_line(&any_a, &any_b)), "disc_line");
        assert_eq!(robot.edge_linkage(&a, &b), any.edge_linkage(&any_a, &any_b), "edge_linkage");
        for part in 0..4 {
            let point = Point2::new(0.5 * (min.x + max.x), min.y);
            assert_eq!(bits(robot.jacobian(&a, part, point)), bits(any.jacobian(&any_a, part, point)), "jacobian");
        }
        assert_eq!(robot.is_within_limits(&a), any.is_within_limits(&any_a), "is_within_limits");
        assert_eq!(bits(robot.edge_leaves(&a, &b)), bits(any.edge_leaves(&any_a, &any_b)), "edge_leaves");
        let (edge, any_edge) = (robot.edge(&a, &b).unwrap(), any.edge(&any_a, &any_b).unwrap());
        assert_eq!(bits(edge.at(0.3).into()), bits(any_edge.at(0.3)), "edge");
        let (mut proof, mut any_proof) = (Certificate::new(), Certificate::new());
        let verdict = typed.edge_certified(&a, &b, &mut proof).unwrap();
        assert_eq!(bits(verdict), bits(dynamic.edge_certified(&any_a, &any_b, &mut any_proof).unwrap()));
        assert_eq!(bits(proof.steps()), bits(any_proof.steps()));
        assert_eq!(typed.edge_free(&a, &b), dynamic.edge_free(&any_a, &any_b));
    }
    let stranger = if any.kind() == "reach" {
        AnyConfiguration::Pose(Pose2::IDENTITY)
    } else {
        AnyConfiguration::T2(T2::new(0.0, 0.0))
    };
    assert!(any.check(&stranger).is_err() && !any.footprint(&stranger).is_valid());
    assert!(any.disc_line(&stranger, &stranger).is_none() && any.jacobian(&stranger, 0, min).is_none());
    assert!(any.position(&stranger).is_none());
}

#[test]
fn every_kind_answers_as_the_robot_that_it_is() {
    let limited = Hitch { jackknife: Some(0.5), ..HITCH }.with_trailer();
    compare(&Scene::apartment(), &RUSTY, &AnyRobot::Rusty(RUSTY));
    compare(&Scene::workbench(), &Reach::workbench(), &AnyRobot::Reach(Reach::workbench()));
    compare(&Scene::workbench(), &Reach::choset(), &AnyRobot::Reach(Reach::choset()));
    compare(&Scene::workbench(), &Reach::redundant(), &AnyRobot::Reach3(Reach::redundant()));
    for car in [HITCH, HITCH.with_trailer(), limited] {
        compare(&Scene::lot(), &car, &AnyRobot::Hitch(car));
    }
}
