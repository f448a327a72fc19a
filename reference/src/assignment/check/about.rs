//! Which variables and functions of the solution a line of the rubric is about, where the line says what the solution lacks without it.
//!
//! What a text is replaced by in the solution without a feature tells what belongs to the feature: the names that are gone, what they
//! are computed from, and what is given the value that is another one.

mod flow;

use crate::Assignment;
use crate::assignment::HandedIn;
use crate::feature::Feature;
use crate::interpreter::DISCARD;
use crate::interpreter::outline::{Word, loop_heads, words};
use flow::{Flow, OwnFunction, ScopedName, given, names};
use std::collections::BTreeSet;

/// What belongs to a line.
#[derive(Debug, Default)]
struct Belongs {
    /// What is not read any more, without the feature, where it is used.
    gone: BTreeSet<ScopedName>,
    /// What is given the value that is another one without it.
    given: BTreeSet<ScopedName>,
    /// Those that are given other values as well, or of whose value that is a part.
    parts: BTreeSet<ScopedName>,
    /// What is read all the same where it is used.
    left: BTreeSet<ScopedName>,
    /// Whether it is what throws fragments away.
    throws_away: bool,
}

/// Completes the lines of the rubric by what they are about; of what the folder says so of some line, that holds.
pub(super) fn complete(assignment: &mut Assignment) {
    let lines: Vec<usize> =
        (0..assignment.rubric.len()).filter(|at| !assignment.judges_position(&assignment.rubric[*at])).collect();
    if lines.len() < 2 || !assignment.has_features_alone() {
        return;
    }
    let flow = Flow::of(&assignment.files);
    let belongs = lines.iter().map(|at| match &assignment.features[*at] {
        Some(Feature::Program(program)) => belongs(&flow, &program.replaced),
        Some(Feature::Term(_)) => {
            let judged = BTreeSet::from([flow.seen_in_main(&assignment.rubric[*at].judges)]);
            Some(Belongs { gone: judged, ..Belongs::default() })
        }
        None => Some(Belongs::default()),
    });
    let Some(belongs) = belongs.collect::<Option<Vec<Belongs>>>() else { return };
    let has_rest = lines.iter().any(|at| assignment.features[*at].is_none());
    let colour = assignment.equation.definitions[assignment.equation.colour].name.clone();
    let within = |own: &Belongs| {
        let left = own.left.difference(&own.given).cloned().collect();
        let left = flow.made_of(&left, &|_, _| false);
        flow.made_of(&own.gone, &|_, _| false).into_iter().filter(|node| !left.contains(node)).collect()
    };
    let within = belongs.iter().map(within).collect();
    let lines_of = Lines { rest: rest(&flow, &belongs, &colour), flow, belongs, within, has_rest };
    let said = lines.iter().flat_map(|at| assignment.rubric[*at].variables.iter().cloned());
    let said: BTreeSet<String> = said.collect();
    for (own, at) in lines.into_iter().enumerate() {
        let about = match &assignment.features[at] {
            Some(_) => lines_of.about(own),
            None => lines_of.rest.clone(),
        };
        let thrown = lines_of.belongs[own].throws_away.then(|| DISCARD.to_owned());
        let more = lines_of.named(about).into_iter().chain(thrown).filter(|name| !said.contains(name));
        assignment.rubric[at].variables.extend(more);
    }
}

/// The names of what is computed in a solution.
pub(super) fn computed(files: &[HandedIn]) -> BTreeSet<String> {
    Flow::of(files).computed().map(|(_, name)| name.clone()).collect()
}

/// What belongs to a feature without which these texts are replaced; `None` where that is not within a function.
fn belongs(flow: &Flow<'_>, replaced: &[[String; 2]]) -> Option<Belongs> {
    let mut belongs = Belongs::default();
    for [value, instead] in replaced {
        let start = |own: &OwnFunction<'_>| own.file.find(value.as_str()).filter(|at| own.text.body.contains(at));
        let function = flow.functions.iter().position(|own| start(own).is_some())?;
        let own = &flow.functions[function];
        let start = start(own)?;
        let is_replaced = |word: &Word| word.range.start < start + value.len() && start < word.range.end;
        let mut gone = words(value);
        for statement in &own.text.statements {
            let is_decided_by_it = deciding(&statement.under).any(is_replaced);
            let throws_away = statement.words.iter().any(|word| word.text == DISCARD && is_replaced(word));
            belongs.throws_away |= throws_away;
            if is_decided_by_it || throws_away {
                gone.extend(statement.under.iter().cloned());
            }
            for giving in given(statement) {
                let node = flow.given_by(function, &giving);
                if is_decided_by_it || giving.from.iter().any(is_replaced) {
                    belongs.given.insert(node.clone());
                }
                if !giving.from.iter().all(is_replaced) {
                    belongs.parts.insert(node);
                }
            }
        }
        let left = words(instead);
        let left: BTreeSet<&str> = names(&left).collect();
        belongs.gone.extend(names(&gone).filter(|name| !left.contains(name)).map(|name| flow.seen_in(function, name)));
        belongs.left.extend(left.iter().map(|name| flow.seen_in(function, name)));
    }
    let is_own = |node: &ScopedName| flow.is_computed(node) && !belongs.given.contains(node);
    belongs.gone.retain(is_own);
    Some(belongs)
}

/// The words that decide whether a statement is done at all. How often a loop goes round decides of no one value in it.
fn deciding(under: &[Word]) -> impl Iterator<Item = &Word> {
    let heads: BTreeSet<usize> = loop_heads(under).iter().map(|word| word.range.start).collect();
    under.iter().filter(move |word| !heads.contains(&word.range.start))
}

/// What the colour is made of without all features.
fn rest(flow: &Flow<'_>, all: &[Belongs], colour: &str) -> BTreeSet<ScopedName> {
    let is_cut =
        |to: &ScopedName, from: &ScopedName| all.iter().any(|own| own.given.contains(to) && own.gone.contains(from));
    flow.made_of(&BTreeSet::from([flow.seen_in_main(colour)]), &is_cut)
}

/// The lines of a rubric that judge the colour.
struct Lines<'t> {
    flow: Flow<'t>,
    belongs: Vec<Belongs>,
    /// For each line what is gone without its feature, and what that is made of, but for what is read all the same.
    within: Vec<BTreeSet<ScopedName>>,
    /// What the colour is made of without all features.
    rest: BTreeSet<ScopedName>,
    /// Whether a line judges that.
    has_rest: bool,
}

impl Lines<'_> {
    /// What a line with a feature is about.
    fn about(&self, line: usize) -> BTreeSet<ScopedName> {
        // What goes into the colour in other ways as well is nobody's own.
        let within = self.within[line].iter().filter(|node| self.has_rest || !self.rest.contains(node));
        let mut about: BTreeSet<ScopedName> = within.cloned().collect();
        let own = self.flow.computed().filter(|node| self.combines(node, line) || self.hands_on(node, line));
        about.extend(own.cloned());
        about.extend(self.belongs[line].given.iter().cloned());
        about
    }

    /// Whether a feature goes by the value that another one changes in a part.
    fn combines(&self, node: &ScopedName, line: usize) -> bool {
        let is_part = |own: &Belongs| own.given.contains(node) && own.parts.contains(node);
        self.belongs.iter().any(is_part) && !self.from(node).is_disjoint(&self.belongs[line].given)
    }

    /// Whether a value is made of what a feature gives, and of nothing that another one has to do with.
    fn hands_on(&self, node: &ScopedName, line: usize) -> bool {
        let from = self.from(node);
        let mut others = self.belongs.iter().enumerate().filter(|(other, _)| *other != line);
        let is_beside = |(number, other): (usize, &Belongs)| {
            !self.within[number].contains(node)
                && !other.gone.iter().chain(&other.given).any(|node| from.contains(node))
        };
        !from.is_disjoint(&self.belongs[line].given) && others.all(is_beside)
    }

    fn from(&self, node: &ScopedName) -> BTreeSet<ScopedName> {
        self.flow.made_of(&BTreeSet::from([node.clone()]), &|_, _| false)
    }

    fn named(&self, nodes: BTreeSet<ScopedName>) -> Vec<String> {
        let own = nodes.into_iter().filter(|node| self.flow.is_computed(node)).map(|(_, name)| name);
        own.collect::<BTreeSet<String>>().into_iter().collect()
    }
}
