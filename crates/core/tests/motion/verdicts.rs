//! The claims of verdicts on motions, against dense sampling.

use motion_lab_core::collision::{Certificate, Collision, EdgeVerdict, MarchOptions, Scene, march, verify_certificate};
use motion_lab_core::geometry::{Footprint, Placed, largest_coordinate};
use motion_lab_core::num::ulp;
use motion_lab_core::robots::Motion;

use oracle::{plain, sweep};

/// Distance before and after a hit at which its direction is sampled, metres of motion.
const PROBE: f64 = 1e-4;

/// The counts of a survey of many edges.
#[derive(Debug, Default)]
pub struct Tally {
    pub edges: u64,
    pub free: u64,
    pub hits: u64,
    /// Hits that go on into the obstacle.
    pub transversal: u64,
    /// Hits bracketed more widely than a micrometre, where the motion grazes.
    pub wide: u64,
    /// Hits at the start of the motion.
    pub from_contact: u64,
    pub unresolved: u64,
    /// Steps of all certificates.
    pub steps: usize,
}

impl Tally {
    /// Prints the counts on one line.
    pub fn print(&self, name: &str) {
        println!(
            "{name}: {} edges, {} free, {} hits ({} transversal, {} from contact, {} in a wide bracket), {:.3} % unresolved, \
             {:.1} steps an edge",
            self.edges,
            self.free,
            self.hits,
            self.transversal,
            self.from_contact,
            self.wide,
            100.0 * self.unresolved as f64 / self.edges as f64,
            self.steps as f64 / self.edges as f64,
        );
    }
}

/// A scene and its pieces for the sampling oracle.
pub struct Sampled<'a> {
    pub scene: &'a Scene,
    pieces: Vec<Placed>,
}

impl<'a> Sampled<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        Sampled { scene, pieces: scene.pieces().map(|(_, piece)| piece.clone()).collect() }
    }

    /// The distance by the plain oracle.
    pub fn distance(&self, footprint: &Footprint) -> f64 {
        let parts = footprint.parts().iter();
        parts.fold(f64::INFINITY, |m, part| sweep::nearest_of(part.placed(), &self.pieces, m))
    }

    /// The least clearance found on `[0, until]`: steps of half the clearance, and of 0.1 mm where it is small.
    pub fn least<M: Motion>(&self, motion: &M, speed: f64, until: f64) -> f64 {
        let (mut s, mut least) = (0.0, f64::INFINITY);
        loop {
            let here = self.distance(&motion.footprint_at(s));
            least = if here < least { here } else { least };
            if s >= until || here == 0.0 {
                return least;
            }
            let travel = if 0.5 * here > 1e-4 { 0.5 * here } else { 1e-4 };
            let next = s + if speed > 0.0 { travel / speed } else { 1.0 };
            s = if next < until { next } else { until };
        }
    }
}

/// The greatest speed of a vertex per unit of the parameter, by finite differences; a tenth more for what lies between.
fn measured_speed<M: Motion>(motion: &M) -> f64 {
    let n = 48;
    let frames: Vec<Footprint> = (0..=n).map(|i| motion.footprint_at(f64::from(i) / f64::from(n))).collect();
    let mut speed = 0.0;
    for pair in frames.windows(2) {
        for (p, q) in pair[0].parts().iter().zip(pair[1].parts()) {
            for (v, w) in p.placed().core().iter().zip(q.placed().core()) {
                let d = (w - v).norm() * f64::from(n);
                speed = if d > speed { d } else { speed };
            }
        }
    }
    1.1 * speed
}

/// Marches along a motion and checks everything that the verdict claims.
pub fn check(
    world: &Sampled<'_>,
    motion: &impl Motion,
    options: MarchOptions,
    certificate: &mut Certificate,
    tally: &mut Tally,
    at: impl Fn() -> String,
) -> EdgeVerdict {
    let verdict = march(world.scene, motion, options, Some(certificate));
    check_claims(world, motion, options.margin, (verdict, certificate), tally, at);
    verdict
}

/// Checks everything that a verdict on a motion, and its certificate, claim.
pub fn check_claims(
    world: &Sampled<'_>,
    motion: &impl Motion,
    margin: f64,
    (verdict, certificate): (EdgeVerdict, &Certificate),
    tally: &mut Tally,
    at: impl Fn() -> String,
) {
    let proven = verify_certificate(world.scene, motion, certificate).unwrap_or_else(|e| panic!("{e}: {}", at()));
    assert_eq!(proven, certificate.proven_until(), "{}", at());
    assert!(certificate.steps().len() <= 4096, "{} steps: {}", certificate.steps().len(), at());
    tally.edges += 1;
    tally.steps += certificate.steps().len();
    let speed = measured_speed(motion);
    let kept_until = |s: f64| s == 0.0 || world.least(motion, speed, s) > margin;
    match verdict {
        EdgeVerdict::Free { clearance } => {
            tally.free += 1;
            assert_eq!((proven, certificate.clearance()), (1.0, clearance), "{}", at());
            let sampled = world.least(motion, speed, 1.0);
            assert!(clearance > margin && sampled >= clearance, "{clearance} proven, {sampled} sampled: {}", at());
        }
        EdgeVerdict::Hit { free_until, contact_at, part, by } => {
            let obstacle = by.obstacle().unwrap();
            tally.hits += 1;
            assert_eq!(proven, free_until, "{}", at());
            let contact = motion.footprint_at(contact_at);
            assert!(world.scene.distance(&contact) <= margin, "no contact at {contact_at}: {}", at());
            let touching = contact.parts()[part].placed();
            let gap = world.scene.pieces().filter(|(id, _)| *id == obstacle).fold(f64::INFINITY, |m, (_, piece)| {
                let d = plain::distance(touching, piece);
                if d < m { d } else { m }
            });
            let rounding = 32.0 * ulp(largest_coordinate([touching]) + 1.0);
            assert!(gap <= margin + rounding, "part {part} is {gap} away: {}", at());
            if contact_at == 0.0 {
                tally.from_contact += 1;
                return;
            }
            assert!(free_until < contact_at && kept_until(free_until), "not free until {free_until}: {}", at());
            let width = (0..contact.parts().len())
                .map(|k| motion.bound(k, free_until, contact_at))
                .fold(0.0, |m, d| if d > m { d } else { m });
            if margin == 0.0 && is_transversal(world, motion, (free_until, contact_at), speed) {
                tally.transversal += 1;
                assert!(width <= 1e-6, "a transversal hit in a bracket of {width}: {}", at());
            } else if width > 1e-6 {
                // a wide bracket is allowed only where the gap before it is too small for any step
                let gap = world.distance(&motion.footprint_at(free_until)) - margin;
                assert!(gap <= 1e-9, "a bracket of {width}, though {gap} is left before it: {}", at());
                tally.wide += 1;
            }
        }
        EdgeVerdict::Unresolved { free_until, gap, reason } => {
            tally.unresolved += 1;
            println!("unresolved ({reason:?}, gap {gap:e}) after {free_until}: {}", at());
            assert_eq!(proven, free_until, "{}", at());
            assert!(kept_until(free_until), "not free until {free_until}: {}", at());
        }
    }
}

/// Whether the motion goes on into the obstacle: clear of it a little before the hit, and deep in it a little after.
fn is_transversal(world: &Sampled<'_>, motion: &impl Motion, (before, after): (f64, f64), speed: f64) -> bool {
    let probe = PROBE / speed;
    before >= probe
        && after + probe <= 1.0
        && world.distance(&motion.footprint_at(before - probe)) > 0.2 * PROBE
        && world.scene.depth(&motion.footprint_at(after + probe)) > 0.2 * PROBE
}
