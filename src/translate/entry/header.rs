//! The storage buffer by which a stage is told a few numbers and says what happened: its header, and the records of the
//! vertices behind it.

use super::{CAPTURE_GROUP, CAPTURE_HEADER, CAPTURE_SLOT};
use crate::translate::build::Build;
use naga::{
    AddressSpace, ArraySize, BinaryOperator, Expression, GlobalVariable, Handle, Module, ResourceBinding, Scalar, Span,
    StorageAccess, StructMember, Type, TypeInner, VectorSize,
};

const ZERO_MEMBER: u32 = 1;
const UNDEFINED_MEMBER: u32 = 2;
const SPENT_MEMBER: u32 = 3;
const IS_FRAME_MEMBER: u32 = 4;
const RECORDS_MEMBER: u32 = 5;

/// The buffer in a module.
pub(super) struct CaptureHeader {
    pub u32: Handle<Type>,
    pub vec4: Handle<Type>,
    variable: Handle<GlobalVariable>,
}

impl CaptureHeader {
    /// Declares the buffer; a record has a position and `slots` vectors more. Without records, for fragments, the fuel
    /// that they spend is added up by all at once.
    pub fn declare(module: &mut Module, slots: Option<u32>) -> Self {
        let u32 = insert(module, TypeInner::Scalar(Scalar::U32));
        let vec4 = insert(module, TypeInner::Vector { size: VectorSize::Quad, scalar: Scalar::F32 });
        let spent = if slots.is_none() { insert(module, TypeInner::Atomic(Scalar::U32)) } else { u32 };
        let number = |name: &str, ty, offset| StructMember { name: Some(name.into()), ty, binding: None, offset };
        let mut members = vec![
            number("ran_out", u32, 0),
            number("zero", u32, 4),
            number("undefined", u32, 8),
            number("spent", spent, 12),
            number("is_frame", u32, 16),
        ];
        let mut span = CAPTURE_HEADER as u32;
        if let Some(slots) = slots {
            let stride = (u64::from(slots) + 1) as u32 * CAPTURE_SLOT as u32;
            let slot = |number: u32| StructMember {
                name: None,
                ty: vec4,
                binding: None,
                offset: number * CAPTURE_SLOT as u32,
            };
            let record = TypeInner::Struct { members: (0..=slots).map(slot).collect(), span: stride };
            let base = insert(module, record);
            let records = insert(module, TypeInner::Array { base, size: ArraySize::Dynamic, stride });
            members.push(number("records", records, CAPTURE_HEADER as u32));
            span += stride;
        }
        let ty = insert(module, TypeInner::Struct { members, span });
        let variable = GlobalVariable {
            name: Some("capture".into()),
            space: AddressSpace::Storage { access: StorageAccess::LOAD | StorageAccess::STORE },
            binding: Some(ResourceBinding { group: CAPTURE_GROUP, binding: 0 }),
            ty,
            init: None,
            memory_decorations: naga::MemoryDecorations::empty(),
        };
        Self { u32, vec4, variable: module.global_variables.append(variable, Span::UNDEFINED) }
    }

    /// A pointer to the buffer.
    pub fn pointer(&self, build: &mut Build<'_>) -> Handle<Expression> {
        build.leaf(Expression::GlobalVariable(self.variable))
    }

    /// A zero of which the driver's compiler does not know that it is one.
    pub fn zero(&self, build: &mut Build<'_>, capture: Handle<Expression>) -> Handle<Expression> {
        let member = build.member(capture, ZERO_MEMBER);
        build.load(member)
    }

    /// Whether a frame is painted, 1 or 0.
    pub fn is_frame(&self, build: &mut Build<'_>, capture: Handle<Expression>) -> Handle<Expression> {
        let member = build.member(capture, IS_FRAME_MEMBER);
        build.load(member)
    }

    /// A pointer to the fuel that all fragments together have spent.
    pub fn spent(&self, build: &mut Build<'_>, capture: Handle<Expression>) -> Handle<Expression> {
        build.member(capture, SPENT_MEMBER)
    }

    /// A pointer to a record.
    pub fn record(
        &self,
        build: &mut Build<'_>,
        capture: Handle<Expression>,
        index: Handle<Expression>,
    ) -> Handle<Expression> {
        let records = build.member(capture, RECORDS_MEMBER);
        build.node(Expression::Access { base: records, index })
    }

    /// Tells what [`crate::translate::undefined`] met. Any vertex's or fragment's answer will do.
    pub fn tell_undefined(
        &self,
        build: &mut Build<'_>,
        capture: Handle<Expression>,
        undefined: Handle<GlobalVariable>,
    ) {
        let undefined = build.leaf(Expression::GlobalVariable(undefined));
        let met = build.load(undefined);
        let none = build.number(0);
        let is_met = build.binary(BinaryOperator::NotEqual, met, none);
        build.when(is_met, |build| {
            let place = build.member(capture, UNDEFINED_MEMBER);
            build.store(place, met);
        });
    }
}

pub(super) fn insert(module: &mut Module, inner: TypeInner) -> Handle<Type> {
    module.types.insert(Type { name: None, inner }, Span::UNDEFINED)
}
