//! Within which features a mistake is: those of the lines without which nothing is left of the mistake.

use super::feature_text::stands_in;
use super::{Derived, FIRST, RESULT, definition, read};
use crate::accepted::{AcceptedAnswer, Computed};
use crate::assignment::HandedIn;
use crate::feature::Feature;
use crate::fit::{TOLERANCE, agrees};
use crate::interpreter::{Program, SlipMark, Stage, outline, slips_marked, slips_written};
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

/// What is left of a slip without a feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Left {
    /// It stands in the text that is gone.
    Gone,
    /// The text that is gone stands in what it changes.
    Within,
    /// It changes nothing that is seen.
    NoDifference,
    Something,
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
        let (stage, mark) = self.slip(found)?;
        // The only line that is about the variable, which is about all of it.
        let name = definition(&found.id).filter(|name| *name != RESULT).or(mark.name.as_deref());
        let name = name.filter(|name| of == Shown::Colour && self.assignment.is_of_one_line(name));
        let owner = name.and_then(|name| self.assignment.only_line_about(name));
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
        // A line that no feature tells is told by what it is about.
        if let Some(owner) = owner.filter(|owner| self.assignment.features[*owner].is_none()) {
            return Some(vec![owner]);
        }
        let left = |texts: &[String], feature: &AcceptedAnswer| match self.slipped(texts, (stage, &mark), &probes) {
            Slipped::Gone if stands_in(&mark.texts.0, feature) => Left::Gone,
            Slipped::Gone => Left::Within,
            Slipped::Shown(wrong)
                if self.shown_by(texts, None, &probes).is_some_and(|own| is_same(&wrong, &own, of)) =>
            {
                Left::NoDifference
            }
            Slipped::Shown(_) | Slipped::Unknown => Left::Something,
        };
        let is_seen = |own: &AcceptedAnswer| !is_same(&self.assignment.computed_by(own, &probes), &shown, of);
        let features: Vec<FeatureProgram<'_>> = self.feature_programs(of).filter(|(_, own)| is_seen(own)).collect();
        // What a slip writes over is lost with it.
        let is_lost = |(_, own): &&FeatureProgram<'_>| match self.slipped(&own.texts, (stage, &mark), &probes) {
            Slipped::Shown(without) => is_same(&without, &wrong, of),
            Slipped::Gone | Slipped::Unknown => false,
        };
        let lost: Vec<usize> = match mark.writes_over() && owner.is_none() {
            true => features.iter().filter(is_lost).map(|(line, _)| *line).collect(),
            false => Vec::new(),
        };
        if !lost.is_empty() {
            return Some(lost);
        }
        let judged: Vec<(FeatureProgram<'_>, Left)> =
            features.iter().map(|own| (*own, left(&own.1.texts, own.1))).collect();
        let left_with = |which: Left| -> Vec<FeatureProgram<'_>> {
            judged.iter().filter(|(_, left)| *left == which).map(|(own, _)| *own).collect()
        };
        // What stands in the text of a feature is of that, whatever else happens to hide it.
        let mut around = left_with(Left::Gone);
        if around.is_empty() {
            around = left_with(Left::NoDifference);
        }
        // Another line may only be within that.
        if owner.is_some_and(|owner| !around.iter().any(|(line, _)| *line == owner)) {
            return None;
        }
        if let Some(line) = self.innermost(&around, of, &probes) {
            return Some(vec![line]);
        }
        if !around.is_empty() {
            return None;
        }
        // What lines are about is theirs, whatever of it is left without the features of others.
        let about = if of == Shown::Colour { self.lines_about(found) } else { Vec::new() };
        let is_theirs = |line: usize| about.is_empty() || about.contains(&self.assignment.rubric[line].id.as_str());
        let pairs = judged.iter().enumerate().flat_map(|(at, a)| judged[..at].iter().map(move |b| (b, a)));
        let is_nothing_left = |(a, left_of_a): &(FeatureProgram<'_>, Left),
                               (b, left_of_b): &(FeatureProgram<'_>, Left)| {
            let without_both = || self.without_both(a.1, b.1);
            [*left_of_a, *left_of_b] == [Left::Within; 2]
                || without_both().is_some_and(|texts| left(&texts, a.1) == Left::NoDifference)
        };
        let mut pairs = pairs.filter(|(a, b)| is_theirs(a.0.0) && is_theirs(b.0.0) && is_nothing_left(a, b));
        let Some((((a, _), _), ((b, _), _))) = pairs.next() else { return self.only_about(found, &mark, &features) };
        pairs.next().is_none().then(|| vec![*a, *b])
    }

    /// The only line that is about what a mistake is in, and in the text of whose feature its slip stands.
    fn only_about(&self, found: &FoundMistake, mark: &SlipMark, features: &[FeatureProgram<'_>]) -> Option<Vec<usize>> {
        let name = definition(&found.id)?;
        let is_about =
            |line: usize| self.assignment.lines_about(name).any(|own| own.id == self.assignment.rubric[line].id);
        let mut own = features.iter().filter(|(line, own)| is_about(*line) && stands_in(&mark.texts.0, own));
        let (line, _) = own.next()?;
        own.next().is_none().then(|| vec![*line])
    }

    /// The line whose feature goes by those of all others.
    fn innermost(&self, around: &[FeatureProgram<'_>], of: Shown, probes: &ProbeSet) -> Option<usize> {
        // A feature goes by another one where its text is gone with that, or makes no difference then.
        let goes_by = |inner: &AcceptedAnswer, outer: &AcceptedAnswer| match self.without_both(outer, inner) {
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

    /// The slip that a mistake is, and the stage whose text it is in.
    fn slip(&self, found: &FoundMistake) -> Option<(Stage, SlipMark)> {
        let mistake = self.assignment.mistake(&found.id)?;
        if let Some(program) = mistake.program(found.form) {
            return program.slip.as_deref().cloned();
        }
        let form = mistake.forms.get(found.form)?;
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

    /// The texts of the solution without two features; `None` where the text of the second is gone with the first.
    fn without_both(&self, first: &AcceptedAnswer, second: &AcceptedAnswer) -> Option<Vec<String>> {
        let mut texts = first.texts.clone();
        for [own, instead] in &second.replaced {
            let Some([_, without_first]) = first.replaced.iter().find(|[other, _]| other == own) else {
                let text = texts.iter_mut().find(|text| text.contains(own.as_str()))?;
                *text = text.replacen(own.as_str(), instead, 1);
                continue;
            };
            // Both stand in one text.
            let both = left_of_both(own, [without_first, instead]).filter(|_| first.replaced.len() == 1)?;
            let place = |(file, own_file): (usize, &HandedIn)| Some((file, own_file.solution.text.find(own.as_str())?));
            let (file, start) = self.assignment.files.iter().enumerate().find_map(place)?;
            texts[file].replace_range(start..start + without_first.len(), &both);
        }
        (!second.replaced.is_empty()).then_some(texts)
    }
}

fn is_same(a: &[Computed], b: &[Computed], of: Shown) -> bool {
    a.iter().zip(b).all(|((colour, position), (other, there))| match of {
        Shown::Colour => agrees(*colour, *other, TOLERANCE),
        Shown::Position => (*position - *there).abs().max_element() <= TOLERANCE * there.abs().max_element().max(1.0),
    })
}

/// What is left of a text that two others are parts of: what is in both, or nothing of its value.
fn left_of_both(text: &str, parts: [&str; 2]) -> Option<String> {
    let words = |text| -> Vec<String> { outline::words(text).into_iter().map(|word| word.text).collect() };
    let all = words(text);
    let [first, second] = parts.map(|part| {
        let part = words(part);
        let mut next = part.iter().peekable();
        let is_kept: Vec<bool> = all.iter().map(|word| next.next_if_eq(&word).is_some()).collect();
        next.peek().is_none().then_some(is_kept)
    });
    let is_kept = first?.into_iter().zip(second?).map(|(first, second)| first && second);
    let left: Vec<&str> = all.iter().zip(is_kept).filter(|(_, is)| *is).map(|(word, _)| word.as_str()).collect();
    Some(if left.is_empty() { format!("0.0 * ({text})") } else { left.join(" ") })
}

#[cfg(test)]
mod tests {
    use super::left_of_both;

    #[test]
    fn what_two_parts_have_of_a_text_is_left() {
        let left = |text, parts| left_of_both(text, parts);
        assert_eq!(left("base * (ambient + lamp)", ["(ambient + lamp)", "base * ambient"]).as_deref(), Some("ambient"));
        assert_eq!(left("a*b + c", ["c", "a * b"]).as_deref(), Some("0.0 * (a*b + c)"));
        assert_eq!(left("a + b", ["a", "vec3(0.0)"]), None, "that is no part of it");
    }
}
