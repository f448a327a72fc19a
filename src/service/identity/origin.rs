//! Whether a request comes from a page of ours.

use crate::service::Service;
use axum::http::{HeaderMap, header};

/// Whether no page of another site sends a request. Browsers say so by `Sec-Fetch-Site`, older ones by the origin of the page
/// alone; a program says nothing.
pub fn is_own_page(service: &Service, headers: &HeaderMap) -> bool {
    let said = |name: &str| headers.get(name).map(|value| value.to_str().unwrap_or("unreadable"));
    match (said("sec-fetch-site"), said(header::ORIGIN.as_str())) {
        (Some(site), _) => matches!(site, "same-origin" | "none"),
        (None, Some(origin)) => is_own(service, headers, origin),
        (None, None) => true,
    }
}

/// Whether an origin is that of the service: of the address that is configured, or by which it is asked. That of a page that has
/// none is `null`.
fn is_own(service: &Service, headers: &HeaderMap, origin: &str) -> bool {
    let asked = headers.get(header::HOST).and_then(|host| host.to_str().ok());
    let configured = service.config.public_url.as_deref().and_then(host_of);
    let own = [asked, configured];
    host_of(origin).is_some_and(|host| own.into_iter().flatten().any(|own| own.eq_ignore_ascii_case(host)))
}

/// Host and port of an address.
fn host_of(address: &str) -> Option<&str> {
    address.split_once("://")?.1.split('/').next()
}
