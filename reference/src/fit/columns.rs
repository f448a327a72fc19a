//! The equation at all probes, with every definition computed once for whatever it depends on.
//!
//! A search tries thousands of combinations that share most of their terms, and gives most of them up after a few probes. So
//! a definition with given inputs is one column, shared by all combinations, and filled only as far as somebody asks.

use crate::Assignment;
use crate::expression::{Expression, Value};
use crate::mistake::Form;
use crate::probes::ProbeSet;
use glam::DVec3;
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// Number of definitions that one expression may use.
const MAX_INPUTS: usize = 8;

/// An expression with its parameter, known to [`Columns`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Rule(u32);

/// For each definition the column that holds its values.
pub(super) type Resolved = Vec<u32>;

/// A rule and the columns of the definitions that it uses; unused places are `u32::MAX`.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Key {
    rule: Rule,
    inputs: [u32; MAX_INPUTS],
}

struct Column {
    key: Key,
    values: Vec<Value>,
}

struct RuleBody<'a> {
    expression: &'a Expression,
    parameter: f64,
    /// The definitions that it uses.
    uses: Vec<usize>,
}

pub(super) struct Columns<'a> {
    assignment: &'a Assignment,
    probes: &'a ProbeSet,
    rules: Vec<RuleBody<'a>>,
    columns: Vec<Column>,
    known: HashMap<Key, u32, BuildHasherDefault<Mixer>>,
}

impl<'a> Columns<'a> {
    pub(super) fn new(assignment: &'a Assignment, probes: &'a ProbeSet) -> Self {
        Self {
            assignment,
            probes,
            rules: Vec::new(),
            columns: Vec::new(),
            known: HashMap::default(),
        }
    }

    /// Makes an expression known. The same text with the same parameter is the same rule.
    pub(super) fn rule(&mut self, expression: &'a Expression, parameter: f64) -> Rule {
        let same = |r: &RuleBody| {
            r.expression.text() == expression.text() && r.parameter.to_bits() == parameter.to_bits()
        };
        let place = self.rules.iter().position(same).unwrap_or_else(|| {
            let equation = &self.assignment.equation;
            let slots = expression.slots().iter();
            let uses = slots.filter_map(|s| equation.definition_in(*s)).collect();
            self.rules.push(RuleBody {
                expression,
                parameter,
                uses,
            });
            self.rules.len() - 1
        });
        Rule(u32::try_from(place).unwrap_or(u32::MAX))
    }

    /// The right equation.
    pub(super) fn right(&mut self) -> Resolved {
        let definitions = &self.assignment.equation.definitions;
        let mut resolved = Vec::with_capacity(definitions.len());
        for definition in definitions {
            let rule = self.rule(&definition.expression, f64::NAN);
            let column = self.column(rule, &resolved);
            resolved.push(column);
        }
        resolved
    }

    /// `base` with some definitions replaced; what depends on them follows.
    pub(super) fn derive(&mut self, base: &Resolved, replaced: &[(usize, Rule)]) -> Resolved {
        let mut resolved = base.clone();
        let first = replaced.first().map_or(base.len(), |(d, _)| *d);
        for definition in first..base.len() {
            let old = self.columns[base[definition] as usize].key.rule;
            let new = replaced.iter().find(|(d, _)| *d == definition);
            let moved = |d: &usize| resolved[*d] != base[*d];
            if new.is_some() || self.rules[old.0 as usize].uses.iter().any(moved) {
                resolved[definition] = self.column(new.map_or(old, |(_, rule)| *rule), &resolved);
            }
        }
        resolved
    }

    fn column(&mut self, rule: Rule, resolved: &[u32]) -> u32 {
        let mut inputs = [u32::MAX; MAX_INPUTS];
        for (slot, definition) in inputs.iter_mut().zip(&self.rules[rule.0 as usize].uses) {
            *slot = resolved[*definition];
        }
        let key = Key { rule, inputs };
        let next = u32::try_from(self.columns.len()).unwrap_or(u32::MAX);
        let column = *self.known.entry(key).or_insert(next);
        if column == next {
            self.columns.push(Column {
                key,
                values: Vec::new(),
            });
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

    /// The vertex colour at a probe for `base` with a form in it whose parameter is still being sought.
    pub(super) fn colour_with(
        &mut self,
        base: &Resolved,
        form: &Form,
        parameter: f64,
        probe: usize,
    ) -> DVec3 {
        let equation = &self.assignment.equation;
        let mut changed: Vec<Option<Value>> = vec![None; base.len()];
        let first = form.overrides.first().map_or(base.len(), |o| o.definition);
        for definition in first..=equation.colour {
            let replaced = form.overrides.iter().find(|o| o.definition == definition);
            let rule = &self.rules[self.columns[base[definition] as usize].key.rule.0 as usize];
            if replaced.is_none() && !rule.uses.iter().any(|d| changed[*d].is_some()) {
                continue;
            }
            let expression = replaced.map_or(rule.expression, |o| &o.expression);
            let slots = expression.slots().iter();
            for used in slots.filter_map(|s| equation.definition_in(*s)) {
                if changed[used].is_none() {
                    self.fill(base[used], probe);
                }
            }
            let sample = &self.probes.probes[probe];
            let uniforms = self.probes.uniforms(sample);
            let value = expression.evaluate(&|slot| match equation.definition_in(slot) {
                Some(d) => {
                    changed[d].unwrap_or_else(|| self.columns[base[d] as usize].values[probe])
                }
                None => equation
                    .given(slot, uniforms, &sample.attributes)
                    .unwrap_or(Value::Float(parameter)),
            });
            changed[definition] = Some(value);
        }
        match changed[equation.colour] {
            Some(value) => value.vec3(),
            None => self.colour(self.colour_column(base), probe),
        }
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
        let sample = &self.probes.probes[probe];
        let uniforms = self.probes.uniforms(sample);
        rule.expression
            .evaluate(&|slot| match equation.definition_in(slot) {
                Some(definition) => {
                    let input = rule.uses.iter().position(|d| *d == definition);
                    let input = input.map_or(u32::MAX, |i| key.inputs[i]);
                    self.columns[input as usize].values[probe]
                }
                None => equation
                    .given(slot, uniforms, &sample.attributes)
                    .unwrap_or(Value::Float(rule.parameter)),
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
