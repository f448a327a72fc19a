//! Texture lookups of GLSL 1.x, at which the compiler ends the process, and which drivers take up to GLSL 4.10.

use super::{TranslationRefusal, portability, unsupported};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;
use crate::source::{self, Source};
use reference::interpreter::lookup_of_today;
use std::collections::BTreeMap;

/// From this version on, drivers have no `texture2D` and its like outside the compatibility profile.
const NO_OLD_LOOKUPS: i32 = 420;

/// From this version on, there are the lookups of today.
pub(super) const FIRST_OF_TODAY: i32 = 130;

/// What the names of old lookups go on with behind `texture` or `shadow`.
const KINDS_OF_TEXTURE: [&str; 4] = ["1D", "2D", "3D", "Cube"];

/// Names for the parameters of a macro; no lookup has more.
const PARAMETERS: [&str; 4] = ["a", "b", "c", "d"];

/// A function of old GLSL that is called, and is not the student's own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct OldLookup<'a> {
    /// The byte that it stands at.
    at: usize,
    word: &'a str,
    /// How many arguments it is given; `None` where its parentheses do not end.
    arguments: Option<usize>,
}

/// A text in which the compiler finds the lookups of today.
pub(super) struct Renewed {
    pub text: String,
    /// Macros that stand before the text without counting as lines.
    pub preamble: String,
    /// About the first of the old lookups.
    pub warning: Option<Diagnostic>,
}

impl<'a> OldLookup<'a> {
    /// All of a text.
    fn all(code: &'a str) -> Vec<Self> {
        let is_old = |word: &str| {
            let kind = word.strip_prefix("texture").or_else(|| word.strip_prefix("shadow"));
            kind.is_some_and(|kind| KINDS_OF_TEXTURE.iter().any(|start| kind.starts_with(start)))
        };
        let is_called = |at: usize, word: &str| code[at + word.len()..].trim_start().starts_with('(');
        // Behind a type stands a declaration.
        let is_own = |at: usize, word: &str| {
            let before = code[..at].trim_end();
            let is_behind_a_word = before.ends_with(|c: char| c.is_ascii_alphanumeric() || c == '_');
            before.ends_with("#define") || is_called(at, word) && is_behind_a_word && !before.ends_with("return")
        };
        let old = || source::words(code).filter(|(_, word)| is_old(word));
        let own: Vec<&str> = old().filter(|&(at, word)| is_own(at, word)).map(|(_, word)| word).collect();
        let foreign = old().filter(|&(at, word)| is_called(at, word) && !own.contains(&word));
        foreign.map(|(at, word)| Self { at, word, arguments: arguments(&code[at + word.len()..]) }).collect()
    }

    /// Whether it compares depths. It gives a vector of four, and that of today one number.
    fn is_shadow(&self) -> bool {
        self.word.starts_with("shadow")
    }

    /// The lookup of today that it is; `None` where there is none of the same kind.
    fn of_today(&self) -> Option<&'static str> {
        lookup_of_today(self.word)
    }

    /// A macro of its name that gives what it gave.
    fn as_macro(&self) -> Option<String> {
        let parameters = PARAMETERS.get(..self.arguments?)?.join(", ");
        Some(format!("#define {}({parameters}) vec4({}({parameters}))\n", self.word, self.of_today()?))
    }
}

/// How many arguments stand in the parentheses that a text begins with.
fn arguments(text: &str) -> Option<usize> {
    let mut depth = 0;
    let mut commas = 0;
    for c in text.chars() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            ',' if depth == 1 => commas += 1,
            _ => {}
        }
        if depth == 0 && c == ')' {
            return Some(commas + 1);
        }
    }
    None
}

/// The macros for the lookups of a text that compare depths, by their names. `Err`: the name of one that is called in several ways,
/// which no macro is.
fn macros<'a>(lookups: &[OldLookup<'a>]) -> Result<BTreeMap<&'a str, String>, &'a str> {
    let mut found: BTreeMap<&str, String> = BTreeMap::new();
    for lookup in lookups.iter().filter(|lookup| lookup.is_shadow()) {
        let own = lookup.as_macro().ok_or(lookup.word)?;
        if found.insert(lookup.word, own.clone()).is_some_and(|before| before != own) {
            return Err(lookup.word);
        }
    }
    Ok(found)
}

/// What neither the compiler takes nor anything else says: an old lookup that drivers have no more, or that has no other name.
pub(super) fn refuse(source: &Source) -> Result<(), TranslationRefusal> {
    let is_gone = source.version() >= NO_OLD_LOOKUPS && !portability::is_compatible(source);
    let lookups = OldLookup::all(source.code());
    let unknown = lookups.iter().find(|lookup| lookup.of_today().is_none()).map(|lookup| lookup.word);
    match lookups.iter().find(|lookup| lookup.of_today().is_some()) {
        Some(lookup) if is_gone => Err(TranslationRefusal::Rejected(vec![gone(source, lookup)])),
        _ => match unknown.or_else(|| macros(&lookups).err()) {
            Some(word) => Err(unsupported(&format!("`{word}`")).into()),
            None => Ok(()),
        },
    }
}

fn gone(source: &Source, lookup: &OldLookup<'_>) -> Diagnostic {
    let (word, today) = (lookup.word, lookup.of_today().unwrap_or("texture"));
    let message = Text::new(
        format!("There is no function `{word}` in this version of GLSL."),
        format!("この GLSL のバージョンに関数 `{word}` はありません。"),
    );
    let hint = match lookup.is_shadow() {
        false => Text::new(format!("Its name is `{today}`."), format!("`{today}` と書きます。")),
        true => Text::new(
            format!("Its name is `{today}`, and it gives one number instead of a vector."),
            format!("`{today}` と書きます。結果はベクトルではなく 1 つの数です。"),
        ),
    };
    let (line, column) = source.position(lookup.at);
    Diagnostic::error(DiagnosticStage::Compile, message).hint(hint).at(line, Some(column)).spanning(word.len())
}

/// The text with the lookups of today, each on as many columns. Those that compare depths become macros, for they give vectors.
pub(super) fn renewed(text: String, source: &Source) -> Renewed {
    let old = OldLookup::all(source.code());
    let Some(first) = old.first() else { return Renewed { text, preamble: String::new(), warning: None } };
    let mut renewed = text.clone();
    for lookup in OldLookup::all(&text).iter().filter(|lookup| !lookup.is_shadow()) {
        if let Some(today) = lookup.of_today() {
            let width = lookup.word.len();
            renewed.replace_range(lookup.at..lookup.at + width, &format!("{today:width$}"));
        }
    }
    let preamble = macros(&old).map(|macros| macros.into_values().collect()).unwrap_or_default();
    Renewed { text: renewed, preamble, warning: Some(outdated(source, first)) }
}

fn outdated(source: &Source, lookup: &OldLookup<'_>) -> Diagnostic {
    let (word, today) = (lookup.word, lookup.of_today().unwrap_or("texture"));
    let old = Text::new(
        format!("`{word}` is a name of old GLSL, which drivers from GLSL 4.20 on refuse: write `{today}`"),
        format!(
            "`{word}` は古い GLSL の関数で、GLSL 4.20 以降のドライバではエラーになります。`{today}` と書きましょう"
        ),
    );
    let message = match lookup.is_shadow() {
        false => Text::new(format!("{}.", old.en), format!("{}。", old.ja)),
        true => Text::new(
            format!("{}, which gives one number instead of a vector.", old.en),
            format!("{}。結果はベクトルではなく 1 つの数です。", old.ja),
        ),
    };
    let (line, column) = source.position(lookup.at);
    Diagnostic::warning(DiagnosticStage::Compile, message).at(line, Some(column)).spanning(word.len())
}
