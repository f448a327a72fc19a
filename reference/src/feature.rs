//! What a line of the rubric judges, known by the solution without it.

use crate::Assignment;
use crate::accepted::{AcceptedAnswer, Computed};
use crate::assignment::RubricItem;
use crate::equation::Reads;
use crate::interpreter::Stage;
use crate::interpreter::outline::{self, Word};
use crate::mistake::MistakeForm;
use crate::probes::ProbeSet;
use crate::traced::TracedProgram;
use std::ops::{Range, RangeInclusive};

/// The solution without what a line judges.
#[derive(Clone, Debug)]
pub enum Feature {
    /// Its equation with a definition that is 0.
    Term(MistakeForm),
    /// A program of its own.
    Program(AcceptedAnswer),
}

/// The solution with the value of a line's feature, or with what is there instead of it.
#[derive(Debug)]
pub struct FeatureValue {
    /// The program.
    pub program: TracedProgram,
    /// The stage that the value is computed in.
    pub stage: Stage,
    /// Where it is computed.
    pub site: usize,
    /// Where anything is computed that stands in the text of the feature.
    pub within: Vec<usize>,
}

impl Assignment {
    /// The value that is missing in the solution without what a line of the rubric judges, and what is there instead: the solution
    /// with the one and with the other. `None` where what is replaced is no value by itself.
    pub fn feature_values(&self, line: usize) -> Option<[FeatureValue; 2]> {
        let Some(Feature::Program(program)) = self.features.get(line)? else { return None };
        let [[text, instead]] = program.replaced.as_slice() else { return None };
        let (value, instead) = operand(text, instead);
        Some([self.with_value(text, value, value)?, self.with_value(text, value, instead)?])
    }

    /// Whether a line judges a value by itself, and not a way in which all is drawn.
    pub fn judges_a_value(&self, line: usize) -> bool {
        match self.features.get(line) {
            Some(Some(Feature::Program(program))) => program.replaced.len() == 1,
            _ => true,
        }
    }

    /// Whether it is known what the solution lacks without what a line judges.
    pub fn has_feature(&self, line: usize) -> bool {
        self.features.get(line).is_some_and(Option::is_some)
    }

    /// Whether a line judges how often a loop goes round, by what stands in its head.
    pub fn judges_turns(&self, line: usize) -> bool {
        self.loop_words(line).next().is_some()
    }

    /// The words in the head of a loop that are others without what a line judges.
    pub(crate) fn loop_words(&self, line: usize) -> impl Iterator<Item = String> {
        let replaced = match self.features.get(line) {
            Some(Some(Feature::Program(program))) => program.replaced.as_slice(),
            _ => &[],
        };
        let texts = self.files.iter().map(|file| file.solution.text.as_str());
        let words_of = |text: &str| -> Vec<String> {
            let ranges = replaced.iter().filter_map(|[own, _]| Some((text.find(own.as_str())?, own.len())));
            let ranges: Vec<Range<usize>> = ranges.map(|(start, length)| start..start + length).collect();
            let is_replaced = |word: &&Word| ranges.iter().any(|range| range.contains(&word.range.start));
            let statements = outline::functions(text).into_iter().flat_map(|function| function.statements);
            let heads = statements.flat_map(|statement| outline::loop_heads(&statement.under));
            heads.filter(|word| is_replaced(&word)).map(|word| word.text).collect()
        };
        texts.filter(|_| !replaced.is_empty()).flat_map(words_of).collect::<Vec<_>>().into_iter()
    }

    /// Whether a line judges what is left of the solution without the features of the others.
    pub fn judges_the_rest(&self, line: &RubricItem) -> bool {
        let own = self.rubric.iter().position(|own| own.id == line.id);
        let has_none = own.and_then(|own| self.features.get(own)).is_some_and(Option::is_none);
        has_none && !self.judges_position(line) && self.features.iter().any(Option::is_some)
    }

    /// Whether a line judges all that is seen while others judge definitions, such as terms: then a mistake changes what it judges
    /// wherever it stands, which says nothing.
    pub fn is_beside_terms(&self, line: &RubricItem) -> bool {
        let colour = &self.equation.definitions[self.equation.colour].name;
        let judges_a_term = |other: &RubricItem| other.judges != *colour && !self.judges_position(other);
        line.judges == *colour && self.rubric.iter().any(judges_a_term)
    }

    /// Whether what lines judge is known by the solution without it, and not by definitions.
    pub fn is_told_by_features(&self) -> bool {
        self.equation.reads() == Reads::Outputs || self.has_features_alone()
    }

    /// Whether what lines judge is said by what the solution lacks without it. Where a region shows a definition by itself, its values
    /// tell more.
    pub(crate) fn has_features_alone(&self) -> bool {
        let colour = &self.equation.definitions[self.equation.colour].name;
        let lines = || self.rubric.iter().zip(&self.features).filter(|(line, _)| !self.judges_position(line));
        lines().any(|(_, feature)| matches!(feature, Some(Feature::Program(_))))
            && lines().all(|(line, feature)| feature.is_some() || line.judges == *colour)
    }

    /// The solution with something in the place of a value within a text that stands in it.
    fn with_value(&self, around: &str, value: &str, instead: &str) -> Option<FeatureValue> {
        let file = self.files.iter().position(|file| file.solution.text.contains(around))?;
        let mut texts: Vec<(Stage, String)> =
            self.files.iter().map(|file| (file.stage, file.solution.text.clone())).collect();
        let (stage, text) = &mut texts[file];
        let stage = *stage;
        // On lines of their own the text and the value are told from all else.
        let (before, behind) = text.split_once(around)?;
        let (head, tail) = around.split_once(value)?;
        let line_after = |text: &str| text.matches('\n').count() as u32 + 1;
        let before = format!("{before}\n");
        let to_value = format!("{before}{head}\n");
        let to_end = format!("{to_value}{instead}\n{tail}");
        let (first, own, last) = (line_after(&before), line_after(&to_value), line_after(&to_end));
        *text = format!("{to_end}\n{behind}");
        let texts: Vec<(Stage, &str)> = texts.iter().map(|(stage, text)| (*stage, text.as_str())).collect();
        let program = TracedProgram::new(self, &texts).ok().filter(|_| !instead.contains('\n'))?;
        let sites = program.stage(stage).sites();
        let there = |lines: RangeInclusive<u32>| -> Vec<usize> {
            (0..sites.len()).filter(|at| lines.contains(&sites[*at].line)).collect()
        };
        let of_value = there(own..=own);
        let is_whole = |at: &&usize| !of_value.iter().any(|site| sites[*site].operands.contains(at));
        let whole: Vec<usize> = of_value.iter().filter(is_whole).copied().collect();
        let [site] = whole[..] else { return None };
        let within = there(first..=last);
        Some(FeatureValue { program, stage, site, within })
    }

    /// The colour and the position that the solution without a feature computes at each probe.
    pub(crate) fn computed_without(&self, feature: &Feature, probes: &ProbeSet) -> Vec<Computed> {
        let form = match feature {
            Feature::Program(program) => return self.computed_by(program, probes),
            Feature::Term(form) => form,
        };
        let variant = self.equation.right().with(form, f64::NAN);
        let computed = |probe| {
            let outcome = variant.evaluate(probes.uniforms(probe), &probe.attributes);
            (outcome.colour(), outcome.position())
        };
        probes.iter().map(computed).collect()
    }
}

/// The value that a text stands for, and what is there instead of it. Of an operator with an operand that are left out, that is the
/// operand, and what makes no difference to the other one; of an assignment what is assigned, and what the variable has.
fn operand<'t>(text: &'t str, instead: &'t str) -> (&'t str, &'t str) {
    let (text, instead) = (text.trim(), instead.trim());
    if let (Some((to, value)), Some((other, instead))) = (assigned(text), assigned(instead))
        && to == other
    {
        return (value, instead);
    }
    if !matches!(instead, "" | ";") {
        return (text, instead);
    }
    let of = |signs: [char; 2]| text.strip_prefix(signs).or_else(|| text.strip_suffix(signs)).map(str::trim);
    match (assigned(text), of(['+', '-']), of(['*', '/'])) {
        (Some((to, value)), ..) if to.ends_with(['+', '-']) => (value, "0.0"),
        (Some((to, value)), ..) if to.ends_with(['*', '/']) => (value, "1.0"),
        (Some((to, value)), ..) => (value, to),
        (_, Some(addend), _) => (addend, "0.0"),
        (_, _, Some(factor)) => (factor, "1.0"),
        _ => (text, instead),
    }
}

/// What a statement assigns to, with the operator before the `=`, and what it assigns.
fn assigned(text: &str) -> Option<(&str, &str)> {
    let statement = text.strip_suffix(';').filter(|statement| !statement.contains([';', '{', '}']))?;
    let (to, value) = statement.split_once('=').filter(|(_, value)| !value.starts_with('='))?;
    (!to.ends_with(['<', '>', '!', '(']) && !to.contains('(')).then_some((to.trim(), value.trim()))
}
