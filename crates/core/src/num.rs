//! Elementary functions that give the same bits on every platform.
//!
//! The standard library's `sin`, `cos`, `tan`, `atan2`, `hypot`, `exp` and `ln` are the platform's own and differ
//! between native and wasm; everything here goes through the crate `libm`. `f64::min` and `f64::max` treat the two
//! zeros differently between targets, so [`lesser`] and [`greater`] replace them. A clippy ban (`clippy.toml`) enforces
//! both.

use std::f64::consts::{PI, TAU};

/// Sine of an angle in radians.
#[inline]
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}

/// Cosine of an angle in radians.
#[inline]
pub fn cos(x: f64) -> f64 {
    libm::cos(x)
}

/// Sine and cosine of an angle in radians.
#[inline]
pub fn sin_cos(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

/// Tangent of an angle in radians.
#[inline]
pub fn tan(x: f64) -> f64 {
    libm::tan(x)
}

/// The angle of the vector `(x, y)` in radians, in `[-pi, pi]`.
#[inline]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// The arc cosine, in `[0, pi]`; NaN outside `[-1, 1]`.
#[inline]
pub fn acos(x: f64) -> f64 {
    libm::acos(x)
}

/// The length of the vector `(x, y)`.
#[inline]
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

/// The exponential function.
#[inline]
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// The natural logarithm.
#[inline]
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// The square root: correctly rounded by IEEE 754, so the standard library's is portable.
#[inline]
pub fn sqrt(x: f64) -> f64 {
    x.sqrt()
}

/// The lesser of two numbers; `b` when they compare equal or either is NaN.
#[inline]
pub fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The greater of two numbers; `b` when they compare equal or either is NaN.
#[inline]
pub fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The angle wrapped to `(-pi, pi]`, `pi` itself included, in radians.
///
/// Exact for every finite input: the result differs from `angle` by a whole multiple of the `f64` nearest 2 pi, with no
/// rounding (`fmod` is exact, and the last subtraction is exact by Sterbenz's lemma). NaN for a non-finite input.
///
/// ```
/// use motion_lab_core::num::wrap;
/// use std::f64::consts::PI;
/// assert_eq!(wrap(PI), PI);
/// assert_eq!(wrap(-PI), PI);
/// assert_eq!(wrap(3.0 * PI), PI);
/// assert_eq!(wrap(0.25), 0.25);
/// ```
#[inline]
pub fn wrap(angle: f64) -> f64 {
    if angle > -PI && angle <= PI {
        return angle + 0.0; // as below, and most angles
    }
    wrap_far(angle)
}

/// [`wrap`] of an angle that may be out of range.
fn wrap_far(angle: f64) -> f64 {
    // the remainder of less than a turn is itself
    let r = if angle.abs() < TAU { angle } else { libm::fmod(angle, TAU) };
    let wrapped = if r > PI {
        r - TAU
    } else if r <= -PI {
        r + TAU
    } else {
        r
    };
    wrapped + 0.0 // a wrapped -0.0 is stored as +0.0
}

/// The angle itself, bit for bit, where it lies in `(-pi, pi]` (-0.0 too); [wrapped](wrap) where it lies outside.
///
/// Functions that take an angle from their caller pass it through this one. So an angle and the same angle a thousand
/// turns on mean one heading, and an angle in range keeps all its bits.
///
/// ```
/// use motion_lab_core::num::{in_range, wrap};
/// assert_eq!(in_range(1e3), wrap(1e3));
/// assert!(in_range(-0.0).is_sign_negative());
/// ```
#[inline]
pub fn in_range(angle: f64) -> f64 {
    if angle > -PI && angle <= PI { angle } else { wrap(angle) }
}

/// The unit in the last place of `x`: the gap from `|x|` to the next larger `f64`.
///
/// ```
/// assert_eq!(motion_lab_core::num::ulp(1.0), f64::EPSILON);
/// ```
pub fn ulp(x: f64) -> f64 {
    let a = x.abs();
    f64::from_bits(a.to_bits() + 1) - a
}

/// One classical Runge-Kutta integration of `dy/dt = f(t, y)` from `t0` over `span`, in `substeps` equal steps.
///
/// The number of steps is fixed, so the result is a pure function of the arguments.
pub fn rk4(f: impl Fn(f64, f64) -> f64, y0: f64, t0: f64, span: f64, substeps: u32) -> f64 {
    let h = span / f64::from(substeps);
    let mut y = y0;
    for i in 0..substeps {
        let t = t0 + f64::from(i) * h;
        let k1 = f(t, y);
        let k2 = f(t + 0.5 * h, y + 0.5 * h * k1);
        let k3 = f(t + 0.5 * h, y + 0.5 * h * k2);
        let k4 = f(t + h, y + h * k3);
        y += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    y
}

/// `sin(x) / x`, 1 at zero; a series below 1e-4, so that no digits are lost.
pub fn sinc(x: f64) -> f64 {
    let x2 = x * x;
    if x2 < 1e-8 { 1.0 - x2 / 6.0 * (1.0 - x2 / 20.0) } else { sin(x) / x }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_angle_of_less_than_a_turn_is_its_own_remainder() {
        let near = |x: f64| [x.next_down(), x, x.next_up()];
        let all = [0.0, 1.0, 2.5, PI, 4.0, TAU, 7.0, 2.0 * TAU, 1e300, f64::INFINITY, f64::NAN].map(near);
        for angle in all.as_flattened().iter().flat_map(|x| [*x, -x]) {
            let r = libm::fmod(angle, TAU);
            let by_remainder = [r, r - TAU, r + TAU].into_iter().find(|w| *w > -PI && *w <= PI).map_or(r, |w| w) + 0.0;
            assert_eq!(wrap(angle).to_bits(), by_remainder.to_bits(), "{angle}");
        }
    }

    #[test]
    fn wrap_is_exact_modulo_two_pi_and_stays_in_range() {
        for k in -1000..1000_i32 {
            let base = f64::from(k) * 0.00731;
            for turns in [-3.0, -1.0, 0.0, 1.0, 2.0] {
                let angle = base + turns * TAU;
                let w = wrap(angle);
                assert!(w > -PI && w <= PI, "wrap({angle}) = {w}");
                // exact: the remainder of the difference by TAU is 0
                assert_eq!(libm::fmod(libm::fmod(angle, TAU) - w, TAU), 0.0, "wrap({angle}) = {w}");
            }
        }
        assert_eq!(wrap(-PI), PI);
        assert_eq!(wrap(f64::from_bits(PI.to_bits() + 1)), f64::from_bits(PI.to_bits() + 1) - TAU);
        assert_eq!(wrap(-0.0).to_bits(), 0.0_f64.to_bits());
        assert!(wrap(1e300).abs() <= PI);
        assert!(wrap(f64::INFINITY).is_nan());
    }

    #[test]
    fn rk4_is_of_fourth_order() {
        // y' = y from 1: the error of one step of size h falls by about 2^5 when h is halved.
        let error = |n| (rk4(|_, y| y, 1.0, 0.0, 1.0, n) - std::f64::consts::E).abs();
        let ratio = error(8) / error(16);
        assert!((14.0..18.0).contains(&ratio), "global order 4 means a ratio near 16, got {ratio}");
    }

    #[test]
    fn sinc_agrees_across_its_switch() {
        for x in [0.0, 1e-300, 9.9e-5, 1.01e-4, 0.5, 3.0] {
            let exact = if x == 0.0 { 1.0 } else { sin(x) / x };
            assert!((sinc(x) - exact).abs() <= f64::EPSILON, "sinc({x})");
        }
    }
}
