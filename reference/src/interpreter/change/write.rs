//! An expression as text.

use crate::interpreter::syntax::{Binary, Expression, ExpressionKind, Unary};

/// The expression as a person would write it.
pub fn written(expression: &Expression) -> String {
    let listed = |all: &[Expression]| all.iter().map(written).collect::<Vec<_>>().join(", ");
    match &expression.kind {
        ExpressionKind::Integer(value, unsigned) => format!("{value}{}", if *unsigned { "u" } else { "" }),
        ExpressionKind::Floating(value, is_double) => {
            format!("{value:?}{}", if *is_double { "lf" } else { "" })
        }
        ExpressionKind::Bool(value) => value.to_string(),
        ExpressionKind::Name(name) => name.to_string(),
        ExpressionKind::Unary(operator, operand) => {
            let sign = match operator {
                Unary::Plus => "+",
                Unary::Minus => "-",
                Unary::Not => "!",
                Unary::Complement => "~",
            };
            format!("{sign}{}", within(operand))
        }
        ExpressionKind::Step(adds, after, operand) => {
            let (operand, step) = (written(operand), if *adds { "++" } else { "--" });
            if *after { format!("{operand}{step}") } else { format!("{step}{operand}") }
        }
        ExpressionKind::Chain(first, others) => others.iter().fold(within(first), |text, (operator, _, operand)| {
            format!("{text} {} {}", sign(*operator), within(operand))
        }),
        ExpressionKind::Assign(operator, to, from) => {
            format!("{} {}= {}", written(to), operator.map_or("", sign), written(from))
        }
        ExpressionKind::Conditional(condition, yes, no) => {
            format!("{} ? {} : {}", written(condition), written(yes), written(no))
        }
        ExpressionKind::Comma(all) => format!("({})", listed(all)),
        ExpressionKind::Call(name, arguments) => format!("{name}({})", listed(arguments)),
        ExpressionKind::ArrayConstructor(_, arguments) => format!("[]({})", listed(arguments)),
        ExpressionKind::Index(of, index) => format!("{}[{}]", within(of), written(index)),
        ExpressionKind::Member(of, name) => format!("{}.{name}", within(of)),
        ExpressionKind::Length(of) => format!("{}.length()", written(of)),
        ExpressionKind::List(all) => format!("{{ {} }}", listed(all)),
    }
}

/// An operand: in brackets where it is made of operands itself.
fn within(operand: &Expression) -> String {
    let is_compound = matches!(operand.kind, ExpressionKind::Chain(..) | ExpressionKind::Conditional(..));
    if is_compound { format!("({})", written(operand)) } else { written(operand) }
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
