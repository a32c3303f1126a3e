//! What lessons begin with, and how they end.

use super::lessons::{Reader, ui, under_way};
use super::*;
use motion_lab_core::configuration::Configuration as _;

#[test]
fn the_lesson_of_two_elbows_begins_where_the_other_is_reached_and_ends_with_both() {
    let elbows = motion_lab_sim::manifest::Lesson::of("two_elbows").unwrap();
    let arm = |reader: &Reader| reader.harness.state().robot(1);
    let mut put = 0;
    // the tour's arm is in contact half of the time, and goes on meanwhile; paused it stands
    for (ticks, is_paused) in (0..12).flat_map(|k| [(25 * k + 7, false), (25 * k + 20, true)]) {
        let mut reader = Reader::new();
        while reader.harness.state().transport().tick < ticks {
            reader.harness.step();
        }
        if is_paused {
            pause(&mut reader.harness);
        }
        let before = arm(&reader);
        ui(&mut reader.harness, |ui| ui.begin(elbows));
        reader.harness.run_steps(8);
        let start = arm(&reader);
        put += u32::from(start.coordinates != before.coordinates);
        assert!(!start.in_contact, "{ticks}: {}", start.configuration);
        // a reader who reads first finds the arm where it was, and nothing done
        reader.harness.run_steps(100);
        assert_eq!((arm(&reader).coordinates, under_way(&reader.harness).took), (start.coordinates.clone(), None));
        reader.click("One tip, two elbows");
        while under_way(&reader.harness).took.is_none() {
            reader.harness.step();
            assert!(reader.now() < 60.0, "{ticks}");
        }
        let end = arm(&reader);
        let off = (start.tip.unwrap() - end.tip.unwrap()).norm();
        let bends = [&start, &end].map(|arm| arm.coordinates[1]);
        assert!(off < 1e-3 && bends[0] * bends[1] < 0.0, "one tip, two elbows: {off} {bends:?}");
        let said = |q: &[f64]| format!("({:.2}, {:.2})", q[0], q[1]).replace('-', "\u{2212}");
        let both = format!("{} and {}", said(&start.coordinates), said(&end.coordinates));
        let learnt = under_way(&reader.harness).learnt;
        assert_eq!(learnt, format!("One tip, two configurations: {both}. A tip does not say where the elbow is."));
    }
    assert!(put >= 8, "the arm had to be put: {put} times");
}

#[test]
fn nothing_below_moves_as_a_lesson_ends() {
    for size in [WIDE, [900.0, 700.0]] {
        let mut harness = lab(size);
        ui(&mut harness, |ui| ui.begin(motion_lab_sim::manifest::Lesson::of("held").unwrap()));
        harness.run_steps(4);
        let before = paper(&harness, "Apartment");
        ui(&mut harness, |ui| {
            let under_way = ui.lesson.as_mut().unwrap();
            under_way.took = Some(12.0);
            under_way.learnt = under_way.lesson.learnt().to_owned();
        });
        harness.run_steps(4);
        assert_eq!(paper(&harness, "Apartment"), before, "{size:?}");
    }
}

#[test]
fn a_lesson_of_an_address_begins_where_the_address_says_and_one_without_at_its_usual_place() {
    for id in ["near", "over_edge"] {
        let mut harness = lab(WIDE);
        let place = |harness: &Harness<'static, Lab>| interface(harness).anatomy.anatomy.q();
        let elsewhere = place(&harness).with_coordinates(&[0.5, 1.25]).unwrap();
        ui(&mut harness, |ui| {
            ui.begin(motion_lab_sim::manifest::Lesson::of(id).unwrap());
            ui.lesson.as_mut().unwrap().start = Some(elsewhere);
        });
        harness.run_steps(4);
        assert_eq!(place(&harness).coordinates().to_vec(), [0.5, 1.25], "{id}");
        // begun again it is the lesson that everybody has: the book's arm at 45 and 90 degrees
        ui(&mut harness, |ui| ui.begin(motion_lab_sim::manifest::Lesson::of(id).unwrap()));
        harness.run_steps(4);
        let usual = [std::f64::consts::FRAC_PI_4, std::f64::consts::FRAC_PI_2];
        assert_eq!(place(&harness).coordinates().to_vec(), usual, "{id}");
    }
}
