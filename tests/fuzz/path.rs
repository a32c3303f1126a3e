//! Paths, JSON.
//!
//! A wrong reader calls a path free that is not, or draws a number that is none. Barriers have no reader here: the lab
//! writes them, and `tests/peers/tamper_barrier.py` forges them for the one that reads them.

use super::refusal;
use motion_lab::collision::{Collision, Scene};
use motion_lab::configuration::Configuration;
use motion_lab::plans::{PathFile, Task};
use motion_lab::robots::{AnyRobot, Robot};
use motion_lab::worlds::World;

/// Reads a path, and judges it in the world of its kind of robot.
pub fn check(data: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(data) else { return false };
    let file = match PathFile::read(text) {
        Ok(file) => file,
        Err(error) => {
            refusal::check(&error, "");
            return false;
        }
    };
    let again = file.to_json().map(|json| PathFile::read(&json).map(|file| file.to_json().unwrap()));
    let json = file.to_json().unwrap();
    // by their texts: a clearance may be no number
    assert_eq!(again.unwrap().unwrap(), json, "{text}");
    let (robot, ends) = file.robot().expect("it was read");
    let drawn = file.drawn(&robot).expect("it was read");
    let is_finite = |q: &dyn Fn() -> Vec<f64>| q().iter().all(|x| x.is_finite());
    for q in drawn.path.iter().chain(&drawn.corners) {
        assert!(is_finite(&|| q.coordinates().to_vec()), "{q:?}\n{text}");
    }
    let world = match robot {
        AnyRobot::Rusty(_) => World::apartment(),
        AnyRobot::Hitch(_) => World::lot(),
        _ => World::workbench(),
    };
    let task = Task::new("robot", robot, world, ends);
    let Ok(Some(judged)) = file.judged(&task) else { return true };
    match judged.proof {
        Ok(clearance) => {
            assert!(clearance >= 0.0 && judged.hit.is_none(), "{clearance}\n{text}");
            let scene: &Scene = &task.scene;
            for q in &drawn.path {
                assert!(!scene.intersects(&task.robot.footprint(q)), "a path called free touches at {q:?}\n{text}");
            }
        }
        Err(error) => refusal::check(&error, ""),
    }
    true
}
