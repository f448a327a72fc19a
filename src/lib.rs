//! ggrade, the autograder for GLSL shading homework.
//!
//! A hand-in flows through
//! [`hand_in`] → [`source`] → [`slots`] → [`translate`] → [`render`] → [`compare`] → [`diagnose`] → [`report`].
//! [`grade`] is the pipeline, [`sandbox`] the processes that it runs in. [`expected`] and [`pictures`] are what right answers draw.
//! [`cross_check`] and [`opengl`] are second and third opinions on what was drawn.
//!
//! A class begins at [`intake`], which finds who handed in what. [`likeness`] shows which answers are alike, and [`class`] is what
//! came of it all, in the formats that courses use. Three surfaces grade many hand-ins: [`batch`] on the command line, [`service`] in
//! a browser, [`corpus`] samples of which the result is known.
//!
//! [`cli`] is the command line as it is written, [`choice`] the assignments that it means, [`command`] what a person calls, and
//! [`excerpt`] a message with its line for the terminal. All rooms share [`diagnostic`], [`fault`], [`language`] and [`parallel`],
//! and [`ffi`] has the libraries that are written in C and C++.

pub mod hand_in;

pub mod source;

pub mod slots;
pub mod translate;

pub mod render;

pub mod compare;
pub mod diagnose;
pub mod report;

pub mod expected;
pub mod pictures;

pub mod cross_check;
pub mod grade;
#[cfg(feature = "opengl")]
pub mod opengl;
pub mod sandbox;

pub mod intake;
pub mod likeness;

pub mod class;

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
