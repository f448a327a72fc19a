//! A course for the next term, made from another one.

use super::super::Service;
use super::super::clock::{Millis, millis};
use super::super::errors::Problem;
use super::super::store::{AssignmentSettings, CoursePlace, LateRules};
use super::{changed, make};
use std::time::Duration;

const DAY: Duration = Duration::from_secs(24 * 3600);

/// Most days by which dates are shifted: ten years.
const MOST_DAYS: i64 = 3660;

/// Makes a course with the homeworks of another one, their order, points, rules and folders; without students, hand-ins and
/// lecturers. `days` shifts every date; without it, the copy has none. Seeds are drawn anew.
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
    let settings = from.store.course().await?;
    let copy = make(first, id, title).await?;
    copy.store.set_course(&settings.titled(title)).await?;
    let shifted = |at: Option<Millis>| Some(at? + millis(DAY) * days?);
    for (homework, folder) in from.store.published().await? {
        let Some(folder) = from.store.folder(&folder).await? else { continue };
        copy.store.add_folder(&folder, &from.store.folder_files(&folder.id).await?, None).await?;
        copy.store.assignment(&homework).await?;
        copy.store.publish(&folder.id, folder.published_at.unwrap_or_else(|| first.clock.now())).await?;
    }
    let mut places = from.store.places().await?;
    let served = from.ids();
    places.retain(|place| served.contains(&place.id));
    for place in &mut places {
        let rules = from.store.assignment(&place.id).await?;
        let own = copy.store.assignment(&place.id).await?;
        let late = rules.late.clone();
        let until = shifted(late.until);
        copy.store
            .set_assignment(&AssignmentSettings {
                seed: own.seed,
                opens_at: shifted(rules.opens_at),
                closes_at: shifted(rules.closes_at),
                late: LateRules { until, ..late },
                ..rules
            })
            .await?;
        *place = in_copy(from, place, shifted(place.shown_from));
    }
    copy.store.set_places(&places).await?;
    changed(&copy).await?;
    Ok(copy)
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
