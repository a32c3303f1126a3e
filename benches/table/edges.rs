//! Edges: exact for the disc, certified for arm and car, beside parry's casts and samples.

use motion_lab::collision::{Certificate, Checker, EdgeVerdict, Scene};
use motion_lab::num::wrap;
use motion_lab::prelude::*;

use crate::Table;
use crate::contest::numbers;
use crate::measure::Entrant;
use crate::pairs::{self, Pairs};
use crate::rivals::Task;
use crate::row::Mark;
use crate::worlds::{CASES, arm_scenes, boxes, pieces, walls};

/// Edges of a robot in a scene, and what the peers need to know of them.
struct Edges<R: Robot> {
    robot: &'static str,
    checker: Checker<R>,
    pairs: Vec<[R::Configuration; 2]>,
    settings: Vec<f64>,
    cases: Vec<Vec<f64>>,
}

/// A range of the parameter within which an edge first meets something; `None` where it is free.
fn contact(verdict: EdgeVerdict) -> Option<[f64; 2]> {
    match verdict {
        EdgeVerdict::Free { .. } => None,
        EdgeVerdict::Hit { free_until, contact_at, .. } => Some([free_until, contact_at]),
        EdgeVerdict::Unresolved { free_until, .. } => Some([free_until, 1.0]),
    }
}

impl<R: Robot> Edges<R> {
    fn task(&self, kind: &str) -> Task {
        Task {
            kind: kind.into(),
            settings: self.settings.clone(),
            obstacles: pieces(self.checker.scene()).map(numbers).collect(),
            cases: self.cases.clone(),
        }
    }

    fn verdicts(&self) -> Vec<Option<[f64; 2]>> {
        let mut certificate = Certificate::new();
        let verdict = |[a, b]: &[R::Configuration; 2]| {
            let verdict = self.checker.edge(a, b).expect("of this robot");
            assert_eq!(self.checker.edge_free(a, b), verdict.is_free(), "{a} to {b}");
            let certified = self.checker.edge_certified(a, b, &mut certificate).expect("of this robot");
            assert_eq!(certified.is_free(), verdict.is_free(), "{a} to {b}");
            contact(verdict)
        };
        self.pairs.iter().map(verdict).collect()
    }

    /// Checks that a peer agrees before the race on which edges are free, and where the others first meet something.
    /// Samples may miss what is touched for less than 2 mm, and parry's nonlinear cast misses some: as many edges as
    /// `allowed` may differ.
    fn agree(&self, name: &str, is_free: impl Fn(f64) -> bool, answers: &[Vec<f64>], allowed: usize) {
        let verdicts = self.verdicts();
        let differ = verdicts.iter().zip(answers).filter(|(ours, theirs)| ours.is_none() != is_free(theirs[0])).count();
        println!("  {name}: {differ} of {} verdicts differ", answers.len());
        assert!(differ <= allowed, "{name}: {differ} verdicts differ, more than {allowed}");
    }

    /// The two works of a robot in a scene: free or not, and with the clearance or the first contact.
    fn rows(&self, table: &mut Table, kinds: [&str; 2], names: [String; 2], marks: [f64; 2], allowed: usize) {
        let [free, hit] = kinds;
        let [free_name, hit_name] = names;
        let (checker, pairs) = (&self.checker, &self.pairs);
        table.race(&[(free_name, Mark::faster_by(marks[0]))], |peers| {
            // the disc answers 1 for free; arm and car when they meet something, or infinity
            let is_free = |answer: f64| if self.robot == "disc" { answer > 0.0 } else { answer > 1.0 };
            let peers = peers.entrants(&self.task(free), |name, answers| self.agree(name, is_free, answers, allowed));
            let ours = Entrant::new("", CASES, move |i| checker.edge_free(&pairs[i][0], &pairs[i][1]));
            std::iter::once(ours).chain(peers).collect()
        });
        table.race(&[(hit_name, Mark::faster_by(marks[1]))], |peers| {
            // a clearance is answered negative
            let is_free = |answer: f64| !(0.0..=1.0).contains(&answer);
            let peers = peers.entrants(&self.task(hit), |name, answers| {
                self.agree(name, is_free, answers, allowed);
                self.agree_on_contacts(name, answers, allowed);
            });
            let ours = Entrant::new("", CASES, move |i| checker.edge(&pairs[i][0], &pairs[i][1]));
            std::iter::once(ours).chain(peers).collect()
        });
    }

    /// Checks that a first contact is not before what is proven free, to 1e-3 of an edge. A cast whose elbow goes along
    /// chords may be earlier where a link comes near a wall slowly.
    fn agree_on_contacts(&self, name: &str, answers: &[Vec<f64>], allowed: usize) {
        let early = |(ours, theirs): &(Option<[f64; 2]>, &Vec<f64>)| {
            ours.is_some_and(|[free_until, _]| theirs[0] >= 0.0 && theirs[0] < free_until - 1e-3)
        };
        let early = self.verdicts().into_iter().zip(answers).filter(early).count();
        println!("  {name}: {early} contacts are early");
        assert!(early <= allowed, "{name}: {early} contacts where the edge is proven free, more than {allowed}");
    }
}

fn disc(scene: &Scene, side: f64) -> Edges<RustyDisc> {
    let Pairs { checker, pairs } = pairs::disc(scene.clone(), side);
    let settings = vec![checker.robot().radius];
    let cases = pairs.iter().map(|[a, b]| vec![a.0.x, a.0.y, b.0.x, b.0.y]).collect();
    Edges { robot: "disc", checker, settings, pairs, cases }
}

/// For the peers also the number of the last sample, so that no point moves 2 mm between two.
fn certified<R: Robot>(
    robot: &'static str,
    pairs: Pairs<R>,
    settings: Vec<f64>,
    case: impl Fn(&R::Configuration, &R::Configuration) -> Vec<f64>,
) -> Edges<R> {
    let Pairs { checker, pairs } = pairs;
    let sampled = |[a, b]: &[R::Configuration; 2]| {
        let edge = checker.robot().edge(a, b).expect("of this robot");
        let parts = edge.footprint_at(0.0).parts().len();
        let way = (0..parts).map(|k| edge.bound(k, 0.0, 1.0)).fold(0.0, f64::max);
        case(a, b).into_iter().chain([(way / 0.002).ceil().max(1.0)]).collect()
    };
    let cases = pairs.iter().map(sampled).collect();
    Edges { robot, checker, pairs, settings, cases }
}

fn arm(scene: Scene) -> Edges<Reach<2>> {
    let arm = Reach::<2>::workbench();
    let settings = vec![arm.base.x, arm.base.y, arm.lengths[0], arm.lengths[1], arm.link_radius];
    certified("arm", pairs::arm(scene), settings, |a, b| {
        vec![a.0[0], a.0[1], wrap(b.0[0] - a.0[0]), wrap(b.0[1] - a.0[1])]
    })
}

fn car(scene: Scene) -> Edges<Hitch> {
    let body = HITCH.body;
    let settings = vec![0.5 * body.length - body.rear_overhang, 0.0, 0.5 * body.length, 0.5 * body.width];
    certified("car", pairs::car(scene), settings, |a, b| {
        let (a, b) = (a.body, b.body);
        vec![a.x, a.y, a.theta, b.x - a.x, b.y - a.y, wrap(b.theta - a.theta)]
    })
}

fn names(robot: &str, how: &str, count: usize, what: &str) -> [String; 2] {
    ["free or not", "with its clearance or hit"].map(|asked| format!("{robot} edge, {how}, {asked}, {count} {what}"))
}

pub fn rows(table: &mut Table) {
    for (count, side, longest) in [(40, 8.0, 2.0), (10_000, 100.0, 1.0)] {
        let names = names("disc", "exact", count, "segments");
        if names.iter().any(|name| table.wants(name)) {
            disc(&walls(count, side, longest), side).rows(table, ["disc_free", "disc_hit"], names, [1.7, 2.0], 0);
        }
    }
    for ((count, scene), marks) in arm_scenes().into_iter().zip([[18.0, 3.5], [30.0, 8.0], [18.0, 6.0]]) {
        let names = names("arm", "certified", count, "obstacles");
        if names.iter().any(|name| table.wants(name)) {
            arm(scene).rows(table, ["arm_free", "arm_hit"], names, marks, 8);
        }
    }
    for (count, marks) in [(3, [40.0, 7.0]), (100, [40.0, 10.0]), (10_000, [30.0, 8.0])] {
        let names = names("car", "certified", count, "obstacles");
        if names.iter().any(|name| table.wants(name)) {
            car(boxes(count, 0.0)).rows(table, ["car_free", "car_hit"], names, marks, 8);
        }
    }
}
