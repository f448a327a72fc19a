//! What a course sets once for all its homework: its title, the time zone of its dates, and the language in which it speaks to
//! students. All are settings of the teacher's, and neither is the machine's.

use super::errors::Problem;
use super::store::{Result as StoreResult, Store, word};
use super::texts::check_length;
use crate::language::Language;
use jiff::tz::TimeZone;
use serde::{Deserialize, Serialize};

/// Name of the setting that holds the course.
const SETTING: &str = "course";

/// Where the lecture is held, until a teacher says otherwise.
const USUAL_ZONE: &str = "Asia/Tokyo";

/// Longest title of a course, in characters.
const LONGEST_TITLE: usize = 100;

/// The course.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Course {
    zone: TimeZone,
    /// Language of what students receive through other systems: comments, feedback files, results. A page is in its
    /// reader's language.
    pub language: Language,
    /// What it is called; empty where nobody said.
    pub title: String,
}

/// The course as it is stored.
#[derive(Serialize, Deserialize)]
struct StoredCourse {
    zone: String,
    language: Language,
    #[serde(default)]
    title: String,
}

impl Default for Course {
    fn default() -> Self {
        Self::new(USUAL_ZONE, Language::Ja).unwrap_or(Self {
            zone: TimeZone::UTC,
            language: Language::Ja,
            title: String::new(),
        })
    }
}

impl Course {
    /// A course in the time zone with this name of the tz database; none where there is no such zone.
    pub fn new(zone: &str, language: Language) -> Option<Self> {
        let zone = TimeZone::get(zone.trim()).ok().filter(|zone| zone.iana_name().is_some())?;
        Some(Self { zone, language, title: String::new() })
    }

    /// The course in the words of the log of acts. The title is last: it says whatever somebody wrote.
    pub fn described(&self) -> [(&'static str, String); 3] {
        [("zone", self.zone_name().to_owned()), ("language", word(&self.language)), ("title", self.title.clone())]
    }

    /// The same with a title, without what is in no title; a problem where it is too long.
    pub fn titled(mut self, title: &str) -> Result<Self, Problem> {
        check_length(title, LONGEST_TITLE, ("The title", "授業名"))?;
        self.title = title.trim().chars().filter(|c| !c.is_control()).collect();
        Ok(self)
    }

    /// The time zone of every date that is shown or typed.
    pub fn zone(&self) -> &TimeZone {
        &self.zone
    }

    /// Its name, such as `Asia/Tokyo`.
    pub fn zone_name(&self) -> &str {
        self.zone.iana_name().unwrap_or("UTC")
    }
}

/// The names of every time zone, for a list to choose from.
pub fn zone_names() -> Vec<String> {
    let mut names: Vec<String> = jiff::tz::db().available().map(|name| name.to_string()).collect();
    // The others are aliases and zones of machines (`posix/…`, `Etc/…`, `EST5EDT`).
    names.retain(|name| name == "UTC" || (name.contains('/') && name.starts_with(|c: char| c.is_ascii_uppercase())));
    names.retain(|name| !name.starts_with("Etc/") && !name.starts_with("SystemV/"));
    names.sort_unstable();
    names.dedup();
    names
}

impl Store {
    /// The course as the teacher set it.
    pub async fn course(&self) -> StoreResult<Course> {
        let Some(json) = self.setting(SETTING).await? else { return Ok(Course::default()) };
        let StoredCourse { zone, language, title } = serde_json::from_str(&json)?;
        // A machine without this zone shows the instant itself rather than no page at all.
        let zone = Course::new(&zone, language).map_or(TimeZone::UTC, |course| course.zone);
        Ok(Course { zone, language, title })
    }

    /// Sets the course.
    pub async fn set_course(&self, course: &Course) -> StoreResult<()> {
        let zone = course.zone_name().to_owned();
        let stored = StoredCourse { zone, language: course.language, title: course.title.clone() };
        self.set_setting(SETTING, &serde_json::to_string(&stored)?).await?;
        self.keep_zone(course.zone()).await
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_zone_is_one_of_the_tz_database() {
        let named = |zone: &str| Course::new(zone, Language::En).map(|course| course.zone_name().to_owned());
        assert_eq!(named(" Asia/Tokyo ").as_deref(), Some("Asia/Tokyo"));
        assert_eq!(named("Europe/Berlin").as_deref(), Some("Europe/Berlin"));
        for wrong in ["", "Tokyo", "Asia/Nowhere", "+09:00", "JST-9", "../../etc/passwd"] {
            assert_eq!(named(wrong), None, "{wrong}");
        }
        assert_eq!(Course::default().zone_name(), "Asia/Tokyo");
    }

    #[test]
    fn every_zone_of_the_list_can_be_chosen() {
        let names = zone_names();
        assert!(names.len() > 300 && names.iter().any(|name| name == "Asia/Tokyo"), "{}", names.len());
        for name in &names {
            assert!(Course::new(name, Language::Ja).is_some(), "{name}");
        }
    }
}
