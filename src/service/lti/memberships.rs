//! The roster of a platform's course.

use super::super::Service;
use super::super::errors::Problem;
use super::super::identity::normal_number;
use super::super::roster;
use super::super::store::{HomeworkLink, Platform, RosterLine, StudentRecord};
use super::claims::{id, or_none};
use super::next_page::next_page;
use super::people::{Described, PlatformStudent, student, teaches_no_more};
use super::platform::{Connections, Failure, parsed};
use super::{refused, roles};
use reqwest::Method;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What this service may read of people.
pub(super) const SCOPE: &str = "https://purl.imsglobal.org/spec/lti-nrps/scope/contextmembership.readonly";
const KIND: &str = "application/vnd.ims.lti-nrps.v2.membershipcontainer+json";

/// Most pages of a list that are read.
const MOST_PAGES: usize = 100;

#[derive(Deserialize)]
struct Container {
    #[serde(default)]
    members: Vec<PlatformMember>,
}

#[derive(Deserialize)]
struct PlatformMember {
    #[serde(deserialize_with = "id")]
    user_id: String,
    #[serde(default)]
    roles: Vec<String>,
    status: Option<String>,
    #[serde(default, deserialize_with = "or_none")]
    name: Option<String>,
    #[serde(default, deserialize_with = "or_none")]
    given_name: Option<String>,
    #[serde(default, deserialize_with = "or_none")]
    family_name: Option<String>,
    #[serde(default, deserialize_with = "or_none")]
    email: Option<String>,
    #[serde(default, deserialize_with = "or_none")]
    lis_person_sourcedid: Option<String>,
    #[serde(default, deserialize_with = "or_none")]
    ext_user_username: Option<String>,
}

impl PlatformMember {
    fn is_active(&self) -> bool {
        self.status.as_deref().is_none_or(|status| status == "Active")
    }

    fn is_student(&self) -> bool {
        roles::is_learner(&self.roles) && self.is_active()
    }

    fn teaches(&self) -> bool {
        roles::staff_role(&self.roles).is_some() && self.is_active()
    }

    /// Who that is, and their mail address; empty where the platform shares none.
    fn described(self) -> (Described, String) {
        let email = self.email.unwrap_or_default().trim().to_owned();
        let parts = [self.family_name, self.given_name];
        let joined = || parts.iter().flatten().map(String::as_str).collect::<Vec<_>>().join(" ");
        let who = Described {
            name: self.name.clone().filter(|name| !name.trim().is_empty()).unwrap_or_else(joined),
            numbers: [self.lis_person_sourcedid, self.ext_user_username].into_iter().flatten().collect(),
            subject: self.user_id,
        };
        (who, email)
    }
}

/// What came of fetching a roster.
#[derive(Clone, Copy, Debug, Serialize, utoipa::ToSchema)]
pub struct FetchedRoster {
    /// Students whom the platform lists in its course.
    pub students: usize,
    /// Students who are on the roster now.
    pub on_roster: usize,
}

/// Takes everybody who is a student in a platform's course onto the roster; who stands there already stays. Whom the list has and who teaches there no more loses the role that they have by the platform.
pub async fn import(service: &Service, platform: &Platform, link: &HomeworkLink) -> Result<FetchedRoster, Problem> {
    let failed = |failure: Failure| {
        tracing::warn!(failure, "the roster of a platform");
        refused(
            format!("The learning platform did not give its roster: {failure}. The roster was not changed."),
            format!("学習プラットフォームから名簿を取得できませんでした: {failure}。名簿は変更していません。"),
        )
    };
    let address = link.memberships.clone().ok_or_else(|| failed("the link has none".to_owned()))?;
    let members = fetched(service, platform, address).await.map_err(failed)?;
    for member in members.iter().filter(|member| !member.teaches()) {
        teaches_no_more(service, platform, &member.user_id).await?;
    }
    let students: Vec<(Described, String)> =
        members.into_iter().filter(PlatformMember::is_student).map(PlatformMember::described).collect();
    if students.is_empty() {
        return Err(failed("it has no students".to_owned()));
    }
    let before = service.store.roster().await?;
    let mut lines: BTreeMap<String, RosterLine> =
        before.into_iter().map(|student| (student.number.clone(), line(student))).collect();
    for (who, email) in &students {
        // Whoever has a number is matched by it; the others get one that is made of the platform's id.
        // Who holds the number of one of them by another way stands on the roster, and is asked for the code when they come.
        let (PlatformStudent::Theirs(student) | PlatformStudent::Held(student)) =
            student(service, platform, who).await?;
        service.store.note_member_of_link(&platform.id, &link.link_id, &who.subject).await?;
        let is_own = who.numbers.iter().filter_map(|number| normal_number(number)).any(|n| n == student.number);
        // A platform may share no names: it takes none away by that.
        let is_named = !who.name.trim().is_empty() && (is_own || student.name.is_empty());
        let name = if is_named { who.name.clone() } else { student.name.clone() };
        // What a file of the teacher's says goes before.
        let email = if student.email.is_empty() { email.clone() } else { student.email.clone() };
        lines.insert(student.number.clone(), RosterLine { name, email, ..line(student) });
    }
    let lines: Vec<RosterLine> = lines.into_values().collect();
    roster::import(service, &lines).await?;
    Ok(FetchedRoster { students: students.len(), on_roster: lines.len() })
}

fn line(student: StudentRecord) -> RosterLine {
    RosterLine {
        number: student.number,
        name: student.name,
        moodle: student.moodle.map(i64::unsigned_abs),
        group: student.group_name,
        email: student.email,
    }
}

/// Every page of the list.
async fn fetched(service: &Service, platform: &Platform, first: String) -> Result<Vec<PlatformMember>, Failure> {
    let mut members = Vec::new();
    let mut address = first;
    for _ in 0..MOST_PAGES {
        let response = Connections::call(service, platform, SCOPE, (Method::GET, &address, KIND), None).await?;
        let next = next_page(&address, response.headers())?;
        let container: Container = parsed(&address, response).await?;
        members.extend(container.members);
        match next {
            Some(next) => address = next,
            None => return Ok(members),
        }
    }
    Err(format!("{address}: the list has more than {MOST_PAGES} pages"))
}
