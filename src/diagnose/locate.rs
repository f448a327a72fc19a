//! Which line of the student's file a message speaks of.

use crate::source::Source;

/// A place in the file, and the variable that is given a value there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Located {
    /// The line, from 1.
    pub line: u32,
    /// The name that the line assigns to, where it assigns.
    pub name: Option<String>,
}

/// The first statement that contains the first of `telling` that any statement contains, or the last one where that is
/// an assignment; spaces do not count.
///
/// Declarations of the interface and constants are no statements: a mistake is in what is done with them.
pub(super) fn find(source: &Source, telling: &[String]) -> Option<Located> {
    let lines: Vec<(u32, String)> = (1..=source.line_count())
        .map(|number| (number, source.code_line(number)))
        .filter(|(_, line)| !is_declaration(line))
        .map(|(number, line)| (number, line.split_whitespace().collect()))
        .collect();
    telling.iter().find_map(|part| {
        let part: String = part.split_whitespace().collect();
        let mut showing = lines.iter().filter(|(_, line)| contains(line, &part));
        // Of assignments to one name the last decides what is drawn.
        let (number, line) = if part.ends_with('=') { showing.next_back()? } else { showing.next()? };
        Some(Located { line: *number, name: assigned(source.code_line(*number), line) })
    })
}

fn is_declaration(line: &str) -> bool {
    let first =
        line.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == '#')).find(|word| !word.is_empty());
    matches!(first, Some("in" | "out" | "uniform" | "const" | "layout" | "attribute" | "varying"))
        || first.is_some_and(|word| word.starts_with('#') && !line.contains("define"))
}

/// Whether `line` contains `part` without a name that `part` begins or ends with being part of a longer one.
fn contains(line: &str, part: &str) -> bool {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    line.match_indices(part).any(|(at, _)| {
        let joined =
            |outside: Option<char>, inside: Option<char>| outside.is_some_and(is_word) && inside.is_some_and(is_word);
        let before = line[..at].chars().next_back();
        let after = line[at + part.len()..].chars().next();
        // Types stand right before a name once spaces are gone, so only what follows can lengthen it.
        let lengthened = joined(after, part.chars().next_back());
        let qualified = before == Some('.') || (joined(before, part.chars().next()) && !ends_with_type(&line[..at]));
        !lengthened && !qualified
    })
}

fn ends_with_type(text: &str) -> bool {
    ["float", "double", "int", "uint", "vec2", "vec3", "vec4", "mat3", "mat4", "return", "highp", "mediump", "lowp"]
        .iter()
        .any(|ty| text.ends_with(ty))
}

/// The name left of `=`, of a line as written and with its spaces taken out.
fn assigned(line: &str, squeezed: &str) -> Option<String> {
    if !squeezed.contains('=') {
        return None;
    }
    let (left, right) = line.split_once('=')?;
    if right.starts_with('=') || left.ends_with(['<', '>', '!', '=']) {
        return None;
    }
    let left = left.trim_end_matches(['+', '-', '*', '/']).trim_end();
    let name = left.rsplit(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).next()?;
    let is_name = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    is_name.then(|| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source;

    fn located(code: &str, telling: &[&str]) -> Option<(u32, Option<String>)> {
        let source = source::read("a.vert", code.as_bytes()).expect("a vertex shader");
        let telling: Vec<String> = telling.iter().map(|part| (*part).into()).collect();
        find(&source, &telling).map(|found| (found.line, found.name))
    }

    #[test]
    fn spaces_and_comments_do_not_count() {
        let code =
            "#version 410\n// h = l + v\nvoid main() {\n  vec3 h = (l  +  v) / 2.0;\n gl_Position = vec4(h, 1);\n}\n";
        assert_eq!(located(code, &["l+v"]), Some((4, Some("h".into()))));
    }

    #[test]
    fn a_longer_name_is_another_name() {
        let code = "#version 410\nvoid main() {\n  float all = ball + value;\n  vec3 k = l + v;\n gl_Position = vec4(k, 1);\n}\n";
        assert_eq!(located(code, &["l+v"]), Some((4, Some("k".into()))));
    }

    #[test]
    fn of_assignments_the_last_one_counts() {
        let code = "#version 410\nvoid main() {\n  vc = cv;\n  vec4 a = kamb;\n  vc = a;\n gl_Position = a;\n}\n";
        assert_eq!(located(code, &["vc="]), Some((5, Some("vc".into()))));
        assert_eq!(located(code, &["vc=cv", "vc="]), Some((3, Some("vc".into()))));
    }

    #[test]
    fn the_most_telling_part_wins_and_declarations_do_not_count() {
        let code = "#version 410\nout vec4 vc;\nin vec4 cv;\nvoid main() {\n  vc = vec4(0);\n  vc += cv;\n gl_Position = cv;\n}\n";
        assert_eq!(located(code, &["vc=cv", "vc="]), Some((5, Some("vc".into()))));
        assert_eq!(located(code, &["nothing"]), None);
    }
}
