//! The illumination equation as an ordered list of definitions.

use crate::expression::{Expression, Scope, Type, Value};
use glam::{DVec3, DVec4};

/// Definition that holds the vertex colour. The one fixed name, beside [`POSITION`].
pub const COLOUR: &str = "colour";

/// Definition that holds the position in clip space.
pub const POSITION: &str = "position";

/// Number of definitions that one expression may use.
pub(crate) const MAX_INPUTS: usize = 8;

/// A name and what it is.
#[derive(Clone, Debug)]
pub struct Definition {
    /// Its name in later definitions.
    pub name: String,
    /// What it is in a right answer.
    pub expression: Expression,
    /// The slide of the lecture that defines it.
    pub slide: Option<u32>,
    /// What the lecture calls it.
    pub symbol: Option<String>,
}

/// Constants, uniforms, vertex attributes, and what is computed from them, in slots of that order.
#[derive(Clone, Debug)]
pub struct Equation {
    pub(crate) scope: Scope,
    pub(crate) constants: Vec<Value>,
    pub(crate) uniforms: usize,
    pub(crate) attributes: usize,
    pub(crate) definitions: Vec<Definition>,
    pub(crate) colour: usize,
    pub(crate) position: usize,
}

/// The equation with some definitions replaced.
#[derive(Clone, Debug)]
pub struct Variant<'a> {
    pub(crate) equation: &'a Equation,
    pub(crate) expressions: Vec<&'a Expression>,
    /// For each definition the free parameter of what replaces it; NaN if there is none.
    pub(crate) parameters: Vec<f64>,
}

/// What a variant computes for one vertex.
#[derive(Clone, Debug)]
pub struct Outcome<'a> {
    equation: &'a Equation,
    values: Vec<Value>,
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

    /// Whether the value of the definition `of` depends on that of `on`, or is it.
    pub(crate) fn depends(&self, of: usize, on: usize) -> bool {
        let slots = self.definitions[of].expression.slots();
        of == on || slots.iter().filter_map(|slot| self.definition_in(*slot)).any(|used| self.depends(used, on))
    }

    /// The slot of a definition's value.
    pub(crate) fn slot(&self, definition: usize) -> usize {
        self.constants.len() + self.uniforms + self.attributes + definition
    }

    /// The definition whose value is in `slot`, if it is one.
    pub(crate) fn definition_in(&self, slot: usize) -> Option<usize> {
        let definition = slot.checked_sub(self.slot(0))?;
        (definition < self.definitions.len()).then_some(definition)
    }

    /// The slot of a form's free parameter.
    pub(crate) fn parameter_slot(&self) -> usize {
        self.slot(self.definitions.len())
    }

    /// The value in a slot that is not a definition's.
    pub(crate) fn given(&self, slot: usize, uniforms: &[Value], attributes: &[Value]) -> Option<Value> {
        if let Some(constant) = self.constants.get(slot) {
            return Some(constant.clone());
        }
        let slot = slot - self.constants.len();
        uniforms.get(slot).or_else(|| attributes.get(slot.checked_sub(self.uniforms)?)).cloned()
    }

    /// The names of the constants in the expression of a definition.
    pub fn constants_in(&self, definition: usize) -> Vec<&str> {
        let slots = self.definitions.get(definition).map_or(&[][..], |d| d.expression.slots());
        let constants = slots.iter().filter(|slot| **slot < self.constants.len());
        constants.filter_map(|slot| self.scope.get(*slot)).map(|(name, _)| name).collect()
    }

    /// The equation as it stands.
    pub fn right(&self) -> Variant<'_> {
        Variant {
            equation: self,
            expressions: self.definitions.iter().map(|d| &d.expression).collect(),
            parameters: vec![f64::NAN; self.definitions.len()],
        }
    }
}

impl<'a> Variant<'a> {
    /// The expression of each definition, in the equation's order.
    pub fn expressions(&self) -> &[&'a Expression] {
        &self.expressions
    }

    /// The value of the free parameter in each of them; NaN if there is none.
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// Computes every definition for one vertex. `uniforms` and `attributes` stand in the interface's order.
    pub fn evaluate(&self, uniforms: &[Value], attributes: &[Value]) -> Outcome<'a> {
        let mut values: Vec<Value> = Vec::with_capacity(self.expressions.len());
        for (expression, parameter) in self.expressions.iter().zip(&self.parameters) {
            let value = expression.evaluate(&|slot| match self.equation.definition_in(slot) {
                Some(d) => values.get(d).cloned().unwrap_or(Value::Float(f64::NAN)),
                None => self.equation.given(slot, uniforms, attributes).unwrap_or(Value::Float(*parameter)),
            });
            values.push(value);
        }
        Outcome { equation: self.equation, values }
    }
}

impl Outcome<'_> {
    /// Value of the definition called `name`.
    pub fn get(&self, name: &str) -> Option<Value> {
        self.values.get(self.equation.index(name)?).cloned()
    }

    /// Red, green and blue of the vertex colour, not clamped; alpha is not seen.
    pub fn colour(&self) -> DVec3 {
        self.values[self.equation.colour].vec3()
    }

    /// Position in clip space.
    pub fn position(&self) -> DVec4 {
        self.values[self.equation.position].vec4()
    }
}

impl Definition {
    /// The type of the definition's value.
    pub const fn kind(&self) -> Type {
        self.expression.kind()
    }
}
