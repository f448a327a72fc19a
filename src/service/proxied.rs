//! Who a reverse proxy says that somebody is (`mod_shib` and the like).
//!
//! Off unless the configuration names the header and the proxies. The header is believed where one of them is at the other end of
//! the connection, and taken away from every request, so that nothing behind this layer can believe anybody else's.

use super::Service;
use super::limits::peer;
use axum::extract::{Request, State as Shared};
use axum::middleware::Next;
use axum::response::Response;

/// Who the proxy says that somebody is: a student number, or the login of an account. An extension of the request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProxiedName(pub String);

/// Longest name, in bytes.
const LONGEST_NAME: usize = 255;

/// The layer.
pub(super) async fn attend(Shared(service): Shared<Service>, mut request: Request, next: Next) -> Response {
    let Some(header) = &service.config.identity_header else { return next.run(request).await };
    let peer = peer(request.extensions());
    let values: Vec<_> = request.headers().get_all(header).iter().cloned().collect();
    request.headers_mut().remove(header);
    // A proxy that leaves what the client wrote beside its own word is set up wrongly: neither is believed.
    if let [only] = values.as_slice()
        && service.identity_proxies.trusts(peer)
        && let Ok(name) = only.to_str()
        && (1..=LONGEST_NAME).contains(&name.trim().len())
    {
        request.extensions_mut().insert(ProxiedName(name.trim().to_owned()));
    }
    next.run(request).await
}
