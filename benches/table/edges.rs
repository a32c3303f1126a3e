//! Edges: exact for the disc, certified for arm and car, beside what parry users do.

use motion_lab::collision::{Checker, Scene};
use motion_lab::prelude::*;

use crate::Table;
use crate::measure::{Contender, Timing, race};
use crate::peer::Peer;
use crate::queries::arm_scenes;
use crate::worlds::{CASES, boxes, draws, free_points, pieces, walls};

fn disc(scene: &Scene, side: f64) -> Vec<Timing> {
    let checker = Checker::new(scene.clone(), RustyDisc::default());
    let (peer, radius) = (Peer::new(pieces(scene)), RustyDisc::default().radius);
    let mut s = draws("disc edges");
    let mut pairs = Vec::new();
    for p in free_points(scene, 0.1 * side, 0.9 * side).iter().cycle() {
        let a = R2::new(p.x, p.y);
        let b = R2::new(p.x + s.uniform(-2.0, 2.0), p.y + s.uniform(-2.0, 2.0));
        if checker.is_free(&a) {
            let hit = peer.disc_line(radius, (a.0.x, a.0.y), (b.0.x - a.0.x, b.0.y - a.0.y)).is_some();
            assert_eq!(hit, !checker.edge_free(&a, &b), "{a} to {b}");
            pairs.push((a, b));
        }
        if pairs.len() == CASES {
            break;
        }
    }
    race(vec![
        Contender::new("", |i| checker.edge(&pairs[i % CASES].0, &pairs[i % CASES].1)),
        Contender::new("parry cast", |i| {
            let (a, b) = &pairs[i % CASES];
            peer.disc_line(radius, (a.0.x, a.0.y), (b.0.x - a.0.x, b.0.y - a.0.y))
        }),
    ])
}

/// Certified edges beside parry's contact test at every 2 mm.
fn certified<R: Robot>(
    checker: &Checker<R>,
    mut draw: impl FnMut(&mut Stream, &R) -> [R::Configuration; 2],
) -> Vec<Timing> {
    let peer = Peer::new(pieces(checker.scene()));
    let mut s = draws("certified edges");
    let mut pairs = Vec::new();
    while pairs.len() < CASES {
        let [a, b] = draw(&mut s, checker.robot());
        if checker.is_free(&a) && checker.is_free(&b) {
            pairs.push((a, b));
        }
    }
    let sampled = |i: usize| {
        let (a, b) = &pairs[i % CASES];
        let edge = checker.robot().edge(a, b).expect("of this robot");
        let parts = edge.footprint_at(0.0).parts().len();
        let way = (0..parts).map(|k| edge.bound(k, 0.0, 1.0)).fold(0.0, f64::max);
        let samples = (way / 0.002).ceil() as u32;
        (0..=samples).any(|i| peer.intersects(&edge.footprint_at(f64::from(i) / f64::from(samples.max(1)))))
    };
    let steps = {
        let mut certificate = motion_lab::collision::Certificate::new();
        let mut steps = 0;
        for (a, b) in &pairs {
            checker.edge_certified(a, b, &mut certificate).expect("of this robot");
            steps += certificate.steps().len();
        }
        steps as f64 / CASES as f64
    };
    let free = pairs.iter().filter(|(a, b)| checker.edge_free(a, b)).count();
    println!("  {steps:.1} proven steps an edge, {free} of {CASES} edges free");
    race(vec![
        Contender::new("", |i| checker.edge(&pairs[i % CASES].0, &pairs[i % CASES].1)),
        Contender::new("2 mm samples", sampled),
    ])
}

pub fn rows(table: &mut Table) {
    for (count, side, longest, must) in [(40, 8.0, 2.0, ">= 5x"), (10_000, 100.0, 1.0, ">= 2x")] {
        table.row(&format!("disc edge, {count} segments"), must, || disc(&walls(count, side, longest), side));
    }
    for (count, scene) in arm_scenes() {
        table.row(&format!("arm edge, certified, {count} obstacles"), ">= 50x", || {
            let checker = Checker::new(scene.clone(), Reach::<2>::workbench());
            certified(&checker, |s, arm| {
                let o = Point2::origin();
                let a = arm.sample(o, o, s);
                [a, T2::new(a.0[0] + s.uniform(-0.5, 0.5), a.0[1] + s.uniform(-0.5, 0.5))]
            })
        });
    }
    for (count, scene) in [(3, boxes(3, 0.0)), (100, boxes(100, 0.0)), (10_000, boxes(10_000, 0.0))] {
        table.row(&format!("car edge, certified, {count} obstacles"), ">= 50x", || {
            let (min, max) = (scene.bounds().min, scene.bounds().max);
            certified(&Checker::new(scene.clone(), HITCH), |s, car| {
                let a = car.sample(min, max, s);
                let mut b = a;
                b.body = Pose2::new(
                    a.body.x + s.uniform(-1.0, 1.0),
                    a.body.y + s.uniform(-1.0, 1.0),
                    a.body.theta + s.uniform(-0.5, 0.5),
                );
                [a, b]
            })
        });
    }
}
