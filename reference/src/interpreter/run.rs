//! Runs a compiled program for many samples at once.

mod bits;
mod indexed;
mod kernel;
mod lookup;
mod machine;
mod mask;
mod memory;
mod outputs;
mod prepared;
mod rounding;
mod single;
mod undefined;

pub(super) use kernel::{defined, scalar};
pub use memory::UndefinedCause;
pub use outputs::{Column, NotedLookup, Outputs};
pub use prepared::Prepared;
pub use rounding::Precision;
pub(super) use single::SingleSample;
pub use undefined::Undefined;
pub(super) use undefined::lanes as undefined_lanes;

use super::code::{Code, ProgramVariable, Slot};
use super::texture::Texture;
use machine::Machine;
use std::borrow::Cow;
use std::fmt;

/// Lanes that run together: enough that an instruction costs little, few enough that columns stay in the cache.
const BLOCK: usize = 256;
/// Most bytes that the columns of a block take.
const BLOCK_BYTES: usize = 64 << 20;
/// Steps of lanes that a run may take: a few seconds.
pub const FUEL: u64 = 2_000_000_000;

/// The steps are used up; the line is one of those that used them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stopped {
    /// A line of the endless loop, or 0.
    pub line: u32,
}

/// What a host gives to a run does not fit the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mismatch(String);

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// A program with its inputs.
#[derive(Debug)]
pub struct Run<'a> {
    code: &'a Code,
    samples: usize,
    uniforms: Vec<(Slot, f64)>,
    inputs: Vec<(Slot, Cow<'a, [f64]>)>,
    textures: &'a [Texture],
    precision: Precision,
    fuel: u64,
    notes_lookups: bool,
    texels: f64,
}

impl<'a> Run<'a> {
    pub(super) fn new(code: &'a Code, samples: usize) -> Self {
        Self {
            code,
            samples,
            uniforms: Vec::new(),
            inputs: Vec::new(),
            textures: &[],
            precision: Precision::Exact,
            fuel: FUEL,
            notes_lookups: false,
            texels: 1.0,
        }
    }

    /// Sets a uniform, or a part of one, by its path: `mw`, `lights[1].colour`, `Light.lamb`. Matrices are given by
    /// columns, a sampler as the number of its texture.
    ///
    /// # Errors
    /// There is no such uniform, or it has another number of scalars.
    pub fn uniform(mut self, path: &str, values: &[f64]) -> Result<Self, Mismatch> {
        let leaves: Vec<&ProgramVariable> = leaves(&self.code.uniforms, path).collect();
        let slots: Vec<Slot> = leaves.iter().flat_map(|leaf| slots(leaf)).collect();
        if slots.is_empty() {
            return Err(Mismatch(format!("there is no uniform {path}")));
        }
        if slots.len() != values.len() {
            return Err(Mismatch(format!("{path} has {} scalars, and {} are given", slots.len(), values.len())));
        }
        self.uniforms.extend(slots.into_iter().zip(values.iter().copied()));
        Ok(self)
    }

    /// Sets an input: a column of all samples for each of its scalars.
    ///
    /// # Errors
    /// There is no such input, or it has another number of scalars or samples.
    pub fn input(mut self, name: &str, columns: &[&'a [f64]]) -> Result<Self, Mismatch> {
        let input = self.code.inputs.iter().find(|input| input.name == name);
        let input = input.ok_or_else(|| Mismatch(format!("there is no input {name}")))?;
        self.columns(name, slots(input).collect(), columns.iter().copied())?;
        Ok(self)
    }

    /// Sets a uniform, or a part of one, to another value for each sample: a column for each of its scalars.
    ///
    /// # Errors
    /// As for [`Run::uniform`] and [`Run::input`].
    pub fn uniform_of_each<C: Into<Cow<'a, [f64]>>>(
        mut self,
        path: &str,
        columns: impl IntoIterator<Item = C>,
    ) -> Result<Self, Mismatch> {
        let slots: Vec<Slot> = leaves(&self.code.uniforms, path).flat_map(slots).collect();
        self.columns(path, slots, columns)?;
        Ok(self)
    }

    fn columns<C: Into<Cow<'a, [f64]>>>(
        &mut self,
        name: &str,
        slots: Vec<Slot>,
        columns: impl IntoIterator<Item = C>,
    ) -> Result<(), Mismatch> {
        let columns: Vec<Cow<'a, [f64]>> = columns.into_iter().map(C::into).collect();
        if slots.len() != columns.len() || columns.iter().any(|column| column.len() != self.samples) {
            return Err(Mismatch(format!("{name} has {} scalars of {} samples", slots.len(), self.samples)));
        }
        self.inputs.extend(slots.into_iter().zip(columns));
        Ok(())
    }

    /// Sets the textures that samplers name by their number.
    pub fn textures(self, textures: &'a [Texture]) -> Self {
        Self { textures, ..self }
    }

    /// Rounds as a driver does, and not as little as possible.
    pub fn precision(self, precision: Precision) -> Self {
        Self { precision, ..self }
    }

    /// Bounds the steps; one is one scalar operation in one lane.
    pub fn fuel(self, fuel: u64) -> Self {
        Self { fuel, ..self }
    }

    /// Notes where textures are looked up.
    pub fn noting_lookups(self) -> Self {
        Self { notes_lookups: true, ..self }
    }

    /// Multiplies what textures give with a number near 1, save what every driver holds exactly: 0 and 1.
    pub fn texels(self, texels: f64) -> Self {
        Self { texels, ..self }
    }

    /// Runs, and gives the outputs.
    ///
    /// # Errors
    /// The steps are used up.
    pub fn outputs(self) -> Result<Outputs, Stopped> {
        self.outputs_and_locals(&[])
    }

    /// Runs, and gives the outputs and what variables of `main` hold at its end.
    ///
    /// # Errors
    /// The steps are used up.
    pub fn outputs_and_locals(self, locals: &[&str]) -> Result<Outputs, Stopped> {
        let code = self.code;
        let slots = code.constants.len().max(1);
        // Whole quads, as derivatives need them.
        let block = (BLOCK_BYTES / (8 * slots)).clamp(4, BLOCK) / 4 * 4;
        let block = block.min(self.samples.max(1));
        let mut machine = Machine::new(code, self.textures, block, self.precision, self.fuel);
        machine.lookups = self.notes_lookups.then(Vec::new);
        machine.texels = self.texels;
        for &(slot, value) in code.defaults.iter().chain(&self.uniforms) {
            machine.memory.column_mut(slot).fill(value);
        }
        let column = |variable: &ProgramVariable| Column {
            name: variable.name.clone(),
            kind: variable.kind.clone(),
            values: vec![Vec::with_capacity(self.samples); variable.kind.slots().unwrap_or(0)],
            undefined: vec![Vec::new(); variable.kind.slots().unwrap_or(0)],
        };
        let outputs: Vec<&ProgramVariable> = code.outputs.iter().collect();
        let locals: Vec<&ProgramVariable> =
            locals.iter().filter_map(|name| code.locals.iter().rev().find(|local| local.name == **name)).collect();
        let mut result = Outputs {
            outputs: outputs.iter().map(|variable| column(variable)).collect(),
            locals: locals.iter().map(|variable| column(variable)).collect(),
            discarded: Vec::with_capacity(self.samples),
            lookups: Vec::new(),
        };
        for first in (0..self.samples).step_by(block) {
            let lanes = block.min(self.samples - first);
            machine.begin(lanes);
            for (slot, values) in &self.inputs {
                machine.memory.column_mut(*slot).copy_from_slice(&values[first..first + lanes]);
            }
            machine.run()?;
            outputs.iter().zip(&mut result.outputs).for_each(|(variable, column)| column.collect(&machine, variable));
            locals.iter().zip(&mut result.locals).for_each(|(variable, column)| column.collect(&machine, variable));
            let noted = machine.lookups.iter_mut().flat_map(std::mem::take);
            result.lookups.extend(noted.map(|one| NotedLookup { sample: first + one.sample, ..one }));
            result.discarded.extend((0..lanes).map(|lane| machine.discarded.has(lane)));
        }
        Ok(result)
    }
}

fn slots(variable: &ProgramVariable) -> impl Iterator<Item = Slot> + use<> {
    (variable.slot..).take(variable.kind.slots().unwrap_or(0))
}

/// The uniform with this path, or all that lie in the structure or array with this path.
fn leaves<'a>(uniforms: &'a [ProgramVariable], path: &'a str) -> impl Iterator<Item = &'a ProgramVariable> {
    let exact = uniforms.iter().any(|uniform| uniform.name == path);
    uniforms.iter().filter(move |uniform| match uniform.name.strip_prefix(path) {
        Some(rest) => rest.is_empty() || (!exact && rest.starts_with(['.', '['])),
        None => false,
    })
}
