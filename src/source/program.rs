//! A program in C++ of which numbers are read, as the shader that is judged instead: its lines are the student's own.

use super::{FileFacts, Source, SourceRefusal, decode, kind};
use crate::diagnostic::{Diagnostic, DiagnosticStage, Severity};
use crate::language::Text;
use reference::host::{HostArray, ProgramListing, UnreadableProgram};

/// A program as it was read.
#[derive(Clone, Debug)]
pub struct ReadProgram {
    /// The shader that is judged, by the name of the program, with the program's lines.
    pub source: Source,
    /// What else is known of the numbers.
    pub listing: ProgramListing,
}

/// Reads the program `name`, whose content is `bytes`.
///
/// # Errors
/// A [`SourceRefusal`] for what is no text, and for numbers that cannot be read.
pub fn read_program(array: &HostArray, name: &str, bytes: &[u8]) -> Result<ReadProgram, Box<SourceRefusal>> {
    let mut facts = FileFacts::of(name, bytes);
    let decoded = match decode(bytes) {
        Ok(decoded) => decoded,
        Err(error) => {
            return Err(Box::new(SourceRefusal { facts, source: None, diagnostics: vec![kind::of_program(*error)] }));
        }
    };
    facts.encoding = Some(decoded.encoding);
    let written = Source::new(facts.clone(), &decoded.text);
    let listing = match array.read(&written.text) {
        Ok(listing) => listing,
        Err(unreadable) => {
            let diagnostics = std::iter::once(refused(unreadable)).chain(decoded.notes).collect();
            return Err(Box::new(SourceRefusal { facts, source: Some(written), diagnostics }));
        }
    };
    let mut source = Source::new(facts, &listing.shader);
    let notice = |(line, message): &(Option<u32>, reference::Text)| {
        let warning = Diagnostic { severity: Severity::Warning, ..said(message) };
        Diagnostic { line: *line, ..warning }
    };
    source.notes = listing.notices.iter().map(notice).chain(decoded.notes).collect();
    Ok(ReadProgram { source, listing })
}

fn refused(unreadable: UnreadableProgram) -> Diagnostic {
    let error = Diagnostic { line: unreadable.line, ..said(&unreadable.message) };
    match unreadable.hint {
        Some(hint) => error.hint(hint.into()),
        None => error,
    }
}

fn said(message: &reference::Text) -> Diagnostic {
    Diagnostic::error(DiagnosticStage::Source, Text::new(&*message.en, &*message.ja))
}
