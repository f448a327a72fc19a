//! A class graded on the command line.
//!
//! [`run`] grades on all cores what [`crate::class::roll`] has read, and writes each result into a [`journal`] as it comes. [`resume`]
//! goes on where an earlier run stopped, [`shard`] divides a class among machines, [`anonymous`] takes the names away.
//! [`changes`] compares a class with an earlier grading of it, [`likeness`] shows which answers are alike, [`json_lines`], [`progress`]
//! and [`summary`] say how a run goes and how it ended.

pub mod anonymous;
pub mod changes;
pub mod journal;
pub mod json_lines;
pub mod likeness;
pub mod progress;
pub mod resume;
pub mod run;
pub mod shard;
pub mod summary;
