//! The clearance of motions from obstacles and from one another, by distances at many places.

use motion_lab_core::geometry::Placed;

use super::robots::Motion;
use oracle::{plain, sweep};

/// Largest clearance at which a robot is held, metres. Anything nearer may hold it.
pub const NEAR: f64 = 1e-4;

/// Number of places checked for contact once a motion has come near something.
const PLACES: u32 = 64;

/// Largest number of distance queries about one motion or one pair of motions.
const BUDGET: u32 = 5000;

/// The answer to a question about all places of a motion, from some of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    Yes,
    No,
    /// Something comes nearer than [`NEAR`], and no contact was found.
    Undecided,
}

impl Answer {
    /// Yes if one answer is yes, no if all are no.
    pub fn any(answers: impl IntoIterator<Item = Answer>) -> Answer {
        answers.into_iter().fold(Answer::No, |so_far, answer| match (so_far, answer) {
            (Answer::Yes, _) | (_, Answer::Yes) => Answer::Yes,
            (Answer::No, Answer::No) => Answer::No,
            _ => Answer::Undecided,
        })
    }
}

/// The distance from these parts to the nearest obstacle, metres; 0 on contact, infinity without obstacles.
pub fn clearance(parts: &[Placed], obstacles: &[Placed]) -> f64 {
    parts.iter().fold(f64::INFINITY, |least, part| sweep::nearest_of(part, obstacles, least))
}

/// The part of a motion that is possible among obstacles.
#[derive(Clone, Copy, Debug)]
pub struct Cut {
    /// Whether the motion touches an obstacle.
    pub blocked: Answer,
    /// The motion goes at least to this parameter: the first where an obstacle is near.
    pub at_least: f64,
    /// The motion goes at most to this parameter: the first where contact was found, or the end.
    pub at_most: f64,
    /// The clearance at its start, metres.
    pub start_clearance: f64,
}

impl Cut {
    /// The part of `motion` that is possible when anything nearer than `near` may hold it.
    ///
    /// The first loop steps by at most the clearance above `near`, or a tenth of `near`, so it misses nothing. The
    /// second loop searches for contact. A motion that starts where robots are held and comes no nearer to anything is
    /// free: a motion away from a held pose is free, and sliding never sticks.
    pub fn new(motion: &Motion, obstacles: &[Placed], near: f64) -> Self {
        let speed = motion.speed();
        let at = |s: f64| clearance(&motion.shapes_at(s), obstacles);
        let start_clearance = at(0.0);
        let cut = |blocked, at_least, at_most| Cut { blocked, at_least, at_most, start_clearance };
        if start_clearance == 0.0 {
            return cut(Answer::Yes, 0.0, 0.0);
        }
        if speed == 0.0 {
            return cut(Answer::No, 1.0, 1.0);
        }
        let (mut s, mut here, mut queries) = (0.0, start_clearance, 0);
        while here > near {
            queries += 1;
            if s >= 1.0 {
                return cut(Answer::No, 1.0, 1.0);
            }
            if queries == BUDGET {
                return cut(Answer::Undecided, s, 1.0);
            }
            let beyond = if here - near > 0.1 * near { here - near } else { 0.1 * near };
            s = if s + beyond / speed < 1.0 { s + beyond / speed } else { 1.0 };
            here = at(s);
        }
        let mut nearest = here;
        for k in 0..=PLACES {
            let on = s + (1.0 - s) * f64::from(k) / f64::from(PLACES);
            here = at(on);
            if here == 0.0 {
                return cut(Answer::Yes, s, on);
            }
            nearest = if here < nearest { here } else { nearest };
        }
        // robots are not held nearer than this; a teleport may put them there
        if s == 0.0 && start_clearance >= 0.3 * near && nearest > start_clearance - 0.01 * near {
            return cut(Answer::No, 1.0, 1.0);
        }
        cut(Answer::Undecided, s, 1.0)
    }
}

/// Whether the sets that two cut motions sweep over meet, regardless of time.
pub fn sweeps_meet((motion_a, a): (&Motion, &Cut), (motion_b, b): (&Motion, &Cut)) -> Answer {
    let (speed_a, speed_b) = (motion_a.speed(), motion_b.speed());
    // the motion of the other is already cut at a robot that stands still
    if a.at_most == 0.0 || b.at_most * speed_b == 0.0 {
        return Answer::No;
    }
    let apart = |s: f64, t: f64| clearance(&motion_a.shapes_at(s), &motion_b.shapes_at(t));
    if apart(0.0, 0.0) > NEAR + a.at_most * speed_a + b.at_most * speed_b {
        return Answer::No;
    }
    // contact is searched at places a centimetre apart, as far as both are sure to go
    let places = |motion: &Motion, speed: f64, until: f64| -> Vec<Vec<Placed>> {
        let count = 1 + (100.0 * speed * until) as u32;
        (0..=count).map(|k| motion.shapes_at(until * f64::from(k) / f64::from(count))).collect()
    };
    let (at_a, at_b) = (places(motion_a, speed_a, a.at_least), places(motion_b, speed_b, b.at_least));
    if at_a.iter().any(|a| at_b.iter().any(|b| a.iter().any(|a| b.iter().any(|b| plain::intersects(a, b))))) {
        return Answer::Yes;
    }
    // a distance is proven piece by piece, as far as both may go
    let mut open = vec![((0.0, a.at_most), (0.0, b.at_most))];
    let mut queries = 0;
    while let Some(((a0, a1), (b0, b1))) = open.pop() {
        let (s, t) = (0.5 * (a0 + a1), 0.5 * (b0 + b1));
        let (reach_a, reach_b) = (0.5 * (a1 - a0) * speed_a, 0.5 * (b1 - b0) * speed_b);
        let here = apart(s, t);
        if here > NEAR + reach_a + reach_b {
            continue;
        }
        queries += 1;
        if here <= NEAR || queries == BUDGET {
            let surely = here == 0.0 && s <= a.at_least && t <= b.at_least;
            return if surely { Answer::Yes } else { Answer::Undecided };
        }
        if reach_a > reach_b {
            open.extend([((a0, s), (b0, b1)), ((s, a1), (b0, b1))]);
        } else {
            open.extend([((a0, a1), (b0, t)), ((a0, a1), (t, b1))]);
        }
    }
    Answer::No
}
