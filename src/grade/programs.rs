//! Homework of which a fragment stage is handed in, or several files: they are linked and run as one program.

use super::extended::Extended;
use super::judged::JudgedHandIn;
use super::{Graded, Grader, Order, map_lookup};
use crate::compare::{COLOUR_TOLERANCE, colour_difference};
use crate::cross_check;
use crate::diagnostic::{Diagnostic, DiagnosticStage as Speaker};
use crate::fault::Fault;
use crate::hand_in::HandedInFile;
use crate::language::Text;
use crate::render::{Captured, Pixel, RenderScene, Rendering, Sample};
use crate::report::{SourceInfo, UNEXPLAINED, Verdict};
use crate::source::{self, Source};
use crate::translate::{self, HomeworkProgram, Linked, LinkedInterface, ProgramRefusal, Stage, TranslationRefusal};
use reference::Assignment;
use reference::equation::{DISCARDED, Reads};
use reference::interpreter::{ProgramVariable, root};
use reference::probes::{Probe, ProbeSet, Spot};

/// The program of a homework, as far as it is not handed in.
#[derive(Debug)]
pub(super) struct Programs {
    program: HomeworkProgram,
    /// The frames' vertices after the fixed vertex stage, once they were needed.
    captured: Option<Captured>,
}

impl Programs {
    /// `None` for homework of one vertex shader that is a list of definitions: that goes a shorter way.
    pub fn of(assignment: &Assignment) -> Result<Option<Self>, Fault> {
        if assignment.equation.reads() == Reads::Attributes {
            return Ok(None);
        }
        let own = assignment.fixed.first().map(|fixed| (fixed.stage, fixed.text.as_str()));
        let program = HomeworkProgram::new(LinkedInterface::of(assignment)?, own)?;
        Ok(Some(Self { program, captured: None }))
    }
}

impl Grader {
    /// Judges the files of a program, in the order of the homework.
    pub(super) fn judge_program(
        &mut self,
        infos: Vec<SourceInfo>,
        files: &[HandedInFile],
        order: Order,
        drawn: &mut dyn FnMut(),
    ) -> Result<Graded, Fault> {
        let mut sources: Vec<(Stage, Source)> = Vec::new();
        let mut refused: Vec<Diagnostic> = Vec::new();
        for (file, slot) in files.iter().zip(&self.assignment.files) {
            let stage = slot.stage;
            match source::read_stage(stage, &file.name, &file.bytes) {
                Ok(source) => sources.push((stage, source)),
                Err(refusal) => refused.extend(in_file(&file.name, refusal.diagnostics)),
            }
        }
        if !refused.is_empty() {
            return Ok(self.rejected(infos, refused));
        }
        // Vertex before fragment, whatever the order of the files.
        sources.sort_by_key(|(stage, _)| *stage == Stage::Fragment);
        let name = |stage: Stage| {
            let found = sources.iter().find(|(own, _)| *own == stage).or(sources.last());
            found.map_or("", |(_, source)| source.facts.name.as_str())
        };
        let notes = || sources.iter().flat_map(|(_, source)| in_file(&source.facts.name, source.notes.clone()));
        let given: Vec<_> = sources.iter().map(|(stage, source)| (*stage, source)).collect();
        let Some(programs) = &self.programs else { return Err(no_program()) };
        let extended = Extended::of(&self.assignment, &self.probes, &given)?;
        let program = extended.as_ref().map_or(&programs.program, |extended| &extended.program);
        let linked = match program.translate(&given) {
            Ok(linked) => linked,
            Err(ProgramRefusal { refusal: TranslationRefusal::Fault(fault), .. }) => return Err(fault),
            Err(ProgramRefusal { stage, refusal: TranslationRefusal::Rejected(diagnostics) }) => {
                let diagnostics = in_file(name(stage), diagnostics).chain(notes()).collect();
                return Ok(self.rejected(infos, diagnostics));
            }
            Err(ProgramRefusal { stage, refusal: TranslationRefusal::Stopped(diagnostics) }) => {
                let diagnostics = in_file(name(stage), diagnostics).chain(notes()).collect();
                return Ok(self.refused(infos, Verdict::Stopped, diagnostics));
            }
        };
        let warnings = linked.diagnostics.iter().flat_map(|(stage, one)| in_file(name(*stage), vec![one.clone()]));
        let mut diagnostics: Vec<Diagnostic> = warnings.chain(notes()).collect();
        let probing = self.probing(order.seed);
        let own_fresh = extended.as_ref().map(|extended| extended.probes_of(&probing.fresh));
        let own_crossings = extended.as_ref().and_then(|extended| {
            let crossings = self.crossings.as_ref()?;
            Some(crossings.given(extended.probes_of(&crossings.probes)))
        });
        let own_scene = extended.as_ref().zip(own_fresh.as_ref()).map(|(extended, fresh)| {
            let across = own_crossings.iter().map(|crossings| &crossings.probes);
            let sets: Vec<&ProbeSet> = [&extended.probes, fresh].into_iter().chain(across).collect();
            RenderScene::of(&extended.assignment, &sets)
        });
        let rendering = self.render_linked(&linked, own_scene.as_ref().unwrap_or(&probing.scene))?;
        let stages = [(&linked.vertex, rendering.ran_out), (&linked.fragment, rendering.of_fragments.ran_out)];
        if let Some((shader, ran_out)) = stages.into_iter().find_map(|(shader, out)| Some((shader, out?))) {
            let error = Diagnostic { file: Some(name(shader.stage).to_owned()), ..shader.out_of_fuel(ran_out) };
            diagnostics.insert(0, error);
            return Ok(self.refused(infos, Verdict::Stopped, diagnostics));
        }
        drawn();
        let Some((_, source)) = sources.last() else { return Err(no_program()) };
        let own = extended.as_ref();
        let (assignment, probes) = own.map_or((&*self.assignment, &self.probes), |own| (&own.assignment, &own.probes));
        let fresh = own_fresh.as_ref().unwrap_or(&probing.fresh);
        let mut samples = samples(&linked, &rendering);
        if linked.fragment.shift.is_some() {
            pass_outside(probes.iter().chain(fresh.iter()), samples.iter_mut().flatten());
        }
        let drawing = Rendering { probe_samples: samples, undefined: None, ..rendering };
        let crossings = own_crossings.as_ref().or(self.crossings.as_ref());
        let (sources, rendering) = (&given[..], &drawing);
        let judged = JudgedHandIn { source, sources, assignment, probes, fresh, crossings, rendering };
        let mut report = self.report(judged, diagnostics, order.hints);
        if report.verdict == Verdict::Wrong {
            report.map_lookup = map_lookup::of(assignment, &given, &self.expected, &rendering.frames, &report.frames);
        }
        report.advice.extend(own.into_iter().flat_map(|own| own.notes(&given)));
        if report.mistakes.iter().any(|id| id == UNEXPLAINED) {
            report.diagnostics.extend(overlooked(assignment, &given, &linked));
        }
        report.cross_check = order.cross_check.then(|| {
            let samples = rendering.probe_samples.concat();
            cross_check::check_program(assignment, &given, probes, &samples)
        });
        report.sources = infos;
        Ok(Graded { report, frames: Some(drawing.frames) })
    }

    /// Draws a program. What the fixed vertex stage does with the frames is the same for every submission.
    fn render_linked(&mut self, linked: &Linked, scene: &RenderScene) -> Result<Rendering, Fault> {
        if !linked.vertex.is_fixed {
            return self.renderer.render_program(linked, scene);
        }
        let Some(programs) = &mut self.programs else { return Err(no_program()) };
        let captured = match &mut programs.captured {
            Some(captured) => captured,
            none => none.insert(self.renderer.capture(&linked.vertex, scene)?),
        };
        self.renderer.draw(captured, &linked.fragment, scene)
    }
}

/// What a wrong answer that nothing explains leaves alone: outputs without a value, and uniforms that a right answer reads.
fn overlooked(assignment: &Assignment, sources: &[(Stage, &Source)], linked: &Linked) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    let is_named = |name: &str| sources.iter().any(|(_, source)| source.words().any(|(_, word)| word == name));
    if linked.fragment.outputs.is_empty() && !linked.fragment.is_fixed && !is_named("discard") {
        let message = Text::new(
            "No output is given a value, so that there is no colour.",
            "出力変数に値が代入されていないため、色が決まりません。",
        );
        found.push(Diagnostic::warning(Speaker::Run, message));
    }
    let unwritten = linked.vertex.outputs.iter().filter(|output| !linked.vertex.is_fixed && !output.is_used);
    let mut unwritten: Vec<&str> = unwritten.map(|output| root(&output.name)).collect();
    unwritten.dedup();
    if let Some((_, source)) = sources.iter().find(|(stage, _)| *stage == Stage::Vertex) {
        found.extend(unwritten.into_iter().map(|name| {
            let message = Text::new(
                format!("`{name}` is given no value here, and the fragment shader reads it."),
                format!("`{name}` に値が代入されていませんが、フラグメントシェーダはこれを読みます。"),
            );
            let warning = translate::place(Diagnostic::warning(Speaker::Run, message), source, name);
            Diagnostic { file: Some(source.facts.name.clone()), ..warning }
        }));
    }
    let of_stage = |stage: &Stage| match stage {
        Stage::Vertex => assignment.pipeline.vertex.uniforms(),
        Stage::Fragment => assignment.pipeline.fragment.uniforms(),
    };
    // What students name themselves may have any name.
    let has_a_name = |uniform: &&ProgramVariable| !assignment.free.iter().any(|free| free.kind == uniform.kind);
    let read = sources.iter().flat_map(|(stage, _)| of_stage(stage)).filter(has_a_name);
    // The members of a block may have other names.
    let roots = read.map(|uniform| uniform.place.as_ref().map_or(root(&uniform.name), |place| &place.block));
    let mut unread: Vec<&str> = roots.filter(|root| !is_named(root)).collect();
    unread.dedup();
    if !unread.is_empty() {
        let names = unread.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>();
        let message = Text::new(
            format!(
                "The file does not read {}, which the program sets. The result has to follow when that changes.",
                names.join(", ")
            ),
            format!(
                "プログラムが値を渡す {} を使っていません。その値が変われば、結果も変わる必要があります。",
                names.join("、")
            ),
        );
        found.push(Diagnostic::warning(Speaker::Run, message));
    }
    found
}

fn no_program() -> Fault {
    Fault::new(Text::verbatim("the homework has no program"))
}

/// Diagnostics about places in a file.
fn in_file(name: &str, diagnostics: Vec<Diagnostic>) -> impl Iterator<Item = Diagnostic> {
    let name = name.to_owned();
    diagnostics.into_iter().map(move |diagnostic| match diagnostic.stage {
        // What is said of no file at all has no place in one.
        Speaker::Run if diagnostic.line.is_none() => diagnostic,
        _ => Diagnostic { file: Some(name.clone()), ..diagnostic },
    })
}

/// What a program shows at each probe: the position of its first corner, and the colour as a target of fixed point holds it.
fn samples(linked: &Linked, rendering: &Rendering) -> Vec<Vec<Sample>> {
    let seen = linked.fragment.outputs.iter().position(|output| output.location == 0).unwrap_or(0);
    let of_batch = |(batch, pixels): (usize, &Vec<Pixel>)| {
        let corners = rendering.probe_samples.get(batch);
        let position = |pixel: usize| {
            corners.and_then(|corners| corners.get(3 * pixel)).map_or([0.0, 0.0, 0.0, 1.0], |c| c.position)
        };
        let sample =
            |(number, pixel): (usize, &Pixel)| Sample { position: position(number), colour: shown(pixel, seen) };
        pixels.iter().enumerate().map(sample).collect()
    };
    rendering.pixels.iter().enumerate().map(of_batch).collect()
}

/// Has an answer that reads `gl_FragCoord`, and is right at all probes within the window, pass at those outside: no pixel lies there.
fn pass_outside<'p>(probes: impl Iterator<Item = &'p Probe>, samples: impl Iterator<Item = &'p mut Sample>) {
    let is_outside = |probe: &Probe| {
        let within = |axis: usize, spot: &Spot| (0.0..spot.window[axis]).contains(&spot.place[axis]);
        probe.spot.as_ref().is_some_and(|spot| !(within(0, spot) && within(1, spot)))
    };
    let (outside, within): (Vec<_>, Vec<_>) = probes.zip(samples).partition(|(probe, _)| is_outside(probe));
    if within.iter().any(|(probe, sample)| colour_difference(probe.colour, sample) > COLOUR_TOLERANCE) {
        return;
    }
    for (probe, sample) in outside {
        let colour = probe.colour.extend(f64::from(sample.colour[3])).as_vec4().to_array();
        *sample = Sample { position: probe.position.as_vec4().to_array(), colour };
    }
}

/// What a fragment shows; nothing where it is thrown away, or where nothing is ever written.
fn shown(pixel: &Pixel, seen: usize) -> [f32; 4] {
    match pixel.outputs.get(seen).filter(|_| !pixel.is_discarded) {
        Some(colour) => colour.map(|channel| channel.clamp(0.0, 1.0)),
        None => DISCARDED.extend(1.0).as_vec4().to_array(),
    }
}
