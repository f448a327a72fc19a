//! What a program exchanges with its host: uniforms, inputs, outputs, blocks, built-in variables.

use super::scope::Symbol;
use super::{Compiler, scope};
use crate::interpreter::code::{BlockPlace, Interpolation, ProgramVariable, Slot};
use crate::interpreter::run::Undefined;
use crate::interpreter::syntax::{BaseType, Declaration, InterfaceBlock, Name, Qualifiers, StorageQualifier};
use crate::interpreter::types::{Struct, Type};
use crate::interpreter::{Refusal, Stage, WindowCoordinates, builtin, std140};
use crate::text::both;
use std::sync::Arc;

/// What a shader without a host's number reads: as many as OpenGL has of anything.
const MAX_LEAVES: usize = 1 << 16;

impl Compiler {
    /// A declaration outside of functions.
    pub(super) fn global(&mut self, declaration: &Declaration) -> Result<(), Refusal> {
        self.builder.line = declaration.line;
        let storage = self.storage(declaration.qualifiers.storage);
        match storage {
            StorageQualifier::Plain | StorageQualifier::Constant => return self.plain_variables(declaration),
            StorageQualifier::Shared => {
                for variable in &declaration.variables {
                    self.scopes.declare(
                        Name::clone(&variable.name),
                        Symbol::Unsupported(["shared memory is not supported", "共有メモリには対応していません"]),
                    );
                }
                return Ok(());
            }
            _ => {}
        }
        if storage == StorageQualifier::Uniform && is_opaque(declaration) {
            for variable in &declaration.variables {
                self.scopes.declare(
                    Name::clone(&variable.name),
                    Symbol::Unsupported([
                        "this kind of texture or image is not supported",
                        "この種類のテクスチャや画像には対応していません",
                    ]),
                );
            }
            return Ok(());
        }
        let base = self.type_of(&declaration.kind)?;
        let Qualifiers { interpolation, location, .. } = declaration.qualifiers;
        for variable in &declaration.variables {
            self.builder.line = variable.line;
            let kind = self.arrays_of(base.clone(), &variable.lengths)?;
            if variable.name.starts_with("gl_") {
                self.redeclare(&variable.name, kind, declaration.qualifiers.window)?;
                continue;
            }
            let slot = self.allocate(&kind)?;
            self.exchange(storage, &variable.name, &kind, slot)?;
            self.qualify(storage, interpolation, location);
            if let Some(value) = &variable.value {
                let value = self.untraced(|compiler| compiler.initial_value(value, &kind))?;
                for (slot, &from) in (slot..).zip(&value.slots) {
                    let known = self.builder.known(from);
                    let known = known.ok_or_else(|| {
                        self.invalid(both(
                            "a uniform's value must be constant",
                            "uniform 変数の初期値は定数式でなければなりません",
                        ))
                    })?;
                    self.defaults.push((slot, known));
                }
            }
            self.scopes.declare(Name::clone(&variable.name), Symbol::variable(kind, slot));
        }
        Ok(())
    }

    fn storage(&self, storage: StorageQualifier) -> StorageQualifier {
        match (storage, self.stage) {
            (StorageQualifier::Varying, Stage::Vertex) => StorageQualifier::Output,
            (StorageQualifier::Varying, Stage::Fragment) => StorageQualifier::Input,
            (other, _) => other,
        }
    }

    fn outside(&self, name: &str, kind: &Type, slot: Slot) -> ProgramVariable {
        let (interpolation, location) = (Interpolation::Smooth, None);
        ProgramVariable {
            name: name.to_owned(),
            written: name.to_owned(),
            kind: kind.clone(),
            slot,
            line: self.builder.line,
            interpolation,
            location,
            place: None,
        }
    }

    /// Tells the host of a variable.
    fn exchange(&mut self, storage: StorageQualifier, name: &str, kind: &Type, slot: Slot) -> Result<(), Refusal> {
        let variable = self.outside(name, kind, slot);
        match storage {
            StorageQualifier::Input => self.inputs.push(variable),
            StorageQualifier::Output => self.outputs.push(variable),
            StorageQualifier::Uniform => self.leaves(name, kind, slot)?,
            _ => {}
        }
        Ok(())
    }

    /// Notes how the last input or output is interpolated, and where the program wants it.
    fn qualify(&mut self, storage: StorageQualifier, interpolation: Interpolation, location: Option<u32>) {
        if let Some(last) = self.last_exchanged(storage) {
            (last.interpolation, last.location) = (interpolation, location);
        }
    }

    /// The last input or output.
    fn last_exchanged(&mut self, storage: StorageQualifier) -> Option<&mut ProgramVariable> {
        match storage {
            StorageQualifier::Input => self.inputs.last_mut(),
            StorageQualifier::Output => self.outputs.last_mut(),
            _ => None,
        }
    }

    /// The parts of a uniform that a host sets, each with its path.
    fn leaves(&mut self, path: &str, kind: &Type, slot: Slot) -> Result<(), Refusal> {
        if self.uniforms.len() > MAX_LEAVES {
            return Err(self.limit(both("there are too many uniforms", "uniform 変数が多すぎます")));
        }
        match kind {
            Type::Struct(structure) => {
                let mut slot = slot;
                for (name, kind) in &structure.members {
                    self.leaves(&format!("{path}.{name}"), kind, slot)?;
                    slot += kind.slots().unwrap_or(0) as Slot;
                }
            }
            Type::Array(element, length) => {
                let size = element.slots().unwrap_or(0) as Slot;
                for index in 0..length.unwrap_or(scope::UNSIZED) {
                    self.leaves(&format!("{path}[{index}]"), element, slot + index as Slot * size)?;
                }
            }
            _ => {
                let variable = self.outside(path, kind, slot);
                self.uniforms.push(variable);
            }
        }
        Ok(())
    }

    /// An interface block, with or without a name for the program.
    pub(super) fn interface_block(&mut self, block: &InterfaceBlock) -> Result<(), Refusal> {
        self.builder.line = block.line;
        let storage = self.storage(block.qualifiers.storage);
        if storage == StorageQualifier::Shared {
            return self.storage_buffer(block);
        }
        let members = self.member_types(&block.members)?;
        let is_laid_out = !block.qualifiers.is_placed && !block.members.iter().any(|own| own.qualifiers.is_placed);
        let offsets = if is_laid_out { std140::offsets(&members) } else { Vec::new() };
        let first = self.uniforms.len();
        let each = |member: &Declaration| -> Vec<(Interpolation, u32)> {
            member.variables.iter().map(|own| (member.qualifiers.interpolation, own.line)).collect()
        };
        let ways: Vec<(Interpolation, u32)> = block.members.iter().flat_map(each).collect();
        self.builder.line = block.line;
        if &*block.name == "gl_PerVertex" {
            return members
                .into_iter()
                .try_for_each(|(name, kind)| self.redeclare(&Name::from(name), kind, WindowCoordinates::default()));
        }
        let Some((instance, lengths)) = &block.instance else {
            for ((name, kind), (interpolation, line)) in members.into_iter().zip(ways) {
                self.builder.line = line;
                let slot = self.allocate(&kind)?;
                self.exchange(storage, &name, &kind, slot)?;
                self.qualify(storage, interpolation, None);
                self.scopes.declare(Name::from(name), Symbol::variable(kind, slot));
            }
            self.place_parts(first, block, &offsets);
            return Ok(());
        };
        self.structures += 1;
        let structure = Struct::new(block.name.to_string(), self.structures, members);
        let one = Type::Struct(Arc::new(structure));
        let kind = self.arrays_of(one.clone(), lengths)?;
        let slot = self.allocate(&kind)?;
        if storage == StorageQualifier::Uniform {
            self.leaves(&block.name, &kind, slot)?;
            self.place_parts(first, block, &offsets);
        } else {
            self.block_parts(storage, [&block.name, instance], &kind, slot, &ways)?;
            if matches!(kind, Type::Struct(_)) {
                self.instances.push(Name::clone(instance));
            }
        }
        self.scopes.declare(Name::clone(instance), Symbol::variable(kind, slot));
        Ok(())
    }

    /// Tells the host of the members of an input or output block, or of each block of an array: by the name of the block, and by that which
    /// the program has for it.
    fn block_parts(
        &mut self,
        storage: StorageQualifier,
        [path, written]: [&str; 2],
        kind: &Type,
        slot: Slot,
        ways: &[(Interpolation, u32)],
    ) -> Result<(), Refusal> {
        let mut slot = slot;
        match kind {
            Type::Struct(structure) => {
                for ((name, kind), (interpolation, line)) in structure.members.iter().zip(ways) {
                    self.builder.line = *line;
                    self.exchange(storage, &format!("{path}.{name}"), kind, slot)?;
                    self.qualify(storage, *interpolation, None);
                    if let Some(last) = self.last_exchanged(storage) {
                        last.written = format!("{written}.{name}");
                    }
                    slot += kind.slots().unwrap_or(0) as Slot;
                }
            }
            Type::Array(element, length) => {
                for index in 0..length.unwrap_or(scope::UNSIZED) {
                    let names = [path, written].map(|name| format!("{name}[{index}]"));
                    self.block_parts(storage, [&names[0], &names[1]], element, slot, ways)?;
                    slot += element.slots().unwrap_or(0) as Slot;
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// Says where the uniforms from `first` on lie, which are the parts of a block; those of several blocks in an array have no place.
    fn place_parts(&mut self, first: usize, block: &InterfaceBlock, offsets: &[u32]) {
        let Some(parts) = self.uniforms.get_mut(first..).filter(|parts| parts.len() == offsets.len()) else { return };
        let is_std140 = block.qualifiers.is_std140;
        for (part, offset) in parts.iter_mut().zip(offsets) {
            part.place = Some(BlockPlace { block: block.name.to_string(), offset: *offset, is_std140 });
        }
    }

    fn storage_buffer(&mut self, block: &InterfaceBlock) -> Result<(), Refusal> {
        let unsupported =
            || Symbol::Unsupported(["storage buffers are not supported", "ストレージバッファには対応していません"]);
        if let Some((instance, _)) = &block.instance {
            self.scopes.declare(Name::clone(instance), unsupported());
            return Ok(());
        }
        for variable in block.members.iter().flat_map(|member| &member.variables) {
            self.scopes.declare(Name::clone(&variable.name), unsupported());
        }
        Ok(())
    }

    /// A built-in variable that the program declares again, perhaps with a length or a way to count.
    fn redeclare(&mut self, name: &Name, kind: Type, window: WindowCoordinates) -> Result<(), Refusal> {
        let known = builtin::variable(name, self.stage);
        let (storage, known) = known.ok_or_else(|| {
            self.limit(both(format!("there is no `{name}` here"), format!("ここでは `{name}` を使えません")))
        })?;
        // Where it is not written the depth is the surface's: it is declared where it is used.
        if &**name == "gl_FragDepth" {
            return Ok(());
        }
        let kind = if kind.slots().is_some() { kind } else { known };
        let is_place = &**name == WindowCoordinates::default().input();
        self.built_in(name, if is_place { window.input() } else { name }, storage, kind)
    }

    /// Declares a built-in variable where the program uses it.
    pub(super) fn declare_built_in(&mut self, name: &Name) -> Result<(), Refusal> {
        if let Some(value) = builtin::constant(name, self.version) {
            let value = crate::interpreter::code::CodeConstant { value: f64::from(value), is_float: false };
            let slot = self.builder.allocate_constants(&[value])?;
            self.scopes.declare_globally(Name::clone(name), Symbol::variable(Type::INT, slot));
            return Ok(());
        }
        let known = builtin::variable(name, self.stage);
        let (storage, kind) = known.ok_or_else(|| {
            self.limit(both(
                format!("there is no variable `{name}` here"),
                format!("ここでは変数 `{name}` を使えません"),
            ))
        })?;
        self.built_in(name, name, storage, kind)
    }

    /// Declares a built-in variable, which the host calls `outside`.
    fn built_in(&mut self, name: &Name, outside: &str, storage: StorageQualifier, kind: Type) -> Result<(), Refusal> {
        let slot = self.allocate(&kind)?;
        self.exchange(storage, outside, &kind, slot)?;
        // As long as a host says nothing else, the depth range is that of OpenGL's initial state.
        if &**name == "gl_DepthRange" {
            self.defaults.extend([(slot + 1, 1.0), (slot + 2, 1.0)]);
        }
        self.scopes.declare_globally(Name::clone(name), Symbol::variable(kind, slot));
        Ok(())
    }

    /// Leaves the results of a function without a value until they get one.
    pub(super) fn undefine_result(&mut self, index: usize) {
        let function = &self.functions[index];
        let (slot, size) = (function.result, function.signature.result.slots().unwrap_or(0));
        self.builder.undefine(slot, size, Undefined::NoResult);
    }
}

/// Whether a uniform is of a kind that this interpreter does not know: it may be declared, and not used.
fn is_opaque(declaration: &Declaration) -> bool {
    let BaseType::Named(name) = &declaration.kind.base else { return false };
    let is_named = ["sampler", "image", "atomic_uint", "texture"].iter().any(|word| name.contains(word));
    is_named && Type::named(name).is_none()
}
