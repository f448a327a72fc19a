//! From which other names each name of a solution is computed, as it is written.

use crate::assignment::HandedIn;
use crate::interpreter::outline::{FunctionText, StatementText, Word, functions};
use std::collections::{BTreeMap, BTreeSet};

/// A name, and the number of the function in which it is declared; `None` outside of functions.
pub(super) type ScopedName = (Option<usize>, String);

/// The functions of a solution, and from what each name is computed.
pub(super) struct Flow<'t> {
    pub functions: Vec<OwnFunction<'t>>,
    made_of: BTreeMap<ScopedName, BTreeSet<ScopedName>>,
}

/// A function of the solution.
pub(super) struct OwnFunction<'t> {
    /// The text that it stands in.
    pub file: &'t str,
    pub text: FunctionText,
    /// Its parameters, and whether each is written.
    parameters: Vec<(String, bool)>,
    locals: BTreeSet<String>,
}

/// A statement that gives something a value.
pub(super) struct Giving<'s> {
    /// What is given the value; nothing by name is what the function returns.
    pub to: Option<&'s str>,
    /// The words of the value.
    pub from: &'s [Word],
}

impl<'t> Flow<'t> {
    pub fn of(files: &'t [HandedIn]) -> Self {
        let own = files.iter().flat_map(|file| {
            let text = file.solution.text.as_str();
            functions(text).into_iter().map(move |function| OwnFunction::of(text, function))
        });
        let mut flow = Self { functions: own.collect(), made_of: BTreeMap::new() };
        let mut edges: Vec<(ScopedName, BTreeSet<ScopedName>)> = Vec::new();
        for (function, own) in flow.functions.iter().enumerate() {
            for statement in &own.text.statements {
                for giving in given(statement) {
                    let mut from = flow.read(function, giving.from);
                    from.extend(flow.read(function, &statement.under));
                    edges.push((flow.given_by(function, &giving), from));
                }
                for words in [&statement.words, &statement.under] {
                    edges.extend(flow.handed_over(function, words));
                }
            }
        }
        for (to, from) in edges {
            flow.made_of.entry(to).or_default().extend(from);
        }
        flow
    }

    /// What a name means in a function.
    pub fn seen_in(&self, function: usize, name: &str) -> ScopedName {
        (self.functions[function].locals.contains(name).then_some(function), name.to_owned())
    }

    /// What the name of a definition means.
    pub fn seen_in_main(&self, name: &str) -> ScopedName {
        let is_its = |own: &OwnFunction<'_>| own.text.name.text == "main" && own.locals.contains(name);
        (self.functions.iter().position(is_its), name.to_owned())
    }

    /// What is given a value in a function.
    pub fn given_by(&self, function: usize, giving: &Giving<'_>) -> ScopedName {
        giving.to.map_or_else(|| self.functions[function].result(), |to| self.seen_in(function, to))
    }

    /// Whether it is computed in the solution.
    pub fn is_computed(&self, node: &ScopedName) -> bool {
        self.made_of.contains_key(node)
    }

    /// All that is computed.
    pub fn computed(&self) -> impl Iterator<Item = &ScopedName> {
        self.made_of.keys()
    }

    /// Some names and what they are computed from, by all steps but some. What a function that is among them is given is its caller's
    /// affair.
    pub fn made_of(
        &self,
        nodes: &BTreeSet<ScopedName>,
        is_cut: &dyn Fn(&ScopedName, &ScopedName) -> bool,
    ) -> BTreeSet<ScopedName> {
        let is_given = |node: &ScopedName| {
            let own = node.0.map(|function| &self.functions[function]);
            own.is_some_and(|own| {
                nodes.contains(&own.result()) && own.parameters.iter().any(|(name, _)| *name == node.1)
            })
        };
        let mut found = BTreeSet::new();
        let mut open: Vec<ScopedName> = nodes.iter().cloned().collect();
        while let Some(node) = open.pop() {
            if found.insert(node.clone()) && !is_given(&node) {
                let from = self.made_of.get(&node).into_iter().flatten();
                open.extend(from.filter(|from| !is_cut(&node, from)).cloned());
            }
        }
        found
    }

    /// What some words read. What stands in the brackets of a call is read by the function.
    fn read(&self, function: usize, words: &[Word]) -> BTreeSet<ScopedName> {
        let mut found = BTreeSet::new();
        let mut at = 0;
        while at < words.len() {
            if is_read(words, at) {
                found.insert(self.seen_in(function, &words[at].text));
            }
            let inside = if self.called(words, at).is_some() { until_closed(&words[at + 2..]) + 2 } else { 1 };
            at += inside;
        }
        found
    }

    /// The function of the solution that is called at a place.
    fn called(&self, words: &[Word], at: usize) -> Option<usize> {
        let is_call = words.get(at + 1).is_some_and(|next| next.text == "(");
        self.functions.iter().position(|own| is_call && own.text.name.text == words[at].text)
    }

    /// What calls among some words give to parameters, and parameters to what is handed over.
    fn handed_over(&self, function: usize, words: &[Word]) -> Vec<(ScopedName, BTreeSet<ScopedName>)> {
        let mut edges = Vec::new();
        for at in 0..words.len() {
            let Some(called) = self.called(words, at) else { continue };
            let arguments = parts(&words[at + 2..]);
            for ((parameter, is_written), argument) in self.functions[called].parameters.iter().zip(arguments) {
                let inner = (Some(called), parameter.clone());
                let outer = self.read(function, argument);
                if *is_written {
                    edges.extend(outer.iter().map(|outer| (outer.clone(), BTreeSet::from([inner.clone()]))));
                }
                edges.push((inner, outer));
            }
        }
        edges
    }
}

impl<'t> OwnFunction<'t> {
    fn of(file: &'t str, text: FunctionText) -> Self {
        let parameter = |part: &[Word]| {
            let is_written = part.iter().any(|word| matches!(word.text.as_str(), "out" | "inout"));
            let name = part.iter().take_while(|word| word.text != "[").filter(|word| word.is_name).last();
            name.map(|name| (name.text.clone(), is_written))
        };
        let parameters: Vec<(String, bool)> = parts(&text.parameters).into_iter().filter_map(parameter).collect();
        let declared = text.statements.iter().filter(|statement| is_declaration(statement)).flat_map(given);
        let locals = declared.filter_map(|giving| giving.to.map(str::to_owned));
        let locals = locals.chain(parameters.iter().map(|(name, _)| name.clone())).collect();
        Self { file, text, parameters, locals }
    }

    /// What it returns.
    fn result(&self) -> ScopedName {
        (None, self.text.name.text.clone())
    }
}

/// Whether a statement declares: a type, and then a name.
fn is_declaration(statement: &StatementText) -> bool {
    matches!(&statement.words[..], [first, second, ..] if first.is_name && second.is_name && first.text != "return")
}

/// What a statement gives values to.
pub(super) fn given(statement: &StatementText) -> Vec<Giving<'_>> {
    let words = &statement.words[..statement.words.len().saturating_sub(1)];
    if words.first().is_some_and(|first| first.text == "return") {
        return vec![Giving { to: None, from: &words[1..] }];
    }
    if !is_declaration(statement) {
        let assigned = statement.assignment().and_then(|at| {
            let to = words[..at].iter().find(|word| word.is_name)?;
            Some(Giving { to: Some(&to.text), from: &words[at + 1..] })
        });
        return assigned.into_iter().collect();
    }
    let declared = parts(words).into_iter().filter_map(|part| {
        let name = part.iter().take_while(|word| word.is_name).last()?;
        let value = part.iter().position(|word| word.text == "=").map_or(&[][..], |at| &part[at + 1..]);
        Some(Giving { to: Some(&name.text), from: value })
    });
    declared.collect()
}

/// The names among some words, members of something left out.
pub(super) fn names(words: &[Word]) -> impl Iterator<Item = &str> {
    (0..words.len()).filter(|at| is_read(words, *at)).map(|at| words[at].text.as_str())
}

fn is_read(words: &[Word], at: usize) -> bool {
    words[at].is_name && at.checked_sub(1).is_none_or(|before| words[before].text != ".")
}

/// How many words stand before the bracket that closes.
fn until_closed(words: &[Word]) -> usize {
    let mut depth = 0_usize;
    let closes = words.iter().position(|word| {
        let is_end = depth == 0 && closes(word);
        if opens(word) {
            depth += 1;
        } else if closes(word) {
            depth = depth.saturating_sub(1);
        }
        is_end
    });
    closes.unwrap_or(words.len())
}

/// What stands between commas, up to the bracket that closes.
fn parts(words: &[Word]) -> Vec<&[Word]> {
    let mut depth = 0_usize;
    let is_between = |word: &Word| {
        if opens(word) {
            depth += 1;
        } else if closes(word) {
            depth = depth.saturating_sub(1);
        }
        depth == 0 && word.text == ","
    };
    words[..until_closed(words)].split(is_between).collect()
}

fn opens(word: &Word) -> bool {
    matches!(word.text.as_str(), "(" | "[" | "{")
}

fn closes(word: &Word) -> bool {
    matches!(word.text.as_str(), ")" | "]" | "}")
}
