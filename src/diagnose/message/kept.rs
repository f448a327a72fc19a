//! What is said of a line of the rubric that costs nothing.

use crate::compare::COLOUR_TOLERANCE;
use crate::diagnose::cause::terms_alone;
use crate::diagnose::columns::is_colour;
use crate::diagnose::{Cause, Evidence, addends};
use crate::language::Text;
use crate::render::Sample;
use glam::DVec3;
use reference::assignment::RubricItem;
use reference::derived::is_derived;
use reference::fit::{Alternatives, Footprints, TermJudgement, is_right};
use std::cell::OnceCell;

/// What is known of such lines of a wrong answer, looked up once it is asked for.
#[derive(Debug, Default)]
pub(super) struct KeptLines {
    /// Whether no colour is a number, so that nothing shows by itself.
    is_finite_nowhere: OnceCell<bool>,
    /// The lines whose feature shows beside others everywhere, by id.
    never_alone: OnceCell<Vec<String>>,
    /// Whether every colour is right, and only a place is not.
    is_right: OnceCell<bool>,
    /// Where the features of the lines show.
    footprints: OnceCell<Footprints>,
    /// How far the lines are right where they show.
    terms: OnceCell<Vec<TermJudgement>>,
}

impl KeptLines {
    /// What is said of a line.
    pub fn of(&self, evidence: &Evidence<'_>, cause: &Cause, line: &RubricItem) -> Text {
        // The numbers that a program lists are known one by one.
        let is_listed = evidence.assignment.files.iter().any(|file| file.program.is_some());
        let all_is_right =
            matches!(cause, Cause::Right) || *self.is_right.get_or_init(|| all_colours_are_right(evidence));
        if is_listed || all_is_right || evidence.assignment.judges_position(line) {
            return agreement(evidence, line);
        }
        if *self.is_finite_nowhere.get_or_init(|| addends::is_finite_nowhere(evidence)) {
            return unseen();
        }
        // Mistakes that are known explain all that is seen. One that nobody wrote down may hide a feature that it costs nothing.
        let is_open = match cause {
            Cause::Known { found, .. } => {
                evidence.assignment.is_told_by_features() && found.iter().any(|found| is_derived(&found.id))
            }
            _ => matches!(cause, Cause::Unexplained { .. } | Cause::Repaired(_)),
        };
        if matches!(cause, Cause::Known { .. }) && !is_open {
            return agreement(evidence, line);
        }
        match self.judgement(evidence, line) {
            None if is_open => never_alone(),
            _ if is_open && self.is_never_alone(evidence, line) => never_alone(),
            Some(term) if term.matched < term.judged => elsewhere(),
            _ if is_open && self.is_wrong_where_shown(evidence, line) => elsewhere(),
            _ => agreement(evidence, line),
        }
    }

    /// Whether what a line judges shows beside other lines everywhere, so that no probe says that it is right.
    fn is_never_alone(&self, evidence: &Evidence<'_>, line: &RubricItem) -> bool {
        let sought = || {
            let footprints = self.footprints(evidence);
            let judged = footprints.judged(&|_| true);
            let open = footprints.lines().filter(|line| !judged.iter().any(|known| known.line == *line));
            open.map(|line| evidence.assignment.rubric[line].id.clone()).collect()
        };
        self.never_alone.get_or_init(sought).contains(&line.id)
    }

    fn footprints(&self, evidence: &Evidence<'_>) -> &Footprints {
        let Evidence { assignment, probes, .. } = *evidence;
        let sought = || Footprints::of(&Alternatives::new(assignment, probes), COLOUR_TOLERANCE);
        self.footprints.get_or_init(sought)
    }

    /// Whether a colour is wrong where a line's feature shows, beside others or not.
    fn is_wrong_where_shown(&self, evidence: &Evidence<'_>, line: &RubricItem) -> bool {
        let Evidence { assignment, probes, .. } = *evidence;
        let own = assignment.rubric.iter().position(|own| own.id == line.id);
        let Some(own) = own.filter(|_| assignment.is_told_by_features()) else { return false };
        self.footprints(evidence).of_line(own).into_iter().any(|at| {
            let sample = evidence.samples.get(at).map(|sample| DVec3::from(sample.colour_f64()));
            sample.is_none_or(|sample| !is_colour(probes.probes[at].colour, sample))
        })
    }

    /// How far a line is right where it shows, wherever the mistake stands; `None` for one that is not seen by itself.
    fn judgement(&self, evidence: &Evidence<'_>, line: &RubricItem) -> Option<&TermJudgement> {
        let terms = self.terms.get_or_init(|| terms_alone(evidence));
        terms.iter().find(|term| term.line == line.id)
    }
}

fn all_colours_are_right(evidence: &Evidence<'_>) -> bool {
    let samples: Vec<[f64; 3]> = evidence.samples.iter().map(Sample::colour_f64).collect();
    is_right(evidence.probes, &samples, COLOUR_TOLERANCE)
}

/// What is said of a line that costs nothing where no colour is a number.
fn unseen() -> Text {
    Text::new(
        "No colour is a number, so that it cannot be seen by itself. No mistake was found in it in the text.",
        "どの色も数値になっていないので、この項だけを色から確かめることはできません。シェーダの中では、この項に間違いは見つかりませんでした。",
    )
}

/// What is said of a line that costs nothing where other lines show wherever it does, as where all that is seen is tone-mapped.
fn never_alone() -> Text {
    Text::new(
        "The colour alone does not tell whether it is right: other parts change it wherever this one does. No mistake was found in it in \
         the text.",
        "この項が現れるところではほかの項も色を変えるので、色だけからは確かめられません。シェーダの中では、この項に間違いは見つかりませんでした。",
    )
}

/// What is said of a line that costs nothing and is not right where it shows.
fn elsewhere() -> Text {
    Text::new(
        "The colour is not right everywhere where it shows, but the mistake was found elsewhere, and none in this part of the text.",
        "この項が現れるところに色の正しくない場所がありますが、見つかった間違いはほかの場所にあり、この項には見つかりませんでした。",
    )
}

/// Right answers get more than silence.
fn agreement(evidence: &Evidence<'_>, line: &RubricItem) -> Text {
    let frames = evidence.frames.len();
    let probes = evidence.probes.probes.len();
    if let Some(right) = &line.right {
        let filled = right.fill(&[("frames", &frames.to_string()), ("probes", &probes.to_string())]);
        return filled.into();
    }
    if evidence.assignment.judges_position(line) {
        return Text::new(
            format!("Everything stands where it should in all {frames} frames."),
            format!("{frames} 枚の画像すべてで、位置と形が一致しています。"),
        );
    }
    Text::new(
        format!("It agrees wherever it shows among {probes} probes."),
        format!("{probes} 点の検査点のうち、この項が現れるすべての点で一致しています。"),
    )
}
