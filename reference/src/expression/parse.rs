//! From text to a typed tree, by recursive descent.

mod lex;

use super::builtin::Builtin;
use super::value::Type;
use super::{Comparison, ExpressionError, Node, Operator, Scope};

/// Nesting beyond this is refused, so that no text can exhaust the stack.
const MAX_DEPTH: usize = 64;

type Typed = (Node, Type);

pub(super) fn is_identifier(name: &str) -> bool {
    let mut chars = name.chars();
    chars.next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_')
        && chars.all(|c| c.is_ascii_alphanumeric() || c == '_')
}

pub(super) fn parse(text: &str, scope: &Scope) -> Result<(Node, Type, Vec<usize>), ExpressionError> {
    let mut parser = Parser { text: text.chars().collect(), at: 0, scope, slots: Vec::new(), depth: 0 };
    let (node, kind) = parser.choice()?;
    parser.skip_space();
    match parser.text.get(parser.at) {
        None => Ok((node, kind, parser.slots)),
        Some(c) => Err(parser.error(parser.at, format!("unexpected `{c}`"))),
    }
}

struct Parser<'a> {
    text: Vec<char>,
    at: usize,
    scope: &'a Scope,
    slots: Vec<usize>,
    depth: usize,
}

impl Parser<'_> {
    /// `condition ? a : b`, or what stands above it in precedence.
    fn choice(&mut self) -> Result<Typed, ExpressionError> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(self.error(self.at, "nested too deeply"));
        }
        self.skip_space();
        let start = self.at;
        let (condition, kind) = self.comparison()?;
        let result = if self.take("?") {
            if kind != Type::Bool {
                return Err(self.error(start, "a condition must be a bool"));
            }
            let (yes, a) = self.choice()?;
            self.expect(":")?;
            let (no, b) = self.choice()?;
            if a != b {
                return Err(self.error(start, format!("`?:` between {} and {}", a.glsl(), b.glsl())));
            }
            let node = Node::Choose(Box::new(condition), Box::new(yes), Box::new(no));
            (node, a)
        } else {
            (condition, kind)
        };
        self.depth -= 1;
        Ok(result)
    }

    fn comparison(&mut self) -> Result<Typed, ExpressionError> {
        let (a, kind_a) = self.sum()?;
        self.skip_space();
        let at = self.at;
        let comparison = if self.take("<=") {
            Comparison::LessOrEqual
        } else if self.take(">=") {
            Comparison::GreaterOrEqual
        } else if self.take("<") {
            Comparison::Less
        } else if self.take(">") {
            Comparison::Greater
        } else {
            return Ok((a, kind_a));
        };
        let (b, kind_b) = self.sum()?;
        if (kind_a, kind_b) != (Type::Float, Type::Float) {
            return Err(self.error(at, "only floats can be compared"));
        }
        let node = Node::Compare(comparison, Box::new(a), Box::new(b));
        Ok((node, Type::Bool))
    }

    fn sum(&mut self) -> Result<Typed, ExpressionError> {
        let mut left = self.product()?;
        loop {
            self.skip_space();
            let at = self.at;
            let operator = if self.take("+") {
                Operator::Add
            } else if self.take("-") {
                Operator::Subtract
            } else {
                return Ok(left);
            };
            let right = self.product()?;
            left = self.join(at, operator, left, right)?;
        }
    }

    fn product(&mut self) -> Result<Typed, ExpressionError> {
        self.skip_space();
        let mut start = self.at;
        let mut left = self.unary()?;
        loop {
            self.skip_space();
            let at = self.at;
            let operator = if self.take("*") {
                Operator::Multiply
            } else if self.take("/") {
                Operator::Divide
            } else {
                return Ok(left);
            };
            self.skip_space();
            let second = self.at;
            let right = self.unary()?;
            if operator == Operator::Divide && self.is_integer(start, at) && self.is_integer(second, self.at) {
                return Err(self.error(at, "GLSL divides integers here: write 1.0 / 2.0"));
            }
            start = second;
            left = self.join(at, operator, left, right)?;
        }
    }

    fn join(
        &self,
        at: usize,
        operator: Operator,
        (a, kind_a): Typed,
        (b, kind_b): Typed,
    ) -> Result<Typed, ExpressionError> {
        let kind = operator.result(kind_a, kind_b).ok_or_else(|| {
            let names = (kind_a.glsl(), kind_b.glsl());
            self.error(at, format!("no such operation between {} and {}", names.0, names.1))
        })?;
        Ok((Node::Binary(operator, Box::new(a), Box::new(b)), kind))
    }

    fn unary(&mut self) -> Result<Typed, ExpressionError> {
        self.skip_space();
        let at = self.at;
        if self.take("-") {
            let (node, kind) = self.unary()?;
            if kind == Type::Bool {
                return Err(self.error(at, "a bool has no negative"));
            }
            return Ok((Node::Negate(Box::new(node)), kind));
        }
        self.postfix()
    }

    fn postfix(&mut self) -> Result<Typed, ExpressionError> {
        let mut value = self.primary()?;
        while self.take(".") {
            let at = self.at;
            let name = self.identifier()?;
            value = self.swizzle(at, &name, value)?;
        }
        Ok(value)
    }

    fn swizzle(&self, at: usize, name: &str, (node, kind): Typed) -> Result<Typed, ExpressionError> {
        let wrong = || self.error(at, format!("{} has no `.{name}`", kind.glsl()));
        let width = kind.width().filter(|w| *w > 1).ok_or_else(wrong)?;
        let set =
            ["xyzw", "rgba", "stpq"].into_iter().find(|set| name.chars().all(|c| set.contains(c))).ok_or_else(wrong)?;
        let mut places = [0u8; 4];
        if name.len() > places.len() {
            return Err(wrong());
        }
        for (slot, c) in places.iter_mut().zip(name.chars()) {
            let place = set.find(c).filter(|p| *p < width).ok_or_else(wrong)?;
            *slot = u8::try_from(place).map_err(|_| wrong())?;
        }
        let kind = Type::of_width(name.len()).ok_or_else(wrong)?;
        Ok((Node::Swizzle(Box::new(node), places, name.len()), kind))
    }

    fn primary(&mut self) -> Result<Typed, ExpressionError> {
        self.skip_space();
        let start = self.at;
        if self.take("(") {
            let inner = self.choice()?;
            self.expect(")")?;
            return Ok(inner);
        }
        if self.text.get(self.at).is_some_and(|c| c.is_ascii_digit() || *c == '.') {
            return self.number();
        }
        let name = self.identifier()?;
        if self.take("(") {
            let arguments = self.arguments()?;
            return self.call(start, &name, arguments);
        }
        let slot = self.scope.slot(&name).ok_or_else(|| self.error(start, format!("`{name}` is not known here")))?;
        let (_, kind) = self.scope.get(slot).unwrap_or(("", Type::Float));
        self.slots.push(slot);
        Ok((Node::Variable(slot), kind))
    }

    fn arguments(&mut self) -> Result<Vec<Typed>, ExpressionError> {
        let mut arguments = Vec::new();
        if self.take(")") {
            return Ok(arguments);
        }
        loop {
            arguments.push(self.choice()?);
            if self.take(")") {
                return Ok(arguments);
            }
            self.expect(",")?;
        }
    }

    fn call(&self, at: usize, name: &str, arguments: Vec<Typed>) -> Result<Typed, ExpressionError> {
        let kinds: Vec<Type> = arguments.iter().map(|(_, kind)| *kind).collect();
        let nodes: Vec<Node> = arguments.into_iter().map(|(node, _)| node).collect();
        let listed: Vec<&str> = kinds.iter().map(|k| k.glsl()).collect();
        let wrong = || self.error(at, format!("no `{name}({})`", listed.join(", ")));
        if let Some(kind) = Type::from_glsl(name) {
            return if constructs(kind, &kinds) { Ok((Node::Construct(kind, nodes), kind)) } else { Err(wrong()) };
        }
        let builtin =
            Builtin::named(name).ok_or_else(|| self.error(at, format!("the function `{name}` is not known here")))?;
        let kind = builtin.result(&kinds).ok_or_else(wrong)?;
        Ok((Node::Call(builtin, nodes), kind))
    }
}

/// Whether GLSL 4.10, 5.4 has this constructor. Matrices by columns are left out: no equation here needs them.
fn constructs(kind: Type, arguments: &[Type]) -> bool {
    match (kind, arguments) {
        (Type::Bool, _) => false,
        (Type::Mat3 | Type::Mat4, [Type::Float | Type::Mat3 | Type::Mat4]) => true,
        (Type::Mat3 | Type::Mat4, _) => false,
        (_, [Type::Float]) => true,
        (_, arguments) => {
            let widths: Option<Vec<usize>> = arguments.iter().map(|t| t.width()).collect();
            let wanted = kind.numbers();
            widths.is_some_and(|w| {
                let all: usize = w.iter().sum();
                all == wanted || (w.len() == 1 && all > wanted)
            })
        }
    }
}
