//! A number that the platform says is somebody's, and that somebody holds here who did not come from there. Platforms may let people
//! write their number themselves, so their word is not enough for what another one has handed in: the personal code is asked for, once.

use super::super::clock::{Millis, millis};
use super::super::identity::{check_form, form_token, is_own_page};
use super::super::pages::{PageFrame, shown_number};
use super::super::store::{Platform, StudentRecord};
use super::super::{Service, State};
use super::people::{Described, proved, with_own_number};
use super::{launch, refused};
use crate::service::errors::Problem;
use axum::Form;
use axum::extract::State as Shared;
use axum::http::HeaderMap;
use axum::response::Response;
use base64::prelude::{BASE64_URL_SAFE_NO_PAD, Engine};
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// How long an answer may take.
const PATIENCE: Duration = Duration::from_secs(600);

/// Who asks for which number. It goes to the browser and back, sealed by the token of its form.
#[derive(Debug, Serialize, Deserialize)]
struct NumberClaim {
    platform: String,
    subject: String,
    name: String,
    number: String,
    link: String,
    homework: String,
    until: Millis,
}

/// What the page shows.
#[derive(Debug)]
pub struct HeldNumber {
    /// The number.
    pub number: String,
    /// Where the forms go.
    pub action: String,
    /// Who asks for it.
    pub claim: String,
    /// The token of the forms.
    pub csrf: String,
    /// What is wrong with the last answer.
    pub problem: Option<String>,
}

impl HeldNumber {
    fn of(service: &Service, number: &str, claim: String) -> Self {
        let (csrf, action) = (form_token(service, &claim), format!("{}/lti/number", service.root()));
        Self { number: number.to_owned(), action, claim, csrf, problem: None }
    }
}

/// The form of the page.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct NumberForm {
    claim: String,
    csrf: String,
    wish: String,
    code: String,
}

/// Asks somebody who comes from a platform whether a student is them.
pub(super) fn asked(
    service: &Service,
    frame: PageFrame,
    (platform, link, who): (&Platform, &str, &Described),
    (state, student): (&State, &StudentRecord),
) -> Result<Response, Problem> {
    let claimed = NumberClaim {
        platform: platform.id.clone(),
        subject: who.subject.clone(),
        name: who.name.clone(),
        number: student.number.clone(),
        link: link.to_owned(),
        homework: state.assignment.id.clone(),
        until: service.clock.now() + millis(PATIENCE),
    };
    let claim = serde_json::to_vec(&claimed).map_err(|error| Problem::internal(&error))?;
    shown_number(frame, HeldNumber::of(service, &student.number, BASE64_URL_SAFE_NO_PAD.encode(claim)))
}

/// `POST /lti/number`: takes the answer.
pub async fn answered(
    Shared(service): Shared<Service>,
    headers: HeaderMap,
    frame: PageFrame,
    Form(given): Form<NumberForm>,
) -> Result<Response, Problem> {
    let claimed = claimed(&service, &headers, &given)?;
    let platform = service.store.platform(&claimed.platform).await?.filter(|found| found.is_active == 1);
    let platform = platform.ok_or_else(Problem::not_found)?;
    let state = service.homework(&claimed.homework).ok_or_else(Problem::not_found)?;
    let who = Described { subject: claimed.subject, name: claimed.name, numbers: vec![claimed.number.clone()] };
    let student = match given.wish.as_str() {
        "own" => with_own_number(&service, &platform, &who).await,
        _ => proved(&service, &platform, &who, &given.code).await,
    };
    match student {
        Ok(student) => {
            launch::enter(&service, (&platform, &claimed.link, &who.subject), (&state, student), &headers).await
        }
        Err(problem) if matches!(problem.kind, "code-needed" | "wrong-code") => {
            let said = Some(problem.detail.get(frame.language).to_owned());
            let held = HeldNumber::of(&service, &claimed.number, given.claim);
            let mut page = shown_number(frame, HeldNumber { problem: said, ..held })?;
            *page.status_mut() = problem.status;
            Ok(page)
        }
        Err(problem) => Err(problem),
    }
}

/// Who asks, where the form is one of ours and not old.
fn claimed(service: &Service, headers: &HeaderMap, given: &NumberForm) -> Result<NumberClaim, Problem> {
    let own = if is_own_page(service, headers) { given.csrf.as_str() } else { "" };
    check_form(service, &given.claim, own)?;
    let claim = BASE64_URL_SAFE_NO_PAD.decode(&given.claim).map_err(|error| Problem::internal(&error))?;
    let claimed: NumberClaim = serde_json::from_slice(&claim).map_err(|error| Problem::internal(&error))?;
    match claimed.until > service.clock.now() {
        true => Ok(claimed),
        false => Err(refused(
            "This page is older than ten minutes. Go back and open the homework again.",
            "このページは表示から 10 分を過ぎています。戻って課題を開き直してください。",
        )),
    }
}
