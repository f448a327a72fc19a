//! Who a reverse proxy says that somebody is (`mod_shib` and the like).
//!
//! Off unless the configuration names the header and the proxies. The header is believed where one of them is at the other end of
//! the connection, and taken away from every request, so that nothing behind this layer can believe anybody else's.

use super::Service;
use super::errors::Problem;
use super::identity::check_session;
use super::limits::peer;
use axum::extract::{Request, State as Shared};
use axum::http::HeaderValue;
use axum::middleware::Next;
use axum::response::Response;

/// Who the proxy says that somebody is: a student number, or the login of an account. An extension of the request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProxiedName(pub String);

/// Longest name, in bytes.
const LONGEST_NAME: usize = 255;

/// The layer.
pub(super) async fn attend(
    Shared(service): Shared<Service>,
    mut request: Request,
    next: Next,
) -> Result<Response, Problem> {
    let Some(header) = &service.config.identity_header else { return Ok(next.run(request).await) };
    let values: Vec<_> = request.headers().get_all(header).iter().cloned().collect();
    request.headers_mut().remove(header);
    if service.identity_proxies.trusts(peer(request.extensions())) {
        let said = named(&values);
        check_session(&service, request.headers_mut(), said.as_ref()).await?;
        if let Some(name) = said {
            request.extensions_mut().insert(name);
        }
    }
    Ok(next.run(request).await)
}

/// Whom a proxy names by these values of its header.
fn named(values: &[HeaderValue]) -> Option<ProxiedName> {
    // A proxy that leaves what the client wrote beside its own word is set up wrongly: neither is believed.
    let [only] = values else { return None };
    let name = only.to_str().ok()?.trim();
    (1..=LONGEST_NAME).contains(&name.len()).then(|| ProxiedName(name.to_owned()))
}
