//! The types that the rebuilt entry point needs.

use super::{CAPTURE_HEADER, CAPTURE_STRIDE};
use naga::{ArraySize, Handle, Module, Scalar, Span, StructMember, Type, TypeInner, VectorSize};

pub(super) struct Types {
    pub u32: Handle<Type>,
    pub vec4: Handle<Type>,
    pub capture: Handle<Type>,
}

impl Types {
    pub fn new(module: &mut Module) -> Self {
        let u32 = scalar_type(module, Scalar::U32);
        let vec4 = insert(module, TypeInner::Vector { size: VectorSize::Quad, scalar: Scalar::F32 });
        let member = |name: &str, binding, offset| StructMember { name: Some(name.into()), ty: vec4, binding, offset };
        let record = insert(
            module,
            TypeInner::Struct { members: vec![member("position", None, 0), member("colour", None, 16)], span: 32 },
        );
        let records =
            insert(module, TypeInner::Array { base: record, size: ArraySize::Dynamic, stride: CAPTURE_STRIDE as u32 });
        let number = |name: &str, offset| StructMember { name: Some(name.into()), ty: u32, binding: None, offset };
        let header = [number("ran_out", 0), number("zero", 4), number("undefined", 8)];
        let behind =
            StructMember { name: Some("records".into()), ty: records, binding: None, offset: CAPTURE_HEADER as u32 };
        let span = (CAPTURE_HEADER + CAPTURE_STRIDE) as u32;
        let capture = insert(module, TypeInner::Struct { members: header.into_iter().chain([behind]).collect(), span });
        Self { u32, vec4, capture }
    }
}

pub(super) fn scalar_type(module: &mut Module, scalar: Scalar) -> Handle<Type> {
    insert(module, TypeInner::Scalar(scalar))
}

fn insert(module: &mut Module, inner: TypeInner) -> Handle<Type> {
    module.types.insert(Type { name: None, inner }, Span::UNDEFINED)
}
