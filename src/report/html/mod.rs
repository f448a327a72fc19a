//! The report as one HTML page that needs nothing else: no network, no script, no other file.

mod listing;
mod player;
pub(crate) mod rich;
mod sheet;

use self::listing::Line;
use self::player::{FrameView, Player, Swatch, TermView};
use self::rich::{Piece, pieces};
use super::labels::Labels;
use super::text::number;
use super::{Equation, Pictures, Report, RubricLine, Verdict};
use crate::diagnostic::{Diagnostic, Severity};
use crate::fault::Fault;
use crate::language::{Language, Text};
use askama::Template;

/// The page's one script, for a `Content-Security-Policy` that names it by its hash.
pub const SCRIPT: &str = include_str!("../../../templates/report.js");

/// What goes into a page; what is not there is left out of it.
#[derive(Clone, Copy, Debug)]
pub struct Page<'a> {
    /// The report.
    pub report: &'a Report,
    /// The student's file as text.
    pub source: Option<&'a str>,
    /// What was drawn and what is expected.
    pub pictures: Option<&'a Pictures>,
    /// The equation that the rubric judges.
    pub equation: Option<&'a Equation>,
    /// The language of every word.
    pub language: Language,
}

impl Page<'_> {
    /// The page; a fault when the pictures do not go together.
    pub fn render(&self) -> Result<String, Fault> {
        let view = View::of(self)?;
        view.render().map_err(|error| {
            Fault::new(Text::new(
                format!("The page could not be written: {error}."),
                format!("ページを生成できませんでした（{error}）。"),
            ))
        })
    }
}

/// How much of its points a line or a whole file earned, as a teacher marks it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mark {
    Full,
    Partial,
    None,
}

impl Mark {
    fn of(points: f64, max_points: f64) -> Self {
        match points {
            points if points >= max_points => Self::Full,
            points if points > 0.0 => Self::Partial,
            _ => Self::None,
        }
    }

    fn id(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Partial => "partial",
            Self::None => "none",
        }
    }

    fn sign(self) -> &'static str {
        match self {
            Self::Full => "○",
            Self::Partial => "△",
            Self::None => "×",
        }
    }

    fn word(self, labels: &'static Labels) -> &'static str {
        match self {
            Self::Full => labels.full,
            Self::Partial => labels.partial,
            Self::None => labels.none,
        }
    }
}

/// One line of the rubric.
struct Rubric {
    id: String,
    mark: Mark,
    label: String,
    points: String,
    max_points: String,
    weight: f64,
    percent: f64,
    mistake: Option<String>,
    message: Vec<Piece>,
    line: Option<u32>,
    place: String,
}

impl Rubric {
    fn of(line: &RubricLine, labels: &Labels, language: Language) -> Self {
        let share = if line.max_points > 0.0 { line.points / line.max_points } else { 1.0 };
        Self {
            id: line.id.clone(),
            mark: Mark::of(line.points, line.max_points),
            label: line.label.get(language).to_owned(),
            points: number(line.points),
            max_points: number(line.max_points),
            weight: line.max_points,
            percent: 100.0 * share.clamp(0.0, 1.0),
            mistake: line.mistake.clone(),
            message: pieces(line.message.get(language)),
            line: line.line,
            place: line.line.map(|line| labels.line(line)).unwrap_or_default(),
        }
    }
}

/// One diagnostic.
struct Message {
    kind: &'static str,
    severity: &'static str,
    stage: &'static str,
    line: Option<u32>,
    place: String,
    text: Vec<Piece>,
    hint: Option<Vec<Piece>>,
}

impl Message {
    fn of(diagnostic: &Diagnostic, labels: &Labels, language: Language) -> Self {
        let place = diagnostic.line.map(|line| labels.place(line, diagnostic.column));
        Self {
            kind: match diagnostic.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
                Severity::Note => "remark",
            },
            severity: labels.severity(diagnostic.severity),
            stage: labels.stage(diagnostic.stage),
            line: diagnostic.line,
            place: place.unwrap_or_default(),
            text: pieces(diagnostic.message.get(language)),
            hint: diagnostic.hint.as_ref().map(|hint| pieces(hint.get(language))),
        }
    }
}

/// The equation with the marks of its terms.
struct EquationView {
    source: String,
    total: &'static str,
    terms: Vec<EquationTerm>,
    definitions: Vec<(&'static str, &'static str, String)>,
}

struct EquationTerm {
    symbol: &'static str,
    value: &'static str,
    mark: Mark,
    label: String,
    points: String,
}

impl EquationView {
    fn of(equation: &Equation, rubric: &[Rubric], language: Language) -> Self {
        let terms = equation.terms.iter().filter_map(|term| {
            let line = rubric.iter().find(|line| line.id == term.rubric)?;
            Some(EquationTerm {
                symbol: term.symbol,
                value: term.value,
                mark: line.mark,
                label: line.label.clone(),
                points: format!("{} / {}", line.points, line.max_points),
            })
        });
        let definitions = equation.definitions.iter();
        Self {
            source: equation.source.get(language).to_owned(),
            total: equation.total,
            terms: terms.collect(),
            definitions: definitions.map(|d| (d.symbol, d.value, d.source.get(language).to_owned())).collect(),
        }
    }
}

/// Everything that the template shows.
#[derive(Template)]
#[template(path = "report.html")]
struct View<'a> {
    labels: &'static Labels,
    report: &'a Report,
    script: &'static str,
    verdict: &'static str,
    headline: &'static str,
    mark: Mark,
    is_drawn: bool,
    score: String,
    max_score: String,
    next: Option<String>,
    rubric: Vec<Rubric>,
    messages: Vec<Message>,
    player: Option<Player>,
    frames: Vec<FrameView>,
    frames_agree: String,
    legend: Vec<Swatch>,
    probes_agree: String,
    equation: Option<EquationView>,
    terms: Vec<TermView>,
    listing: Vec<Line>,
    elapsed: String,
}

impl<'a> View<'a> {
    fn of(page: &Page<'a>) -> Result<Self, Fault> {
        let Page { report, language, .. } = *page;
        let labels = Labels::of(language);
        let is_drawn = matches!(report.verdict, Verdict::Correct | Verdict::Wrong);
        let pictures = page.pictures.filter(|_| is_drawn);
        let rubric = report.rubric.iter().map(|line| Rubric::of(line, labels, language));
        let rubric: Vec<Rubric> = rubric.collect();
        let messages = report.diagnostics.iter().map(|d| Message::of(d, labels, language));
        let messages: Vec<Message> = messages.collect();
        let agree = report.frames.iter().filter(|frame| frame.agrees()).count();
        let probes = &report.probes;
        Ok(Self {
            labels,
            report,
            script: SCRIPT,
            verdict: labels.verdict(report.verdict),
            headline: labels.headline(report.verdict),
            mark: match report.verdict {
                Verdict::Correct => Mark::Full,
                Verdict::Wrong if report.score > 0.0 => Mark::Partial,
                Verdict::Wrong => Mark::None,
                Verdict::Rejected | Verdict::Stopped => Mark::None,
            },
            is_drawn,
            score: number(report.score),
            max_score: number(report.max_score),
            next: labels.next_step(report, language),
            equation: page.equation.filter(|_| is_drawn).map(|equation| EquationView::of(equation, &rubric, language)),
            player: pictures.map(|p| Player::of(p, labels)).transpose()?.flatten(),
            terms: pictures.map(|p| player::terms(p, report, language)).transpose()?.unwrap_or_default(),
            frames: player::frames(report, labels),
            frames_agree: labels.frames_agree(agree, report.frames.len()),
            legend: player::legend(),
            probes_agree: labels.probes_agree(probes.samples.saturating_sub(probes.mismatched), probes.samples),
            listing: page
                .source
                .map(|source| listing::listing(source, report, &messages, language))
                .unwrap_or_default(),
            rubric,
            messages,
            elapsed: format!("{:.0} ms", report.elapsed_ms),
        })
    }
}

#[cfg(test)]
mod tests;
