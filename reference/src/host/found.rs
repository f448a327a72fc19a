//! Where the array of a program stands, and what its numbers are written as.

use super::token::{HostToken, HostTokenKind};
use super::{HostArray, UnreadableProgram};
use crate::text::both;
use std::ops::Range;

/// An array in a program.
pub(super) struct FoundArray {
    /// The lines on which it begins and ends.
    pub first: u32,
    pub last: u32,
    /// What each of its numbers is written as.
    pub values: Vec<NumberTokens>,
    /// Whether the program turns it over before it is used.
    pub is_transposed: bool,
}

/// The tokens that say a number; of none it is 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct NumberTokens {
    pub at: usize,
    pub end: usize,
    pub line: u32,
}

/// A declaration of an array: what it is initialised with, if it is, and how many it is said to hold.
struct DeclaredArray {
    at: usize,
    listed: Option<Vec<Range<usize>>>,
    end: usize,
    size: Option<usize>,
}

/// So many tokens between a matrix and the word that turns it over.
const NEAR: usize = 8;

/// The array of a program.
pub(super) fn array(wanted: &HostArray, tokens: &[HostToken<'_>]) -> Result<FoundArray, UnreadableProgram> {
    let (name, used_by, count) = (wanted.name.as_str(), wanted.used_by.as_str(), wanted.count);
    let all: Vec<DeclaredArray> = (0..tokens.len()).filter_map(|at| declared(tokens, at)).collect();
    let is_whole =
        |one: &&DeclaredArray| one.size == Some(count) || one.listed.as_ref().is_some_and(|all| all.len() == count);
    let called = |name: &'_ str| all.iter().filter(|one| tokens[one.at].is(name)).collect::<Vec<_>>();
    // The last one: what stands above may be the one that was handed out.
    let found = [name, used_by].into_iter().find_map(|name| called(name).into_iter().rfind(is_whole));
    let other = || all.iter().rfind(is_whole);
    let is_read = |one: &&DeclaredArray| is_used(wanted, tokens, tokens[one.at].text).is_ok();
    let found = found.or_else(|| other().filter(is_read));
    // Where nothing else is used, one with too few numbers is the one that is meant: other things have sixteen as well.
    let is_list = |one: &&DeclaredArray| one.listed.as_ref().is_some_and(|all| all.len() > 1);
    if let (None, Some(short)) = (found, called(name).into_iter().rfind(is_list)) {
        return Err(of_another_size(name, count, short, tokens));
    }
    let Some(found) = found.or_else(other) else {
        if let Some(short) = called(name).pop() {
            return Err(of_another_size(name, count, short, tokens));
        }
        return Err(UnreadableProgram {
            line: None,
            message: both(
                format!("There is no array `{name}` of {count} numbers in the program."),
                format!("プログラムに {count} 個の数の配列 `{name}` がありません。"),
            ),
            hint: Some(both(
                format!("Write them where the file that was handed out has them: `const GLfloat {name}[] = {{ … }};`"),
                format!("配布されたファイルと同じ形 `const GLfloat {name}[] = {{ … }};` で書いてください。"),
            )),
        });
    };
    let own = tokens[found.at].text;
    is_used(wanted, tokens, own)?;
    let first = tokens[found.at].line;
    let mut last = tokens[found.end.min(tokens.len() - 1)].line;
    let mut values: Vec<Option<NumberTokens>> = match &found.listed {
        None => vec![None; count],
        Some(listed) => {
            let of =
                |range: &Range<usize>| NumberTokens { at: range.start, end: range.end, line: tokens[range.start].line };
            let rest = NumberTokens { at: 0, end: 0, line: last };
            let listed = listed.iter().map(of).map(Some).chain(std::iter::repeat(Some(rest)));
            listed.take(count).collect()
        }
    };
    for at in found.end..tokens.len() {
        if let Some((place, value)) = assigned(tokens, at, own, count)? {
            last = last.max(value.line);
            values[place] = Some(value);
        }
    }
    let values = values.into_iter().enumerate().map(|(at, value)| {
        let message =
            || both(format!("`{own}[{at}]` has no value."), format!("`{own}[{at}]` に値が代入されていません。"));
        value.ok_or_else(|| UnreadableProgram::at(first, message()))
    });
    let values = values.collect::<Result<Vec<_>, _>>()?;
    let turns = |at: usize| {
        let near = &tokens[at.saturating_sub(NEAR)..(at + NEAR).min(tokens.len())];
        let word = tokens[at].text;
        (word == "transpose" || word == "loadTranspose") && near.iter().any(|near| near.is(own) || near.is(used_by))
    };
    let is_transposed = (0..tokens.len()).filter(|at| turns(*at)).count() == 1 && count.isqrt().pow(2) == count;
    Ok(FoundArray { first, last, values, is_transposed })
}

/// What is wrong with an array of too few or too many numbers, at the comma that is missing where there is one.
fn of_another_size(name: &str, count: usize, declared: &DeclaredArray, tokens: &[HostToken<'_>]) -> UnreadableProgram {
    let listed = declared.listed.as_deref().unwrap_or_default();
    let own = listed.len();
    let mut ends = listed.iter().filter_map(|all| {
        all.clone().skip(1).find(|at| tokens[*at].line > tokens[*at - 1].line).map(|at| tokens[at - 1].line)
    });
    let is_short = own + 1 == count;
    let missing = ends.next().filter(|_| is_short && ends.next().is_none());
    let hint = missing.map(|line| {
        both(
            format!("There is no comma at the end of line {line}: the number goes on on the next line."),
            format!("{line} 行目の終わりにコンマがないので、次の行まで 1 つの数の式とみなされます。"),
        )
    });
    let message = both(
        format!("`{name}` has {own} numbers, and a matrix has {count}."),
        format!("`{name}` の数は {own} 個ですが、行列の要素は {count} 個です。"),
    );
    UnreadableProgram { hint, ..UnreadableProgram::at(missing.unwrap_or(tokens[declared.at].line), message) }
}

/// The array that is declared with the name at this place.
fn declared(tokens: &[HostToken<'_>], at: usize) -> Option<DeclaredArray> {
    let is_declared = |before: &HostToken<'_>| {
        before.kind == HostTokenKind::Name && !before.is("return") || [">", "*", "&"].contains(&before.text)
    };
    if tokens[at].kind != HostTokenKind::Name || !at.checked_sub(1).is_some_and(|before| is_declared(&tokens[before])) {
        return None;
    }
    let mut next = at + 1;
    let mut size = None;
    while tokens.get(next)?.is("[") {
        let end = closing(tokens, next)?;
        let own = if let [one] = &tokens[next + 1..end] { one.text.parse::<usize>().ok() } else { None };
        size = match (size, own) {
            (Some(size), Some(own)) => usize::checked_mul(size, own),
            (None, own) => own,
            (size, None) => size,
        };
        next = end + 1;
    }
    let is_array = next > at + 1;
    if is_array && tokens.get(next)?.is(";") {
        return Some(DeclaredArray { at, listed: None, end: next, size });
    }
    if tokens.get(next)?.is("=") || tokens.get(next)?.is("(") {
        next += 1;
    }
    if !tokens.get(next)?.is("{") {
        return None;
    }
    let end = closing(tokens, next)?;
    Some(DeclaredArray { at, listed: Some(listed(tokens, next, end)), end, size: size.filter(|_| is_array) })
}

/// The tokens of each number between two braces; braces within them only group.
fn listed(tokens: &[HostToken<'_>], open: usize, close: usize) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let (mut depth, mut start) = (0, open + 1);
    for at in open + 1..=close {
        let token = &tokens[at];
        // Braces behind a name are those of a value: `GLfloat{4}`.
        let is_value = token.is("{") && tokens[at - 1].kind == HostTokenKind::Name;
        if token.is("(") || token.is("[") || is_value || token.is("{") && depth > 0 {
            depth += 1;
        } else if depth > 0 {
            depth -= usize::from([")", "]", "}"].contains(&token.text));
        } else if ["{", "}", ","].contains(&token.text) {
            found.extend((start < at).then_some(start..at));
            start = at + 1;
        }
    }
    found
}

/// The value that is given to an element of the array here.
fn assigned(
    tokens: &[HostToken<'_>],
    at: usize,
    name: &str,
    count: usize,
) -> Result<Option<(usize, NumberTokens)>, UnreadableProgram> {
    let is_element = tokens[at].is(name) && tokens.get(at + 1).is_some_and(|next| next.is("["));
    if !is_element {
        return Ok(None);
    }
    let line = tokens[at].line;
    let mut places = Vec::new();
    let mut next = at + 1;
    while tokens.get(next).is_some_and(|token| token.is("[")) {
        let Some(end) = closing(tokens, next) else { return Ok(None) };
        let place = if let [one] = &tokens[next + 1..end] { one.text.parse::<usize>().ok() } else { None };
        places.push(place);
        next = end + 1;
    }
    let sign = tokens.get(next).map_or("", |token| token.text);
    if !["=", "+=", "-=", "*=", "/=", "++", "--"].contains(&sign) {
        return Ok(None);
    }
    let side = count.isqrt();
    let place = match places[..] {
        [Some(place)] => Some(place),
        [Some(column), Some(row)] if row < side => Some(column * side + row),
        _ => None,
    };
    match place.filter(|place| *place < count && sign == "=") {
        Some(place) => {
            let end = (next..tokens.len()).find(|at| tokens[*at].is(";")).unwrap_or(tokens.len());
            Ok(Some((place, NumberTokens { at: next + 1, end, line })))
        }
        None => Err(UnreadableProgram {
            line: Some(line),
            message: both(
                format!("`{name}` is changed here in a way that only running the program would tell."),
                format!("ここで `{name}` の値が変わりますが、その値はプログラムを実行しないと分かりません。"),
            ),
            hint: Some(both(
                format!("Write the {count} numbers where `{name}` is declared."),
                format!("`{name}` の宣言に {count} 個の数を書いてください。"),
            )),
        }),
    }
}

/// Whether the program makes its matrix of the array, where it can be seen.
fn is_used(wanted: &HostArray, tokens: &[HostToken<'_>], own: &str) -> Result<(), UnreadableProgram> {
    let used_by = wanted.used_by.as_str();
    if own == used_by {
        return Ok(());
    }
    let given = (1..tokens.len()).filter(|at| {
        let next = tokens.get(at + 1).is_some_and(|next| ["{", "(", "="].contains(&next.text));
        tokens[*at].is(used_by)
            && next
            && (tokens[at - 1].kind == HostTokenKind::Name || tokens[at - 1].is("*") || tokens[at + 1].is("="))
    });
    let statement = |at: usize| {
        let end = (at..tokens.len()).find(|at| tokens[*at].is(";")).unwrap_or(tokens.len());
        (at, &tokens[at..end])
    };
    let statements: Vec<_> = given.map(statement).collect();
    if statements.is_empty() || statements.iter().any(|(_, all)| all.iter().any(|token| token.is(own))) {
        return Ok(());
    }
    let line = tokens[statements[0].0].line;
    Err(UnreadableProgram {
        line: Some(line),
        message: both(
            format!("The program does not make `{used_by}` of the numbers of `{own}`, which are what is graded."),
            format!("`{used_by}` が `{own}` の数値から作られていません。採点するのは `{own}` の数値です。"),
        ),
        hint: Some(both(
            "Is this the way of the shadow map? That is another homework, to which the shaders are handed in.",
            "シャドウマップの方法で作ったのであれば、シェーダを提出する別の課題があります。",
        )),
    })
}

/// So many tokens may stand between brackets: sixteen numbers have far fewer.
const MOST_TOKENS: usize = 4_000;

/// The place of the bracket that closes this one.
pub(super) fn closing(tokens: &[HostToken<'_>], open: usize) -> Option<usize> {
    let mut depth = 0_usize;
    let behind = tokens.iter().enumerate().skip(open).take(MOST_TOKENS);
    for (at, token) in behind.filter(|(_, token)| token.kind == HostTokenKind::Sign) {
        match token.text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => {
                depth = depth.checked_sub(1)?;
                if depth == 0 {
                    return Some(at);
                }
            }
            _ => {}
        }
    }
    None
}
