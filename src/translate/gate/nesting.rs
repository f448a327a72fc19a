//! How deeply a parser, and everything that walks its tree, is nested at a token.

/// Deepest nesting that is compiled.
///
/// Homework stays below 20. The parser gives up near 1,500 and names memory, which helps nobody; a chain of 1,000
/// `else if` takes the driver 2 s, one of 256 takes 0.1 s. All stages stand 8,000 levels on a worker's stack.
pub(super) const MAX_NESTING: usize = 256;

/// Follows brackets, operators and statements that hold each other without brackets.
#[derive(Debug, Default)]
pub(super) struct Nesting {
    /// Open parentheses and brackets.
    brackets: usize,
    /// For each open block, the statements that held it.
    blocks: Vec<usize>,
    /// Statements that hold what follows.
    statements: usize,
    /// Operators that hold all of the expression that follows.
    operators: usize,
    /// Operators in front of one operand.
    prefixes: usize,
    /// A statement has ended; `else` would continue it.
    ended: bool,
}

impl Nesting {
    /// Takes the next token.
    pub fn take(&mut self, token: &str) {
        if std::mem::take(&mut self.ended) && token != "else" {
            self.statements = 0;
            self.operators = 0;
        }
        self.prefixes = if matches!(token, "-" | "+" | "!" | "~") { self.prefixes + 1 } else { 0 };
        match token {
            "(" | "[" => self.brackets += 1,
            ")" | "]" => self.brackets = self.brackets.saturating_sub(1),
            "{" => self.blocks.push(std::mem::take(&mut self.statements)),
            "}" => {
                self.statements = self.blocks.pop().unwrap_or(0);
                self.brackets = 0;
                self.ended = true;
            }
            // The semicolons of `for (;;)` end nothing.
            ";" if self.brackets == 0 => {
                self.ended = true;
                self.operators = 0;
            }
            "," if self.brackets == 0 => self.operators = 0,
            "?" | "=" => self.operators += 1,
            "if" | "else" | "for" | "while" | "do" | "switch" => self.statements += 1,
            _ => {}
        }
    }

    /// How deep the parser is.
    pub fn depth(&self) -> usize {
        let statements = self.statements + self.blocks.iter().sum::<usize>();
        self.brackets + self.blocks.len() + statements + self.operators + self.prefixes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::translate::gate::expand::{ExpandedToken, tokens};

    fn deepest(code: &str) -> usize {
        let mut nesting = Nesting::default();
        let depth = |token: ExpandedToken| {
            nesting.take(&token.text);
            nesting.depth()
        };
        tokens(code, 1).into_iter().map(depth).max().unwrap_or(0)
    }

    #[test]
    fn brackets_and_blocks_add_up() {
        assert_eq!(deepest("((()))"), 3);
        assert_eq!(deepest("a[b[(c)]]"), 3);
        assert_eq!(deepest("{ ( ) { ( ) } }"), 3);
    }

    #[test]
    fn what_holds_without_brackets_counts() {
        assert_eq!(deepest("- - ! ~ x"), 4);
        assert_eq!(deepest("a ? b : c ? d : e;"), 2);
        assert_eq!(deepest("a = b = c;"), 2);
        // Two loops, and the open parenthesis of the second.
        assert_eq!(deepest("for(;;) for(;;) x;"), 3);
        // Two ifs and two elses hold the last assignment and its sign; the assignments before have ended.
        assert_eq!(deepest("if (a) b; else if (c) d; else e = 1;"), 5);
        assert_eq!(deepest("if (a) b = 1; else if (c) d = 1; else e = 1;"), 5);
    }

    #[test]
    fn statements_in_a_row_do_not_add_up() {
        assert_eq!(deepest(&"x = -y; ".repeat(1000)), 2);
        assert_eq!(deepest(&"if (a) { x = 1; } ".repeat(1000)), 3);
        assert_eq!(deepest(&"a - b + c - ".repeat(1000)), 1);
        assert_eq!(deepest(&"a = 1, ".repeat(1000)), 1);
        assert_eq!(deepest(&"a == b && ".repeat(1000)), 0);
    }
}
