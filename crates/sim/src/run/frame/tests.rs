#[test]
fn seconds_are_the_nearest_numbers() {
    for (ticks, expected) in [(0, 0.0), (1, 0.05), (3, 0.15), (48, 2.4), (72_000, 3600.0)] {
        assert_eq!(super::seconds(ticks), expected);
    }
    assert_ne!(48.0 * super::DT, 2.4, "the product is not");
}

use super::*;
use crate::run::fixture;

#[test]
fn the_encoding_is_the_documented_words() {
    let state = RobotState {
        id: 7,
        configuration: [1.0, -0.0].into_iter().collect(),
        extra: [f64::INFINITY].into_iter().collect(),
        channels: [-128, 5],
        target: Coordinates::new(),
        manual: true,
        in_contact: false,
        contacts: 3,
        flash: 4,
        refusals: 6,
    };
    let frame = Frame {
        tick: 9,
        robots: vec![state],
        scans: vec![RobotScan { robot: 7, ranges: [2.5].into() }],
        obstacles: ObstacleStates::new(),
    };
    let mut bytes = Vec::new();
    frame.encode(&mut bytes);
    let words: Vec<u64> = bytes.as_chunks::<8>().0.iter().map(|c| u64::from_le_bytes(*c)).collect();
    let (one, minus_zero, infinity) = (0x3ff0_0000_0000_0000, 0x8000_0000_0000_0000, 0x7ff0_0000_0000_0000);
    let expected = [9, 1, 7, 2, one, minus_zero, 1, infinity, 128_u64.wrapping_neg(), 5, 0, 1, 0, 3, 4, 6, 1, 7, 1];
    assert_eq!(words[..19], expected);
    assert_eq!(words[19..], [2.5_f64.to_bits()]);
    assert_eq!(bytes.len(), 160, "whole words only");
    assert_eq!(frame.encoded_length(), 160);
}

#[test]
fn the_encoding_in_pieces_is_the_encoding() {
    let mut frame = fixture::frame(3);
    let words = PIECE / 8;
    for length in [0, 1, words - 40, words, words + 1, 3 * words + 7] {
        frame.scans[0].ranges = (0..length).map(|k| k as f64).collect();
        for changed in [0, 1, words / 3] {
            let obstacle = |number| ObstacleState { world: 0, obstacle: number, present: true, pose: Pose2::IDENTITY };
            frame.obstacles = (0..changed as u32).map(obstacle).collect();
            let (mut whole, mut pieces, mut room) = (Vec::new(), Vec::new(), Vec::new());
            frame.encode(&mut whole);
            frame.encode_in_pieces(&mut room, |piece| {
                assert!(piece.len() <= PIECE);
                pieces.extend_from_slice(piece);
            });
            assert!(pieces == whole, "{length} ranges, {changed} obstacles");
        }
    }
}

#[test]
fn a_nan_is_found_wherever_it_hides() {
    let mut frame = fixture::frame(3);
    assert_eq!(frame.first_nan(), None);
    frame.scans[0].ranges_mut()[1] = f64::NAN;
    assert_eq!(frame.first_nan(), Some((0, "ranges[1]".into())));
    frame.robots[1].extra.push(f64::NAN);
    assert_eq!(frame.first_nan(), Some((1, "extra[0]".into())), "robots come before scans");
}
