//! What a right answer computes: the definitions of the solution, in their order, with any of them replaced.

use crate::Value;
use crate::interpreter::{Formula, Registers, Sheet, Type};
use crate::probes::Region;
use crate::value;
use glam::{DVec3, DVec4};
use std::cell::RefCell;
use std::sync::Arc;

/// Number of definitions that one expression may use.
pub(crate) const MAX_INPUTS: usize = 8;

/// A name and what it is.
#[derive(Clone, Debug)]
pub struct Definition {
    /// Its name in the solution.
    pub name: String,
    /// Its type.
    pub kind: Type,
    /// How a right answer computes it.
    pub formula: Formula,
    /// The slide of the lecture that defines it.
    pub slide: Option<u32>,
    /// What the lecture calls it.
    pub symbol: Option<String>,
}

/// Constants, uniforms, vertex attributes, and what is computed from them, each in a cell of the solution's sheet.
#[derive(Clone, Debug)]
pub struct Equation {
    pub(crate) sheet: Arc<Sheet>,
    /// The cells of the assignment's constants, in its order, and their values.
    pub(crate) constants: Vec<(usize, Value)>,
    /// The cells of the uniforms, in the interface's order; none of one that the solution does not have.
    pub(crate) uniforms: Vec<Option<usize>>,
    /// Those of the vertex attributes.
    pub(crate) attributes: Vec<Option<usize>>,
    /// The cell of the first definition; the others follow, and then what is free in a form.
    pub(crate) first: usize,
    pub(crate) definitions: Vec<Definition>,
    /// How many numbers all definitions have.
    pub(crate) numbers: usize,
    pub(crate) colour: usize,
    pub(crate) position: usize,
    /// What each output is given, by their names.
    pub(crate) outputs: Vec<(String, usize)>,
}

/// The equation with some definitions replaced.
#[derive(Clone, Debug)]
pub struct Variant<'a> {
    pub(crate) equation: &'a Equation,
    pub(crate) formulas: Vec<&'a Formula>,
    /// For each definition the free parameter of what replaces it; NaN if there is none.
    pub(crate) parameters: Vec<f64>,
    /// Used again for each vertex.
    registers: RefCell<Registers>,
}

/// What a variant computes for one vertex.
#[derive(Clone, Debug)]
pub struct Outcome<'a> {
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

    /// The place of the definition that is the vertex colour.
    pub fn colour(&self) -> usize {
        self.colour
    }

    /// The place of the definition that is the position in clip space.
    pub fn position(&self) -> usize {
        self.position
    }

    /// The place of the definition that an output is given.
    pub(crate) fn output(&self, name: &str) -> Option<usize> {
        self.outputs.iter().find(|(output, _)| output == name).map(|(_, definition)| *definition)
    }

    /// Whether the value of the definition `of` depends on that of `on`, or is it.
    pub(crate) fn depends(&self, of: usize, on: usize) -> bool {
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

    /// The names of the constants in the expression of a definition.
    pub fn constants_in(&self, definition: usize) -> Vec<&str> {
        let uses = self.definitions.get(definition).map_or(&[][..], |d| d.formula.uses());
        let constants = uses.iter().filter(|cell| self.constants.iter().any(|(constant, _)| constant == *cell));
        constants.map(|cell| self.sheet.cells()[*cell].name.as_str()).collect()
    }

    /// Registers that hold the constants.
    pub(crate) fn registers(&self) -> Registers {
        let mut registers = self.sheet.registers();
        for (cell, value) in &self.constants {
            self.sheet.set(*cell, value.numbers(), &mut registers);
        }
        registers
    }

    /// The equation as it stands.
    pub fn right(&self) -> Variant<'_> {
        Variant {
            equation: self,
            formulas: self.definitions.iter().map(|d| &d.formula).collect(),
            parameters: vec![f64::NAN; self.definitions.len()],
            registers: RefCell::new(self.registers()),
        }
    }
}

impl<'a> Variant<'a> {
    /// Computes every definition for one vertex. `uniforms` and `attributes` stand in the interface's order.
    pub fn evaluate(&self, uniforms: &[Value], attributes: &[Value]) -> Outcome<'a> {
        let Equation { sheet, .. } = self.equation;
        let mut registers = self.registers.borrow_mut();
        let given = self.equation.uniforms.iter().zip(uniforms);
        for (cell, value) in given.chain(self.equation.attributes.iter().zip(attributes)) {
            cell.iter().for_each(|cell| sheet.set(*cell, value.numbers(), &mut registers));
        }
        let mut numbers = Vec::with_capacity(self.equation.numbers);
        for (formula, parameter) in self.formulas.iter().zip(&self.parameters) {
            if !parameter.is_nan() {
                sheet.set(self.equation.parameter_cell(), &[*parameter], &mut registers);
            }
            sheet.compute(formula, &mut registers);
            numbers.extend_from_slice(sheet.get(formula.cell(), &registers));
        }
        Outcome { equation: self.equation, numbers }
    }
}

impl Variant<'_> {
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

impl Outcome<'_> {
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

    /// Red, green and blue of the vertex colour, not clamped; alpha is not seen.
    pub fn colour(&self) -> DVec3 {
        self.vec3(self.equation.colour)
    }

    /// Position in clip space.
    pub fn position(&self) -> DVec4 {
        value::vec4(self.numbers(self.equation.position))
    }
}
