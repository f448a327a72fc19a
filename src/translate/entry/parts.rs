//! The scalars and vectors that inputs and outputs consist of.

use crate::translate::build::Build;
use crate::translate::interface::type_name;
use crate::translate::spirv::{InputInterpolation, InterfaceQualifiers, Io};
use naga::{Expression, GlobalVariable, Handle, Module, ScalarKind, Type, TypeInner};

/// A scalar or vector that goes into a stage or comes out of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StageVariable {
    /// Its path in the student's file, such as `vc`, `tangents[1]` or, in a block, `Surface.normal`.
    pub name: String,
    /// Its location in the module.
    pub location: u32,
    /// Its GLSL type, such as `vec4`.
    pub ty: String,
    /// What its components are, where it is a scalar or vector.
    pub kind: Option<ScalarKind>,
    /// Bytes of a component.
    pub width: u8,
    /// How many components it has.
    pub size: u8,
    /// Its qualifiers.
    pub qualifiers: InterfaceQualifiers,
    /// Whether the stage reads or writes it.
    pub is_used: bool,
}

/// Such a part, and where it stands in the module.
#[derive(Clone, Debug)]
pub(in crate::translate) struct AttributePart {
    pub attribute: StageVariable,
    pub ty: Handle<Type>,
    variable: Handle<GlobalVariable>,
    /// Members and elements to it from the variable.
    chain: Vec<u32>,
}

impl AttributePart {
    /// A pointer to it.
    pub fn pointer(&self, build: &mut Build<'_>) -> Handle<Expression> {
        let variable = build.leaf(Expression::GlobalVariable(self.variable));
        self.chain.iter().fold(variable, |base, index| build.member(base, *index))
    }

    /// The variable that it is all of.
    pub fn whole(&self) -> Option<Handle<GlobalVariable>> {
        self.chain.is_empty().then_some(self.variable)
    }
}

/// Whether the variable is an input of the student's own.
pub(in crate::translate) fn is_input(io: &[Io], variable: &GlobalVariable) -> bool {
    io.iter().any(|io| io.is_input && variable.name.as_ref() == Some(&io.variable))
}

/// The parts of the inputs or of the outputs, in the order of the text.
pub(in crate::translate) fn parts(module: &Module, io: &[Io], inputs: bool) -> Vec<AttributePart> {
    let mut found = Vec::new();
    for io in io.iter().filter(|io| io.is_input == inputs && !io.is_second) {
        let variable =
            module.global_variables.iter().find(|(_, variable)| variable.name.as_ref() == Some(&io.variable));
        let Some((variable, declared)) = variable else { continue };
        let first = found.len();
        walk(
            module,
            declared.ty,
            &PartWalk { io, variable, path: io.name.clone(), chain: Vec::new(), member: None },
            &mut found,
        );
        for (number, part) in (0..).zip(&mut found[first..]) {
            part.attribute.location = io.location + number;
        }
    }
    found
}

struct PartWalk<'a> {
    io: &'a Io,
    variable: Handle<GlobalVariable>,
    path: String,
    chain: Vec<u32>,
    /// Which member of the outermost structure it is in.
    member: Option<u32>,
}

impl PartWalk<'_> {
    fn into(&self, index: u32, path: String) -> Self {
        PartWalk { path, chain: [&self.chain[..], &[index]].concat(), ..*self }
    }
}

fn walk(module: &Module, ty: Handle<Type>, at: &PartWalk<'_>, found: &mut Vec<AttributePart>) {
    match &module.types[ty].inner {
        TypeInner::Struct { members, .. } => {
            for (index, member) in (0..).zip(members) {
                let path = format!("{}.{}", at.path, member.name.as_deref().unwrap_or_default());
                let member_of = PartWalk { member: at.member.or(Some(index)), ..at.into(index, path) };
                walk(module, member.ty, &member_of, found);
            }
        }
        TypeInner::Array { base, size: naga::ArraySize::Constant(length), .. } => {
            (0..length.get())
                .for_each(|index| walk(module, *base, &at.into(index, format!("{}[{index}]", at.path)), found));
        }
        TypeInner::Matrix { columns, rows, scalar } => {
            let column = TypeInner::Vector { size: *rows, scalar: *scalar };
            // The front end makes the type of a column with the matrix.
            let column = module.types.iter().find(|(_, ty)| ty.inner == column && ty.name.is_none());
            if let Some((column, _)) = column {
                (0..*columns as u32)
                    .for_each(|index| walk(module, column, &at.into(index, format!("{}[{index}]", at.path)), found));
            }
        }
        inner => {
            let size = if let TypeInner::Vector { size, .. } = inner { *size as u8 } else { 1 };
            let of_member = at.member.and_then(|member| at.io.members.get(member as usize)).copied();
            let mut qualifiers = of_member.unwrap_or_default();
            let outer = at.io.qualifiers;
            qualifiers.centroid |= outer.centroid;
            qualifiers.sample |= outer.sample;
            if outer.interpolation != InputInterpolation::Smooth {
                qualifiers.interpolation = outer.interpolation;
            }
            found.push(AttributePart {
                attribute: StageVariable {
                    name: at.path.clone(),
                    location: 0,
                    ty: type_name(inner),
                    kind: inner.scalar_kind(),
                    width: inner.scalar().map_or(0, |scalar| scalar.width),
                    size,
                    qualifiers,
                    is_used: at.io.is_used,
                },
                ty,
                variable: at.variable,
                chain: at.chain.clone(),
            });
        }
    }
}
