//! SPIR-V → naga module with the entry point rebuilt and the uniforms found by name.

use super::entry::{self, Attribute};
use super::fuel::{self, Meter};
use super::gate::{self, Costs};
use super::opaque;
use super::spirv::{self, Lines, Reworked, Unset, Unworkable};
use super::undefined;
use super::{Interface, Refusal, Variable};
use crate::diagnostic::Diagnostic;
use crate::fault::Fault;
use crate::language::Text;
use crate::source::Source;
use naga::{AddressSpace, Handle, Module, ResourceBinding, Type, TypeInner};

/// A uniform variable of the default block, or a member of a block of the student's own.
#[derive(Clone, Debug)]
pub struct Uniform {
    /// Its name.
    pub name: String,
    /// Offset in its block, in bytes.
    pub offset: u32,
    /// Its type.
    pub ty: TypeInner,
}

/// A block of uniforms: binding 0, 1, … of group 0.
#[derive(Clone, Debug)]
pub struct UniformBlock {
    /// Its binding in group 0.
    pub binding: u32,
    /// Its size in bytes.
    pub size: u32,
    /// Whether it is OpenGL's default block, whose members the program sets by name.
    pub is_default: bool,
    /// Its members.
    pub members: Vec<Uniform>,
}

/// A vertex shader that wgpu can run.
#[derive(Clone, Debug)]
pub struct Shader {
    /// The module; its entry point is `main`.
    pub module: Module,
    /// The attributes that it reads.
    pub attributes: Vec<Attribute>,
    /// Its uniform blocks in order of binding.
    pub uniforms: Vec<UniformBlock>,
    /// Uniforms that it reads and the program does not set.
    pub(super) unset: Vec<Unset>,
    /// From a span of the module to the line of the student's file.
    pub lines: Lines,
    /// Its loops, numbered from 1 where the capture's header names one.
    pub meters: Vec<Meter>,
    /// What the compiler wrote.
    written: Vec<u32>,
}

impl Shader {
    /// The same shader, but where its text leaves a result undefined (see [`super::undefined`]) it computes a number that
    /// shows in whatever depends on it.
    pub fn poisoned(&self, source: &Source, interface: &Interface) -> Result<Self, Refusal> {
        build(self.written.clone(), source, interface, true)
    }

    /// The module as the compiler wrote it, without fuel, capture and whatever else ggrade adds: to measure what they cost.
    /// Its attributes have locations in the interface's order, its output location 0, its uniforms binding 0 of group 0.
    pub fn plain(&self, interface: &Interface) -> Result<Module, Fault> {
        let set: Vec<_> = interface.uniforms.iter().map(|variable| variable.name.as_str()).collect();
        let mut module = parse(&spirv::rework(&self.written, &set, false).map_err(damaged)?.words)?;
        bind_uniforms(&mut module);
        entry::locate(&mut module, interface);
        Ok(module)
    }

    /// What to say where the capture's header is not 0.
    pub fn out_of_fuel(&self, ran_out: u32) -> Diagnostic {
        fuel::out_of_fuel(&self.meters, ran_out)
    }
}

/// Makes the module. A fault here is our limit, not the student's.
pub(super) fn build(
    written: Vec<u32>,
    source: &Source,
    interface: &Interface,
    poisons: bool,
) -> Result<Shader, Refusal> {
    let names = |variables: &'_ [Variable]| variables.iter().map(|variable| variable.name.clone()).collect::<Vec<_>>();
    let (inputs, set) = (names(&interface.inputs), names(&interface.uniforms));
    let set: Vec<&str> = set.iter().map(String::as_str).collect();
    let Reworked { words, lines, unset } = spirv::rework(&written, &set, poisons).map_err(refusal)?;
    let mut module = parse(&words)?;
    let costs = Costs::of(&module);
    gate::check_module(&module, &costs, &lines, source)?;
    let zero = opaque::hide_conditions(&mut module);
    let (meters, gauge) = fuel::meter(&mut module, &costs, &written, &lines);
    let undefined = undefined::watch(&mut module, &lines);
    let inputs: Vec<&str> = inputs.iter().map(String::as_str).collect();
    let hooks = entry::Hooks { gauge, zero, undefined };
    let attributes = entry::rebuild(&mut module, &inputs, &interface.output.name, &hooks);
    let uniforms = bind_uniforms(&mut module);
    Ok(Shader { module, attributes, uniforms, unset, lines, meters, written })
}

fn refusal(unworkable: Unworkable) -> Refusal {
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
    let module = naga::front::spv::Frontend::new(words.iter().copied(), &options)
        .parse()
        .map_err(|error| unsupported(&error.to_string()))?;
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

/// Gives the uniform blocks the bindings 0, 1, … of group 0 and lists their members.
fn bind_uniforms(module: &mut Module) -> Vec<UniformBlock> {
    let mut blocks = Vec::new();
    let types = &module.types;
    for (_, variable) in module.global_variables.iter_mut() {
        if variable.space != AddressSpace::Uniform {
            continue;
        }
        let binding = blocks.len() as u32;
        variable.binding = Some(ResourceBinding { group: 0, binding });
        blocks.push(block(types, variable.ty, binding));
    }
    blocks
}

fn block(types: &naga::UniqueArena<Type>, ty: Handle<Type>, binding: u32) -> UniformBlock {
    let TypeInner::Struct { members, span } = &types[ty].inner else {
        return UniformBlock { binding, size: 16, is_default: false, members: Vec::new() };
    };
    UniformBlock {
        binding,
        size: *span,
        is_default: types[ty].name.as_deref() == Some(spirv::DEFAULT_BLOCK),
        members: members
            .iter()
            .map(|member| Uniform {
                name: member.name.clone().unwrap_or_default(),
                offset: member.offset,
                ty: types[member.ty].inner.clone(),
            })
            .collect(),
    }
}

/// Makes the module of the assignment's fixed fragment stage; it reads `varying` at location 0.
pub(super) fn build_fixed_stage(words: &[u32], varying: &str) -> Result<Module, Fault> {
    let mut module = parse(&spirv::rework(words, &[], false).map_err(damaged)?.words)?;
    for argument in &mut module.entry_points[0].function.arguments {
        if let Some(naga::Binding::Location { location, .. }) = &mut argument.binding
            && argument.name.as_deref() == Some(varying)
        {
            *location = 0;
        }
    }
    Ok(module)
}
