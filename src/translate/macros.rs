//! Macros written out where they are used, so that the compiler says for each operator on which line it is written.

use super::hints::{Lexeme, LexemeKind, tokens};
use std::collections::HashMap;
use std::fmt::Write;

/// From this version on, `#line` names the line that follows it.
const PLAIN_LINES: i32 = 330;
/// Macros nest no deeper than this; a line grows to no more than so many tokens, and a text to so many bytes.
const MAX_DEPTH: u32 = 16;
const MAX_TOKENS: usize = 1 << 12;
const MAX_BYTES: usize = 1 << 18;

/// A token and the line that it is written on.
#[derive(Clone, Copy)]
struct Placed<'a> {
    token: Lexeme<'a>,
    line: usize,
}

/// A macro of the file.
struct Macro<'a> {
    line: usize,
    /// The parameters, where it takes any.
    parameters: Option<Vec<&'a str>>,
    body: Vec<Lexeme<'a>>,
}

/// `text` with its macros written out between `#line` directives. `None` where there are none, or where it takes a
/// preprocessor to say what they are.
pub(super) fn on_their_lines(text: &str, version: i32) -> Option<String> {
    let mut macros = HashMap::new();
    for (line, directive) in text.lines().zip(1..).map(|(text, line)| (line, text.trim_start())) {
        let Some(rest) = directive.strip_prefix('#').map(str::trim_start) else { continue };
        let Some(definition) = rest.strip_prefix("define") else {
            let is_harmless = ["version", "extension", "pragma"].iter().any(|name| rest.starts_with(name));
            if is_harmless { continue } else { return None }
        };
        let (name, found) = definition_of(definition, line)?;
        if macros.insert(name, found).is_some() {
            return None;
        }
    }
    if macros.is_empty() || version < PLAIN_LINES {
        return None;
    }
    let mut out = String::new();
    for (line, own) in text.split_inclusive('\n').zip(1..).map(|(text, line)| (line, text)) {
        let all = tokens(own);
        let is_used = all.iter().any(|token| macros.contains_key(token.text));
        if own.trim_start().starts_with('#') || !is_used {
            out.push_str(own);
        } else {
            let all: Vec<Placed<'_>> = all.into_iter().map(|token| Placed { token, line }).collect();
            let mut written = Vec::new();
            write_out(&all, &macros, 0, &mut written)?;
            let mut last = line;
            for Placed { token, line } in written {
                if line != last {
                    let _ = write!(out, "\n#line {line}\n");
                }
                last = line;
                let _ = write!(out, "{} ", token.text);
            }
            let _ = write!(out, "\n#line {}\n", line + 1);
        }
        if out.len() > MAX_BYTES {
            return None;
        }
    }
    Some(out)
}

fn definition_of(definition: &str, line: usize) -> Option<(&str, Macro<'_>)> {
    let definition = definition.trim_start();
    let all = tokens(definition);
    let name = all.first().filter(|token| token.kind == LexemeKind::Word)?;
    let known =
        |token: &Lexeme<'_>| !matches!(token.kind, LexemeKind::Other | LexemeKind::Quoted | LexemeKind::Directive);
    if definition.ends_with('\\') || !all.iter().all(known) {
        return None;
    }
    let takes_any = all.get(1).is_some_and(|open| open.text == "(" && open.start == name.end());
    if !takes_any {
        return Some((name.text, Macro { line, parameters: None, body: all[1..].to_vec() }));
    }
    let close = all.iter().position(|token| token.text == ")")?;
    let parameters =
        all[2..close].iter().filter(|token| token.kind == LexemeKind::Word).map(|token| token.text).collect();
    Some((name.text, Macro { line, parameters: Some(parameters), body: all[close + 1..].to_vec() }))
}

/// Writes out what `all` are made of: each token with the line that it is written on.
fn write_out<'a>(
    all: &[Placed<'a>],
    macros: &HashMap<&str, Macro<'a>>,
    depth: u32,
    out: &mut Vec<Placed<'a>>,
) -> Option<()> {
    if depth > MAX_DEPTH || out.len() > MAX_TOKENS {
        return None;
    }
    let mut at = 0;
    while let Some(one) = all.get(at) {
        at += 1;
        let Some(found) = macros.get(one.token.text) else {
            out.push(*one);
            continue;
        };
        let body = found.body.iter().map(|token| Placed { token: *token, line: found.line });
        let body: Vec<Placed<'a>> = match &found.parameters {
            None => body.collect(),
            Some(_) if all.get(at).is_none_or(|open| open.token.text != "(") => {
                out.push(*one);
                continue;
            }
            Some(parameters) => {
                // A call that goes on in the next line is left to a preprocessor.
                let (arguments, taken) = arguments(&all[at..])?;
                at += taken;
                if arguments.len() != parameters.len() {
                    return None;
                }
                body.flat_map(|one| match parameters.iter().position(|name| *name == one.token.text) {
                    Some(index) => arguments[index].clone(),
                    None => vec![one],
                })
                .collect()
            }
        };
        write_out(&body, macros, depth + 1, out)?;
    }
    Some(())
}

/// The arguments in the brackets that `all` begins with, and how many tokens they take.
fn arguments<'a>(all: &[Placed<'a>]) -> Option<(Vec<Vec<Placed<'a>>>, usize)> {
    let mut depth = 0;
    let mut arguments = vec![Vec::new()];
    for (index, one) in all.iter().enumerate() {
        match one.token.text {
            "(" | "[" => depth += 1,
            ")" | "]" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some((arguments, index + 1));
        }
        match (depth, one.token.text) {
            (1, ",") => arguments.push(Vec::new()),
            (1, "(") if index == 0 => {}
            _ => arguments.last_mut()?.push(*one),
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_token_comes_from_the_line_that_it_is_written_on() {
        let text = "#version 410\n#define TWICE(x) (2.0 * x)\n#define A TWICE(k)\nfloat a = A + TWICE(b);\nfloat c;\n";
        let written = on_their_lines(text, 410).expect("there are macros");
        let squeezed: Vec<&str> = written.lines().map(str::trim).skip(3).collect();
        let expected = "float a =|#line 2|( 2.0 *|#line 3|k|#line 2|)|#line 4|+|#line 2|( 2.0 *|#line 4|b|#line 2|)|#line 4|;|#line 5|float c;";
        assert_eq!(squeezed.join("|"), expected);
    }

    #[test]
    fn what_takes_a_preprocessor_is_left_alone() {
        for text in ["float a;\n", "#ifdef A\n#endif\n", "#define A(x) x##x\nA(b)\n", "#define A(x) x\nA(b,\nc)\n"] {
            assert_eq!(on_their_lines(text, 410), None, "{text}");
        }
    }

    #[test]
    fn macros_that_explode_are_left_alone() {
        let mut text = String::from("#define M0 a a a a a a a a\n");
        for depth in 1..12 {
            let below = format!("M{} ", depth - 1);
            text.push_str(&format!("#define M{depth} {}\n", below.repeat(8)));
        }
        text.push_str("M11\n");
        assert_eq!(on_their_lines(&text, 410), None);
    }
}
