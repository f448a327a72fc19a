//! The known mistakes: what the equation becomes, what it costs, and what is said about it.

use crate::Text;
use crate::accepted::AcceptedAnswer;
use crate::interpreter::{FREE, Formula};

/// A mistake that students make, as one hypothesis about the equation.
#[derive(Clone, Debug)]
pub struct Mistake {
    /// Its name in reports; stable.
    pub id: String,
    /// The mistake in a few words, as a teacher's lists show it.
    pub title: Text,
    /// Fraction of a rubric line's points that is kept, for each line that the mistake touches.
    pub keeps: Vec<(String, f64)>,
    /// The ways in which it is written. Empty for a mistake that is not seen in the equation.
    pub forms: Vec<MistakeForm>,
    /// The ways in which it is written, each as a whole program; their numbers follow those of the forms.
    pub variants: Vec<AcceptedAnswer>,
    /// The number in the forms or variants that is not known beforehand.
    pub fit: Option<FreeParameter>,
    /// Whether the handed-out file itself has it, so that its own line may be named.
    pub handed_out: bool,
    /// Whether the folder says nothing of it, so that the words are those of any homework.
    pub is_general: bool,
    /// Whether it is what a negative base of a power means, also where a driver hides that the result is undefined.
    pub undefined_power: bool,
    /// Whether something is left out where a right value is used, so that the use is what is named.
    pub at_use: bool,
    /// What the text contains, parentheses and swizzles aside, if it is this mistake and not a number that equals it by chance:
    /// one of these.
    pub needs: Vec<String>,
    /// Constants that the statements no longer use if it is this mistake and not a number that equals it by chance.
    pub lacks: Vec<String>,
    /// What is seen in the picture.
    pub seen: Text,
    /// Which equation of the lecture it breaks.
    pub equation: Text,
    /// Where to look and what to try, to be completed with [`Text::fill`]: `{line}`, `{name}`, `{expected}`, `{found}`.
    pub look: Text,
    /// Texts in place of those where they would not be true of the student's file; the first that applies.
    pub instead: Vec<Alternative>,
}

/// What is said of a mistake.
#[derive(Clone, Copy, Debug)]
pub struct Texts<'a> {
    /// See [`Mistake::seen`].
    pub seen: &'a Text,
    /// See [`Mistake::equation`].
    pub equation: &'a Text,
    /// See [`Mistake::look`].
    pub look: &'a Text,
}

/// Texts for files of which the usual ones would not be true.
#[derive(Clone, Debug)]
pub struct Alternative {
    /// When it applies: where all of these hold.
    pub when: Vec<Condition>,
    /// In place of [`Mistake::seen`].
    pub seen: Option<Text>,
    /// In place of [`Mistake::equation`].
    pub equation: Option<Text>,
    /// In place of [`Mistake::look`].
    pub look: Option<Text>,
}

/// What is looked up in the student's file before something is said of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Condition {
    /// The mistake was found in one of these forms.
    Forms(Vec<usize>),
    /// None of these words stands in the statement that is named, or in the file where none is.
    Lacks(Vec<String>),
    /// The term is computed, and it is 0 everywhere.
    Zero,
    /// Nothing that the colour depends on stands for the term.
    Absent,
}

/// One way of writing a mistake: definitions of the equation, replaced.
#[derive(Clone, Debug)]
pub struct MistakeForm {
    /// What is replaced, in the equation's order.
    pub overrides: Vec<DefinitionOverride>,
    /// Whether the mistake's free parameter occurs in it.
    pub free: bool,
}

/// Another expression in place of a definition.
#[derive(Clone, Debug)]
pub struct DefinitionOverride {
    /// The definition's place in the equation.
    pub definition: usize,
    /// The expression as it is written.
    pub text: String,
    /// How it is computed.
    pub formula: Formula,
}

/// A number that is found from the samples.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeParameter {
    /// Its name in the forms or variants.
    pub name: String,
    /// The least value that it may have; above 0.
    pub from: f64,
    /// The greatest.
    pub to: f64,
    /// A value that a student may well have written.
    pub example: f64,
    /// Whether the colour at a place may rise and fall again while it grows; else it only rises or only falls.
    pub turns: bool,
    /// What it should be, where it stands for a constant of the handed-out file: that one's place among the constants.
    pub of: Option<usize>,
}

/// A mistake that was found, in the form in which it was found.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundMistake {
    /// The mistake's id.
    pub id: String,
    /// Which of its forms.
    pub form: usize,
    /// The value of the free parameter, if the form has one.
    pub parameter: Option<f64>,
}

impl Mistake {
    /// What is said where these conditions hold.
    pub fn texts(&self, holds: &dyn Fn(&Condition) -> bool) -> Texts<'_> {
        let applies = |alternative: &&Alternative| alternative.when.iter().all(holds);
        let other = self.instead.iter().find(applies);
        Texts {
            seen: other.and_then(|other| other.seen.as_ref()).unwrap_or(&self.seen),
            equation: other.and_then(|other| other.equation.as_ref()).unwrap_or(&self.equation),
            look: other.and_then(|other| other.look.as_ref()).unwrap_or(&self.look),
        }
    }

    /// The number by which it explains what is seen, where it has one; below 0 where a derived one subtracts it or turns all around.
    pub fn number(&self, found: &FoundMistake) -> Option<f64> {
        let written = self.forms.get(found.form).and_then(|form| form.overrides.first()).map(|own| own.text.as_str());
        let is_turned = written.and_then(|text| text.split_once(FREE)).is_some_and(|(before, behind)| {
            before.trim_end().ends_with('-') || before.starts_with("-(") && behind == ")"
        });
        found.parameter.map(|number| if is_turned { -number } else { number })
    }

    /// In how many ways it is written.
    pub fn ways(&self) -> usize {
        self.forms.len() + self.variants.len()
    }

    /// The program of a form with this number, if it is one.
    pub(crate) fn program(&self, form: usize) -> Option<&AcceptedAnswer> {
        self.variants.get(form.checked_sub(self.forms.len())?)
    }

    /// Fraction of the line's points that is kept; 1 for a line that the mistake does not touch.
    pub fn keeps(&self, line: &str) -> f64 {
        let kept = self.keeps.iter().find(|(l, _)| l == line);
        kept.map_or(1.0, |(_, fraction)| *fraction)
    }
}
