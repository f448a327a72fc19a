//! The equation of an assignment as a view shows it: MathML, each term tied to its rubric line.

use crate::language::Text;

/// A sum of terms. Every string but the ids is MathML of our own, never a student's text.
#[derive(Clone, Debug)]
pub struct Equation {
    /// Where it stands, such as `lecture 6, slide 31`.
    pub source: Text,
    /// The symbol of the sum.
    pub total: &'static str,
    /// The summands, in order.
    pub terms: Vec<Term>,
    /// The definitions that the terms need.
    pub definitions: Vec<Definition>,
}

/// One summand.
#[derive(Clone, Debug)]
pub struct Term {
    /// Id of the rubric line that judges it.
    pub rubric: &'static str,
    /// Its symbol in the sum.
    pub symbol: &'static str,
    /// What the symbol stands for.
    pub value: &'static str,
}

/// `symbol = value`, with where it stands.
#[derive(Clone, Debug)]
pub struct Definition {
    /// The left-hand side.
    pub symbol: &'static str,
    /// The right-hand side.
    pub value: &'static str,
    /// Where it stands, such as `slide 21`.
    pub source: Text,
}

macro_rules! sub {
    ($base:literal, $index:literal) => {
        concat!("<msub><mi>", $base, "</mi><mtext>", $index, "</mtext></msub>")
    };
}

macro_rules! clamped_dot {
    ($a:literal, $b:literal) => {
        concat!(
            "<mrow><mi>max</mi><mo>(</mo><mi>",
            $a,
            "</mi><mo>·</mo><mi>",
            $b,
            "</mi><mo>,</mo><mn>0</mn><mo>)</mo></mrow>"
        )
    };
}

impl Equation {
    /// The illumination equation (lecture 6, slide 31) with the Blinn half vector (slide 21).
    pub fn illumination() -> Self {
        let slide =
            |number: u32| Text::new(format!("lecture 6, slide {number}"), format!("講義第 6 回 スライド {number}"));
        Self {
            source: slide(31),
            total: sub!("I", "tot"),
            terms: vec![
                Term {
                    rubric: "ambient",
                    symbol: sub!("I", "amb"),
                    value: concat!(sub!("K", "amb"), "<mo>⊗</mo>", sub!("L", "amb")),
                },
                Term {
                    rubric: "diffuse",
                    symbol: sub!("I", "diff"),
                    value: concat!(
                        clamped_dot!("N", "L"),
                        "<mspace width=\"0.25em\"/>",
                        sub!("K", "diff"),
                        "<mo>⊗</mo>",
                        sub!("L", "diff")
                    ),
                },
                Term {
                    rubric: "specular",
                    symbol: sub!("I", "spec"),
                    value: concat!(
                        "<msup>",
                        clamped_dot!("N", "H"),
                        sub!("K", "shi"),
                        "</msup><mspace width=\"0.25em\"/>",
                        sub!("K", "spec"),
                        "<mo>⊗</mo>",
                        sub!("L", "spec")
                    ),
                },
            ],
            definitions: vec![Definition {
                symbol: "<mi>H</mi>",
                value: "<mfrac><mrow><mi>L</mi><mo>+</mo><mi>V</mi></mrow><mrow><mo>|</mo><mi>L</mi>\
                        <mo>+</mo><mi>V</mi><mo>|</mo></mrow></mfrac>",
                source: slide(21),
            }],
        }
    }
}
