//! Preprocessor lines: `#version` and conditions, comments without an end, and `#line`.

use super::file::HintContext;
use super::tokens::{Lexeme, LexemeKind, tokens};
use super::{CompilerMessage, LogEntry, vocabulary};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;

const NAMES: [&str; 12] =
    ["version", "define", "undef", "if", "ifdef", "ifndef", "else", "endif", "elif", "error", "pragma", "extension"];

/// `text` with its `#line` directives blanked, so that the compiler counts as an editor does; `None` without any.
/// Every byte of them becomes a space: offsets of everything else stay.
pub fn without_line_directives(text: &str) -> Option<String> {
    let mut blanked = String::with_capacity(text.len());
    let mut kept = 0;
    for directive in tokens(text).iter().filter(|token| is_line(token)) {
        blanked.push_str(&text[kept..directive.start]);
        let bytes = directive.text.bytes();
        blanked.extend(bytes.map(|byte| if byte == b'\n' { '\n' } else { ' ' }));
        kept = directive.end();
    }
    blanked.push_str(&text[kept..]);
    (kept > 0).then_some(blanked)
}

/// What to say of a file with which the compiler gets further where its `#line` directives are blanked.
pub fn refused_line_directive(text: &str) -> Diagnostic {
    let message = Text::new(
        "the compiler refuses what the `#line` directives of this file make of it; without them it gets further.",
        "`#line` 指令があるためにここでコンパイルが止まります。`#line` を除けば先に進みます。",
    );
    let hint = Text::new(
        "Delete the `#line` directives: this homework needs none.",
        "`#line` を削除してください。この課題では必要ありません。",
    );
    let all = tokens(text);
    let first = all.iter().find(|token| is_line(token));
    let line = first.map(|token| text[..token.start].bytes().filter(|byte| *byte == b'\n').count() as u32 + 1);
    let diagnostic = Diagnostic::error(DiagnosticStage::Compile, message).hint(hint);
    match line {
        Some(line) => diagnostic.at(line, None),
        None => diagnostic,
    }
}

fn is_line(token: &Lexeme<'_>) -> bool {
    token.kind == LexemeKind::Directive && directive_name(token.text) == "line"
}

pub fn directive_name(directive: &str) -> &str {
    let rest = directive.trim_start_matches('#').trim_start();
    let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
    &rest[..end]
}

/// Whether `entry` is about a directive that was meant to be `#version`.
pub fn is_misspelt_version(entry: &LogEntry<'_>) -> bool {
    let name = entry.message.strip_prefix("invalid directive:").map(str::trim);
    name.and_then(|name| vocabulary::nearest(name, NAMES.into_iter())) == Some("version")
}

/// Whether `entry` is about the number or the profile of a `#version` line without saying where that is.
pub fn is_about_version(entry: &LogEntry<'_>) -> bool {
    entry.message == "version not supported" || entry.message.starts_with("#version")
}

/// Puts a message of the preprocessor into words.
pub fn explain(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Option<Diagnostic> {
    let entry = finding.entry;
    let line = entry.place.map(|(line, _)| line);
    let directive = file.directives.iter().find(|token| Some(file.line(token.start)) == line);
    let message = entry.message;
    if entry.token == "#version" || is_about_version(entry) {
        return version(file, directive, message);
    }
    if message.starts_with("End of input in comment") {
        let (line, column) = entry.place?;
        let text =
            Text::new("This comment never ends: its `*/` is missing.", "このコメントを閉じる `*/` がありません。");
        return Some(file.error(file.offset(line, column), 2, text));
    }
    if message.starts_with("missing #endif") {
        let open = unclosed_condition(file)?;
        let text = Text::new("The `#endif` for this line is missing.", "この行に対応する `#endif` がありません。");
        return Some(file.error(open.start, open.text.len(), text));
    }
    // Where a line ends too early, the compiler is on the next one already.
    let above = || file.directives.iter().find(|token| Some(file.line(token.end()) + 1) == line);
    let condition = entry.token == "preprocessor evaluation";
    let about = |token: &&Lexeme<'_>| condition || entry.token.strip_prefix('#') == Some(directive_name(token.text));
    let above = above().filter(about);
    let directive = if condition { above.or(directive) } else { directive.or(above) }?;
    let name = directive_name(directive.text);
    let mark = |text| file.error(directive.start, directive.text.len(), text);
    if message.starts_with("mismatched statements") {
        let text = Text::new(
            format!("This `#{name}` belongs to no `#if`."),
            format!("この `#{name}` に対応する `#if` がありません。"),
        );
        return Some(mark(text));
    }
    if name == "include" {
        let text = Text::new("GLSL has no `#include`.", "GLSL に `#include` はありません。");
        return Some(mark(text).hint(Text::new(
            "A shader is one file; its functions need no header.",
            "シェーダは 1 つのファイルで完結します。組み込み関数を使うのにヘッダは要りません。",
        )));
    }
    if message.starts_with("invalid directive") {
        return Some(misspelt(name, mark));
    }
    (condition || entry.token.starts_with('#')).then(|| {
        mark(Text::new(
            format!("This `#{name}` is not complete or not correct: “{message}”."),
            format!("この `#{name}` の書き方が正しくありません:「{message}」。"),
        ))
    })
}

fn misspelt(name: &str, mark: impl Fn(Text) -> Diagnostic) -> Diagnostic {
    let text =
        Text::new(format!("There is no preprocessor line `#{name}`."), format!("`#{name}` という指令はありません。"));
    match vocabulary::nearest(name, NAMES.into_iter()) {
        Some(meant) => mark(text)
            .hint(Text::new(format!("Did you mean `#{meant}`?"), format!("`#{meant}` の間違いではありませんか。"))),
        None => mark(text),
    }
}

fn version(file: &HintContext<'_>, directive: Option<&Lexeme<'_>>, message: &str) -> Option<Diagnostic> {
    let own = |token: &&Lexeme<'_>| directive_name(token.text) == "version";
    let line = directive.or_else(|| file.directives.iter().find(own));
    let text = if message.starts_with("must occur first") {
        Text::new(
            "`#version` must be the first line of the file; only comments may stand before it.",
            "`#version` はファイルの先頭に書きます。これより前に置けるのはコメントだけです。",
        )
    } else if message.contains("profile") {
        Text::new(
            "After the number, `#version` takes only `core` or `compatibility`.",
            "`#version` の番号の後に書けるのは `core` か `compatibility` だけです。",
        )
    } else if message.starts_with("must be followed by version number") {
        Text::new("`#version` lacks its number.", "`#version` の後に番号がありません。")
    } else {
        Text::new("There is no GLSL of this version.", "この番号の GLSL は存在しません。")
    };
    let hint = version_hint(file);
    let Some(line) = line else { return Some(Diagnostic::error(DiagnosticStage::Compile, text).hint(hint)) };
    Some(file.error(line.start, line.text.len(), text).hint(hint))
}

/// The `#if` whose `#endif` is missing.
fn unclosed_condition<'f, 'a>(file: &'f HintContext<'a>) -> Option<&'f Lexeme<'a>> {
    let mut open = Vec::new();
    for directive in &file.directives {
        match directive_name(directive.text) {
            "if" | "ifdef" | "ifndef" => open.push(directive),
            "endif" => {
                open.pop();
            }
            _ => {}
        }
    }
    open.pop()
}

/// A file that is written in today's GLSL and does not say so, or not in a way that the compiler reads: it is then taken
/// for one of 2004.
pub fn missing_version(file: &HintContext<'_>) -> Option<Diagnostic> {
    if file.directives.iter().any(|token| directive_name(token.text) == "version") {
        return None;
    }
    if let Some(meant) = meant_version(file) {
        return Some(meant.hint(version_hint(file)));
    }
    let modern = file.declarations.iter().any(|d| d.global && (d.is("in") || d.is("out") || d.is("layout")));
    if !modern {
        return None;
    }
    let text = Text::new(
        "The file has no `#version` line, so it is read as GLSL 1.10, which has no `in` and `out` variables.",
        "`#version` の行がないので、`in` や `out` の変数がない GLSL 1.10 として扱われます。",
    );
    Some(file.error(0, 1, text).hint(version_hint(file)))
}

/// A line that was meant to be `#version`.
fn meant_version(file: &HintContext<'_>) -> Option<Diagnostic> {
    let is_meant = |name: &str| vocabulary::nearest(name, std::iter::once("version")).is_some();
    let number_joined =
        |name: &str| name.strip_prefix("version").is_some_and(|rest| rest.starts_with(char::is_numeric));
    for line in &file.directives {
        let name = directive_name(line.text);
        if number_joined(name) {
            let text = Text::new(
                "A space is missing between `#version` and its number.",
                "`#version` と番号の間に空白が必要です。",
            );
            return Some(file.error(line.start, line.text.len(), text));
        }
        if is_meant(name) {
            let text = Text::new(
                format!("`#{name}` is misspelt: it is written `#version`, in small letters."),
                format!("`#{name}` は綴りが違います。小文字で `#version` と書きます。"),
            );
            return Some(file.error(line.start, line.text.len(), text));
        }
    }
    let first = file.code.first().filter(|first| first.text == "version" || is_meant(first.text));
    if let Some(first) = first.filter(|_| file.code.get(1).is_some_and(|next| next.kind == LexemeKind::Number)) {
        let text = Text::new(
            format!("`{}` lacks the `#` before it: the line is written `#version …`.", first.text),
            format!("`{}` の前に `#` がありません。`#version …` と書きます。", first.text),
        );
        return Some(file.error_at(0, text));
    }
    let commented = version_in_comment(file)?;
    let text = Text::new(
        "This `#version` stands in a comment, so the compiler does not read it.",
        "この `#version` はコメントの中にあるので、コンパイラに読まれません。",
    );
    Some(file.error(commented, "#version".len(), text))
}

/// Where a line of a comment is a `#version`.
fn version_in_comment(file: &HintContext<'_>) -> Option<usize> {
    let mut start = 0;
    file.text.split_inclusive('\n').find_map(|line| {
        let at = start;
        start += line.len();
        let rest = line.trim_start_matches(|c: char| c.is_whitespace() || matches!(c, '/' | '*'));
        (rest.starts_with('#') && directive_name(rest) == "version").then(|| at + line.len() - rest.len())
    })
}

/// The `#version` of what is handed out.
pub fn version_hint(file: &HintContext<'_>) -> Text {
    let version = &file.interface.version;
    Text::new(
        format!("The file of this assignment begins with `{version}`."),
        format!("この課題のファイルは `{version}` で始めます。"),
    )
}

#[cfg(test)]
mod line_tests {
    use super::without_line_directives;

    #[test]
    fn blanks_line_directives_and_nothing_else() {
        let text = "a;\n # line 5 // 光\nb;\n#line \\\n 7 2\n// #line 3\n/*\n#line 4\n*/ #linear\n";
        let blanked = without_line_directives(text).expect("the text has #line");
        assert_eq!(blanked, "a;\n          // 光\nb;\n       \n    \n// #line 3\n/*\n#line 4\n*/ #linear\n");
        assert_eq!(blanked.len(), text.len());
    }

    #[test]
    fn says_when_there_is_none() {
        assert_eq!(without_line_directives("// #line 3\nint line;\n"), None);
    }
}
