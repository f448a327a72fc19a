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

/// Who the proxy says that somebody is: a student number, or the login of an account; empty where that cannot be read, which is
/// nobody who is known here. An extension of the request.
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

/// Whom a proxy names by these values of its header; none where it says that nobody has logged in.
fn named(values: &[HeaderValue]) -> Option<ProxiedName> {
    // A proxy that leaves what the client wrote beside its own word is set up wrongly: neither is believed.
    let name = match values {
        [] => return None,
        [only] => std::str::from_utf8(only.as_bytes()).ok().map(str::trim).filter(|name| name.len() <= LONGEST_NAME),
        _ => None,
    };
    (name != Some("")).then(|| ProxiedName(name.unwrap_or_default().to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_read_is_somebody_and_nobody_who_is_known() {
        let named = |values: &[&[u8]]| {
            let values: Vec<_> = values.iter().map(|value| HeaderValue::from_bytes(value).expect("a value")).collect();
            named(&values).map(|ProxiedName(name)| name)
        };
        let nobody: [&[&[u8]]; 3] = [&[], &[b""], &[b" "]];
        for none in nobody {
            assert_eq!(named(none), None, "{none:?}");
        }
        for (value, name) in [(&b" S1 "[..], "S1"), ("jürgen".as_bytes(), "jürgen")] {
            assert_eq!(named(&[value]).as_deref(), Some(name));
        }
        let unreadable: [&[&[u8]]; 4] = [&[b"j\xfcrgen"], &[&[b'x'; 256]], &[b"S1", b"S1"], &[b"S1", b""]];
        for unreadable in unreadable {
            assert_eq!(named(unreadable).as_deref(), Some(""), "{unreadable:?}");
        }
    }
}
