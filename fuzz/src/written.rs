//! What the process that was started makes of a student's bytes: everything that a person or a program reads.

use ggrade::diagnostic::Diagnostic;
use ggrade::hand_in::HandIn;
use ggrade::language::Language;
use ggrade::likeness::Likeness;
use ggrade::report::html::{LineLinks, ReportFragment};
use ggrade::report::{Verdict, json, text};
use ggrade::source::Source;
use std::sync::LazyLock;

static LIKENESS: LazyLock<Likeness> = LazyLock::new(|| Likeness::of(crate::assignment()));

/// Writes a report with these diagnostics in every form. No form has a control character that a terminal obeys, or an
/// element that the page does not write itself.
pub fn check(bytes: &[u8], source: Option<&Source>, diagnostics: &[Diagnostic]) {
    let sources_read = source.map(std::slice::from_ref).unwrap_or_default();
    let answer = LIKENESS.read(sources_read);
    let _ = LIKENESS.compare((&answer, sources_read), (&answer, sources_read));
    let sources = ggrade::grade::sources(crate::assignment(), &HandIn::of_one("a.vert", bytes));
    let environment = Default::default();
    let report =
        ggrade::grade::unfinished(crate::assignment(), sources, Verdict::Rejected, diagnostics.to_vec(), environment);
    for language in [Language::En, Language::Ja] {
        let excerpts = ggrade::excerpt::excerpt(sources_read, diagnostics, language, false);
        let options = text::TextOptions {
            assignment: crate::assignment(),
            language,
            width: 80,
            colour: false,
            excerpts: Some(&excerpts),
        };
        let shown = text::render(&report, &options);
        assert!(!shown.contains(|c: char| c.is_control() && c != '\n'), "{shown:?}");
        let read: serde_json::Value = serde_json::from_str(&json::render(&report, language)).expect("JSON");
        assert_eq!(read["verdict"], "rejected");
        let lines = LineLinks::of(sources_read);
        let part = ReportFragment {
            assignment: crate::assignment(),
            report: &report,
            source: lines,
            gallery: None,
            language,
            level: 1,
            has_footer: true,
        };
        let page = part.render().expect("a page");
        assert!(!page.contains("<script") && !page.contains("<img"), "{page}");
    }
}
