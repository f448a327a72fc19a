//! Where the student's loops begin.

use crate::translate::spirv::{self, LineTable, op};
use naga::{Arena, Block, Expression, Span, Statement};
use std::collections::HashMap;

/// The first line that anything in a loop has.
pub(super) fn first_line(body: &Block, expressions: &Arena<Expression>, lines: &LineTable) -> Option<u32> {
    let of_statement = |(statement, span): (&Statement, &Span)| match statement {
        Statement::Emit(range) => {
            range.clone().filter_map(|expression| lines.line(expressions.get_span(expression))).min()
        }
        _ => lines.line(*span),
    };
    body.span_iter().filter_map(of_statement).min()
}

/// The lines of the loops of each function, by the compiler's name for it.
pub(super) fn loop_lines(words: &[u32]) -> HashMap<String, Vec<Option<u32>>> {
    let mut names = HashMap::new();
    let mut found: HashMap<String, Vec<Option<u32>>> = HashMap::new();
    let mut function = String::new();
    let mut line = None;
    for instruction in spirv::instructions(words) {
        match (instruction.opcode, instruction.words) {
            (op::NAME, [_, id, name @ ..]) => {
                names.insert(*id, spirv::text(name));
            }
            (op::FUNCTION, [_, _, id, ..]) => {
                function = names.get(id).cloned().unwrap_or_default();
                line = None;
            }
            (op::LINE, [_, _, number, ..]) => line = Some(*number),
            (op::LOOP_MERGE, _) => found.entry(function.clone()).or_default().push(line),
            _ => {}
        }
    }
    found
}
