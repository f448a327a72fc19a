//! The report on a hand-in that was drawn: by the solution, or by the accepted reading of the task that it follows.

use super::{Grader, own_values};
use crate::compare::{self, COLOUR_TOLERANCE, ExpectedFrame};
use crate::diagnose::{self, Diagnosis, Evidence, Fresh, Recorded};
use crate::diagnostic::Diagnostic;
use crate::language::Text;
use crate::render::{Rendering, Sample};
use crate::report::{AdviceLine, FrameResult, Hints, OwnValues, Report, Verdict};
use crate::source::Source;
use crate::translate;
use reference::Assignment;
use reference::accepted::{AcceptedAnswer, Reading};
use reference::probes::{Crossings, ProbeSet};
use reference::traced::TracedProgram;

/// What a report is made from.
pub(super) struct JudgedHandIn<'a> {
    /// The text that messages point into.
    pub source: &'a Source,
    pub sources: &'a [(translate::Stage, &'a Source)],
    /// The homework, and the probes that judge, with what the files add to it.
    pub assignment: &'a Assignment,
    pub probes: &'a ProbeSet,
    pub fresh: &'a ProbeSet,
    pub crossings: Option<&'a Crossings>,
    pub rendering: &'a Rendering,
}

/// A hand-in as one reading of the task judges it.
struct ReadHandIn {
    frames: Vec<FrameResult>,
    diagnosis: Diagnosis,
    own_values: Option<OwnValues>,
}

impl Grader {
    /// The report but for what was handed in and how it was asked for.
    pub(super) fn report(&self, judged: JudgedHandIn<'_>, diagnostics: Vec<Diagnostic>, hints: Hints) -> Report {
        let JudgedHandIn { source, sources, assignment, probes, fresh, crossings, rendering } = judged;
        let frames = compared(&self.expected, rendering);
        let samples: Vec<_> = rendering.probe_samples.concat();
        let (samples, others) = samples.split_at(probes.probes.len().min(samples.len()));
        let (fresh_samples, across) = others.split_at(fresh.probes.len().min(others.len()));
        let texts: Vec<_> =
            sources.iter().map(|(stage, source)| (*stage, translate::plain_lines(&source.text))).collect();
        let texts: Vec<_> = texts.iter().map(|(stage, text)| (*stage, &**text)).collect();
        let traced = TracedProgram::new(assignment, &texts).ok();
        let evidence = Evidence {
            assignment,
            source,
            sources,
            frames: &frames,
            probes,
            samples,
            fresh: Fresh { probes: fresh, samples: fresh_samples },
            undefined: rendering.undefined,
            across: crossings.map(|crossings| (crossings, across)),
            traced: traced.as_ref(),
            recorded: &Recorded::default(),
            beyond: &self.beyond,
            hints,
        };
        let ReadHandIn { frames, diagnosis, own_values } = self.read(&evidence, rendering);
        Report {
            assignment: self.assignment.id.clone(),
            assignment_digest: self.assignment.digest.clone(),
            sources: Vec::new(),
            verdict: if diagnosis.is_right { Verdict::Correct } else { Verdict::Wrong },
            score: diagnosis.points(),
            max_score: self.assignment.max_score(),
            rubric: diagnosis.rubric,
            mistakes: diagnosis.mistakes,
            advice: diagnosis.advice,
            repairs: diagnosis.repairs,
            explanation: diagnosis.explanation,
            diagnostics,
            frames,
            probes: diagnosis.probes,
            map_lookup: None,
            own_values,
            cross_check: None,
            environment: self.environment.clone(),
            hints,
            elapsed_ms: 0.0,
            lateness: None,
            comments: Vec::new(),
        }
    }

    /// The hand-in by the solution; by the accepted answer by which most of it is right, where that is more. Of equal ones
    /// the first counts.
    fn read(&self, evidence: &Evidence<'_>, rendering: &Rendering) -> ReadHandIn {
        let diagnosis = diagnose::diagnose(evidence);
        let by_solution = ReadHandIn { frames: evidence.frames.to_vec(), diagnosis, own_values: None };
        if by_solution.diagnosis.is_right {
            return by_solution;
        }
        // What one mistake explains is no mistake in another reading.
        let is_explained = matches!(by_solution.diagnosis.explanation.as_deref(), Some([_]));
        let least = (!is_explained && !self.accepted.is_empty()).then(|| agreeing(evidence));
        let others = self.accepted.iter().rev().filter_map(|(answer, expected)| {
            Some((read_as(answer, expected, evidence, rendering, least)?, answer, expected))
        });
        let points = |read: &ReadHandIn| read.diagnosis.points();
        let best = others.max_by(|(a, ..), (b, ..)| points(a).total_cmp(&points(b)));
        let best = best.filter(|(read, ..)| read.diagnosis.is_right || points(read) > points(&by_solution));
        let followed = |evidence: &Evidence<'_>, expected: &[ExpectedFrame], read: &ReadHandIn| {
            let is_wrong = !read.diagnosis.is_right;
            is_wrong.then(|| own_values::of(evidence, expected, &rendering.frames, &read.diagnosis.rubric)).flatten()
        };
        match best {
            Some((read, answer, expected)) => {
                let own_values = answer.reading.as_deref().and_then(|reading| {
                    let probes = evidence.assignment.probes_of(answer, evidence.probes);
                    let assignment = &reading.assignment;
                    let recorded = &Recorded::default();
                    let evidence =
                        Evidence { assignment, frames: &read.frames, probes: &probes, recorded, ..*evidence };
                    followed(&evidence, expected, &read)
                });
                ReadHandIn { own_values, ..read }
            }
            None => ReadHandIn { own_values: followed(evidence, &self.expected, &by_solution), ..by_solution },
        }
    }
}

/// At how many probes the hand-in agrees with the right answer.
fn agreeing(evidence: &Evidence<'_>) -> usize {
    let samples: Vec<[f64; 3]> = evidence.samples.iter().map(Sample::colour_f64).collect();
    let wrong = reference::fit::contradicted(evidence.assignment, &[], evidence.probes, &samples, COLOUR_TOLERANCE);
    wrong.into_iter().filter(|is_wrong| !is_wrong).count()
}

/// The hand-in by an accepted answer, where it agrees with that answer, or where the answer is a reading of the task and
/// mistakes are looked for in it: where it agrees at no fewer probes than `least`. What it computes on its way is not looked up.
fn read_as(
    answer: &AcceptedAnswer,
    expected: &[ExpectedFrame],
    evidence: &Evidence<'_>,
    rendering: &Rendering,
    least: Option<usize>,
) -> Option<ReadHandIn> {
    let Evidence { assignment, probes, fresh, .. } = *evidence;
    let probes = assignment.probes_of(answer, probes);
    let reading = answer.reading.as_deref();
    let by_answer = Evidence { probes: &probes, ..*evidence };
    let is_likely = reading.is_some() && least.is_some_and(|least| agreeing(&by_answer) >= least);
    // Frames have many more pixels than there are probes.
    if !is_likely && !diagnose::agrees_at_probes(&by_answer) {
        return None;
    }
    let frames = compared(expected, rendering);
    let of_answer = assignment.probes_of(answer, fresh.probes);
    let fresh = Fresh { probes: &of_answer, ..fresh };
    // Advice and the explanation are about the solution, which this answer is not.
    let (recorded, recorded_as_read) = <(Recorded, Recorded)>::default();
    let evidence = Evidence { frames: &frames, fresh, beyond: &[], recorded: &recorded, ..by_answer };
    let read = |reading: &Reading| {
        let (assignment, recorded) = (&reading.assignment, &recorded_as_read);
        diagnose::diagnose(&Evidence { assignment, recorded, ..evidence })
    };
    let mut diagnosis = diagnose::agreement(&evidence).or_else(|| reading.filter(|_| is_likely).map(read))?;
    diagnosis.explanation = None;
    let followed =
        reading.filter(|reading| diagnosis.is_right || is_followed(reading, assignment, &probes, &diagnosis));
    diagnosis.advice.extend(followed.map(|reading| AdviceLine {
        id: reading.id.clone(),
        message: Text::new(&*reading.note.en, &*reading.note.ja),
        file: evidence.source.facts.name.clone(),
        line: None,
    }));
    Some(ReadHandIn { frames, diagnosis, own_values: None })
}

/// Whether a wrong answer has all points of the lines that judge what a reading reads in another way: else it has something third there.
fn is_followed(reading: &Reading, assignment: &Assignment, probes: &ProbeSet, diagnosis: &Diagnosis) -> bool {
    let both = [assignment, &reading.assignment].map(|own| own.equation.right());
    let is_other = |name: &str| {
        probes.iter().any(|probe| {
            let values = both.each_ref().map(|right| {
                let outcome = right.evaluate(probes.uniforms(probe), &probe.attributes);
                outcome.get(name).map(|value| value.numbers().to_vec())
            });
            values[0] != values[1]
        })
    };
    let all = || assignment.rubric.iter().zip(&diagnosis.rubric);
    all().all(|(line, judged)| judged.points >= judged.max_points || !is_other(&line.judges))
}

/// What was drawn beside what is expected, frame by frame.
fn compared(expected: &[ExpectedFrame], rendering: &Rendering) -> Vec<FrameResult> {
    let frames = expected.iter().zip(0..);
    frames.map(|(expected, index)| compare::frame(expected, &rendering.frames, index)).collect()
}
