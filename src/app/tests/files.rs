//! Runs saved and opened.

use super::*;

#[test]
fn what_was_driven_is_saved_and_verifies_to_the_same_digest() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("driven.mcap");
    let mut harness = lab(WIDE);
    arm_rusty(&mut harness);
    harness.key_down(Key::ArrowUp);
    harness.run_steps(60);
    harness.key_up(Key::ArrowUp);
    drag(&mut harness, "Reach: elbow, theta1 in radians", [-0.6, 0.9]);
    click(&mut harness, "put a trailer on");
    harness.run_steps(60);
    pause(&mut harness);
    harness.key_press(Key::End);
    harness.run_steps(2);
    let last = harness.state().app.world().resource::<LatestFrame>().0.clone();
    let notice = save_run(harness.state_mut().app.world_mut(), &path).unwrap();
    assert!(!notice.is_error, "{notice:?}");
    let bytes = std::fs::read(&path).unwrap();
    let log = Log::read_mcap(&bytes).unwrap().log;
    assert!(log.script.events.len() >= 4);
    assert_eq!(log.frames.last(), Some(&last), "what was seen is what was saved");
    assert_eq!(Run::replay(&log).unwrap(), log.frames, "headless, to the last bit");
    assert!(notice.text.contains(&log.digest().to_string()));
    // opened again it says so, and stands at its start
    let opened = open_run(harness.state_mut().app.world_mut(), &path).unwrap();
    let ticks = log.frames.len();
    assert_eq!(opened.text, format!("driven.mcap: bit-identical, {ticks} of {ticks}"));
    let transport = harness.state().transport();
    assert_eq!((transport.tick, transport.frontier), (0, ticks as u64));
    // one bit of one coordinate, in the file of a run that was not: the tick is named and shown
    let mut forged = log.clone();
    let x = &mut forged.frames[70].robots[0].configuration[0];
    *x = f64::from_bits(x.to_bits() ^ 1);
    forged.digests = forged.frames.iter().map(crate::run::Frame::digest).collect();
    let mut file = std::fs::File::create(&path).unwrap();
    forged.write_mcap(&mut file).unwrap();
    let opened = open_run(harness.state_mut().app.world_mut(), &path).unwrap();
    assert!(opened.is_error && opened.text.contains("71"), "{opened:?}");
    assert_eq!(harness.state().transport().tick, 71);
    // of a cut file the sealed beginning is opened, and the notice says how much that is
    std::fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
    let opened = open_run(harness.state_mut().app.world_mut(), &path).unwrap();
    let sealed = harness.state().transport().frontier;
    assert!(sealed > 10 && sealed < ticks as u64 && opened.is_error, "{opened:?}");
    let [whole, cut] = [format!("bit-identical, {sealed} of {ticks}"), format!("{sealed} of {ticks} ticks are whole")];
    assert!(opened.text.contains(&whole) && opened.text.contains(&cut), "{opened:?}");
    // what is no log leaves the run as it is
    let stands = harness.state().transport().tick;
    std::fs::write(&path, b"a cat").unwrap();
    let opened = open_run(harness.state_mut().app.world_mut(), &path).unwrap();
    assert!(opened.is_error && harness.state().transport().tick == stands, "{opened:?}");
}
