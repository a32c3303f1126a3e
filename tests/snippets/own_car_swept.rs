use motion_lab::collision::{Checker, Collision, Scene};
use motion_lab::prelude::*;
use motion_lab::worlds::World;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let checker = Checker::new(Scene::of_world(&World::parse("world.ron", WORLD)?), Hitch {
        wheelbase: 2.5,
        max_steer: 0.5,
        body: motion_lab::robots::CarBody { length: 3.9, width: 1.25, rear_overhang: 0.7 },
        trailer_body: motion_lab::robots::TrailerBody { front_overhang: 1.0, rear_overhang: 0.8, width: 1.5 },
        hitch_len: Some(2.75),
        ..HITCH
    });
    let q = HitchCfg { body: Pose2 { x: 6.5, y: 2.5, theta: 0.25 }, trailer: Some(-0.5) };
    let to = HitchCfg { body: Pose2 { x: 7.0, y: 2.5, theta: 0.25 }, trailer: Some(-0.5) };
    let verdict = checker.edge(&q, &to)?;
    println!("{verdict:?}");
    assert_eq!(
        format!("{verdict:?}"),
        "Free { clearance: 0.49729560481520196 }"
    );
    let (a, b) = (checker.robot().footprint(&q), checker.robot().footprint(&to));
    println!("swept: {}", checker.scene().swept(&a, &b));
    Ok(())
}

const WORLD: &str = r#"World(
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
        (name: "the west pillar", shape: Box(min: (5.3, 4.85), max: (5.7, 5.25))),
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
        (name: "Hitch", kind: "hitch", start: [6.5, 2.5, 0.25, -0.5], car: (wheelbase: 2.5, length: 3.9, width: 1.25, rear_overhang: 0.7, max_steer: 0.5, trailer: (hitch_len: 2.75, width: 1.5, front_overhang: 1.0, rear_overhang: 0.8))),
    ],
)
"#;
