//! Everything a planner holds may be sent to and shared between threads. If one of these types could not, this file
//! would not compile.

use motion_lab_core::collision::{
    CarChecker, Certificate, CertificateError, ChainChecker, Checker, Collision, Counted, DiscChecker, EdgeVerdict,
    MarchOptions, ObstacleId, Problem, ProblemError, ProvenStep, QueryCounts, Scene, Surroundings, Witness,
};
use motion_lab_core::configuration::{ChartMismatch, Coordinates};
use motion_lab_core::geometry::{Aabb, ConvexPolygon, Placed, ShapeError};
use motion_lab_core::picture::{Figure, Item, Picture};
use motion_lab_core::planning::{Bounds, Metric, Nearest, Prm, RrtConnect, RrtStar, VisibilityGraph};
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{ChartLine, ConfigurationError, HitchArc, PartRates, RustyArc};
use motion_lab_core::sensors::{BeamModel, RangeSensor};
use motion_lab_core::worlds::{DistanceTransform, Grid, GridError, Obstacle, Resident, World, WorldError};

const fn shared<T: Send + Sync + ?Sized>() {}

const _: () = {
    shared::<dyn Collision>();
    shared::<Scene>();
    shared::<Surroundings<'_>>();
    shared::<Counted<Scene>>();
    shared::<Counted<&Scene>>();
    shared::<DiscChecker>();
    shared::<Checker<Rusty>>();
    shared::<ChainChecker<2>>();
    shared::<ChainChecker<3>>();
    shared::<CarChecker>();
    shared::<Problem<RustyDisc>>();
    shared::<Problem<Reach<2>>>();
    shared::<Problem<Hitch>>();
    shared::<(LinePath<Reach<2>>, RrtConnect<Reach<2>>, RrtStar<Hitch>, Prm<Rusty>, VisibilityGraph<RustyDisc>)>();
    shared::<(Bounds, NoPath, Metric, Nearest)>();
    shared::<(Witness, ObstacleId, EdgeVerdict, MarchOptions, Certificate, ProvenStep, QueryCounts)>();
    shared::<(Rusty, RustyDisc, Reach<2>, Reach<3>, Hitch)>();
    shared::<(R2, Pose2, T2, Tn<3>, HitchCfg, Coordinates)>();
    shared::<(ChartLine<RustyDisc>, ChartLine<Reach<2>>, ChartLine<Hitch>, RustyArc, HitchArc, PartRates)>();
    shared::<(Footprint, Part, Shape, Placed, ConvexPolygon, Segment)>();
    shared::<(World, Aabb, Obstacle, Resident, Grid, DistanceTransform)>();
    shared::<(RangeSensor, BeamModel, Seed, Stream)>();
    shared::<(Picture, Item, Figure)>();
    shared::<(ProblemError, CertificateError, ConfigurationError, ChartMismatch, ShapeError)>();
    shared::<(WorldError, GridError)>();
};

/// One checker behind `&dyn Collision` gives several threads the answers that it gives one.
#[test]
fn one_checker_answers_many_threads() {
    let counted = Counted::new(Scene::apartment());
    let planner_sees: &dyn Collision = &counted;
    let ask = || {
        let mut s = Stream::new(Seed(12), "threads");
        let mut place = || Point2::new(s.uniform(0.0, 12.0), s.uniform(0.0, 8.0));
        (0..500).map(|_| planner_sees.distance(&Footprint::disc(place(), 0.11))).collect::<Vec<f64>>()
    };
    let alone = ask();
    assert!(alone.contains(&0.0) && alone.iter().any(|d| *d > 0.5));
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(ask)).collect();
        for thread in threads {
            assert_eq!(thread.join().unwrap(), alone);
        }
    });
    assert_eq!(counted.counts().distance, 5 * 500, "each question is counted once");
}
