//! What a report shows, part by part, as the templates need it.

mod equation;

use super::listing::{self, FileListing};
use super::map::MapView;
use super::mark::Mark;
use super::player::{self, FrameView, Player, Swatch, TermView};
use super::rich::{MessagePiece, pieces};
use super::values::ValuesView;
use super::{LineLinks, ReportFragment};
use crate::diagnostic::{Diagnostic, Severity};
use crate::language::Language;
use crate::report::labels::{Labels, mistake_title};
use crate::report::text::number;
use crate::report::{AdviceLine, CrossCheck, Hints, Opinion, Report, RubricLine, Verdict};
use askama::Template;
use equation::EquationView;
use reference::Assignment;
use reference::typeset::SumPart;

/// One line of the rubric.
struct HtmlRubricLine {
    id: String,
    mark: Mark,
    label: String,
    points: String,
    max_points: String,
    /// Title and id.
    mistake: Option<(String, String)>,
    message: Vec<MessagePiece>,
    anchor: Option<String>,
    place: String,
}

impl HtmlRubricLine {
    fn of(assignment: &Assignment, report: &Report, line: &RubricLine, language: Language) -> Self {
        let labels = Labels::of(language);
        let shown = line.mistake.as_ref().filter(|_| report.hints > Hints::None);
        let titled = |id: &String| (mistake_title(assignment, id, language), id.clone());
        Self {
            id: line.id.clone(),
            mark: Mark::of(line.points, line.max_points),
            label: line.label.get(language).to_owned(),
            points: number(line.points),
            max_points: number(line.max_points),
            mistake: shown.map(titled),
            message: match report.said_before(line) {
                Some(before) => pieces(&labels.as_for(before.label.get(language))),
                None => pieces(line.message.get(language)),
            },
            anchor: anchor(report, line.file.as_deref(), line.line),
            place: place(report, labels, line.file.as_deref(), line.line),
        }
    }
}

/// The id of a line in the listings below, see [`super::LineLinks`].
fn anchor(report: &Report, file: Option<&str>, line: Option<u32>) -> Option<String> {
    let index = file.and_then(|file| report.sources.iter().position(|source| source.name == file));
    Some(listing::anchor(index.unwrap_or(0), line?))
}

/// A line as a person reads it.
fn place(report: &Report, labels: &Labels, file: Option<&str>, line: Option<u32>) -> String {
    line.map(|line| labels.place(report.file_to_name(file), line, None)).unwrap_or_default()
}

/// What would break elsewhere.
struct HtmlAdvice {
    text: Vec<MessagePiece>,
    anchor: Option<String>,
    place: String,
}

impl HtmlAdvice {
    fn of(report: &Report, advice: &AdviceLine, labels: &Labels, language: Language) -> Self {
        Self {
            text: pieces(advice.message.get(language)),
            anchor: anchor(report, Some(&advice.file), advice.line),
            place: place(report, labels, Some(&advice.file), advice.line),
        }
    }
}

/// One diagnostic.
pub(super) struct HtmlMessage {
    pub kind: &'static str,
    pub severity: &'static str,
    stage: &'static str,
    pub file: Option<String>,
    pub line: Option<u32>,
    anchor: Option<String>,
    place: String,
    pub text: Vec<MessagePiece>,
    hint: Option<Vec<MessagePiece>>,
}

impl HtmlMessage {
    fn of(report: &Report, diagnostic: &Diagnostic, labels: &Labels, language: Language) -> Self {
        let file = report.file_to_name(diagnostic.file.as_deref());
        let place = diagnostic.line.map(|line| labels.place(file, line, diagnostic.column));
        Self {
            kind: match diagnostic.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
                Severity::Note => "remark",
            },
            severity: labels.severity(diagnostic.severity),
            stage: labels.stage(diagnostic.stage),
            file: diagnostic.file.clone(),
            line: diagnostic.line,
            anchor: anchor(report, diagnostic.file.as_deref(), diagnostic.line),
            place: place.unwrap_or_default(),
            text: pieces(diagnostic.message.get(language)),
            hint: diagnostic.hint.as_ref().map(|hint| pieces(hint.get(language))),
        }
    }
}

/// What the interpreter says of the same vertices.
struct SecondOpinion {
    differs: bool,
    counted: String,
    message: Option<String>,
    anchor: Option<String>,
    place: String,
}

impl SecondOpinion {
    fn of(report: &Report, checked: &CrossCheck, labels: &Labels, language: Language) -> Self {
        Self {
            differs: checked.opinion == Opinion::Differs,
            counted: labels.cross_check(checked),
            message: checked.message.as_ref().map(|message| message.get(language).to_owned()),
            anchor: anchor(report, None, checked.line),
            place: place(report, labels, None, checked.line),
        }
    }
}

/// A stretch of the bar of points: one line of the rubric, in thousandths of the bar.
struct BarStretch {
    x: f64,
    width: f64,
    earned: f64,
}

/// The lines of the rubric side by side, each as long as its points, with gaps between.
fn bar(report: &Report) -> Vec<BarStretch> {
    const GAP: f64 = 3.0;
    let total: f64 = report.rubric.iter().map(|line| line.max_points).sum();
    let room = 1000.0 - GAP * (report.rubric.len().saturating_sub(1)) as f64;
    let mut x = 0.0;
    let stretch = |line: &RubricLine| {
        let width = if total > 0.0 { room * line.max_points / total } else { 0.0 };
        let share = if line.max_points > 0.0 { (line.points / line.max_points).clamp(0.0, 1.0) } else { 1.0 };
        let stretch = BarStretch { x, width, earned: width * share };
        x += width + GAP;
        stretch
    };
    report.rubric.iter().map(stretch).collect()
}

/// The report as its template shows it.
#[derive(Template)]
#[template(path = "report/html/templates/body.html")]
pub(super) struct ReportBody<'a> {
    pub labels: &'static Labels,
    pub report: &'a Report,
    pub score: String,
    pub max_score: String,
    /// What lateness takes off, and what is left.
    lateness: Vec<String>,
    level: u8,
    verdict: &'static str,
    headline: &'static str,
    mark: Mark,
    is_drawn: bool,
    /// Whether the rubric is shown: what could not be drawn has one where somebody gave points.
    has_rubric: bool,
    next: Option<String>,
    bar: Vec<BarStretch>,
    rubric: Vec<HtmlRubricLine>,
    advice: Vec<HtmlAdvice>,
    messages: Vec<HtmlMessage>,
    player: Option<Player<'a>>,
    frames: Vec<FrameView>,
    frames_agree: String,
    agreeing: String,
    legend: Vec<Swatch>,
    probes_agree: String,
    second_opinion: Option<SecondOpinion>,
    equation: Option<EquationView<'a>>,
    terms: Vec<TermView<'a>>,
    map: Option<MapView>,
    values: Option<ValuesView>,
    listings: Vec<FileListing>,
    has_lines: bool,
    has_footer: bool,
    elapsed: String,
}

impl<'a> ReportBody<'a> {
    pub fn of(part: &ReportFragment<'a>) -> Self {
        let ReportFragment { report, language, .. } = *part;
        let typeset = part.assignment.typeset.as_ref();
        let labels = Labels::of(language);
        let is_drawn = report.verdict.is_drawn();
        let gallery = part.gallery.filter(|_| is_drawn);
        let rubric: Vec<HtmlRubricLine> =
            report.rubric.iter().map(|line| HtmlRubricLine::of(part.assignment, report, line, language)).collect();
        let messages = report.diagnostics.iter().map(|d| HtmlMessage::of(report, d, labels, language));
        let messages: Vec<HtmlMessage> = messages.collect();
        let agree = report.frames.iter().filter(|frame| frame.agrees()).count();
        let probes = &report.probes;
        let (agreeing, legend) = player::legend();
        let listings = match part.source {
            LineLinks::Here(sources) => listing::listings(sources, report, &messages, language),
            LineLinks::Elsewhere | LineLinks::Nowhere => Vec::new(),
        };
        Self {
            labels,
            report,
            level: part.level,
            verdict: labels.verdict(report.verdict),
            headline: labels.headline(report.verdict),
            mark: Mark::of_verdict(report.verdict, report.score),
            is_drawn,
            has_rubric: is_drawn || report.rubric.iter().any(|line| line.graded.is_some()),
            score: number(report.score),
            max_score: number(report.max_score),
            lateness: report.lateness_lines(language),
            next: labels.next_step(report, language),
            bar: bar(report),
            equation: typeset.filter(|_| is_drawn).map(|equation| EquationView::of(equation, &rubric, language)),
            player: gallery.and_then(|gallery| Player::of(gallery, &report.frames, labels)),
            terms: gallery.map(|gallery| player::terms(gallery, report, language)).unwrap_or_default(),
            map: report.map_lookup.as_ref().and_then(|lookup| MapView::of(part.assignment, lookup, language)),
            values: report.own_values.as_ref().filter(|_| is_drawn).map(|values| {
                ValuesView::of(part, values, |line| anchor(report, line.file.as_deref(), Some(line.line)))
            }),
            frames: player::frames(report, labels),
            frames_agree: labels.frames_agree(agree, report.frames.len()),
            agreeing,
            legend,
            probes_agree: labels.probes_agree(probes.samples.saturating_sub(probes.mismatched), probes.samples),
            second_opinion: report
                .cross_check
                .as_ref()
                .map(|checked| SecondOpinion::of(report, checked, labels, language)),
            has_lines: !listings.is_empty() || part.source == LineLinks::Elsewhere,
            has_footer: part.has_footer,
            listings,
            rubric,
            advice: report.advice.iter().map(|advice| HtmlAdvice::of(report, advice, labels, language)).collect(),
            messages,
            elapsed: format!("{:.0} ms", report.elapsed_ms),
        }
    }

    /// Whether there are pictures that move.
    pub fn moves(&self) -> bool {
        self.player.is_some()
    }
}
