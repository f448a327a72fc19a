//! Expressions.

use super::Parser;
use super::literal::literal;
use crate::interpreter::Refusal;
use crate::interpreter::syntax::{BaseType, Binary, Expression, ExpressionKind, TypeName, Unary};
use crate::interpreter::text::TokenKind;
use crate::interpreter::types::Type;
use crate::text::both;

/// Built-in functions that write into an argument.
const WRITING: [&str; 6] = ["modf", "frexp", "uaddCarry", "usubBorrow", "umulExtended", "imulExtended"];

impl Parser<'_> {
    /// An expression with commas.
    pub(super) fn expression(&mut self) -> Result<Expression, Refusal> {
        let first = self.assignment()?;
        if self.text(0) != "," {
            return Ok(first);
        }
        let line = first.line;
        let mut all = vec![first];
        while self.takes(",") {
            all.push(self.assignment()?);
        }
        Ok(Expression { line, at: 0, changes: all.iter().any(|one| one.changes), kind: ExpressionKind::Comma(all) })
    }

    /// An expression without commas, or `{ … }`.
    pub(super) fn initialiser(&mut self) -> Result<Expression, Refusal> {
        if self.text(0) != "{" {
            return self.assignment();
        }
        let (line, at) = self.place();
        self.at += 1;
        let mut all = Vec::new();
        while !self.takes("}") {
            all.push(self.nested(Self::initialiser)?);
            if !self.takes(",") && self.text(0) != "}" {
                return Err(self.unexpected(both("`,` or `}`", " `,` または `}` ")));
            }
        }
        Ok(Expression { line, at, changes: all.iter().any(|one| one.changes), kind: ExpressionKind::List(all) })
    }

    /// An expression without commas.
    pub(super) fn assignment(&mut self) -> Result<Expression, Refusal> {
        let left = self.conditional()?;
        let operator = match self.text(0) {
            "=" => None,
            "+=" => Some(Binary::Add),
            "-=" => Some(Binary::Subtract),
            "*=" => Some(Binary::Multiply),
            "/=" => Some(Binary::Divide),
            "%=" => Some(Binary::Remainder),
            "<<=" => Some(Binary::ShiftLeft),
            ">>=" => Some(Binary::ShiftRight),
            "&=" => Some(Binary::BitAnd),
            "^=" => Some(Binary::BitXor),
            "|=" => Some(Binary::BitOr),
            _ => return Ok(left),
        };
        let (line, at) = self.place();
        self.at += 1;
        let right = self.nested(Self::assignment)?;
        let kind = ExpressionKind::Assign(operator, Box::new(left), Box::new(right));
        Ok(Expression { line, at, changes: true, kind })
    }

    fn conditional(&mut self) -> Result<Expression, Refusal> {
        let condition = self.binary(1)?;
        let (line, at) = self.place();
        if !self.takes("?") {
            return Ok(condition);
        }
        let yes = self.nested(Self::expression)?;
        self.expect(":")?;
        let no = self.nested(Self::assignment)?;
        let changes = condition.changes || yes.changes || no.changes;
        let kind = ExpressionKind::Conditional(Box::new(condition), Box::new(yes), Box::new(no));
        Ok(Expression { line, at, changes, kind })
    }

    /// Operators that bind at least as tightly as `level`.
    fn binary(&mut self, level: u8) -> Result<Expression, Refusal> {
        let mut left = self.unary()?;
        let mut chained = 0;
        while let Some((operator, of)) = binary(self.text(0)).filter(|&(_, of)| of >= level) {
            let (line, at) = self.place();
            self.at += 1;
            let right = self.nested(|parser| parser.binary(of + 1))?;
            left.changes |= right.changes;
            match &mut left.kind {
                ExpressionKind::Chain(_, others) if chained == of => others.push((operator, line, right)),
                _ => {
                    let changes = left.changes;
                    let kind = ExpressionKind::Chain(Box::new(left), vec![(operator, line, right)]);
                    left = Expression { line, at, changes, kind };
                }
            }
            chained = of;
        }
        Ok(left)
    }

    fn unary(&mut self) -> Result<Expression, Refusal> {
        let (line, at) = self.place();
        let operator = match self.text(0) {
            "+" => Unary::Plus,
            "-" => Unary::Minus,
            "!" => Unary::Not,
            "~" => Unary::Complement,
            step @ ("++" | "--") => {
                let adds = step == "++";
                self.at += 1;
                let operand = self.nested(Self::unary)?;
                return Ok(Expression {
                    line,
                    at,
                    changes: true,
                    kind: ExpressionKind::Step(adds, false, Box::new(operand)),
                });
            }
            _ => return self.postfix(),
        };
        self.at += 1;
        let operand = self.nested(Self::unary)?;
        Ok(Expression { line, at, changes: operand.changes, kind: ExpressionKind::Unary(operator, Box::new(operand)) })
    }

    fn postfix(&mut self) -> Result<Expression, Refusal> {
        let mut value = self.primary()?;
        for _ in 0..super::MAX_NESTING {
            let (line, at) = self.place();
            let mut changes = value.changes;
            let kind = match self.text(0) {
                "[" => {
                    self.at += 1;
                    let index = self.nested(Self::expression)?;
                    self.expect("]")?;
                    changes |= index.changes;
                    ExpressionKind::Index(Box::new(value), Box::new(index))
                }
                "." => {
                    self.at += 1;
                    let name = self.name()?;
                    if &*name == "length" && self.text(0) == "(" {
                        self.at += 1;
                        self.expect(")")?;
                        ExpressionKind::Length(Box::new(value))
                    } else {
                        ExpressionKind::Member(Box::new(value), name)
                    }
                }
                step @ ("++" | "--") => {
                    let adds = step == "++";
                    self.at += 1;
                    changes = true;
                    ExpressionKind::Step(adds, true, Box::new(value))
                }
                _ => return Ok(value),
            };
            value = Expression { line, at, changes, kind };
        }
        Err(Refusal::limit(self.line(), both("this is nested too deeply", "入れ子が深すぎます")))
    }

    fn primary(&mut self) -> Result<Expression, Refusal> {
        let (line, at) = self.place();
        let plain = |kind| Expression { line, at, changes: false, kind };
        if self.text(0) == "(" {
            return self.bracket();
        }
        match self.peek(0) {
            Some(token) if token.kind == TokenKind::Number => {
                let literal = literal(&token.text);
                let literal = literal.ok_or_else(|| {
                    Refusal::invalid(
                        line,
                        both(format!("{} is no number", token.text), format!("`{}` は数値ではありません", token.text)),
                    )
                })?;
                self.at += 1;
                Ok(plain(literal))
            }
            Some(token) if token.kind == TokenKind::Name => match &*token.text {
                word @ ("true" | "false") => {
                    let value = word == "true";
                    self.at += 1;
                    Ok(plain(ExpressionKind::Bool(value)))
                }
                _ => self.name_or_call(),
            },
            _ => Err(self.unexpected(both("an expression", "式"))),
        }
    }

    fn bracket(&mut self) -> Result<Expression, Refusal> {
        self.at += 1;
        let inner = self.nested(Self::expression)?;
        self.expect(")")?;
        // A chain in brackets is not gone on with outside of them.
        Ok(match inner.kind {
            ExpressionKind::Chain(..) => {
                Expression { line: inner.line, at: 0, changes: inner.changes, kind: ExpressionKind::Comma(vec![inner]) }
            }
            _ => inner,
        })
    }

    fn name_or_call(&mut self) -> Result<Expression, Refusal> {
        let (line, at) = self.place();
        let lengths = self.lengths_ahead(1);
        if lengths > 0 && self.text(1 + lengths) == "(" {
            let kind = self.type_name()?;
            self.at += 1;
            let arguments = self.arguments()?;
            let changes = arguments.iter().any(|argument| argument.changes);
            return Ok(Expression {
                line,
                at,
                changes,
                kind: ExpressionKind::ArrayConstructor(Box::new(kind), arguments),
            });
        }
        let name = self.name()?;
        if !self.takes("(") {
            return Ok(Expression { line, at, changes: false, kind: ExpressionKind::Name(name) });
        }
        let arguments = self.arguments()?;
        let changes = self.functions.contains(&name) || WRITING.contains(&&*name);
        let changes = changes || arguments.iter().any(|argument| argument.changes);
        Ok(Expression { line, at, changes, kind: ExpressionKind::Call(name, arguments) })
    }

    /// What stands in the brackets of a call, which are open.
    fn arguments(&mut self) -> Result<Vec<Expression>, Refusal> {
        if self.text(0) == "void" && self.text(1) == ")" {
            self.at += 1;
        }
        let mut arguments = Vec::new();
        while !self.takes(")") {
            if !arguments.is_empty() {
                self.expect(",")?;
            }
            arguments.push(self.nested(Self::assignment)?);
        }
        Ok(arguments)
    }

    /// A type's name and the lengths behind it.
    pub(super) fn type_name(&mut self) -> Result<TypeName, Refusal> {
        let line = self.line();
        let base = BaseType::Named(self.name()?);
        Ok(TypeName { line, base, lengths: self.lengths()? })
    }

    /// `[n][]`
    pub(super) fn lengths(&mut self) -> Result<Vec<Option<Expression>>, Refusal> {
        let mut lengths = Vec::new();
        while self.takes("[") {
            let length = if self.text(0) == "]" { None } else { Some(self.nested(Self::conditional)?) };
            self.expect("]")?;
            lengths.push(length);
        }
        Ok(lengths)
    }

    /// Whether a word names a built-in type.
    pub(super) fn is_type(word: &str) -> bool {
        Type::named(word).is_some()
    }
}

fn binary(text: &str) -> Option<(Binary, u8)> {
    Some(match text {
        "||" => (Binary::Or, 1),
        "^^" => (Binary::Xor, 2),
        "&&" => (Binary::And, 3),
        "|" => (Binary::BitOr, 4),
        "^" => (Binary::BitXor, 5),
        "&" => (Binary::BitAnd, 6),
        "==" => (Binary::Equal, 7),
        "!=" => (Binary::NotEqual, 7),
        "<" => (Binary::Less, 8),
        ">" => (Binary::Greater, 8),
        "<=" => (Binary::LessEqual, 8),
        ">=" => (Binary::GreaterEqual, 8),
        "<<" => (Binary::ShiftLeft, 9),
        ">>" => (Binary::ShiftRight, 9),
        "+" => (Binary::Add, 10),
        "-" => (Binary::Subtract, 10),
        "*" => (Binary::Multiply, 11),
        "/" => (Binary::Divide, 11),
        "%" => (Binary::Remainder, 11),
        _ => return None,
    })
}
