//! The equation at all probes, with every definition computed once for whatever it depends on.
//!
//! A search tries thousands of combinations that share most of their terms, and gives most of them up after a few probes. So
//! a definition with given inputs is one column, shared by all combinations, and filled only as far as somebody asks.

use crate::Assignment;
use crate::equation::MAX_INPUTS;
use crate::expression::{Expression, Value};
use crate::probes::{Probe, ProbeSet};
use glam::DVec3;
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// Definitions as a set of bits.
pub(super) type Set = u64;

/// An expression, known to [`Columns`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Rule(u32);

/// For each definition the column that holds its values.
pub(super) type Resolved = Vec<u32>;

/// A rule and the columns of the definitions that it uses; unused places are `u32::MAX`.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Key {
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

struct Column {
    key: Key,
    values: Vec<Value>,
}

struct RuleBody<'a> {
    expression: &'a Expression,
    /// The definitions that it uses.
    uses: Vec<usize>,
    /// The same as a set.
    used: Set,
}

pub(super) struct Columns<'a> {
    assignment: &'a Assignment,
    /// The probes in the order in which they are tried.
    probes: Vec<&'a Probe>,
    uniforms: Vec<&'a [Value]>,
    rules: Vec<RuleBody<'a>>,
    rules_by_text: HashMap<&'a str, Rule>,
    columns: Vec<Column>,
    known: HashMap<Key, u32, BuildHasherDefault<Mixer>>,
    /// One value for each definition, for combinations that are not worth a column.
    scratch: Vec<Value>,
}

impl<'a> Columns<'a> {
    /// `order`: the places of the probes in the set, in the order in which they are tried.
    pub(super) fn new(assignment: &'a Assignment, probes: &'a ProbeSet, order: &[usize]) -> Self {
        let tried = || order.iter().map(|place| &probes.probes[*place]);
        let definitions = assignment.equation.definitions.len();
        Self {
            assignment,
            uniforms: tried().map(|p| probes.uniforms(p)).collect(),
            probes: tried().collect(),
            rules: Vec::new(),
            rules_by_text: HashMap::new(),
            columns: Vec::new(),
            known: HashMap::default(),
            scratch: vec![Value::Float(f64::NAN); definitions],
        }
    }

    /// Makes an expression known. The same text is the same rule.
    pub(super) fn rule(&mut self, expression: &'a Expression) -> Rule {
        *self.rules_by_text.entry(expression.text()).or_insert_with(|| {
            let equation = &self.assignment.equation;
            let slots = expression.slots().iter();
            let uses: Vec<usize> = slots.filter_map(|s| equation.definition_in(*s)).collect();
            self.rules.push(RuleBody { expression, used: uses.iter().map(|d| 1 << d).sum(), uses });
            Rule(u32::try_from(self.rules.len() - 1).unwrap_or(u32::MAX))
        })
    }

    /// The right equation.
    pub(super) fn right(&mut self) -> Resolved {
        let definitions = &self.assignment.equation.definitions;
        let mut resolved = Vec::with_capacity(definitions.len());
        for definition in definitions {
            let rule = self.rule(&definition.expression);
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
        let key = Key { rule, inputs, parameter: parameter.to_bits() };
        let next = u32::try_from(self.columns.len()).unwrap_or(u32::MAX);
        let column = *self.known.entry(key).or_insert(next);
        if column == next {
            self.columns.push(Column { key, values: Vec::new() });
        }
        column
    }

    /// The column of the vertex colour.
    pub(super) fn colour_column(&self, resolved: &Resolved) -> u32 {
        resolved[self.assignment.equation.colour]
    }

    /// The vertex colour at a probe.
    pub(super) fn colour(&mut self, column: u32, probe: usize) -> DVec3 {
        self.fill(column, probe);
        self.columns[column as usize].values[probe].vec3()
    }

    /// The vertex colour at a probe for `base` with some definitions replaced, without making columns of them.
    pub(super) fn colour_with(&mut self, base: &Resolved, replaced: &[Replaced], probe: usize) -> DVec3 {
        let equation = &self.assignment.equation;
        let mut changed: Set = 0;
        let first = replaced.first().map_or(base.len(), |r| r.definition);
        for definition in first..=equation.colour {
            let Some((rule, parameter)) = self.changed_rule(base, replaced, changed, definition) else {
                continue;
            };
            for place in 0..self.rules[rule.0 as usize].uses.len() {
                let used = self.rules[rule.0 as usize].uses[place];
                if changed & (1 << used) == 0 {
                    self.fill(base[used], probe);
                }
            }
            let sample = self.probes[probe];
            let uniforms = self.uniforms[probe];
            let expression = self.rules[rule.0 as usize].expression;
            let value = expression.evaluate(&|slot| match equation.definition_in(slot) {
                Some(d) if changed & (1 << d) != 0 => self.scratch[d].clone(),
                Some(d) => self.columns[base[d] as usize].values[probe].clone(),
                None => equation.given(slot, uniforms, &sample.attributes).unwrap_or(Value::Float(parameter)),
            });
            self.scratch[definition] = value;
            changed |= 1 << definition;
        }
        if changed & (1 << equation.colour) == 0 {
            return self.colour(self.colour_column(base), probe);
        }
        self.scratch[equation.colour].vec3()
    }

    fn fill(&mut self, column: u32, probe: usize) {
        let filled = self.columns[column as usize].values.len();
        if filled > probe {
            return;
        }
        let inputs = self.columns[column as usize].key.inputs;
        for input in inputs.into_iter().filter(|i| *i != u32::MAX) {
            self.fill(input, probe);
        }
        for at in filled..=probe {
            let value = self.compute(column, at);
            self.columns[column as usize].values.push(value);
        }
    }

    fn compute(&self, column: u32, probe: usize) -> Value {
        let key = &self.columns[column as usize].key;
        let rule = &self.rules[key.rule.0 as usize];
        let equation = &self.assignment.equation;
        let sample = self.probes[probe];
        let uniforms = self.uniforms[probe];
        rule.expression.evaluate(&|slot| match equation.definition_in(slot) {
            Some(definition) => {
                let input = rule.uses.iter().position(|d| *d == definition);
                let input = input.map_or(u32::MAX, |i| key.inputs[i]);
                self.columns[input as usize].values[probe].clone()
            }
            None => {
                let parameter = f64::from_bits(key.parameter);
                equation.given(slot, uniforms, &sample.attributes).unwrap_or(Value::Float(parameter))
            }
        })
    }
}

/// A quick hash for keys of our own making, by multiplication; no key comes from a student.
#[derive(Default)]
struct Mixer(u64);

impl Hasher for Mixer {
    fn finish(&self) -> u64 {
        self.0 ^ (self.0 >> 29)
    }

    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            self.write_u64(u64::from_le_bytes(word));
        }
    }

    fn write_u32(&mut self, n: u32) {
        self.write_u64(u64::from(n));
    }

    fn write_u64(&mut self, n: u64) {
        // 2⁶⁴ divided by the golden ratio.
        self.0 = (self.0.rotate_left(23) ^ n).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    }
}
