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
const FIRST_SPIRV_VERSION: i32 = 140;
/// What older versions are read as; it has every construct of theirs, under the names below.
const MODERN_VERSION: i32 = 450;

/// Prepares `text` (whose comments are blanked in `code`) of GLSL `version`.
pub(super) fn rework(text: &str, code: &str, version: i32) -> Reworked {
    let mut preamble = String::new();
    for word in words(code).filter(|word| is_vulkan_keyword(word)) {
        let line = format!("#define {word} own_{word}\n");
        if !preamble.contains(&line) {
            preamble.push_str(&line);
        }
    }
    if words(code).any(|word| word == "attribute" || word == "varying") {
        preamble.push_str("#define attribute in\n#define varying out\n");
    }
    Reworked {
        text: c_text(text),
        preamble: c_text(&preamble),
        version: (version < FIRST_SPIRV_VERSION).then_some(MODERN_VERSION),
    }
}

/// Turns the uniforms that have an initialiser into globals: nothing sets a uniform of the
/// student's own, so it keeps its initial value, and the compiler drops initialisers of uniforms.
///
/// `log` is the compiler's log, which names them; `None` where it names none. Uniforms in `set`
/// are left alone: the program sets those.
pub(super) fn initialised_uniforms(text: &str, code: &str, log: &str, set: &[&str]) -> Option<CString> {
    let mut bytes = text.as_bytes().to_vec();
    let mut changed = false;
    for line in log.lines().filter(|line| line.contains("Ignoring initializer for uniform")) {
        let name = line.split('\'').nth(1).unwrap_or_default();
        if set.contains(&name) {
            continue;
        }
        for range in uniform_qualifiers(code, name) {
            bytes[range].fill(b' ');
            changed = true;
        }
    }
    // Only ASCII was replaced, by ASCII: the text stays UTF-8.
    changed.then(|| CString::new(bytes).unwrap_or_default())
}

/// Where `uniform` and its `layout(…)` stand in the declaration that has `name`.
fn uniform_qualifiers(code: &str, name: &str) -> Vec<std::ops::Range<usize>> {
    let mut start = 0;
    for statement in code.split_inclusive([';', '{', '}']) {
        let own = start..start + statement.len();
        start = own.end;
        let mut all = words(statement).peekable();
        if !all.clone().any(|word| word == "uniform") || !all.any(|word| word == name) {
            continue;
        }
        let mut ranges = Vec::new();
        if let Some(at) = statement.find("uniform") {
            ranges.push(own.start + at..own.start + at + "uniform".len());
        }
        if let Some(at) = statement.find("layout")
            && let Some(length) = statement[at..].find(')')
        {
            ranges.push(own.start + at..own.start + at + length + 1);
        }
        return ranges;
    }
    Vec::new()
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

/// Keywords of Vulkan's GLSL that are free names in OpenGL's.
fn is_vulkan_keyword(word: &str) -> bool {
    if matches!(word, "sampler" | "samplerShadow") {
        return true;
    }
    let stem = word.strip_prefix(['i', 'u']).unwrap_or(word);
    let kinds = ["1D", "2D", "3D", "Cube", "2DRect", "Buffer", "2DMS", "1DArray", "2DArray", "CubeArray", "2DMSArray"];
    matches!(stem, "subpassInput" | "subpassInputMS" | "attachmentEXT")
        || stem.strip_prefix("texture").is_some_and(|kind| kinds.contains(&kind))
}

/// A text without NUL as C text; a [`crate::source::Source`] never has one.
pub(super) fn c_text(text: &str) -> CString {
    CString::new(text).unwrap_or_else(|_| CStr::from_bytes_with_nul(b"\0").unwrap_or_default().to_owned())
}
