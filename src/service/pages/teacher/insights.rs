//! What a homework shows of its class: attempts until a right answer, mistakes over time, and what came after each message.

use super::super::frame::PageFrame;
use super::super::shown;
use super::Tab;
use crate::language::{Language, Text};
use crate::report::html::rich::{MessagePiece, pieces};
use crate::service::State;
use crate::service::errors::Problem;
use crate::service::identity::TeacherPage;
use crate::service::insights::{self, Insights};
use askama::Template;
use axum::extract::State as Shared;
use axum::response::Response;

/// Attempts that have a bar of their own; the last one stands for this many and more.
const BARS: usize = 10;

/// Mistakes that are drawn over time; the table has all.
const DRAWN: usize = 8;

/// Width and height of the drawings, in their own units.
const SIZE: (f64, f64) = (600.0, 160.0);
const SMALL: (f64, f64) = (300.0, 40.0);

#[derive(Template)]
#[template(path = "service/pages/templates/insights.html")]
struct InsightsPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    attempts: Vec<LabelledBar>,
    mistakes: Vec<MistakeChart>,
    /// The parts of the time, with how often each mistake was handed in.
    times: Vec<Time>,
    messages: Vec<MessageLine>,
    size: (f64, f64),
    small: (f64, f64),
    /// By which an address of the API says which homework it is about.
    query: String,
}

/// A part of the time.
struct Time {
    from: String,
    to: String,
    counts: Vec<usize>,
}

/// A bar with what it stands for.
struct LabelledBar {
    label: String,
    count: usize,
    is_right: bool,
    x: f64,
    y: f64,
    width: f64,
    height: f64,
}

/// A mistake over time.
struct MistakeChart {
    title: String,
    total: usize,
    bars: Vec<LabelledBar>,
}

/// A message, with what came after it as parts of a bar.
struct MessageLine {
    text: Vec<MessagePiece>,
    said: usize,
    students: usize,
    counts: [usize; 4],
    /// Place and width of each part, in hundredths.
    parts: [(f64, f64); 4],
}

/// `GET /teacher/insights`.
pub(in crate::service::pages) async fn page(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let insights = insights::of(&state).await?;
    let time = |at| frame.datetime(at).text;
    shown(
        InsightsPage {
            place: Tab::Insights,
            csrf: teacher.csrf(&state),
            attempts: attempts(&frame, &insights),
            mistakes: courses(&insights, frame.language),
            times: insights
                .stretches
                .iter()
                .map(|stretch| Time {
                    from: time(stretch.from),
                    to: time(stretch.to),
                    counts: drawn(&insights).map(|(id, _)| stretch.mistakes.get(id).copied().unwrap_or(0)).collect(),
                })
                .collect(),
            messages: insights.messages.iter().map(|message| row(message, frame.language)).collect(),
            size: SIZE,
            small: SMALL,
            query: state.query(),
            frame,
        }
        .render(),
    )
}

/// A bar for each number of attempts, and one for those who have no right answer yet.
fn attempts(frame: &PageFrame, insights: &Insights) -> Vec<LabelledBar> {
    let mut counts = [0; BARS];
    for (attempts, students) in &insights.right_at {
        counts[(attempts - 1).min(BARS - 1)] += students;
    }
    let label = |at: usize| if at + 1 < BARS { (at + 1).to_string() } else { format!("{BARS}+") };
    let mut bars: Vec<(String, usize)> = counts.iter().enumerate().map(|(at, count)| (label(at), *count)).collect();
    bars.push((frame.say("not yet", "まだ").to_owned(), insights.trying.values().sum()));
    laid_out(bars, SIZE, 6.0)
}

/// Bars side by side, the highest as high as the drawing.
fn laid_out(counts: Vec<(String, usize)>, (width, height): (f64, f64), gap: f64) -> Vec<LabelledBar> {
    let most = counts.iter().map(|(_, count)| *count).max().unwrap_or(0).max(1);
    let step = width / counts.len().max(1) as f64;
    let last = counts.len().saturating_sub(1);
    let bar = |(at, (label, count)): (usize, (String, usize))| {
        let high = height * count as f64 / most as f64;
        let (x, y, width) = (at as f64 * step + gap / 2.0, height - high, step - gap);
        LabelledBar { label, count, is_right: at < last, x, y, width, height: high }
    };
    counts.into_iter().enumerate().map(bar).collect()
}

fn courses(insights: &Insights, language: Language) -> Vec<MistakeChart> {
    let course = |(id, title): &(String, Text)| {
        let counts: Vec<usize> =
            insights.stretches.iter().map(|stretch| stretch.mistakes.get(id).copied().unwrap_or(0)).collect();
        let bars = laid_out(counts.iter().map(|count| (String::new(), *count)).collect(), SMALL, 2.0);
        MistakeChart { title: title.get(language).to_owned(), total: counts.iter().sum(), bars }
    };
    drawn(insights).map(course).collect()
}

/// The mistakes that are drawn over time.
fn drawn(insights: &Insights) -> impl Iterator<Item = &(String, Text)> {
    insights.mistakes.iter().take(DRAWN)
}

fn row(message: &insights::MessageInsight, language: Language) -> MessageLine {
    let counts = [message.right, message.gone, message.again, message.last];
    let mut x = 0.0;
    let parts = counts.map(|count| {
        let width = 100.0 * count as f64 / message.said.max(1) as f64;
        x += width;
        (x - width, width)
    });
    MessageLine {
        text: pieces(message.text.get(language)),
        said: message.said,
        students: message.students,
        counts,
        parts,
    }
}
