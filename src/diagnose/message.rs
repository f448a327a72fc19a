//! What a line of the rubric says: what is seen, which equation it breaks, where to look.
//!
//! A message is said only where it is true of the student's text: what it presupposes is looked up first ([`Facts`]).

mod blanks;
mod kept;

use super::cause::{FEW_PIXELS, NEARLY_RIGHT, PART_ABSENT, PART_MISSING, PART_SCALED};
use super::constants::ChangedConstant;
use super::inside::{self, Finding};
use super::listed::WrongNumbers;
use super::locate::{self, Located, TracedProbes, Words};
use super::{Cause, Evidence, Hints};
use crate::language::Text;
use crate::report::UNEXPLAINED;
use blanks::Blanks;
use kept::KeptLines;
use reference::assignment::RubricItem;
use reference::mistake::{FoundMistake, Mistake};

/// A message and the line of the student's file that it speaks of.
pub(super) struct Told {
    pub text: Text,
    pub line: Option<u32>,
    /// The file of that line, where there are several.
    pub file: Option<String>,
}

/// The message for a line of the rubric that these mistakes cost points.
pub(super) fn tell(
    evidence: &Evidence<'_>,
    facts: &Facts,
    line: &RubricItem,
    cause: &Cause,
    culprits: &[&str],
) -> Told {
    let mut told: Vec<Told> = Vec::new();
    for mistake in culprits.iter().filter_map(|id| cause.mistake(evidence.assignment, id)) {
        let one = of_mistake(evidence, facts, line, cause, mistake);
        // Two mistakes in one place may be told in the same words.
        if told.iter().all(|known| known.text != one.text) {
            told.push(one);
        }
    }
    if told.is_empty() {
        let text = facts.kept.of(evidence, cause, line);
        return Told { text, line: None, file: None };
    }
    let join = |language: fn(&Text) -> &String, space| {
        told.iter().map(|told| language(&told.text).as_str()).collect::<Vec<_>>().join(space)
    };
    Told {
        text: Text::new(join(|text| &text.en, " "), join(|text| &text.ja, "")),
        line: told.iter().find_map(|told| told.line),
        file: told.iter().find(|told| told.line.is_some()).and_then(|told| told.file.clone()),
    }
}

fn of_mistake(evidence: &Evidence<'_>, facts: &Facts, line: &RubricItem, cause: &Cause, mistake: &Mistake) -> Told {
    let mut blanks = Blanks::of(evidence, facts, line, cause, mistake);
    blanks.values.extend(facts.names.iter().map(|(name, value)| (name.as_str(), value.clone())));
    let values: Vec<(&str, &str)> = blanks.values.iter().map(|(name, value)| (*name, value.as_str())).collect();
    let situation = blanks.situation(evidence, cause, mistake);
    let texts = mistake.texts(&situation);
    let mut parts = vec![texts.seen];
    if evidence.hints >= Hints::Gentle {
        parts.push(texts.equation);
    }
    let is_full = evidence.hints >= Hints::Full;
    // What is known of the very place says more than advice for any file.
    let sentence = blanks.finding.filter(|_| is_full && is_general(&mistake.id));
    let sentence = sentence.map(|finding| finding.sentence(evidence.assignment));
    let sentence = sentence.or_else(|| blanks.overwritten().filter(|_| is_full));
    // The sentence has a place of its own.
    let worst = blanks.worst.filter(|_| sentence.is_none());
    if is_full && sentence.is_none() {
        parts.push(texts.look);
    }
    let mut filled: Vec<reference::Text> = parts.iter().map(|part| part.fill(&values)).collect();
    let numbers = facts.listed(&mistake.id, line).filter(|_| is_full).and_then(|listed| listed.sentence());
    filled.extend(sentence.into_iter().chain(numbers).map(|text| reference::Text { en: text.en, ja: text.ja }));
    let join = |language: fn(&reference::Text) -> &String, space| {
        filled.iter().map(|part| language(part).as_str()).collect::<Vec<_>>().join(space)
    };
    let mut text = Text::new(join(|text| &text.en, " "), join(|text| &text.ja, ""));
    let regions = &evidence.assignment.regions;
    if let Some(place) = worst.and_then(|worst| Some(&regions.get(worst.region?)?.seen)) {
        text.en = format!("{} ({}.)", text.en, place.en);
        text.ja = format!("{}({})", text.ja, place.ja);
    }
    if let (Some(line), Some(file)) = (blanks.line, &blanks.file) {
        text = with_file(&text, line, file);
    }
    Told { text, line: is_full.then_some(blanks.line).flatten(), file: blanks.file.clone() }
}

/// A text that says of which file a line is, where it names it first.
fn with_file(text: &Text, line: u32, file: &str) -> Text {
    let name = format!("{line}");
    let is_whole = |rest: &str| !rest.starts_with(|next: char| next.is_ascii_digit());
    let place = |text: &str, before: &str, behind: &str| {
        let word = format!("{before}{name}{behind}");
        text.match_indices(&word)
            .map(|(at, _)| [at, at + word.len()])
            .find(|[at, end]| is_whole(&text[*end..]) && !text[..*at].ends_with(|last: char| last.is_ascii_digit()))
    };
    let en = place(&text.en, "ine ", "").map(|[_, end]| format!("{} of `{file}`{}", &text.en[..end], &text.en[end..]));
    let ja = place(&text.ja, "", " 行目").map(|[at, _]| format!("{}`{file}` の {}", &text.ja[..at], &text.ja[at..]));
    Text::new(en.unwrap_or_else(|| text.en.clone()), ja.unwrap_or_else(|| text.ja.clone()))
}

/// Whether a mistake is only known by what is seen, so that its texts say nothing of the place.
fn is_general(id: &str) -> bool {
    [UNEXPLAINED, PART_MISSING, PART_ABSENT, PART_SCALED, NEARLY_RIGHT, FEW_PIXELS].contains(&id)
}

/// What the messages may say of the student's text, because it was looked up there.
#[derive(Debug, Default)]
pub(super) struct Facts {
    /// Where each mistake stands that was found, by id.
    places: Vec<(String, Option<Located>)>,
    /// What stands for a name in the texts: the student's own for a definition, or the lecture's symbol; and the
    /// names of the handed-out file that the student's still has.
    names: Vec<(String, String)>,
    /// Where in the text the mistakes stand that nobody wrote down.
    findings: Vec<Finding>,
    /// Of a program that lists numbers, those that each mistake is about, by id.
    listed: Vec<(String, WrongNumbers)>,
    /// All that are wrong.
    wrong: Option<WrongNumbers>,
    /// What is known of lines that cost nothing.
    kept: KeptLines,
}

impl Facts {
    pub fn of(evidence: &Evidence<'_>, cause: &Cause, mistakes: &[String]) -> Self {
        let (changed, found): (&[ChangedConstant], &[FoundMistake]) = match cause {
            Cause::Known { constants, found, .. } => (constants, found),
            _ => (&[], &[]),
        };
        let values: Vec<_> = changed.iter().map(|constant| (constant.name.as_str(), constant.found.clone())).collect();
        let theirs = evidence.assignment.with_constants(&values).unwrap_or_else(|_| evidence.assignment.clone());
        let mut points = TracedProbes::new(evidence, &theirs);
        let wrong = WrongNumbers::of(evidence);
        let is_sought = wrong.is_none() && changed.is_empty() && !found.is_empty();
        let (findings, slip) = match found {
            _ if is_sought => inside::slip(evidence),
            [_, _, ..] => (inside::find_in(evidence, &theirs), None),
            _ => Default::default(),
        };
        let only = if found.len() > 1 { inside::only(findings) } else { findings.into_iter().next() };
        let is_one_of_several = is_sought && slip.is_none() && found.len() > 1;
        let mut place = |index| {
            let own = if is_one_of_several { inside::slip_of(evidence, found, index) } else { None };
            let known = locate::KnownPlaces { slip: slip.as_ref().or(own.as_ref()), only: only.as_ref() };
            locate::mistake(evidence, &theirs, &mut points, found, index, known)
        };
        let listed: Vec<(String, WrongNumbers)> = match &wrong {
            Some(wrong) => found.iter().map(|found| (found.id.clone(), wrong.of_mistake(evidence, found))).collect(),
            None => Vec::new(),
        };
        // What is known number by number need not be looked for.
        let sought = if wrong.is_some() { &[] } else { found };
        let mut places: Vec<_> =
            sought.iter().enumerate().map(|(index, mistake)| (mistake.id.clone(), place(index))).collect();
        let is_found = |id: &&String| mistakes.contains(id) && !places.iter().any(|(known, _)| known == *id);
        if let Some(id) = evidence.assignment.gradual.as_ref().map(|gradual| &gradual.abrupt).filter(is_found) {
            places.push((id.clone(), inside::decision(evidence)));
        }
        let findings = match cause {
            // Everything stands where it should not, and nothing else is wrong.
            Cause::Known { constants, found, .. } if constants.is_empty() && found.is_empty() => inside::find(evidence),
            Cause::Parts(parts) => inside::find_beside(evidence, &parts.found),
            Cause::Right | Cause::NearlyRight(_) | Cause::FewPixels => inside::find(evidence),
            Cause::Known { .. } | Cause::HardCoded | Cause::NothingDrawn | Cause::Repaired(_) => Vec::new(),
            Cause::Unexplained { findings, .. } => findings.clone(),
        };
        let mut names = Self::handed_out(evidence);
        let own = points.as_ref().map(|points| points.names(found)).unwrap_or_default();
        let own = own.into_iter().chain(std::iter::repeat(None));
        for (definition, own) in evidence.assignment.equation.definitions().iter().zip(own) {
            let symbol = evidence.assignment.names.get(&definition.name).and_then(|name| name.symbol.clone());
            names.extend(own.map(|own| format!("`{own}`")).or(symbol).map(|name| (definition.name.clone(), name)));
        }
        Self { places, names, findings, listed, wrong, kept: KeptLines::default() }
    }

    /// The names of the handed-out file that the student's still has.
    fn handed_out(evidence: &Evidence<'_>) -> Vec<(String, String)> {
        let interface = &evidence.assignment.interface;
        let constants = evidence.assignment.constants.iter().map(|constant| &constant.name);
        let inputs = interface.inputs.iter().map(|input| &input.name);
        let all = constants.chain(inputs).chain(interface.outputs.iter().map(|output| &output.name));
        let code = Words::all(evidence.sources);
        all.filter(|name| code.has(name)).map(|name| (name.clone(), format!("`{name}`"))).collect()
    }

    /// Where the mistake stands that a line of the rubric suffers from.
    fn finding(&self, line: &RubricItem) -> Option<&Finding> {
        let own = self.findings.iter().find(|finding| finding.touches.contains(&line.judges));
        own.or(self.findings.first())
    }

    /// The wrong numbers of a program that a line of the rubric suffers from by a mistake.
    fn listed(&self, id: &str, line: &RubricItem) -> Option<WrongNumbers> {
        let own = self.listed.iter().find(|(known, _)| known == id).map(|(_, own)| own.clone());
        own.or_else(|| Some(self.wrong.as_ref()?.of_line(line)))
    }

    fn place(&self, id: &str) -> Option<&Located> {
        self.places.iter().find(|(known, _)| known == id)?.1.as_ref()
    }
}
