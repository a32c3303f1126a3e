use motion_lab::collision::{Checker, Collision, Scene};
use motion_lab::prelude::*;
use motion_lab::worlds::World;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let checker = Checker::new(Scene::of_world(&World::parse("world.ron", WORLD)?), HITCH.with_trailer());
    let q = HitchCfg { body: Pose2 { x: 6.5, y: 2.5, theta: 0.25 }, trailer: Some(-0.5) };
    let footprint = checker.robot().footprint(&q);
    let w = checker.scene().witness(&footprint).ok_or("nothing is there")?;
    println!("a* = {} on part {}", w.on_robot, w.part);
    println!("b* = {} on {:?}", w.on_obstacle, checker.scene().obstacle_name(w.obstacle));
    println!("distance: {} m", w.dist);
    assert_eq!(w.on_robot, Point2::new(4.94665936328299, 4.203214302907453));
    assert_eq!(w.on_obstacle, Point2::new(5.3, 4.85));
    assert_eq!(w.dist, 0.7370083741173318);
    Ok(())
}

const WORLD: &str = r##"World(
    version: 1,
    name: "Lot",
    bounds: (min: (0.0, 0.0), max: (16.0, 10.0)),
    walls: [
        (name: "the south curb", points: [(0.0, 0.0), (16.0, 0.0)]),
        (name: "the east curb", points: [(16.0, 0.0), (16.0, 10.0)]),
        (name: "the north curb", points: [(16.0, 10.0), (0.0, 10.0)]),
        (name: "the west curb", points: [(0.0, 10.0), (0.0, 0.0)]),
    ],
    obstacles: [
        (name: "a \"#quoted\"# pillar", shape: Box(min: (5.3, 4.85), max: (5.7, 5.25))),
        (name: "the east pillar", shape: Box(min: (10.3, 4.85), max: (10.7, 5.25))),
    ],
    places: [
        (name: "parked in bay 1", pose: (x: 4.25, y: 8.875, theta: -1.5707963267948966)),
        (name: "parked in bay 2", pose: (x: 6.75, y: 8.875, theta: -1.5707963267948966)),
        (name: "parked in bay 3", pose: (x: 9.25, y: 8.875, theta: -1.5707963267948966)),
        (name: "parked in bay 4", pose: (x: 11.75, y: 8.875, theta: -1.5707963267948966)),
        (name: "the aisle", pose: (x: 6.5, y: 2.5, theta: 0.0)),
    ],
    marks: [
        (name: "bay 1", points: [(3.0, 5.25), (3.0, 10.0), (5.5, 10.0), (5.5, 5.25)]),
        (name: "bay 2", points: [(5.5, 5.25), (5.5, 10.0), (8.0, 10.0), (8.0, 5.25)]),
        (name: "bay 3", points: [(8.0, 5.25), (8.0, 10.0), (10.5, 10.0), (10.5, 5.25)]),
        (name: "bay 4", points: [(10.5, 5.25), (10.5, 10.0), (13.0, 10.0), (13.0, 5.25)]),
    ],
    robots: [
        (name: "Hitch", kind: "hitch", start: [6.5, 2.5, 0.0]),
    ],
)
"##;
