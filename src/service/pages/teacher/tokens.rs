//! Tokens for programs: one's own, and for administrators everybody's.

use super::super::datetime::TimeElement;
use super::super::frame::PageFrame;
use super::super::shown;
use super::{Tab, refused, said_of};
use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::errors::Problem;
use crate::service::identity::{
    LONGEST_DAYS, Teacher, TeacherPage, WantedToken, check_wanted_scope, end_token, make_token, tokens_for,
};
use crate::service::store::{OwnedToken, TokenScope};
use askama::Template;
use axum::Form;
use axum::extract::{Path, State as Shared};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;

/// How long a token holds where nobody says otherwise, in days: a term.
const USUAL_DAYS: u32 = 180;

#[derive(Template)]
#[template(path = "service/pages/templates/tokens.html")]
struct TokensPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    /// Whether this is somebody with an account, who may make one.
    may_make: bool,
    scopes: Vec<(&'static str, &'static str)>,
    homeworks: Vec<String>,
    longest: u32,
    tokens: Vec<TokenLine>,
    typed: NewToken,
    problem: Option<String>,
    /// A token that was just made: its name, and its secret.
    made: Option<(String, String)>,
}

/// A token of the list.
struct TokenLine {
    id: String,
    name: String,
    owner: String,
    scope: &'static str,
    homework: String,
    until: TimeElement,
    used: Option<TimeElement>,
}

/// The form of a new token.
#[derive(Debug, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct NewToken {
    csrf: String,
    name: String,
    scope: String,
    assignment: String,
    days: String,
}

impl Default for NewToken {
    fn default() -> Self {
        let nothing = String::new;
        Self { csrf: nothing(), name: nothing(), scope: nothing(), assignment: nothing(), days: USUAL_DAYS.to_string() }
    }
}

/// The form that ends a token.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct Ended {
    csrf: String,
}

const SCOPES: [TokenScope; 3] = [TokenScope::Read, TokenScope::Submit, TokenScope::All];

fn word(scope: TokenScope) -> &'static str {
    match scope {
        TokenScope::Read => "read",
        TokenScope::Submit => "submit",
        TokenScope::All => "all",
    }
}

fn scope_name(frame: &PageFrame, scope: TokenScope) -> &'static str {
    match scope {
        TokenScope::Read => frame.say("read", "閲覧"),
        TokenScope::Submit => frame.say("read, and hand in for students", "閲覧と、学生の代わりの提出"),
        TokenScope::All => frame.say("whatever I may do", "自分にできる操作すべて"),
    }
}

impl NewToken {
    fn wanted(&self) -> WantedToken {
        let scope = SCOPES.into_iter().find(|scope| word(*scope) == self.scope);
        WantedToken {
            name: self.name.clone(),
            scope: scope.unwrap_or(TokenScope::Read),
            assignment: Some(self.assignment.clone()).filter(|id| !id.is_empty()),
            // What is no number is out of the range, and told so.
            days: self.days.trim().parse().unwrap_or(0),
        }
    }
}

fn line(frame: &PageFrame, OwnedToken { token, login }: OwnedToken) -> TokenLine {
    TokenLine {
        scope: scope_name(frame, token.scope),
        homework: token.assignment.unwrap_or_default(),
        until: frame.datetime(token.expires_at),
        used: token.last_used_at.map(|at| frame.datetime(at)),
        id: token.id,
        name: token.name,
        owner: login,
    }
}

/// What the page says of a form that was sent.
#[derive(Default)]
struct TokensNotice {
    typed: NewToken,
    problem: Option<String>,
    made: Option<(String, String)>,
}

async fn view(service: &Service, frame: PageFrame, teacher: &Teacher, said: TokensNotice) -> Result<Response, Problem> {
    let tokens = tokens_for(service, teacher).await?;
    let offered = SCOPES.into_iter().filter(|scope| check_wanted_scope(teacher, *scope).is_ok());
    shown(
        TokensPage {
            place: Tab::Tokens,
            csrf: teacher.csrf(service),
            may_make: teacher.staff().is_some(),
            scopes: offered.map(|scope| (word(scope), scope_name(&frame, scope))).collect(),
            homeworks: service.ids(),
            longest: LONGEST_DAYS,
            tokens: tokens.into_iter().map(|owned| line(&frame, owned)).collect(),
            typed: said.typed,
            problem: said.problem,
            made: said.made,
            frame,
        }
        .render(),
    )
}

/// `GET /teacher/tokens`.
pub(in crate::service::pages) async fn page(
    Shared(service): Shared<Service>,
    TeacherPage(teacher): TeacherPage,
    frame: PageFrame,
) -> Result<Response, Problem> {
    view(&service, frame, &teacher, TokensNotice::default()).await
}

/// `POST /teacher/tokens`: makes one; the answer is the only page that shows it.
pub(in crate::service::pages) async fn make(
    Shared(service): Shared<Service>,
    TeacherPage(teacher): TeacherPage,
    frame: PageFrame,
    Form(typed): Form<NewToken>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&service, &typed.csrf)?;
    match make_token(&service, &teacher, typed.wanted()).await {
        Ok((token, secret)) => {
            let detail = Detail::of(format!("+ {} ({})", token.name, word(token.scope)));
            let detail = Detail { assignment: token.assignment, ..detail };
            let said = TokensNotice { made: Some((token.name, secret)), ..TokensNotice::default() };
            Ok(detail.on(view(&service, frame, &teacher, said).await?))
        }
        Err(problem) => {
            let said = TokensNotice { typed, problem: Some(said_of(problem, &frame)?), made: None };
            Ok(refused(view(&service, frame, &teacher, said).await?, StatusCode::UNPROCESSABLE_ENTITY))
        }
    }
}

/// `POST /teacher/tokens/{id}`: ends one.
pub(in crate::service::pages) async fn end(
    Shared(service): Shared<Service>,
    TeacherPage(teacher): TeacherPage,
    Path(id): Path<String>,
    Form(ended): Form<Ended>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&service, &ended.csrf)?;
    let ended = end_token(&service, &teacher, &id).await?;
    Ok(ended.detail().on(Redirect::to("/teacher/tokens").into_response()))
}
