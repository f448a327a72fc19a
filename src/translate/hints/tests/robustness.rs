//! Files broken at random places: something is always said, at a place in the file, and nothing panics.

use super::{RIGHT, diagnostics, interface, outcome};
use crate::diagnostic::Severity;
use crate::ffi::glslang::Reached;
use crate::translate::hints::tokens::tokens;

fn check(text: &str) {
    let outcome = outcome(text, &interface());
    // A continued line or a `;` too many alone is no reason: real drivers take it.
    let taken = |log: &str| log.contains("line continuation") || log.contains("extraneous semicolon");
    let refused = outcome.reached != Reached::Done && !taken(outcome.log(crate::ffi::glslang::Stage::Vertex));
    let all = diagnostics(text);
    let is_error = |severity| severity == Severity::Error;
    assert!(!refused || all.iter().any(|one| is_error(one.severity)), "nothing is said about\n{text}");
    let lines: Vec<_> = text.split('\n').collect();
    for one in &all {
        assert!(!one.message.en.is_empty() && !one.message.ja.is_empty(), "{one:?}");
        let Some(line) = one.line else { continue };
        let length =
            lines.get(line as usize - 1).unwrap_or_else(|| panic!("no line {line} in\n{text}")).chars().count();
        assert!(one.column.is_some_and(|column| column as usize <= length + 1), "{one:?} in\n{text}");
    }
}

#[test]
fn a_token_left_out_or_written_twice() {
    for token in tokens(RIGHT) {
        let (before, after) = (&RIGHT[..token.start], &RIGHT[token.end()..]);
        check(&format!("{before}{after}"));
        check(&format!("{before}{0} {0}{after}", token.text));
    }
}

#[test]
fn a_token_replaced_by_another() {
    for token in tokens(RIGHT).into_iter().step_by(3) {
        let (before, after) = (&RIGHT[..token.start], &RIGHT[token.end()..]);
        for other in ["{", "}", "(", ")", ";", "else", "vec3", "光", "\"", "/*", "\\", "#", "."] {
            check(&format!("{before} {other} {after}"));
        }
    }
}

#[test]
fn a_file_cut_off() {
    for (end, _) in RIGHT.char_indices().step_by(7) {
        check(&RIGHT[..end]);
    }
}

#[test]
fn files_that_are_hardly_one() {
    for text in ["", "\n", "}", "{", ")", "((((", "/*", "\"", "#", "#define", "#version", "\\", "光", "a", ";", "a\\\n"]
    {
        check(text);
    }
}

#[test]
fn many_mistakes_are_not_all_told() {
    let text = format!("#version 410 core\nvoid main() {{\n{}}}\n", "a = b;\nc(d);\n".repeat(200));
    let mistakes: String = (0..100).map(|number| format!("  x{number} = y{number};\n")).collect();
    for text in [text, format!("#version 410 core\nvoid main() {{\n{mistakes}}}\n")] {
        let all = diagnostics(&text);
        assert!((2..=20).contains(&all.len()), "{}", all.len());
    }
}
