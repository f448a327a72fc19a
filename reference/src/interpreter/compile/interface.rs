//! What a program exchanges with its host: uniforms, inputs, outputs, blocks, built-in variables.

mod block;

use super::scope::Symbol;
use super::{Compiler, scope};
use crate::interpreter::code::{Interpolation, ProgramVariable, Slot};
use crate::interpreter::run::Undefined;
use crate::interpreter::syntax::{BaseType, Declaration, Name, Qualifiers, StorageQualifier};
use crate::interpreter::types::Type;
use crate::interpreter::{Refusal, Stage, WindowCoordinates, builtin};
use crate::text::both;

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
