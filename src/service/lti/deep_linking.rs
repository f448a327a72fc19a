//! A lecturer chooses in the platform's course which homework a link is for.

use super::super::Service;
use super::super::courses;
use super::super::identity::new_id;
use super::super::pages::PageFrame;
use super::super::store::{Platform, StaffRole};
use super::claims::{Claims, DeepLinking};
use super::keys::{issued_at, sign};
use super::launch::HOMEWORK;
use super::platform::checked;
use super::{address, refused};
use crate::service::errors::Problem;
use serde_json::{Value, json};

/// How long a choice holds, in seconds.
const HOUR: i64 = 3600;

/// The most points of a column that a platform takes without being set up for more, as Moodle's `gradepointmax`.
const USUAL_MOST: f64 = 100.0;

/// Whether every platform takes a column of so many points: Moodle's form wants a whole number.
fn is_usual(points: f64) -> bool {
    (1.0..=USUAL_MOST).contains(&points) && points.fract() == 0.0
}

/// The homeworks to choose from.
#[derive(Debug)]
pub struct HomeworkChoice {
    /// Where the choice goes.
    pub action: String,
    /// The site of that, for the policy of the page.
    pub origin: String,
    /// Title, and the signed answer that chooses it.
    pub homeworks: Vec<(String, String)>,
    /// The signed answer that chooses all of them, where the platform takes several.
    pub all: Option<String>,
}

/// What is offered to somebody who teaches.
pub(super) async fn offer(
    service: &Service,
    platform: &Platform,
    claims: &Claims,
    frame: &PageFrame,
) -> Result<HomeworkChoice, Problem> {
    if claims.staff_role() != Some(StaffRole::Lecturer) {
        return Err(refused("Only lecturers choose a homework.", "課題を選択できるのは担当教員だけです。"));
    }
    let wanted = claims.deep_linking.clone().ok_or_else(|| {
        refused("The platform does not say where the choice goes.", "選択結果の送信先が示されていません。")
    })?;
    let action = checked(&wanted.deep_link_return_url).map_err(|why| refused(why.en, why.ja))?;
    let own = address(service)?;
    let places = service.store.places().await?;
    let (mut titles, mut items) = (Vec::new(), Vec::new());
    for state in service.homeworks() {
        let title = frame.language.of(&state.assignment.title).to_owned();
        let points = courses::points(&places, &state.assignment);
        let most = if is_usual(points) { points } else { USUAL_MOST };
        items.push(json!({
            "type": "ltiResourceLink",
            "title": title,
            "url": format!("{own}{}", state.place()),
            "custom": { HOMEWORK: state.assignment.id },
            "lineItem": { "scoreMaximum": most, "label": title, "resourceId": state.assignment.id },
        }));
        titles.push(title);
    }
    let answer =
        async |items: &[Value]| sign(service, platform, &answer(service, platform, claims, &wanted, items)).await;
    let all = if wanted.takes_several() && items.len() > 1 { Some(answer(&items).await?) } else { None };
    let mut homeworks = Vec::new();
    for (title, item) in titles.into_iter().zip(&items) {
        homeworks.push((title, answer(std::slice::from_ref(item)).await?));
    }
    Ok(HomeworkChoice { origin: action.origin().ascii_serialization(), action: action.to_string(), homeworks, all })
}

/// The message that makes links of these items.
fn answer(service: &Service, platform: &Platform, claims: &Claims, wanted: &DeepLinking, items: &[Value]) -> Value {
    let now = service.clock.now() / 1000;
    let mut answer = json!({
        "iss": platform.client_id,
        "aud": platform.issuer,
        "iat": issued_at(service),
        "exp": now + HOUR,
        "nonce": new_id(),
        "https://purl.imsglobal.org/spec/lti/claim/message_type": "LtiDeepLinkingResponse",
        "https://purl.imsglobal.org/spec/lti/claim/version": "1.3.0",
        "https://purl.imsglobal.org/spec/lti/claim/deployment_id": claims.deployment_id,
        "https://purl.imsglobal.org/spec/lti-dl/claim/content_items": items,
    });
    if let Some(data) = &wanted.data {
        answer["https://purl.imsglobal.org/spec/lti-dl/claim/data"] = json!(data);
    }
    answer
}
