//! Which answers of a class are alike: the attempt that counts of each, held against those of the class and of whoever is
//! kept beside it: archives, hand-ins without a name, and what the same homework has in other courses, as of earlier terms, in
//! which the one who asks teaches as well.

use super::blocking::blocking;
use super::classes::{People, Person, people};
use super::errors::Problem;
use super::identity::Teacher;
use super::store::Submission;
use super::{Service, State};
use crate::hand_in::HandIn;
use crate::likeness::{Answer, Comparison, Likeness, Pair};
use crate::source::Source;
use axum::http::HeaderMap;
use percent_encoding::{NON_ALPHANUMERIC, utf8_percent_encode};

/// Most pairs that are told.
const MOST: usize = 200;

/// One of two whose answers are alike.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AlikePerson {
    /// What tells them apart, see [`Person::key`].
    pub key: String,
    /// Student number, or what stands for it.
    pub number: String,
    /// Name, where it is known.
    pub name: String,
    /// Id of the submission that was looked at.
    pub submission: String,
    /// Whether they are of the class; others are of an earlier term, or of nobody.
    pub is_of_class: bool,
    /// The course that they are of, where it is another one.
    pub course: Option<OtherCourse>,
}

/// Another course of the service.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OtherCourse {
    /// What its addresses begin with: nothing for the first one.
    pub root: String,
    /// What it is called, or its short name.
    pub title: String,
}

impl OtherCourse {
    /// What names it in the query of an address.
    pub fn query(&self) -> String {
        format!("course={}", utf8_percent_encode(&self.root, NON_ALPHANUMERIC))
    }
}

impl AlikePerson {
    /// The same without what says who it is.
    pub fn nameless(self) -> Self {
        Self { number: String::new(), name: String::new(), ..self }
    }

    /// By what they are called on a page.
    pub fn called(&self) -> String {
        match (self.number.is_empty(), self.name.is_empty()) {
            (false, false) => format!("{} {}", self.number, self.name),
            (false, true) => self.number.clone(),
            (true, false) => self.name.clone(),
            (true, true) => self.submission.get(..8).unwrap_or(&self.submission).to_owned(),
        }
    }
}

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub struct AlikePairs {
    /// How many answers of the class were looked at,
    pub class: usize,
    /// and how many others.
    pub others: usize,
    /// Who is alike, the most alike first.
    pub pairs: Vec<(Pair, [AlikePerson; 2])>,
    /// How many pairs are left out, because there are too many.
    pub left_out: usize,
}

/// Holds the answers of a class against each other, and against what is kept; `headers` say who asks.
pub async fn find(state: &State, headers: &HeaderMap) -> Result<AlikePairs, Problem> {
    let People { class, apart } = people(state).await?;
    let mut members: Vec<AlikePerson> = class.iter().filter_map(|person| member(person, true)).collect();
    let class = members.len();
    members.extend(apart.iter().filter_map(|person| member(person, false)));
    let mut files = files_of(state, &members).await?;
    let mut nameless = Vec::new();
    for (course, teacher) in state.others_of(headers).await? {
        if teacher.may_see(&state.assignment.id) {
            let there = state.in_course(&course);
            let theirs = earlier(&there).await?;
            files.extend(files_of(&there, &theirs).await?);
            members.extend(theirs);
            nameless.extend((!teacher.sees_names()).then(|| course.root().to_owned()));
        }
    }
    let others = members.len() - class;
    let mut pairs = blocking(state, move |state| {
        let likeness = Likeness::of(&state.assignment);
        let answers: Vec<Answer> = files.iter().map(|hand_in| likeness.read(&hand_in.readable())).collect();
        Ok(likeness.pairs(&answers, class))
    })
    .await?;
    // Who takes the course again may hand in what is their own.
    pairs.retain(|pair| !is_repeating(&members[pair.places.0], &members[pair.places.1]));
    let left_out = pairs.len().saturating_sub(MOST);
    pairs.truncate(MOST);
    let shown = |member: &AlikePerson| match &member.course {
        Some(course) if nameless.contains(&course.root) => member.clone().nameless(),
        _ => member.clone(),
    };
    let named = |pair: Pair| {
        let members = [shown(&members[pair.places.0]), shown(&members[pair.places.1])];
        (pair, members)
    };
    Ok(AlikePairs { class, others, pairs: pairs.into_iter().map(named).collect(), left_out })
}

/// What each of these has handed in.
async fn files_of(state: &State, members: &[AlikePerson]) -> Result<Vec<HandIn>, Problem> {
    let mut hand_ins = state.store.hand_ins(&state.assignment.id).await?;
    Ok(members.iter().map(|member| hand_ins.remove(&member.submission).unwrap_or_default()).collect())
}

/// Everybody of another course.
async fn earlier(state: &State) -> Result<Vec<AlikePerson>, Problem> {
    let people = people(state).await?;
    let course = other_course(state).await?;
    let of_there = |person: AlikePerson| AlikePerson { course: Some(course.clone()), ..person };
    Ok(people.all().filter_map(|person| member(person, false)).map(of_there).collect())
}

/// Whether two are one student number in two courses.
fn is_repeating(one: &AlikePerson, other: &AlikePerson) -> bool {
    other.course.is_some() && !one.number.is_empty() && one.number == other.number
}

async fn other_course(service: &Service) -> Result<OtherCourse, Problem> {
    let title = service.store.course().await?.title;
    let id = service.course_id().unwrap_or_default().to_owned();
    Ok(OtherCourse { root: service.root().to_owned(), title: if title.is_empty() { id } else { title } })
}

/// The homework of this class in another course, whose addresses begin with `root`, in which the one who asks teaches as well;
/// the class's own without one.
pub async fn in_course(
    state: &State,
    root: Option<&str>,
    headers: &HeaderMap,
) -> Result<(State, Option<Teacher>), Problem> {
    let Some(root) = root.filter(|root| *root != state.root()) else { return Ok((state.clone(), None)) };
    let mut others = state.others_of(headers).await?.into_iter();
    let found = others.find(|(course, teacher)| course.root() == root && teacher.may_see(&state.assignment.id));
    let (course, teacher) = found.ok_or_else(Problem::not_found)?;
    Ok((state.in_course(&course), Some(teacher)))
}

/// Somebody with the attempt that counts, or the last one while none is graded.
fn member(person: &Person, is_of_class: bool) -> Option<AlikePerson> {
    let row = person.counted().or_else(|| person.rows.first())?;
    Some(with(person, &row.row.submission.id, is_of_class))
}

/// Somebody with one of their submissions.
fn with(person: &Person, submission: &str, is_of_class: bool) -> AlikePerson {
    AlikePerson {
        key: person.key.clone(),
        number: person.number.clone(),
        name: person.name.clone(),
        submission: submission.to_owned(),
        is_of_class,
        course: None,
    }
}

/// Two hand-ins of a homework side by side, each in its course; the names are those that are to be shown.
pub async fn compare(two: [(&State, &str); 2], names: [String; 2]) -> Result<Comparison, Problem> {
    let mut files: Vec<Vec<Source>> = Vec::new();
    let [(own, _), _] = two;
    for (state, id) in two {
        let submission: Submission = state.store.submission(id).await?.ok_or_else(Problem::not_found)?;
        if submission.assignment != state.assignment.id {
            return Err(Problem::not_found());
        }
        files.push(state.store.hand_in(id).await?.unwrap_or_default().readable());
    }
    blocking(own, move |state| {
        let likeness = Likeness::of(&state.assignment);
        let answers: Vec<Answer> = files.iter().map(|sources| likeness.read(sources)).collect();
        let pair = likeness.pair(&answers[0], &answers[1]);
        let sides = likeness.compare((&answers[0], &files[0]), (&answers[1], &files[1]));
        Ok(Comparison { pair, names, sides: sides.into() })
    })
    .await
}

/// Who handed this in; `there` is the teacher in another course, where it is of that.
pub async fn member_of(state: &State, submission: &str, there: Option<&Teacher>) -> Result<AlikePerson, Problem> {
    let People { class, apart } = people(state).await?;
    let all = class.iter().map(|person| (person, true)).chain(apart.iter().map(|person| (person, false)));
    let mut found = all.filter(|(person, _)| person.rows.iter().any(|row| row.row.submission.id == submission));
    let (person, is_of_class) = found.next().ok_or_else(Problem::not_found)?;
    let Some(teacher) = there else { return Ok(with(person, submission, is_of_class)) };
    let of_there = AlikePerson { course: Some(other_course(state).await?), ..with(person, submission, false) };
    Ok(if teacher.sees_names() { of_there } else { of_there.nameless() })
}
