//! The solution, changed: what a rubric line's feature is told by, and what a mistake draws.

use super::stages::Stages;
use super::{CheckResult, listed};
use crate::accepted::AcceptedAnswer;
use crate::assignment::{HandedIn, error};
use crate::manifest;
use crate::text::both;
use crate::together::with_number;

/// Makes programs of variants.
pub(super) struct Variants<'a> {
    pub files: &'a [HandedIn],
    pub stages: &'a Stages,
    pub read: &'a dyn Fn(&str) -> CheckResult<String>,
}

impl Variants<'_> {
    /// The program of a variant; `place`: where it stands.
    pub fn program(&self, variant: &manifest::Variant, place: &str) -> CheckResult<AcceptedAnswer> {
        self.program_with(variant, None, place)
    }

    /// The same with a number in place of a name.
    pub fn program_with(
        &self,
        variant: &manifest::Variant,
        number: Option<(&str, f64)>,
        place: &str,
    ) -> CheckResult<AcceptedAnswer> {
        let manifest::Variant { define, replace, file, of } = variant;
        if define.is_empty() && replace.is_empty() && file.is_none() {
            let message = both(
                "changes nothing: write `define`, `replace` or `file`",
                "変わるものがありません。`define`、`replace`、`file` のいずれかを書いてください",
            );
            return Err(error(place, message));
        }
        let mut texts: Vec<String> = self.files.iter().map(|file| file.solution.text.clone()).collect();
        let meant = self.meant(of.as_deref(), place)?;
        if let Some(name) = file {
            let [only] = meant[..] else { return Err(self.which(place)) };
            texts[only] = (self.read)(name)?;
        }
        for [from, to] in replace {
            let count = |at: &usize| texts[*at].matches(from.as_str()).count();
            let places: Vec<usize> = meant.iter().copied().filter(|at| count(at) > 0).collect();
            let found: usize = places.iter().map(count).sum();
            let ([at], 1) = (&places[..], found) else {
                let names = listed(meant.iter().map(|at| self.files[*at].solution.name.as_str()));
                let message = both(
                    format!("`{from}` stands {found} times in {names}: write a text that stands there once"),
                    format!("`{from}` は {names} に {found} 回あります。1 回だけ現れる文字列を書いてください"),
                );
                return Err(error(place, message));
            };
            let to = number.map_or_else(|| to.clone(), |(name, value)| with_number(to, name, value));
            texts[*at] = texts[*at].replacen(from.as_str(), &to, 1);
        }
        let texts: Vec<String> = texts.iter().map(|text| with_macros(text, define)).collect();
        let changed = self.files.iter().zip(texts.iter().cloned());
        let changed: Vec<_> = changed.filter(|(file, text)| *text != file.solution.text).collect();
        let replaced = if define.is_empty() && file.is_none() { replace.clone() } else { Vec::new() };
        Ok(AcceptedAnswer { replaced, texts, ..self.stages.changed(&changed, place)? })
    }

    /// The files that a variant may change.
    fn meant(&self, of: Option<&str>, place: &str) -> CheckResult<Vec<usize>> {
        let all = 0..self.files.len();
        match of {
            None => Ok(all.collect()),
            Some(name) => match all.into_iter().find(|at| self.files[*at].name == name) {
                Some(at) => Ok(vec![at]),
                None => Err(self.which(place)),
            },
        }
    }

    fn which(&self, place: &str) -> crate::AssignmentError {
        let names = listed(self.files.iter().map(|file| file.name.as_str()));
        let message = both(
            format!("which file is changed? Write `of` with one of {names}"),
            format!("どのファイルを変えるのか、`of` に {names} のいずれかを書いてください"),
        );
        error(place, message)
    }
}

/// The text with macros defined behind its first line with `#version`.
fn with_macros(text: &str, define: &[String]) -> String {
    let defined: String = define.iter().map(|name| format!("#define {name}\n")).collect();
    let version = text.split_inclusive('\n').scan(0, |start, line| {
        let own = *start;
        *start += line.len();
        Some((own, line))
    });
    let behind = version.into_iter().find(|(_, line)| line.trim_start().starts_with("#version"));
    let at = behind.map_or(0, |(start, line)| start + line.len());
    let separator = if at > 0 && !text[..at].ends_with('\n') { "\n" } else { "" };
    if define.is_empty() { text.to_owned() } else { [&text[..at], separator, &defined, &text[at..]].concat() }
}
