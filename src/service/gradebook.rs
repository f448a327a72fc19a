//! The gradebook of a course: everybody with what they have in each homework, and together.

use super::classes::people;
use super::courses;
use super::download;
use super::errors::Problem;
use super::{Service, State};
use crate::class::formats::plain::cell;
use crate::language::Language;
use axum::response::Response;
use std::collections::BTreeMap;

/// The gradebook.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Gradebook {
    /// The homeworks in the order of the course.
    pub homeworks: Vec<HomeworkColumn>,
    /// Everybody of the class who has a student number, by it.
    pub lines: Vec<GradebookPerson>,
}

/// A homework in it.
#[derive(Clone, Debug, PartialEq)]
pub struct HomeworkColumn {
    /// Id.
    pub id: String,
    /// Title.
    pub title: String,
    /// What it counts in the course.
    pub points: f64,
}

/// One person.
#[derive(Clone, Debug, PartialEq)]
pub struct GradebookPerson {
    /// Student number.
    pub number: String,
    /// Name.
    pub name: String,
    /// Points in each homework; none where nothing is graded.
    pub points: Vec<Option<f64>>,
}

impl GradebookPerson {
    /// Points of the course; 0 and not -0 for who has none.
    pub fn total(&self) -> f64 {
        self.points.iter().flatten().fold(0.0, |sum, points| sum + points)
    }
}

impl Gradebook {
    /// Most points of the course.
    pub fn most(&self) -> f64 {
        self.homeworks.iter().fold(0.0, |sum, homework| sum + homework.points)
    }

    /// The gradebook of a course as it stands: of everybody the attempt that counts, with what lateness takes off.
    pub async fn of(service: &Service, language: Language) -> Result<Self, Problem> {
        let places = service.store.places().await?;
        let states: Vec<State> = service.homeworks().collect();
        let mut homeworks = Vec::new();
        let mut lines: BTreeMap<String, GradebookPerson> = BTreeMap::new();
        for (index, state) in states.iter().enumerate() {
            let id = state.assignment.id.clone();
            let points = courses::points(&places, &state.assignment);
            homeworks.push(HomeworkColumn { id, title: language.of(&state.assignment.title).to_owned(), points });
            // Whoever gave no number is nobody whose homeworks could be put together.
            for person in people(state).await?.class.into_iter().filter(|person| !person.number.is_empty()) {
                let graded = person.counted().and_then(|it| Some((it.row.total()?, it.row.max_score?)));
                let line = lines.entry(person.number.clone()).or_insert_with(|| GradebookPerson {
                    number: person.number.clone(),
                    name: person.name.clone(),
                    points: vec![None; states.len()],
                });
                line.points[index] = graded.map(|(score, most)| if most > 0.0 { score / most * points } else { 0.0 });
            }
        }
        Ok(Self { homeworks, lines: lines.into_values().collect() })
    }

    /// The same as a file to be saved.
    pub fn file(&self, name: &str) -> Result<Response, Problem> {
        Ok(download::saved(name, "text/csv; charset=utf-8", self.csv()?))
    }

    /// The same for a spreadsheet. Under the ids of the homeworks stand their most points; a cell where nothing is graded is empty.
    pub fn csv(&self) -> Result<Vec<u8>, Problem> {
        let row = |who: [String; 2], points: Vec<String>, total: String| {
            who.into_iter().chain(points).chain([total]).collect::<Vec<String>>()
        };
        let ids = self.homeworks.iter().map(|homework| cell(&homework.id)).collect();
        let most = self.homeworks.iter().map(|homework| rounded(homework.points)).collect();
        let of_line = |line: &GradebookPerson| {
            let points = line.points.iter().map(|points| points.map(rounded).unwrap_or_default()).collect();
            row([&line.number, &line.name].map(|text| cell(text)), points, rounded(line.total()))
        };
        let heading = row(["student", "name"].map(str::to_owned), ids, "total".to_owned());
        let most = row([String::new(), String::new()], most, rounded(self.most()));
        download::csv([heading, most].into_iter().chain(self.lines.iter().map(of_line)))
    }
}

/// Points with two digits at most.
pub fn rounded(points: f64) -> String {
    crate::report::text::number((points * 100.0).round() / 100.0)
}
