//! An expression as text.

use crate::interpreter::syntax::{Binary, Expression, ExpressionKind, Unary};
use std::fmt::Write;

/// The expression as a person would write it.
pub fn written(expression: &Expression) -> String {
    let mut text = String::new();
    write(&mut text, expression);
    text
}

/// Writes it at the end of a text. Millions are written in a search, so none has a text of its own.
fn write(text: &mut String, expression: &Expression) {
    let put = |text: &mut String, part: std::fmt::Arguments<'_>| _ = text.write_fmt(part);
    match &expression.kind {
        ExpressionKind::Integer(value, unsigned) => {
            put(text, format_args!("{value}{}", if *unsigned { "u" } else { "" }));
        }
        ExpressionKind::Floating(value, is_double) => {
            put(text, format_args!("{value:?}{}", if *is_double { "lf" } else { "" }));
        }
        ExpressionKind::Bool(value) => put(text, format_args!("{value}")),
        ExpressionKind::Name(name) => text.push_str(name),
        ExpressionKind::Unary(operator, operand) => {
            text.push(match operator {
                Unary::Plus => '+',
                Unary::Minus => '-',
                Unary::Not => '!',
                Unary::Complement => '~',
            });
            within(text, operand);
        }
        ExpressionKind::Step(adds, after, operand) => {
            let step = if *adds { "++" } else { "--" };
            text.push_str(if *after { "" } else { step });
            write(text, operand);
            text.push_str(if *after { step } else { "" });
        }
        ExpressionKind::Chain(first, others) => {
            within(text, first);
            for (operator, _, operand) in others {
                [" ", sign(*operator), " "].into_iter().for_each(|part| text.push_str(part));
                within(text, operand);
            }
        }
        ExpressionKind::Assign(operator, to, from) => {
            write(text, to);
            [" ", operator.map_or("", sign), "= "].into_iter().for_each(|part| text.push_str(part));
            write(text, from);
        }
        ExpressionKind::Conditional(condition, yes, no) => {
            write(text, condition);
            text.push_str(" ? ");
            write(text, yes);
            text.push_str(" : ");
            write(text, no);
        }
        ExpressionKind::Comma(all) => list(text, "(", all, ")"),
        ExpressionKind::Call(name, arguments) => {
            text.push_str(name);
            list(text, "(", arguments, ")");
        }
        ExpressionKind::ArrayConstructor(_, arguments) => list(text, "[](", arguments, ")"),
        ExpressionKind::Index(of, index) => {
            within(text, of);
            text.push('[');
            write(text, index);
            text.push(']');
        }
        ExpressionKind::Member(of, name) => {
            within(text, of);
            text.push('.');
            text.push_str(name);
        }
        ExpressionKind::Length(of) => {
            write(text, of);
            text.push_str(".length()");
        }
        ExpressionKind::List(all) => list(text, "{ ", all, " }"),
    }
}

fn list(text: &mut String, open: &str, all: &[Expression], close: &str) {
    text.push_str(open);
    for (at, one) in all.iter().enumerate() {
        text.push_str(if at == 0 { "" } else { ", " });
        write(text, one);
    }
    text.push_str(close);
}

/// An operand: in brackets where it is made of operands itself.
fn within(text: &mut String, operand: &Expression) {
    match operand.kind {
        ExpressionKind::Chain(..) | ExpressionKind::Conditional(..) => {
            list(text, "(", std::slice::from_ref(operand), ")")
        }
        _ => write(text, operand),
    }
}

fn sign(operator: Binary) -> &'static str {
    match operator {
        Binary::Add => "+",
        Binary::Subtract => "-",
        Binary::Multiply => "*",
        Binary::Divide => "/",
        Binary::Remainder => "%",
        Binary::ShiftLeft => "<<",
        Binary::ShiftRight => ">>",
        Binary::BitAnd => "&",
        Binary::BitXor => "^",
        Binary::BitOr => "|",
        Binary::Less => "<",
        Binary::LessEqual => "<=",
        Binary::Greater => ">",
        Binary::GreaterEqual => ">=",
        Binary::Equal => "==",
        Binary::NotEqual => "!=",
        Binary::And => "&&",
        Binary::Xor => "^^",
        Binary::Or => "||",
    }
}
