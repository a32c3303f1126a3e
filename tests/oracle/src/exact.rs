//! Contact and distance of two placed shapes in integer arithmetic.
//!
//! Every finite `f64` is an integer times a power of two, so any pair of placed shapes lies on a lattice. With the
//! lattice's step as the unit everything here is a polynomial of integers: `i128` when the numbers are small (the
//! lattice tests), `BigInt` otherwise. The only irrational quantity, the square root, is avoided by comparing squares.

use std::ops::{Add, Mul, Neg, Sub};

use motion_lab_core::geometry::{Placed, Point2};
use num_bigint::BigInt;

/// An integer wide enough for the pair at hand.
trait Int: Clone + Ord + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self> {
    /// `mantissa * 2^shift`.
    fn scaled(mantissa: i64, shift: u32) -> Self;
}

impl Int for i128 {
    fn scaled(mantissa: i64, shift: u32) -> Self {
        i128::from(mantissa) << shift
    }
}

impl Int for BigInt {
    fn scaled(mantissa: i64, shift: u32) -> Self {
        BigInt::from(mantissa) << shift
    }
}

/// `x` as an odd mantissa and an exponent: `x = mantissa * 2^exponent`.
fn decode(x: f64) -> (i64, i32) {
    assert!(x.is_finite(), "the oracle is asked about finite numbers only");
    if x == 0.0 {
        return (0, 0);
    }
    let bits = x.to_bits();
    let biased = (bits >> 52 & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let (mantissa, exponent) = if biased == 0 { (fraction, -1074) } else { (fraction | 1 << 52, biased - 1075) };
    let zeros = mantissa.trailing_zeros() as i32;
    let mantissa = mantissa >> zeros;
    (if x < 0.0 { -mantissa } else { mantissa }, exponent + zeros)
}

/// The number of binary places of `x` after the point.
fn places(x: f64) -> u32 {
    (-decode(x).1).max(0) as u32
}

/// `x * 2^places` as an integer; `x` must have no more binary places than that.
fn integer<T: Int>(x: f64, places: u32) -> T {
    let (mantissa, exponent) = decode(x);
    T::scaled(mantissa, u32::try_from(exponent + places as i32).expect("enough places"))
}

/// The exact distance of a pair of shapes, in units of the lattice's step `2^-places`.
pub struct ExactPair {
    places: u32,
    /// The squared distance of the cores is `square / scale`.
    square: BigInt,
    scale: BigInt,
    /// The sum of the radii.
    reach: BigInt,
}

impl ExactPair {
    pub fn new(a: &Placed, b: &Placed) -> Self {
        let numbers = || {
            let coordinates = [a, b].into_iter().flat_map(|s| s.core().iter().flat_map(|p| [p.x, p.y]));
            coordinates.chain([a.radius(), b.radius()])
        };
        let places = numbers().map(places).max().unwrap_or(0);
        let size = numbers().fold(0.0_f64, |m, x| if x.abs() > m { x.abs() } else { m });
        // below 2^19 steps every product in here stays below 2^127
        let small = places < 60 && size * (1_u64 << places) as f64 <= (1 << 19) as f64;
        let (square, scale) = if small {
            let (square, scale) = core_distance::<i128>(a.core(), b.core(), places);
            (square.into(), scale.into())
        } else {
            core_distance::<BigInt>(a.core(), b.core(), places)
        };
        let reach = integer::<BigInt>(a.radius(), places) + integer::<BigInt>(b.radius(), places);
        ExactPair { places, square, scale, reach }
    }

    /// Whether the two shapes have a point in common.
    pub fn contact(&self) -> bool {
        self.square <= &self.reach * &self.reach * &self.scale
    }

    /// Whether the two shapes touch without overlap: the distance of their cores is exactly the sum of the radii.
    pub fn tangent(&self) -> bool {
        self.square == &self.reach * &self.reach * &self.scale
    }

    /// Whether the shapes are apart by more than `gap` metres.
    pub fn apart_by_more_than(&self, gap: f64) -> bool {
        self.compare(gap, 0.0).is_gt()
    }

    /// Whether the distance of the two shapes is within `tolerance` metres of `claimed`.
    pub fn distance_is(&self, claimed: f64, tolerance: f64) -> bool {
        // on contact the distance is 0, not the negative number that the comparison would see
        let not_below = claimed <= tolerance || self.compare(claimed, -tolerance).is_ge();
        not_below && self.compare(claimed, tolerance).is_le()
    }

    /// Compares the distance of the cores less the radii with `x + y`, exactly; `x + y` must be at least 0.
    fn compare(&self, x: f64, y: f64) -> std::cmp::Ordering {
        assert!(x + y >= 0.0);
        let places = [places(x), places(y), self.places].into_iter().max().unwrap_or(0);
        let finer = places - self.places;
        let reach = integer::<BigInt>(x, places) + integer::<BigInt>(y, places) + (&self.reach << finer);
        (&self.square << (2 * finer)).cmp(&(&reach * &reach * &self.scale))
    }
}

/// Whether `p` lies within `tolerance` metres of the shape, exactly.
pub fn lies_on(p: Point2, shape: &Placed, tolerance: f64) -> bool {
    let point = Placed::new([p], 0.0);
    !ExactPair::new(&point, shape).apart_by_more_than(tolerance)
}

type Vertex<T> = [T; 2];

/// The squared distance of two cores as a fraction.
fn core_distance<T: Int>(a: &[Point2], b: &[Point2], places: u32) -> (T, T) {
    let lattice = |core: &[Point2]| -> Vec<Vertex<T>> {
        core.iter().map(|p| [integer(p.x, places), integer(p.y, places)]).collect()
    };
    let (a, b) = (lattice(a), lattice(b));
    let (zero, one) = (T::scaled(0, 0), T::scaled(1, 0));
    let meet = contains(&a, &b[0])
        || contains(&b, &a[0])
        || edges(&a).any(|(p, q)| edges(&b).any(|(r, s)| segments_meet(p, q, r, s)));
    if meet {
        return (zero, one);
    }
    let from = |points: &[Vertex<T>], core: &[Vertex<T>]| -> Vec<(T, T)> {
        points.iter().flat_map(|p| edges(core).map(|(q, r)| point_segment(p, q, r)).collect::<Vec<_>>()).collect()
    };
    from(&a, &b)
        .into_iter()
        .chain(from(&b, &a))
        .reduce(|x, y| if x.0.clone() * y.1.clone() <= y.0.clone() * x.1.clone() { x } else { y })
        .expect("a core has a vertex")
}

/// The boundary's edges: a point is one edge of length 0, a segment one edge.
fn edges<T>(core: &[Vertex<T>]) -> impl Iterator<Item = (&Vertex<T>, &Vertex<T>)> {
    let count = if core.len() > 2 { core.len() } else { 1 };
    (0..count).map(move |i| (&core[i], &core[(i + 1) % core.len()]))
}

fn minus<T: Int>(a: &Vertex<T>, b: &Vertex<T>) -> Vertex<T> {
    [a[0].clone() - b[0].clone(), a[1].clone() - b[1].clone()]
}

fn cross<T: Int>(u: &Vertex<T>, v: &Vertex<T>) -> T {
    u[0].clone() * v[1].clone() - u[1].clone() * v[0].clone()
}

fn dot<T: Int>(u: &Vertex<T>, v: &Vertex<T>) -> T {
    u[0].clone() * v[0].clone() + u[1].clone() * v[1].clone()
}

/// The orientation of `a`, `b`, `c`: 1 for a left turn, -1 for a right turn, 0 on a line.
fn turn<T: Int>(a: &Vertex<T>, b: &Vertex<T>, c: &Vertex<T>) -> i32 {
    cross(&minus(b, a), &minus(c, a)).cmp(&T::scaled(0, 0)) as i32
}

/// Whether a polygon core, counter-clockwise, holds `p`; false for a point or a segment.
fn contains<T: Int>(core: &[Vertex<T>], p: &Vertex<T>) -> bool {
    core.len() > 2 && edges(core).all(|(a, b)| turn(a, b, p) >= 0)
}

/// Whether two closed segments, either of which may be a single point, have a point in common.
fn segments_meet<T: Int>(p: &Vertex<T>, q: &Vertex<T>, r: &Vertex<T>, s: &Vertex<T>) -> bool {
    let (tr, ts, tp, tq) = (turn(p, q, r), turn(p, q, s), turn(r, s, p), turn(r, s, q));
    let between = |x: &T, a: &T, b: &T| (a <= x && x <= b) || (b <= x && x <= a);
    let in_box =
        |x: &Vertex<T>, a: &Vertex<T>, b: &Vertex<T>| between(&x[0], &a[0], &b[0]) && between(&x[1], &a[1], &b[1]);
    (tr * ts < 0 && tp * tq < 0)
        || (tr == 0 && in_box(r, p, q))
        || (ts == 0 && in_box(s, p, q))
        || (tp == 0 && in_box(p, r, s))
        || (tq == 0 && in_box(q, r, s))
}

/// The squared distance from `p` to the segment `a b` as a fraction.
fn point_segment<T: Int>(p: &Vertex<T>, a: &Vertex<T>, b: &Vertex<T>) -> (T, T) {
    let (along, from_a, from_b) = (minus(b, a), minus(p, a), minus(p, b));
    let (zero, one) = (T::scaled(0, 0), T::scaled(1, 0));
    if dot(&from_a, &along) <= zero {
        (dot(&from_a, &from_a), one)
    } else if dot(&from_b, &along) >= zero {
        (dot(&from_b, &from_b), one)
    } else {
        let area = cross(&along, &from_a);
        (area.clone() * area, dot(&along, &along))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::geometry::Vertices;

    fn placed(points: &[(f64, f64)], radius: f64) -> Placed {
        Placed::new(points.iter().map(|&(x, y)| Point2::new(x, y)).collect::<Vertices>(), radius)
    }

    #[test]
    fn numbers_are_taken_apart_without_loss() {
        for x in [1.0, -0.75, 1e-300, 5e-324, 1e4, 0.1, -3.0] {
            let (mantissa, exponent) = decode(x);
            assert_eq!(mantissa as f64 * 2.0_f64.powf_exact(exponent), x);
        }
        assert_eq!(places(0.75), 2);
        assert_eq!(places(8.0), 0);
    }

    trait PowerOfTwo {
        fn powf_exact(self, exponent: i32) -> f64;
    }
    impl PowerOfTwo for f64 {
        fn powf_exact(self, exponent: i32) -> f64 {
            (0..exponent.abs()).fold(1.0, |x, _| if exponent < 0 { x / self } else { x * self })
        }
    }

    #[test]
    fn one_ulp_tells_touching_from_apart() {
        let disc = placed(&[(0.0, 0.0)], 2.0);
        assert!(ExactPair::new(&disc, &placed(&[(3.0, 4.0)], 3.0)).tangent());
        let farther = f64::from_bits(4.0_f64.to_bits() + 1);
        let apart = ExactPair::new(&disc, &placed(&[(3.0, farther)], 3.0));
        assert!(!apart.contact() && apart.distance_is(7.1e-16, 1e-18) && !apart.distance_is(7.2e-16, 1e-18));
        let nearer = f64::from_bits(4.0_f64.to_bits() - 1);
        let overlapping = ExactPair::new(&disc, &placed(&[(3.0, nearer)], 3.0));
        assert!(overlapping.contact() && !overlapping.tangent() && overlapping.distance_is(0.0, 0.0));
    }

    #[test]
    fn a_square_inside_another_is_in_contact_though_no_edges_meet() {
        let square = |s: f64| placed(&[(-s, -s), (s, -s), (s, s), (-s, s)], 0.0);
        assert!(ExactPair::new(&square(1.0), &square(4.0)).contact());
        assert!(ExactPair::new(&square(4.0), &square(1.0)).contact());
        let segment = placed(&[(0.1, 0.2), (0.3, -0.1)], 0.0);
        assert!(ExactPair::new(&segment, &square(4.0)).contact());
    }

    #[test]
    fn small_and_big_integers_agree() {
        // the second segment has a radius of 2^-40, too fine a step for i128
        let triangle = placed(&[(7.0, 1.0), (9.0, 9.0), (-1.0, 7.0)], 0.0);
        let segment = placed(&[(0.0, 0.0), (-3.0, -4.0)], 0.0);
        let step = 1.0 / (1_u64 << 40) as f64;
        let thick = placed(&[(0.0, 0.0), (-3.0, -4.0)], step);
        for (a, b) in [(&triangle, &segment), (&segment, &triangle)] {
            let pair = ExactPair::new(a, b);
            assert!(pair.distance_is(5.0, 0.0) && !pair.contact());
        }
        for (a, b) in [(&triangle, &thick), (&thick, &triangle)] {
            let pair = ExactPair::new(a, b);
            assert!(pair.distance_is(5.0 - step, 0.0) && pair.distance_is(5.0, step));
            assert!(!pair.distance_is(5.0, 0.999 * step) && !pair.distance_is(5.0 - 2.0 * step, 0.999 * step));
        }
    }
}
