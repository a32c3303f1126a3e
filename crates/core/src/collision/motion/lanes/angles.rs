//! Sine and cosine in single precision, as loops over lanes need them: without a branch and without a table.

/// Largest angle in size, radians, that [`sin_cos`] takes.
pub(crate) const MAX_ANGLE: f64 = 16.0;

/// The sine and the cosine of an angle of at most [`MAX_ANGLE`], each off by at most 2^-22.
///
/// A whole number of quarter turns is taken away, at most eleven of them. Their first part has eight bits, so that its
/// multiples and the difference are exact; what the second part is rounded by does not count. The polynomials are those
/// of Cephes for an eighth of a turn to either side.
#[inline(always)]
pub(crate) fn sin_cos(angle: f32) -> (f32, f32) {
    // the sum's last bit is worth 1, so that its bits end in the number of quarter turns
    const SHIFT: f32 = 12_582_912.0;
    let shifted = angle * std::f32::consts::FRAC_2_PI + SHIFT;
    let (quarters, bits) = (shifted - SHIFT, shifted.to_bits());
    let r = (angle - quarters * 1.570_312_5) - quarters * 4.838_268e-4;
    let z = r * r;
    let sin = ((-1.951_529_6e-4 * z + 8.332_161e-3) * z - 1.666_665_5e-1) * z * r + r;
    let cos = ((2.443_315_7e-5 * z - 1.388_731_6e-3) * z + 4.166_664_6e-2) * z * z - 0.5 * z + 1.0;
    let (sin, cos) = if bits & 1 == 0 { (sin, cos) } else { (cos, sin) };
    let flipped = |value: f32, quarter: u32| f32::from_bits(value.to_bits() ^ ((quarter & 2) << 30));
    (flipped(sin, bits), flipped(cos, bits.wrapping_add(1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_are_those_of_double_precision_to_22_bits() {
        let mut worst = 0.0;
        for i in -2_000_000..=2_000_000_i32 {
            let angle = i as f32 * (MAX_ANGLE as f32 / 2_000_000.0);
            let ((sin, cos), (exact_sin, exact_cos)) = (sin_cos(angle), crate::num::sin_cos(f64::from(angle)));
            worst = crate::num::greater((f64::from(sin) - exact_sin).abs(), worst);
            worst = crate::num::greater((f64::from(cos) - exact_cos).abs(), worst);
        }
        assert!(worst < 1.0 / f64::from(1 << 22), "{worst}");
    }
}
