//! Things that a motion grazes: exactly tangent, in numbers that hold without rounding.

use motion_lab_core::prelude::*;

use crate::seen::Seen;

/// About a nanometre, metres; it adds exactly to every coordinate here.
pub const HAIR: f64 = 1.0 / (1_u64 << 30) as f64;

/// A thing that is grazed, and the displacement that takes it a hair away.
pub struct Grazed {
    pub what: &'static str,
    pub thing: Seen,
    pub away: Vector2,
}

pub fn wall(a: (f64, f64), b: (f64, f64)) -> Seen {
    Seen::Wall(Point2::new(a.0, a.1), Point2::new(b.0, b.1))
}

fn points(corners: &[(f64, f64)]) -> Vec<Point2> {
    corners.iter().map(|&(x, y)| Point2::new(x, y)).collect()
}

pub fn outline(corners: &[(f64, f64)]) -> Seen {
    Seen::Outline(points(corners))
}

pub fn round(core: &[(f64, f64)], radius: f64) -> Seen {
    Seen::Round(points(core), radius)
}

/// The things that a disc of radius 1/4 grazes as its centre runs along the x axis: at (0, 1/4), or along a stretch
/// about it.
pub fn beside_a_line() -> Vec<Grazed> {
    let g = |what, thing| Grazed { what, thing, away: Vector2::new(0.0, HAIR) };
    vec![
        g("a wall along", wall((-0.75, 0.25), (0.5, 0.25))),
        g("a wall's end", wall((0.0, 0.25), (0.0, 2.0))),
        g("the end of a slanted wall", wall((0.0, 0.25), (1.0, 2.0))),
        g("a box", outline(&[(-0.5, 0.25), (0.5, 0.25), (0.5, 1.0), (-0.5, 1.0)])),
        g("a corner", outline(&[(0.0, 0.25), (1.0, 1.0), (-1.0, 1.5)])),
        g("a disc", round(&[(0.0, 0.75)], 0.5)),
        g("a capsule along", round(&[(-0.5, 0.5), (0.75, 0.5)], 0.25)),
        g("a capsule's cap", round(&[(0.0, 0.5), (0.5, 2.0)], 0.25)),
        g("a rounded side", round(&[(-0.5, 0.5), (0.5, 0.5), (0.0, 1.5)], 0.25)),
        g("a rounded corner", round(&[(0.0, 0.5), (1.0, 1.5), (-1.0, 1.5)], 0.25)),
    ]
}

/// The things that a point grazes as it goes round the origin at this radius, within 1.2 rad of the x axis. `post` is a
/// multiple of 5/4 beyond the radius.
pub fn about_a_circle(radius: f64, post: f64) -> Vec<Grazed> {
    let g = |what, thing| Grazed { what, thing, away: Vector2::new(HAIR, 0.0) };
    let slanted = Vector2::new(0.75 * HAIR, HAIR);
    let (x, r) = (radius, post - radius);
    let mut all = vec![
        g("a wall", wall((x, -3.0), (x, 4.0))),
        g("a wall's end", wall((x, 0.0), (x + 2.0, 0.0))),
        g("the end of a slanted wall", wall((x, 0.0), (x + 2.0, 1.0))),
        g("a box", outline(&[(x, -1.0), (x + 2.0, -1.0), (x + 2.0, 2.0), (x, 2.0)])),
        g("a corner", outline(&[(x, 0.0), (x + 1.0, -1.0), (x + 2.0, 0.0), (x + 1.0, 1.0)])),
        g("a disc", round(&[(x + 0.5, 0.0)], 0.5)),
        g("a capsule's side", round(&[(x + 0.5, -1.0), (x + 0.5, 2.0)], 0.5)),
        g("a rounded corner", round(&[(x + 0.5, 0.0), (x + 2.0, -1.0), (x + 2.0, 1.0)], 0.5)),
        Grazed { what: "a post at 3-4-5", thing: round(&[(3.0 * post / 5.0, 4.0 * post / 5.0)], r), away: slanted },
    ];
    if radius % 1.25 == 0.0 {
        let (u, v) = (3.0 * radius / 5.0, 4.0 * radius / 5.0);
        all.push(Grazed {
            what: "a wall at 3-4-5",
            thing: wall((u - 4.0, v + 3.0), (u + 4.0, v - 3.0)),
            away: slanted,
        });
        all.push(Grazed { what: "a wall's end at 3-4-5", thing: wall((u, v), (u + 1.0, v + 2.0)), away: slanted });
    }
    all
}
