//! Numbers as a person would write them.

/// Significant digits to which a free parameter is rounded if that still explains every sample: what a person would write.
const DIGITS: [i32; 3] = [1, 2, 3];

/// `x` with ever more significant digits.
pub(super) fn simpler(x: f64) -> [f64; DIGITS.len()] {
    DIGITS.map(|digits| significant(x, digits))
}

/// `x` rounded to so many significant digits.
fn significant(x: f64, digits: i32) -> f64 {
    let step = 10f64.powi(x.abs().log10().floor() as i32 + 1 - digits);
    if step < 1.0 {
        // Dividing by a power of ten keeps 0.3 exact where multiplying by 0.1 does not.
        let steps = (1.0 / step).round();
        (x * steps).round() / steps
    } else {
        (x / step).round() * step
    }
}
