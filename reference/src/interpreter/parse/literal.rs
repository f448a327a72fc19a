//! Numbers as they are written (GLSL 4.60, sections 4.1.3 and 4.1.4).

use crate::interpreter::syntax::ExpressionKind;

/// Whole floats from here on are not all floats of 32 bits.
const FIRST_GAP: f64 = 16_777_216.0;

/// The number, or none where it is no number.
pub fn literal(text: &str) -> Option<ExpressionKind> {
    let lower = text.to_ascii_lowercase();
    let hexadecimal = lower.strip_prefix("0x");
    if hexadecimal.is_none() && lower.contains(['.', 'e', 'f']) {
        let (digits, double) = match lower.strip_suffix("lf") {
            Some(digits) => (digits, true),
            None => (lower.strip_suffix('f').unwrap_or(&lower), false),
        };
        let value: f64 = digits.parse().ok()?;
        // A literal means the number that is written; only large whole ones are known by their neighbours.
        let value = if !double && value.abs() >= FIRST_GAP { f64::from(value as f32) } else { value };
        return Some(ExpressionKind::Floating(value, double));
    }
    let (digits, unsigned) = lower.strip_suffix('u').map_or((&*lower, false), |digits| (digits, true));
    let bits = match (digits.strip_prefix("0x"), digits.strip_prefix('0')) {
        (Some(digits), _) => u64::from_str_radix(digits, 16).ok()?,
        (None, Some(digits)) if !digits.is_empty() => u64::from_str_radix(digits, 8).ok()?,
        _ => digits.parse().ok()?,
    } as u32;
    let value = if unsigned { f64::from(bits) } else { f64::from(bits.cast_signed()) };
    Some(ExpressionKind::Integer(value, unsigned))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn literals_have_their_types_and_values() {
        let number = |text| match literal(text) {
            Some(ExpressionKind::Integer(value, unsigned)) => (value, if unsigned { "uint" } else { "int" }),
            Some(ExpressionKind::Floating(value, double)) => (value, if double { "double" } else { "float" }),
            other => panic!("{text}: {other:?}"),
        };
        assert_eq!(number("010"), (8.0, "int"));
        assert_eq!(number("0xFFFFFFFF"), (-1.0, "int"));
        assert_eq!(number("4294967295u"), (4_294_967_295.0, "uint"));
        assert_eq!(number("1e3"), (1000.0, "float"));
        assert_eq!(number(".5F"), (0.5, "float"));
        assert_eq!(number("0.1lf"), (0.1, "double"));
        assert_eq!(number("16777217.0"), (16_777_216.0, "float"));
        assert_eq!(number("1e40"), (f64::INFINITY, "float"));
        assert!(literal("08").is_none() && literal("1x").is_none());
    }
}
