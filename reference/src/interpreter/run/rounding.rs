//! How the results of operations are rounded.

/// How values of type `float` are rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// In 64 bits, but no larger than a float can be.
    Exact,
    /// After each operation to 32 bits, as a driver does that follows IEEE 754.
    Single,
    /// To a float near by where the result is none, in one of four ways, and to 0 below the least normal float, as a
    /// driver may: a value that this moves depends on how a driver rounds, or approximates a sine.
    Noisy(u8),
}

/// How far a noisy result is off at least, relative to it: two steps of a float.
const NOISE: f64 = 2.4e-7;

/// Floats of this size and more round to infinity: the middle between the largest float and the next power of two.
const OVERFLOW: f64 = 340_282_356_779_733_660_000_000_000_000_000_000_000.0;

/// How one kind of result is rounded.
pub(super) trait Rounding {
    fn round(x: f64) -> f64;

    /// What an operation gives that does not compute, as the bits of an integer taken for a float.
    fn given(x: f64) -> f64 {
        x
    }

    /// An angle as a driver has it that takes whole turns off it in its own way.
    fn angle(x: f64) -> f64 {
        x
    }
}

pub(super) struct Exact;
pub(super) struct SinglePrecision;
pub(super) struct Noisy<const WAY: u8>;
pub(super) struct DoublePrecision;

impl Rounding for Exact {
    #[inline(always)]
    fn round(x: f64) -> f64 {
        if x.abs() >= OVERFLOW { f64::INFINITY.copysign(x) } else { x }
    }
}

impl Rounding for SinglePrecision {
    #[inline(always)]
    fn round(x: f64) -> f64 {
        f64::from(x as f32)
    }
}

impl<const WAY: u8> Rounding for Noisy<WAY> {
    #[inline(always)]
    fn round(x: f64) -> f64 {
        let near = f64::from(x as f32);
        if is_subnormal(x) {
            return 0.0_f64.copysign(x);
        }
        // Drivers compute exactly what is a float: small whole numbers stay whole.
        if near == x {
            return x;
        }
        // Any bit will do that is as good as random.
        let is_up = (x.to_bits() >> (20 - WAY)) & 1 == 0;
        let noise = NOISE * f64::from(1 + WAY);
        f64::from((x * (1.0 + if is_up { noise } else { -noise })) as f32)
    }

    #[inline(always)]
    fn given(x: f64) -> f64 {
        if is_subnormal(x) { 0.0_f64.copysign(x) } else { x }
    }

    #[inline(always)]
    fn angle(x: f64) -> f64 {
        x * (1.0 + NOISE * f64::from(1 + WAY))
    }
}

impl Rounding for DoublePrecision {
    #[inline(always)]
    fn round(x: f64) -> f64 {
        x
    }
}

/// Whether a float of this size has no leading 1, which many drivers take for 0.
#[inline(always)]
pub fn is_subnormal(x: f64) -> bool {
    x.abs() < f64::from(f32::MIN_POSITIVE)
}
