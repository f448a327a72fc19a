//! The server around the router.
