//! Recognises text files that are no shader, or a shader of another stage.

use super::looks_like;
use crate::diagnostic::Diagnostic;
use crate::language::Text;
use crate::source::Source;
use reference::interpreter::Stage;

/// Words that only shaders of one stage have, other than the vertex stage. Those of the fragment stage come first.
const OTHER_STAGES: [(&[&str], &str, &str); 4] = [
    (
        &["gl_FragCoord", "gl_FragColor", "gl_FragData", "gl_FragDepth", "discard"],
        "the fragment shader",
        "フラグメントシェーダ",
    ),
    (&["EmitVertex", "EndPrimitive"], "a geometry shader", "ジオメトリシェーダ"),
    (&["gl_TessLevelOuter", "gl_TessCoord"], "a tessellation shader", "テッセレーションシェーダ"),
    (&["gl_GlobalInvocationID", "gl_LocalInvocationID"], "a compute shader", "コンピュートシェーダ"),
];

/// Why the text of `source` is no shader of this stage, where it is not.
pub(in crate::source) fn wrong_text(source: &Source, stage: Stage) -> Option<Diagnostic> {
    if source.code().trim().is_empty() {
        return Some(empty(source));
    }
    let found = markup(source).or_else(|| wrapped(source)).or_else(|| cpp_with_main(source));
    let of_fragments = |word: &str| OTHER_STAGES[0].0.contains(&word);
    match stage {
        _ if found.is_some() => found,
        Stage::Vertex if has_word(source, "gl_Position") => None,
        Stage::Vertex => other_program(source, &OTHER_STAGES),
        Stage::Fragment if source.words().any(|(_, word)| of_fragments(word)) => None,
        Stage::Fragment => vertex_shader(source).or_else(|| other_program(source, &OTHER_STAGES[1..])),
    }
}

/// A vertex shader: it writes `gl_Position`, which no other stage here has.
fn vertex_shader(source: &Source) -> Option<Diagnostic> {
    let (at, word) = source.words().find(|(_, word)| *word == "gl_Position")?;
    let (line, column) = source.position(at);
    Some(looks_like("the vertex shader", "頂点シェーダ").at(line, Some(column)).spanning(word.len()))
}

/// The refusal of a fragment shader: one that takes in the variable that the vertex shader has to write, `varying`,
/// and has no `gl_Position`.
pub fn fragment_shader(source: &Source, varying: &str) -> Option<Diagnostic> {
    let words: Vec<_> = source.words().collect();
    // `in vec4 NAME`, with or without a precision.
    let declaration = words.iter().enumerate().find(|&(index, (_, word))| {
        let before = |count: usize| index.checked_sub(count).and_then(|at| words.get(at)).map(|(_, word)| *word);
        *word == varying
            && (before(2) == Some("in") || (before(3) == Some("in") && before(2).is_some_and(is_precision)))
    })?;
    if has_word(source, "gl_Position") {
        return None;
    }
    let (line, column) = source.position(declaration.1.0);
    Some(looks_like("the fragment shader", "フラグメントシェーダ").at(line, Some(column)).spanning(varying.len()))
}

fn is_precision(word: &str) -> bool {
    matches!(word, "highp" | "mediump" | "lowp")
}

fn has_word(source: &Source, wanted: &str) -> bool {
    source.words().any(|(_, word)| word == wanted)
}

/// The number of the first line of code that `matches`.
fn line_where(source: &Source, matches: impl Fn(&str) -> bool) -> Option<u32> {
    (1..=source.line_count()).find(|&number| matches(source.code_line(number).trim()))
}

fn empty(source: &Source) -> Diagnostic {
    let message = if source.facts.bytes == 0 {
        Text::new("The file is empty.", "ファイルの中身が空です。")
    } else if source.text.trim().is_empty() {
        Text::new("The file holds nothing but white space.", "ファイルに空白と改行しか入っていません。")
    } else {
        Text::new("The file holds nothing but comments.", "ファイルにコメントしか入っていません。")
    };
    let open = source.comments.last().filter(|comment| !comment.to_line_end && comment.range.end == source.text.len());
    let diagnostic = Diagnostic::error(crate::diagnostic::DiagnosticStage::Source, message)
        .hint(Text::new("Was it saved before you handed it in?", "提出する前に保存したか確かめてください。"));
    let Some(open) = open else { return diagnostic };
    let (line, column) = source.position(open.range.start);
    diagnostic.at(line, Some(column)).spanning(2).hint(Text::new(
        "This comment has no end: where is its */ ?",
        "このコメントが閉じられていません。対応する */ を確かめてください。",
    ))
}

/// HTML and XML: no GLSL begins with `<`.
fn markup(source: &Source) -> Option<Diagnostic> {
    let start = source.code().trim_start();
    if !start.starts_with('<') || start.starts_with("<<") {
        return None;
    }
    let is_html = start.get(..200).unwrap_or(start).to_lowercase().contains("html");
    let refusal = if is_html {
        looks_like("a web page (HTML)", "Web ページ（HTML）").hint(Text::new(
            "Saving a page keeps the page, not the shader that it shows. Use the page's download link (“Raw” on GitHub) and hand in the .vert file.",
            "ページを保存すると、シェーダではなくページ自体が保存されます。ダウンロード用のリンク（GitHub なら「Raw」）から .vert ファイルを取得してください。",
        ))
    } else {
        looks_like("an XML file", "XML ファイル")
    };
    let line = line_where(source, |line| !line.is_empty())?;
    Some(refusal.at(line, None))
}

/// A shader inside something else: a patch, a conflict of a merge, a fence of Markdown.
fn wrapped(source: &Source) -> Option<Diagnostic> {
    if let Some(line) = line_where(source, |line| line.starts_with("<<<<<<< ")) {
        return Some(conflict().at(line, None));
    }
    let hunk = line_where(source, |line| line.starts_with("@@ -"));
    if hunk.is_some() || source.code().trim_start().starts_with("diff --git ") {
        return Some(looks_like("a patch (diff)", "差分（diff、パッチ）ファイル").at(hunk.unwrap_or(1), None));
    }
    let fence = line_where(source, |line| line.starts_with("```"))?;
    Some(fenced().at(fence, Some(1)).spanning(3))
}

fn conflict() -> Diagnostic {
    let message = Text::new(
        "The marks of a Git merge conflict are still in the file.",
        "Git のマージで競合した箇所の印（<<<<<<<）が残っています。",
    );
    Diagnostic::error(crate::diagnostic::DiagnosticStage::Source, message).hint(Text::new(
        "Keep one of the two versions and delete the lines <<<<<<<, ======= and >>>>>>>.",
        "どちらか一方を残し、<<<<<<<、=======、>>>>>>> の行を削除してください。",
    ))
}

fn fenced() -> Diagnostic {
    let message = Text::new(
        "The shader is wrapped in a Markdown code fence (```), which is not GLSL.",
        "シェーダが Markdown のコードブロックの印（```）で囲まれています。これは GLSL ではありません。",
    );
    Diagnostic::error(crate::diagnostic::DiagnosticStage::Source, message).hint(Text::new(
        "Delete the lines that begin with ``` and everything outside of them.",
        "``` で始まる行と、その外側の文章を削除してください。",
    ))
}

/// A program in another language, or for another stage. Only asked where nothing writes `gl_Position`.
fn other_program(source: &Source, stages: &[(&[&str], &str, &str)]) -> Option<Diagnostic> {
    for &(marks, en, ja) in stages {
        if let Some((at, word)) = source.words().find(|(_, word)| marks.contains(word)) {
            let (line, column) = source.position(at);
            return Some(looks_like(en, ja).at(line, Some(column)).spanning(word.len()));
        }
    }
    let is_cpp = |line: &str| is_include(line) || line.contains("std::") || line.starts_with("using namespace ");
    if let Some(line) = line_where(source, is_cpp) {
        return Some(cpp(line));
    }
    let python = line_where(source, |line| line.starts_with("def ") && line.ends_with(':'));
    python.map(|line| looks_like("a Python program", "Python のプログラム").at(line, None))
}

/// A C++ program that has the text of a shader inside of it: no GLSL has both an `#include` and an `int main`.
fn cpp_with_main(source: &Source) -> Option<Diagnostic> {
    let include = line_where(source, is_include)?;
    let words: Vec<_> = source.words().map(|(_, word)| word).collect();
    words.windows(2).any(|pair| pair == ["int", "main"]).then(|| cpp(include))
}

fn is_include(line: &str) -> bool {
    line.strip_prefix('#').is_some_and(|rest| rest.trim_start().starts_with("include"))
}

fn cpp(line: u32) -> Diagnostic {
    looks_like("a C++ program", "C++ のプログラム").at(line, None)
}
