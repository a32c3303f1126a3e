//! Distance with witness, and contact.

use motion_lab::collision::{Checker, Collision, Scene};
use motion_lab::geometry::Footprint;
use motion_lab::prelude::*;

use crate::Table;
use crate::contest::numbers;
use crate::measure::Entrant;
use crate::pairs;
use crate::rectangles::Rectangles;
use crate::rivals::Task;
use crate::row::Mark;
use crate::worlds::{CASES, arm_scenes, boxes, draws, pieces, rectangles};

fn distances(scene: &Scene, footprints: &[Footprint]) -> Task {
    let ends = |footprint: &Footprint| {
        footprint.parts().iter().flat_map(|part| part.placed().core().iter().flat_map(|p| [p.x, p.y])).collect()
    };
    Task {
        kind: "distance".into(),
        settings: vec![Reach::<2>::workbench().link_radius],
        obstacles: pieces(scene).map(numbers).collect(),
        cases: footprints.iter().map(ends).collect(),
    }
}

/// One rectangle against many; the time is per pair.
fn rectangle_pairs(table: &mut Table) {
    let rects = rectangles(CASES, 8.0);
    let number = |(pose, _, max): &(Pose2, Point2, Point2)| vec![pose.x, pose.y, pose.theta, max.x, max.y];
    let task = Task { kind: "rectangles".into(), cases: rects.iter().map(number).collect(), ..Task::default() };
    let work = "rectangle pair, boolean, one against 256";
    let works = [work.to_owned(), format!("{work} (Baseline)")].map(|work| (work, Mark::faster_by(10.0)));
    table.race_per(CASES as f64, &works, |peers| {
        let peers = peers.entrants(&task, |name, answers| {
            let ours = Rectangles::new(rects.iter().copied());
            let mut touched = Vec::new();
            for (k, theirs) in answers.iter().enumerate() {
                ours.touched_by(rects[k], &mut touched);
                assert!(
                    touched.iter().map(|t| f64::from(u8::from(*t))).eq(theirs.iter().copied()),
                    "{name} differs at {k}"
                );
            }
        });
        let ours = [Rectangles::new(rects.iter().copied()), Rectangles::with_baseline(rects.iter().copied())];
        let ours = ours.map(|ours| {
            let (rects, mut touched) = (&rects, Vec::new());
            Entrant::new("", CASES, move |k| {
                ours.touched_by(rects[k], &mut touched);
                touched[k]
            })
        });
        ours.into_iter().chain(peers).collect()
    });
}

/// Many configurations in one call, on two threads and on one.
fn batch(table: &mut Table) {
    let checker = Checker::new(boxes(10_000, 0.2), Reach::<2>::workbench());
    let (arm, mut s) = (Reach::<2>::workbench(), draws("batch"));
    let many: Vec<T2> = (0..10_000).map(|_| arm.sample(Point2::origin(), Point2::origin(), &mut s)).collect();
    let [one, two] =
        [1, 2].map(|n| rayon::ThreadPoolBuilder::new().num_threads(n).build().expect("as many threads as asked for"));
    let work = "distances of 10,000 arm configurations among 10,000 obstacles, two threads".to_owned();
    table.race(&[(work, Mark::faster_by(1.6))], |_| {
        let (alone, both) = (one.install(|| checker.distances(&many)), two.install(|| checker.distances(&many)));
        assert!(alone.iter().map(|d| d.to_bits()).eq(both.iter().map(|d| d.to_bits())), "threads change nothing");
        vec![
            Entrant::new("", 1, |_| two.install(|| checker.distances(&many))),
            Entrant::new("one thread", 1, |_| one.install(|| checker.distances(&many))),
        ]
    });
}

pub fn rows(table: &mut Table) {
    for ((count, scene), mark) in arm_scenes().into_iter().zip([3.0, 3.0, 4.0]) {
        let work = format!("arm, distance and witness, {count} obstacles");
        let footprints = pairs::free_arms(&scene);
        table.race(&[(work, Mark::faster_by(mark))], |peers| {
            let distances = distances(&scene, &footprints);
            let peers = peers.entrants(&distances, |name, answers| {
                // parry's capsules are off by up to 1e-7 m, and single precision by more
                let near = if name.starts_with("parry") { 1e-6 } else { 1e-3 };
                for (footprint, theirs) in footprints.iter().zip(answers) {
                    let ours = scene.distance(footprint);
                    assert!((ours - theirs[0]).abs() < near, "{name}: {} for {ours}", theirs[0]);
                }
            });
            let ours = Entrant::new("", CASES, |i| scene.witness(&footprints[i]));
            std::iter::once(ours).chain(peers).collect()
        });
    }
    rectangle_pairs(table);
    batch(table);
}
