//! Homework of one vertex shader that is a list of definitions: its vertices are captured, and drawn by a fixed fragment stage.

use super::judged::JudgedHandIn;
use super::{Graded, Grader, Order, SeedScene};
use crate::cross_check;
use crate::fault::Fault;
use crate::hand_in::HandedInFile;
use crate::language::Text;
use crate::render::{DrawCall, RenderScene, Rendering, Sample};
use crate::report::{AdviceLine, CrossCheck, Report, SourceInfo, Verdict};
use crate::source::{self, ReadProgram, Source};
use crate::translate::{self, Shader, TranslationRefusal};
use std::rc::Rc;
use std::sync::Arc;

impl Grader {
    /// Judges the only file of the homework.
    pub(super) fn judge_vertex_shader(
        &mut self,
        sources: Vec<SourceInfo>,
        file: &HandedInFile,
        order: Order,
        drawn: &mut dyn FnMut(),
    ) -> Result<Graded, Fault> {
        let assignment = Arc::clone(&self.assignment);
        let array = assignment.files[0].program.as_ref().map(|program| &program.array);
        let read = match array {
            Some(array) => source::read_program(array, &file.name, &file.bytes)
                .map(|ReadProgram { source, listing }| (source, self.assignment.written_in(array, &listing))),
            None => source::read(&file.name, &file.bytes).map(|source| (source, Vec::new())),
        };
        let (source, written_in) = match read {
            Ok(read) => read,
            Err(refusal) => return Ok(self.rejected(sources, refusal.diagnostics)),
        };
        if let Some(error) = source::fragment_shader(&source, self.interface.colour()) {
            return Ok(self.refused(sources, Verdict::Rejected, vec![error]));
        }
        let mut translation = match translate::translate(&source, &self.interface) {
            Ok(translation) => translation,
            Err(TranslationRefusal::Rejected(mut diagnostics)) => {
                diagnostics.extend(source.notes);
                return Ok(self.rejected(sources, diagnostics));
            }
            Err(TranslationRefusal::Stopped(mut diagnostics)) => {
                diagnostics.extend(source.notes);
                return Ok(self.refused(sources, Verdict::Stopped, diagnostics));
            }
            Err(TranslationRefusal::Fault(fault)) => return Err(fault),
        };
        let mut diagnostics = std::mem::take(&mut translation.diagnostics);
        let shader = &translation.shader;
        diagnostics.extend(source.notes.iter().cloned());
        let mut probing = self.probing(order.seed);
        let mut at_rest = None;
        if !written_in.is_empty() {
            let [probes, fresh] =
                [&self.probes, &probing.fresh].map(|probes| self.assignment.probes_at_rest(probes, &written_in));
            let scene = RenderScene::of(&self.assignment, &[&probes, &fresh]);
            probing = Rc::new(SeedScene { fresh, scene });
            at_rest = Some(probes);
        }
        let SeedScene { fresh, scene } = &*probing;
        let mut rendering = self.renderer.render(shader, scene)?;
        if let Some(ran_out) = rendering.ran_out {
            diagnostics.insert(0, shader.out_of_fuel(ran_out));
            return Ok(self.refused(sources, Verdict::Stopped, diagnostics));
        }
        if rendering.undefined.is_some() && !self.shows_undefined(&source, shader, scene, &rendering)? {
            rendering.undefined = None;
        }
        drawn();
        let sources_given = [(translate::Stage::Vertex, &source)];
        let judged = JudgedHandIn {
            source: &source,
            sources: &sources_given,
            assignment: &self.assignment,
            probes: at_rest.as_ref().unwrap_or(&self.probes),
            fresh,
            crossings: self.crossings.as_ref(),
            rendering: &rendering,
        };
        let mut report = self.report(judged, diagnostics, order.hints);
        let said = array.and_then(|array| array.written_in.as_ref());
        let said = said.filter(|_| !written_in.is_empty() && report.verdict == Verdict::Correct);
        report.advice.extend(said.map(|text| AdviceLine {
            id: "number-written-in".into(),
            message: Text::new(&*text.en, &*text.ja),
            file: file.name.clone(),
            line: None,
        }));
        let cross_check = order.cross_check.then(|| self.cross_check(&source, scene, &rendering));
        let report = Report { sources, cross_check, ..report };
        Ok(Graded { report, frames: Some(rendering.frames) })
    }

    /// The second opinion on all vertices that were drawn.
    fn cross_check(&self, source: &Source, scene: &RenderScene, rendering: &Rendering) -> CrossCheck {
        let batches: Vec<&DrawCall> = scene.frames.iter().flatten().chain(&scene.probes).collect();
        let samples = rendering.frame_samples.iter().chain(&rendering.probe_samples);
        let samples: Vec<&[Sample]> = samples.map(Vec::as_slice).collect();
        cross_check::check(&source.text, self.interface.colour(), &self.assignment.interface, &batches, &samples)
    }

    /// Whether a colour depends on what GLSL leaves undefined.
    fn shows_undefined(
        &self,
        source: &Source,
        shader: &Shader,
        scene: &RenderScene,
        rendering: &Rendering,
    ) -> Result<bool, Fault> {
        let poisoned = match shader.poisoned(source, &self.interface) {
            Ok(poisoned) => self.renderer.compute(&poisoned, scene)?,
            Err(TranslationRefusal::Fault(fault)) => return Err(fault),
            // The gate bounds what it is given; what is a little larger is still only a doubt.
            Err(_) => return Ok(false),
        };
        let bits = |samples: &[Vec<Sample>]| -> Vec<[u32; 4]> {
            samples.iter().flatten().map(|sample| sample.colour.map(f32::to_bits)).collect()
        };
        Ok(bits(&poisoned.probe_samples) != bits(&rendering.probe_samples)
            || bits(&poisoned.frame_samples) != bits(&rendering.frame_samples))
    }
}
