//! Runs whose frames would not fit into memory.

use motion_lab_core::prelude::*;
use motion_lab_sim::recording::{FramesError, MAX_FRAME_BYTES, Recorder, Run, RunError};
use motion_lab_sim::run::{Log, LogKind, Recipe, Recorded};
use motion_lab_sim::tour::{MAX_TICKS, TourConfig};

#[test]
fn a_run_whose_frames_take_too_much_memory_is_refused_before_it_begins() {
    for ticks in [40_000_000, MAX_TICKS] {
        let config = || TourConfig { ticks, ..TourConfig::default() };
        let error = Run::record(config(), Seed(1)).unwrap_err();
        // 360 ranges of 8 bytes, and three robots of a kilobyte at most
        let RunError::Frames(FramesError { ticks: refused, bytes, .. }) = error else { panic!("{error}") };
        assert!(refused == ticks && (2880..2880 + 3072).contains(&bytes), "{error}");
        assert!(error.to_string().starts_with(&format!("the frames of {ticks} ticks, of {bytes} bytes each, ")));
        let start = Recorder::new(config(), Seed(1)).unwrap().frame().clone();
        let log = Log::with_frames(Recipe::new(config(), Seed(1)), start, Vec::new());
        assert!(matches!(Run::replay(&log), Err(RunError::Frames(_))));
    }
    // four gibibytes, the size of the largest log that is read
    assert_eq!(MAX_FRAME_BYTES, 4 * 1024 * 1024 * 1024);
}

#[test]
fn a_run_of_any_length_begins_and_its_digests_are_kept() {
    let config = TourConfig { ticks: MAX_TICKS, worlds: vec![World::lot()], ..TourConfig::default() };
    let mut run = Recorder::new(config.clone(), Seed(1)).unwrap().without_keyframes();
    assert_eq!(run.step().tick, 1);
    let recipe = Recipe::new(TourConfig { ticks: 100, ..config }, Seed(1));
    let log = Run::record_recipe(recipe, LogKind::Digests, |_| {}).unwrap();
    let Recorded::Digests(digests) = log.recorded else { panic!("it has frames") };
    assert_eq!(digests.digests.len(), 5, "one a second");
}
