use motion_lab::collision::{Checker, Collision, Scene};
use motion_lab::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let checker = Checker::new(Scene::lot(), HITCH);
    let q = HitchCfg { body: Pose2 { x: 6.5, y: 2.5, theta: 0.0 }, trailer: None };
    let to = HitchCfg { body: Pose2 { x: 7.0, y: 2.5, theta: 0.0 }, trailer: None };
    let verdict = checker.edge(&q, &to)?;
    println!("{verdict:?}");
    assert_eq!(
        format!("{verdict:?}"),
        "Free { clearance: 1.5033296378372334 }"
    );
    let (a, b) = (checker.robot().footprint(&q), checker.robot().footprint(&to));
    println!("swept: {}", checker.scene().swept(&a, &b));
    Ok(())
}
