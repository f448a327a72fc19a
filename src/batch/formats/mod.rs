//! The formats that courses' tools read. Each is a pure view of a [`Class`](super::class::Class), or of one
//! [`Entry`](super::class::Entry) of it.
