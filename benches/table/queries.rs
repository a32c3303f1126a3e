//! Distance with witness, and contact.

use motion_lab::collision::{Collision, Scene};
use motion_lab::prelude::*;

use crate::Table;
use crate::measure::{Contender, Timing, race};
use crate::peer::Peer;
use crate::worlds::{CASES, boxes, draws, pieces};

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

pub fn rows(table: &mut Table) {
    let musts = [">= 5x", ">= 2.8x", ">= 2.5x"];
    for ((count, scene), must) in arm_scenes().into_iter().zip(musts) {
        table.row(&format!("arm, distance and witness, {count} obstacles"), must, || arm_distance(&scene));
    }
}
