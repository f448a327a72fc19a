//! What numbers are made of.

/// `count` bits of `a` from bit `offset` on; with `signed`, the highest of them is the sign.
pub fn field(a: f64, offset: f64, count: f64, signed: bool) -> i64 {
    let (offset, count) = ((offset as i64).clamp(0, 32), (count as i64).clamp(0, 32));
    if count == 0 {
        return 0;
    }
    let pattern = i64::from(a as i64 as u32) >> offset << (64 - count);
    if signed { pattern >> (64 - count) } else { (pattern.cast_unsigned() >> (64 - count)).cast_signed() }
}

/// `a · 2^b`, for whole `b`.
pub fn scaled(a: f64, b: f64) -> f64 {
    // Twice, so that neither power overflows where the product does not.
    let half = (b / 2.0).trunc().clamp(-1000.0, 1000.0);
    a * half.exp2() * (b - half).clamp(-1000.0, 1000.0).exp2()
}

/// `a` as a number in [0.5, 1) and a power of two.
pub fn split(a: f64) -> (f64, f64) {
    if a == 0.0 || !a.is_finite() {
        return (a, 0.0);
    }
    // The small numbers of 64 bits lose their leading 1: scale them into the usual ones.
    let (a, before) = if a.abs() < f64::MIN_POSITIVE { (a * 64_f64.exp2(), -64.0) } else { (a, 0.0) };
    let bits = a.to_bits();
    let exponent = ((bits >> 52) & 0x7FF) as i64 - 1022;
    let significand = f64::from_bits(bits & !(0x7FF << 52) | 1022 << 52);
    (significand, exponent as f64 + before)
}

/// The nearest number of 16 bits.
pub fn half(a: f32) -> u16 {
    let sign = if a.is_sign_negative() { 0x8000 } else { 0 };
    let magnitude = a.abs();
    if a.is_nan() {
        return sign | 0x7E00;
    }
    // From the middle between the largest number and the next power of two on.
    if magnitude >= 65_520.0 {
        return sign | 0x7C00;
    }
    // The distance of neighbours: 2^-24 below 2^-14, and 2^-10 of the leading bit above.
    let exponent = (((magnitude.to_bits() >> 23) as i32) - 127).max(-14);
    let unit = f64::from(exponent - 10).exp2();
    let steps = (f64::from(magnitude) / unit).round_ties_even() as u32;
    // 1024 steps more are one exponent more, so that a carry goes where it belongs.
    let pattern = ((exponent + 14) as u32) * 1024 + steps;
    sign | pattern as u16
}

/// The value of a number of 16 bits.
pub fn of_half(pattern: u16) -> f64 {
    let sign = if pattern & 0x8000 == 0 { 1.0 } else { -1.0 };
    let (exponent, fraction) = (i32::from(pattern >> 10 & 31), f64::from(pattern & 1023));
    sign * match exponent {
        0 => fraction * (-24_f64).exp2(),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        _ => (1024.0 + fraction) * f64::from(exponent - 25).exp2(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_numbers_of_16_bits_are_themselves_again() {
        for pattern in 0..=u16::MAX {
            let value = of_half(pattern);
            if !value.is_nan() {
                assert_eq!(half(value as f32), pattern, "{value}");
            }
        }
        // 1 + 2^-11 lies in the middle between 1 and the next: the even one is taken.
        assert_eq!(half(1.0 + 2_f32.powi(-11)), 0x3C00);
        assert_eq!(half(1.0 + 3.0 * 2_f32.powi(-11)), 0x3C02);
        assert_eq!((half(65_519.0), half(65_520.0)), (0x7BFF, 0x7C00));
    }

    #[test]
    fn a_field_of_bits_may_have_a_sign() {
        assert_eq!(field(240.0, 4.0, 4.0, false), 15);
        assert_eq!(field(240.0, 4.0, 4.0, true), -1);
        assert_eq!(field(-1.0, 0.0, 32.0, true), -1);
        assert_eq!(field(-1.0, 31.0, 1.0, false), 1);
        assert_eq!(field(-1.0, 3.0, 0.0, true), 0);
    }

    #[test]
    fn a_number_is_its_significand_times_a_power_of_two() {
        for a in [1.0, -3.5, 0.3, 1e300, 5e-324, -0.0] {
            let (significand, exponent) = split(a);
            assert_eq!(significand * exponent.max(-1000.0).exp2() * (exponent + 1000.0).min(0.0).exp2(), a);
            assert!(a == 0.0 || (0.5..1.0).contains(&significand.abs()));
            assert_eq!(scaled(significand, exponent), a);
        }
    }
}
