//! Instructions that naga's front end does not know, or takes for something else, in terms of ones it knows.

use super::code::{SpirvCode, SpirvInstruction};
use super::{images, integers, op, op::glsl, packing};
use std::collections::HashMap;

/// Lowers the functions of `code`.
pub(super) fn lower(code: &mut SpirvCode) {
    // A shader here shares no memory with anybody.
    code.functions.retain(|instruction| !matches!(instruction.opcode, op::IMAGE_WRITE | op::MEMORY_BARRIER));
    rewrite(code, lowered);
}

/// Replaces the instructions of all functions for which `replaced` writes others.
pub(super) fn rewrite(
    code: &mut SpirvCode,
    replaced: impl Fn(&mut InstructionBuilder<'_>, &SpirvInstruction) -> Option<()>,
) {
    let (types, set) = (code.value_types(), code.glsl());
    let functions = std::mem::take(&mut code.functions);
    let mut builder = InstructionBuilder { code, types, out: Vec::with_capacity(functions.len()), line: None, set };
    for instruction in functions {
        builder.line = instruction.line;
        if replaced(&mut builder, &instruction).is_none() {
            builder.out.push(instruction);
        }
    }
    let out = builder.out;
    code.functions = out;
}

/// What a number type consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct NumberType {
    /// The type of a component.
    pub scalar: u32,
    /// Bits of a component.
    pub width: u32,
    /// Components; 1 for a scalar.
    pub size: u32,
    /// Whether it is a signed integer.
    pub is_signed: bool,
}

/// Writes instructions in place of one.
pub(super) struct InstructionBuilder<'a> {
    pub code: &'a mut SpirvCode,
    types: HashMap<u32, u32>,
    out: Vec<SpirvInstruction>,
    line: Option<u32>,
    /// The id of `GLSL.std.450`.
    set: u32,
}

impl InstructionBuilder<'_> {
    /// The type of a value.
    pub fn type_of(&self, id: u32) -> Option<u32> {
        self.types.get(&id).copied()
    }

    /// What a scalar or vector of numbers consists of.
    pub fn shape(&self, ty: u32) -> Option<NumberType> {
        let declared = self.code.global(ty)?;
        let operand = |at: usize| declared.operands.get(at).copied();
        match declared.opcode {
            op::TYPE_FLOAT => Some(NumberType { scalar: ty, width: operand(1)?, size: 1, is_signed: false }),
            op::TYPE_INT => Some(NumberType { scalar: ty, width: operand(1)?, size: 1, is_signed: operand(2)? == 1 }),
            op::TYPE_VECTOR => Some(NumberType { size: operand(2)?, ..self.shape(operand(1)?)? }),
            _ => None,
        }
    }

    /// `scalar`, or the vector of `size` of it.
    pub fn sized(&mut self, scalar: u32, size: u32) -> u32 {
        if size == 1 { scalar } else { self.code.ty(op::TYPE_VECTOR, &[scalar, size]) }
    }

    /// As many truth values.
    pub fn bools(&mut self, size: u32) -> u32 {
        let bool = self.code.ty(op::TYPE_BOOL, &[]);
        self.sized(bool, size)
    }

    /// As many 32-bit integers.
    pub fn ints(&mut self, size: u32, is_signed: bool) -> u32 {
        let int = self.code.ty(op::TYPE_INT, &[32, u32::from(is_signed)]);
        self.sized(int, size)
    }

    /// The constant of type `ty` of which every component has the bits `bits`.
    pub fn splat(&mut self, ty: u32, bits: &[u32]) -> u32 {
        let Some(NumberType { scalar, size, .. }) = self.shape(ty) else { return self.code.null(ty) };
        let one = self.code.constant(op::CONSTANT, scalar, bits);
        if size == 1 { one } else { self.code.constant(op::CONSTANT_COMPOSITE, ty, &vec![one; size as usize]) }
    }

    /// The floating-point constant `value` of type `ty`.
    pub fn float(&mut self, ty: u32, value: f64) -> u32 {
        let bits = value.to_bits();
        match self.shape(ty) {
            Some(NumberType { width: 64, .. }) => self.splat(ty, &[bits as u32, (bits >> 32) as u32]),
            _ => self.splat(ty, &[(value as f32).to_bits()]),
        }
    }

    /// Appends an instruction with a new result.
    pub fn op(&mut self, opcode: u16, ty: u32, operands: &[u32]) -> u32 {
        let id = self.code.fresh();
        self.op_as(id, opcode, ty, operands)
    }

    /// Appends an instruction whose result is `id`.
    pub fn op_as(&mut self, id: u32, opcode: u16, ty: u32, operands: &[u32]) -> u32 {
        self.types.insert(id, ty);
        self.push(opcode, [&[ty, id], operands].concat());
        id
    }

    /// Appends an instruction.
    pub fn push(&mut self, opcode: u16, operands: Vec<u32>) {
        self.out.push(SpirvInstruction { opcode, operands, line: self.line });
    }

    /// Appends an extended instruction of GLSL with a new result.
    pub fn glsl(&mut self, number: u32, ty: u32, operands: &[u32]) -> u32 {
        self.op(op::EXT_INST, ty, &[&[self.set, number], operands].concat())
    }
}

/// Writes what stands for `instruction`; `None` where it stays as it is.
fn lowered(b: &mut InstructionBuilder<'_>, instruction: &SpirvInstruction) -> Option<()> {
    let (ty, id) = instruction.result()?;
    let operands = &instruction.operands[2..];
    match (instruction.opcode, operands) {
        (op::EXT_INST, [_, number, arguments @ ..]) => extended(b, id, ty, *number, arguments),
        (op::F_MOD, &[x, y]) => {
            let ratio = b.op(op::F_DIV, ty, &[x, y]);
            let floor = b.glsl(glsl::FLOOR, ty, &[ratio]);
            let product = b.op(op::F_MUL, ty, &[y, floor]);
            b.op_as(id, op::F_SUB, ty, &[x, product]);
            Some(())
        }
        (op::OUTER_PRODUCT, &[column, row]) => outer_product(b, id, ty, column, row),
        // What the functions that look textures up read is a picture.
        (op::IMAGE_FETCH, [picture, ..]) if is_picture(b, *picture) => None,
        (op::SAMPLED_IMAGE..=op::IMAGE_LAST, _) => images::lowered(b, instruction.opcode, id, ty),
        _ => integers::lowered(b, instruction.opcode, id, ty, operands),
    }
}

fn is_picture(b: &InstructionBuilder<'_>, value: u32) -> bool {
    let declared = b.type_of(value).and_then(|ty| b.code.global(ty));
    declared.is_some_and(|declared| declared.opcode == op::TYPE_IMAGE)
}

fn outer_product(b: &mut InstructionBuilder<'_>, id: u32, ty: u32, column: u32, row: u32) -> Option<()> {
    let column_ty = b.type_of(column)?;
    let NumberType { scalar, size, .. } = b.shape(b.type_of(row)?)?;
    let columns: Vec<u32> = (0..size)
        .map(|at| {
            let factor = b.op(op::COMPOSITE_EXTRACT, scalar, &[row, at]);
            b.op(op::VECTOR_TIMES_SCALAR, column_ty, &[column, factor])
        })
        .collect();
    b.op_as(id, op::COMPOSITE_CONSTRUCT, ty, &columns);
    Some(())
}

/// The extended instructions that naga has for vectors only, writes through pointers, or gets wrong.
fn extended(b: &mut InstructionBuilder<'_>, id: u32, ty: u32, number: u32, arguments: &[u32]) -> Option<()> {
    let argument_ty = b.type_of(*arguments.first()?)?;
    let is_scalar = b.shape(argument_ty).is_some_and(|shape| shape.size == 1);
    match (number, arguments) {
        (glsl::LENGTH, &[x]) if is_scalar => {
            b.op_as(id, op::EXT_INST, ty, &[b.set, glsl::F_ABS, x]);
        }
        (glsl::DISTANCE, &[x, y]) if is_scalar => {
            let difference = b.op(op::F_SUB, ty, &[x, y]);
            b.op_as(id, op::EXT_INST, ty, &[b.set, glsl::F_ABS, difference]);
        }
        (glsl::NORMALIZE, &[x]) if is_scalar => {
            b.op_as(id, op::EXT_INST, ty, &[b.set, glsl::F_SIGN, x]);
        }
        (glsl::FACE_FORWARD, &[n, incident, reference]) if is_scalar => {
            let dot = b.op(op::F_MUL, ty, &[reference, incident]);
            let zero = b.float(ty, 0.0);
            let bools = b.bools(1);
            let faces = b.op(op::F_ORD_LESS_THAN, bools, &[dot, zero]);
            let turned = b.op(op::F_NEGATE, ty, &[n]);
            b.op_as(id, op::SELECT, ty, &[faces, n, turned]);
        }
        (glsl::REFLECT, &[incident, n]) if is_scalar => {
            let dot = b.op(op::F_MUL, ty, &[n, incident]);
            let two = b.float(ty, 2.0);
            let twice = b.op(op::F_MUL, ty, &[two, dot]);
            let along = b.op(op::F_MUL, ty, &[twice, n]);
            b.op_as(id, op::F_SUB, ty, &[incident, along]);
        }
        (glsl::REFRACT, &[incident, n, eta]) if is_scalar => refract(b, id, ty, [incident, n, eta]),
        (glsl::MODF, &[x, pointer]) => {
            let whole = b.glsl(glsl::TRUNC, ty, &[x]);
            b.push(op::STORE, vec![pointer, whole]);
            b.op_as(id, op::F_SUB, ty, &[x, whole]);
        }
        (glsl::MODF_STRUCT, &[x]) => {
            let whole = b.glsl(glsl::TRUNC, argument_ty, &[x]);
            let fraction = b.op(op::F_SUB, argument_ty, &[x, whole]);
            b.op_as(id, op::COMPOSITE_CONSTRUCT, ty, &[fraction, whole]);
        }
        (glsl::FREXP, &[x, pointer]) => {
            let exponent_ty = b.code.global(b.type_of(pointer)?)?.operands.get(2).copied()?;
            let (significand, exponent) = frexp(b, ty, x, exponent_ty)?;
            b.push(op::STORE, vec![pointer, exponent]);
            b.op_as(id, op::COPY_OBJECT, ty, &[significand]);
        }
        (glsl::FREXP_STRUCT, &[x]) => {
            let exponent_ty = b.code.global(ty)?.operands.get(2).copied()?;
            let (significand, exponent) = frexp(b, argument_ty, x, exponent_ty)?;
            b.op_as(id, op::COMPOSITE_CONSTRUCT, ty, &[significand, exponent]);
        }
        (glsl::FIND_I_LSB..=glsl::FIND_U_MSB, &[x]) if argument_ty != ty => {
            let found = b.glsl(number, argument_ty, &[x]);
            b.op_as(id, op::BITCAST, ty, &[found]);
        }
        // With one sample a pixel, all of these are in its middle.
        (glsl::INTERPOLATE_AT_CENTROID | glsl::INTERPOLATE_AT_SAMPLE, &[pointer, ..]) => {
            b.op_as(id, op::LOAD, ty, &[pointer]);
        }
        (glsl::INTERPOLATE_AT_OFFSET, &[pointer, offset]) => {
            let NumberType { scalar, size, .. } = b.shape(ty)?;
            let mut value = b.op(op::LOAD, ty, &[pointer]);
            let middle = value;
            for (axis, derivative) in [(0, op::D_PDX), (1, op::D_PDY)] {
                let along = b.op(derivative, ty, &[middle]);
                let by = b.op(op::COMPOSITE_EXTRACT, scalar, &[offset, axis]);
                let times = if size == 1 { op::F_MUL } else { op::VECTOR_TIMES_SCALAR };
                let moved = b.op(times, ty, &[along, by]);
                value = b.op(op::F_ADD, ty, &[value, moved]);
            }
            b.op_as(id, op::COPY_OBJECT, ty, &[value]);
        }
        (glsl::PACK_SNORM_4X8 | glsl::PACK_SNORM_2X16, &[x]) => return packing::pack_signed(b, id, ty, x),
        (glsl::UNPACK_HALF_2X16, &[x]) => return packing::unpack_half(b, id, ty, x),
        _ => return None,
    }
    Some(())
}

/// `refract` of scalars (GLSL 4.10, section 8.5): k = 1 − η²(1 − (N·I)²); 0 where k < 0, else
/// ηI − (ηN·I + √k)N.
fn refract(b: &mut InstructionBuilder<'_>, id: u32, ty: u32, [incident, n, eta]: [u32; 3]) {
    let one = b.float(ty, 1.0);
    let zero = b.float(ty, 0.0);
    let dot = b.op(op::F_MUL, ty, &[n, incident]);
    let square = b.op(op::F_MUL, ty, &[dot, dot]);
    let rest = b.op(op::F_SUB, ty, &[one, square]);
    let eta_rest = b.op(op::F_MUL, ty, &[eta, rest]);
    let eta_eta_rest = b.op(op::F_MUL, ty, &[eta, eta_rest]);
    let k = b.op(op::F_SUB, ty, &[one, eta_eta_rest]);
    let bools = b.bools(1);
    let is_total = b.op(op::F_ORD_LESS_THAN, bools, &[k, zero]);
    let root = b.glsl(glsl::SQRT, ty, &[k]);
    let eta_dot = b.op(op::F_MUL, ty, &[eta, dot]);
    let factor = b.op(op::F_ADD, ty, &[eta_dot, root]);
    let along = b.op(op::F_MUL, ty, &[factor, n]);
    let bent = b.op(op::F_MUL, ty, &[eta, incident]);
    let through = b.op(op::F_SUB, ty, &[bent, along]);
    b.op_as(id, op::SELECT, ty, &[is_total, zero, through]);
}

/// Significand in [0.5, 1) and exponent of x by the bits of a 32-bit float; both 0 for 0.
fn frexp(b: &mut InstructionBuilder<'_>, ty: u32, x: u32, exponent_ty: u32) -> Option<(u32, u32)> {
    let shape = b.shape(ty).filter(|shape| shape.width == 32)?;
    let uints = b.ints(shape.size, false);
    let bools = b.bools(shape.size);
    let bits = b.op(op::BITCAST, uints, &[x]);
    let twenty_three = b.splat(uints, &[23]);
    let eight_bits = b.splat(uints, &[0xff]);
    let shifted = b.op(op::SHIFT_RIGHT_LOGICAL, uints, &[bits, twenty_three]);
    let biased = b.op(op::BITWISE_AND, uints, &[shifted, eight_bits]);
    let biased = b.op(op::BITCAST, exponent_ty, &[biased]);
    let bias = b.splat(exponent_ty, &[126]);
    let exponent = b.op(op::I_SUB, exponent_ty, &[biased, bias]);
    let kept = b.splat(uints, &[0x807f_ffff]);
    let half = b.splat(uints, &[0x3f00_0000]);
    let kept = b.op(op::BITWISE_AND, uints, &[bits, kept]);
    let significand = b.op(op::BITWISE_OR, uints, &[kept, half]);
    let significand = b.op(op::BITCAST, ty, &[significand]);
    let zero = b.float(ty, 0.0);
    let is_zero = b.op(op::F_ORD_EQUAL, bools, &[x, zero]);
    let no_exponent = b.splat(exponent_ty, &[0]);
    let exponent = b.op(op::SELECT, exponent_ty, &[is_zero, no_exponent, exponent]);
    Some((b.op(op::SELECT, ty, &[is_zero, x, significand]), exponent))
}
