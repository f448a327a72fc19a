//! One sample at a time, without masks: what is undefined is not a number, and so is all that comes of it.

use super::kernel;
use super::lookup::look_up;
use crate::interpreter::code::{Indexed, Instruction, Node, Slot};
use crate::interpreter::texture::Texture;

/// Nodes that a run may take: an endless loop ends here.
const FUEL: u32 = 1_000_000;

/// Registers, and what may be called.
pub struct SingleSample<'a> {
    functions: &'a [Vec<Node>],
    textures: &'a [Texture],
    registers: &'a mut [f64],
    fuel: u32,
}

/// What comes next.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Next {
    Node,
    Break,
    Continue,
    Return,
}

/// Something undefined decides what is done, or it does not end.
#[derive(Debug)]
pub struct Astray;

impl<'a> SingleSample<'a> {
    /// Ready to run.
    pub fn new(functions: &'a [Vec<Node>], textures: &'a [Texture], registers: &'a mut [f64]) -> Self {
        Self { functions, textures, registers, fuel: FUEL }
    }

    fn of(&self, slot: Slot) -> f64 {
        self.registers[slot as usize]
    }

    fn step(&mut self, instruction: &Instruction) {
        let Instruction { operation, class, to, of, .. } = *instruction;
        self.registers[to as usize] = kernel::defined(operation, class, of.map(|slot| self.of(slot)));
    }

    /// Does everything.
    ///
    /// # Errors
    /// The value is undefined.
    pub fn run(&mut self, nodes: &[Node]) -> Result<(), Astray> {
        self.nodes(nodes).map(drop)
    }

    fn nodes(&mut self, nodes: &[Node]) -> Result<Next, Astray> {
        for node in nodes {
            let next = self.node(node)?;
            if next != Next::Node {
                return Ok(next);
            }
        }
        Ok(Next::Node)
    }

    fn node(&mut self, node: &Node) -> Result<Next, Astray> {
        self.fuel = self.fuel.checked_sub(1).ok_or(Astray)?;
        match node {
            Node::Do(instruction) => self.step(instruction),
            Node::Store { to, from } => self.registers[*to as usize] = self.of(*from),
            Node::Undefine { base, count, .. } => {
                self.registers[*base as usize..(base + count) as usize].fill(f64::NAN);
            }
            Node::Offset { to, before, index, count, stride, .. } => {
                let (before, index) = (before.map_or(0.0, |slot| self.of(slot)), self.of(*index));
                let is_inside = index >= 0.0 && index < f64::from(*count);
                self.registers[*to as usize] = if is_inside { before + index * f64::from(*stride) } else { f64::NAN };
            }
            Node::Gather { to, from, .. } => {
                self.registers[*to as usize] = self.place(from).map_or(f64::NAN, |slot| self.of(slot));
            }
            Node::Scatter { to, from, .. } => {
                let place = self.place(to).ok_or(Astray)?;
                self.registers[place as usize] = self.of(*from);
            }
            Node::If { condition, yes, no, .. } => {
                return self.nodes(if self.decides(*condition)? { yes } else { no });
            }
            Node::Loop { .. } => return self.repeat(node),
            Node::Switch { selector, cases, .. } => return self.switch(*selector, cases),
            Node::Call { function, .. } => {
                let functions = self.functions;
                self.nodes(&functions[*function])?;
            }
            Node::Break => return Ok(Next::Break),
            Node::Continue => return Ok(Next::Continue),
            Node::Return => return Ok(Next::Return),
            Node::Texture(query) => {
                // A sample by itself has no neighbours.
                let (found, open) = look_up(self.textures, query, &|slot| self.of(slot), &|_, _| None);
                let is_known = open.is_none() && query.operands().all(|slot| !self.of(slot).is_nan());
                for (to, found) in query.to.iter().zip(found) {
                    self.registers[*to as usize] = if is_known { found } else { f64::NAN };
                }
            }
            Node::Discard | Node::Derivative { .. } => return Err(Astray),
            // Nothing of a sheet is traced.
            Node::Record(_) | Node::Wrote { .. } | Node::HandedOn { .. } => {}
        }
        Ok(Next::Node)
    }

    fn place(&self, indexed: &Indexed) -> Option<Slot> {
        let distance = self.of(indexed.offset);
        (!distance.is_nan()).then(|| indexed.base + distance as Slot)
    }

    fn decides(&self, condition: Slot) -> Result<bool, Astray> {
        let condition = self.of(condition);
        if condition.is_nan() { Err(Astray) } else { Ok(condition != 0.0) }
    }

    fn repeat(&mut self, node: &Node) -> Result<Next, Astray> {
        let Node::Loop { test, condition, body, step, test_first, .. } = node else { return Ok(Next::Node) };
        let mut tests = *test_first;
        loop {
            self.fuel = self.fuel.checked_sub(1).ok_or(Astray)?;
            if tests {
                self.nodes(test)?;
                if let Some(condition) = condition
                    && !self.decides(*condition)?
                {
                    return Ok(Next::Node);
                }
            }
            match self.nodes(body)? {
                Next::Break => return Ok(Next::Node),
                Next::Return => return Ok(Next::Return),
                Next::Node | Next::Continue => {}
            }
            self.nodes(step)?;
            tests = true;
        }
    }

    fn switch(&mut self, selector: Slot, cases: &[(Vec<Option<f64>>, Vec<Node>)]) -> Result<Next, Astray> {
        let selected = self.of(selector);
        if selected.is_nan() {
            return Err(Astray);
        }
        let labelled = |label| cases.iter().position(|(labels, _)| labels.contains(&label));
        let Some(first) = labelled(Some(selected)).or_else(|| labelled(None)) else { return Ok(Next::Node) };
        for (_, nodes) in &cases[first..] {
            match self.nodes(nodes)? {
                Next::Node => {}
                Next::Break => return Ok(Next::Node),
                other => return Ok(other),
            }
        }
        Ok(Next::Node)
    }
}
