//! Many files → many reports, in and out of the formats that courses use.
//!
//! [`intake`](crate::intake) finds what was handed in, [`roll`] reads it, [`run`] grades it on all cores and writes each result into a
//! [`journal`] as it comes; a [`class::Class`] is what came of it all, and [`formats`] are its views. [`content`] knows which
//! submissions are the same, [`likeness`] shows which answers are alike, [`anonymous`] takes the names away, [`changes`] holds a class against an earlier grading of it,
//! [`shard`] divides it among machines.

pub mod anonymous;
pub mod changes;
pub mod class;
pub mod content;
pub mod folder;
pub mod formats;
pub mod journal;
pub mod json_lines;
pub mod likeness;
pub mod output;
pub mod page;
pub mod portrait;
pub mod progress;
pub mod resume;
pub mod roll;
pub mod run;
pub mod shard;
pub mod standing;
pub mod statistics;
pub mod summary;
