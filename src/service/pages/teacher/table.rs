//! The table of people: filtered, sorted by a column, in pages. All of it is in the address, so that it needs no script.

mod column;

use super::super::datetime::TimeElement;
use super::super::frame::PageFrame;
use super::super::report_fragment;
use super::pager::Pager;
use super::word;
use crate::report::Verdict;
use crate::report::html::Mark;
use crate::report::text::number;
use crate::service::classes::Person;
use column::{SortColumn, by_number};
use percent_encoding::{NON_ALPHANUMERIC, utf8_percent_encode};
use serde::Deserialize;
use std::cmp::Reverse;

/// What to show, as an address says it.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct TableFilter {
    pub verdict: String,
    pub mistake: String,
    pub q: String,
    /// Id of a column, with `-` before it from the last to the first.
    pub sort: String,
    pub page: String,
    pub anonymous: String,
    /// `on`: the files of nobody in the class.
    pub apart: String,
    /// `on`: who has handed in something on which driver and interpreter disagree.
    pub disputed: String,
    /// What has just been done.
    pub done: String,
}

impl TableFilter {
    pub fn is_anonymous(&self) -> bool {
        self.anonymous == "on"
    }

    pub fn is_apart(&self) -> bool {
        self.apart == "on"
    }

    pub fn is_disputed(&self) -> bool {
        self.disputed == "on"
    }

    fn takes(&self, person: &Person) -> bool {
        let counted = person.counted();
        let q = self.q.trim().to_lowercase();
        let has = |text: &str| text.to_lowercase().contains(&q);
        (self.verdict.is_empty() || person.standing().id() == self.verdict)
            && (!self.is_disputed() || person.is_disputed())
            && (self.mistake.is_empty() || counted.is_some_and(|row| row.mistakes.contains(&self.mistake)))
            && (q.is_empty() || (!self.is_anonymous() && (has(&person.number) || has(&person.name))))
    }

    /// This with one field changed, as the query of an address; everything else but the page stays.
    pub fn with(&self, name: &str, value: &str) -> String {
        let fields = [
            ("verdict", &self.verdict),
            ("mistake", &self.mistake),
            ("q", &self.q),
            ("sort", &self.sort),
            ("anonymous", &self.anonymous),
            ("apart", &self.apart),
            ("disputed", &self.disputed),
        ];
        let kept = fields.into_iter().filter(|(field, kept)| *field != name && !kept.is_empty());
        let pairs = kept.map(|(field, kept)| (field, kept.as_str())).chain([(name, value)]);
        let pairs = pairs.filter(|(_, value)| !value.is_empty());
        let pairs: Vec<String> =
            pairs.map(|(field, value)| format!("{field}={}", utf8_percent_encode(value, NON_ALPHANUMERIC))).collect();
        format!("?{}", pairs.join("&"))
    }
}

/// A column's heading, which leads to the table sorted by it.
pub(super) struct ColumnHeading {
    pub label: &'static str,
    pub href: String,
    /// For `aria-sort`, where the table is sorted by it.
    pub sorted: Option<&'static str>,
    pub is_number: bool,
}

/// The table as a page shows it.
pub(super) struct StudentTable {
    pub headers: Vec<ColumnHeading>,
    pub rows: Vec<StudentLine>,
    pub pager: Pager,
}

/// One line of the table.
pub(super) struct StudentLine {
    pub href: String,
    pub number: String,
    pub name: String,
    pub portrait: Option<String>,
    pub mark: Option<&'static str>,
    pub word: &'static str,
    pub score: String,
    pub max_score: String,
    /// The points before what lateness takes off, and that.
    pub taken: Option<String>,
    /// Title and id.
    pub mistakes: Vec<(String, String)>,
    pub note: String,
    pub is_disputed: bool,
    pub attempts: usize,
    pub at: Option<TimeElement>,
}

impl StudentTable {
    /// The people that a filter takes, the one page of them that it asks for. `people` stand in an order that says nothing
    /// of their names: pseudonyms are numbered by it.
    pub fn of(frame: &PageFrame, people: &[&Person], filter: &TableFilter) -> Self {
        let mut chosen: Vec<(usize, &Person)> =
            people.iter().copied().enumerate().filter(|(_, person)| filter.takes(person)).collect();
        let (falls, id) = match filter.sort.strip_prefix('-') {
            Some(id) => (true, id),
            None => (false, filter.sort.as_str()),
        };
        let sorted = SortColumn::ALL.into_iter().find(|column| column.id() == id);
        if !filter.is_anonymous() {
            chosen.sort_by(|(_, a), (_, b)| by_number(a, b));
        }
        match sorted {
            // An order by names would undo the pseudonyms.
            Some(SortColumn::Student) if filter.is_anonymous() => {}
            Some(column) if falls => chosen.sort_by(|(_, a), (_, b)| column.compare(b, a)),
            Some(column) => chosen.sort_by(|(_, a), (_, b)| column.compare(a, b)),
            // What a teacher must look at comes first.
            None => chosen.sort_by_key(|(_, person)| Reverse(person.standing().is_trouble())),
        }
        let header = |column: SortColumn| {
            let is_sorted = sorted == Some(column);
            let next = if is_sorted { !falls } else { column.falls_first() };
            let order = if next { format!("-{}", column.id()) } else { column.id().to_owned() };
            ColumnHeading {
                label: column.label(frame),
                href: filter.with("sort", &order),
                sorted: is_sorted.then_some(if falls { "descending" } else { "ascending" }),
                is_number: column.is_number(),
            }
        };
        let pager = Pager::new(chosen.len(), &filter.page, |page| filter.with("page", page));
        let rows = pager.of(&chosen).iter().map(|(index, person)| row(frame, filter, *index, person));
        Self { headers: SortColumn::ALL.map(header).into(), rows: rows.collect(), pager }
    }
}

/// Titles and ids of mistakes, in the reader's language.
pub(super) fn titled(frame: &PageFrame, ids: &[String]) -> Vec<(String, String)> {
    ids.iter().map(|id| (frame.mistake_title(id), id.clone())).collect()
}

fn row(frame: &PageFrame, filter: &TableFilter, index: usize, person: &Person) -> StudentLine {
    let counted = person.counted();
    let shown = counted.or(person.rows.first());
    let anonymous = filter.is_anonymous();
    let portrait = counted.filter(|row| row.row.verdict.is_some_and(Verdict::is_drawn));
    let key = utf8_percent_encode(&person.key, NON_ALPHANUMERIC);
    let note = person.note.as_ref().filter(|_| shown.is_none());
    StudentLine {
        href: format!("{}/person?key={key}{}", frame.teacher(), if anonymous { "&anonymous=on" } else { "" }),
        number: if anonymous { frame.pseudonym(index) } else { person.number.clone() },
        name: if anonymous { String::new() } else { person.name.clone() },
        portrait: portrait.map(|row| frame.picture(&row.row.submission.id, "portrait")),
        mark: counted.and_then(|row| Some(Mark::of_verdict(row.row.verdict?, row.row.score.unwrap_or(0.0)).id())),
        word: word(frame, person.standing()),
        score: report_fragment::points(counted.and_then(|row| row.row.total())),
        taken: counted
            .and_then(|row| Some((row.row.score?, row.row.lateness?.penalty)))
            .map(|(score, penalty)| format!("{} − {}", number(score), number(penalty))),
        max_score: report_fragment::points(counted.and_then(|row| row.row.max_score)),
        mistakes: shown.map(|row| titled(frame, &row.mistakes)).unwrap_or_default(),
        is_disputed: person.is_disputed(),
        note: note.map(|note| note.get(frame.language).replace('`', "")).unwrap_or_default(),
        attempts: person.rows.len(),
        at: person.latest().map(|at| frame.datetime(at)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Language, Text};
    use crate::service::classes::samples::person;
    use crate::service::course::Course;
    use axum::http::Uri;

    fn frame() -> PageFrame {
        PageFrame::new(
            Language::Ja,
            Course::default(),
            Uri::from_static("/teacher"),
            reference::assignment("ggsample06").cloned(),
        )
    }

    fn shown(people: &[Person], filter: &TableFilter) -> Vec<String> {
        let people: Vec<&Person> = people.iter().collect();
        StudentTable::of(&frame(), &people, filter).rows.into_iter().map(|row| row.number).collect()
    }

    fn sorted(sort: &str) -> TableFilter {
        TableFilter { sort: sort.to_owned(), ..TableFilter::default() }
    }

    fn class() -> Vec<Person> {
        let mut pdf = person("s3", &[]);
        pdf.note = Some(Text::verbatim("a PDF"));
        vec![
            person("s2", &[(5, 100.0, "")]),
            pdf,
            person("s1", &[(9, 20.0, "gamma unchanged")]),
            person("s4", &[(1, 50.0, ""), (7, 0.0, "")]),
        ]
    }

    #[test]
    fn what_could_not_be_graded_stands_first() {
        assert_eq!(shown(&class(), &TableFilter::default()), ["s3", "s1", "s2", "s4"]);
    }

    #[test]
    fn each_heading_sorts_and_sorts_back() {
        for (sort, order) in [
            ("student", ["s1", "s2", "s3", "s4"]),
            ("-student", ["s4", "s3", "s2", "s1"]),
            ("score", ["s3", "s1", "s4", "s2"]),
            ("-score", ["s2", "s4", "s1", "s3"]),
            ("-attempts", ["s4", "s1", "s2", "s3"]),
            ("-last", ["s1", "s4", "s2", "s3"]),
            ("verdict", ["s2", "s1", "s4", "s3"]),
            ("mistakes", ["s1", "s2", "s3", "s4"]),
        ] {
            assert_eq!(shown(&class(), &sorted(sort)), order, "{sort}");
        }
        let people = class();
        let people: Vec<&Person> = people.iter().collect();
        let filter = TableFilter { q: "s&1".into(), ..sorted("score") };
        let headers = StudentTable::of(&frame(), &people, &filter).headers;
        let score = headers.iter().find(|header| header.sorted.is_some()).expect("the sorted column");
        assert_eq!((score.sorted, score.href.as_str()), (Some("ascending"), "?q=s%261&sort=%2Dscore"));
    }

    #[test]
    fn a_page_has_its_own_rows() {
        let people: Vec<Person> = (0..120).map(|n| person(&format!("s{n:03}"), &[])).collect();
        let page = |page: &str| shown(&people, &TableFilter { page: page.into(), ..TableFilter::default() });
        assert_eq!((page("").len(), page("3").len()), (50, 20));
        assert_eq!((page("2")[0].as_str(), page("9")[0].as_str(), page("x")[0].as_str()), ("s050", "s100", "s000"));
    }

    #[test]
    fn pseudonyms_stay_and_no_order_gives_them_away() {
        let anonymous = TableFilter { anonymous: "on".into(), ..sorted("student") };
        assert_eq!(shown(&class(), &anonymous), ["学生 1", "学生 2", "学生 3", "学生 4"]);
        let by_score = TableFilter { anonymous: "on".into(), ..sorted("-score") };
        assert_eq!(shown(&class(), &by_score), ["学生 1", "学生 4", "学生 3", "学生 2"]);
    }
}
