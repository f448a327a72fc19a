//! Within which feature's text something of the solution stands.

use crate::Assignment;
use crate::assignment::HandedIn;
use crate::feature::Feature;
use crate::interpreter::outline::{self, FunctionText};
use std::collections::BTreeSet;
use std::ops::Range;

impl Assignment {
    /// The line of the rubric without whose feature these bytes of a solution's file are not there, or not run: the one with the
    /// shortest text around them, or the only one whose text calls the function that they stand in.
    pub(crate) fn line_with(&self, file: &HandedIn, bytes: &Range<usize>) -> Option<usize> {
        let text = &file.solution.text;
        let replaced = |line: usize| -> Vec<Range<usize>> {
            let Some(Some(Feature::Program(program))) = self.features.get(line) else { return Vec::new() };
            let range = |[own, _]: &[String; 2]| text.find(own.as_str()).map(|start| start..start + own.len());
            program.replaced.iter().filter_map(range).collect()
        };
        let all: Vec<(usize, Range<usize>)> = (0..self.rubric.len())
            .flat_map(|line| replaced(line).into_iter().map(move |range| (line, range)))
            .collect();
        let is_around = |(_, range): &&(usize, Range<usize>)| range.start <= bytes.start && bytes.end <= range.end;
        if let Some((line, _)) = all.iter().filter(is_around).min_by_key(|(_, range)| range.len()) {
            return Some(*line);
        }
        let functions = outline::functions(text);
        let own = functions.iter().position(|one| one.body.start <= bytes.start && bytes.end <= one.body.end)?;
        let is_only = |line: &usize| {
            let within: Vec<&Range<usize>> =
                all.iter().filter(|(own, _)| own == line).map(|(_, range)| range).collect();
            let ways = called(text, &functions, &|at| within.iter().any(|range| range.contains(&at)));
            ways.contains(&(own, true)) && !ways.contains(&(own, false))
        };
        let mut lines = (0..self.rubric.len()).filter(is_only);
        lines.next().filter(|_| lines.next().is_none())
    }
}

/// The functions that are run, each with whether a call on the way to it stands `is_within` something.
fn called(text: &str, functions: &[FunctionText], is_within: &dyn Fn(usize) -> bool) -> BTreeSet<(usize, bool)> {
    let is_letter = |c: char| c.is_alphanumeric() || c == '_';
    let calls = |of: &FunctionText| -> Vec<(usize, usize)> {
        let calls_of = |name: &str| -> Vec<usize> {
            let is_call =
                |at: &usize| !text[..*at].ends_with(is_letter) && text[at + name.len()..].trim_start().starts_with('(');
            let all = text[of.body.clone()].match_indices(name).map(|(at, _)| of.body.start + at);
            all.filter(is_call).collect()
        };
        let each = functions.iter().enumerate();
        each.flat_map(|(number, one)| calls_of(&one.name.text).into_iter().map(move |at| (at, number))).collect()
    };
    let main = functions.iter().position(|one| one.name.text == "main");
    let mut open: Vec<(usize, bool)> = main.map(|main| (main, false)).into_iter().collect();
    let mut seen: BTreeSet<(usize, bool)> = open.iter().copied().collect();
    while let Some((function, is_behind)) = open.pop() {
        for (at, callee) in calls(&functions[function]) {
            let next = (callee, is_behind || is_within(at));
            if seen.insert(next) {
                open.push(next);
            }
        }
    }
    seen
}
