//! What a right answer computes: the definitions of the solution, in their order, with any of them replaced.

use crate::Value;
use crate::interpreter::{Formula, Registers, Sheet, Stage, Type};
use crate::mistake::MistakeForm;
use crate::probes::Region;
use crate::value;
use glam::{DVec3, DVec4};
use std::cell::RefCell;
use std::sync::Arc;

/// Number of definitions that one expression may use.
pub(crate) const MAX_INPUTS: usize = 8;

/// What an equation is computed from, beside the uniforms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reads {
    /// The attributes of a vertex: the solution's definitions are those of a vertex stage.
    Attributes,
    /// What the fragment stage is handed: the definitions are its own.
    Varyings,
    /// What the whole program shows: colour and position are all that is told apart.
    Outputs,
}

impl Reads {
    /// The stage whose definitions the solution consists of; `None` where it is known by what it shows.
    pub const fn stage(self) -> Option<Stage> {
        match self {
            Self::Attributes => Some(Stage::Vertex),
            Self::Varyings => Some(Stage::Fragment),
            Self::Outputs => None,
        }
    }
}

/// The colour that stands for a fragment that is thrown away: no other is below 0.
pub const DISCARDED: DVec3 = DVec3::NEG_ONE;

/// A name and what it is.
#[derive(Clone, Debug)]
pub struct Definition {
    /// Its name in the solution.
    pub name: String,
    /// Its type.
    pub kind: Type,
    /// How a right answer computes it.
    pub formula: Formula,
}

/// Constants, uniforms, vertex attributes, and what is computed from them, each in a cell of the solution's sheet.
#[derive(Clone, Debug)]
pub struct Equation {
    pub(crate) reads: Reads,
    pub(crate) sheet: Arc<Sheet>,
    /// The cells of the assignment's constants, in its order, and their values; no cell where all is read from outputs.
    pub(crate) constants: Vec<(Option<usize>, Value)>,
    /// The cells of the uniforms, in the interface's order; `None` for one that the solution does not have.
    pub(crate) uniforms: Vec<Option<usize>>,
    /// The cells of what it reads: of the vertex attributes in the interface's order, of the fragment stage's inputs in the
    /// program's, or of colour and position.
    pub(crate) attributes: Vec<Option<usize>>,
    /// The cell of the first definition; the others follow, and then what is free in a form.
    pub(crate) first: usize,
    pub(crate) definitions: Vec<Definition>,
    /// How many numbers all definitions have.
    pub(crate) numbers: usize,
    pub(crate) colour: usize,
    pub(crate) position: Option<usize>,
    /// What each output is given, by their names.
    pub(crate) outputs: Vec<(String, usize)>,
}

/// The equation with some definitions replaced.
#[derive(Clone, Debug)]
pub struct EquationVariant<'a> {
    pub(crate) equation: &'a Equation,
    pub(crate) formulas: Vec<&'a Formula>,
    /// For each definition the free parameter of what replaces it; NaN if there is none.
    pub(crate) parameters: Vec<f64>,
    /// Used again for each vertex.
    registers: RefCell<Registers>,
}

/// What a variant computes for one vertex.
#[derive(Clone, Debug)]
pub struct Evaluation<'a> {
    equation: &'a Equation,
    /// The numbers of all definitions, one after the other.
    numbers: Vec<f64>,
}

impl Equation {
    /// The definitions in the order in which they are computed.
    pub fn definitions(&self) -> &[Definition] {
        &self.definitions
    }

    /// The place of a definition in that order.
    pub fn index(&self, name: &str) -> Option<usize> {
        self.definitions.iter().position(|d| d.name == name)
    }

    /// What it is computed from.
    pub fn reads(&self) -> Reads {
        self.reads
    }

    /// The place of the definition that is the colour.
    pub fn colour(&self) -> usize {
        self.colour
    }

    /// The place of the definition that is the position in clip space; a fragment stage has none.
    pub fn position(&self) -> Option<usize> {
        self.position
    }

    /// The numbers of the colour as they are seen: a fragment's go to a target of fixed point, a vertex's to the next stage.
    pub fn seen(&self, numbers: &[f64]) -> DVec3 {
        self.clamped(value::vec3(numbers))
    }

    pub(crate) fn clamped(&self, colour: DVec3) -> DVec3 {
        if self.reads == Reads::Varyings { colour.map(|channel| channel.clamp(0.0, 1.0)) } else { colour }
    }

    /// The place of the definition that an output is given.
    pub(crate) fn output(&self, name: &str) -> Option<usize> {
        self.outputs.iter().find(|(output, _)| output == name).map(|(_, definition)| *definition)
    }

    /// Whether the value of the definition `of` depends on that of `on`, or is it.
    pub fn depends(&self, of: usize, on: usize) -> bool {
        let used = || self.used(&self.definitions[of].formula);
        of == on || used().any(|used| self.depends(used, on))
    }

    /// The definitions that a formula uses.
    pub(crate) fn used<'f>(&'f self, formula: &'f Formula) -> impl Iterator<Item = usize> + 'f {
        formula.uses().iter().filter_map(|cell| self.definition_in(*cell))
    }

    /// The cell of a definition.
    pub(crate) fn cell(&self, definition: usize) -> usize {
        self.first + definition
    }

    /// The definition in a cell, if there is one.
    pub(crate) fn definition_in(&self, cell: usize) -> Option<usize> {
        let definition = cell.checked_sub(self.first)?;
        (definition < self.definitions.len()).then_some(definition)
    }

    /// The cell of a form's free parameter.
    pub(crate) fn parameter_cell(&self) -> usize {
        self.cell(self.definitions.len())
    }

    /// Whether a formula uses no more definitions than a search keeps.
    pub(crate) fn is_few(&self, formula: &Formula) -> bool {
        self.used(formula).count() <= MAX_INPUTS
    }

    /// The names of the constants in the expression of a definition.
    pub fn constants_in(&self, definition: usize) -> Vec<&str> {
        let uses = self.definitions.get(definition).map_or(&[][..], |d| d.formula.uses());
        let constants = uses.iter().filter(|cell| self.constants.iter().any(|(constant, _)| *constant == Some(**cell)));
        constants.map(|cell| self.sheet.cells()[*cell].name.as_str()).collect()
    }

    /// Registers that hold the constants.
    pub(crate) fn registers(&self) -> Registers {
        let mut registers = self.sheet.registers();
        for (cell, value) in &self.constants {
            cell.iter().for_each(|cell| self.sheet.set(*cell, value.numbers(), &mut registers));
        }
        registers
    }

    /// The equation as it stands.
    pub fn right(&self) -> EquationVariant<'_> {
        EquationVariant {
            equation: self,
            formulas: self.definitions.iter().map(|d| &d.formula).collect(),
            parameters: vec![f64::NAN; self.definitions.len()],
            registers: RefCell::new(self.registers()),
        }
    }
}

impl<'a> EquationVariant<'a> {
    /// The same with what a form replaces, and a number for what is free in it.
    pub(crate) fn with(mut self, form: &'a MistakeForm, parameter: f64) -> Self {
        for replaced in &form.overrides {
            self.formulas[replaced.definition] = &replaced.formula;
            self.parameters[replaced.definition] = parameter;
        }
        self
    }

    /// Takes back what forms replace, and replaces what another one does.
    pub(crate) fn instead(&mut self, form: Option<&'a MistakeForm>, parameter: f64) {
        for (at, definition) in self.equation.definitions.iter().enumerate() {
            (self.formulas[at], self.parameters[at]) = (&definition.formula, f64::NAN);
        }
        for replaced in form.iter().flat_map(|form| &form.overrides) {
            (self.formulas[replaced.definition], self.parameters[replaced.definition]) = (&replaced.formula, parameter);
        }
    }

    /// Computes every definition for one sample. `uniforms` stand in the interface's order, `attributes` as [`Reads`] says.
    pub fn evaluate(&self, uniforms: &[Value], attributes: &[Value]) -> Evaluation<'a> {
        self.computed(uniforms, attributes, &[], [0.0; 3])
    }

    /// By how much the colour moves, before it is clamped, when so much is added to a definition.
    pub fn moves(&self, uniforms: &[Value], attributes: &[Value], definition: usize, by: [f64; 3]) -> DVec3 {
        self.moved(uniforms, attributes, &[definition], by)
    }

    /// The same when so much is added to each of some definitions.
    pub(crate) fn moved(&self, uniforms: &[Value], attributes: &[Value], definitions: &[usize], by: [f64; 3]) -> DVec3 {
        let colour = |moved: &[usize]| self.computed(uniforms, attributes, moved, by).vec3(self.equation.colour);
        colour(definitions) - colour(&[])
    }

    fn computed(&self, uniforms: &[Value], attributes: &[Value], moved: &[usize], by: [f64; 3]) -> Evaluation<'a> {
        let Equation { sheet, .. } = self.equation;
        let mut registers = self.registers.borrow_mut();
        let given = self.equation.uniforms.iter().zip(uniforms);
        for (cell, value) in given.chain(self.equation.attributes.iter().zip(attributes)) {
            cell.iter().for_each(|cell| sheet.set(*cell, value.numbers(), &mut registers));
        }
        let mut numbers = Vec::with_capacity(self.equation.numbers);
        for (definition, (formula, parameter)) in self.formulas.iter().zip(&self.parameters).enumerate() {
            if !parameter.is_nan() {
                sheet.set(self.equation.parameter_cell(), &[*parameter], &mut registers);
            }
            sheet.compute(formula, &mut registers);
            if moved.contains(&definition) {
                let mut own = sheet.get(formula.cell(), &registers).to_vec();
                own.iter_mut().zip(by).for_each(|(number, by)| *number += by);
                sheet.set(formula.cell(), &own, &mut registers);
            }
            numbers.extend_from_slice(sheet.get(formula.cell(), &registers));
        }
        Evaluation { equation: self.equation, numbers }
    }
}

impl EquationVariant<'_> {
    /// The first of these regions in which the vertex lies that was computed last.
    pub(crate) fn first_region(&self, regions: &[Region]) -> Option<usize> {
        let Equation { sheet, .. } = self.equation;
        let mut registers = self.registers.borrow_mut();
        regions.iter().position(|region| {
            sheet.compute(&region.when, &mut registers);
            sheet.get(region.when.cell(), &registers) == [1.0]
        })
    }
}

impl Evaluation<'_> {
    /// Value of the definition called `name`.
    pub fn get(&self, name: &str) -> Option<Value> {
        let definition = self.equation.index(name)?;
        Value::new(self.equation.definitions[definition].kind.clone(), self.numbers(definition).to_vec())
    }

    /// Three components of a definition by its place.
    pub(crate) fn vec3(&self, definition: usize) -> DVec3 {
        value::vec3(self.numbers(definition))
    }

    /// The numbers of a definition by its place.
    pub(crate) fn numbers(&self, definition: usize) -> &[f64] {
        let count = |d: &Definition| d.kind.slots().unwrap_or(0);
        let first = self.equation.definitions[..definition].iter().map(count).sum();
        &self.numbers[first..first + count(&self.equation.definitions[definition])]
    }

    /// Red, green and blue of the colour: a vertex's as it is, a fragment's clamped to [0, 1]; alpha is not seen.
    pub fn colour(&self) -> DVec3 {
        self.equation.seen(self.numbers(self.equation.colour))
    }

    /// Position in clip space; the origin's where a fragment stage is all there is.
    pub fn position(&self) -> DVec4 {
        self.equation.position.map_or(DVec4::W, |position| value::vec4(self.numbers(position)))
    }
}
