//! A course for the next term, made from another one.

use super::super::Service;
use super::super::blocking::to_its_end;
use super::super::clock::{Millis, days_later};
use super::super::course::Course;
use super::super::errors::Problem;
use super::super::store::{AssignmentSettings, CoursePlace, LateRules, Result as StoreResult, Store, UploadedFolder};
use super::filled;
use reference::Folder;

/// Most days by which dates are shifted: ten years.
const MOST_DAYS: i64 = 3660;

/// Makes a course with the homeworks of another one, their order, points, rules and folders; without students, hand-ins and
/// lecturers. `days` of the calendar shift every date, which keeps its time of day; without them, the copy has none. Seeds are drawn
/// anew.
pub async fn copy(
    first: &Service,
    from: &Service,
    (id, title): (&str, &str),
    days: Option<i64>,
) -> Result<Service, Problem> {
    if days.is_some_and(|days| days.abs() > MOST_DAYS) {
        return Err(Problem::unprocessable(
            format!("Dates are shifted by {MOST_DAYS} days at most."),
            format!("日時をずらせるのは {MOST_DAYS} 日までです。"),
        ));
    }
    // All is read before the course is begun: while its tables are filled, nothing else is written into the first course's.
    let zone = from.store.course().await?.zone().clone();
    let source = CourseCopy::read(from, |at| Some(days_later(at?, days?, &zone))).await?;
    let (first, id, title) = (first.clone(), id.to_owned(), title.to_owned());
    let now = first.clock.now();
    to_its_end(async move { filled(&first, &id, async |tables| source.write(tables, &title, now).await).await }).await
}

/// What a copy takes of a course, with the dates of the copy.
struct CourseCopy {
    course: Course,
    folders: Vec<(UploadedFolder, Folder)>,
    rules: Vec<AssignmentSettings>,
    places: Vec<CoursePlace>,
}

impl CourseCopy {
    async fn read(from: &Service, shifted: impl Fn(Option<Millis>) -> Option<Millis>) -> StoreResult<Self> {
        let mut folders = Vec::new();
        for (_, id) in from.store.published().await? {
            let Some(folder) = from.store.folder(&id).await? else { continue };
            folders.push((folder, from.store.folder_files(&id).await?));
        }
        let mut places = from.store.places().await?;
        let served = from.ids();
        places.retain(|place| served.contains(&place.id));
        let mut rules = Vec::new();
        for place in &mut places {
            let own = from.store.assignment(&place.id).await?;
            let until = shifted(own.late.until);
            rules.push(AssignmentSettings {
                opens_at: shifted(own.opens_at),
                closes_at: shifted(own.closes_at),
                late: LateRules { until, ..own.late.clone() },
                ..own
            });
            *place = in_copy(from, place, shifted(place.shown_from));
        }
        Ok(Self { course: from.store.course().await?, folders, rules, places })
    }

    /// Writes it into the tables of a new course.
    async fn write(self, tables: &Store, title: &str, now: Millis) -> Result<(), Problem> {
        tables.set_course(&self.course.titled(title)?).await?;
        for (folder, files) in &self.folders {
            tables.add_folder(folder, files, None).await?;
            tables.assignment(&folder.assignment).await?;
            tables.publish(&folder.id, folder.published_at.unwrap_or(now)).await?;
        }
        for rules in self.rules {
            let seed = tables.assignment(&rules.id).await?.seed;
            tables.set_assignment(&AssignmentSettings { seed, ..rules }).await?;
        }
        Ok(tables.set_places(&self.places).await?)
    }
}

/// The place of a homework in the copy: there it stands where it stood, and what came with the command line is chosen. What was to
/// be shown at a date that is taken away is hidden.
fn in_copy(from: &Service, place: &CoursePlace, shown_from: Option<Millis>) -> CoursePlace {
    let position = from.ids().iter().position(|id| *id == place.id).and_then(|index| i64::try_from(index).ok());
    let is_hidden = place.is_hidden != 0 || (place.shown_from.is_some() && shown_from.is_none());
    let is_named = from.named_as(&place.id).is_some();
    CoursePlace {
        is_chosen: i64::from(is_named),
        position,
        is_hidden: i64::from(is_hidden),
        shown_from,
        ..place.clone()
    }
}
