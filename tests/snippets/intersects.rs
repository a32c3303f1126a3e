use motion_lab::collision::{Checker, Collision, Scene};
use motion_lab::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let checker = Checker::new(Scene::workbench(), Reach::<2>::choset());
    let q = T2::new(0.7853981633974483, 1.5707963267948966);
    let footprint = checker.robot().footprint(&q);
    let intersects = checker.scene().intersects(&footprint);
    println!("intersects: {intersects}");
    assert!(!intersects);
    Ok(())
}
