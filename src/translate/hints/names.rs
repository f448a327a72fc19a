//! Names that are not there, and those that were meant.

use super::declarations::DeclarationKind;
use super::file::{HintContext, macro_name};
use super::tokens::LexemeKind;
use super::vocabulary;
use super::{CompilerMessage, LogEntry, suggestions};
use crate::diagnostic::Diagnostic;
use crate::language::Text;

/// The index of the code token that `entry` is about; `offset` is where the compiler noticed.
pub fn locate(file: &HintContext<'_>, entry: &LogEntry<'_>, offset: usize) -> usize {
    let at = file.index_at(offset);
    // The token of this message is a keyword, its place that of the name.
    if entry.message.starts_with("non-matching") {
        return at;
    }
    let call = entry.message.starts_with("no matching overloaded") || entry.token == "constructor";
    // The compiler notices at the end of the arguments, which may be lines below the name.
    if call && file.word(Some(at)) == ")" {
        let name = file.opening(at).and_then(|open| open.checked_sub(1));
        if let Some(name) = name.filter(|&name| entry.token == "constructor" || file.code[name].text == entry.token) {
            return name;
        }
    }
    let line = file.line(offset);
    let on_line = file.code.iter().enumerate().filter(|(_, token)| file.line(token.start) == line);
    let same = on_line.filter(|(_, token)| token.text == entry.token);
    same.min_by_key(|(_, token)| token.start.abs_diff(offset)).map_or(at, |(index, _)| index)
}

/// Whether `name` is a function, a type or a variable that can be called or indexed by its name at least.
pub fn is_callable(file: &HintContext<'_>, name: &str) -> bool {
    let known = vocabulary::is_function(file.interface.stage, name) || vocabulary::is_type(name) || name.is_empty();
    let declared = file.declarations.iter().any(|d| d.name == name && d.role != DeclarationKind::Function);
    let function = file.declarations.iter().any(|d| d.name == name && d.role == DeclarationKind::Function);
    known || declared || function
}

/// Puts a message about a name into words.
pub fn explain(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Option<Diagnostic> {
    let name = finding.entry.token;
    let message = finding.entry.message;
    if message.starts_with("undeclared identifier") {
        return Some(undeclared(file, finding, name));
    }
    if finding.unknown_function {
        return Some(unknown_function(file, finding, name));
    }
    if message.starts_with("no matching overloaded") && !vocabulary::is_function(file.interface.stage, name) {
        return defined_later(file, finding, name);
    }
    if message.starts_with("can't use function syntax on variable") {
        let text = Text::new(
            format!("`{name}` is a variable and cannot be called like a function."),
            format!("`{name}` は変数なので、関数のように呼び出すことはできません。"),
        );
        return Some(file.error_at(finding.index, text).hint(Text::new(
            "Is there a `*` missing between the name and the parenthesis?",
            "名前と括弧の間の `*` が抜けていませんか。",
        )));
    }
    if message.starts_with("function call, method, or subroutine call expected") {
        let text =
            Text::new("What stands before this `(` is no function.", "この `(` の前にあるものは関数ではありません。");
        return Some(
            file.error_at(finding.index, text)
                .hint(Text::new("Is a `*` missing before the parenthesis?", "括弧の前の `*` が抜けていませんか。")),
        );
    }
    None
}

fn undeclared(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>, name: &str) -> Diagnostic {
    let next = file.code.get(finding.index + 1);
    let is_type =
        next.is_some_and(|next| next.kind == LexemeKind::Word) && !vocabulary::is_function(file.interface.stage, name);
    if file.word(Some(finding.index)) == name && is_type {
        return unknown_type(file, finding.index);
    }
    if vocabulary::is_function(file.interface.stage, name) {
        let text = Text::new(
            format!("`{name}` is a function: its arguments stand in parentheses `( )`."),
            format!("`{name}` は関数です。引数を括弧 `( )` で囲んでください。"),
        );
        return file.error_at(finding.index, text);
    }
    if let Some(swallowed) = file.swallowed(name) {
        return swallowed;
    }
    let text = Text::new(format!("`{name}` is not declared."), format!("`{name}` は宣言されていません。"));
    place(file, finding, name, text).hint(suggestions::hint_for_variable(file, finding, name))
}

/// A diagnostic about `name`: where it stands, or in the macro that brought it to the line of the message.
fn place(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>, name: &str, text: Text) -> Diagnostic {
    if file.word(Some(finding.index)) == name || file.anywhere(name).is_some() {
        return file.error_at(finding.index, text);
    }
    let found = file.directives.iter().find_map(|line| {
        let after = line.text.find(macro_name(line.text)?)?;
        let body = super::tokens::tokens(&line.text[after..]);
        let word = body.iter().find(|token| token.kind == LexemeKind::Word && token.text == name);
        word.map(|token| line.start + after + token.start)
    });
    match found {
        Some(offset) => {
            let used = finding.entry.place.map_or(0, |(line, _)| line);
            let text = Text::new(
                format!("{} This macro is used on line {used}.", text.en),
                format!("{}このマクロは {used} 行目で使われています。", text.ja),
            );
            file.error(offset, name.len(), text)
        }
        None => file.error_at(finding.index, text),
    }
}

fn unknown_function(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>, name: &str) -> Diagnostic {
    let text = Text::new(format!("There is no function `{name}`."), format!("`{name}` という関数はありません。"));
    let functions = || file.declarations.iter().filter(|d| d.role == DeclarationKind::Function).map(|d| d.name);
    let otherwise = || {
        let text = "`else if (…)`";
        let hint = Text::new(format!("It is written {text}."), format!("{text} と書きます。"));
        matches!(name, "elseif" | "elsif" | "elif").then_some(hint)
    };
    let handed_out = || file.interface.functions.iter().map(String::as_str);
    // Of names that are as near, a student's own is meant rather than one of GLSL.
    let nearest = || {
        vocabulary::nearest(name, functions().chain(handed_out()).chain(vocabulary::callables(file.interface.stage)))
    };
    let hint = suggestions::from_elsewhere(file, name)
        .or_else(otherwise)
        .or_else(|| handed_out().any(|own| own == name).then(|| suggestions::deleted_function(name)))
        .or_else(|| {
            let meant = nearest().or_else(|| vocabulary::of_one_word(name, functions()))?;
            Some(suggestions::did_you_mean(file, name, meant, usize::MAX - 1))
        });
    let diagnostic = place(file, finding, name, text);
    match hint {
        Some(hint) => diagnostic.hint(hint),
        None => diagnostic,
    }
}

/// A function of the file that is called before it is defined.
fn defined_later(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>, name: &str) -> Option<Diagnostic> {
    let call = file.code.get(finding.index)?.start;
    let function = file.declarations.iter().find(|d| d.name == name && d.role == DeclarationKind::Function)?;
    if function.start < call {
        return None;
    }
    let line = file.line(function.start);
    let text = Text::new(
        format!("The function `{name}` is called before it is defined (line {line})."),
        format!("関数 `{name}` が、定義 ({line} 行目) より前で呼び出されています。"),
    );
    Some(file.error_at(finding.index, text).hint(Text::new(
        "Move its definition above the function that calls it, or declare it there first.",
        "呼び出す関数より前に定義を移すか、先に関数の宣言 (プロトタイプ) を書いてください。",
    )))
}

/// A word at `index` that stands where a type or a qualifier belongs.
pub fn unknown_type(file: &HintContext<'_>, index: usize) -> Diagnostic {
    let name = file.code[index].text;
    if name == "main" {
        let text = Text::new("The type that `main` returns is missing.", "`main` の戻り値の型がありません。");
        let hint = Text::new("It is declared as `void main()`.", "`void main()` と宣言します。");
        return file.error_at(index, text).hint(hint);
    }
    let text = Text::new(
        format!("`{name}` is neither a type nor a keyword of GLSL."),
        format!("`{name}` は GLSL の型でもキーワードでもありません。"),
    );
    let structures = file.declarations.iter().filter(|d| d.role == DeclarationKind::Structure).map(|d| d.name);
    let hint = suggestions::from_elsewhere(file, name).or_else(|| {
        let meant = vocabulary::nearest(name, vocabulary::keywords().chain(structures))?;
        Some(Text::new(format!("Did you mean `{meant}`?"), format!("`{meant}` の間違いではありませんか。")))
    });
    let hint = hint.or_else(|| {
        let keyword = vocabulary::keywords().filter(|word| word.len() > 2).find(|word| name.starts_with(word))?;
        let rest = &name[keyword.len()..];
        Some(Text::new(
            format!("Is a space missing, as in `{keyword} {rest}`?"),
            format!("`{keyword} {rest}` のように空白が必要ではありませんか。"),
        ))
    });
    file.error_at(index, text).hint(hint.unwrap_or_else(|| {
        Text::new(
            "If this is meant as a remark, write `//` in front of it.",
            "説明を書いた行であれば、先頭に `//` を付けてコメントにしてください。",
        )
    }))
}
