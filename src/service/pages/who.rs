//! Who sits at the browser of a student's page, and how they leave it.

use crate::service::Service;
use crate::service::identity::Visitor;
use crate::service::proxied::ProxiedName;
use axum::http::Extensions;

/// The student at whose browser a page is read.
#[derive(Clone, Debug)]
pub struct KnownStudent {
    /// Student number.
    pub number: String,
    /// The token of the form by which they leave; none where a reverse proxy says who they are, with every request.
    pub leave: Option<String>,
}

impl KnownStudent {
    /// The one of a request for a page.
    pub(super) fn of(service: &Service, extensions: &Extensions) -> Option<Self> {
        let visitor = extensions.get::<Visitor>()?;
        let number = visitor.identity.student()?.number.clone();
        let is_proxied = extensions.get::<ProxiedName>().is_some();
        Some(Self { number, leave: (!is_proxied).then(|| visitor.csrf(service)) })
    }
}
