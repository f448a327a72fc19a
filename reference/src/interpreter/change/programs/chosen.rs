//! Slips of a program by what is asked of them.

use super::{PlacedSlip, ProgramSlip, SlipMark, Sought, found, slips_of};
use crate::interpreter::change::{FREE, Operator, written};
use crate::interpreter::outline::{self, Word};
use crate::interpreter::{Program, Refusal, Stage, parse, text};

/// What makes another value of the one that a variable has.
const COMPOUND: [&str; 4] = ["+=", "-=", "*=", "/="];

/// A number where a slip may have any.
const ANY: f64 = 0.371;

/// The programs with each of the slips that have a mark; where there is none, with those that leave out the same words of another text.
/// A number that the mark leaves open is any.
///
/// # Errors
/// The program is none.
pub fn slips_marked(source: &str, stage: Stage, mark: &SlipMark) -> Result<Vec<Program>, Refusal> {
    let free = mark.texts.1.as_ref().filter(|text| text.contains(FREE)).map(|_| ANY);
    let sought = Sought { is_part: &|_| true, operator: Some(mark.operator), free };
    let slips = slips_of(source, stage, &sought, |slips| {
        let is_there = slips.iter().any(|slip| slip.mark() == *mark);
        slips.retain(|slip| if is_there { slip.mark() == *mark } else { slip.mark().leaves_out_the_same(mark) });
    })?;
    Ok(slips.into_iter().map(|slip| slip.program).collect())
}

impl SlipMark {
    /// Whether what a variable holds is lost, which is read without the slip.
    pub(crate) fn writes_over(&self) -> bool {
        let (own, Some(instead)) = &self.texts else { return false };
        let is_compound = |text: &str| COMPOUND.iter().any(|operator| text.contains(operator));
        let reads = |text: &str| outline::words(text).iter().any(|word| Some(&word.text) == self.name.as_ref());
        is_compound(own) && !is_compound(instead) || reads(own) && !reads(instead)
    }

    fn leaves_out_the_same(&self, other: &Self) -> bool {
        let left_out = self.left_out();
        left_out.is_some() && self.operator == other.operator && self.name == other.name && left_out == other.left_out()
    }

    /// The words that go, some of them names, where others stay and none comes.
    fn left_out(&self) -> Option<Vec<String>> {
        // What stands beside a change decides where brackets are.
        let words = |text: &str| -> Vec<Word> {
            outline::words(text).into_iter().filter(|word| !matches!(word.text.as_str(), "(" | ")")).collect()
        };
        let (own, left) = (words(&self.texts.0), words(self.texts.1.as_deref()?));
        let before = own.iter().zip(&left).take_while(|(own, left)| own.text == left.text).count();
        let (own, left) = (&own[before..], &left[before..]);
        let gone = own.len().checked_sub(left.len())?;
        let ends_so = own[gone..].iter().zip(left).all(|(own, left)| own.text == left.text);
        let is_it = ends_so && before + left.len() > 0 && own[..gone].iter().any(|word| word.is_name);
        is_it.then(|| own[..gone].iter().map(|word| word.text.clone()).collect())
    }
}

/// The slips in `main` by which a variable is given what is written.
///
/// # Errors
/// The program is none.
pub fn slips_written(source: &str, (of, name): (Operator, &str), text: &str) -> Result<Vec<SlipMark>, Refusal> {
    let items = parse::parse(&text::preprocess(source)?.tokens)?;
    let is_it = |slip: &PlacedSlip| match slip {
        PlacedSlip::Expression(_, Some(given), change, _) => **given == *name && written(&change.expression) == text,
        _ => false,
    };
    let free = text.contains(FREE).then_some(ANY);
    let slips = found(&items, &Sought { is_part: &|function| function == "main", operator: Some(of), free });
    Ok(slips.iter().filter(|slip| is_it(slip)).map(PlacedSlip::mark).collect())
}

/// The slips of a program in those of its functions that `is_part` names, as far as they are programs. The plainer ones come first.
///
/// # Errors
/// The program is none.
pub fn program_slips(source: &str, stage: Stage, is_part: &dyn Fn(&str) -> bool) -> Result<Vec<ProgramSlip>, Refusal> {
    let sought = Sought { is_part, operator: None, free: None };
    slips_of(source, stage, &sought, |slips| slips.retain(|slip| !matches!(slip, PlacedSlip::Branch(..))))
}

/// Those in `main` by which certain variables are given another value.
///
/// # Errors
/// The program is none.
pub fn slips_of_variables(
    source: &str,
    stage: Stage,
    is_one: &dyn Fn(&str) -> bool,
) -> Result<Vec<ProgramSlip>, Refusal> {
    let sought = Sought { is_part: &|function| function == "main", operator: None, free: None };
    slips_of(source, stage, &sought, |slips| slips.retain(|slip| slip.parts().0.is_some_and(|name| is_one(name))))
}

/// The program without each of its parts: a statement, a branch, an operand, a function around a value.
///
/// # Errors
/// The program is none.
pub fn program_without_parts(source: &str, stage: Stage) -> Result<Vec<ProgramSlip>, Refusal> {
    let sought = Sought { is_part: &|_| true, operator: None, free: None };
    slips_of(source, stage, &sought, |slips| slips.retain(|slip| slip.operator() <= Operator::FallsThrough))
}

#[cfg(test)]
mod tests {
    use super::{Operator, SlipMark};

    #[test]
    fn what_writes_over_a_variable_no_longer_reads_it() {
        let writes_over = |own: &str, instead: &str| {
            let name = Some("colour".to_owned());
            let texts = (own.to_owned(), Some(instead.to_owned()));
            SlipMark { operator: Operator::OtherOperator, name, texts }.writes_over()
        };
        assert!(writes_over("colour += w * lamp.colour", "colour = w * lamp.colour"));
        assert!(writes_over("colour + glow", "glow"));
        assert!(!writes_over("colour += glow", "colour -= glow"), "it is still made of what was there");
        assert!(!writes_over("base + glow", "base - glow"), "it never was");
    }
}
