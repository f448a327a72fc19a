//! One [`Report`]; text, JSON, HTML and every exchange format are views of it.

mod cross_check;
mod difference;
mod encode;
mod frame;
pub mod html;
pub mod json;
pub(crate) mod labels;
mod map_lookup;
mod next;
mod own_values;
pub mod pictures;
#[cfg(test)]
pub(crate) mod samples;
mod sources;
pub mod text;
pub(crate) mod wrap;

pub use cross_check::{CrossCheck, Opinion};
pub use frame::{Area, FrameResult, Picture, Pictures, SILHOUETTE, TermPictures};
pub use map_lookup::{MapLookup, MapPlace};
pub use own_values::{OwnValues, ValueAt, ValueLine, ValuePlace};
pub use sources::SourceInfo;

use crate::diagnostic::Diagnostic;
use crate::language::{Language, Text};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// The id of a mistake that is none of those that are known: nothing explains a wrong answer.
pub const UNEXPLAINED: &str = "unexplained";

/// The outcome in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// Every frame and every probe agrees: full marks.
    Correct,
    /// It runs, and something differs.
    Wrong,
    /// The compiler or linker refuses it, or the interface is not met.
    Rejected,
    /// It exceeded a limit or crashed the renderer.
    Stopped,
}

impl Verdict {
    /// Whether it ran, so that there are pictures of it.
    pub fn is_drawn(self) -> bool {
        matches!(self, Self::Correct | Self::Wrong)
    }
}

/// One line of the rubric with what it earned.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RubricLine {
    /// Its id, as `assignment.toml` has it.
    pub id: String,
    /// Its name in the lecture's words.
    pub label: Text,
    /// Points earned.
    pub points: f64,
    /// Points possible.
    pub max_points: f64,
    /// The mistake that costs the points, where it is known.
    pub mistake: Option<String>,
    /// What is seen, which equation it breaks, where to look.
    pub message: Text,
    /// The file that the line is in.
    #[serde(default)]
    pub file: Option<String>,
    /// The line of that file to look at, from 1.
    pub line: Option<u32>,
    /// The points that the grading gave, where somebody who teaches gave others in their place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub graded: Option<f64>,
}

/// What somebody who teaches says about a line of a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct Comment {
    /// Name of the file.
    pub file: String,
    /// The line, from 1.
    pub line: u32,
    /// What is said, in the words of who says it.
    pub text: String,
    /// Who says it; none where only the course is known.
    pub author: Option<String>,
}

/// A known mistake in the form in which it explains what the shader computes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hypothesis {
    /// Id of the mistake.
    pub id: String,
    /// Which of its forms, from 0.
    pub form: usize,
    /// The number that the form leaves open, as the mistake's `fit` names it.
    pub parameter: Option<f64>,
}

/// A change of a file by which all becomes right, together with the others that a report has.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct Repair {
    /// Id of the mistake that it undoes.
    pub mistake: String,
    /// The file.
    pub file: String,
    /// The line of it, from 1.
    pub line: u32,
    /// What is written there, as an expression of GLSL.
    pub written: String,
    /// What belongs there; empty where nothing does.
    pub right: String,
}

/// Something true and worth saying that costs no points.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AdviceLine {
    /// Its id; stable.
    pub id: String,
    /// What would break, and where to look.
    pub message: Text,
    /// The file that it is about.
    pub file: String,
    /// The line to look at, from 1.
    pub line: Option<u32>,
}

/// How much a message helps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, clap::ValueEnum, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(rename_all = "lowercase")]
pub enum Hints {
    /// What is seen, no more.
    None,
    /// And which equation it breaks.
    Gentle,
    /// And which line to look at, with a question to think about.
    #[default]
    Full,
}

/// How the probes compare.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ProbeResult {
    /// The seed that they come from; `--seed` with it repeats the grading.
    pub seed: u64,
    /// How many there are.
    pub samples: u32,
    /// How many differ by more than the tolerance.
    pub mismatched: u32,
    /// Largest difference of a colour channel (not quantised: 1 is the full range); null when not finite.
    pub max_difference: Option<f64>,
}

/// What graded it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct Environment {
    /// Version of ggrade.
    pub ggrade: String,
    /// Name of the adapter, such as `llvmpipe (LLVM 15.0.6, 256 bits)`.
    pub renderer: String,
    /// Driver and version, such as `llvmpipe Mesa 22.3.6`.
    pub driver: String,
}

/// How late a hand-in came, and what that takes off its points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct Lateness {
    /// Milliseconds since the due date.
    pub milliseconds: u64,
    /// Points that go.
    pub penalty: f64,
}

/// Everything that a grading found out, in both languages.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// What the interpreter computes for the same vertices, where that was asked for. It stands first, where the service's
    /// database finds it in a stored report without reading the rest.
    #[serde(default)]
    pub cross_check: Option<CrossCheck>,
    /// Id of the assignment.
    pub assignment: String,
    /// The digest of its folder: one that was changed since is another assignment. Empty in reports of old.
    #[serde(default)]
    pub assignment_digest: String,
    /// What was handed in: the files in the order of the assignment. A report of the first version has one, as `source`.
    #[serde(alias = "source", deserialize_with = "sources::one_or_several")]
    pub sources: Vec<SourceInfo>,
    /// The outcome in one word.
    pub verdict: Verdict,
    /// Sum of the rubric's points.
    pub score: f64,
    /// Sum of the rubric's possible points.
    pub max_score: f64,
    /// The rubric, line by line.
    pub rubric: Vec<RubricLine>,
    /// Ids of the mistakes found; empty when correct.
    pub mistakes: Vec<String>,
    /// The equation with these mistakes in it computes what the shader computes; none where no equation known does.
    pub explanation: Option<Vec<Hypothesis>>,
    /// The changes by which the files become right, where nothing else explains what is wrong. They are the answer itself, so
    /// that only who teaches sees them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub repairs: Vec<Repair>,
    /// What would break elsewhere in a right answer.
    #[serde(default)]
    pub advice: Vec<AdviceLine>,
    /// What the stages say about places in the file.
    pub diagnostics: Vec<Diagnostic>,
    /// The frames, in order of t; empty when nothing was rendered.
    pub frames: Vec<FrameResult>,
    /// The probes.
    pub probes: ProbeResult,
    /// Where the map that a pass draws is looked up for a pixel that is wrong.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map_lookup: Option<MapLookup>,
    /// What the files compute on their way, line by line, where the answer is wrong and can be followed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub own_values: Option<OwnValues>,
    /// What graded it.
    pub environment: Environment,
    /// How much its messages help.
    #[serde(default)]
    pub hints: Hints,
    /// Milliseconds that the grading took.
    pub elapsed_ms: f64,
    /// How late it was handed in, where a service knows; no part of what grading finds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lateness: Option<Lateness>,
    /// What people say about lines of the files, where a service knows; no part of what grading finds.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub comments: Vec<Comment>,
}

impl Report {
    /// The points that count: the score without what lateness takes off.
    pub fn total(&self) -> f64 {
        self.score - self.lateness.map_or(0.0, |lateness| lateness.penalty)
    }

    /// The earlier line of the rubric of which the same is said, where points are lost: one mistake may cost several.
    pub fn said_before(&self, line: &RubricLine) -> Option<&RubricLine> {
        let is_lost = |line: &&RubricLine| line.points < line.max_points;
        let before = self.rubric.iter().take_while(|other| other.id != line.id);
        before.filter(is_lost).find(|other| is_lost(&line) && other.message == line.message)
    }

    /// What lateness takes off and what is left, a line each; nothing where it is in time.
    pub fn lateness_lines(&self, language: Language) -> Vec<String> {
        self.lateness.map(|lateness| labels::lateness(lateness, self, language).into()).unwrap_or_default()
    }

    /// What people say about lines of the files, a line each: `ggsample06.vert, line 12: …`.
    pub fn comment_lines(&self, language: Language) -> Vec<String> {
        let labels = labels::Labels::of(language);
        let said = |comment: &Comment| {
            format!("{}: {}", labels.place(Some(&comment.file), comment.line, None), comment.text.replace('\n', " "))
        };
        self.comments.iter().map(said).collect()
    }

    /// The report as its student may see it: no repair is. The name of a mistake is the answer in words, so where messages say only
    /// what is seen, it is left out; a class's own pages and tables have it for the teacher.
    pub fn for_student(&self) -> Cow<'_, Self> {
        if self.hints > Hints::None && self.repairs.is_empty() {
            return Cow::Borrowed(self);
        }
        let mut report = self.clone();
        report.repairs.clear();
        if self.hints > Hints::None {
            return Cow::Owned(report);
        }
        report.mistakes.clear();
        for line in &mut report.rubric {
            (line.mistake, line.file, line.line) = (None, None, None);
        }
        Cow::Owned(report)
    }
}
