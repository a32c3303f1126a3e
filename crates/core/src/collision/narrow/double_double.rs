//! Double-double arithmetic: about 106 bits, for comparisons that `f64` cannot decide.

use std::cmp::Ordering;

/// An unevaluated sum `hi + lo` with `|lo|` at most half an ulp of `hi`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dd {
    pub(crate) hi: f64,
    lo: f64,
}

/// Knuth's exact sum: `a + b = hi + lo`.
fn two_sum(a: f64, b: f64) -> Dd {
    let hi = a + b;
    let v = hi - a;
    Dd { hi, lo: (a - (hi - v)) + (b - v) }
}

/// Dekker's exact product without a fused multiply-add: `a * b = hi + lo`.
fn two_prod(a: f64, b: f64) -> Dd {
    const SPLITTER: f64 = 134_217_729.0; // 2^27 + 1
    let split = |x: f64| {
        let c = SPLITTER * x;
        let high = c - (c - x);
        (high, x - high)
    };
    let hi = a * b;
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    Dd { hi, lo: al * bl - (((hi - ah * bh) - al * bh) - ah * bl) }
}

impl Dd {
    /// `a + b`, exactly.
    pub(crate) fn sum(a: f64, b: f64) -> Dd {
        two_sum(a, b)
    }

    /// `a - b`, exactly.
    pub(crate) fn difference(a: f64, b: f64) -> Dd {
        two_sum(a, -b)
    }

    pub(crate) fn add(self, other: Dd) -> Dd {
        let s = two_sum(self.hi, other.hi);
        let t = two_sum(self.lo, other.lo);
        let u = two_sum(s.hi, s.lo + t.hi);
        two_sum(u.hi, u.lo + t.lo)
    }

    pub(crate) fn negated(self) -> Dd {
        Dd { hi: -self.hi, lo: -self.lo }
    }

    pub(crate) fn sub(self, other: Dd) -> Dd {
        self.add(other.negated())
    }

    pub(crate) fn mul(self, other: Dd) -> Dd {
        let p = two_prod(self.hi, other.hi);
        two_sum(p.hi, p.lo + (self.hi * other.lo + self.lo * other.hi))
    }

    pub(crate) fn sign(self) -> Ordering {
        self.hi.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Seed, Stream};

    #[test]
    fn integer_products_of_up_to_100_bits_are_exact() {
        let mut s = Stream::new(Seed(1), "dd");
        for _ in 0..10_000 {
            let draw = |s: &mut Stream, bits: u32| (s.bits() >> (64 - bits)) as i128;
            let (a, b) = (draw(&mut s, 50), draw(&mut s, 50));
            let (c, d) = (draw(&mut s, 49), draw(&mut s, 50));
            let dd = |x: i128| Dd::sum(x as f64, 0.0);
            let difference = dd(a).mul(dd(b)).sub(dd(c).mul(dd(d)));
            assert_eq!(difference.sign(), (a * b).cmp(&(c * d)));
            // a product and one more than it compare as different
            let one_more = dd(a).mul(dd(b)).add(dd(1));
            assert_eq!(one_more.sub(dd(a).mul(dd(b))).sign(), Ordering::Greater);
        }
    }
}
