//! stub
use super::Interface;
use crate::diagnostic::*;
use crate::language::Text;
pub fn vertex_diagnostics(log: &str, _text: &str, _interface: &Interface) -> Vec<Diagnostic> {
    log.lines()
        .filter(|l| l.starts_with("ERROR"))
        .map(|l| Diagnostic::error(Stage::Compile, Text::verbatim(l)))
        .collect()
}
pub fn link_diagnostics(log: &str, _text: &str, _interface: &Interface) -> Vec<Diagnostic> {
    log.lines().filter(|l| l.starts_with("ERROR")).map(|l| Diagnostic::error(Stage::Link, Text::verbatim(l))).collect()
}
