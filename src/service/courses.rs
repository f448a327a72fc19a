//! The courses of a service.
//!
//! The first course is the service's own database: it has everything that a service of one course had, at the same addresses.
//! Every other course is a [`Service`] of its own with tables of its own, below `/c/COURSE`: its own homeworks, roster, course link,
//! codes, settings, log and learning platforms. Nothing of one course can be found by way of another, because no statement reaches
//! two of them. What the courses share is what grades, the accounts of who teaches ([`Service::accounts`]), and the queue's graders.

mod archived;
mod copy;
mod plan;
mod way;

pub use archived::archived;
pub(super) use archived::keep;
pub use copy::copy;
pub use plan::{CoursePlan, arrange, points, reread, set_places, too_many};
pub(super) use way::{answer, within};
pub use way::{at, public_address, root, root_of};

use super::blocking::to_its_end;
use super::errors::Problem;
use super::identity::Teacher;
use super::store::{Result as StoreResult, Store, StoredSubmission};
use super::{Service, app, grading};
use axum::Router;
use axum::http::HeaderMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Longest id of a course.
const LONGEST_ID: usize = 32;

/// Most courses beside the first one that a service has: each has connections of its own.
const MOST_COURSES: usize = 64;

/// The courses beside the first one that are open in this process.
#[derive(Debug, Default)]
pub struct Courses(Mutex<Vec<OpenCourse>>);

#[derive(Clone, Debug)]
struct OpenCourse {
    id: String,
    service: Service,
    routes: Router,
}

impl Courses {
    fn open(&self) -> MutexGuard<'_, Vec<OpenCourse>> {
        // Nothing in here is left half done by a panic.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Whether this can be the id of a course: it stands in addresses, and names a file or a schema.
pub fn is_id(text: &str) -> bool {
    let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    !text.is_empty() && text.len() <= LONGEST_ID && text.chars().all(is_plain) && !text.starts_with('-')
}

/// What the addresses of the course with this id begin with.
pub(super) fn root_of_id(id: &str) -> String {
    format!("/c/{id}")
}

impl Service {
    /// This course, and the others where it is the first one.
    pub fn everywhere(&self) -> Vec<Self> {
        let others = self.courses.open();
        std::iter::once(self.clone()).chain(others.iter().map(|open| open.service.clone())).collect()
    }

    /// The courses of the service beside this one in which somebody teaches, with them as they are known there.
    pub async fn others_of(&self, headers: &HeaderMap) -> Result<Vec<(Self, Teacher)>, Problem> {
        let mut others = Vec::new();
        for course in self.first_course().iter().flat_map(Self::everywhere).filter(|course| course.root != self.root) {
            if let Some(teacher) = Teacher::of(&course, headers).await? {
                others.push((course, teacher));
            }
        }
        Ok(others)
    }

    /// The course with this id beside the first one.
    pub fn course(&self, id: &str) -> Option<Self> {
        self.courses.open().iter().find(|open| open.id == id).map(|open| open.service.clone())
    }

    /// The course with this id; the empty one is this one.
    pub fn course_or_this(&self, id: &str) -> Option<Self> {
        if id.is_empty() { Some(self.clone()) } else { self.course(id) }
    }

    /// Id of the course; none for the first one.
    pub fn course_id(&self) -> Option<&str> {
        self.root.strip_prefix("/c/")
    }
}

/// Opens the courses that are not open in this process yet.
pub(super) async fn follow(first: &Service) -> StoreResult<()> {
    for id in first.store.courses().await? {
        if first.course(&id).is_none() {
            let service = first.beside(&id).await?;
            grading::take_over(&service).await?;
            let open = OpenCourse { id, routes: app(service.clone()), service };
            let mut courses = first.courses.open();
            if courses.iter().all(|known| known.id != open.id) {
                courses.push(open);
            }
        }
    }
    Ok(())
}

/// The course of a submission, where a graders' process has only its id, and the submission.
pub(super) async fn holding(first: &Service, id: &str) -> StoreResult<Option<(Service, StoredSubmission)>> {
    for course in first.everywhere() {
        if let Some(stored) = course.store.stored(id).await? {
            return Ok(Some((course, stored)));
        }
    }
    Ok(None)
}

/// Makes a course without homeworks, students and lecturers.
pub async fn make(first: &Service, id: &str, title: &str) -> Result<Service, Problem> {
    let settings = first.store.course().await?.titled(title)?;
    let (first, id) = (first.clone(), id.to_owned());
    to_its_end(async move { filled(&first, &id, async |tables| Ok(tables.set_course(&settings).await?)).await }).await
}

/// Makes a course whose tables `fill` fills. Nobody sees it before they are filled: where that fails, there is no course.
async fn filled(
    first: &Service,
    id: &str,
    fill: impl AsyncFnOnce(&Store) -> Result<(), Problem>,
) -> Result<Service, Problem> {
    let id = id.trim();
    if !is_id(id) {
        return Err(Problem::unprocessable(
            format!("The short name of a course has 1 to {LONGEST_ID} small letters, digits or `-`, such as cg-2027."),
            format!("授業の短い名前は {LONGEST_ID} 文字以内の英小文字、数字、`-` で入力してください（例: cg-2027）。"),
        ));
    }
    let turn = first.course_turn.acquire().await;
    let known = first.store.courses().await?;
    if known.iter().any(|known| known == id) {
        return Err(is_there(id));
    }
    if known.len() >= MOST_COURSES {
        return Err(Problem::unprocessable(
            format!("A service has at most {MOST_COURSES} courses beside the first. Start another service."),
            format!(
                "1 つのサービスで扱える授業は、最初の授業のほかに {MOST_COURSES} 個までです。サービスを分けてください。"
            ),
        ));
    }
    let tables = first.store.open_course(id).await?;
    let made = first.store.add_course(id, first.clock.now(), async || {
        if tables.forget_unfinished().await? { fill(&tables).await } else { Err(still_there(id)) }
    });
    let made = made.await;
    tables.close().await;
    drop((tables, turn));
    if !made? {
        return Err(is_there(id));
    }
    follow(first).await?;
    let course = first.course(id).ok_or_else(|| Problem::internal(&"a course that was made is not open"))?;
    grading::folders_changed(first).await;
    grading::files_wait(&course).await;
    Ok(course)
}

fn is_there(id: &str) -> Problem {
    Problem::unprocessable(
        format!("There is a course `{id}` already. Choose another short name."),
        format!("「{id}」という授業はすでにあります。別の短い名前にしてください。"),
    )
}

/// The refusal to write over the data of a course that the service does not know any more, as after a backup was put back.
fn still_there(id: &str) -> Problem {
    Problem::unprocessable(
        format!("The database still has people or hand-ins of an earlier course `{id}`. Choose another short name."),
        format!("以前の授業「{id}」の名簿や提出がデータベースに残っています。別の短い名前にしてください。"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_names_a_file_and_a_schema() {
        for right in ["cg-2027", "a", "7"] {
            assert!(is_id(right), "{right}");
        }
        for wrong in ["", "CG", "a b", "../x", "a_b", "a.b", "-a", "日本", &"x".repeat(33)] {
            assert!(!is_id(wrong), "{wrong}");
        }
    }
}
