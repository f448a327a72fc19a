//! SPIR-V → naga module with the entry point rebuilt.

use super::blocks::{self, Misplaced};
use super::entry::{self, AttributePart, CAPTURE_SLOT, StageVariable};
use super::fuel::{self, LoopFuel};
use super::gate::{self, Costs};
use super::opaque;
use super::spirv::{self, LineTable, Reworked, UniformVariables, Unworkable};
use super::undefined;
use super::uniforms::{UniformBlock, bind_uniforms};
use super::{LinkedInterface, TranslationRefusal};
use crate::diagnostic::Diagnostic;
use crate::fault::Fault;
use crate::ffi::glslang::Stage;
use crate::language::Text;
use crate::source::Source;
use naga::{Module, TypeInner};
use reference::assignment::Input;
use reference::interpreter::{Program, WindowCoordinates};

/// A stage that wgpu can run.
#[derive(Clone, Debug)]
pub struct Shader {
    /// Which stage.
    pub stage: Stage,
    /// The module; its entry point is `main`.
    pub module: Module,
    /// What it is fed, at locations from 0 on.
    pub inputs: Vec<StageVariable>,
    /// What it hands over: a vertex stage in the slots of a captured record behind the position, a fragment stage to the
    /// targets of their locations.
    pub outputs: Vec<StageVariable>,
    /// Whether it is the homework's own, which nothing watches.
    pub is_fixed: bool,
    /// The location of what is to be added to `gl_FragCoord`, where a fragment stage reads that.
    pub shift: Option<u32>,
    /// How it counts places in the window.
    pub window: WindowCoordinates,
    /// Its uniform blocks in order of binding.
    pub uniforms: Vec<UniformBlock>,
    /// Whether it reads textures, which are bound at [`TEXTURES`](super::TEXTURES).
    pub reads_textures: bool,
    /// What its blocks have elsewhere than the homework.
    pub(super) misplaced: Vec<Misplaced>,
    /// Its uniforms as its text declares them.
    pub(super) known: UniformVariables,
    /// From a span of the module to the line of the student's file.
    pub lines: LineTable,
    /// Its loops, numbered from 1 where the capture's header names one.
    pub meters: Vec<LoopFuel>,
    /// What the compiler wrote.
    written: Vec<u32>,
}

impl Shader {
    /// The same shader, but where its text leaves a result undefined (see [`super::undefined`]) it computes a number that
    /// shows in whatever depends on it.
    pub fn poisoned(&self, source: &Source, interface: &LinkedInterface) -> Result<Self, TranslationRefusal> {
        build(self.written.clone(), source, interface, self.as_built(true))
    }

    /// The module as the compiler wrote it, without fuel, capture and whatever else ggrade adds: to measure what they cost.
    /// Its attributes have locations in the interface's order, its output location 0, its uniforms binding 0 of group 0.
    pub fn plain(&self, interface: &LinkedInterface) -> Result<Module, Fault> {
        let how = spirv::How { set: &interface.set_uniforms(), ..spirv::How::default() };
        let mut module = parse(&spirv::rework(&self.written, how).map_err(damaged)?.words)?;
        bind_uniforms(&mut module);
        entry::locate(&mut module, interface);
        Ok(module)
    }

    /// How it was built, but poisoned or not.
    fn as_built(&self, poisons: bool) -> Built {
        let outputs = Some(self.outputs.iter().map(|output| output.name.clone()).collect());
        Built { stage: self.stage, outputs, is_fixed: self.is_fixed, poisons }
    }

    /// Whether a fragment stage gives a depth of its own.
    pub fn writes_depth(&self) -> bool {
        let results = self.module.entry_points.iter().filter_map(|entry| entry.function.result.as_ref());
        let is_depth = |member: &naga::StructMember| {
            matches!(member.binding, Some(naga::Binding::BuiltIn(naga::BuiltIn::FragDepth)))
        };
        results.into_iter().any(|result| match &self.module.types[result.ty].inner {
            TypeInner::Struct { members, .. } => members.iter().any(is_depth),
            _ => false,
        })
    }

    /// Whether a fragment stage takes derivatives.
    pub fn has_derivatives(&self) -> bool {
        let own = self.module.entry_points.iter().map(|entry| &entry.function);
        let all = own.chain(self.module.functions.iter().map(|(_, function)| function));
        let mut expressions = all.flat_map(|function| function.expressions.iter());
        expressions.any(|(_, expression)| matches!(expression, naga::Expression::Derivative { .. }))
    }

    /// Bytes of a captured vertex: its position and its outputs.
    pub fn record_stride(&self) -> u64 {
        (self.outputs.len() as u64 + 1) * CAPTURE_SLOT
    }

    /// What to say where the capture's header is not 0.
    pub fn out_of_fuel(&self, ran_out: u32) -> Diagnostic {
        fuel::out_of_fuel(&self.meters, ran_out, self.stage)
    }
}

/// An input that every vertex has beside those of the homework: its place in its mesh.
pub const VERTEX_NUMBER: &str = "gl_VertexID";
/// Another: the number of the instance that it is drawn in.
pub const INSTANCE_NUMBER: &str = "gl_InstanceID";

/// How a stage is built.
#[derive(Clone, Debug)]
pub(super) struct Built {
    pub stage: Stage,
    /// The outputs of a vertex stage that are captured, by path; all where none are named.
    pub outputs: Option<Vec<String>>,
    /// Whether it is the homework's own, which needs no watching.
    pub is_fixed: bool,
    /// Whether what is undefined becomes a number that shows.
    pub poisons: bool,
}

/// Calls inputs of a vertex stage as the homework does, of which only the location is the homework's.
fn name_by_location(inputs: &mut [AttributePart], source: &Source, interface: &LinkedInterface) {
    let is_known = |part: &AttributePart| interface.inputs.iter().any(|input| input.name == part.attribute.name);
    if inputs.iter().all(is_known) || !source.text.contains("location") {
        return;
    }
    let Ok(program) = Program::compile(&source.text, Stage::Vertex) else { return };
    for part in inputs {
        let own = program.inputs().iter().find(|own| own.name == part.attribute.name);
        if let Some(fed) = own.and_then(|own| Input::fed(&interface.attributes, &program, own)) {
            part.attribute.name.clone_from(&fed.name);
        }
    }
}

/// Makes the module. A fault here is our limit, not the student's.
pub(super) fn build(
    written: Vec<u32>,
    source: &Source,
    interface: &LinkedInterface,
    how: Built,
) -> Result<Shader, TranslationRefusal> {
    let has_textures = interface.uniforms.iter().any(|uniform| uniform.ty.contains("sampler"));
    let (set, alike) = (&interface.set_uniforms(), interface.alike);
    let rework = spirv::How { set, has_textures, alike, is_split: true, poisons: how.poisons };
    let Reworked { words, lines, uniforms: known, io, reads_textures, window } =
        spirv::rework(&written, rework).map_err(refusal)?;
    let mut module = parse(&words)?;
    let [mut inputs, mut outputs] = [true, false].map(|inputs| entry::parts(&module, &io, inputs));
    let mut costs = Costs::of(&module);
    costs.copy(&inputs, &outputs);
    gate::check_module(&module, &costs, &lines, source, how.stage)?;
    let mut meters = Vec::new();
    let mut hooks = entry::Hooks { gauge: None, zero: None, undefined: None };
    if !how.is_fixed {
        hooks.zero = opaque::hide_conditions(&mut module, &io);
        (meters, hooks.gauge) = fuel::meter(&mut module, &costs, &written, &lines);
        hooks.undefined = undefined::watch(&mut module, &lines);
    }
    let shift = match how.stage {
        Stage::Vertex => {
            entry::leave_unset(&mut module, &inputs);
            if !how.is_fixed {
                name_by_location(&mut inputs, source, interface);
            }
            let is_fed = |part: &AttributePart| {
                let name = &part.attribute.name;
                [VERTEX_NUMBER, INSTANCE_NUMBER].contains(&name.as_str())
                    || interface.inputs.iter().any(|input| input.name == *name)
            };
            inputs.retain(is_fed);
            if let Some(wanted) = &how.outputs {
                let place = |part: &AttributePart| wanted.iter().position(|name| *name == part.attribute.name);
                outputs.retain(|part| place(part).is_some());
                outputs.sort_by_key(place);
            }
            entry::rebuild_vertex(&mut module, &inputs, &outputs, &hooks);
            None
        }
        Stage::Fragment => {
            inputs.retain(|part| part.attribute.is_used);
            outputs.retain(|part| part.attribute.is_used);
            entry::rebuild_fragment(&mut module, &inputs, &outputs, (!how.is_fixed).then_some(&hooks), window)
        }
    };
    let mut uniforms = bind_uniforms(&mut module);
    let misplaced = blocks::lay_out(&mut uniforms, &known.declared, &interface.placed);
    let mut inputs: Vec<StageVariable> = inputs.into_iter().map(|part| part.attribute).collect();
    // The compiler's automatic locations may collide with the student's own.
    (0..).zip(&mut inputs).for_each(|(location, input)| input.location = location);
    let outputs = outputs.into_iter().map(|part| part.attribute).collect();
    let Built { stage, is_fixed, .. } = how;
    let shader = Shader {
        stage,
        module,
        inputs,
        outputs,
        is_fixed,
        shift,
        window,
        uniforms,
        reads_textures,
        misplaced,
        known,
        lines,
        meters,
        written,
    };
    Ok(shader)
}

fn refusal(unworkable: Unworkable) -> TranslationRefusal {
    match unworkable {
        Unworkable::Damaged => damaged(unworkable).into(),
        Unworkable::Cases(line) => gate::too_many_cases(line),
    }
}

fn damaged(unworkable: Unworkable) -> Fault {
    unsupported(&format!("the words of the compiler: {unworkable:?}"))
}

fn parse(words: &[u32]) -> Result<Module, Fault> {
    let options = naga::front::spv::Options {
        adjust_coordinate_space: false,
        strict_capabilities: false,
        block_ctx_dump_prefix: None,
    };
    // naga's own function, unlike its generic reader of words, is compiled in naga and not once more here.
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    let module = naga::front::spv::parse_u8_slice(&bytes, &options).map_err(|error| unsupported(&error.to_string()))?;
    if module.entry_points.is_empty() {
        return Err(unsupported("no entry point"));
    }
    Ok(module)
}

/// The answer to valid GLSL that this route cannot take.
pub fn unsupported(detail: &str) -> Fault {
    Fault::new(Text::new(
        format!("valid GLSL, not supported by ggrade: {detail}"),
        format!("GLSL としては正しいのですが、ggrade が対応していない書き方です: {detail}"),
    ))
    .remedy(Text::new(
        "This is a limit of ggrade and costs no points: please show the file to the course's staff. \
         docs/limits.md lists what is not supported.",
        "これは ggrade 側の制限で、減点にはなりません。ファイルを担当教員に見せてください。\
         対応していない書き方は docs/limits.md にあります。",
    ))
}
