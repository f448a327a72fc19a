//! What can be said of a program without running it.

use super::code::{Code, Instruction, Node, Operation, Slot};
use super::texture::LookupMode;
use std::collections::HashMap;

/// What a fragment program needs and does beyond computing outputs from inputs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Nature {
    /// It takes derivatives: it has to run in 2 × 2 pixels.
    pub derivatives: bool,
    /// It looks up textures whose level may come from the neighbours.
    pub implicit_levels: bool,
    /// It may throw fragments away.
    pub discards: bool,
    /// It goes one of several ways, or its values have steps.
    pub decides: bool,
}

impl Nature {
    pub(super) fn of(code: &Code) -> Self {
        let mut nature = Self::default();
        nature.add(&code.start);
        code.functions.iter().for_each(|nodes| nature.add(nodes));
        nature
    }

    fn add(&mut self, nodes: &[Node]) {
        for node in nodes {
            match node {
                Node::Derivative { .. } => self.derivatives = true,
                Node::Texture(query) => self.implicit_levels |= matches!(query.mode, LookupMode::Implicit(_)),
                Node::Discard => self.discards = true,
                Node::Do(one) => self.decides |= has_steps(one),
                Node::If { yes, no, .. } => {
                    self.decides = true;
                    [yes, no].into_iter().for_each(|nodes| self.add(nodes));
                }
                Node::Loop { test, body, step, .. } => [test, body, step].into_iter().for_each(|nodes| self.add(nodes)),
                Node::Switch { cases, .. } => {
                    self.decides = true;
                    cases.iter().for_each(|(_, nodes)| self.add(nodes));
                }
                _ => {}
            }
        }
    }
}

/// Whether the result of an instruction jumps where what it is made of changes by little.
fn has_steps(instruction: &Instruction) -> bool {
    use Operation as Is;
    matches!(
        instruction.operation,
        Is::Sign
            | Is::Floor
            | Is::Ceil
            | Is::Trunc
            | Is::Round
            | Is::RoundEven
            | Is::Fract
            | Is::Mod
            | Is::Less
            | Is::LessEqual
            | Is::Equal
            | Is::NotEqual
            | Is::Truncate
    )
}

/// A scalar of an output that is only handed on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Copied {
    /// The input, by its place, and which of its scalars.
    Input(usize, usize),
    /// A number.
    Constant(f64),
}

/// See [`super::Program::copies`].
pub(super) fn copies(code: &Code) -> Option<Vec<Vec<Copied>>> {
    let mut known: HashMap<Slot, Copied> = HashMap::new();
    for (place, input) in code.inputs.iter().enumerate() {
        let slots = input.kind.slots()?;
        known.extend((0..slots).map(|scalar| (input.slot + scalar as Slot, Copied::Input(place, scalar))));
    }
    let constant = |slot: &Slot| code.constants.get(*slot as usize).copied().flatten();
    for node in code.start.iter().chain(code.functions.get(code.main)?) {
        let (to, from) = match node {
            Node::Store { to, from } => (to, from),
            Node::Do(one) if one.operation == Operation::Copy => (&one.to, &one.of[0]),
            _ => return None,
        };
        let copied = known.get(from).copied().or_else(|| constant(from).map(|known| Copied::Constant(known.value)))?;
        known.insert(*to, copied);
    }
    let scalars =
        |slot: Slot, count: usize| (slot..slot + count as Slot).map(|slot| known.get(&slot).copied()).collect();
    code.outputs.iter().map(|output| scalars(output.slot, output.kind.slots()?)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interpreter::{Program, Stage};

    fn fragment(text: &str) -> Program {
        Program::compile(&format!("#version 410\n{text}"), Stage::Fragment).expect(text)
    }

    #[test]
    fn copies_are_seen() {
        let copied = |text: &str| fragment(text).copies().map(|copies| copies[0].clone());
        let input = |scalar| Copied::Input(0, scalar);
        let all = Some(vec![input(0), input(1), input(2), input(3)]);
        assert_eq!(copied("in vec4 a; out vec4 b; void main() { b = a; }"), all);
        let mixed = Some(vec![input(2), input(1), input(0), Copied::Constant(1.0)]);
        assert_eq!(copied("in vec4 a; out vec4 b; void main() { vec3 c = a.zyx; b = vec4(c, 1.0); }"), mixed);
        assert_eq!(copied("in vec4 a; out vec4 b; void main() { b = a * 2.0; }"), None);
        assert_eq!(copied("in vec4 a; out vec4 b; void main() { if (a.x > 0.0) b = a; }"), None);
        assert_eq!(copied("in vec4 a; out vec4 b; void main() { b.x = a.x; }"), None);
    }

    #[test]
    fn what_needs_neighbours_is_seen_in_functions_and_branches() {
        let text = "in vec2 a; out float b; float f(float x) { if (x > 0.0) { discard; } return fwidth(x); }\n\
            void main() { b = f(a.x); }";
        assert_eq!(
            fragment(text).nature(),
            Nature { derivatives: true, implicit_levels: false, discards: true, decides: true }
        );
        assert_eq!(fragment("in vec2 a; out float b; void main() { b = a.x; }").nature(), Nature::default());
    }
}
