//! Mistakes that nobody wrote down: the definitions of the solution, changed by generic operators.
//!
//! A mistake is an operator and the definition in which it acts; its forms are the places and the ways in which it does. Forms that
//! compute the same as a form before them, or as a written mistake, are left out; the plainer operators come first.

mod alike;
mod feature_text;
mod operator;
mod programs;
mod within;
mod wording;

use crate::assignment::RubricItem;
use crate::equation::{Equation, Reads};
use crate::interpreter::{DefinitionSlip, Draft, FREE, Operator};
use crate::mistake::{DefinitionOverride, FoundMistake, FreeParameter, Mistake, MistakeForm};
use crate::probes::ProbeSet;
use crate::{Assignment, Value};
use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex, OnceLock};

pub(crate) use operator::{OperatorText, operator_of, operators};
pub(crate) use programs::FIRST;
use programs::Screen;
use within::Shown;

/// What the id of a derived mistake begins with.
pub const PREFIX: &str = "derived-";

/// What stands for a definition in the id of a mistake that is in none.
const RESULT: &str = "result";

/// The seed of the probes at which forms are told apart.
const SEED: u64 = 6;

/// A homework with its derived mistakes.
#[derive(Debug)]
pub struct Derived {
    /// The homework with the derived mistakes behind the written ones.
    pub assignment: Assignment,
    /// The place of the first derived mistake.
    pub first: usize,
    /// Where forms are told apart: some vertices or fragments.
    places: Vec<(Vec<Value>, Vec<Value>)>,
    /// The terms that the colour is a sum of: definitions that lines of the rubric judge, as bits.
    pub(crate) terms: u64,
    /// What the programs show at some probes.
    screen: OnceLock<Screen>,
    judging: OnceLock<ProbeSet>,
    /// The lines within whose features mistakes are that were asked for.
    within: Mutex<HashMap<(String, usize, Shown), Vec<usize>>>,
}

impl Derived {
    /// Those of a homework; none of one whose solution is no list of definitions.
    pub(crate) fn of(assignment: &Assignment) -> Self {
        let first = assignment.mistakes.len();
        let mut derived = Self {
            assignment: Assignment { derived: Arc::default(), ..assignment.clone() },
            first,
            places: Vec::new(),
            terms: 0,
            screen: OnceLock::new(),
            judging: OnceLock::new(),
            within: Mutex::default(),
        };
        let programs = programs::mistakes(assignment);
        if assignment.equation.reads() == Reads::Outputs {
            programs::add(&mut derived.assignment.mistakes, first, programs);
            return derived;
        }
        derived.places = places(&assignment.fresh_probes(SEED));
        if let Some((slips, equation)) = slips(assignment) {
            derived.assignment.equation = equation;
            derived.assignment.mistakes.extend(mistakes(assignment, slips));
            derived.leave_out_alike();
            derived.terms = derived.summed();
        }
        programs::add(&mut derived.assignment.mistakes, first, programs);
        derived
    }

    /// The same with the student's own constants, see [`Assignment::with_constants`].
    pub(crate) fn with_constants(&self, changed: &[(&str, Value)]) -> Option<Self> {
        let assignment = self.assignment.with_constants(changed).ok()?;
        let (places, first, terms) = (self.places.clone(), self.first, self.terms);
        let (screen, judging, within) = Default::default();
        Some(Self { assignment, first, places, terms, screen, judging, within })
    }

    /// The derived mistakes.
    pub fn mistakes(&self) -> &[Mistake] {
        &self.assignment.mistakes[self.first..]
    }

    /// Whether a mistake is one of those that are made often enough to be made beside another one.
    pub(crate) fn is_usual(&self, mistake: usize) -> bool {
        let said =
            |said: &&OperatorText| self.assignment.mistakes[mistake].id.starts_with(&format!("{PREFIX}{}-", said.id));
        operators().iter().find(said).is_none_or(|said| !said.rare)
    }

    /// Whether what a line judges is another with the mistake in it, or is used in another way.
    pub(crate) fn touches(&self, found: &FoundMistake, line: &RubricItem) -> bool {
        let assignment = &self.assignment;
        let shown = if assignment.judges_position(line) { Shown::Position } else { Shown::Colour };
        let within = self.lines_of(found, shown);
        if !within.is_empty() {
            return within.iter().any(|own| assignment.rubric[*own].id == line.id);
        }
        let form = assignment.mistake(&found.id).and_then(|mistake| mistake.forms.get(found.form));
        if form.is_none() {
            return self.program_touches(found, line);
        }
        let about = self.lines_about(found);
        if !(about.is_empty() || assignment.judges_position(line)) {
            return about.contains(&line.id.as_str());
        }
        let touched = |changes: fn(&Self, &FoundMistake, &RubricItem) -> bool| {
            let is_touched = |line: &RubricItem| changes(self, found, line);
            assignment.rubric.iter().any(is_touched).then(|| is_touched(line))
        };
        // What is another value by itself makes all the difference: terms behind a wrong factor are right. What concerns no
        // line, such as a number that is added to the sum, is in all of them.
        let touched = touched(Self::changes).or_else(|| touched(Self::uses_otherwise));
        touched.unwrap_or_else(|| !assignment.judges_position(line))
    }

    /// Whether what a line judges is another.
    fn changes(&self, found: &FoundMistake, line: &RubricItem) -> bool {
        let equation = &self.assignment.equation;
        let Some(judged) = equation.index(&line.judges) else { return true };
        if self.assignment.is_beside_terms(line) {
            return false;
        }
        let Some(wrong) = self.assignment.variant(std::slice::from_ref(found)) else { return true };
        let right = equation.right();
        self.places.iter().any(|(uniforms, attributes)| {
            let [ours, theirs] = [&right, &wrong].map(|variant| variant.evaluate(uniforms, attributes));
            let mut pairs = ours.numbers(judged).iter().zip(theirs.numbers(judged));
            pairs.any(|(a, b)| differs(*a, *b))
        })
    }

    /// Whether the colour moves otherwise with what a line judges.
    fn uses_otherwise(&self, found: &FoundMistake, line: &RubricItem) -> bool {
        /// In a colour beyond this nothing is left of what moves it.
        const LARGE: f64 = 1e3;
        let equation = &self.assignment.equation;
        let Some(judged) = equation.index(&line.judges) else { return true };
        let Some(wrong) = self.assignment.variant(std::slice::from_ref(found)) else { return true };
        let right = equation.right();
        let is_large = |value: &f64| value.is_nan() || value.abs() > LARGE;
        let is_term = judged != equation.colour && equation.depends(equation.colour, judged);
        is_term
            && self.places.iter().any(|(uniforms, attributes)| {
                let colour = wrong.evaluate(uniforms, attributes);
                let [ours, theirs] =
                    [&right, &wrong].map(|variant| variant.moves(uniforms, attributes, judged, [0.31, 0.37, 0.41]));
                !colour.numbers(equation.colour).iter().any(is_large)
                    && (0..3).any(|channel| differs(ours[channel], theirs[channel]))
            })
    }
}

/// Whether two numbers differ by far more than computing in another order makes.
fn differs(a: f64, b: f64) -> bool {
    const RELATIVE: f64 = 1e-7;
    (a - b).abs() > RELATIVE * a.abs().max(b.abs()).max(1e-3) || a.is_nan() != b.is_nan()
}

impl Assignment {
    /// What is said of a mistake, and what it costs, where it is known by what makes the text right: the operator that a student
    /// slipped by, and the definition that it is in, where it is one, or the variable that a line is about. `is_bound_by_zero`: a bound of 0 is concerned.
    pub fn repaired(&self, operator: Operator, definition: Option<&str>, is_bound_by_zero: bool) -> Mistake {
        let is_known = |name: &&str| self.equation.index(name).is_some() || self.is_told_apart(name);
        wording::of_repair(self, operator, definition.filter(is_known), is_bound_by_zero)
    }

    /// The homework with its derived mistakes. They are made when they are first asked for.
    pub fn derived(&self) -> &Derived {
        self.derived.get_or_init(|| Derived::of(self))
    }
}

/// Whether a mistake is a derived one.
pub fn is_derived(id: &str) -> bool {
    id.starts_with(PREFIX)
}

/// What derived mistakes cost, by their operators: what their ids begin with, what they are, and the fraction of a line's points
/// that is kept.
pub fn costs() -> impl Iterator<Item = (String, &'static crate::Text, f64)> {
    operators().iter().map(|said| (format!("{PREFIX}{}", said.id), &said.title, said.keeps))
}

/// What a derived mistake is called, by its id: a repair may name one that no change of the solution makes.
pub(crate) fn title(assignment: &Assignment, id: &str) -> Option<crate::Text> {
    read(id).map(|(said, name)| wording::title(assignment, said, name))
}

/// The definition that a derived mistake is in, by its id.
pub fn definition(id: &str) -> Option<&str> {
    read(id).map(|(_, name)| name)
}

/// The operator and the definition in an id.
fn read(id: &str) -> Option<(&'static OperatorText, &str)> {
    let rest = id.strip_prefix(PREFIX)?;
    let known = operators().iter().filter_map(|said| Some((said, rest.strip_prefix(&*said.id)?.strip_prefix('-')?)));
    known.max_by_key(|(said, _)| said.id.len())
}

fn places(probes: &ProbeSet) -> Vec<(Vec<Value>, Vec<Value>)> {
    probes.iter().map(|probe| (probes.uniforms(probe).to_vec(), probe.attributes.clone())).collect()
}

/// What stands in a text that takes other components than the solution: one of them by itself, or several in another order. A
/// constant may equal them by chance.
fn components(forms: &[MistakeForm]) -> Vec<String> {
    const SINGLE: [&str; 16] =
        [".x", ".y", ".z", ".w", ".r", ".g", ".b", ".a", ".s", ".t", ".p", ".q", "[0]", "[1]", "[2]", "[3]"];
    const SEVERAL: [&str; 5] = [".xzy", ".yxz", ".zyx", ".yzx", ".zxy"];
    let takes = |taken: &&str| forms.iter().any(|form| form.overrides.iter().any(|own| own.text.contains(taken)));
    if !SEVERAL.iter().any(takes) {
        return SINGLE.map(str::to_owned).into();
    }
    let with = |names: &str| {
        let letter = |c: char| "xyz".find(c).and_then(|at| names.chars().nth(at)).unwrap_or(c);
        SEVERAL.map(|taken| taken.chars().map(letter).collect::<String>())
    };
    // Or one after the other.
    let listed = SINGLE.iter().map(|one| format!("{one},"));
    ["xyz", "rgb", "stp"].iter().flat_map(|names| with(names)).chain(listed).collect()
}

/// The slips of every definition that the colour depends on, and the equation in whose registers they are computed.
fn slips(assignment: &Assignment) -> Option<(Vec<(usize, DefinitionSlip)>, Equation)> {
    let file = assignment.files.first()?;
    let constants: Vec<&str> = assignment.constants.iter().map(|constant| constant.name.as_str()).collect();
    let mut draft = Draft::read(&file.solution.text, file.stage, &constants).ok()?;
    let equation = &assignment.equation;
    draft.beyond(&equation.sheet).ok()?;
    let mut slips = Vec::new();
    for definition in (0..equation.definitions.len()).filter(|d| equation.depends(equation.colour, *d)) {
        let own = draft.slips(definition).into_iter().filter(|slip| equation.is_few(&slip.formula));
        slips.extend(own.map(|slip| (definition, slip)));
    }
    let beyond = draft.finish(Arc::clone(&assignment.textures)).ok()?;
    let sheet = Arc::new(equation.sheet.with(&beyond));
    Some((slips, Equation { sheet, ..equation.clone() }))
}

/// One mistake for each operator and definition, the plainer operators and the later definitions first.
fn mistakes(assignment: &Assignment, slips: Vec<(usize, DefinitionSlip)>) -> Vec<Mistake> {
    let mut grouped: BTreeMap<(Operator, usize), Vec<DefinitionSlip>> = BTreeMap::new();
    let last = assignment.equation.definitions.len();
    for (definition, slip) in slips {
        // What is the same everywhere is added to what is computed first: there it changes nothing else.
        let is_judged =
            assignment.rubric.iter().any(|line| assignment.equation.index(&line.judges) == Some(definition));
        let place = match slip.operator {
            Operator::Shifted if is_judged => definition,
            Operator::Shifted => last + definition,
            _ => last - definition,
        };
        grouped.entry((slip.operator, place)).or_default().push(slip);
    }
    let mistake = |((operator, place), slips): ((Operator, usize), Vec<DefinitionSlip>)| {
        let definition = if operator == Operator::Shifted { place % last } else { last - place };
        let mut mistake = wording::mistake(assignment, operator, definition, &slips);
        mistake.forms = slips.into_iter().map(|slip| form(definition, slip)).collect();
        mistake.fit = free_number(operator);
        if operator == Operator::OtherComponents {
            mistake.needs = components(&mistake.forms);
        }
        mistake
    };
    grouped.into_iter().map(mistake).collect()
}

fn form(definition: usize, slip: DefinitionSlip) -> MistakeForm {
    let DefinitionSlip { text, is_free, formula, .. } = slip;
    MistakeForm { overrides: vec![DefinitionOverride { definition, text, formula }], free: is_free }
}

/// What a number that is free in an operator's forms may be.
fn free_number(operator: Operator) -> Option<FreeParameter> {
    let (from, to, turns) = match operator {
        Operator::OtherNumber => (1e-3, 1e3, true),
        Operator::Scaled => (1e-2, 1e2, false),
        Operator::Raising => (0.1, 300.0, false),
        Operator::Shifted => (1e-3, 10.0, true),
        _ => return None,
    };
    Some(FreeParameter { name: FREE.into(), from, to, example: 1.0, turns, of: None })
}
