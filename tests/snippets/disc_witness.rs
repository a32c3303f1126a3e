use motion_lab::collision::{Checker, Collision, Scene};
use motion_lab::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let checker = Checker::new(Scene::apartment(), RUSTY);
    let q = Pose2 { x: 2.25, y: 6.25, theta: 0.0 };
    let footprint = checker.robot().footprint(&q);
    let w = checker.scene().witness(&footprint).ok_or("nothing is there")?;
    println!("a* = {} on part {}", w.on_robot, w.part);
    println!("b* = {} on {:?}", w.on_obstacle, checker.scene().obstacle_name(w.obstacle));
    println!("distance: {} m", w.dist);
    assert_eq!(w.on_robot, Point2::new(2.14, 6.25));
    assert_eq!(w.on_obstacle, Point2::new(1.25, 6.25));
    assert_eq!(w.dist, 0.89);
    Ok(())
}
