//! The equation that is made of a solution which is checked.

use super::{CheckedSolution, POSITION, SHOWN_COLOUR, SHOWN_POSITION, refused};
use crate::assignment::check::CheckResult;
use crate::assignment::{Constant, Interface};
use crate::equation::{Definition, Equation, Reads};
use crate::interpreter::{Cell, Formula, Texture};
use crate::pipeline::Pipeline;
use std::sync::Arc;

impl CheckedSolution<'_> {
    /// The equation that the solution is.
    pub(in crate::assignment::check) fn finish(
        self,
        interface: &Interface,
        pipeline: &Pipeline,
        constants: &[Constant],
        textures: Arc<[Texture]>,
    ) -> CheckResult<Equation> {
        let colour = self.output(None)?;
        let has_position = self.draft.stored().iter().any(|stored| stored.output == POSITION);
        let position = has_position.then(|| self.output(Some(POSITION))).transpose()?;
        let stored = self.draft.stored().iter();
        let outputs = stored.map(|stored| (stored.output.clone(), stored.cell - self.first)).collect();
        let cells = self.draft.cells();
        let definition = |formula: &Formula| {
            let Cell { name, kind, .. } = cells[formula.cell()].clone();
            Definition { name, kind, formula: formula.clone() }
        };
        let definitions: Vec<Definition> = self.draft.formulas().iter().map(definition).collect();
        let given = |name: &str| cells[..self.first].iter().position(|cell| cell.name == *name);
        let constants = constants.iter().map(|constant| (given(&constant.name), constant.value.clone())).collect();
        let uniforms = interface.uniforms.iter().map(|uniform| given(&uniform.path)).collect();
        let attributes = match self.reads {
            Reads::Attributes => interface.inputs.iter().map(|input| given(&input.name)).collect(),
            Reads::Varyings => pipeline.fragment.inputs().iter().map(|input| given(&input.name)).collect(),
            Reads::Outputs => [SHOWN_COLOUR, SHOWN_POSITION].into_iter().map(given).collect(),
        };
        let (name, reads) = (&self.file.solution.name, self.reads);
        let sheet = self.draft.finish(textures).map_err(|refusal| refused(name, &refusal))?;
        let sheet = Arc::new(sheet);
        let numbers = definitions.iter().filter_map(|definition| definition.kind.slots()).sum();
        Ok(Equation {
            reads,
            sheet,
            constants,
            uniforms,
            attributes,
            first: self.first,
            definitions,
            numbers,
            colour,
            position,
            outputs,
        })
    }
}
