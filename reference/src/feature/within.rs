//! Within which feature's text something of the solution stands.

use crate::Assignment;
use crate::assignment::HandedIn;
use crate::feature::Feature;
use crate::interpreter::outline::{self, FunctionText};
use std::collections::BTreeSet;
use std::ops::Range;

/// Where the features of a rubric stand in a solution's file.
#[derive(Debug)]
pub(crate) struct FeatureTexts {
    /// The texts that are not there without a line's feature, with the line's place in the rubric.
    texts: Vec<(usize, Range<usize>)>,
    /// The bodies of the functions that are run by the texts of one line alone.
    functions: Vec<(usize, Range<usize>)>,
}

impl FeatureTexts {
    /// Looks for them.
    pub fn of(assignment: &Assignment, file: &HandedIn) -> Self {
        let text = &file.solution.text;
        let replaced = |line: usize| -> Vec<(usize, Range<usize>)> {
            let Some(Some(Feature::Program(program))) = assignment.features.get(line) else { return Vec::new() };
            let range = |[own, _]: &[String; 2]| text.find(own.as_str()).map(|start| (line, start..start + own.len()));
            program.replaced.iter().filter_map(range).collect()
        };
        let texts: Vec<(usize, Range<usize>)> = (0..assignment.rubric.len()).flat_map(replaced).collect();
        let all = if texts.is_empty() { Vec::new() } else { outline::functions(text) };
        let lines: BTreeSet<usize> = texts.iter().map(|(line, _)| *line).collect();
        let ways_of = |line: usize| {
            let is_within = |at: usize| texts.iter().any(|(own, range)| *own == line && range.contains(&at));
            (line, called(text, &all, &is_within))
        };
        let ways: Vec<(usize, BTreeSet<(usize, bool)>)> = lines.into_iter().map(ways_of).collect();
        let alone = |(number, function): (usize, &FunctionText)| {
            let is_run = |(_, ways): &&(usize, BTreeSet<(usize, bool)>)| {
                ways.contains(&(number, true)) && !ways.contains(&(number, false))
            };
            let mut lines = ways.iter().filter(is_run);
            let (line, _) = lines.next().filter(|_| lines.next().is_none())?;
            Some((*line, function.body.clone()))
        };
        let functions = all.iter().enumerate().filter_map(alone).collect();
        Self { texts, functions }
    }

    /// The line without whose feature these bytes of the file are not there, or not run: the one with the shortest text around them, or
    /// the only one whose texts call the function that they stand in.
    pub fn line(&self, bytes: &Range<usize>) -> Option<usize> {
        let is_around = |(_, range): &&(usize, Range<usize>)| range.start <= bytes.start && bytes.end <= range.end;
        let shortest = self.texts.iter().filter(is_around).min_by_key(|(_, range)| range.len());
        shortest.or_else(|| self.functions.iter().find(is_around)).map(|(line, _)| *line)
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
