//! The stages of a homework as one program: those that are handed in, and those that are fixed.

use super::module::{self, Built, Shader};
use super::verdict::{Submitted, compiled, first_pass, linked};
use super::{
    LinkedInterface, TranslationRefusal, Variable, boundary, check_text, fixed, gate, interface, portability, text,
};
use crate::diagnostic::Diagnostic;
use crate::fault::Fault;
use crate::ffi::glslang::{Stage, StageText};
use crate::source::Source;
use std::ffi::CString;

/// A homework's program, whose other stages are handed in.
#[derive(Clone, Debug)]
pub struct HomeworkProgram {
    interface: LinkedInterface,
    fixed: Option<LinkedFixedStage>,
}

/// A stage of the homework's own.
#[derive(Clone, Debug)]
struct LinkedFixedStage {
    stage: Stage,
    text: CString,
    shader: Shader,
}

/// A program that runs, and what there is to say about it.
#[derive(Clone, Debug)]
pub struct Linked {
    /// Its vertex stage, of which everything is captured that the fragment stage reads.
    pub vertex: Shader,
    /// Its fragment stage.
    pub fragment: Shader,
    /// Warnings and notes, each about one of the stages that are handed in.
    pub diagnostics: Vec<(Stage, Diagnostic)>,
}

/// Why there is no program: about which stage, and what.
#[derive(Clone, Debug)]
pub struct ProgramRefusal {
    /// The stage that it is about.
    pub stage: Stage,
    /// Why.
    pub refusal: TranslationRefusal,
}

impl HomeworkProgram {
    /// The program of a homework with this interface, whose `stage` is fixed as `text`; both are handed in where there is
    /// none.
    pub fn new(interface: LinkedInterface, own: Option<(Stage, &str)>) -> Result<Self, Fault> {
        let Some((stage, text)) = own else { return Ok(Self { interface, fixed: None }) };
        let text = text::c_text(text);
        // The compiler's table of built-ins is made under OpenGL's rules.
        compiled(std::iter::once(StageText::plain(stage, &text)), &[]);
        let shader = fixed(stage, &text, &interface)?;
        Ok(Self { interface, fixed: Some(LinkedFixedStage { stage, text, shader }) })
    }

    /// Compiles, links and translates the stages that are handed in, vertex before fragment.
    pub fn translate(&self, sources: &[(Stage, &Source)]) -> Result<Linked, ProgramRefusal> {
        let about = |stage| move |refusal: TranslationRefusal| ProgramRefusal { stage, refusal };
        let interfaces: Vec<LinkedInterface> = sources.iter().map(|(stage, _)| self.seen_by(*stage)).collect();
        let mut stages = Vec::with_capacity(sources.len());
        for ((stage, source), interface) in sources.iter().zip(&interfaces) {
            check_text(source).map_err(about(*stage))?;
            stages.push(Submitted::new(*stage, source, interface));
        }
        let last = sources.last().map_or(Stage::Fragment, |(stage, _)| *stage);
        let own: Vec<_> = self.fixed.iter().map(|fixed| StageText::plain(fixed.stage, &fixed.text)).collect();
        let verdict = first_pass(&mut stages, &own).map_err(|(stage, refusal)| about(stage)(refusal))?;
        let mut diagnostics = Vec::new();
        for one in &stages {
            let found = one.diagnostics(&verdict).map_err(about(one.stage))?;
            diagnostics.extend(found.into_iter().map(|diagnostic| (one.stage, diagnostic)));
        }
        // The fragment stage first: what it reads is captured of the other.
        let mut built: Vec<Shader> = Vec::with_capacity(stages.len());
        for one in stages.iter().rev() {
            let read = built.first().map(|fragment| fragment.inputs.iter().map(|input| input.name.clone()).collect());
            let shader = Self::build(one, read).or_else(|refusal| {
                // What does not link in itself, such as a function that calls itself, the compiler does not write.
                linked(&verdict, &stages, &own)?;
                Err(refusal)
            });
            let mut shader = shader.map_err(about(one.stage))?;
            if one.stage == Stage::Fragment {
                by_location(&mut shader, &self.placed(sources));
            }
            let notes = interface::check(&shader, one.source, &self.interface).map_err(about(one.stage))?;
            diagnostics.extend(notes.into_iter().map(|note| (one.stage, note)));
            built.push(shader);
        }
        let mut shader = |stage| match built.iter().position(|shader| shader.stage == stage) {
            Some(place) => Some(built.swap_remove(place)),
            None => self.fixed.iter().find(|fixed| fixed.stage == stage).map(|fixed| fixed.shader.clone()),
        };
        let (Some(vertex), Some(fragment)) = (shader(Stage::Vertex), shader(Stage::Fragment)) else {
            return Err(about(last)(super::unsupported("a program without a vertex or a fragment stage").into()));
        };
        if let Some((_, source)) = sources.iter().find(|(stage, _)| *stage == Stage::Fragment) {
            boundary::check(&vertex, &fragment, source, self.versions(sources)).map_err(about(Stage::Fragment))?;
        }
        if let [(_, first), (_, second)] = sources {
            let names: Vec<_> = fragment.inputs.iter().map(|input| input.name.as_str()).collect();
            let version = self.versions(sources);
            let in_first = portability::smooth_alone(first, second, &names, version).map(|note| (sources[0].0, note));
            let found =
                in_first.or_else(|| Some((sources[1].0, portability::smooth_alone(second, first, &names, version)?)));
            diagnostics.extend(found);
        }
        linked(&verdict, &stages, &own).map_err(about(last))?;
        Ok(Linked { vertex, fragment, diagnostics })
    }

    fn build(one: &Submitted<'_>, read: Option<Vec<String>>) -> Result<Shader, TranslationRefusal> {
        let spirv = one.second_pass()?;
        gate::check_words(&spirv, one.source, one.stage, &one.interface.set_uniforms())?;
        let how = Built { stage: one.stage, outputs: read, is_fixed: false, poisons: false };
        module::build(spirv, one.source, one.interface, how)
    }

    /// Names of the fragment stage that stand for others of the vertex stage, by a location that both give.
    fn placed(&self, sources: &[(Stage, &Source)]) -> Vec<(String, String)> {
        let text = |stage: Stage| {
            let handed_in = sources.iter().find(|(own, _)| *own == stage).map(|(_, source)| source.text.as_str());
            let own = self.fixed.iter().find(|fixed| fixed.stage == stage).and_then(|fixed| fixed.text.to_str().ok());
            handed_in.or(own)
        };
        if !sources.iter().any(|(_, source)| source.text.contains("location")) {
            return Vec::new();
        }
        let read = |stage| reference::interpreter::Program::compile(text(stage)?, stage).ok();
        let (Some(vertex), Some(fragment)) = (read(Stage::Vertex), read(Stage::Fragment)) else { return Vec::new() };
        let written = |location| vertex.outputs().iter().find(|output| output.location == location);
        let inputs = fragment.inputs().iter().filter(|input| input.location.is_some());
        let pairs = inputs.filter_map(|input| Some((input.name.clone(), written(input.location)?.name.clone())));
        pairs.filter(|(own, other)| own != other).collect()
    }

    /// The GLSL versions of the stages, the lowest of them.
    fn versions(&self, sources: &[(Stage, &Source)]) -> i32 {
        let own = self.fixed.iter().map(|fixed| text::version(fixed.text.to_str().unwrap_or_default()));
        own.chain(sources.iter().map(|(_, source)| source.version())).max().unwrap_or(0)
    }

    /// The interface as a stage sees it: what the vertex stage hands over is fed to the fragment stage. Between two stages that are
    /// handed in, names are free.
    fn seen_by(&self, stage: Stage) -> LinkedInterface {
        let mut interface = LinkedInterface { stage, ..self.interface.clone() };
        match stage {
            Stage::Fragment => {
                let written = self.fixed.iter().flat_map(|fixed| &fixed.shader.outputs);
                interface.inputs =
                    written.map(|output| Variable { name: output.name.clone(), ty: output.ty.clone() }).collect();
            }
            Stage::Vertex if self.fixed.is_none() => interface.outputs.clear(),
            Stage::Vertex => {}
        }
        interface
    }
}

/// Calls inputs by the names that the vertex stage has for them.
fn by_location(fragment: &mut Shader, placed: &[(String, String)]) {
    for input in &mut fragment.inputs {
        let rest = |own: &String| {
            let rest = input.name.strip_prefix(own.as_str())?;
            (rest.is_empty() || rest.starts_with(['.', '['])).then(|| rest.to_owned())
        };
        if let Some((other, rest)) = placed.iter().find_map(|(own, other)| Some((other, rest(own)?))) {
            input.name = format!("{other}{rest}");
        }
    }
}
