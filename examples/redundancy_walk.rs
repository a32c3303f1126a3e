//! The redundancy walk: a three-link arm has one joint more than its tip needs, so it moves while the tip stays.
//!
//! `cargo run --example redundancy_walk`
#![allow(clippy::print_stdout, dead_code)]

use std::error::Error;
use std::fmt::Write;

use motion_lab::prelude::*;
use motion_lab::tour::BOOK_SEED;

/// 200 configurations of one tip. The first joint walks by seeded steps. The other two follow by two-link inverse
/// kinematics about the end of the first link, on the elbow side of the start. A step out of reach turns back.
pub fn walk(arm: &Reach<3>, start: Tn<3>, seed: Seed) -> Vec<Tn<3>> {
    let tip = arm.tip(&start);
    // the start's solution among [elbow-down, elbow-up]
    let side = usize::from(start.0[2] < 0.0);
    let mut draws = Stream::new(seed, "redundancy walk");
    let mut walk = vec![start];
    let mut step = 0.05;
    while walk.len() < 200 {
        let th1 = walk[walk.len() - 1].0[0] + step * draws.unit();
        match arm.with_tip_at(tip, th1)[side] {
            Some(q) => walk.push(q),
            None => step = -step,
        }
    }
    walk
}

/// The program's output.
pub fn report() -> Result<String, Box<dyn Error>> {
    let arm = Reach::<3>::redundant();
    let start = Tn([0.3, 0.9, 0.8]);
    let tip = arm.tip(&start);
    let walk = walk(&arm, start, BOOK_SEED);
    let mut text = String::new();
    for k in (0..walk.len()).step_by(40).chain([walk.len() - 1]) {
        let at = arm.tip(&walk[k]);
        writeln!(text, "{k:3}  {}  tip ({:.9}, {:.9})", walk[k], at.x, at.y)?;
    }
    let extreme = |pick: fn(f64, f64) -> f64| walk.iter().map(|q| q.0[0]).fold(start.0[0], pick);
    let (low, high) = (extreme(motion_lab::num::lesser), extreme(motion_lab::num::greater));
    let stray = walk.iter().map(|q| (arm.tip(q) - tip).norm()).fold(0.0, motion_lab::num::greater);
    writeln!(text, "theta1 from {low:.3} to {high:.3}; the tip strays by less than 1e-9 m: {}", stray < 1e-9)?;
    Ok(text)
}

fn main() -> Result<(), Box<dyn Error>> {
    print!("{}", report()?);
    Ok(())
}
