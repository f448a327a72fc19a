//! The teacher: a session's cookie in a browser, or a token in a program.

use super::accounts::in_course;
use super::cookies::{TEACHER_COOKIE, read};
use super::secrets::equal_secrets;
use super::{csrf, token_hash};
use crate::service::Service;
use crate::service::errors::Problem;
use crate::service::requests::route_of;
use crate::service::store::{AccessToken, DeletionTarget, StaffMember, StaffRole, TeacherSession, TokenScope};
use axum::extract::Request;
use axum::http::request::Parts;
use axum::http::{Extensions, HeaderMap, Method, StatusCode, header};

/// A teacher. As an argument of a handler it lets nobody else pass; where the handler is not of one homework, it asks which
/// class they may see. What assistants may not do asks for more: [`LecturerPage`](super::LecturerPage), [`Teacher::check_role`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Teacher {
    /// The session; none for a program.
    session: Option<String>,
    /// Id of the homework whose teacher it is; none for the whole course.
    homework: Option<String>,
    /// Who it is; none with a secret of the whole service or of a homework.
    staff: Option<StaffMember>,
    /// Whether they read names and numbers of students, or pseudonyms.
    sees_names: bool,
    /// What a token of theirs is good for; everything where they come in by another way.
    scope: TokenScope,
}

/// What tells the course link or personal codes. With them one hands in as somebody else, so that a token that only reads does not
/// read them.
const SECRET: [&str; 4] = ["/api/v1/codes", "/teacher/codes", "/teacher/codes/file", "/teacher/settings"];

/// The teacher of a request, as it was found.
#[derive(Clone)]
struct LookedUp(Option<Teacher>);

impl Teacher {
    /// The teacher of a request, where one sends it.
    pub(in crate::service) async fn of(service: &Service, headers: &HeaderMap) -> Result<Option<Self>, Problem> {
        if let Some(secret) = bearer(headers) {
            return Self::of_program(service, secret).await;
        }
        let Some(session) = read(service, headers, TEACHER_COOKIE) else { return Ok(None) };
        let open = service.accounts().session(&token_hash(&session), service.clock.now()).await?;
        let Some(TeacherSession { assignment, staff, .. }) = open else { return Ok(None) };
        // A secret of a homework is for one of the first course.
        if assignment.is_some() && service.is_beside() {
            return Ok(None);
        }
        let staff = match staff {
            Some(member) => match in_course(service, member).await? {
                Some(member) => Some(member),
                None => return Ok(None),
            },
            None => None,
        };
        let sees_names = sees_names(service, staff.as_ref()).await?;
        Ok(Some(Self { session: Some(session), homework: assignment, staff, sees_names, scope: TokenScope::All }))
    }

    /// The same, looked up once for a request however many layers and extractors ask.
    pub(in crate::service) async fn of_request(
        service: &Service,
        headers: &HeaderMap,
        extensions: &mut Extensions,
    ) -> Result<Option<Self>, Problem> {
        if let Some(LookedUp(teacher)) = extensions.get() {
            return Ok(teacher.clone());
        }
        let teacher = Self::of(service, headers).await?;
        extensions.insert(LookedUp(teacher.clone()));
        Ok(teacher)
    }

    /// Whose token this is: the service's, that of a homework, or somebody's own.
    async fn of_program(service: &Service, secret: &str) -> Result<Option<Self>, Problem> {
        if let Some(homework) = of_token(service, secret) {
            let all = TokenScope::All;
            return Ok(Some(Self { session: None, homework, staff: None, sees_names: true, scope: all }));
        }
        let Some((token, owner)) = used_token(service, &token_hash(secret)).await? else { return Ok(None) };
        let account = service.accounts().staff_member(&owner.id).await?.filter(|account| account.is_active);
        let owner = match account {
            Some(account) => in_course(service, account).await?,
            None => None,
        };
        let Some(owner) = owner else { return Ok(None) };
        let sees_names = sees_names(service, Some(&owner)).await?;
        let (homework, scope) = (token.assignment, token.scope);
        Ok(Some(Self { session: None, homework, staff: Some(owner), sees_names, scope }))
    }

    /// Lets a request pass that the token is good for.
    pub(super) fn check_scope(&self, parts: &Parts) -> Result<(), Problem> {
        let hands_in = parts.method == Method::POST && parts.uri.path() == "/api/v1/submissions";
        match self.scope {
            TokenScope::All => Ok(()),
            _ if SECRET.contains(&route_of(parts).as_str()) => Err(beyond_its_scope()),
            _ if parts.method.is_safe() => Ok(()),
            TokenScope::Submit if hands_in => Ok(()),
            TokenScope::Submit | TokenScope::Read => Err(beyond_its_scope()),
        }
    }

    /// Whether they read the secrets by which students hand in.
    pub fn sees_secrets(&self) -> bool {
        self.scope == TokenScope::All
    }

    /// Whether they read names and numbers of students; where not, pages that have these show pseudonyms, and whatever else
    /// names people is not theirs ([`pseudonyms`](super::pseudonyms)).
    pub fn sees_names(&self) -> bool {
        self.sees_names
    }

    /// Who it is; none with a secret of the whole service or of a homework.
    pub fn staff(&self) -> Option<&StaffMember> {
        self.staff.as_ref()
    }

    /// What they may do.
    pub fn role(&self) -> StaffRole {
        match (&self.staff, &self.homework) {
            (Some(member), _) => member.role,
            (None, Some(_)) => StaffRole::Lecturer,
            (None, None) => StaffRole::Administrator,
        }
    }

    /// Lets who may do that much pass.
    pub fn check_role(&self, least: StaffRole) -> Result<(), Problem> {
        if self.role() >= least { Ok(()) } else { Err(not_of_this_role(least)) }
    }

    /// How they came in, for the log of acts.
    pub(in crate::service) fn way(&self) -> &'static str {
        match (&self.staff, &self.session) {
            (Some(_), Some(_)) => "account",
            (None, Some(_)) => "password",
            (_, None) => "token",
        }
    }

    /// Whether they logged in with a secret that others have as well.
    pub fn is_shared(&self) -> bool {
        self.way() == "password"
    }

    /// Id of the homework whose teacher it is; none for the whole course.
    pub fn homework(&self) -> Option<&str> {
        self.homework.as_deref()
    }

    /// Whether they may see the class of a homework.
    pub fn may_see(&self, assignment: &str) -> bool {
        self.homework.as_deref().is_none_or(|own| own == assignment)
    }

    /// Lets who may see the class of a homework pass.
    pub fn check(&self, assignment: &str) -> Result<(), Problem> {
        if self.may_see(assignment) { Ok(()) } else { Err(Problem::not_this_teachers()) }
    }

    /// Whether they are a teacher of the whole course.
    pub fn has_course(&self) -> bool {
        self.homework.is_none()
    }

    /// Lets a teacher of the whole course pass: for what belongs to all its homeworks.
    pub fn check_course(&self) -> Result<(), Problem> {
        if self.has_course() { Ok(()) } else { Err(Problem::not_this_teachers()) }
    }

    /// Lets who may delete this pass, where they may see the homework that it was found in. With somebody goes what they
    /// handed in for every homework.
    pub fn may_delete(&self, target: &DeletionTarget) -> Result<(), Problem> {
        self.check_role(StaffRole::Lecturer)?;
        match target {
            DeletionTarget::Submission(_) | DeletionTarget::Batch(_) | DeletionTarget::Entry(..) => Ok(()),
            DeletionTarget::Student(_) | DeletionTarget::Browser(_) => self.check_course(),
        }
    }

    /// The token of every form on a page for this teacher.
    pub fn csrf(&self, service: &Service) -> String {
        self.session.as_deref().map(|session| csrf::token(service, session)).unwrap_or_default()
    }

    /// Lets a form pass that has this session's token. A program brings its secret itself, which no page can make it do.
    pub fn check_csrf(&self, service: &Service, given: &str) -> Result<(), Problem> {
        self.session.as_deref().map_or(Ok(()), |session| csrf::check(service, session, given))
    }

    pub(super) fn session(&self) -> Option<&str> {
        self.session.as_deref()
    }
}

/// The token with this hash, and its owner: one of this course, or one that the first course gave an administrator for whatever
/// they may do. An administrator is so in every course.
async fn used_token(service: &Service, hash: &str) -> Result<Option<(AccessToken, StaffMember)>, Problem> {
    let now = service.clock.now();
    let own = service.store.use_token(hash, now).await?;
    if own.is_some() || !service.is_beside() {
        return Ok(own);
    }
    let everywhere = |(token, owner): &(AccessToken, StaffMember)| {
        owner.role == StaffRole::Administrator && token.scope == TokenScope::All && token.assignment.is_none()
    };
    Ok(service.accounts().use_token(hash, now).await?.filter(everywhere))
}

/// Whose token this is: the id of a homework, none for the whole course; nothing where it is no teacher's.
pub(super) fn of_token(service: &Service, token: &str) -> Option<Option<String>> {
    if service.teacher_token.as_ref().is_some_and(|secret| equal_secrets(secret, token)) {
        return Some(None);
    }
    let of_homeworks = service.config.homework_tokens.iter();
    of_homeworks.filter(|(_, secret)| equal_secrets(secret, token)).map(|(id, _)| Some(id.clone())).next()
}

/// Whether a request brings a teacher's token, as a program of theirs does.
pub(in crate::service) async fn is_teachers_program(service: &Service, request: &mut Request) -> bool {
    // Who cannot be looked up is counted.
    let headers = request.headers().clone();
    bearer(&headers).is_some()
        && matches!(Teacher::of_request(service, &headers, request.extensions_mut()).await, Ok(Some(_)))
}

/// Whether somebody reads names and numbers of students.
async fn sees_names(service: &Service, member: Option<&StaffMember>) -> Result<bool, Problem> {
    let is_assistant = member.is_some_and(|member| member.role == StaffRole::Assistant);
    Ok(!(is_assistant && service.store.has_pseudonyms().await?))
}

/// The secret of an `Authorization: Bearer`.
pub(in crate::service) fn bearer(headers: &HeaderMap) -> Option<&str> {
    headers.get(header::AUTHORIZATION)?.to_str().ok()?.strip_prefix("Bearer ").map(str::trim)
}

/// The answer to a program whose token is good for less.
fn beyond_its_scope() -> Problem {
    Problem::new(
        StatusCode::FORBIDDEN,
        "scope",
        "This token is not good for that: it has the scope `read` or `submit`. Its owner makes another one at \
         /teacher/tokens.",
        "このトークンの権限（`read` または `submit`）ではこの操作はできません。/teacher/tokens で別のトークンを作成してください。",
    )
}

/// The answer to a teacher who may do less.
fn not_of_this_role(least: StaffRole) -> Problem {
    let (en, ja) = match least {
        StaffRole::Administrator => (
            "Only an administrator may do this. Ask one; the page of the people says who they are.",
            "この操作は管理者だけができます。管理者に依頼してください。",
        ),
        StaffRole::Lecturer | StaffRole::Assistant => (
            "Assistants see the class and its reports; this is for lecturers. Ask one to do it.",
            "アシスタントはクラスと採点結果を閲覧できますが、この操作は担当教員だけができます。担当教員に依頼してください。",
        ),
    };
    Problem::new(StatusCode::FORBIDDEN, "role", en, ja)
}
