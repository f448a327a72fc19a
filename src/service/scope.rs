//! What routes are for: the whole service, or one homework.

use super::{Service, State};

/// What a router is made for: the whole service, or one homework in it. Extractors need no more of it than this.
pub trait Scope: Clone + Send + Sync + 'static {
    /// The whole service.
    fn whole(&self) -> &Service;

    /// The homework, where it is one, or the only one.
    fn own(&self) -> Option<State>;
}

impl Scope for Service {
    fn whole(&self) -> &Service {
        self
    }

    fn own(&self) -> Option<State> {
        self.only()
    }
}

impl Scope for State {
    fn whole(&self) -> &Service {
        self.service()
    }

    fn own(&self) -> Option<State> {
        Some(self.clone())
    }
}
