//! Definitions: a program whose `main` only gives names to values, each of which can be computed by itself.
//!
//! Such a program is a sheet of cells. A definition's cell has a formula, and any other expression of its type can be put
//! in its place; what depends on it is computed anew, and nothing else. One sample is computed at a time, in registers that
//! are used again: what has to be computed thousands of times costs a few nanoseconds for each operation.
//!
//! What GLSL leaves undefined is not a number here, and so is all that is computed from it. What is too large for a float
//! stays the number that it is.
//!
//! ```
//! use reference::interpreter::{Draft, Stage};
//! let text = "const float k = 3.0; in float x; out float y; void main() { float a = k * x; float b = a + 1.0; y = b; }";
//! let mut draft = Draft::read(text, Stage::Vertex, &["k"]).unwrap();
//! let cell = |name: &str| draft.cells().iter().position(|cell| cell.name == name).unwrap();
//! let (x, a, b) = (cell("x"), cell("a"), cell("b"));
//! let other = draft.replacement(b, "a * a", None).unwrap();
//! let sheet = draft.finish([].into()).unwrap();
//! let mut registers = sheet.registers();
//! sheet.set(x, &[2.0], &mut registers);
//! sheet.compute(&sheet.formulas()[0], &mut registers);
//! sheet.compute(&other, &mut registers);
//! assert_eq!(other.uses(), [a]);
//! assert_eq!(sheet.get(b, &registers), [36.0]);
//! ```

mod access;
mod straight;

use super::code::{Node, Slot};
use super::run::SingleSample;
use super::texture::Texture;
use super::types::Type;
use crate::text::{Text, both};
use std::ops::Range;
use std::sync::Arc;
use straight::VectorInstruction;

/// A name and the place of its value.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Its name; empty for what is free in formulas.
    pub name: String,
    /// Its type.
    pub kind: Type,
    /// The places of its scalars.
    pub(super) slots: Range<Slot>,
    /// Where it is declared.
    pub line: u32,
}

impl Cell {
    pub(super) fn new(name: &str, kind: Type, slot: Slot, line: u32) -> Self {
        let count = kind.slots().unwrap_or(0) as Slot;
        Self { name: name.to_owned(), kind, slots: slot..slot + count, line }
    }

    fn places(&self) -> Range<usize> {
        self.slots.start as usize..self.slots.end as usize
    }
}

/// An output and what it is given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StoredOutput {
    /// The output.
    pub output: String,
    /// The cell that it is given.
    pub cell: usize,
    /// Where.
    pub line: u32,
}

/// How a cell comes by its value.
#[derive(Clone, Debug)]
pub struct Formula {
    cell: usize,
    uses: Vec<usize>,
    body: Arc<FunctionBody>,
}

#[derive(Debug)]
enum FunctionBody {
    /// Without branches and calls.
    Straight(Vec<VectorInstruction>),
    Nodes(Vec<Node>),
}

/// All cells, and the functions that formulas call.
#[derive(Debug)]
pub struct Sheet {
    cells: Vec<Cell>,
    functions: Vec<Vec<Node>>,
    first: Vec<f64>,
    formulas: Vec<Formula>,
    textures: Arc<[Texture]>,
}

/// The values of all cells, for one sample.
#[derive(Clone, Debug)]
pub struct Registers(Vec<f64>);

impl Formula {
    /// How many steps it takes, calls and loops aside.
    #[must_use]
    pub fn steps(&self) -> usize {
        match &*self.body {
            FunctionBody::Straight(steps) => steps.len(),
            FunctionBody::Nodes(nodes) => nodes.len(),
        }
    }

    /// The formula of a cell. `functions` are those that it may call; `temporaries` are free to be used.
    ///
    /// # Errors
    /// It does what no definition does: what, and on which line.
    pub(super) fn new(
        cell: usize,
        nodes: Vec<Node>,
        cells: &[Cell],
        functions: &[&[Node]],
        temporaries: Range<Slot>,
    ) -> Result<Self, (Text, u32)> {
        let access = access::of(&nodes, functions)?;
        let cell_of = |slot: &Slot| cells.iter().position(|cell| cell.slots.contains(slot));
        if let Some(other) = access.written.iter().filter_map(cell_of).find(|&other| other != cell) {
            let name = &cells[other].name;
            let what = both(
                format!("this changes `{name}`, which has a value already"),
                format!("すでに値のある `{name}` を変更しています"),
            );
            return Err((what, 0));
        }
        let mut uses: Vec<usize> = access.read.iter().filter_map(cell_of).collect();
        uses.sort_unstable();
        uses.dedup();
        let body = match straight::steps(&nodes, cells[cell].slots.clone(), temporaries) {
            Some(steps) => FunctionBody::Straight(steps),
            None => FunctionBody::Nodes(nodes),
        };
        Ok(Self { cell, uses, body: Arc::new(body) })
    }

    /// The cell that it computes.
    pub fn cell(&self) -> usize {
        self.cell
    }

    /// The cells that it reads, ascending.
    pub fn uses(&self) -> &[usize] {
        &self.uses
    }
}

impl Sheet {
    pub(super) fn new(
        cells: Vec<Cell>,
        functions: Vec<Vec<Node>>,
        first: Vec<f64>,
        formulas: Vec<Formula>,
        textures: Arc<[Texture]>,
    ) -> Self {
        Self { cells, functions, first, formulas, textures }
    }

    /// How many scalars its registers hold.
    pub(super) fn slots(&self) -> usize {
        self.first.len()
    }

    /// The sheet with what is compiled beyond it, see [`super::Draft::beyond`].
    pub fn with(&self, beyond: &Self) -> Self {
        let more = beyond.first.get(self.first.len()..).unwrap_or_default();
        Self {
            cells: self.cells.clone(),
            functions: self.functions.clone(),
            first: [self.first.as_slice(), more].concat(),
            formulas: self.formulas.clone(),
            textures: Arc::clone(&self.textures),
        }
    }

    /// All cells: constants, uniforms and inputs, then the definitions in their order, then the number that is free.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// What the definitions are, in their order.
    pub fn formulas(&self) -> &[Formula] {
        &self.formulas
    }

    /// Registers in which the constants have the values that the program gives them.
    pub fn registers(&self) -> Registers {
        Registers(self.first.clone())
    }

    /// The scalars of a cell.
    pub fn get<'r>(&self, cell: usize, registers: &'r Registers) -> &'r [f64] {
        &registers.0[self.cells[cell].places()]
    }

    /// Gives a cell its scalars.
    pub fn set(&self, cell: usize, values: &[f64], registers: &mut Registers) {
        registers.0[self.cells[cell].places()].copy_from_slice(values);
    }

    /// Computes a cell from what it uses.
    pub fn compute(&self, formula: &Formula, registers: &mut Registers) {
        match &*formula.body {
            FunctionBody::Straight(steps) => steps.iter().for_each(|step| step.run(&mut registers.0)),
            FunctionBody::Nodes(nodes) => {
                if SingleSample::new(&self.functions, &self.textures, &mut registers.0).run(nodes).is_err() {
                    registers.0[self.cells[formula.cell].places()].fill(f64::NAN);
                }
            }
        }
    }
}
