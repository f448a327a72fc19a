//! Libraries that are written in C and C++, behind functions that cannot be misused. `unsafe` stands here and nowhere else.
#![allow(unsafe_code, reason = "the libraries are written in C and C++")]

pub(crate) mod allocator;
pub(crate) mod glslang;
#[cfg(feature = "opengl")]
pub mod opengl;
