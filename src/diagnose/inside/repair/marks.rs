//! What comes of a change, and what stands where it is made.

use crate::diagnose::columns::is_constant;
use crate::diagnose::inside::around::ReachedValue;
use crate::diagnose::inside::variable;
use reference::interpreter::trace::{Event, Site, Trace, What};
use reference::interpreter::{Binary, Operator, Program, ProgramRepair, Scalar};

/// Whether another value is the wrong one in what is made of it.
pub(super) fn is_of_use(mistake: Operator) -> bool {
    matches!(mistake, Operator::OtherValue | Operator::OtherMatrix | Operator::OtherComponents | Operator::OtherNumber)
}

/// The variable that is given what was changed; of what is read, the one that it is read for.
pub(super) fn made_for(sites: &[Site], site: usize) -> Option<String> {
    if !matches!(sites[site].what, What::Read(_)) {
        return variable(sites, site);
    }
    let mut own = site;
    // Operands stand before what is made of them.
    while let Some(user) = (own + 1..sites.len()).find(|user| sites[*user].operands.contains(&own)) {
        if let What::Assign { name, .. } = &sites[user].what {
            return Some(name.clone());
        }
        own = user;
    }
    None
}

/// Whether a whole number is given to a variable, or compared.
pub(super) fn is_count(sites: &[Site], site: usize) -> bool {
    let is_whole = matches!(sites[site].kind.scalar(), Some(Scalar::Int | Scalar::Uint));
    let counts = |what: &What| match what {
        What::Assign { .. } => true,
        What::Binary(operator) => {
            matches!(operator, Binary::Less | Binary::LessEqual | Binary::Greater | Binary::GreaterEqual)
        }
        _ => false,
    };
    is_whole && sites.iter().any(|user| user.operands.contains(&site) && counts(&user.what))
}

/// Whether a value is what was changed.
pub(super) fn is_marked(program: &Program, event: &Event) -> bool {
    program.sites()[event.site].line == ProgramRepair::MARK
}

/// Whether each value is what was changed, or is computed from it.
pub(super) fn computed_from_the_mark(program: &Program, trace: &Trace) -> Vec<bool> {
    let mut is_computed: Vec<bool> = trace.events.iter().map(|event| is_marked(program, event)).collect();
    for (number, event) in trace.events.iter().enumerate() {
        is_computed[number] |= event.from.iter().any(|from| is_computed[*from]);
    }
    is_computed
}

/// What was changed, and what is computed from it or decided by it, in this order; none that is the same everywhere. Another value is
/// the wrong one in what is made of it.
pub(super) fn reached_values<'t>(program: &Program, trace: &'t Trace, mistake: Operator) -> Vec<ReachedValue<'t>> {
    let is_marked = |event: &Event| is_marked(program, event);
    let is_computed = computed_from_the_mark(program, trace);
    let mut is_reached: Vec<bool> = trace.events.iter().map(is_marked).collect();
    for (number, event) in trace.events.iter().enumerate() {
        is_reached[number] |= event.from.iter().chain(&event.under).any(|from| is_reached[*from]);
    }
    let last = trace.events.iter().rposition(is_marked).unwrap_or(trace.events.len());
    let first = last + usize::from(is_of_use(mistake));
    let reached = trace.events.iter().enumerate().skip(first);
    let reached = reached.filter(|(number, event)| is_reached[*number] && !is_constant(&event.values));
    reached.map(|(number, event)| ReachedValue { values: &event.values, is_made_there: is_computed[number] }).collect()
}

/// Whether a number goes that something is multiplied by, or that is added to it.
pub(super) fn is_number_too_many(repair: &ProgramRepair) -> bool {
    let [before, after] = &repair.texts;
    let is_number = |word: &str| word.starts_with(|c: char| c.is_ascii_digit() || c == '.');
    let mut gone = before.split(|c: char| !(c.is_ascii_alphanumeric() || "_.".contains(c)));
    matches!(repair.mistake, Operator::Scaled | Operator::Shifted)
        && gone.all(|word| word.is_empty() || after.contains(word) || is_number(word))
}
