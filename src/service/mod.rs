//! The upload service: axum router, pages, store.
