//! What the fuzz targets share: the homework, and programs made of random bytes.

pub mod program;
pub mod written;

use ggrade::source::Source;
use ggrade::translate::{LinkedInterface, Translation};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use std::sync::LazyLock;

/// The assignment whose files are graded.
pub fn assignment() -> &'static reference::Assignment {
    reference::assignment("ggsample06").expect("built in")
}

/// Its interface.
pub static INTERFACE: LazyLock<LinkedInterface> = LazyLock::new(|| {
    let interface = ggrade::translate::LinkedInterface::of(assignment()).expect("complete");
    // The compiler's tables are made under OpenGL's rules first, as a worker does.
    ggrade::translate::warm(&interface, &assignment().files[0].starter);
    interface
});

/// What must hold for every text that is read, whatever its bytes.
pub fn check_source(source: &Source) {
    assert_eq!(source.text.len(), source.code().len(), "blanked comments keep every offset");
    let lines = source.line_count();
    for number in 0..=lines.saturating_add(1) {
        assert!(!source.line(number).contains('\n'));
        assert_eq!(source.line(number).len(), source.code_line(number).len());
    }
    assert!(source.unread_lines().len() <= lines as usize + 1);
    for (offset, word) in source.words() {
        let (line, column) = source.position(offset);
        assert!((1..=lines).contains(&line), "{word:?} stands on a line of the file");
        assert_eq!(source.offset(line, column), Some(offset));
    }
    for note in &source.notes {
        assert!(note.line.is_none_or(|line| (1..=lines).contains(&line)), "{note:?}");
    }
}

/// What must hold for every translation: the module with gate, fuel and capture in it is valid.
pub fn check_module(translation: &Translation, text: &str) {
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
    if let Err(error) = validator.validate(&translation.shader.module) {
        panic!("{}\n{text}", error.emit_to_string(""));
    }
}

/// What must hold for every list of diagnostics about a file with so many lines.
pub fn check_diagnostics(diagnostics: &[ggrade::diagnostic::Diagnostic], lines: u32) {
    for diagnostic in diagnostics {
        assert!(diagnostic.line.is_none_or(|line| (1..=lines.max(1)).contains(&line)), "{diagnostic:?}");
        assert!(!diagnostic.message.en.trim().is_empty() && !diagnostic.message.ja.trim().is_empty());
    }
}
