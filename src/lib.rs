//! ggrade, the autograder for GLSL shading homework.
//!
//! A submission flows through
//! [`hand_in`] → [`slots`] → [`source`] → [`translate`] → [`render`] → [`compare`] → [`diagnose`] → [`report`].
//! [`grade`] is the pipeline, [`sandbox`] the processes that it runs in. Many submissions at once are a [`batch`],
//! uploads in a browser the [`service`]; [`command`] is what a person calls.

pub mod hand_in;
pub mod intake;
pub mod slots;

pub mod compare;
pub mod cross_check;
pub mod diagnose;
pub mod render;
pub mod report;
pub mod source;
pub mod translate;

pub mod expected;
pub mod grade;
pub mod likeness;
#[cfg(feature = "opengl")]
pub mod opengl;
pub mod pictures;
pub mod sandbox;

pub mod batch;
pub mod corpus;
#[cfg(feature = "service")]
pub mod service;

pub mod choice;
pub mod cli;
pub mod command;
pub mod excerpt;

pub mod diagnostic;
pub mod fault;
pub mod language;
pub mod parallel;

pub mod ffi;
