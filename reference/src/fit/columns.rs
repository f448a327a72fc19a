//! The equation at all probes, with every definition computed once for whatever it depends on.
//!
//! A search tries thousands of combinations that share most of their terms, and gives most of them up after a few probes. So
//! a definition with given inputs is one column, shared by all combinations, and filled only as far as somebody asks.

mod mixer;

use crate::equation::{Equation, MAX_INPUTS};
use crate::interpreter::{Formula, Registers};
use crate::probes::{Probe, ProbeSet};
use crate::{Assignment, Value, value};
use glam::DVec3;
use mixer::Mixer;
use std::collections::HashMap;
use std::hash::BuildHasherDefault;

/// Definitions as a set of bits.
pub(super) type Set = u64;

/// A formula, known to [`RuleColumns`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Rule(u32);

/// For each definition the column that holds its values.
pub(super) type Resolved = Vec<u32>;

/// A rule and the columns of the definitions that it uses; unused places are `u32::MAX`.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct RuleKey {
    rule: Rule,
    inputs: [u32; MAX_INPUTS],
    /// The bits of its free parameter.
    parameter: u64,
}

/// A definition that is replaced, by what, and the value of what is free in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Replaced {
    pub definition: usize,
    pub rule: Rule,
    pub parameter: f64,
}

struct RuleColumn {
    key: RuleKey,
    /// The numbers of all probes that are computed, one probe after the other.
    numbers: Vec<f64>,
    /// How many are one probe's.
    width: usize,
}

impl RuleColumn {
    fn has(&self, probe: usize) -> bool {
        self.numbers.len() > probe * self.width
    }

    fn at(&self, probe: usize) -> &[f64] {
        &self.numbers[probe * self.width..(probe + 1) * self.width]
    }
}

struct RuleBody<'a> {
    formula: &'a Formula,
    /// The definitions that it uses.
    uses: Vec<usize>,
    /// The same as a set.
    used: Set,
    /// The uniforms and the attributes that it uses, with their cells.
    uniforms: Vec<(usize, usize)>,
    attributes: Vec<(usize, usize)>,
    /// The cell that it computes, and the cell of the number that is free in it.
    cell: usize,
    free: Option<usize>,
    /// What it takes to compute it.
    cost: u64,
}

pub(super) struct RuleColumns<'a> {
    equation: &'a Equation,
    /// The probes in the order in which they are tried.
    probes: Vec<&'a Probe>,
    uniforms: Vec<&'a [Value]>,
    rules: Vec<RuleBody<'a>>,
    columns: Vec<RuleColumn>,
    known: HashMap<RuleKey, u32, BuildHasherDefault<Mixer>>,
    /// Where columns are computed.
    registers: Registers,
    /// Where combinations are computed that are not worth a column.
    scratch: Registers,
    /// How many steps of formulas were computed, and those that begin one: what a search costs, on any machine and with any equation.
    pub work: u64,
}

/// To begin a formula costs as much as so many of its steps.
const BEGINNING: u64 = 4;

impl<'a> RuleColumns<'a> {
    /// `order`: the places of the probes in the set, in the order in which they are tried.
    pub(super) fn new(assignment: &'a Assignment, probes: &'a ProbeSet, order: &[usize]) -> Self {
        let tried = || order.iter().map(|place| &probes.probes[*place]);
        let equation = &assignment.equation;
        Self {
            equation,
            uniforms: tried().map(|p| probes.uniforms(p)).collect(),
            probes: tried().collect(),
            rules: Vec::new(),
            columns: Vec::new(),
            known: HashMap::default(),
            registers: equation.registers(),
            scratch: equation.registers(),
            work: 0,
        }
    }

    /// Makes a formula known.
    pub(super) fn rule(&mut self, formula: &'a Formula) -> Rule {
        let equation = self.equation;
        let uses: Vec<usize> = equation.used(formula).collect();
        let given = |cells: &[Option<usize>]| {
            let all = cells.iter().enumerate().filter_map(|(place, cell)| Some((place, (*cell)?)));
            all.filter(|(_, cell)| formula.uses().contains(cell)).collect()
        };
        self.rules.push(RuleBody {
            formula,
            used: uses.iter().map(|d| 1 << d).sum(),
            uses,
            uniforms: given(&equation.uniforms),
            attributes: given(&equation.attributes),
            cell: formula.cell(),
            cost: BEGINNING + formula.steps() as u64,
            free: Some(equation.parameter_cell()).filter(|cell| formula.uses().contains(cell)),
        });
        Rule(u32::try_from(self.rules.len() - 1).unwrap_or(u32::MAX))
    }

    /// The right equation.
    pub(super) fn right(&mut self) -> Resolved {
        let mut resolved = Vec::with_capacity(self.equation.definitions.len());
        for definition in &self.equation.definitions {
            let rule = self.rule(&definition.formula);
            let column = self.column(rule, f64::NAN, &resolved);
            resolved.push(column);
        }
        resolved
    }

    /// `base` with some definitions replaced; what depends on them follows.
    pub(super) fn derive(&mut self, base: &Resolved, replaced: &[Replaced]) -> Resolved {
        let mut resolved = base.clone();
        let mut changed: Set = 0;
        let first = replaced.first().map_or(base.len(), |r| r.definition);
        for definition in first..base.len() {
            if let Some((rule, parameter)) = self.changed_rule(base, replaced, changed, definition) {
                resolved[definition] = self.column(rule, parameter, &resolved);
                changed |= 1 << definition;
            }
        }
        resolved
    }

    /// The rule of a definition, if it is replaced or uses one of the `changed` ones.
    fn changed_rule(
        &self,
        base: &Resolved,
        replaced: &[Replaced],
        changed: Set,
        definition: usize,
    ) -> Option<(Rule, f64)> {
        if let Some(replaced) = replaced.iter().find(|r| r.definition == definition) {
            return Some((replaced.rule, replaced.parameter));
        }
        let key = &self.columns[base[definition] as usize].key;
        (self.rules[key.rule.0 as usize].used & changed != 0).then(|| (key.rule, f64::from_bits(key.parameter)))
    }

    fn column(&mut self, rule: Rule, parameter: f64, resolved: &[u32]) -> u32 {
        let mut inputs = [u32::MAX; MAX_INPUTS];
        for (slot, definition) in inputs.iter_mut().zip(&self.rules[rule.0 as usize].uses) {
            *slot = resolved[*definition];
        }
        let key = RuleKey { rule, inputs, parameter: parameter.to_bits() };
        let next = u32::try_from(self.columns.len()).unwrap_or(u32::MAX);
        let column = *self.known.entry(key).or_insert(next);
        if column == next {
            let definition = self.rules[rule.0 as usize].formula.cell() - self.equation.first;
            let width = self.equation.definitions[definition].kind.slots().unwrap_or(1);
            self.columns.push(RuleColumn { key, numbers: Vec::new(), width });
        }
        column
    }

    /// The column of the vertex colour.
    pub(super) fn colour_column(&self, resolved: &Resolved) -> u32 {
        resolved[self.equation.colour]
    }

    /// The vertex colour at a probe.
    pub(super) fn colour(&mut self, column: u32, probe: usize) -> DVec3 {
        self.fill(column, probe);
        self.equation.seen(self.columns[column as usize].at(probe))
    }

    /// The vertex colour at a probe for `base` with some definitions replaced, without making columns of them.
    pub(super) fn colour_with(&mut self, base: &Resolved, replaced: &[Replaced], probe: usize) -> DVec3 {
        let numbers = self.unclamped_with(base, replaced, probe);
        self.equation.clamped(numbers)
    }

    /// The same as the stage writes it.
    pub(super) fn unclamped_with(&mut self, base: &Resolved, replaced: &[Replaced], probe: usize) -> DVec3 {
        let Equation { sheet, colour, first, .. } = self.equation;
        let mut changed: Set = 0;
        let from = replaced.first().map_or(base.len(), |r| r.definition);
        for definition in from..=*colour {
            let Some((rule, parameter)) = self.changed_rule(base, replaced, changed, definition) else {
                continue;
            };
            let mut unchanged = self.rules[rule.0 as usize].used & !changed;
            while unchanged != 0 {
                let used = unchanged.trailing_zeros() as usize;
                unchanged &= unchanged - 1;
                self.fill(base[used], probe);
                let numbers = self.columns[base[used] as usize].at(probe);
                sheet.set(first + used, numbers, &mut self.scratch);
            }
            let rule = &self.rules[rule.0 as usize];
            rule.give(
                self.equation,
                self.uniforms[probe],
                &self.probes[probe].attributes,
                parameter,
                &mut self.scratch,
            );
            self.work += rule.cost;
            sheet.compute(rule.formula, &mut self.scratch);
            changed |= 1 << definition;
        }
        if changed & (1 << *colour) == 0 {
            let column = self.colour_column(base);
            self.fill(column, probe);
            return value::vec3(self.columns[column as usize].at(probe));
        }
        value::vec3(sheet.get(first + colour, &self.scratch))
    }

    fn fill(&mut self, column: u32, probe: usize) {
        if self.columns[column as usize].has(probe) {
            return;
        }
        let inputs = self.columns[column as usize].key.inputs;
        for input in inputs.into_iter().filter(|i| *i != u32::MAX) {
            self.fill(input, probe);
        }
        let RuleColumn { numbers, width, .. } = &self.columns[column as usize];
        for at in numbers.len() / width..=probe {
            self.compute(column, at);
        }
    }

    fn compute(&mut self, column: u32, probe: usize) {
        let RuleKey { rule, inputs, parameter } = self.columns[column as usize].key;
        let rule = &self.rules[rule.0 as usize];
        let Equation { sheet, first, .. } = self.equation;
        let registers = &mut self.registers;
        for (used, input) in rule.uses.iter().zip(inputs) {
            sheet.set(first + used, self.columns[input as usize].at(probe), registers);
        }
        let parameter = f64::from_bits(parameter);
        rule.give(self.equation, self.uniforms[probe], &self.probes[probe].attributes, parameter, registers);
        self.work += rule.cost;
        sheet.compute(rule.formula, registers);
        self.columns[column as usize].numbers.extend_from_slice(sheet.get(rule.cell, registers));
    }
}

impl RuleBody<'_> {
    /// Gives the formula what it uses beside definitions.
    fn give(
        &self,
        equation: &Equation,
        uniforms: &[Value],
        attributes: &[Value],
        parameter: f64,
        registers: &mut Registers,
    ) {
        for (place, cell) in &self.uniforms {
            equation.sheet.set(*cell, uniforms[*place].numbers(), registers);
        }
        for (place, cell) in &self.attributes {
            equation.sheet.set(*cell, attributes[*place].numbers(), registers);
        }
        if let Some(cell) = self.free {
            equation.sheet.set(cell, &[parameter], registers);
        }
    }
}
