//! `report.html`: the class on one page that needs nothing else but the students' own pages beside it.
//!
//! A plain table of everyone with scripts off; the one script filters, sorts and lays the pictures out as a contact
//! sheet. What the page may load and run is fixed by a `Content-Security-Policy` that names style and script by hash.

#[cfg(test)]
mod browser;
mod charts;
mod groups;
mod portraits;
#[cfg(test)]
mod tests;
mod words;

use self::charts::{Bin, MistakeCount, VerdictCount};
use self::portraits::PortraitStyles;
use self::words::PageWords;
use super::plain::one_line;
use super::status::summary;
use crate::class::standing::Standing;
use crate::class::statistics;
use crate::class::{Class, ClassEntry, Outcome};
use crate::fault::Fault;
use crate::language::{Language, Text};
use crate::report::html::BASE_STYLE;
use crate::report::labels::{Labels, mistake_title};
use crate::report::text::number;
use crate::report::{Environment, Report, Verdict};
use askama::Template;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};

const STYLE: &str = include_str!("page/templates/class.css");
const SCRIPT: &str = include_str!("page/templates/class.js");

/// The page, in the class's language. A student with a page of their own is linked as `students/KEY.html`.
pub fn render(class: &Class) -> Result<Vec<u8>, Fault> {
    let page = ResultsPage::of(class).render().map_err(|error| {
        Fault::new(Text::new(
            format!("The class page could not be written: {error}."),
            format!("クラスのページを生成できませんでした（{error}）。"),
        ))
    })?;
    Ok(page.into_bytes())
}

/// A column of the rubric.
struct RubricColumn {
    id: String,
    label: String,
}

/// Points in one line of the rubric.
struct LinePoints {
    text: String,
    is_less: bool,
}

/// One student.
struct StudentRow {
    key: String,
    name: String,
    detail: String,
    has_page: bool,
    status: &'static str,
    sign: &'static str,
    word: &'static str,
    bin: String,
    exact: String,
    score: String,
    lines: Vec<LinePoints>,
    mistakes: String,
    /// Title and id.
    mistake_titles: Vec<(String, String)>,
    message: String,
    group: String,
    shared: String,
    picture: Option<String>,
}

/// Students with the same answer.
struct AnswerGroup {
    id: usize,
    size: usize,
    members: Vec<GroupMember>,
}

struct GroupMember {
    key: String,
    name: String,
}

/// A grading that failed.
struct FaultView {
    name: String,
    message: String,
    remedy: String,
}

/// Everything that the template shows.
#[derive(Template)]
#[template(path = "class/formats/page/templates/class.html")]
struct ResultsPage {
    tag: &'static str,
    policy: String,
    style: String,
    script: &'static str,
    words: &'static PageWords,
    title: String,
    assignment: String,
    assignment_id: String,
    overview: String,
    mean: Option<String>,
    max_score: String,
    spread: String,
    tallies: Vec<VerdictCount>,
    bins: Vec<Bin>,
    mistakes: Vec<MistakeCount>,
    lines: Vec<RubricColumn>,
    rows: Vec<StudentRow>,
    groups: Vec<AnswerGroup>,
    sharing: usize,
    faults: Vec<FaultView>,
    refused: Vec<(String, String)>,
    environment: Option<Environment>,
}

impl ResultsPage {
    fn of(class: &Class) -> Self {
        let language = class.language;
        let words = PageWords::of(language);
        let portraits = PortraitStyles::of(class);
        let style = format!("{BASE_STYLE}{STYLE}{}", portraits.style);
        let reports = || class.entries.iter().filter_map(ClassEntry::report);
        let full = reports().filter(|report| report.verdict == Verdict::Correct).count();
        let max_score = reports().next().map_or(100.0, |report| report.max_score);
        let averages = statistics::averages(class);
        let groups = groups::groups(class);
        let lines = lines(class);
        let row = |(index, entry)| {
            let group = groups.iter().position(|group| group.contains(&index));
            let shares = group.map(|at| (at + 1, groups[at].len() - 1));
            row(entry, class, &lines, &portraits, shares)
        };
        Self {
            tag: Labels::of(language).tag,
            policy: policy(&style),
            style,
            script: SCRIPT,
            words,
            title: one_line(&class.title),
            assignment: title(class),
            assignment_id: one_line(&class.assignment.id),
            overview: words.overview(class.entries.len(), reports().count()),
            mean: averages.map(|averages| number((averages.mean * 10.0).round() / 10.0)),
            max_score: number(max_score),
            spread: averages.map(|averages| words.spread(&number(averages.median), full)).unwrap_or_default(),
            tallies: charts::tallies(class, language),
            bins: charts::bins(class, max_score, words),
            mistakes: charts::mistakes(class, language),
            rows: trouble_first(class).map(row).collect(),
            lines,
            sharing: groups.iter().map(Vec::len).sum(),
            groups: groups.iter().enumerate().map(|(at, group)| group_view(at + 1, group, class)).collect(),
            faults: class.entries.iter().filter_map(|entry| fault_view(entry, class)).collect(),
            refused: class
                .refused
                .iter()
                .map(|refused| (one_line(&refused.path), one_line(refused.reason.get(language))))
                .collect(),
            environment: reports().find(|r| !r.environment.renderer.is_empty()).map(|r| r.environment.clone()),
        }
    }
}

/// Everyone with their place in the class: what could not be graded first, then the order of the input.
fn trouble_first(class: &Class) -> impl Iterator<Item = (usize, &ClassEntry)> {
    let is_trouble = |entry: &ClassEntry| entry.report().is_none();
    let all = || class.entries.iter().enumerate();
    all().filter(move |(_, entry)| is_trouble(entry)).chain(all().filter(move |(_, entry)| !is_trouble(entry)))
}

/// What the page may do: show its own style and pictures, run its own script, and nothing else.
fn policy(style: &str) -> String {
    let hash = |text: &str| STANDARD.encode(Sha256::digest(text.as_bytes()));
    format!(
        "default-src 'none'; style-src 'sha256-{}'; script-src 'sha256-{}'; img-src data:; base-uri 'none'; form-action 'none'",
        hash(style),
        hash(SCRIPT)
    )
}

/// The homework's title.
fn title(class: &Class) -> String {
    let title = &class.assignment.title;
    match class.language {
        Language::En => title.en.clone(),
        Language::Ja => title.ja.clone(),
    }
}

/// The lines of the rubric, in the order in which the reports have them.
fn lines(class: &Class) -> Vec<RubricColumn> {
    let mut lines: Vec<RubricColumn> = Vec::new();
    for line in class.entries.iter().filter_map(ClassEntry::report).flat_map(|report| &report.rubric) {
        if !lines.iter().any(|known| known.id == line.id) {
            lines.push(RubricColumn { id: line.id.clone(), label: line.label.get(class.language).to_owned() });
        }
    }
    lines
}

fn row(
    entry: &ClassEntry,
    class: &Class,
    lines: &[RubricColumn],
    portraits: &PortraitStyles<'_>,
    shares: Option<(usize, usize)>,
) -> StudentRow {
    let (report, status) = (entry.report(), Standing::of(&entry.outcome));
    let names: Vec<&str> = entry.places.iter().filter_map(|place| place.path.rsplit('/').next()).collect();
    let file = (!names.is_empty()).then(|| one_line(&names.join(", ")));
    let number_in_moodle =
        entry.student.moodle.as_ref().and_then(|moodle| moodle.number).map(|number| number.to_string());
    let points = |line: &RubricColumn| {
        let found = report.and_then(|report| report.rubric.iter().find(|found| found.id == line.id));
        found.map_or(LinePoints { text: "–".into(), is_less: false }, |found| LinePoints {
            text: number(found.points),
            is_less: found.points < found.max_points,
        })
    };
    let mistake_ids = report.map(|report| report.mistakes.clone()).unwrap_or_default();
    let titled = |id: String| (mistake_title(&class.assignment, &id, class.language), id);
    let advised = report.is_some_and(|report| !report.advice.is_empty());
    let is_said_already = (status == Standing::Correct && !advised) || !mistake_ids.is_empty();
    StudentRow {
        key: entry.student.key.clone(),
        name: one_line(&entry.student.name),
        detail: number_in_moodle.into_iter().chain(file).collect::<Vec<_>>().join(" · "),
        has_page: entry.page.is_some(),
        status: status.id(),
        sign: charts::sign(status, report.map_or(0.0, |report| report.score)),
        word: status.word(class.language),
        bin: report.map(|report| statistics::bin(report).to_string()).unwrap_or_default(),
        exact: report.map(|report| report.total().to_string()).unwrap_or_default(),
        score: report.map_or_else(|| "–".into(), score),
        lines: lines.iter().map(points).collect(),
        mistakes: mistake_ids.join(" "),
        mistake_titles: mistake_ids.into_iter().map(titled).collect(),
        message: if is_said_already { String::new() } else { excerpt(&summary(entry, class.language)) },
        group: shares.map(|(id, _)| id.to_string()).unwrap_or_default(),
        shared: shares.map(|(_, others)| PageWords::of(class.language).shared_with(others)).unwrap_or_default(),
        picture: portraits.class(entry.portrait.as_deref()),
    }
}

/// The points that count, and of whoever was late those before.
fn score(report: &Report) -> String {
    let total = number(report.total());
    match report.lateness {
        Some(lateness) => format!("{total} ({} − {})", number(report.score), number(lateness.penalty)),
        None => total,
    }
}

/// The beginning of a message: the whole is on the student's own page.
fn excerpt(message: &str) -> String {
    const LONGEST: usize = 160;
    let message = one_line(message).replace('`', "");
    match message.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &message[..end]),
        None => message,
    }
}

fn group_view(id: usize, group: &[usize], class: &Class) -> AnswerGroup {
    let member = |index: &usize| {
        let student = &class.entries[*index].student;
        GroupMember { key: student.key.clone(), name: one_line(&student.name) }
    };
    AnswerGroup { id, size: group.len(), members: group.iter().map(member).collect() }
}

fn fault_view(entry: &ClassEntry, class: &Class) -> Option<FaultView> {
    let Outcome::Fault(fault) = &entry.outcome else { return None };
    Some(FaultView {
        name: one_line(&entry.student.name),
        message: one_line(fault.message.get(class.language)),
        remedy: fault.remedy.as_ref().map(|remedy| one_line(remedy.get(class.language))).unwrap_or_default(),
    })
}
