//! What this compiler refuses and drivers take: the text is changed so that it takes it too.

use super::log::{self, LogEntry};
use super::{TranslationRefusal, spirv, text, unsupported};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::ffi::glslang::CompilerOutput;
use crate::language::Text;
use crate::source::Source;

/// The version from which on `shared` is a keyword.
const SHARED_VERSION: i32 = 430;

/// The text that has been granted what the compiler minded, and the warnings for it.
pub(super) struct Granted {
    pub text: String,
    pub warnings: Vec<Diagnostic>,
    pub renamed: Vec<Renamed>,
}

/// A name of the student's that the compiler sees as another one of the same length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Renamed {
    own: &'static str,
    ours: &'static str,
}

/// What the compiler says, in the student's own names.
pub(super) fn in_own_names(outcome: &mut CompilerOutput, renamed: &[Renamed]) {
    for Renamed { own, ours } in renamed {
        for log in [&mut outcome.link_log].into_iter().chain(outcome.logs.iter_mut().map(|(_, log)| log)) {
            let places: Vec<usize> = text::words(log).filter(|(_, word)| word == ours).map(|(at, _)| at).collect();
            for at in places {
                log.replace_range(at..at + ours.len(), own);
            }
        }
        spirv::rename(&mut outcome.spirv, ours, own);
    }
}

/// Looks in the `log` of a refused `text` for what drivers take; `None` where there is nothing of the kind.
pub(super) fn grant(text: &str, log: &str, source: &Source) -> Option<Granted> {
    let entries = log::entries(log);
    let errors = || entries.iter().filter(|entry| entry.is_error);
    let mut granted = Granted { text: text.to_owned(), warnings: Vec::new(), renamed: Vec::new() };
    for entry in errors().filter(|entry| entry.token == "extraneous semicolon") {
        granted.semicolon(entry, source);
    }
    if entries.iter().any(|entry| entry.token == "line continuation") {
        granted.continuations(source);
    }
    let version = source.version();
    if version < SHARED_VERSION && errors().any(|entry| entry.message.contains("unexpected SHARED")) {
        granted.rename("shared", "shareD", |text, at| !text::is_in_layout(text, at));
    }
    if errors().any(|entry| entry.token == "length") {
        let is_call = |text: &str, at: usize| text[at + "length".len()..].trim_start().starts_with('(');
        granted.rename("length", "lengtH", |text, at| !is_call(text, at));
    }
    (granted.text != text).then_some(granted)
}

/// The message of a feature that the compiler knows to be valid and cannot take.
pub(super) fn unimplemented(log: &str) -> Option<String> {
    let entries = log::entries(log);
    entries.iter().find(|entry| entry.message == "feature not yet implemented").map(|entry| entry.token.to_owned())
}

/// From this version on, drivers have no `texture2D` and its like.
const NO_OLD_LOOKUPS: i32 = 420;

/// What the names of old lookups go on with behind `texture` or `shadow`.
const KINDS_OF_TEXTURE: [&str; 4] = ["1D", "2D", "3D", "Cube"];

/// The lookup of today that one of old GLSL is; none where there is none of the same kind, as for shadows.
fn lookup_of_today(word: &str) -> Option<&'static str> {
    let kind = word.strip_prefix("texture")?;
    let rest = KINDS_OF_TEXTURE.iter().find_map(|start| kind.strip_prefix(start))?;
    Some(match rest {
        "" => "texture",
        "Lod" => "textureLod",
        "Proj" => "textureProj",
        "ProjLod" => "textureProjLod",
        _ => return None,
    })
}

/// The functions of old GLSL, called and not the student's own, at which the compiler ends the process.
fn old_lookups(code: &str) -> Vec<(usize, &str)> {
    let is_old = |word: &str| {
        let kind = word.strip_prefix("texture").or_else(|| word.strip_prefix("shadow"));
        kind.is_some_and(|kind| KINDS_OF_TEXTURE.iter().any(|start| kind.starts_with(start)))
    };
    let is_called = |at: usize, word: &str| code[at + word.len()..].trim_start().starts_with('(');
    // Behind a type stands a declaration.
    let is_own = |at: usize| {
        let before = code[..at].trim_end();
        before.ends_with(|c: char| c.is_ascii_alphanumeric() || c == '_') && !before.ends_with("return")
    };
    let called = || text::words(code).filter(|&(at, word)| is_old(word) && is_called(at, word));
    let own: Vec<&str> = called().filter(|&(at, _)| is_own(at)).map(|(_, word)| word).collect();
    called().filter(|(_, word)| !own.contains(word)).collect()
}

/// What neither the compiler takes nor anything else says: an old lookup that drivers have no more, or that has no other name.
pub(super) fn refuse_old_lookups(source: &Source) -> Result<(), TranslationRefusal> {
    let code = source.code();
    let is_gone = source.version() >= NO_OLD_LOOKUPS;
    let found = old_lookups(code).into_iter().find(|(_, word)| is_gone || lookup_of_today(word).is_none());
    let Some((at, word)) = found else { return Ok(()) };
    let Some(today) = lookup_of_today(word).filter(|_| is_gone) else {
        return Err(unsupported(&format!("`{word}`")).into());
    };
    let (line, column) = source.position(at);
    let message = Text::new(
        format!("There is no function `{word}` in this version of GLSL."),
        format!("この GLSL のバージョンに関数 `{word}` はありません。"),
    );
    let hint = Text::new(format!("Its name is `{today}`."), format!("`{today}` と書きます。"));
    let error =
        Diagnostic::error(DiagnosticStage::Compile, message).hint(hint).at(line, Some(column)).spanning(word.len());
    Err(TranslationRefusal::Rejected(vec![error]))
}

/// The text with the lookups of today, each on as many columns, and a warning for the first.
pub(super) fn with_lookups_of_today(text: String, source: &Source) -> (String, Option<Diagnostic>) {
    let old = old_lookups(source.code());
    let Some((at, word)) = old.first() else { return (text, None) };
    let mut renewed = text.clone();
    for (at, word) in old_lookups(&text) {
        if let Some(today) = lookup_of_today(word) {
            renewed.replace_range(at..at + word.len(), &format!("{today:width$}", width = word.len()));
        }
    }
    let today = lookup_of_today(word).unwrap_or("texture");
    let message = Text::new(
        format!("`{word}` is a name of old GLSL, which drivers from GLSL 4.20 on refuse: write `{today}`."),
        format!(
            "`{word}` は古い GLSL の関数で、GLSL 4.20 以降のドライバではエラーになります。`{today}` と書きましょう。"
        ),
    );
    let (line, column) = source.position(*at);
    (renewed, Some(Diagnostic::warning(DiagnosticStage::Compile, message).at(line, Some(column)).spanning(word.len())))
}

impl Granted {
    /// A `;` outside functions that ends nothing.
    fn semicolon(&mut self, entry: &LogEntry<'_>, source: &Source) {
        let Some(at) = offset(&self.text, entry).filter(|&at| self.text.as_bytes().get(at) == Some(&b';')) else {
            return;
        };
        self.text.replace_range(at..=at, " ");
        let message = Text::new(
            "This `;` ends nothing. Drivers that keep strictly to GLSL before 4.60 refuse it; others let it pass.",
            "この `;` は余分です。GLSL 4.60 より前の規格に厳密なドライバではエラーになります。",
        );
        let (line, column) = source.position(at);
        self.warnings.push(Diagnostic::warning(DiagnosticStage::Compile, message).at(line, Some(column)));
    }

    fn continuations(&mut self, source: &Source) {
        let Some(text) = text::continued(&self.text, source.code()) else { return };
        self.text = text;
        let message = Text::new(
            "A line continued with `\\` belongs to GLSL 4.20 and later; drivers that keep strictly to this `#version` \
             refuse it.",
            "行末の `\\` による行の継続は GLSL 4.20 以降の機能です。この `#version` に厳密なドライバではエラーになります。",
        );
        let first = (1..=source.line_count()).find(|&number| source.code_line(number).ends_with('\\'));
        let warning = Diagnostic::warning(DiagnosticStage::Compile, message);
        self.warnings.push(match first {
            Some(line) => warning.at(line, Some(source.code_line(line).chars().count() as u32)),
            None => warning,
        });
    }

    /// Gives a name that the compiler keeps for itself another of the same length, unless the text has that too.
    fn rename(&mut self, name: &'static str, new: &'static str, is_name: impl Fn(&str, usize) -> bool) {
        if text::words(&self.text).any(|(_, word)| word == new) {
            return;
        }
        let places: Vec<usize> = text::words(&self.text)
            .filter(|&(at, word)| word == name && is_name(&self.text, at))
            .map(|(at, _)| at)
            .collect();
        for at in places {
            self.text.replace_range(at..at + name.len(), new);
        }
        self.renamed.push(Renamed { own: name, ours: new });
    }
}

/// Where an entry points, in bytes.
fn offset(text: &str, entry: &LogEntry<'_>) -> Option<usize> {
    let (line, column) = entry.place?;
    let before: usize = text.split_inclusive('\n').take((line as usize).checked_sub(1)?).map(str::len).sum();
    Some(before + (column as usize).checked_sub(1)?)
}
