//! The look before the compiler: it is the compiler that a macro bomb or a tower of parentheses kills.

use super::expand::{ExpandedToken, Expander, split_name, tokens};
use super::nesting::{MAX_NESTING, Nesting};
use super::stopped;
use super::structures::{MAX_MEMBERS, Structures};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;
use crate::source::Source;
use crate::translate::TranslationRefusal;

/// Most tokens that the macros of a file may write, those in between included.
///
/// Homework has under 2,000 tokens and few macros. The compiler takes a microsecond a token.
pub(super) const MAX_TOKENS: usize = 100_000;

/// Most `#if` that are open at once: the compiler counts no further, and blames the line that comes next.
const MAX_CONDITIONS: usize = 64;

/// What is wrong at a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Excess {
    Tokens,
    Nesting,
    Conditions,
    Members,
}

/// Refuses a text whose macros write too much, or that nests too deeply after they did.
pub(in crate::translate) fn check_text(source: &Source) -> Result<(), TranslationRefusal> {
    check_extensions(source)?;
    check(source.code()).map_err(|(excess, line)| refusal(excess, line))
}

/// Parts of the names of extensions that the compiler knows and that desktop OpenGL drivers, the course's among them,
/// do not have or have for other purposes than a vertex's colour.
const FOREIGN_EXTENSIONS: [&str; 9] = [
    "subgroup",
    "int64",
    "shader_clock",
    "realtime_clock",
    "debug_printf",
    "ray_",
    "buffer_reference",
    "cooperative",
    "include_directive",
];

/// Refuses a file that asks for one of them.
fn check_extensions(source: &Source) -> Result<(), TranslationRefusal> {
    for (line, text) in logical_lines(source.code()) {
        let Some(directive) = text.trim_start().strip_prefix('#').map(str::trim_start) else { continue };
        let Some((name, behaviour)) = directive.strip_prefix("extension").and_then(|rest| rest.split_once(':')) else {
            continue;
        };
        let name = name.trim();
        let is_foreign = FOREIGN_EXTENSIONS.iter().any(|part| name.contains(part));
        if is_foreign && matches!(behaviour.trim(), "require" | "enable") {
            let message = Text::new(
                format!("the extension `{name}` is not available to this homework's vertex shader"),
                format!("拡張機能 `{name}` は、この課題の頂点シェーダでは使えません"),
            );
            let diagnostic = Diagnostic::error(DiagnosticStage::Compile, message).at(line, None);
            return Err(TranslationRefusal::Rejected(vec![diagnostic]));
        }
    }
    Ok(())
}

fn check(code: &str) -> Result<(), (Excess, u32)> {
    let mut expander = Expander::default();
    let mut shape = TextMeasure::default();
    let mut conditions = 0_usize;
    // Plain lines are expanded together: a macro's arguments may go on to the next line.
    let mut plain = Vec::new();
    for (number, line) in logical_lines(code) {
        let tokens = tokens(&line, number);
        let is_directive = tokens.first().is_some_and(|token| &*token.text == "#");
        if !is_directive {
            plain.extend(tokens);
            continue;
        }
        measure(&mut expander, &mut shape, std::mem::take(&mut plain))?;
        let (name, text) = split_name(line.trim_start().trim_start_matches('#'));
        match name {
            "define" => expander.define(text, conditions == 0),
            "undef" if conditions == 0 => expander.undefine(text),
            "endif" => conditions = conditions.saturating_sub(1),
            "if" | "ifdef" | "ifndef" | "elif" => {
                conditions += usize::from(name != "elif");
                if conditions > MAX_CONDITIONS {
                    return Err((Excess::Conditions, number));
                }
                measure(&mut expander, &mut TextMeasure::default(), tokens.into_iter().skip(2).collect())?;
            }
            _ => {}
        }
    }
    measure(&mut expander, &mut shape, plain)
}

/// What is followed through the tokens that the macros leave.
#[derive(Debug, Default)]
struct TextMeasure {
    nesting: Nesting,
    structures: Structures,
}

fn measure(expander: &mut Expander, shape: &mut TextMeasure, tokens: Vec<ExpandedToken>) -> Result<(), (Excess, u32)> {
    expander.expand(tokens, &mut |token| {
        shape.nesting.take(&token.text);
        if shape.nesting.depth() > MAX_NESTING {
            return Err((Excess::Nesting, token.line));
        }
        if shape.structures.take(&token.text) { Err((Excess::Members, token.line)) } else { Ok(()) }
    })
}

/// The lines with continuations joined, each with the number of its first, from 1.
fn logical_lines(code: &str) -> Vec<(u32, String)> {
    let mut joined: Vec<(u32, String)> = Vec::new();
    let mut goes_on = false;
    for (line, number) in code.lines().zip(1..) {
        let (text, continues) = line.strip_suffix('\\').map_or((line, false), |text| (text, true));
        match joined.last_mut() {
            Some((_, whole)) if goes_on => whole.push_str(text),
            _ => joined.push((number, text.to_owned())),
        }
        goes_on = continues;
    }
    joined
}

fn refusal(excess: Excess, line: u32) -> TranslationRefusal {
    let message = match excess {
        Excess::Tokens => Text::new(
            format!("the macros of this file expand to more than {MAX_TOKENS} tokens (limit of the grader)"),
            format!("マクロの展開結果が {MAX_TOKENS} トークンを超えました (採点システムの上限)"),
        ),
        Excess::Nesting => Text::new(
            format!("parentheses, blocks and operators are nested more than {MAX_NESTING} deep (limit of the grader)"),
            format!("括弧、ブロック、演算子の入れ子が {MAX_NESTING} 段を超えています (採点システムの上限)"),
        ),
        Excess::Conditions => Text::new(
            format!("#if, #ifdef and #ifndef are nested more than {MAX_CONDITIONS} deep (limit of the grader)"),
            format!("#if、#ifdef、#ifndef の入れ子が {MAX_CONDITIONS} 段を超えています (採点システムの上限)"),
        ),
        Excess::Members => Text::new(
            format!(
                "this structure has more than {MAX_MEMBERS} members with those of the structures in it (limit of the grader)"
            ),
            format!(
                "この構造体のメンバは、含まれる構造体のメンバも数えると {MAX_MEMBERS} 個を超えます (採点システムの上限)"
            ),
        ),
    };
    stopped(DiagnosticStage::Compile, Some(line), message)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn homework_passes() {
        let starter = include_str!("../../../reference/assignments/ggsample06/starter.vert");
        assert_eq!(check(starter), Ok(()));
        let macros = "#define MAX0(x) max((x), 0.0)\n#define LIT(a, b) MAX0(dot(a, b))\nfloat f = LIT(n, l);\n";
        assert_eq!(check(macros), Ok(()));
    }

    // Line 20 doubles line 1 nineteen times: 2^19 = 524,288 tokens from 20 lines.
    #[test]
    fn macros_that_double_each_other_are_stopped_where_they_are_used() {
        let mut code = String::from("#define a0 x\n");
        for n in 1..20 {
            code.push_str(&format!("#define a{n} a{0} a{0}\n", n - 1));
        }
        assert_eq!(check(&code), Ok(()), "nothing is used yet");
        code.push_str("a19\n");
        assert_eq!(check(&code), Err((Excess::Tokens, 21)));
    }

    #[test]
    fn a_longer_definition_hides_no_other() {
        let mut code = String::from("#define a0 x\n");
        for n in 1..20 {
            code.push_str(&format!("#define a{n} a{0} a{0}\n", n - 1));
        }
        let harmless = "x + ".repeat(100);
        // What holds is the last; where a condition decides, either may.
        assert_eq!(check(&format!("#define a19 {harmless}\n{code}a19\n")), Err((Excess::Tokens, 22)));
        assert_eq!(check(&format!("{code}#undef a19\n#define a19 {harmless}\na19\n")), Ok(()));
        assert_eq!(check(&format!("{code}#undef a19\na19\n")), Ok(()));
        assert_eq!(
            check(&format!("{code}#if 0\n#undef a19\n#define a19 {harmless}\n#endif\na19\n")),
            Err((Excess::Tokens, 25))
        );
        // No directive, so it defines nothing.
        assert_eq!(check(&format!("{code}#definea19 x\n#undefa19\na19\n")), Err((Excess::Tokens, 23)));
        // With and without arguments under one name.
        let both = format!("#if 1\n#define F(x) x\n#else\n#define F {harmless}\n#endif\nF(a19) F\n");
        assert_eq!(check(&format!("{code}{both}")), Err((Excess::Tokens, 26)));
        let neither = "#if 1\n#define F 1 +\n#else\n#define F(x) 1\n#endif\nF(a19)\n";
        assert_eq!(check(&format!("{code}{neither}")), Err((Excess::Tokens, 26)));
    }

    #[test]
    fn what_macros_write_by_way_of_others_counts() {
        // 10³ copies by G, 10⁹ by H.
        let by_arguments = "#define F(x) x x x x x x x x x x\n#define G(x) F(F(F(x)))\n#define H(x) G(G(G(x)))\n";
        assert_eq!(check(&format!("{by_arguments}G(1)\n")), Ok(()));
        assert_eq!(check(&format!("{by_arguments}H(1)\n")), Err((Excess::Tokens, 4)));
        let mut doubled = String::from("#define a0 x\n");
        for n in 1..20 {
            doubled.push_str(&format!("#define a{n} a{0} a{0}\n", n - 1));
        }
        let pasted = "#define P(a, b) a ## b\n#define Q(n) P(a, n)\n";
        assert_eq!(check(&format!("{doubled}{pasted}P(a1, 9)\n")), Err((Excess::Tokens, 23)));
        assert_eq!(check(&format!("{doubled}{pasted}Q(19)\n")), Err((Excess::Tokens, 23)));
        assert_eq!(check(&format!("{doubled}{pasted}P(b, 19)\n")), Ok(()));
        let variadic = "#define V(...) __VA_ARGS__\n";
        assert_eq!(check(&format!("{doubled}{variadic}V(a19)\n")), Err((Excess::Tokens, 22)));
    }

    #[test]
    fn arguments_that_double_are_stopped() {
        let nested = format!("#define D(x) x x\n{}y{}\n", "D(".repeat(20), ")".repeat(20));
        assert_eq!(check(&nested), Err((Excess::Tokens, 2)));
    }

    #[test]
    fn nesting_that_macros_write_counts() {
        let open = "#define O ((((((((((((((((\n#define P O O O O\nfloat x =\nP P P P P 1;\n";
        // 16 × 4 × 5 = 320 parentheses.
        assert_eq!(check(open), Err((Excess::Nesting, 4)));
    }

    #[test]
    fn a_condition_is_measured_by_itself() {
        let code = format!("#if {}1\n#endif\n", "!".repeat(MAX_NESTING + 1));
        assert_eq!(check(&code), Err((Excess::Nesting, 1)));
    }

    #[test]
    fn conditions_in_conditions_are_counted_and_those_in_a_row_are_not() {
        let deep = |depth| format!("{}{}", "#ifdef x\n".repeat(depth), "#endif\n".repeat(depth));
        assert_eq!(check(&deep(MAX_CONDITIONS).repeat(3)), Ok(()));
        assert_eq!(check(&deep(MAX_CONDITIONS + 1)), Err((Excess::Conditions, MAX_CONDITIONS as u32 + 1)));
    }

    #[test]
    fn a_macro_that_names_itself_ends() {
        assert_eq!(check("#define x x + x\nx\n"), Ok(()));
        assert_eq!(check("#define f(x) f(x) f(x)\nf(f(f(1)))\n"), Ok(()));
        assert_eq!(check("#define a b\n#define b a\na b\n"), Ok(()));
    }
}
