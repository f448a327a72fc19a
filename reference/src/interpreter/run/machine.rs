//! Control flow: which lanes run, and for how long.

use super::mask::Mask;
use super::memory::{CauseNumber, Memory, UndefinedCause};
use super::rounding::Precision;
use super::undefined::Undefined;
use super::{NotedLookup, Stopped};
use crate::interpreter::code::{Code, Node, Slot};
use crate::interpreter::texture::Texture;
use crate::interpreter::trace::Recorder;

/// Steps that a branch, a turn of a loop or a call costs: it makes a few masks.
const CONTROL: u64 = 4;

/// Runs blocks of lanes.
pub(super) struct Machine<'a> {
    pub code: &'a Code,
    pub memory: Memory,
    pub textures: &'a [Texture],
    pub lanes: usize,
    /// The lanes that run now.
    pub active: Mask,
    /// Lanes that left the loop or `switch`, the turn of a loop, the function; innermost last.
    breaks: Vec<Mask>,
    continues: Vec<Mask>,
    returns: Vec<Mask>,
    pub discarded: Mask,
    /// For each lane, why it may have run other statements than it should have.
    pub strayed: Vec<CauseNumber>,
    pub fuel: u64,
    /// What looks at the values of a program that is traced.
    pub recorder: Option<Box<Recorder>>,
    /// The lookups, where they are noted.
    pub lookups: Option<Vec<NotedLookup>>,
    /// What textures give is multiplied with this, save 0 and 1.
    pub texels: f64,
}

impl<'a> Machine<'a> {
    pub fn new(code: &'a Code, textures: &'a [Texture], lanes: usize, precision: Precision, fuel: u64) -> Self {
        let none = Mask::new(lanes, false);
        Self {
            code,
            memory: Memory::new(&code.constants, lanes, precision),
            textures,
            lanes,
            active: none.clone(),
            breaks: Vec::new(),
            continues: Vec::new(),
            returns: Vec::new(),
            discarded: none,
            strayed: Vec::new(),
            fuel,
            recorder: None,
            lookups: None,
            texels: 1.0,
        }
    }

    /// Makes ready for a block of at most as many lanes as at the start.
    pub fn begin(&mut self, lanes: usize) {
        self.lanes = lanes;
        self.memory.begin(lanes);
        self.active = Mask::new(lanes, true);
        self.discarded = Mask::new(lanes, false);
        self.strayed = vec![0; lanes];
        for output in &self.code.outputs {
            let count = output.kind.slots().unwrap_or(0) as u32;
            let cause = UndefinedCause { what: Undefined::Unwritten, line: output.line };
            self.memory.undefine(output.slot, count, cause, &self.active);
        }
    }

    /// Runs a block to its end.
    pub fn run(&mut self) -> Result<(), Stopped> {
        let code = self.code;
        self.execute(&code.start)?;
        self.call(code.main, 0)
    }

    fn burn(&mut self, line: u32) -> Result<(), Stopped> {
        self.burn_many(1, line)
    }

    fn burn_many(&mut self, steps: u64, line: u32) -> Result<(), Stopped> {
        // A lane's step costs less among many others: a few alone cost as much as eight.
        let cost = steps * self.lanes.max(8) as u64;
        self.fuel = self.fuel.checked_sub(cost).ok_or(Stopped { line })?;
        Ok(())
    }

    fn execute(&mut self, nodes: &[Node]) -> Result<(), Stopped> {
        for node in nodes {
            if !self.active.any() {
                return Ok(());
            }
            self.node(node)?;
        }
        Ok(())
    }

    fn node(&mut self, node: &Node) -> Result<(), Stopped> {
        match node {
            Node::Do(instruction) => {
                self.burn(instruction.line)?;
                self.memory.execute(instruction);
            }
            Node::Store { to, from } => {
                self.burn(0)?;
                self.memory.store(*to, *from, &self.active);
            }
            Node::Undefine { base, count, what, line } => {
                self.burn_many(u64::from(*count), *line)?;
                let cause = UndefinedCause { what: *what, line: *line };
                self.memory.undefine(*base, *count, cause, &self.active);
            }
            Node::Offset { to, before, index, count, stride, line } => {
                self.burn(*line)?;
                self.offset(*to, *before, *index, [*count, *stride], *line);
            }
            Node::Gather { to, from, line } => {
                self.burn(*line)?;
                self.gather(*to, *from);
            }
            Node::Scatter { to, from, line } => {
                self.burn(*line)?;
                self.scatter(*to, *from);
            }
            Node::If { condition, yes, no, line } => {
                self.burn_many(CONTROL, *line)?;
                self.branch(*condition, yes, no)?;
            }
            Node::Loop { .. } => self.repeat(node)?,
            Node::Switch { selector, cases, line } => {
                self.burn_many(cases.len() as u64 + 1, *line)?;
                self.switch(*selector, cases)?;
            }
            Node::Call { function, line } => self.call(*function, *line)?,
            Node::Break => self.leave(|machine| machine.breaks.last_mut()),
            Node::Continue => self.leave(|machine| machine.continues.last_mut()),
            Node::Return => self.leave(|machine| machine.returns.last_mut()),
            Node::Discard => self.leave(|machine| Some(&mut machine.discarded)),
            Node::Derivative { to, of, direction, coarse, line } => {
                self.burn(*line)?;
                self.derivative(*to, *of, *direction, *coarse, *line);
            }
            Node::Texture(query) => {
                // A lookup reads up to 16 texels with their weights.
                self.burn_many(16, query.line)?;
                self.lookup(query);
            }
            Node::Record(record) => self.record(record),
            Node::Wrote { site, base, count } => self.wrote(*site, *base..*base + *count),
            Node::HandedOn { to, from } => self.handed_on(*to, *from),
        }
        Ok(())
    }

    fn none(&self) -> Mask {
        Mask::new(self.lanes, false)
    }

    fn leave(&mut self, into: impl FnOnce(&mut Self) -> Option<&mut Mask>) {
        self.recorder.iter_mut().for_each(|recorder| recorder.leave());
        let none = self.none();
        let leaving = std::mem::replace(&mut self.active, none);
        if let Some(mask) = into(self) {
            mask.add(&leaving);
        }
    }

    /// The lanes whose way an undefined value decides run on, and all that they compute is undefined.
    fn stray(&mut self, condition: Slot) {
        if !self.memory.is_undefined(condition) {
            return;
        }
        for lane in 0..self.lanes {
            if self.active.has(lane) && self.strayed[lane] == 0 {
                self.strayed[lane] = self.memory.cause(condition, lane);
            }
        }
    }

    fn branch(&mut self, condition: Slot, yes: &[Node], no: &[Node]) -> Result<(), Stopped> {
        self.stray(condition);
        self.enter(condition);
        let (on_yes, on_no) = self.active.split(self.memory.column(condition));
        self.active = on_yes;
        self.execute(yes)?;
        let mut after = std::mem::replace(&mut self.active, on_no);
        self.execute(no)?;
        after.add(&self.active);
        self.active = after;
        self.leave_condition();
        Ok(())
    }

    fn repeat(&mut self, node: &Node) -> Result<(), Stopped> {
        let Node::Loop { test, condition, body, step, test_first, line } = node else { return Ok(()) };
        let none = self.none();
        self.breaks.push(none.clone());
        let mut left = none.clone();
        let mut tests = *test_first;
        let mut is_within = false;
        loop {
            self.burn_many(CONTROL, *line)?;
            if tests {
                self.execute(test)?;
                if let Some(condition) = condition {
                    if is_within {
                        self.leave_condition();
                    }
                    is_within = true;
                    self.enter(*condition);
                    self.stray(*condition);
                    let (going_on, leaving) = self.active.split(self.memory.column(*condition));
                    left.add(&leaving);
                    self.active = going_on;
                }
            }
            if !self.active.any() {
                break;
            }
            self.continues.push(none.clone());
            self.execute(body)?;
            if let Some(continued) = self.continues.pop() {
                self.active.add(&continued);
            }
            self.execute(step)?;
            tests = true;
        }
        if let Some(broken) = self.breaks.pop() {
            left.add(&broken);
        }
        if is_within {
            self.leave_condition();
        }
        self.active = left;
        Ok(())
    }

    fn switch(&mut self, selector: Slot, cases: &[(Vec<Option<f64>>, Vec<Node>)]) -> Result<(), Stopped> {
        self.stray(selector);
        self.enter(selector);
        let none = self.none();
        let selected = self.memory.column(selector);
        let labelled = |value: f64| cases.iter().position(|(labels, _)| labels.contains(&Some(value)));
        let default = cases.iter().position(|(labels, _)| labels.contains(&None));
        let entries: Vec<Option<usize>> = selected.iter().map(|&value| labelled(value).or(default)).collect();
        let entering = std::mem::replace(&mut self.active, none.clone());
        self.breaks.push(none);
        for (number, (_, nodes)) in cases.iter().enumerate() {
            self.active.add(&entering.filter(|lane| entries[lane] == Some(number)));
            self.execute(nodes)?;
        }
        self.active.add(&entering.filter(|lane| entries[lane].is_none()));
        if let Some(broken) = self.breaks.pop() {
            self.active.add(&broken);
        }
        self.leave_condition();
        Ok(())
    }

    fn call(&mut self, function: usize, line: u32) -> Result<(), Stopped> {
        self.burn_many(CONTROL, line)?;
        let none = self.none();
        self.returns.push(none);
        let code = self.code;
        self.execute(&code.functions[function])?;
        if let Some(returned) = self.returns.pop() {
            self.active.add(&returned);
        }
        Ok(())
    }
}
