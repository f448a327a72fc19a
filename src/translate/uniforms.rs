//! The blocks of uniforms that a module has: their bindings, and their members by name.

use super::spirv;
use naga::{AddressSpace, Handle, Module, ResourceBinding, Type, TypeInner};

/// A scalar, vector or matrix in a block of uniforms.
#[derive(Clone, Debug)]
pub struct UniformMember {
    /// Its path, such as `lights[1].colour` or, in a named block, `Light.ambient`.
    pub path: String,
    /// Its path without the block's name, where the block has no instance name.
    pub alias: Option<String>,
    /// Offset in its block, in bytes.
    pub offset: u32,
    /// Its type.
    pub ty: TypeInner,
}

impl UniformMember {
    /// The paths by which the program may set it.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        [Some(self.path.as_str()), self.alias.as_deref()].into_iter().flatten()
    }
}

/// A block of uniforms: binding 0, 1, … of group 0.
#[derive(Clone, Debug)]
pub struct UniformBlock {
    /// Its name.
    pub name: String,
    /// Its binding in group 0.
    pub binding: u32,
    /// Its size in bytes.
    pub size: u32,
    /// Whether it is OpenGL's default block, whose members the program sets by name.
    pub is_default: bool,
    /// Its members.
    pub members: Vec<UniformMember>,
}

/// Gives the uniform blocks the bindings 0, 1, … of group 0 and lists their members.
pub(super) fn bind_uniforms(module: &mut Module) -> Vec<UniformBlock> {
    let mut blocks = Vec::new();
    let types = &module.types;
    for (_, variable) in module.global_variables.iter_mut() {
        if variable.space != AddressSpace::Uniform {
            continue;
        }
        let binding = blocks.len() as u32;
        variable.binding = Some(ResourceBinding { group: 0, binding });
        blocks.push(block(types, variable, binding));
    }
    blocks
}

fn block(types: &naga::UniqueArena<Type>, variable: &naga::GlobalVariable, binding: u32) -> UniformBlock {
    let TypeInner::Struct { members, span } = &types[variable.ty].inner else {
        return UniformBlock { name: String::new(), binding, size: 16, is_default: false, members: Vec::new() };
    };
    let name = types[variable.ty].name.as_deref().unwrap_or_default();
    let is_default = name == spirv::DEFAULT_BLOCK;
    let mut found = Vec::new();
    for member in members {
        leaves(types, member.ty, member.name.clone().unwrap_or_default(), member.offset, &mut found);
    }
    for uniform in found.iter_mut().filter(|_| !is_default) {
        let path = format!("{name}.{}", uniform.path);
        let alias = std::mem::replace(&mut uniform.path, path);
        uniform.alias = Some(alias);
    }
    UniformBlock { name: name.to_owned(), binding, size: *span, is_default, members: found }
}

/// The scalars, vectors and matrices that a type consists of.
fn leaves(
    types: &naga::UniqueArena<Type>,
    ty: Handle<Type>,
    path: String,
    offset: u32,
    found: &mut Vec<UniformMember>,
) {
    match &types[ty].inner {
        TypeInner::Struct { members, .. } => {
            for member in members {
                let path = format!("{path}.{}", member.name.as_deref().unwrap_or_default());
                leaves(types, member.ty, path, offset + member.offset, found);
            }
        }
        TypeInner::Array { base, size: naga::ArraySize::Constant(length), stride } => {
            for index in 0..length.get() {
                leaves(types, *base, format!("{path}[{index}]"), offset + index * stride, found);
            }
        }
        inner => found.push(UniformMember { path, alias: None, offset, ty: inner.clone() }),
    }
}
