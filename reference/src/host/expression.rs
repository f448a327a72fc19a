//! A number as it is written: numbers, elements of what the program has beside, names of either, `+ - * /` and parentheses.

use std::collections::BTreeSet;

/// What a number is written as.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum HostExpression {
    Int(i32),
    Float(f64),
    /// An element of what the program has beside.
    Given(String),
    Negative(Box<HostExpression>),
    Of(char, Box<[HostExpression; 2]>),
}

impl HostExpression {
    /// The same in GLSL.
    pub fn shader(&self) -> String {
        match self {
            // The least number has no positive one.
            Self::Int(number) if *number < 0 => format!("({}.0)", i64::from(*number)),
            Self::Int(number) => format!("{number}.0"),
            Self::Float(number) => {
                let text = format!("{number:?}");
                if *number < 0.0 { format!("({text})") } else { text }
            }
            Self::Given(text) => format!("({text})"),
            Self::Negative(of) => format!("(-{})", of.shader()),
            Self::Of(sign, parts) => format!("({} {sign} {})", parts[0].shader(), parts[1].shader()),
        }
    }

    /// The numbers and the names in it.
    pub fn mention(&self, literals: &mut Vec<f64>, names: &mut BTreeSet<String>) {
        match self {
            Self::Int(number) => literals.push(f64::from(*number).abs()),
            Self::Float(number) => literals.push(number.abs()),
            Self::Given(text) => {
                let words = text.split(|c: char| c != '_' && !c.is_ascii_alphanumeric());
                names.extend(
                    words.filter(|word| word.starts_with(|c: char| c.is_ascii_alphabetic())).map(str::to_owned),
                );
            }
            Self::Negative(of) => of.mention(literals, names),
            Self::Of(_, parts) => parts.iter().for_each(|part| part.mention(literals, names)),
        }
    }

    /// Its value, where it is a number.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Int(number) => Some(f64::from(*number)),
            Self::Float(number) => Some(*number),
            _ => None,
        }
    }
}
