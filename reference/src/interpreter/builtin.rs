//! What GLSL has by itself: functions, written as scalar instructions, and variables.

mod arithmetic;
mod bits;
mod geometry;
pub(super) mod lookup;
mod table;
mod variable;

pub use table::signatures;
pub use variable::{constant, variable};

use super::Stage;
use super::code::{ArithmeticClass, Operation, Slot};
use super::compile::{CodeBuilder, CompiledValue, class};
use super::types::{Scalar, Type};
use crate::text::{Text, both};

/// A call of a built-in function.
pub struct BuiltinCall<'a> {
    /// The function's name.
    pub name: &'a str,
    /// The values that it takes, of the types of the signature.
    pub arguments: &'a [CompiledValue],
    /// What it returns.
    pub result: &'a Type,
    /// Where it is called.
    pub stage: Stage,
}

impl BuiltinCall<'_> {
    /// Writes the instructions; gives the scalars of the result, then those of each `out` parameter.
    ///
    /// # Errors
    /// What is not supported.
    pub fn write(&self, builder: &mut CodeBuilder) -> Result<Vec<Vec<Slot>>, Text> {
        let of: Vec<&[Slot]> = self.arguments.iter().map(|argument| argument.slots.as_slice()).collect();
        if self.arguments.first().is_some_and(|argument| matches!(argument.kind, Type::Sampler(_))) {
            return self.lookup(builder).map(|result| vec![result]);
        }
        let class = self.class();
        if let ("mix", [a, b, share]) = (self.name, self.arguments)
            && share.kind.scalar() == Some(Scalar::Bool)
        {
            return Ok(vec![builder.each3(Operation::Select, class, [&share.slots, &b.slots, &a.slots])]);
        }
        let written = arithmetic::write(builder, self.name, class, &of)
            .or_else(|| geometry::write(builder, self.name, class, &of))
            .or_else(|| self.matrix(builder, class))
            .or_else(|| bits::write(builder, self.name, self.scalar(), &of))
            .or_else(|| self.derivative(builder, &of));
        written.ok_or_else(|| self.unsupported())
    }

    fn unsupported(&self) -> Text {
        let name = self.name;
        both(format!("the function `{name}` is not supported"), format!("関数 `{name}` には対応していません"))
    }

    /// What the first argument is made of.
    fn scalar(&self) -> Scalar {
        self.arguments.first().and_then(|argument| argument.kind.scalar()).unwrap_or(Scalar::Float)
    }

    fn class(&self) -> ArithmeticClass {
        class(self.scalar())
    }
}
