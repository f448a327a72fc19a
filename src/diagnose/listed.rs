//! Which of the numbers are wrong that a program lists, where they are all that is read of it.
//!
//! Nothing has to be guessed from what such a program draws: its numbers are known one by one. A matrix draws the same with any
//! positive factor, so they are compared with the right ones times the factor with which most of them are right.

use super::columns::is_number;
use super::trials::{FUEL_OF_TRACE, StageChanges, chosen, place};
use super::{Evidence, Text};
use reference::assignment::RubricItem;
use reference::fit::TermJudgement;
use reference::interpreter::Stage;
use reference::interpreter::trace::What;
use reference::mistake::FoundMistake;
use reference::traced::Bench;

/// So many numbers are named; where more are wrong, it is the whole matrix.
const MOST_NAMED: usize = 6;

/// A number that is not the right one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct WrongNumber {
    /// Its definition in the homework's shader.
    pub name: String,
    /// Its place in the array, from 0.
    pub place: usize,
    /// Where it is written.
    pub line: u32,
}

/// The wrong ones.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct WrongNumbers {
    pub wrong: Vec<WrongNumber>,
}

/// A number at all places that are looked at.
struct TracedNumber {
    name: String,
    line: u32,
    own: Vec<f64>,
    right: Vec<f64>,
}

impl WrongNumbers {
    /// Those of an answer. `None` where it is a shader, or cannot be run.
    pub fn of(evidence: &Evidence<'_>) -> Option<Self> {
        let assignment = evidence.assignment;
        let array = &assignment.files.iter().find_map(|file| file.program.as_ref())?.array;
        let program = evidence.traced?;
        let places: Vec<_> = chosen(evidence).iter().map(|at| place(evidence, *at)).collect();
        let mut bench = Bench::new(assignment, program, &places, false, FUEL_OF_TRACE)?;
        let (_, [trace, _]) = bench.trace(&StageChanges::default())?;
        let (trace, sites) = (trace?, program.stage(Stage::Vertex).sites());
        let variant = assignment.equation.right();
        let right: Vec<_> = places.iter().map(|at| variant.evaluate(at.uniforms, &at.probe.attributes)).collect();
        let number = |at: usize| {
            let name = format!("{}{at}", array.name);
            let is_it = |site: usize| matches!(&sites[site].what, What::Assign { name: own, .. } if *own == name);
            let event = trace.events.iter().find(|event| is_it(event.site))?;
            let right = right.iter().map(|one| Some(*one.get(&name)?.numbers().first()?)).collect::<Option<_>>()?;
            Some(TracedNumber { line: sites[event.site].line, own: event.values.first()?.clone(), right, name })
        };
        let numbers: Vec<TracedNumber> = (0..array.count).map(number).collect::<Option<_>>()?;
        let is_wrong = wrong(&numbers);
        let named = numbers.into_iter().enumerate().filter(|(place, _)| is_wrong[*place]);
        let wrong = named.map(|(place, number)| WrongNumber { name: number.name, place, line: number.line });
        Some(Self { wrong: wrong.collect() })
    }

    /// Whether any number is wrong.
    pub fn is_wrong(&self) -> bool {
        !self.wrong.is_empty()
    }

    /// The lines of the rubric whose numbers are all right, and the others.
    pub fn terms(&self, evidence: &Evidence<'_>) -> Vec<TermJudgement> {
        let judged = evidence.samples.len();
        let term = |line: &RubricItem| match self.wrong.iter().any(|wrong| line.numbers.contains(&wrong.name)) {
            true => TermJudgement { matched: 0, ..TermJudgement::right(&line.id, judged) },
            false => TermJudgement::right(&line.id, judged),
        };
        evidence.assignment.rubric.iter().filter(|line| !line.numbers.is_empty()).map(term).collect()
    }

    /// Those that a mistake is about; all where it is about the whole.
    pub fn of_mistake(&self, evidence: &Evidence<'_>, found: &FoundMistake) -> Self {
        let assignment = evidence.assignment;
        let form = assignment.mistake(&found.id).and_then(|mistake| mistake.forms.get(found.form));
        let definitions = assignment.equation.definitions();
        let names: Vec<&str> =
            form.iter().flat_map(|form| &form.overrides).map(|own| definitions[own.definition].name.as_str()).collect();
        let own: Vec<_> = self.wrong.iter().filter(|wrong| names.contains(&wrong.name.as_str())).cloned().collect();
        if own.is_empty() { self.clone() } else { Self { wrong: own } }
    }

    /// Those that a line of the rubric is about; all where it is about none.
    pub fn of_line(&self, line: &RubricItem) -> Self {
        let own: Vec<_> = self.wrong.iter().filter(|wrong| line.numbers.contains(&wrong.name)).cloned().collect();
        if own.is_empty() { self.clone() } else { Self { wrong: own } }
    }

    /// The first line with a wrong number.
    pub fn line(&self) -> Option<u32> {
        self.wrong.iter().map(|wrong| wrong.line).min()
    }

    /// Which numbers they are, where they are few.
    pub fn sentence(&self) -> Option<Text> {
        if self.wrong.is_empty() || self.wrong.len() > MOST_NAMED {
            return None;
        }
        let of = |said: &dyn Fn(&WrongNumber) -> String, between: &str| {
            self.wrong.iter().map(said).collect::<Vec<_>>().join(between)
        };
        let en = of(&|wrong| format!("`[{}]` (line {})", wrong.place, wrong.line), ", ");
        let ja = of(&|wrong| format!("`[{}]` ({} 行目)", wrong.place, wrong.line), "、");
        let en = match self.wrong.len() {
            1 => format!("Counted from 0, number {en} of the array is not that of the right matrix"),
            _ => format!("Counted from 0, the numbers {en} of the array are not those of the right matrix"),
        };
        Some(Text::new(
            format!("{en} (a positive factor of the whole aside)."),
            format!("配列を 0 から数えて {ja} の値が、正しい行列のものと違います (全体に掛かる正の数は問いません)。"),
        ))
    }
}

/// Which numbers are wrong: with the factor that makes most of them right everywhere, of several the one that is the same everywhere.
fn wrong(numbers: &[TracedNumber]) -> Vec<bool> {
    let places = numbers.first().map_or(0, |number| number.own.len());
    let mut best: Option<(usize, bool, Vec<bool>)> = None;
    let by_number = numbers
        .iter()
        .map(|number| -> Vec<f64> { number.own.iter().zip(&number.right).map(|(own, right)| own / right).collect() });
    for factor in std::iter::once(vec![1.0; places]).chain(by_number) {
        if !factor.iter().all(|factor| factor.is_finite() && *factor > 0.0) {
            continue;
        }
        let is_right = |number: &TracedNumber| {
            let mut pairs = number.own.iter().zip(&number.right).zip(&factor);
            pairs.all(|((own, right), factor)| is_number(*own / factor, *right))
        };
        let is_wrong: Vec<bool> = numbers.iter().map(|number| !is_right(number)).collect();
        let count = is_wrong.iter().filter(|wrong| **wrong).count();
        let varies = factor.iter().any(|other| !is_number(*other, factor[0]));
        if best.as_ref().is_none_or(|(least, known, _)| (count, varies) < (*least, *known)) {
            best = Some((count, varies, is_wrong));
        }
    }
    best.map_or_else(|| vec![true; numbers.len()], |(.., is_wrong)| is_wrong)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers of a matrix for lights at heights 4 and 5, at x = 1 and 2.
    fn numbers(own: [[f64; 2]; 4]) -> Vec<TracedNumber> {
        let right = [[4.0, 5.0], [-1.0, -2.0], [-1.0, -1.0], [4.0, 5.0]];
        let number = |(own, right): ([f64; 2], [f64; 2])| TracedNumber {
            name: String::new(),
            line: 1,
            own: own.to_vec(),
            right: right.to_vec(),
        };
        own.into_iter().zip(right).map(number).collect()
    }

    #[test]
    fn a_common_factor_is_right_and_a_single_number_is_named() {
        // Divided by the height.
        assert_eq!(wrong(&numbers([[1.0, 1.0], [-0.25, -0.4], [-0.25, -0.2], [1.0, 1.0]])), [false; 4]);
        // Twice as large, and the second one with another sign.
        assert_eq!(wrong(&numbers([[8.0, 10.0], [2.0, 4.0], [-2.0, -2.0], [8.0, 10.0]])), [false, true, false, false]);
        // Half of them are right as they stand, half are right by a factor that depends on the light: the former are right.
        assert_eq!(wrong(&numbers([[1.0, 1.0], [-1.0, -2.0], [-1.0, -1.0], [1.0, 1.0]])), [true, false, false, true]);
        // A negative factor is none.
        assert_eq!(wrong(&numbers([[-4.0, -5.0], [1.0, 2.0], [1.0, 1.0], [-4.0, -5.0]])), [true; 4]);
    }
}
