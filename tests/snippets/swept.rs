use motion_lab::collision::{Checker, Collision, Scene};
use motion_lab::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let checker = Checker::new(Scene::workbench(), Reach::<2>::choset());
    let q = T2::new(0.7853981633974483, 1.5707963267948966);
    let to = T2::new(-0.7853981633974483, 1.5707963267948966);
    let verdict = checker.edge(&q, &to)?;
    println!("{verdict:?}");
    assert_eq!(
        format!("{verdict:?}"),
        "Hit { free_until: 0.09033440175947335, contact_at: 0.09033447198881014, part: 1, by: Obstacle(ObstacleId(0)) }"
    );
    let (a, b) = (checker.robot().footprint(&q), checker.robot().footprint(&to));
    println!("swept: {}", checker.scene().swept(&a, &b));
    Ok(())
}
