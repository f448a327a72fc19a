//! What names in a program stand for: what it has beside, and what it declares with a value.

use super::UnreadableProgram;
use super::expression::HostExpression;
use super::found::closing;
use super::reader::{DEEPEST, HostResult, Reader};
use super::token::HostTokenKind;
use crate::text::both;

/// What a name stands for.
pub(super) enum NameMeaning {
    Value(HostExpression),
    /// A variable that the program has beside.
    Given(String),
    /// An array of so many tokens each.
    List(Vec<std::ops::Range<usize>>),
}

impl Reader<'_> {
    /// What the name at a place stands for: something that the program has beside, or what it is declared as further up.
    pub fn meaning(&mut self, place: usize, at: &mut usize, end: usize) -> HostResult<NameMeaning> {
        let text = |at: usize| self.tokens.get(at).filter(|_| at < end).map_or("", |token| token.text);
        let mut path = self.tokens[place].text.to_owned();
        let mut next = place + 1;
        loop {
            if self.array.given.contains_key(&path) {
                *at = next;
                // What a vector holds, as a pointer.
                if [".", "data", "(", ")"].iter().enumerate().all(|(step, sign)| text(next + step) == *sign) {
                    *at += 4;
                }
                return Ok(NameMeaning::Given(path));
            }
            let is_member =
                text(next) == "." && self.array.given.keys().any(|given| given.starts_with(&format!("{path}.")));
            if !is_member {
                break;
            }
            path = format!("{path}.{}", text(next + 1));
            next += 2;
        }
        let name = self.tokens[place].text;
        let declared = (1..place).rev().find(|at| self.tokens[*at].is(name) && self.is_declared(*at));
        let declared =
            declared.or_else(|| (0..self.tokens.len()).find(|at| self.tokens[*at].is(name) && self.is_macro(*at)));
        let Some(declared) = declared else {
            let known = self.array.given.keys().map(|name| format!("`{name}[…]`")).collect::<Vec<_>>();
            return Err(UnreadableProgram {
                hint: Some(both(
                    format!("Numbers, {} and names that are declared with these are read.", known.join(", ")),
                    format!("読み取るのは、数、{}、およびそれらで宣言された名前です。", known.join("、")),
                )),
                ..self.wrong(
                    place,
                    both(
                        format!("It is not known what number `{name}` is."),
                        format!("`{name}` がどんな数なのか分かりません。"),
                    ),
                )
            });
        };
        if self.is_macro(declared) {
            let stop = (declared..self.tokens.len()).find(|at| self.tokens[*at].is(";")).unwrap_or(self.tokens.len());
            return Ok(NameMeaning::Value(self.deeper(declared + 1, stop, place)?));
        }
        self.declared(declared, place)
    }

    fn is_macro(&self, at: usize) -> bool {
        self.tokens[at].is_macro && (at == 0 || !self.tokens[at - 1].is_macro || self.tokens[at - 1].is(";"))
    }

    /// Whether a name is declared here with a value: `float height = …`, `auto height{ … }`.
    fn is_declared(&self, at: usize) -> bool {
        let [before, behind] = [
            &self.tokens[at - 1],
            match self.tokens.get(at + 1) {
                Some(behind) => behind,
                None => return false,
            },
        ];
        let is_type = before.kind == HostTokenKind::Name && !["return", "else", "case"].contains(&before.text);
        let is_given = match behind.text {
            // An array, and not an element of one.
            "[" => closing(self.tokens, at + 1)
                .and_then(|close| self.tokens.get(close + 1))
                .is_some_and(|next| ["=", "{", "["].contains(&next.text)),
            behind => ["=", "{", "("].contains(&behind),
        };
        (is_type || [",", "*", "&", ">"].contains(&before.text)) && is_given
    }

    /// What a declaration gives the name at `at`.
    fn declared(&mut self, at: usize, place: usize) -> HostResult<NameMeaning> {
        let mut next = at + 1;
        while self.tokens.get(next).is_some_and(|token| token.is("[")) {
            next = closing(self.tokens, next).ok_or_else(|| self.not_read(place))? + 1;
        }
        let is_list = next > at + 1;
        if self.tokens.get(next).is_some_and(|token| token.is("=")) {
            next += 1;
        }
        let Some(open) = self.tokens.get(next) else { return Err(self.not_read(place)) };
        let (start, end) = if ["{", "("].contains(&open.text) && (open.is("{") || next == at + 1) {
            (next + 1, closing(self.tokens, next).ok_or_else(|| self.not_read(place))?)
        } else {
            (next, self.end_of_value(next))
        };
        let commas = self.commas(start, end);
        if is_list || !commas.is_empty() {
            let starts = std::iter::once(start).chain(commas.iter().map(|comma| comma + 1));
            let ends = commas.iter().copied().chain([end]);
            return Ok(NameMeaning::List(starts.zip(ends).map(|(start, end)| start..end).collect()));
        }
        // `const auto& l = lp;`
        let is_path =
            |at: usize| self.tokens[at].kind == HostTokenKind::Name || [".", "(", ")"].contains(&self.tokens[at].text);
        if start < end && self.tokens[start].kind == HostTokenKind::Name && (start..end).all(is_path) {
            self.depth += 1;
            if self.depth > DEEPEST {
                return Err(self.circle(place));
            }
            let mut behind = start + 1;
            let line = Some(self.tokens[place].line);
            let meaning = self.meaning(start, &mut behind, end);
            let meaning = meaning.map_err(|unreadable| UnreadableProgram { line, ..unreadable })?;
            self.depth -= 1;
            if behind == end {
                return Ok(meaning);
            }
        }
        Ok(NameMeaning::Value(self.deeper(start, end, place)?))
    }

    fn end_of_value(&self, start: usize) -> usize {
        let mut depth = 0_usize;
        for (at, token) in self.tokens.iter().enumerate().skip(start) {
            match token.text {
                "(" | "[" | "{" => depth += 1,
                ")" | "]" | "}" if depth == 0 => return at,
                ")" | "]" | "}" => depth -= 1,
                ";" | "," if depth == 0 => return at,
                _ => {}
            }
        }
        self.tokens.len()
    }

    fn commas(&self, start: usize, end: usize) -> Vec<usize> {
        let mut depth = 0_usize;
        let mut found = Vec::new();
        for at in start..end {
            match self.tokens[at].text {
                "(" | "[" | "{" => depth += 1,
                ")" | "]" | "}" => depth = depth.saturating_sub(1),
                "," if depth == 0 => found.push(at),
                _ => {}
            }
        }
        found
    }

    /// What a name stands for, which is said at the place where the name stands.
    pub fn deeper(&mut self, at: usize, end: usize, place: usize) -> HostResult<HostExpression> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.circle(place));
        }
        let found = self.whole(at, end);
        self.depth -= 1;
        let line = self.tokens[place].line;
        found.map_err(|unreadable| UnreadableProgram { line: Some(line), ..unreadable })
    }

    fn circle(&self, place: usize) -> UnreadableProgram {
        self.wrong(place, both("Names stand for one another in a circle.", "名前が互いに参照し合っています。"))
    }
}
