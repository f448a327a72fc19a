//! The compiler's log → diagnostics: the cause first, at its own line, in words for a student.

use super::LinkedInterface;
use super::hints::{self, CompilerMessage, HintContext};
use crate::diagnostic::{Diagnostic, Severity};

/// No reader fixes more than this at a time; a hostile file can cause thousands.
pub const MAX_DIAGNOSTICS: usize = 20;

/// How many messages are looked into, each of which means a walk through the file.
const MAX_ENTRIES: usize = 100;

/// One message of the compiler.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LogEntry<'a> {
    /// Whether it refuses the file.
    pub is_error: bool,
    /// Line, and column in bytes, both from 1, where it names a place.
    pub place: Option<(u32, u32)>,
    /// What it is about.
    pub token: &'a str,
    /// What it says, without the lines that go on with it.
    pub message: &'a str,
    /// The lines that go on with it.
    pub more: Vec<&'a str>,
}

impl LogEntry<'_> {
    /// Whether this is where the parser gave up.
    pub fn is_syntax_error(&self) -> bool {
        self.message.starts_with("syntax error")
    }
}

/// Reads a log, without its sums.
pub fn entries(log: &str) -> Vec<LogEntry<'_>> {
    let mut all: Vec<LogEntry<'_>> = Vec::new();
    for line in log.lines() {
        let error = line.strip_prefix("ERROR: ");
        match error.or_else(|| line.strip_prefix("WARNING: ")) {
            Some(rest) => all.push(entry(rest, error.is_some())),
            None => {
                if let (Some(last), false) = (all.last_mut(), line.trim().is_empty()) {
                    last.more.push(line.trim());
                }
            }
        }
    }
    all.retain(|entry| !(entry.message.contains("compilation errors.") || entry.message == "compilation terminated"));
    all
}

fn entry(rest: &str, is_error: bool) -> LogEntry<'_> {
    let (place, rest) = place(rest).map_or((None, rest), |(place, rest)| (Some(place), rest));
    let (token, message) = rest.strip_prefix('\'').and_then(|quoted| quoted.split_once("' : ")).unwrap_or(("", rest));
    LogEntry { is_error, place, token, message: message.trim(), more: Vec::new() }
}

/// Reads `0:LINE:COLUMN: `; the first number is that of the text, which `#line` can change.
fn place(rest: &str) -> Option<((u32, u32), &str)> {
    let (text, rest) = rest.split_once(':')?;
    text.parse::<i64>().ok()?;
    let (line, rest) = rest.split_once(':')?;
    let (column, rest) = rest.split_once(": ")?;
    Some(((line.parse().ok()?, column.parse().ok()?), rest))
}

/// What the compiler's log of compiling a stage's `text` says, in the order in which to fix it: at least one
/// error if the log has one, except for what real drivers let pass, which stays a warning. `implied_version` is what the
/// compiler was told in place of a `#version` that the text lacks.
pub fn stage_diagnostics(
    log: &str,
    text: &str,
    implied_version: Option<i32>,
    interface: &LinkedInterface,
) -> Vec<Diagnostic> {
    let mut entries = entries(log);
    // The parser's giving up is the last error, and tells most about the ones before it.
    let syntax = entries.iter().position(LogEntry::is_syntax_error).filter(|&at| at >= MAX_ENTRIES);
    let last = syntax.map(|at| entries.swap_remove(at));
    entries.truncate(MAX_ENTRIES);
    entries.extend(last);
    let file = HintContext::new(text, interface);
    if entries.iter().any(|entry| entry.is_error)
        && implied_version.is_none()
        && let Some(missing) = hints::missing_version(&file)
    {
        return vec![missing];
    }
    let findings: Vec<_> = entries.iter().map(|entry| hints::find(&file, entry)).collect();
    let mut chosen = causes(&file, &findings);
    if chosen.is_empty() {
        chosen.extend(findings.iter().find(|finding| finding.is_error()));
    }
    let is_error = |finding: &&&CompilerMessage<'_, '_>| finding.is_error();
    let errors: Vec<_> = chosen.iter().filter(is_error).map(|finding| hints::explain(&file, finding)).collect();
    let warnings =
        findings.iter().filter(|finding| !finding.is_error()).filter_map(|finding| hints::warn(&file, finding));
    let mut all: Vec<Diagnostic> = Vec::new();
    for diagnostic in errors.into_iter().chain(warnings) {
        let again = |one: &Diagnostic| one.line == diagnostic.line && one.message == diagnostic.message;
        let covered = |one: &Diagnostic| one.severity == Severity::Error && one.line == diagnostic.line;
        if !all.iter().any(|one| again(one) || (diagnostic.severity == Severity::Warning && covered(one))) {
            all.push(diagnostic);
        }
    }
    all.truncate(MAX_DIAGNOSTICS);
    all
}

/// The errors that are causes: those that follow from another are left out.
fn causes<'f, 'e, 'a>(
    file: &HintContext<'a>,
    findings: &'f [CompilerMessage<'e, 'a>],
) -> Vec<&'f CompilerMessage<'e, 'a>> {
    let errors: Vec<_> = findings.iter().filter(|finding| finding.is_error()).collect();
    if let Some(first) = errors.iter().find(|finding| finding.ends_everything()) {
        return vec![first];
    }
    let syntax = errors.iter().find(|finding| finding.entry.is_syntax_error());
    let stray = syntax.and_then(|syntax| hints::stray_brace(file, syntax));
    let mut kept: Vec<&CompilerMessage<'_, '_>> = Vec::new();
    // Names whose declaration is wrong: what is said about their use follows from that.
    let mut tainted: Vec<&str> = Vec::new();
    for &finding in &errors {
        let same = |other: &&CompilerMessage<'_, '_>| other.statement == finding.statement;
        let earlier = kept.iter().copied().find(same);
        let outside = stray.is_some_and(|brace| finding.index > brace && !finding.entry.is_syntax_error());
        let follows = if outside || kept.iter().any(|other| finding.follows_from(other)) {
            true
        } else if finding.entry.is_syntax_error() {
            earlier.is_some_and(|earlier| earlier.explains_syntax_error(file, finding))
        } else if finding.stands_alone() {
            let again = |other: &&CompilerMessage<'_, '_>| other.is_alien() || other.entry.token == finding.entry.token;
            kept.iter().copied().any(|other| same(&other) && other.stands_alone() && again(&other))
        } else {
            earlier.is_some()
                || errors.iter().any(|other| other.stands_alone() && same(other))
                || syntax.is_some_and(|syntax| syntax.statement == finding.statement)
                || hints::statement_words(file, finding).any(|word| tainted.contains(&word))
        };
        if !follows {
            kept.push(finding);
        }
        tainted.extend(hints::declared_in_statement(file, finding));
        // From then on the compiler takes a name that it missed for a number.
        tainted.extend(finding.misses_a_name().then_some(finding.entry.token));
    }
    kept
}

/// What the compiler's log of linking says about the vertex shader `text`.
pub fn link_diagnostics(log: &str, text: &str, interface: &LinkedInterface) -> Vec<Diagnostic> {
    let file = HintContext::new(text, interface);
    let mut all: Vec<_> =
        entries(log).iter().filter(|entry| entry.is_error).map(|entry| hints::link::explain(&file, entry)).collect();
    all.dedup();
    all.truncate(MAX_DIAGNOSTICS);
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_entries_with_their_places() {
        let log = "ERROR: 0:30:34: 'Max' : no matching overloaded function found \n\
                   WARNING: 0:16:1: attribute deprecated in version 130\n\
                   ERROR: Linking vertex and fragment stages: Types must match:\n    vertex stage: \" vec3 vc\"\n\
                   ERROR: 0:36:0: '' : compilation terminated \nERROR: 2 compilation errors.  No code generated.\n\n";
        let all = entries(log);
        assert_eq!(all.len(), 3);
        assert_eq!((all[0].place, all[0].token), (Some((30, 34)), "Max"));
        assert_eq!(all[0].message, "no matching overloaded function found");
        assert_eq!((all[1].is_error, all[1].place, all[1].token), (false, Some((16, 1)), ""));
        assert_eq!((all[2].place, &all[2].more[..]), (None, &["vertex stage: \" vec3 vc\""][..]));
    }

    #[test]
    fn takes_a_token_apart_from_the_words() {
        let all =
            entries("ERROR: 0:1:8: ''' : character literals not supported \nERROR: -1:2:3: '' :  syntax error, x");
        assert_eq!((all[0].token, all[0].message), ("'", "character literals not supported"));
        assert_eq!((all[1].place, all[1].is_syntax_error()), (Some((2, 3)), true));
    }
}
