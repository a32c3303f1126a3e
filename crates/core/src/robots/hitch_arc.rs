//! `HitchArc`, what a car does under a constant control: the chain of its ticks' motions.

use std::f64::consts::PI;

use super::hitch::farthest;
use super::jackknife::TRAILER;
use super::{CarCmd, ConfigurationError, Drivable, Hitch, Leaving, Motion, Rates, Robot, TICK};
use crate::configuration::{Configuration, HitchCfg};
use crate::geometry::{Footprint, Tangent2};
use crate::num::{greater, lesser, rk4, sin, sinc, ulp, wrap};

/// The number of Runge-Kutta steps for the trailer's heading in a motion of one tick.
const TRAILER_SUBSTEPS: u32 = 4;

/// The greatest number of ticks of one drive: an hour.
const MAX_TICKS: f64 = 72_000.0;

/// A time step this near a whole number of ticks is that number of ticks; in ticks.
const WHOLE: f64 = 1e-9;

/// The greatest number of pieces into which a tick is divided to see whether it leaves the jackknife limit.
const MAX_PIECES: f64 = 256.0;

/// The motion of one tick: the body's exact arc, the trailer dragged along.
#[derive(Clone, Copy, Debug, PartialEq)]
struct TickArc {
    car: Hitch,
    start: HitchCfg,
    ahead: f64,
    turn: f64,
    /// `sinc` of half the turn.
    chord: f64,
}

impl TickArc {
    fn at(&self, s: f64) -> HitchCfg {
        if s == 0.0 {
            return self.start;
        }
        let theta = self.start.body.theta;
        let tangent = Tangent2::new(s * self.ahead, 0.0, s * self.turn);
        let chord = if s == 1.0 { self.chord } else { sinc(0.5 * tangent.dtheta) };
        let body = self.start.body.boxplus_along(&tangent, chord);
        // Per unit of s: psi' = (ds / d_h) sin(theta(s) - psi) with theta(s) = theta + s dtheta in closed form.
        let trailer = self.start.trailer.zip(self.car.hitch_len).map(|(psi, hitch_len)| {
            let spin = self.ahead / hitch_len;
            let slope = |t: f64, psi: f64| spin * sin(theta + t * self.turn - psi);
            wrap(rk4(slope, psi, 0.0, s, TRAILER_SUBSTEPS))
        });
        HitchCfg { body, trailer }
    }

    fn rates(&self, part: usize) -> Rates {
        // The frames' common origin, the rear axle, moves uniformly on a circle.
        let (speed, acceleration) = (self.ahead.abs(), (self.ahead * self.turn).abs());
        match self.car.hitch_len {
            Some(hitch_len) if part == 1 => {
                // |psi'| <= |ds| / d_h, and |psi''| <= (|ds| / d_h) (|dtheta| + |psi'|). The Runge-Kutta solution
                // follows the true one to far better than the percent added here.
                let spin = 1.01 * speed / hitch_len;
                let spin_rate = 1.01 * spin * (self.turn.abs() + spin);
                let reach = farthest(self.car.trailer_body.rectangle(hitch_len));
                Rates { speed: speed + reach * spin, acceleration: acceleration + reach * (spin_rate + spin * spin) }
            }
            _ => {
                let reach = farthest(self.car.body.rectangle());
                Rates {
                    speed: speed + reach * self.turn.abs(),
                    acceleration: acceleration + reach * self.turn * self.turn,
                }
            }
        }
    }

    /// By how much the velocity of a part's points may jump where this tick's motion ends and the next begins, metres
    /// per tick. The solution of the equation has no such jump, that by Runge and Kutta's method one of its error: of
    /// fourth order in the substep, with a factor below a third.
    fn kink(&self, part: usize) -> f64 {
        match self.car.hitch_len {
            Some(hitch_len) if part == 1 => {
                let spin = self.ahead.abs() / hitch_len;
                let substep = spin / f64::from(TRAILER_SUBSTEPS);
                farthest(self.car.trailer_body.rectangle(hitch_len)) * spin * (substep * substep) * (substep * substep)
            }
            _ => 0.0,
        }
    }
}

/// The car's motion under a constant control: the chain of the motions of its ticks.
///
/// At the end of its tick number i, at the parameter `i / ticks()`, it is where the simulator's car is after i ticks of
/// that control, bit for bit. A motion of one tick or less is one piece.
#[derive(Clone, Debug, PartialEq)]
pub struct HitchArc {
    first: TickArc,
    control: CarCmd,
    seconds: f64,
    /// The configurations at which the later ticks start.
    later: Vec<HitchCfg>,
    /// The configuration at which the last tick ends. It is asked for again and again: a trailer's costs 16 sines.
    end: HitchCfg,
    /// The length in ticks, the last one perhaps a part of a tick; 1 for a motion of one piece.
    ticks: f64,
    /// By how much rounding may move a point of the footprint from the end of a tick to the start of the next, metres.
    rounding: f64,
    /// Where it leaves the car's jackknife limit.
    leaving: Option<Leaving>,
}

impl HitchArc {
    /// The number of ticks, the last one perhaps a part of a tick: tick number i, from 1, ends at `i / ticks()`. 1 for
    /// a motion of a tick or less.
    pub fn ticks(&self) -> f64 {
        self.ticks
    }

    /// The control that drives it.
    pub fn control(&self) -> CarCmd {
        self.control
    }

    /// How long it is driven, seconds; negative back in time.
    pub fn seconds(&self) -> f64 {
        self.seconds
    }

    /// A motion of one piece.
    fn one(first: TickArc, control: CarCmd, seconds: f64) -> Self {
        let (later, end) = (Vec::new(), first.at(1.0));
        HitchArc { first, control, seconds, later, end, ticks: 1.0, rounding: 0.0, leaving: None }
    }

    /// The chain of this many ticks, more than one.
    fn chain(first: TickArc, control: CarCmd, seconds: f64, ticks: f64) -> Self {
        let mut later = Vec::with_capacity(ticks.ceil() as usize - 1);
        let mut at = first.start;
        let mut size = greater(at.body.x.abs(), at.body.y.abs());
        while ((later.len() + 1) as f64) < ticks {
            at = TickArc { start: at, ..first }.at(1.0);
            size = greater(greater(at.body.x.abs(), at.body.y.abs()), size);
            later.push(at);
        }
        // A tick ends in a pose rounded to an ulp or two of its coordinates and its headings, and a heading is wrapped
        // by the f64 nearest 2 pi.
        let trailer = first.car.hitch_len.map_or(0.0, |length| farthest(first.car.trailer_body.rectangle(length)));
        let reach = greater(farthest(first.car.body.rectangle()), trailer);
        let rounding = 16.0 * ulp(4.0 + size + reach);
        let arc = HitchArc { first, control, seconds, later, end: at, ticks, rounding, leaving: None };
        HitchArc { end: arc.integrated(1.0), ..arc }
    }

    /// The arc with the place where it leaves its car's jackknife limit.
    fn limited(self) -> Self {
        HitchArc { leaving: self.find_leaving(), ..self }
    }

    /// Where the arc leaves its car's jackknife limit: a pair of neighbouring parameters, or almost.
    ///
    /// Under a constant control the hitch's angle f obeys `f' = -(v / d_h) sin f - (v / wheelbase) tan phi`, which does
    /// not depend on time, so f only rises or only falls, and cannot go round without passing the limit. So the arc
    /// stays within where the ends of its ticks do. Ticks in which the angle could change by so much that it is not
    /// known which way round it went are divided. The numerical solution departs from that by less than its own error,
    /// which for the lab's car and trailer is below 1e-9 rad.
    fn find_leaving(&self) -> Option<Leaving> {
        let TickArc { car, start, ahead, turn, .. } = &self.first;
        let (limit, hitch_len) = (car.jackknife?, car.hitch_len?);
        let is_within = |q: &HitchCfg| car.is_within_limits(q);
        let leaving = |within_until: f64, outside_at: f64| Leaving { within_until, outside_at, part: TRAILER };
        if !is_within(start) {
            return Some(leaving(0.0, 0.0));
        }
        let change = 1.01 * ahead.abs() / hitch_len + turn.abs();
        if limit >= PI || change == 0.0 {
            return None;
        }
        let pieces = (change / (PI - limit)).ceil();
        if pieces.is_nan() || pieces > MAX_PIECES {
            return Some(leaving(0.0, 1.0)); // nothing is known of so wild a motion
        }
        let mut within_until = 0.0;
        let mut number = 0.0;
        while within_until < 1.0 {
            number += 1.0;
            let s = lesser(number / pieces / self.ticks, 1.0);
            if is_within(&self.at(s)) {
                within_until = s;
                continue;
            }
            let mut outside_at = s;
            for _ in 0..64 {
                let middle = within_until + 0.5 * (outside_at - within_until);
                if is_within(&self.at(middle)) {
                    within_until = middle;
                } else {
                    outside_at = middle;
                }
            }
            return Some(leaving(within_until, outside_at));
        }
        None
    }

    /// The configuration at `s`, from the start of its tick on.
    fn integrated(&self, s: f64) -> HitchCfg {
        let (tick, within) = self.tick_at(s);
        let start = tick.checked_sub(1).map_or(self.first.start, |i| self.later[i]);
        TickArc { start, ..self.first }.at(within)
    }

    /// The number of the tick at `s`, from 0, and the parameter within its motion.
    fn tick_at(&self, s: f64) -> (usize, f64) {
        if self.later.is_empty() {
            return (0, s);
        }
        let start_of = |tick: usize| tick as f64 / self.ticks;
        let mut tick = ((s * self.ticks) as usize).min(self.later.len());
        // a product that was rounded across a border
        if tick < self.later.len() && s >= start_of(tick + 1) {
            tick += 1;
        } else if tick > 0 && s < start_of(tick) {
            tick -= 1;
        }
        let within = if s == start_of(tick) { 0.0 } else { (s * self.ticks - tick as f64).clamp(0.0, 1.0) };
        (tick, within)
    }

    /// The number of ends of ticks between two parameters.
    fn borders(&self, s0: f64, s1: f64) -> f64 {
        if self.later.is_empty() { 0.0 } else { self.tick_at(s0).0.abs_diff(self.tick_at(s1).0) as f64 }
    }
}

impl Motion for HitchArc {
    type Configuration = HitchCfg;

    fn at(&self, s: f64) -> HitchCfg {
        if s == 1.0 { self.end } else { self.integrated(s) }
    }

    fn footprint_at(&self, s: f64) -> Footprint {
        self.first.car.footprint(&self.at(s))
    }

    /// Every tick has the same control, so the same bounds.
    fn rates(&self, part: usize) -> Rates {
        let Rates { speed, acceleration } = self.first.rates(part);
        Rates { speed: speed * self.ticks, acceleration: acceleration * self.ticks * self.ticks }
    }

    fn bound(&self, part: usize, s0: f64, s1: f64) -> f64 {
        let within = self.rates(part).speed * (s1 - s0).abs();
        if self.later.is_empty() { within } else { within + self.borders(s0, s1) * self.rounding }
    }

    /// At the ends of ticks the pose jumps by its rounding, which moves a point off the chord by as much, and the
    /// trailer's velocity by its integration's error: a jump of a curve's derivative bends it by up to a quarter of
    /// the jump times the span.
    fn sagitta(&self, part: usize, s0: f64, s1: f64) -> f64 {
        let h = s1 - s0;
        let smooth = 0.125 * self.rates(part).acceleration * h * h;
        if self.later.is_empty() {
            return smooth;
        }
        let kink = 0.25 * self.first.kink(part) * self.ticks * h.abs();
        smooth + self.borders(s0, s1) * (kink + self.rounding)
    }

    fn leaves_limits(&self) -> Option<Leaving> {
        self.leaving
    }
}

impl Drivable for Hitch {
    type Control = CarCmd;
    type Drive = HitchArc;

    /// The motion from `q` under `u` for `dt` seconds. One longer than a [tick](TICK) is the chain of its ticks'
    /// motions, and what the simulator's car then does is that motion, bit for bit at the end of every tick. A last
    /// part of a tick is the beginning of that tick's motion. A `dt` within a billionth of a tick of a whole number of
    /// ticks is that number. With a negative `dt` the car goes back in time, in ticks too.
    ///
    /// # Errors
    /// [`ConfigurationError`] when `q` is not a configuration of this car, when `u` or `dt` is not finite, or when `dt`
    /// is more than an hour either way.
    fn drive(&self, q: &HitchCfg, u: &CarCmd, dt: f64) -> Result<HitchArc, ConfigurationError> {
        self.check(q)?;
        let arc = |dt: f64| {
            let ahead = u.v * dt;
            let turn = self.curvature(u.phi) * ahead;
            let finite = ahead.is_finite() && turn.is_finite();
            let chord = sinc(0.5 * turn);
            finite.then(|| TickArc { car: *self, start: q.in_chart(), ahead, turn, chord })
        };
        let whole = arc(dt).ok_or(ConfigurationError::ControlNotFinite)?;
        if dt.abs() <= TICK {
            return Ok(HitchArc::one(whole, *u, dt).limited());
        }
        let ticks = dt.abs() / TICK;
        if ticks > MAX_TICKS {
            return Err(ConfigurationError::TooLong);
        }
        let tick = arc(if dt > 0.0 { TICK } else { -TICK }).ok_or(ConfigurationError::ControlNotFinite)?;
        let nearest = ticks.round();
        let ticks = if (ticks - nearest).abs() <= WHOLE { nearest } else { ticks };
        let arc = if ticks == 1.0 { HitchArc::one(tick, *u, dt) } else { HitchArc::chain(tick, *u, dt, ticks) };
        Ok(arc.limited())
    }
}
