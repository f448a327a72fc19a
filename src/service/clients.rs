//! The clients of the service's own requests: to learning platforms, to issuers, and to itself.

use reqwest::{Client, ClientBuilder, Url, redirect};
use std::error::Error;
use std::sync::OnceLock;
use std::time::Duration;

/// How long the other side may take to answer.
const PATIENCE: Duration = Duration::from_secs(10);

/// A client for each kind of address, made when the first request needs it.
///
/// A client for https reads the certificates of this machine's authorities and cannot be made without any. A service that
/// asks nobody by https needs none, so nothing is read before somebody is to be asked.
#[derive(Debug, Default)]
pub struct Clients {
    local: OnceLock<Client>,
    https: OnceLock<Client>,
}

impl Clients {
    /// The client for an address: one that trusts this machine's authorities, or for http one that trusts none.
    ///
    /// # Errors
    ///
    /// What https lacks here. It is looked for again at the next request.
    pub fn of(&self, url: &Url) -> Result<&Client, String> {
        match url.scheme() {
            "https" => made(&self.https, https),
            _ => made(&self.local, local),
        }
    }
}

/// The client that is kept, or else a new one.
fn made(kept: &OnceLock<Client>, make: fn() -> Result<Client, String>) -> Result<&Client, String> {
    if let Some(client) = kept.get() {
        return Ok(client);
    }
    let client = make()?;
    Ok(kept.get_or_init(|| client))
}

/// Redirects are not followed: the address that was checked is the one that is asked.
fn builder() -> ClientBuilder {
    Client::builder().timeout(PATIENCE).redirect(redirect::Policy::none())
}

/// No proxy stands between this machine and itself.
fn local() -> Result<Client, String> {
    builder().tls_certs_only([]).no_proxy().build().map_err(|error| causes(&error))
}

/// A client for https.
///
/// # Errors
///
/// What https lacks on this machine.
pub fn https() -> Result<Client, String> {
    builder().build().map_err(|error| {
        format!(
            "https cannot be used ({}): install the certificates of the authorities, on Debian and Ubuntu by \
             apt-get install ca-certificates, or name a file of certificates in SSL_CERT_FILE",
            causes(&error)
        )
    })
}

/// An error and what caused it.
pub(super) fn causes(error: &(dyn Error + 'static)) -> String {
    std::iter::successors(Some(error), |error| (*error).source())
        .map(ToString::to_string)
        .collect::<Vec<_>>()
        .join(": ")
}
