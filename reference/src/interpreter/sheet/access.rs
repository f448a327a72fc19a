//! What a formula reads and writes.

use crate::interpreter::code::{Node, Slot};
use crate::text::{Text, both};
use std::collections::HashSet;

/// The slots that nodes read and write.
#[derive(Default)]
pub(super) struct Access {
    pub read: Vec<Slot>,
    pub written: Vec<Slot>,
    called: HashSet<usize>,
}

/// What these nodes read and write, and the functions that they call.
///
/// # Errors
/// Something that a single sample cannot do: what, and on which line.
pub(super) fn of(nodes: &[Node], functions: &[&[Node]]) -> Result<Access, (Text, u32)> {
    let mut access = Access::default();
    access.add(nodes, functions)?;
    Ok(access)
}

impl Access {
    fn add(&mut self, nodes: &[Node], functions: &[&[Node]]) -> Result<(), (Text, u32)> {
        nodes.iter().try_for_each(|node| self.add_one(node, functions))
    }

    fn add_one(&mut self, node: &Node, functions: &[&[Node]]) -> Result<(), (Text, u32)> {
        match node {
            Node::Do(one) => self.read.extend(one.of),
            Node::Store { to, from } => {
                self.read.push(*from);
                self.written.push(*to);
            }
            Node::Undefine { base, .. } => self.written.push(*base),
            Node::Offset { before, index, .. } => self.read.extend(before.iter().chain([index])),
            Node::Gather { from, .. } => self.read.extend([from.base, from.offset]),
            Node::Scatter { to, from, .. } => {
                self.read.extend([to.offset, *from]);
                self.written.push(to.base);
            }
            Node::If { condition, yes, no, .. } => {
                self.read.push(*condition);
                self.add(yes, functions)?;
                self.add(no, functions)?;
            }
            Node::Loop { test, condition, body, step, .. } => {
                self.read.extend(condition);
                [test, body, step].into_iter().try_for_each(|nodes| self.add(nodes, functions))?;
            }
            Node::Switch { selector, cases, .. } => {
                self.read.push(*selector);
                cases.iter().try_for_each(|(_, nodes)| self.add(nodes, functions))?;
            }
            Node::Call { function, .. } => {
                if self.called.insert(*function) {
                    self.add(functions.get(*function).copied().unwrap_or_default(), functions)?;
                }
            }
            Node::Break | Node::Continue | Node::Return => {}
            Node::Record(_) | Node::Wrote { .. } | Node::HandedOn { .. } => {}
            Node::Discard => {
                return Err((both("a definition throws no sample away", "定義の中で `discard` は使えません"), 0));
            }
            Node::Derivative { line, .. } => {
                return Err((
                    both("a definition has no derivatives", "定義の中で微分 (`dFdx` など) は使えません"),
                    *line,
                ));
            }
            Node::Texture(query) => {
                self.read.extend(query.operands());
                self.written.extend(&query.to);
            }
        }
        Ok(())
    }
}
