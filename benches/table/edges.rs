//! Edges: exact for the disc, certified for arm and car, compared with the usual ways with parry.

use motion_lab::collision::{Checker, Scene};
use motion_lab::prelude::*;

use crate::Table;
use crate::measure::{Contender, Timing, race};
use crate::peer::Peer;
use crate::queries::arm_scenes;
use crate::worlds::{CASES, boxes, draws, free_points, pieces, walls};

/// A disc's edges, and parry's cast along them, which finds whether and when it hits.
fn disc<T>(scene: &Scene, side: f64, ask: impl Fn(&Checker<RustyDisc>, &R2, &R2) -> T) -> Vec<Timing> {
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
            assert_eq!(hit, !checker.edge(&a, &b).is_ok_and(|verdict| verdict.is_free()), "{a} to {b}");
            pairs.push((a, b));
        }
        if pairs.len() == CASES {
            break;
        }
    }
    race(vec![
        Contender::new("", |i| ask(&checker, &pairs[i % CASES].0, &pairs[i % CASES].1)),
        Contender::new("parry cast", |i| {
            let (a, b) = &pairs[i % CASES];
            peer.disc_line(radius, (a.0.x, a.0.y), (b.0.x - a.0.x, b.0.y - a.0.y))
        }),
    ])
}

/// Edges of a robot in a scene, from free to free.
struct Edges<R: Robot> {
    checker: Checker<R>,
    pairs: Vec<[R::Configuration; 2]>,
}

impl<R: Robot> Edges<R> {
    fn new(checker: Checker<R>, mut draw: impl FnMut(&mut Stream, &R) -> [R::Configuration; 2]) -> Self {
        let mut s = draws("certified edges");
        let mut pairs = Vec::new();
        while pairs.len() < CASES {
            let [a, b] = draw(&mut s, checker.robot());
            if checker.is_free(&a) && checker.is_free(&b) {
                pairs.push([a, b]);
            }
        }
        let edges = Edges { checker, pairs };
        edges.tell();
        edges
    }

    /// Prints the number of steps of the proofs and the number of free edges, and checks that both queries agree.
    fn tell(&self) {
        let mut certificate = motion_lab::collision::Certificate::new();
        let (mut steps, mut free) = (0, 0);
        for [a, b] in &self.pairs {
            let verdict = self.checker.edge_certified(a, b, &mut certificate).expect("of this robot");
            steps += certificate.steps().len();
            free += usize::from(verdict.is_free());
            assert_eq!(self.checker.edge_free(a, b), verdict.is_free(), "{a} to {b}");
        }
        println!("  {:.1} proven steps an edge, {free} of {CASES} edges free", steps as f64 / CASES as f64);
    }

    /// Times a query of edges and parry's contact test at every 2 mm.
    fn beside_samples<T>(&self, ask: impl Fn(&Checker<R>, &R::Configuration, &R::Configuration) -> T) -> Vec<Timing> {
        let peer = Peer::new(pieces(self.checker.scene()));
        race(vec![
            Contender::new("", |i| ask(&self.checker, &self.pairs[i % CASES][0], &self.pairs[i % CASES][1])),
            Contender::new("2 mm samples", |i| {
                let [a, b] = &self.pairs[i % CASES];
                let edge = self.checker.robot().edge(a, b).expect("of this robot");
                let parts = edge.footprint_at(0.0).parts().len();
                let way = (0..parts).map(|k| edge.bound(k, 0.0, 1.0)).fold(0.0, f64::max);
                let samples = (way / 0.002).ceil() as u32;
                (0..=samples).any(|i| peer.intersects(&edge.footprint_at(f64::from(i) / f64::from(samples.max(1)))))
            }),
        ])
    }
}

/// Two rows for the same edges: whether they are free, which samples answer too, and their clearance or hit.
fn certified<R: Robot>(table: &mut Table, robot: &str, count: usize, edges: impl Fn() -> Edges<R>) {
    let free = format!("{robot} edge, certified free or not, {count} obstacles");
    table.row(&free, ">= 50x", || edges().beside_samples(Checker::edge_free));
    let verdict = format!("{robot} edge, certified, with its clearance or hit, {count} obstacles");
    table.row(&verdict, ">= 50x", || edges().beside_samples(Checker::edge));
}

pub fn rows(table: &mut Table) {
    for (count, side, longest, must) in [(40, 8.0, 2.0, ">= 5x"), (10_000, 100.0, 1.0, ">= 2x")] {
        let scene = walls(count, side, longest);
        table.row(&format!("disc edge, exact, free or not, {count} segments"), must, || {
            disc(&scene, side, Checker::edge_free)
        });
        table.row(&format!("disc edge, exact, with its clearance or hit, {count} segments"), must, || {
            disc(&scene, side, Checker::edge)
        });
    }
    for (count, scene) in arm_scenes() {
        certified(table, "arm", count, || {
            Edges::new(Checker::new(scene.clone(), Reach::<2>::workbench()), |s, arm| {
                let o = Point2::origin();
                let a = arm.sample(o, o, s);
                [a, T2::new(a.0[0] + s.uniform(-0.5, 0.5), a.0[1] + s.uniform(-0.5, 0.5))]
            })
        });
    }
    for (count, scene) in [(3, boxes(3, 0.0)), (100, boxes(100, 0.0)), (10_000, boxes(10_000, 0.0))] {
        let (min, max) = (scene.bounds().min, scene.bounds().max);
        certified(table, "car", count, || {
            Edges::new(Checker::new(scene.clone(), HITCH), |s, car| {
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
