//! The stages of the right program: those of the solution, and those that are fixed.

use super::{CheckResult, solution};
use crate::accepted::AcceptedAnswer;
use crate::assignment::{FixedStage, HandedIn, error};
use crate::interpreter::{Program, Stage};
use crate::manifest;
use crate::pipeline::Pipeline;
use crate::text::{Text, both};
use std::sync::Arc;

/// A stage, compiled.
pub(super) struct Compiled {
    /// The name of its file.
    pub name: String,
    pub stage: Stage,
    pub program: Arc<Program>,
}

/// A vertex and a fragment stage.
pub(super) struct Stages(pub Vec<Compiled>);

impl Stages {
    /// Compiles the solution and what it is linked with.
    pub fn of(files: &[HandedIn], fixed: &[FixedStage]) -> CheckResult<Self> {
        let handed_in = files.iter().map(|file| (&file.solution.name, file.stage, &file.solution.text));
        let fixed = fixed.iter().map(|fixed| (&fixed.name, fixed.stage, &fixed.text));
        let mut stages: Vec<Compiled> = Vec::new();
        for (name, stage, text) in handed_in.chain(fixed) {
            let compiled = compiled(name, stage, text)?;
            if let Some(other) = stages.iter().find(|other| other.stage == compiled.stage) {
                let message = both(
                    format!("is a second stage of this kind, beside {}: keep one", other.name),
                    format!("同じ種類のステージが {} にもあります。一つだけにしてください", other.name),
                );
                return Err(error(name, message));
            }
            stages.push(compiled);
        }
        for (stage, word) in [(Stage::Vertex, "vertex"), (Stage::Fragment, "fragment")] {
            if !stages.iter().any(|known| known.stage == stage) {
                let message = both(
                    format!("there is no {word} stage: write [[file]] or [[fixed]] with `stage = \"{word}\"`"),
                    format!(
                        "{word} ステージがありません。`stage = \"{word}\"` の [[file]] または [[fixed]] を書いてください"
                    ),
                );
                return Err(error("file", message));
            }
        }
        Ok(Self(stages))
    }

    pub fn get(&self, stage: Stage) -> &Compiled {
        let found = self.0.iter().find(|compiled| compiled.stage == stage);
        found.unwrap_or(&self.0[0])
    }

    /// The right program.
    pub fn pipeline(&self) -> CheckResult<Pipeline> {
        let [vertex, fragment] = [Stage::Vertex, Stage::Fragment].map(|stage| self.get(stage));
        let linked = Pipeline::link(&vertex.program, &fragment.program, None);
        linked.map_err(|Text { en, ja }| {
            let name = &vertex.name;
            error(&fragment.name, both(format!("{en} ({name})"), format!("{ja} ({name})")))
        })
    }

    /// Other answers for a stage, linked with the stages of the other kind.
    pub fn accepted(
        &self,
        stage: Stage,
        entries: &[manifest::Accepted],
        read: &dyn Fn(&str) -> CheckResult<String>,
    ) -> CheckResult<Vec<AcceptedAnswer>> {
        let answer = |entry: &manifest::Accepted| {
            let name = entry.file();
            let own = compiled(name, stage, &read(name)?)?;
            let other = |stage| if own.stage == stage { &own.program } else { &self.get(stage).program };
            let linked = Pipeline::link(other(Stage::Vertex), other(Stage::Fragment), None);
            let pipeline = linked.map_err(|what| error(name, what))?;
            Ok(AcceptedAnswer::new(name, pipeline))
        };
        entries.iter().map(answer).collect()
    }
}

impl Stages {
    /// The program in which some files have another text; `place`: what it is called where it does not fit.
    pub fn changed(&self, texts: &[(&HandedIn, String)], place: &str) -> CheckResult<AcceptedAnswer> {
        let mut own = Vec::new();
        for (file, text) in texts.iter().filter(|(file, text)| *text != file.solution.text) {
            let program = Program::compile(text, file.stage).map_err(|refusal| {
                let wrong = solution::refused(&file.solution.name, &refusal);
                error(place, both(wrong.text().en, wrong.text().ja))
            })?;
            own.push((file.stage, Arc::new(program)));
        }
        let stage = |stage| {
            let changed = own.iter().find(|(own, _)| *own == stage).map(|(_, program)| program);
            Arc::clone(changed.unwrap_or(&self.get(stage).program))
        };
        let (vertex, fragment) = (stage(Stage::Vertex), stage(Stage::Fragment));
        let pipeline = Pipeline::link(&vertex, &fragment, None).map_err(|what| error(place, what))?;
        Ok(AcceptedAnswer::new(place, pipeline))
    }
}

pub(super) fn compiled(name: &str, stage: Stage, text: &str) -> CheckResult<Compiled> {
    let program = Program::compile(text, stage).map_err(|refusal| solution::refused(name, &refusal))?;
    Ok(Compiled { name: name.to_owned(), stage, program: Arc::new(program) })
}
