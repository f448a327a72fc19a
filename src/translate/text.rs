//! The student's text as the compiler reads it: the same meaning, without what only this compiler minds.
//!
//! Every line stays where it is, and so does every byte but those of [`continued`] lines, so that the places of the
//! compiler's messages are the student's own.

use crate::ffi::glslang::Stage;
use crate::source::{self, Source};
use std::ffi::{CStr, CString};
use std::ops::Range;

/// The text of `source` for both passes.
///
/// - `//` comments are blanked: before GLSL 4.20 the compiler ends one at a backslash where drivers read on.
/// - Form feeds and vertical tabs are spaces, as in the GLSL specification, section 3.1.
/// - What no compiler reads is blanked where it could not even be read over: quotes and letters of other scripts.
/// - `#pragma` lines are blanked: drivers ignore the unknown ones, and none changes what a shader computes.
pub(super) fn prepared(source: &Source) -> String {
    let mut bytes = source.without_line_comments().into_bytes();
    for byte in bytes.iter_mut().filter(|byte| matches!(byte, b'\x0b' | b'\x0c')) {
        *byte = b' ';
    }
    let code = source.code();
    let unread = source.unread_lines();
    for (line, is_unread) in lines(code).into_iter().zip(unread) {
        let directive = directive(&code[line.clone()]);
        if is_unread && directive != Some("error") {
            let quotes = directive.is_none();
            for at in
                line.filter(|&at| !code.as_bytes()[at].is_ascii() || quotes && b"'\"".contains(&code.as_bytes()[at]))
            {
                bytes[at] = b' ';
            }
        }
    }
    for at in pragmas(code).into_iter().flatten().filter(|&at| code.as_bytes()[at] != b'\n') {
        // What is blank in the code is white space already, or a comment, which may go on behind the line.
        if code.as_bytes()[at] != b' ' {
            bytes[at] = b' ';
        }
    }
    // ASCII, and whole characters of others, were replaced by ASCII.
    String::from_utf8(bytes).unwrap_or_else(|_| source.text.clone())
}

/// `text` without line continuations, which the compiler takes from GLSL 4.20 on: a directive is held together by a
/// comment that spans the line end instead, and elsewhere a line end is white space. `None` where there is none.
pub(super) fn continued(text: &str, code: &str) -> Option<String> {
    let mut out = String::with_capacity(text.len());
    let mut done = 0;
    let mut in_directive = false;
    for line in lines(code) {
        let first = !code[..line.start].ends_with("\\\n");
        if first {
            in_directive = directive(&code[line.clone()]).is_some();
        }
        if code[line.clone()].ends_with('\\') && text[..line.end].ends_with('\\') {
            out.push_str(&text[done..line.end - 1]);
            out.push_str(if in_directive { "/*\n*/" } else { " \n" });
            done = (line.end + 1).min(text.len());
        }
    }
    out.push_str(&text[done.min(text.len())..]);
    (done > 0).then_some(out)
}

/// `code` with the directives blanked, continuations left out of account.
pub(super) fn without_directives(code: &str) -> String {
    let blanked = |line: &str| match directive(line) {
        Some(_) => line.bytes().map(|byte| if byte == b'\n' { '\n' } else { ' ' }).collect(),
        None => line.to_owned(),
    };
    code.split_inclusive('\n').map(blanked).collect()
}

/// The bytes of each line, without its end.
fn lines(text: &str) -> Vec<Range<usize>> {
    let mut start = 0;
    let range = |line: &str| {
        let own = start..start + line.len();
        start = own.end + 1;
        own
    };
    text.lines().map(range).collect()
}

/// The name of the directive that a line of code is, empty for a lone `#`.
fn directive(line: &str) -> Option<&str> {
    let rest = line.trim_start().strip_prefix('#')?.trim_start();
    Some(&rest[..rest.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(rest.len())])
}

/// The bytes of the `#pragma` lines, continuations included.
fn pragmas(code: &str) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = Vec::new();
    let mut goes_on = false;
    for line in lines(code) {
        let is_one = goes_on || directive(&code[line.clone()]) == Some("pragma");
        goes_on = is_one && code[line.clone()].ends_with('\\');
        if is_one {
            found.push(line);
        }
    }
    found
}

/// The version that `#version` names; 110 where there is none (GLSL 4.10, section 3.3).
pub(super) fn version(code: &str) -> i32 {
    source::declared_version(code).unwrap_or(source::DEFAULT_VERSION)
}

/// A text without NUL as C text; a [`Source`] never has one.
pub(super) fn c_text(text: &str) -> CString {
    CString::new(text).unwrap_or_default()
}

/// What the second pass needs besides the text that the first accepts.
pub(super) struct ForSpirv {
    pub text: CString,
    /// What stands before the text without counting as a line.
    pub preamble: CString,
    /// The version that the text is read as, where it is not its own.
    pub version: Option<i32>,
}

/// The first `#version` that can be written as SPIR-V; older ones are read as this, which has all of theirs
/// that is left in OpenGL's core profile, under the names of the preamble.
const FIRST_SPIRV_VERSION: i32 = 330;

/// Makes `text`, which the first pass accepts with `preamble` before it, ready for SPIR-V.
pub(super) fn for_spirv(text: &str, preamble: &CStr, version: i32, stage: Stage) -> ForSpirv {
    let has_old_qualifiers = source::words(text).any(|(_, word)| word == "attribute" || word == "varying");
    let mut bytes = text.as_bytes().to_vec();
    for (at, word) in source::words(text).filter(|(_, word)| matches!(*word, "shared" | "packed")) {
        // Where the members of a block lie is nobody's business: no program fills it.
        if is_in_layout(text, at) {
            bytes[at..at + word.len()].copy_from_slice(b"std140");
        }
    }
    let qualifiers = match stage {
        Stage::Vertex if has_old_qualifiers => c"#define attribute in\n#define varying out\n",
        Stage::Fragment if has_old_qualifiers => c"#define varying in\n",
        _ => c"",
    };
    ForSpirv {
        text: CString::new(bytes).unwrap_or_default(),
        preamble: CString::new([preamble.to_bytes(), qualifiers.to_bytes()].concat()).unwrap_or_default(),
        version: (version < FIRST_SPIRV_VERSION || self::version(text) != version)
            .then_some(version.max(FIRST_SPIRV_VERSION)),
    }
}

/// Whether the byte `at` stands in the parentheses of a `layout(…)`.
pub(super) fn is_in_layout(text: &str, at: usize) -> bool {
    let before = &text[..at];
    before.rfind('(').is_some_and(|open| !before[open..].contains(')') && before[..open].trim_end().ends_with("layout"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source;

    fn prepared_text(text: &str) -> String {
        let source = source::read("a.vert", text.as_bytes()).expect("a shader");
        let prepared = prepared(&source);
        assert_eq!(prepared.len(), source.text.len());
        prepared
    }

    #[test]
    fn comments_to_the_line_end_are_blank_and_others_stay() {
        assert_eq!(
            prepared_text("#version 410\nfloat a; // b \\\nc\n/* d */ void main() {}\n"),
            "#version 410\nfloat a;       \n \n/* d */ void main() {}\n"
        );
    }

    #[test]
    fn pragmas_are_blank_with_their_continuations() {
        assert_eq!(
            prepared_text("#version 410\n # pragma a \\\n b /* c\n*/ void main() {}\n"),
            "#version 410\n             \n   /* c\n*/ void main() {}\n"
        );
    }

    #[test]
    fn only_what_nobody_reads_is_blanked() {
        assert_eq!(
            prepared_text("#version 410\n#if 0\n it's \"光\"\n#endif\n#define NEVER 光\nvoid\x0cmain() {}\n"),
            "#version 410\n#if 0\n it s      \n#endif\n#define NEVER    \nvoid main() {}\n"
        );
    }

    #[test]
    fn continued_lines_keep_their_numbers() {
        let text = "#define A 1 \\\n 2\nfloat a = \\\n 1;\n";
        assert_eq!(continued(text, text).as_deref(), Some("#define A 1 /*\n*/ 2\nfloat a =  \n 1;\n"));
        assert_eq!(continued("float a;\n", "float a;\n"), None);
    }

    #[test]
    fn version_is_that_of_the_directive() {
        assert_eq!(version("\n # version 330 core\n"), 330);
        assert_eq!(version("void main() {}"), 110);
    }

    #[test]
    fn layouts_of_blocks_become_one_that_spirv_has() {
        let ready = for_spirv(
            "#version 410\nlayout(shared) uniform B { float a; };\nfloat shared_;\n",
            c"",
            410,
            Stage::Vertex,
        );
        assert_eq!(ready.text.to_str(), Ok("#version 410\nlayout(std140) uniform B { float a; };\nfloat shared_;\n"));
        assert_eq!(ready.version, None);
        assert_eq!(for_spirv("varying vec4 a;", c"", 120, Stage::Vertex).version, Some(330));
    }
}
