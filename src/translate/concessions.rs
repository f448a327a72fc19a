//! What this compiler refuses and drivers take: the text is changed so that it takes it too.

use super::log::{self, LogEntry};
use super::{spirv, text};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::ffi::glslang::CompilerOutput;
use crate::language::Text;
use crate::source::{self, Source};

/// The version from which on `shared` is a keyword.
const SHARED_VERSION: i32 = 430;

/// The version in which drivers have `inverse`, and the one in which the compiler has it first.
const INVERSE_VERSIONS: [i32; 2] = [140, 150];

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
            let places: Vec<usize> = source::words(log).filter(|(_, word)| word == ours).map(|(at, _)| at).collect();
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
    if version == INVERSE_VERSIONS[0]
        && let Some(entry) = errors().find(|entry| entry.token == "inverse")
    {
        granted.inverse(entry, source);
    }
    (granted.text != text).then_some(granted)
}

/// The message of a feature that the compiler knows to be valid and cannot take.
pub(super) fn unimplemented(log: &str) -> Option<String> {
    let entries = log::entries(log);
    entries.iter().find(|entry| entry.message == "feature not yet implemented").map(|entry| entry.token.to_owned())
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

    /// A function of the next version.
    fn inverse(&mut self, entry: &LogEntry<'_>, source: &Source) {
        let [own, next] = INVERSE_VERSIONS.map(|version| version.to_string());
        let Some(at) = self.text.find("version").and_then(|word| Some(word + self.text[word..].find(&own)?)) else {
            return;
        };
        self.text.replace_range(at..at + own.len(), &next);
        let message = Text::new(
            format!("Some drivers have `inverse` only from `#version {next}` on."),
            format!("`inverse` は `#version {next}` 以降でないと使えないドライバもあります。"),
        );
        let warning = Diagnostic::warning(DiagnosticStage::Compile, message);
        self.warnings.push(match entry.place.and_then(|_| offset(&self.text, entry)) {
            Some(at) => {
                let (line, column) = source.position(at);
                warning.at(line, Some(column))
            }
            None => warning,
        });
    }

    /// Gives a name that the compiler keeps for itself another of the same length, unless the text has that too.
    fn rename(&mut self, name: &'static str, new: &'static str, is_name: impl Fn(&str, usize) -> bool) {
        if source::words(&self.text).any(|(_, word)| word == new) {
            return;
        }
        let places: Vec<usize> = source::words(&self.text)
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
