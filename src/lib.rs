//! ggrade, the autograder for GLSL shading homework.
//!
//! The modules stand in the order in which a submission flows through them:
//! bytes → [`source`] → [`translate`] → [`render`] → [`compare`] → [`diagnose`] → [`report`].

pub mod diagnostic;
pub mod excerpt;
pub mod fault;
pub mod language;
pub mod report;
pub mod source;
