//! The type of an expression, where it follows from names, sizes and operators.

use super::file::HintContext;
use super::tokens::{Lexeme, LexemeKind};
use super::types::Numeric;
use super::vocabulary;

/// The type of the expression that `tokens` are, where it follows from names, sizes and operators.
pub fn type_of(file: &HintContext<'_>, tokens: &[Lexeme<'_>]) -> Option<Numeric> {
    let mut reader = ExpressionReader { file, tokens, at: 0, depth: 0 };
    let ty = reader.sum()?;
    (reader.at == tokens.len()).then_some(ty)
}

/// Splits the arguments between the brackets at `open` and `close` at their commas.
pub fn arguments<'t, 'a>(tokens: &'t [Lexeme<'a>]) -> Vec<&'t [Lexeme<'a>]> {
    let mut depth = 0_i32;
    if tokens.is_empty() {
        return Vec::new();
    }
    tokens
        .split(|token| {
            match token.text {
                "(" | "[" => depth += 1,
                ")" | "]" => depth -= 1,
                _ => {}
            }
            depth == 0 && token.text == ","
        })
        .collect()
}

/// Expressions nest no deeper than this where a hint looks into them.
const MAX_DEPTH: u32 = 40;

struct ExpressionReader<'r, 'a> {
    file: &'r HintContext<'a>,
    tokens: &'r [Lexeme<'r>],
    at: usize,
    depth: u32,
}

impl<'r> ExpressionReader<'r, '_> {
    fn next_is(&self, signs: &[&str]) -> bool {
        self.tokens.get(self.at).is_some_and(|token| signs.contains(&token.text))
    }

    fn sum(&mut self) -> Option<Numeric> {
        let mut left = self.product()?;
        while self.next_is(&["+", "-"]) {
            self.at += 1;
            let right = self.product()?;
            left = element_wise(left, right)?;
        }
        Some(left)
    }

    fn product(&mut self) -> Option<Numeric> {
        let mut left = self.unary()?;
        while self.next_is(&["*", "/"]) {
            let times = self.next_is(&["*"]);
            self.at += 1;
            let right = self.unary()?;
            left = if times { product(left, right) } else { element_wise(left, right) }?;
        }
        Some(left)
    }

    fn unary(&mut self) -> Option<Numeric> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return None;
        }
        if self.next_is(&["-", "+"]) {
            self.at += 1;
            return self.unary();
        }
        let mut ty = self.primary()?;
        loop {
            if self.next_is(&["."]) {
                let field = self.tokens.get(self.at + 1)?;
                self.at += 2;
                ty = swizzle(ty, field.text)?;
            } else if self.next_is(&["["]) {
                self.bracketed()?;
                ty = if ty.columns > 1 { Numeric { columns: 1, ..ty } } else { Numeric { rows: 1, ..ty } };
            } else {
                return Some(ty);
            }
        }
    }

    fn primary(&mut self) -> Option<Numeric> {
        let token = *self.tokens.get(self.at)?;
        if token.text == "(" {
            let inside = self.bracketed()?;
            return ExpressionReader { file: self.file, tokens: inside, at: 0, depth: self.depth }.whole();
        }
        self.at += 1;
        match token.kind {
            LexemeKind::Number => Some(Numeric { base: number_base(token.text), ..Numeric::FLOAT }),
            LexemeKind::Word if self.next_is(&["("]) => {
                let inside = self.bracketed()?;
                let nested = |tokens| ExpressionReader { file: self.file, tokens, at: 0, depth: self.depth }.whole();
                result(self.file, token, || arguments(inside).into_iter().map(nested).collect())
            }
            LexemeKind::Word if matches!(token.text, "true" | "false") => Numeric::named("bool"),
            LexemeKind::Word => Numeric::named(&self.file.visible(token.text, token.start)?.ty),
            _ => None,
        }
    }

    fn whole(mut self) -> Option<Numeric> {
        let ty = self.sum()?;
        (self.at == self.tokens.len()).then_some(ty)
    }

    /// Steps over a bracket and returns what it holds.
    fn bracketed(&mut self) -> Option<&'r [Lexeme<'r>]> {
        let open = self.at;
        let mut depth = 0_usize;
        for (index, token) in self.tokens.iter().enumerate().skip(open) {
            match token.text {
                "(" | "[" => depth += 1,
                ")" | "]" => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                self.at = index + 1;
                return self.tokens.get(open + 1..index);
            }
        }
        None
    }
}

fn number_base(text: &str) -> char {
    let decimal = !text.starts_with("0x") && !text.starts_with("0X");
    if decimal && text.ends_with("lf") {
        'd'
    } else if decimal && text.contains(['.', 'e', 'E', 'f']) {
        'f'
    } else if text.ends_with(['u', 'U']) {
        'u'
    } else {
        'i'
    }
}

fn element_wise(left: Numeric, right: Numeric) -> Option<Numeric> {
    if left.is_scalar() {
        return Some(right.with_base_of(left));
    }
    let fits = right.is_scalar() || (left.columns, left.rows) == (right.columns, right.rows);
    fits.then(|| left.with_base_of(right))
}

fn product(left: Numeric, right: Numeric) -> Option<Numeric> {
    let wide = |ty: Numeric| ty.columns > 1;
    match (wide(left), wide(right)) {
        (true, true) => (left.columns == right.rows).then_some(Numeric { columns: right.columns, ..left }),
        (true, false) if right.is_vector() => (left.columns == right.rows).then_some(Numeric { columns: 1, ..left }),
        (false, true) if left.is_vector() => {
            (left.rows == right.rows).then_some(Numeric { rows: right.columns, columns: 1, ..right })
        }
        _ => element_wise(left, right),
    }
}

fn swizzle(ty: Numeric, field: &str) -> Option<Numeric> {
    let in_set = |set: &str| field.chars().all(|c| set.find(c).is_some_and(|at| at < usize::from(ty.rows)));
    let sets = ["xyzw", "rgba", "stpq"];
    let rows = u8::try_from(field.len()).ok().filter(|rows| (1..=4).contains(rows))?;
    (ty.is_vector() && sets.into_iter().any(in_set)).then_some(Numeric { rows, ..ty })
}

/// The type that the function or constructor `name` returns for arguments of the types that `types` gives.
fn result(file: &HintContext<'_>, name: Lexeme<'_>, types: impl Fn() -> Option<Vec<Numeric>>) -> Option<Numeric> {
    if let Some(function) = file.anywhere(name.text) {
        return Numeric::named(&function.ty);
    }
    if vocabulary::is_type(name.text) {
        return Numeric::named(name.text);
    }
    let types = types()?;
    match name.text {
        "dot" | "length" | "distance" | "determinant" => Some(Numeric { base: types.first()?.base, ..Numeric::FLOAT }),
        "step" | "smoothstep" => types.last().copied(),
        "transpose" => types.first().map(|ty| Numeric { columns: ty.rows, rows: ty.columns, ..*ty }),
        "outerProduct" | "any" | "all" | "not" | "equal" | "notEqual" => None,
        other
            if ["tex", "pack", "unpack", "bit", "find", "lessThan", "greaterThan"]
                .iter()
                .any(|own| other.starts_with(own)) =>
        {
            None
        }
        // A function of one size for all returns that size; integers become floats on the way.
        known if vocabulary::is_function(file.interface.stage, known) => {
            let float = |ty: &Numeric| if matches!(ty.base, 'i' | 'u') { Numeric { base: 'f', ..*ty } } else { *ty };
            types.first().map(float)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::translate::hints::tests::interface;

    #[test]
    fn infers_the_type_of_an_expression() {
        let text = "in vec4 pv; uniform mat4 mw; float f(vec2 a); const vec3 n = vec3(1); void main() { EXPR; }";
        for (expression, name) in [
            ("mw * pv", Some("vec4")),
            ("(mw * pv).xyz / pv.w", Some("vec3")),
            ("-normalize(pv.xyz)", Some("vec3")),
            ("max(dot(n, n), 0.0) * pv", Some("vec4")),
            ("f(pv.xy) + 1", Some("float")),
            ("mw[0]", Some("vec4")),
            ("mat3(mw) * n", Some("vec3")),
            ("n[0]", Some("float")),
            ("2", Some("int")),
            ("n + pv", None),
            ("pv.xyq", None),
            ("nothing", None),
        ] {
            let text = text.replace("EXPR", expression);
            let interface = interface();
            let file = HintContext::new(&text, &interface);
            let open = file.code.iter().rposition(|token| token.text == "{").expect("the text has a body");
            let tokens = &file.code[open + 1..file.code.len() - 2];
            assert_eq!(type_of(&file, tokens).map(|ty| ty.to_string()).as_deref(), name, "{expression}");
        }
    }
}
