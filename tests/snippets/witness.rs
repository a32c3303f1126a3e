use motion_lab::collision::{Checker, Collision, Scene};
use motion_lab::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let checker = Checker::new(Scene::workbench(), Reach::<2>::choset());
    let q = T2::new(0.7853981633974483, 1.5707963267948966);
    let footprint = checker.robot().footprint(&q);
    let w = checker.scene().witness(&footprint).ok_or("nothing is there")?;
    println!("a* = {} on part {}", w.on_robot, w.part);
    println!("b* = {} on {:?}", w.on_obstacle, checker.scene().obstacle_name(w.obstacle));
    println!("distance: {} m", w.dist);
    assert_eq!(w.on_robot, Point2::new(0.4571067811865475, 0.9571067811865475));
    assert_eq!(w.on_obstacle, Point2::new(0.5, 1.0));
    assert_eq!(w.dist, 0.06066017177982128);
    Ok(())
}
