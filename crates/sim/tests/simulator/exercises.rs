//! The chapter's exercises whose solutions are files.

use motion_lab_core::num::{cos, hypot, sin};
use motion_lab_core::robots::HITCH;
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{Frame, Script};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

const ONE_METRE_LEFT: &str = include_str!("../../../../examples/exercises/one_metre_left.ron");

#[test]
fn the_trailer_ends_one_metre_to_the_left_with_the_same_heading_after_one_reversal() {
    let script = Script::parse("one_metre_left.ron", ONE_METRE_LEFT).unwrap();
    let config = TourConfig { ticks: 140, ..TourConfig::default() };
    let hitch = config.robot_names().position(|name| name == "Hitch").unwrap();
    let log = Run::record(config, (BOOK_SEED, script)).unwrap();
    let car = |frame: &Frame| frame.robots[hitch].configuration.to_vec();
    let behind = HITCH.with_trailer().hitch_len.unwrap();
    let trailer = |q: &[f64]| [q[0] - behind * cos(q[3]), q[1] - behind * sin(q[3])];
    let (from, to) = (car(&log.frames()[1]), car(log.frames().last().unwrap()));
    assert_eq!(from, [6.5, 2.5, 0.0, 0.0]);
    let ([x, y], [a, b]) = (trailer(&from), trailer(&to));
    assert!(hypot(a - x, b - (y + 1.0)) < 0.05 && to[3].abs() < 0.05, "{from:?} to {to:?}");
    let speeds: Vec<i16> = log.frames()[2..].iter().map(|frame| frame.robots[hitch].channels[0]).collect();
    let moving: Vec<i16> = speeds.iter().copied().filter(|speed| *speed != 0).collect();
    assert_eq!(moving.windows(2).filter(|pair| pair[0].signum() != pair[1].signum()).count(), 1, "reversals");
    assert_eq!(log.frames().last().unwrap().robots[hitch].contacts, log.frames()[1].robots[hitch].contacts);
}
