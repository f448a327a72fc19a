//! Who somebody of a platform is here: a student by their number, or a lecturer with an account.

use super::super::Service;
use super::super::errors::Problem;
use super::super::identity::{check_code, new_id, normal_number, token_hash, vouched_for};
use super::super::store::{Platform, PlatformPerson, RosterLine, StaffMember, StaffRole, StudentRecord};

/// What a platform says of one person.
#[derive(Clone, Debug, Default)]
pub(super) struct Described {
    /// The platform's id of them.
    pub subject: String,
    /// Their name.
    pub name: String,
    /// What may be their student number, the likeliest first.
    pub numbers: Vec<String>,
}

/// The student that somebody of a platform is.
pub(super) enum PlatformStudent {
    /// From now on, as far as the platform goes.
    Theirs(StudentRecord),
    /// By the platform's word alone: somebody holds the number who did not come from there.
    Held(StudentRecord),
}

use PlatformStudent::{Held, Theirs};

/// The student that somebody is: the one they were before, else the one with their number. Of a number that is somebody else's of
/// the same platform they get none, but one that is made of the platform's id. Where there is a roster, they stand on it from now on:
/// the platform knows its courses.
pub(super) async fn student(
    service: &Service,
    platform: &Platform,
    who: &Described,
) -> Result<PlatformStudent, Problem> {
    let store = &service.store;
    let known = store.platform_person(&platform.id, &who.subject).await?;
    if let Some(id) = known.and_then(|person| person.student_id)
        && let Some(student) = store.student_by_id(&id).await?
    {
        if student.is_on_roster() {
            return Ok(Theirs(student));
        }
        // A roster that was imported since then may lack them.
        return Ok(Theirs(store.enrol(&line(&student.number, who), service.clock.now()).await?));
    }
    let mut numbers: Vec<String> = who.numbers.iter().filter_map(|number| normal_number(number)).collect();
    numbers.push(own_number(platform, who));
    // Whoever stands on the roster goes before who has only a likely number.
    let mut chosen = None;
    for number in &numbers {
        if let Some(student) = store.student_by_number(number).await?.filter(StudentRecord::is_on_roster) {
            chosen = Some(student);
            break;
        }
    }
    if let Some(student) = &chosen
        && store.is_taken(&platform.id, &who.subject, &student.id).await?
    {
        chosen = None;
        numbers.drain(..numbers.len() - 1);
    }
    let found = match chosen {
        Some(student) if store.is_held(&student.id).await? => Held(student),
        Some(student) => Theirs(student),
        None => enrolled(service, platform, who, &numbers).await?,
    };
    if let Theirs(student) = &found {
        note(service, platform, who, student).await?;
    }
    Ok(found)
}

/// The number that is made of the platform's id of somebody.
fn own_number(platform: &Platform, who: &Described) -> String {
    format!("LTI-{}", &token_hash(&format!("{} {}", platform.id, who.subject))[..10]).to_uppercase()
}

async fn note(service: &Service, platform: &Platform, who: &Described, student: &StudentRecord) -> Result<(), Problem> {
    let person = PlatformPerson { student_id: Some(student.id.clone()), staff_id: None };
    Ok(service.store.note_person(&platform.id, &who.subject, &person).await?)
}

/// The student whose number somebody has and whose personal code they bring: theirs from now on.
pub(super) async fn proved(
    service: &Service,
    platform: &Platform,
    who: &Described,
    code: &str,
) -> Result<StudentRecord, Problem> {
    let number = who.numbers.first().map(String::as_str).unwrap_or_default();
    let student = service.store.student_by_number(number).await?.ok_or_else(Problem::not_found)?;
    check_code(service, &student, code)?;
    if service.store.is_taken(&platform.id, &who.subject, &student.id).await? {
        return with_own_number(service, platform, who).await;
    }
    let student = service.store.enrol(&line(number, who), service.clock.now()).await?;
    note(service, platform, who, &student).await?;
    Ok(student)
}

/// Somebody as the student with a number that is made of the platform's id.
pub(super) async fn with_own_number(
    service: &Service,
    platform: &Platform,
    who: &Described,
) -> Result<StudentRecord, Problem> {
    let student = service.store.enrol(&line(&own_number(platform, who), who), service.clock.now()).await?;
    note(service, platform, who, &student).await?;
    Ok(student)
}

fn line(number: &str, who: &Described) -> RosterLine {
    RosterLine { number: number.to_owned(), name: who.name.clone(), ..RosterLine::default() }
}

/// A student whom the platform has and the roster has not.
async fn enrolled(
    service: &Service,
    platform: &Platform,
    who: &Described,
    numbers: &[String],
) -> Result<PlatformStudent, Problem> {
    let store = &service.store;
    let own = own_number(platform, who);
    for number in numbers {
        if let Some(student) = store.student_by_number(number).await?
            && *number != own
            && !store.is_taken(&platform.id, &who.subject, &student.id).await?
            && store.is_held(&student.id).await?
        {
            return Ok(Held(student));
        }
        let student = store.enrol(&line(number, who), service.clock.now()).await?;
        if store.is_taken(&platform.id, &who.subject, &student.id).await? {
            continue;
        }
        // A browser that was only the first to give the number has it no more.
        store.renew_code(&student.id).await?;
        return Ok(Theirs(store.student_by_id(&student.id).await?.unwrap_or(student)));
    }
    Err(Problem::internal(&"no student number is free"))
}

/// The account of somebody who teaches in the platform. It has no password: they come by the platform.
pub(super) async fn staff(
    service: &Service,
    platform: &Platform,
    who: &Described,
    role: StaffRole,
) -> Result<StaffMember, Problem> {
    let login = format!("lti-{}", &token_hash(&format!("{} {}", platform.id, who.subject))[..12]);
    let name: String = who.name.chars().filter(|c| !c.is_control()).take(100).collect();
    let member = StaffMember { id: new_id(), login, name, role, has_password: false, is_active: true };
    let member = vouched_for(service, &member).await?.ok_or_else(closed)?;
    let person = PlatformPerson { student_id: None, staff_id: Some(member.id.clone()) };
    service.store.note_person(&platform.id, &who.subject, &person).await?;
    Ok(member)
}

/// Takes the role here from somebody who teaches in the platform's course no more, where they have it by the platform.
pub(super) async fn teaches_no_more(service: &Service, platform: &Platform, subject: &str) -> Result<(), Problem> {
    let known = service.store.platform_person(&platform.id, subject).await?;
    match known.and_then(|person| person.staff_id) {
        Some(id) => Ok(service.store.follow_platform(&id, None).await?),
        None => Ok(()),
    }
}

fn closed() -> Problem {
    super::refused(
        "Your account here is closed. Ask an administrator.",
        "このサービスでのアカウントは停止されています。管理者に問い合わせてください。",
    )
}
