//! Distance with witness, and contact.

use motion_lab::collision::{Collision, Scene};
use motion_lab::prelude::*;

use crate::Table;
use crate::measure::{Contender, Timing, race};
use crate::peer::{Cuboids, Peer};
use crate::rectangles::Rectangles;
use crate::worlds::{CASES, boxes, draws, pieces, rectangles};

/// The arm's scenes by their numbers of obstacles.
pub fn arm_scenes() -> Vec<(usize, Scene)> {
    vec![(3, Scene::workbench()), (100, boxes(100, 0.2)), (10_000, boxes(10_000, 0.2))]
}

fn arm_distance(scene: &Scene) -> Vec<Timing> {
    let (peer, arm) = (Peer::new(pieces(scene)), Reach::<2>::workbench());
    let mut s = draws("arm");
    let mut footprints = Vec::new();
    while footprints.len() < CASES {
        let q = arm.sample(Point2::origin(), Point2::origin(), &mut s);
        let footprint = arm.footprint(&q);
        if !scene.intersects(&footprint) {
            // parry's capsules are off by up to 1e-7 m
            assert!((scene.distance(&footprint) - peer.distance(&footprint)).abs() < 1e-6);
            footprints.push(footprint);
        }
    }
    race(vec![
        Contender::new("", |i| scene.witness(&footprints[i % CASES])),
        Contender::new("parry", |i| peer.distance(&footprints[i % CASES])),
    ])
}

/// One rectangle against many; the time is per pair.
fn rectangle_pairs() -> Vec<Timing> {
    let rects = rectangles(CASES, 8.0);
    let (ours, peers) = (Rectangles::new(rects.iter().copied()), Cuboids::new(&rects));
    let mut touched = Vec::new();
    for (k, rect) in rects.iter().enumerate() {
        ours.touched_by(*rect, &mut touched);
        assert!((0..CASES).all(|i| touched[i] == peers.touch(k, i)), "parry differs at {k}");
    }
    let pairs = CASES as f64;
    let timings = race(vec![
        Contender::new("", |k| {
            ours.touched_by(rects[k % CASES], &mut touched);
            touched[k % CASES]
        }),
        Contender::new("parry", |k| (0..CASES).filter(|&i| peers.touch(k % CASES, i)).count()),
    ]);
    timings.iter().map(|t| t.per(pairs)).collect()
}

pub fn rows(table: &mut Table) {
    let musts = [">= 5x", ">= 2.8x", ">= 2.5x"];
    for ((count, scene), must) in arm_scenes().into_iter().zip(musts) {
        table.row(&format!("arm, distance and witness, {count} obstacles"), must, || arm_distance(&scene));
    }
    table.row("rectangle pair, boolean, one against 256", ">= 15x", rectangle_pairs);
}
