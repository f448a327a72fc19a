//! What stands in the placeholders of a mistake's texts: the student's own line, names and numbers.

use super::{Facts, is_general};
use crate::diagnose::cause::{Cause, PART_SCALED};
use crate::diagnose::constants::ChangedConstant;
use crate::diagnose::inside::{self, Finding};
use crate::diagnose::locate::{self, Located, MistakeOrigin, Words, is_handed_out};
use crate::diagnose::{CONSTANTS_CHANGED, Evidence, POSITION_CHANGED, belongs};
use crate::language::Text;
use crate::report::FrameResult;
use crate::source::Source;
use crate::translate::NO_LINE;
use reference::assignment::RubricItem;
use reference::equation::DISCARDED;
use reference::fit::{FeatureDefect, FeatureExplanation, Worst};
use reference::interpreter::Stage;
use reference::mistake::{Condition, Mistake};

/// What the placeholders of a mistake's texts stand for in this file.
#[derive(Default)]
pub(super) struct Blanks<'f> {
    pub values: Vec<(&'f str, String)>,
    pub line: Option<u32>,
    role: Option<MistakeOrigin>,
    pub worst: Option<Worst>,
    /// The file of the line, where there are several.
    pub file: Option<String>,
    /// The text that the line is of.
    source: Option<&'f Source>,
    pub finding: Option<&'f Finding>,
}

impl<'f> Blanks<'f> {
    pub fn of(
        evidence: &'f Evidence<'_>,
        facts: &'f Facts,
        line: &RubricItem,
        cause: &Cause,
        mistake: &Mistake,
    ) -> Self {
        let mut blanks = Self::default();
        if is_general(&mistake.id) {
            blanks.finding(evidence, facts.finding(line));
        }
        match (cause, mistake.id.as_str()) {
            (_, POSITION_CHANGED) => {
                let store = evidence.traced.and_then(locate::last_position);
                let store = store.map(|line| Located { stage: Some(Stage::Vertex), ..Located::at(line) });
                let moved = facts.findings.iter().find(|finding| finding.touches_position);
                blanks.place(evidence, mistake, moved.map(Finding::located).or(store));
            }
            (_, id) if evidence.assignment.gradual.as_ref().is_some_and(|gradual| gradual.abrupt == id) => {
                blanks.place(evidence, mistake, facts.place(id).cloned());
            }
            (Cause::Known { constants, .. }, CONSTANTS_CHANGED) => {
                let of_line = |changed: &&ChangedConstant| belongs(evidence.assignment, &changed.name, line);
                blanks.constant(evidence, constants.iter().find(of_line));
            }
            (Cause::Unexplained { .. }, id)
                if let Some(line) = facts.listed(id, line).and_then(|listed| listed.line()) =>
            {
                blanks.is_at(evidence, evidence.source, line);
            }
            (Cause::Unexplained { terms, absent, .. }, _) if !absent.contains(&line.id) => {
                let worst = terms.iter().find(|term| term.line == line.id).and_then(|term| term.worst);
                let throws_away = evidence.source.words().any(|(_, word)| word == "discard");
                blanks.worst(worst, throws_away);
            }
            (Cause::Parts(FeatureExplanation { parts, .. }), PART_SCALED) => {
                let factor = parts.iter().find_map(|(at, part)| match part {
                    FeatureDefect::Factor(factor) if evidence.assignment.rubric[*at].id == line.id => Some(factor),
                    _ => None,
                });
                let [red, others @ ..] = factor.copied().unwrap_or_default();
                // Noise: the tolerance of a colour, relative to a feature that adds a tenth of all.
                if others.iter().all(|other| (other - red).abs() <= 0.02 * red.abs()) {
                    blanks.values.push(("found", number(red)));
                }
            }
            (Cause::Parts(_) | Cause::Unexplained { .. }, _) => {}
            (Cause::NothingDrawn, _) => {
                let source = evidence.source_that_discards();
                if let Some((source, line)) = source.and_then(|source| Some((source, first_use(source, &["discard"])?)))
                {
                    blanks.is_at(evidence, source, line);
                }
            }
            (Cause::Repaired(repairs), id) => {
                // The same may be done twice: each has its own lines.
                let of_id = || repairs.iter().filter(|(_, repaired)| repaired.mistake.id == id);
                let own = of_id().find(|(lines, _)| lines.contains(&line.id)).or(of_id().next());
                let repaired = own.map(|(_, repaired)| repaired);
                blanks.place(evidence, mistake, repaired.and_then(|repaired| repaired.located.clone()));
                if let Some([expected, found]) = repaired.and_then(|repaired| repaired.numbers.clone()) {
                    blanks.values.extend([("expected", expected), ("found", found)]);
                }
            }
            (Cause::Known { found, .. }, id) => {
                let met = evidence.undefined.filter(|line| mistake.undefined_power && *line != NO_LINE);
                let met = met.map(Located::at);
                match facts.listed(id, line).and_then(|listed| listed.line()) {
                    Some(line) => blanks.is_at(evidence, evidence.source, line),
                    None => blanks.place(evidence, mistake, facts.place(id).cloned().or(met)),
                }
                let own = found.iter().find(|found| found.id == id);
                blanks.parameter(own.and_then(|own| mistake.number(own)), evidence, mistake);
            }
            _ => {
                if evidence.frames.iter().all(FrameResult::agrees) {
                    blanks.values.push(("frames", evidence.frames.len().to_string()));
                }
                let line = first_use(evidence.source, &VERTEX_NUMBERS);
                blanks.place(evidence, mistake, line.map(Located::at));
            }
        }
        blanks
    }

    /// What is said where the line writes over what the mistake is about.
    pub fn overwritten(&self) -> Option<Text> {
        let name = self.values.iter().find(|(name, _)| *name == "name").map(|(_, own)| own.clone());
        match self.role? {
            MistakeOrigin::Overwritten => Some(inside::overwrites(self.line?, &name)),
            MistakeOrigin::LeftBehind => Some(inside::left_behind(self.line?, &name)),
            _ => None,
        }
    }

    fn place(&mut self, evidence: &'f Evidence<'_>, mistake: &Mistake, located: Option<Located>) {
        let Some(Located { line, name, role, stage }) = located else { return };
        self.role = Some(role);
        let (source, starter) = evidence.text(stage);
        // A line that the student did not write is not where the student's mistake is, unless it was left there.
        let may_be_left = mistake.handed_out || role == MistakeOrigin::LeftBehind;
        if !may_be_left && is_handed_out(source, line, starter) {
            return;
        }
        self.is_at(evidence, source, line);
        let code = Words::at(source, line);
        self.values.extend(name.filter(|name| code.has(name)).map(|name| ("name", name)));
    }

    fn is_at(&mut self, evidence: &Evidence<'_>, source: &'f Source, line: u32) {
        self.line = Some(line);
        self.source = Some(source);
        self.file = (evidence.sources.len() > 1).then(|| source.facts.name.clone());
        self.values.push(("line", line.to_string()));
    }

    fn finding(&mut self, evidence: &'f Evidence<'_>, finding: Option<&'f Finding>) {
        let Some(finding) = finding else { return };
        self.is_at(evidence, evidence.text(Some(finding.stage)).0, finding.line);
        self.finding = Some(finding);
    }

    /// What decides which of a mistake's texts are true of this file.
    pub fn situation(&self, evidence: &Evidence<'_>, cause: &Cause, mistake: &Mistake) -> impl Fn(&Condition) -> bool {
        let code = match (self.line, self.source) {
            (Some(line), source) => Words::at(source.unwrap_or(evidence.source), line),
            (None, _) => Words::all(evidence.sources),
        };
        let form = match cause {
            Cause::Known { found, .. } => found.iter().find(|found| found.id == mistake.id).map(|found| found.form),
            _ => None,
        };
        let role = self.role;
        move |condition| match condition {
            Condition::Forms(forms) => form.is_some_and(|form| forms.contains(&form)),
            Condition::Lacks(words) => !words.iter().any(|word| code.has(word)),
            Condition::Zero => role == Some(MistakeOrigin::Zero),
            Condition::Absent => role == Some(MistakeOrigin::Absent),
        }
    }

    fn constant(&mut self, evidence: &'f Evidence<'_>, changed: Option<&ChangedConstant>) {
        let Some(changed) = changed else { return };
        self.is_at(evidence, evidence.text(Some(changed.stage)).0, changed.line);
        self.values.push(("name", changed.name.clone()));
        self.values.push(("expected", numbers(changed.expected.numbers())));
        self.values.push(("found", numbers(changed.found.numbers())));
    }

    fn parameter(&mut self, parameter: Option<f64>, evidence: &Evidence<'_>, mistake: &Mistake) {
        let Some(parameter) = parameter else { return };
        self.values.push(("found", number(parameter)));
        let of = mistake.fit.as_ref().and_then(|fit| evidence.assignment.constants.get(fit.of?));
        self.values.extend(of.map(|constant| ("expected", number(constant.value.float()))));
    }

    fn worst(&mut self, worst: Option<Worst>, throws_away: bool) {
        let Some(worst) = worst else { return };
        let colour = |colour: glam::DVec3| match colour == DISCARDED {
            true => "`discard`".to_owned(),
            false => numbers(&colour.to_array()),
        };
        // Where nothing is ever written there is no value to speak of.
        if worst.found != DISCARDED || throws_away {
            self.values.push(("expected", colour(worst.expected)));
            self.values.push(("found", colour(worst.found)));
        }
        self.worst = Some(worst);
    }
}

/// What tells one vertex from another without its attributes.
const VERTEX_NUMBERS: [&str; 2] = ["gl_VertexID", "gl_InstanceID"];

/// The first line on which one of these words stands.
fn first_use(source: &Source, names: &[&str]) -> Option<u32> {
    source.words().find(|(_, word)| names.contains(word)).map(|(at, _)| source.position(at).0)
}

fn numbers(values: &[f64]) -> String {
    values.iter().map(|value| number(*value)).collect::<Vec<_>>().join(", ")
}

/// Three significant places behind the point at most; what is no number is called by its name.
fn number(value: f64) -> String {
    if value.is_nan() {
        return "NaN".into();
    }
    if value.is_infinite() {
        return if value > 0.0 { "+∞".into() } else { "−∞".into() };
    }
    let rounded = (value * 1000.0).round() / 1000.0;
    // No minus before a zero.
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}
