//! What a file declares, found without parsing it: a type, then a name, then what follows a declared name.

use super::tokens::{Lexeme, LexemeKind};
use super::vocabulary;

/// What kind of thing is declared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeclarationKind {
    /// A variable.
    Variable,
    /// A parameter of a function.
    Parameter,
    /// A function, with a body or without.
    Function,
    /// A structure or an interface block.
    Structure,
}

/// A declared name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeclaredName<'a> {
    /// The name.
    pub name: &'a str,
    /// What it is.
    pub role: DeclarationKind,
    /// The type as written, with `[]` for arrays; the type that a function returns.
    pub ty: String,
    /// Words before the type: `const`, `in`, `out`, `uniform`, `flat` …
    pub qualifiers: Vec<&'a str>,
    /// Index of the name among the code tokens.
    pub index: usize,
    /// Byte offset of the name.
    pub start: usize,
    /// Byte offset where the scope ends.
    pub scope_end: usize,
    /// Whether it stands outside functions and blocks.
    pub global: bool,
}

impl DeclaredName<'_> {
    /// Whether the name can be used at byte `offset`.
    pub fn is_visible(&self, offset: usize) -> bool {
        self.start < offset && offset < self.scope_end
    }

    /// Whether it carries `qualifier`.
    pub fn is(&self, qualifier: &str) -> bool {
        self.qualifiers.contains(&qualifier)
    }
}

/// Enough for any real shader; keeps a hostile one from taking long.
const MAX_DECLARATIONS: usize = 2_000;

/// How far a list of parameters or qualifiers is followed, in tokens, for the same reason.
const MAX_LIST: usize = 500;

/// Everything that `code` declares, in order.
pub fn find<'a>(code: &[Lexeme<'a>]) -> Vec<DeclaredName<'a>> {
    let mut all: Vec<DeclaredName<'a>> = Vec::new();
    let braces = Braces::new(code);
    for index in 1..code.len() {
        if all.len() > MAX_DECLARATIONS {
            break;
        }
        if let Some((ty, role)) = structure(code, index).or_else(|| typed(code, index, &all)) {
            let mut indices = vec![index];
            if role == DeclarationKind::Variable {
                indices.extend(more_names(code, index).into_iter().take(MAX_DECLARATIONS));
            }
            let qualifiers = qualifiers(code, index);
            all.extend(indices.into_iter().map(|index| declaration(code, &braces, index, &ty, role, &qualifiers)));
        }
    }
    all
}

fn structure(code: &[Lexeme<'_>], index: usize) -> Option<(String, DeclarationKind)> {
    let opens = code.get(index + 1).is_some_and(|next| next.text == "{");
    let keyword = code[index - 1].text;
    (code[index].kind == LexemeKind::Word && opens && matches!(keyword, "struct" | "uniform" | "in" | "out" | "buffer"))
        .then(|| (keyword.to_owned(), DeclarationKind::Structure))
}

/// The type and role of the name at `index`, if it is one that is declared there.
fn typed(code: &[Lexeme<'_>], index: usize, before: &[DeclaredName<'_>]) -> Option<(String, DeclarationKind)> {
    let name = code[index];
    if name.kind != LexemeKind::Word || vocabulary::is_keyword(name.text) {
        return None;
    }
    let mut at = index - 1;
    let mut suffix = String::new();
    while code[at].text == "]" {
        at = code[..at].iter().rposition(|token| token.text == "[")?.checked_sub(1)?;
        suffix.push_str("[]");
    }
    let ty = code[at].text;
    let next = code.get(index + 1).map_or("", |next| next.text);
    if ty == "}" {
        // The name of a block's instance, or of a variable of the structure just defined.
        return (suffix.is_empty() && matches!(next, ";" | "[" | ","))
            .then(|| ("struct".to_owned(), DeclarationKind::Variable));
    }
    if !vocabulary::is_type(ty) && !before.iter().any(|d| d.role == DeclarationKind::Structure && d.name == ty) {
        return None;
    }
    let role = match next {
        "(" => DeclarationKind::Function,
        _ if parenthesis_before(code, at) => DeclarationKind::Parameter,
        // A declaration whose semicolon is missing still declares its name.
        _ => DeclarationKind::Variable,
    };
    Some((format!("{ty}{suffix}"), role))
}

/// Whether the declaration whose type is at `at` stands in the parentheses of a function's parameters.
fn parenthesis_before(code: &[Lexeme<'_>], at: usize) -> bool {
    let mut depth = 0_i32;
    for (index, token) in code[..at].iter().enumerate().rev().take(MAX_LIST) {
        match token.text {
            ")" => depth += 1,
            "(" if depth == 0 => return index == 0 || code[index - 1].text != "for",
            "(" => depth -= 1,
            ";" | "{" | "}" => return false,
            _ => {}
        }
    }
    false
}

/// Where the further names of `vec3 a, b = c, d;` stand.
fn more_names(code: &[Lexeme<'_>], first: usize) -> Vec<usize> {
    let mut more = Vec::new();
    let mut depth = 0_i32;
    for index in first + 1..code.len() {
        match code[index].text {
            "(" | "[" => depth += 1,
            ")" | "]" => depth -= 1,
            ";" | "{" | "}" => break,
            "," if depth == 0 => {
                let named = code.get(index + 1).is_some_and(|next| next.kind == LexemeKind::Word);
                let ends = code.get(index + 2).is_some_and(|next| matches!(next.text, "," | ";" | "=" | "["));
                if !(named && ends) {
                    break;
                }
                more.push(index + 1);
            }
            _ => {}
        }
        if depth < 0 {
            break;
        }
    }
    more
}

/// The qualifiers in front of the declaration whose first name is at `index`.
fn qualifiers<'a>(code: &[Lexeme<'a>], index: usize) -> Vec<&'a str> {
    let before =
        code[..index].iter().rev().take(MAX_LIST).take_while(|token| !matches!(token.text, ";" | "{" | "}" | "="));
    before.map(|token| token.text).filter(|text| vocabulary::is_qualifier(text)).collect()
}

fn declaration<'a>(
    code: &[Lexeme<'a>],
    braces: &Braces,
    index: usize,
    ty: &str,
    role: DeclarationKind,
    qualifiers: &[&'a str],
) -> DeclaredName<'a> {
    let array = code.get(index + 1).is_some_and(|next| next.text == "[");
    let (scope_end, global) = braces.scope(code, index, role);
    DeclaredName {
        name: code[index].text,
        role,
        ty: if array { format!("{ty}[]") } else { ty.to_owned() },
        qualifiers: qualifiers.to_vec(),
        index,
        start: code[index].start,
        scope_end,
        global,
    }
}

/// The braces around every token, found in one pass.
struct Braces {
    /// For each token, the index of the innermost `{` that is open there.
    around: Vec<Option<usize>>,
    /// For each `{`, where its `}` stands; the end of everything where there is none.
    end: Vec<usize>,
}

impl Braces {
    fn new(code: &[Lexeme<'_>]) -> Self {
        let mut open = Vec::new();
        let mut braces = Self { around: Vec::with_capacity(code.len()), end: vec![usize::MAX; code.len()] };
        for (index, token) in code.iter().enumerate() {
            if token.text == "}"
                && let Some(start) = open.pop()
            {
                let start: usize = start;
                braces.end[start] = token.start;
            }
            braces.around.push(open.last().copied());
            if token.text == "{" {
                open.push(index);
            }
        }
        braces
    }

    /// Where the scope of the name at `index` ends, and whether it is the whole file's.
    fn scope(&self, code: &[Lexeme<'_>], index: usize, role: DeclarationKind) -> (usize, bool) {
        if role == DeclarationKind::Parameter {
            // A parameter lives in the body that follows its list.
            let body = (index..code.len()).find(|&at| matches!(code[at].text, "{" | ";"));
            return (body.map_or(usize::MAX, |at| self.end[at]), false);
        }
        match self.around[index] {
            Some(open) => (self.end[open], false),
            None => (usize::MAX, true),
        }
    }
}
