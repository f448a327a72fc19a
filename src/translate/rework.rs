//! The student's text as the second pass reads it: the same meaning, without what only Vulkan's rules refuse.
//!
//! Every change keeps the line of every character, so that lines of the module are the student's own.

use std::ffi::{CStr, CString};

/// The text for the second pass, what stands before it, and the version it is read as.
pub(super) struct Reworked {
    pub text: CString,
    pub preamble: CString,
    pub version: Option<i32>,
}

/// The first `#version` that can be written as SPIR-V.
const FIRST_SPIRV_VERSION: i32 = 330;
/// What older versions are read as; it has every construct of theirs, under the names below.
const MODERN_VERSION: i32 = 450;

/// Prepares `text` (whose comments are blanked in `code`) of GLSL `version`.
pub(super) fn rework(text: &str, code: &str, version: i32) -> Reworked {
    let mut preamble = String::new();
    if words(code).any(|word| word == "attribute" || word == "varying") {
        preamble.push_str("#define attribute in\n#define varying out\n");
    }
    Reworked {
        text: c_text(text),
        preamble: c_text(&preamble),
        version: (version < FIRST_SPIRV_VERSION).then_some(MODERN_VERSION),
    }
}

/// The names and keywords of `code`, in order.
pub(super) fn words(code: &str) -> impl Iterator<Item = &str> + Clone {
    code.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
        .filter(|word| word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_'))
}

/// The version that `#version` names; 110 where there is none (GLSL 4.10, section 3.3).
pub(super) fn version(code: &str) -> i32 {
    let directive = code
        .lines()
        .map(str::trim_start)
        .find_map(|line| line.strip_prefix('#').map(str::trim_start).and_then(|line| line.strip_prefix("version")));
    directive.and_then(|rest| rest.split_whitespace().next()).and_then(|number| number.parse().ok()).unwrap_or(110)
}

/// A text without NUL as C text; a [`crate::source::Source`] never has one.
pub(super) fn c_text(text: &str) -> CString {
    CString::new(text).unwrap_or_else(|_| CStr::from_bytes_with_nul(b"\0").unwrap_or_default().to_owned())
}
