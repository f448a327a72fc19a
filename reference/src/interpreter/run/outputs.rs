//! What a run computes: columns of all samples, and where textures were looked up.

use super::machine::Machine;
use super::memory::UndefinedCause;
use super::slots;
use super::undefined::Undefined;
use crate::interpreter::code::ProgramVariable;
use crate::interpreter::types::Type;

/// One output, or variable of `main`, of all samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Its type.
    pub kind: Type,
    /// Its scalars, each for all samples.
    pub values: Vec<Vec<f64>>,
    /// For each scalar of each sample, why it is undefined, if it is; nothing for a scalar that always is defined.
    pub(super) undefined: Vec<Vec<Option<UndefinedCause>>>,
}

impl Column {
    /// The scalars of one sample.
    pub fn sample(&self, sample: usize) -> Vec<f64> {
        self.values.iter().map(|values| values[sample]).collect()
    }

    /// Why a scalar of a sample is undefined, if it is.
    pub fn undefined(&self, scalar: usize, sample: usize) -> Option<UndefinedCause> {
        self.undefined[scalar].get(sample).copied().flatten()
    }

    /// Why the first sample is undefined that is, of those that are `asked` for.
    pub fn first_undefined(&self, asked: impl Fn(usize) -> bool) -> Option<UndefinedCause> {
        let causes = self.undefined.iter().flat_map(|scalar| scalar.iter().enumerate());
        let mut causes = causes.filter_map(|(sample, cause)| Some((sample, (*cause)?)));
        causes.find(|(sample, _)| asked(*sample)).map(|(_, cause)| cause)
    }

    /// Appends a block's values.
    pub(super) fn collect(&mut self, machine: &Machine<'_>, variable: &ProgramVariable) {
        for ((slot, values), undefined) in slots(variable).zip(&mut self.values).zip(&mut self.undefined) {
            let column = machine.memory.column(slot);
            let before = values.len();
            values.extend_from_slice(column);
            for (lane, value) in column.iter().enumerate() {
                let cause = match machine.strayed[lane] {
                    0 => machine.memory.cause(slot, lane),
                    strayed => strayed,
                };
                let cause = machine.memory.known(cause).or_else(|| {
                    value.is_nan().then_some(UndefinedCause { what: Undefined::NotANumber, line: variable.line })
                });
                if cause.is_some() {
                    undefined.resize(before + lane, None);
                    undefined.push(cause);
                }
            }
        }
    }
}

/// Where a sample looks a texture up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NotedLookup {
    /// The sample.
    pub sample: usize,
    /// The number of the texture.
    pub texture: usize,
    /// The place, from 0 to 1 along each side, the lower left corner first.
    pub at: [f64; 2],
    /// What the texel is compared with, where the lookup compares.
    pub reference: Option<f64>,
    /// The line that asks.
    pub line: u32,
}

/// What a run computes.
#[derive(Clone, Debug, Default)]
pub struct Outputs {
    /// All outputs of the stage.
    pub outputs: Vec<Column>,
    /// The variables of `main` that were asked for.
    pub locals: Vec<Column>,
    /// Whether a sample was thrown away by `discard`.
    pub discarded: Vec<bool>,
    /// The lookups of textures with two coordinates, in the order in which they are made, where they are noted.
    pub lookups: Vec<NotedLookup>,
}

impl Outputs {
    /// The output with this name.
    pub fn get(&self, name: &str) -> Option<&Column> {
        self.outputs.iter().find(|output| output.name == name)
    }
}
