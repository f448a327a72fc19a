//! Within which features a mistake is: those of the lines without which nothing is left of the mistake.

use super::programs::FIRST;
use super::{Derived, definition, read};
use crate::accepted::{AcceptedAnswer, Computed};
use crate::feature::Feature;
use crate::fit::{TOLERANCE, agrees};
use crate::interpreter::{Program, SlipMark, Stage, slips_marked, slips_written};
use crate::mistake::FoundMistake;
use crate::pipeline::Pipeline;
use crate::probes::ProbeSet;
use std::sync::{Arc, PoisonError};

/// What of a mistake is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Shown {
    Colour,
    Position,
}

/// What a program with a slip shows.
enum Slipped {
    /// The program has no such slip.
    Gone,
    Shown(Vec<Computed>),
    /// It is no program, or has several such slips.
    Unknown,
}

/// A line of the rubric, and the program that lacks its feature.
type FeatureProgram<'a> = (usize, &'a AcceptedAnswer);

impl Derived {
    /// The line of the rubric without whose feature a mistake changes nothing, or is not there; of several the one whose feature goes by
    /// those of all others. Where there is none, the only two lines without whose features together that is so. None of these, or of
    /// several that stand beside each other, is an empty list.
    pub(super) fn lines_of(&self, found: &FoundMistake, of: Shown) -> Vec<usize> {
        if !self.assignment.is_told_by_features() {
            return Vec::new();
        }
        let key = (found.id.clone(), found.form, of);
        let mut known = self.within.lock().unwrap_or_else(PoisonError::into_inner);
        known.entry(key).or_insert_with(|| self.around(found, of).unwrap_or_default()).clone()
    }

    fn around(&self, found: &FoundMistake, of: Shown) -> Option<Vec<usize>> {
        let is_of_one_line = || definition(&found.id).is_some_and(|name| self.assignment.is_of_one_line(name));
        if of == Shown::Colour && is_of_one_line() {
            return None;
        }
        let (stage, mark) = self.slip(found)?;
        // What is counted by in the head of a loop is a matter of its turns.
        let counts = |line: &usize| self.assignment.loop_words(*line).any(|word| Some(&word) == mark.name.as_ref());
        if let Some(line) = (0..self.assignment.rubric.len()).find(counts) {
            return Some(vec![line]);
        }
        let (_, probes) = self.judging().part(FIRST);
        let right: Vec<String> = self.assignment.files.iter().map(|file| file.solution.text.clone()).collect();
        let shown = self.shown_by(&right, None, &probes)?;
        let Slipped::Shown(wrong) = self.slipped(&right, (stage, &mark), &probes) else { return None };
        // What does not show at these probes says nothing. What only moves something is of a line that moves something.
        let of = match of {
            Shown::Colour if is_same(&wrong, &shown, Shown::Colour) => Shown::Position,
            of => of,
        };
        if is_same(&wrong, &shown, of) {
            return None;
        }
        let is_nothing_left = |texts: &[String]| match self.slipped(texts, (stage, &mark), &probes) {
            Slipped::Gone => true,
            Slipped::Shown(wrong) => {
                self.shown_by(texts, None, &probes).is_some_and(|without| is_same(&wrong, &without, of))
            }
            Slipped::Unknown => false,
        };
        let features: Vec<FeatureProgram<'_>> = self.feature_programs(of).collect();
        let around: Vec<_> = features.iter().copied().filter(|(_, own)| is_nothing_left(&own.texts)).collect();
        if let Some(line) = self.innermost(&around, of, &probes) {
            return Some(vec![line]);
        }
        let pairs = features.iter().enumerate().flat_map(|(at, a)| features[..at].iter().map(move |b| (b, a)));
        let mut pairs = pairs.filter(|((_, a), (_, b))| {
            around.is_empty() && without_both(a, b).is_some_and(|texts| is_nothing_left(&texts))
        });
        let ((a, _), (b, _)) = pairs.next()?;
        pairs.next().is_none().then(|| vec![*a, *b])
    }

    /// The line whose feature goes by those of all others.
    fn innermost(&self, around: &[FeatureProgram<'_>], of: Shown, probes: &ProbeSet) -> Option<usize> {
        // A feature goes by another one where its text is gone with that, or makes no difference then.
        let goes_by = |inner: &AcceptedAnswer, outer: &AcceptedAnswer| match without_both(outer, inner) {
            None => !inner.replaced.is_empty(),
            Some(texts) => {
                let both = self.shown_by(&texts, None, probes);
                both.is_some_and(|both| is_same(&both, &self.assignment.computed_by(outer, probes), of))
            }
        };
        let is_innermost = |(line, own): &&FeatureProgram<'_>| {
            let mut others = around.iter().filter(|(other, _)| other != line);
            others.all(|(_, other)| goes_by(own, other) && !goes_by(other, own))
        };
        around.iter().find(is_innermost).map(|(line, _)| *line)
    }

    /// The lines that judge where something stands, or the others, with the programs that lack their features.
    fn feature_programs(&self, of: Shown) -> impl Iterator<Item = FeatureProgram<'_>> {
        let assignment = &self.assignment;
        let judges_position = assignment.rubric.iter().any(|line| assignment.judges_position(line));
        let lines = assignment.rubric.iter().zip(&assignment.features).enumerate();
        lines.filter_map(move |(number, (line, feature))| {
            let is_asked = match of {
                Shown::Colour => !assignment.judges_position(line),
                Shown::Position => !judges_position || assignment.judges_position(line),
            };
            match feature {
                Some(Feature::Program(program)) if is_asked => Some((number, program)),
                _ => None,
            }
        })
    }

    /// The slip that a mistake is, and the stage whose text it is in; none of one with a number of its own.
    fn slip(&self, found: &FoundMistake) -> Option<(Stage, SlipMark)> {
        let mistake = self.assignment.mistake(&found.id)?;
        if let Some(program) = mistake.program(found.form) {
            return program.slip.as_deref().cloned();
        }
        let form = mistake.forms.get(found.form).filter(|form| !form.free)?;
        let [changed] = &form.overrides[..] else { return None };
        let file = self.assignment.files.first()?;
        let (said, name) = read(&found.id)?;
        let written = slips_written(&file.solution.text, (said.of, name), &changed.text).ok()?;
        <[SlipMark; 1]>::try_from(written).ok().map(|[mark]| (file.stage, mark))
    }

    /// What the solution shows with other texts of its files, one of them with a slip.
    fn slipped(&self, texts: &[String], (stage, mark): (Stage, &SlipMark), probes: &ProbeSet) -> Slipped {
        let file = self.assignment.files.iter().position(|file| file.stage == stage);
        let Some(text) = file.and_then(|file| texts.get(file)) else { return Slipped::Unknown };
        let Ok(slips) = slips_marked(text, stage, mark) else { return Slipped::Unknown };
        match <[Program; 1]>::try_from(slips) {
            Ok([program]) => {
                self.shown_by(texts, Some((stage, program)), probes).map_or(Slipped::Unknown, Slipped::Shown)
            }
            Err(slips) if slips.is_empty() => Slipped::Gone,
            Err(_) => Slipped::Unknown,
        }
    }

    /// The same; `other`: a program in the place of one of the texts.
    fn shown_by(&self, texts: &[String], other: Option<(Stage, Program)>, probes: &ProbeSet) -> Option<Vec<Computed>> {
        let Pipeline { vertex, fragment, .. } = &self.assignment.pipeline;
        let mut stages = [Arc::clone(vertex), Arc::clone(fragment)];
        let is_replaced = |stage: Stage| other.as_ref().is_some_and(|(own, _)| *own == stage);
        for (file, text) in self.assignment.files.iter().zip(texts).filter(|(file, _)| !is_replaced(file.stage)) {
            stages[file.stage as usize] = Arc::new(Program::compile(text, file.stage).ok()?);
        }
        if let Some((stage, program)) = other {
            stages[stage as usize] = Arc::new(program);
        }
        let pipeline = Pipeline::link(&stages[0], &stages[1], None).ok()?;
        Some(self.assignment.computed_by(&AcceptedAnswer::new("", pipeline), probes))
    }
}

/// The texts of the solution without two features; none where the text of the second is gone with the first.
fn without_both(first: &AcceptedAnswer, second: &AcceptedAnswer) -> Option<Vec<String>> {
    let mut texts = first.texts.clone();
    for [own, instead] in &second.replaced {
        let text = texts.iter_mut().find(|text| text.contains(own.as_str()))?;
        *text = text.replacen(own.as_str(), instead, 1);
    }
    (!second.replaced.is_empty()).then_some(texts)
}

fn is_same(a: &[Computed], b: &[Computed], of: Shown) -> bool {
    a.iter().zip(b).all(|((colour, position), (other, there))| match of {
        Shown::Colour => agrees(*colour, *other, TOLERANCE),
        Shown::Position => (*position - *there).abs().max_element() <= TOLERANCE * there.abs().max_element().max(1.0),
    })
}
