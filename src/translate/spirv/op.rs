//! Numbers of SPIR-V (specification, section 3) and of its extended instructions for GLSL.
#![allow(missing_docs)]

pub const UNDEF: u16 = 1;
pub const NAME: u16 = 5;
pub const MEMBER_NAME: u16 = 6;
pub const LINE: u16 = 8;
pub const EXTENSION: u16 = 10;
pub const EXT_INST_IMPORT: u16 = 11;
pub const EXT_INST: u16 = 12;
pub const ENTRY_POINT: u16 = 15;
pub const EXECUTION_MODE: u16 = 16;
pub const CAPABILITY: u16 = 17;
pub const TYPE_VOID: u16 = 19;
pub const TYPE_BOOL: u16 = 20;
pub const TYPE_INT: u16 = 21;
pub const TYPE_FLOAT: u16 = 22;
pub const TYPE_VECTOR: u16 = 23;
pub const TYPE_MATRIX: u16 = 24;
pub const TYPE_IMAGE: u16 = 25;
pub const TYPE_SAMPLED_IMAGE: u16 = 27;
pub const TYPE_ARRAY: u16 = 28;
pub const TYPE_RUNTIME_ARRAY: u16 = 29;
pub const TYPE_STRUCT: u16 = 30;
pub const TYPE_POINTER: u16 = 32;
pub const TYPE_FUNCTION: u16 = 33;
pub const CONSTANT: u16 = 43;
pub const CONSTANT_COMPOSITE: u16 = 44;
pub const CONSTANT_NULL: u16 = 46;
pub const FUNCTION: u16 = 54;
pub const FUNCTION_PARAMETER: u16 = 55;
pub const FUNCTION_END: u16 = 56;
pub const FUNCTION_CALL: u16 = 57;
pub const VARIABLE: u16 = 59;
pub const LOAD: u16 = 61;
pub const STORE: u16 = 62;
pub const ACCESS_CHAIN: u16 = 65;
pub const IN_BOUNDS_ACCESS_CHAIN: u16 = 66;
pub const ARRAY_LENGTH: u16 = 68;
pub const DECORATE: u16 = 71;
pub const MEMBER_DECORATE: u16 = 72;
pub const VECTOR_SHUFFLE: u16 = 79;
pub const COMPOSITE_CONSTRUCT: u16 = 80;
pub const COMPOSITE_EXTRACT: u16 = 81;
pub const COMPOSITE_INSERT: u16 = 82;
pub const COPY_OBJECT: u16 = 83;
pub const SAMPLED_IMAGE: u16 = 86;
pub const IMAGE_SAMPLE_FIRST: u16 = 87;
pub const IMAGE_FETCH: u16 = 95;
pub const IMAGE_GATHER: u16 = 96;
pub const IMAGE_DREF_GATHER: u16 = 97;
pub const IMAGE_READ: u16 = 98;
pub const IMAGE_WRITE: u16 = 99;
pub const IMAGE: u16 = 100;
pub const IMAGE_QUERY_SIZE_LOD: u16 = 103;
pub const IMAGE_QUERY_SIZE: u16 = 104;
pub const IMAGE_QUERY_LOD: u16 = 105;
pub const IMAGE_LAST: u16 = 107;
pub const CONVERT_F_TO_U: u16 = 109;
pub const CONVERT_F_TO_S: u16 = 110;
pub const CONVERT_U_TO_F: u16 = 112;
pub const F_CONVERT: u16 = 115;
pub const BITCAST: u16 = 124;
pub const F_NEGATE: u16 = 127;
pub const I_ADD: u16 = 128;
pub const F_ADD: u16 = 129;
pub const I_SUB: u16 = 130;
pub const F_SUB: u16 = 131;
pub const I_MUL: u16 = 132;
pub const F_MUL: u16 = 133;
pub const U_DIV: u16 = 134;
pub const S_DIV: u16 = 135;
pub const F_DIV: u16 = 136;
pub const U_MOD: u16 = 137;
pub const S_REM: u16 = 138;
pub const S_MOD: u16 = 139;
pub const F_MOD: u16 = 141;
pub const VECTOR_TIMES_SCALAR: u16 = 142;
pub const OUTER_PRODUCT: u16 = 147;
pub const I_ADD_CARRY: u16 = 149;
pub const I_SUB_BORROW: u16 = 150;
pub const U_MUL_EXTENDED: u16 = 151;
pub const S_MUL_EXTENDED: u16 = 152;
pub const SELECT: u16 = 169;
pub const I_EQUAL: u16 = 170;
pub const I_NOT_EQUAL: u16 = 171;
pub const U_LESS_THAN: u16 = 176;
pub const S_LESS_THAN: u16 = 177;
pub const F_ORD_EQUAL: u16 = 180;
pub const F_ORD_LESS_THAN: u16 = 184;
pub const SHIFT_RIGHT_LOGICAL: u16 = 194;
pub const SHIFT_LEFT_LOGICAL: u16 = 196;
pub const BITWISE_OR: u16 = 197;
pub const BITWISE_AND: u16 = 199;
pub const BIT_REVERSE: u16 = 204;
pub const BIT_COUNT: u16 = 205;
pub const D_PDX: u16 = 207;
pub const D_PDY: u16 = 208;
pub const MEMORY_BARRIER: u16 = 225;
pub const KILL: u16 = 252;
pub const LOOP_MERGE: u16 = 246;
pub const SELECTION_MERGE: u16 = 247;
pub const LABEL: u16 = 248;
pub const BRANCH: u16 = 249;
pub const BRANCH_CONDITIONAL: u16 = 250;
pub const SWITCH: u16 = 251;
pub const UNREACHABLE: u16 = 255;
pub const NO_LINE: u16 = 317;

/// Storage classes.
pub mod storage {
    pub const UNIFORM_CONSTANT: u32 = 0;
    pub const INPUT: u32 = 1;
    pub const UNIFORM: u32 = 2;
    pub const OUTPUT: u32 = 3;
    pub const PRIVATE: u32 = 6;
    pub const FUNCTION: u32 = 7;
}

/// Decorations.
pub mod decoration {
    pub const BLOCK: u32 = 2;
    pub const ROW_MAJOR: u32 = 4;
    pub const COL_MAJOR: u32 = 5;
    pub const ARRAY_STRIDE: u32 = 6;
    pub const MATRIX_STRIDE: u32 = 7;
    pub const BUILT_IN: u32 = 11;
    pub const NO_PERSPECTIVE: u32 = 13;
    pub const FLAT: u32 = 14;
    pub const CENTROID: u32 = 16;
    pub const SAMPLE: u32 = 17;
    pub const LOCATION: u32 = 30;
    pub const INDEX: u32 = 32;
    pub const BINDING: u32 = 33;
    pub const DESCRIPTOR_SET: u32 = 34;
    pub const OFFSET: u32 = 35;
    pub const XFB_BUFFER: u32 = 36;
    pub const XFB_STRIDE: u32 = 37;
}

/// Execution modes.
pub mod execution_mode {
    pub const PIXEL_CENTER_INTEGER: u32 = 6;
    pub const ORIGIN_UPPER_LEFT: u32 = 7;
    pub const ORIGIN_LOWER_LEFT: u32 = 8;
    pub const EARLY_FRAGMENT_TESTS: u32 = 9;
    pub const XFB: u32 = 11;
    pub const DEPTH_GREATER: u32 = 14;
    pub const DEPTH_LESS: u32 = 15;
    pub const DEPTH_UNCHANGED: u32 = 16;
}

/// Built-in variables.
pub mod built_in {
    pub const CLIP_DISTANCE: u32 = 3;
    pub const CULL_DISTANCE: u32 = 4;
    pub const LAYER: u32 = 9;
    pub const VIEWPORT_INDEX: u32 = 10;
    pub const POINT_COORD: u32 = 16;
    pub const SAMPLE_ID: u32 = 18;
    pub const SAMPLE_POSITION: u32 = 19;
    pub const SAMPLE_MASK: u32 = 20;
    pub const FRAG_DEPTH: u32 = 22;
    pub const HELPER_INVOCATION: u32 = 23;
    pub const VERTEX_ID: u32 = 5;
    pub const INSTANCE_ID: u32 = 6;
    pub const VERTEX_INDEX: u32 = 42;
    pub const INSTANCE_INDEX: u32 = 43;
    pub const BASE_VERTEX: u32 = 4424;
    pub const DRAW_INDEX: u32 = 4426;
}

/// `GLSL.std.450`.
pub mod glsl {
    pub const POW: u32 = 26;
    pub const ROUND_EVEN: u32 = 2;
    pub const TRUNC: u32 = 3;
    pub const F_ABS: u32 = 4;
    pub const F_SIGN: u32 = 6;
    pub const FLOOR: u32 = 8;
    pub const SQRT: u32 = 31;
    pub const MODF: u32 = 35;
    pub const MODF_STRUCT: u32 = 36;
    pub const F_CLAMP: u32 = 43;
    pub const FREXP: u32 = 51;
    pub const FREXP_STRUCT: u32 = 52;
    pub const PACK_SNORM_4X8: u32 = 54;
    pub const PACK_SNORM_2X16: u32 = 56;
    pub const UNPACK_HALF_2X16: u32 = 62;
    pub const LENGTH: u32 = 66;
    pub const DISTANCE: u32 = 67;
    pub const NORMALIZE: u32 = 69;
    pub const FACE_FORWARD: u32 = 70;
    pub const REFLECT: u32 = 71;
    pub const REFRACT: u32 = 72;
    pub const FIND_I_LSB: u32 = 73;
    pub const FIND_U_MSB: u32 = 75;
    pub const INTERPOLATE_AT_CENTROID: u32 = 76;
    pub const INTERPOLATE_AT_SAMPLE: u32 = 77;
    pub const INTERPOLATE_AT_OFFSET: u32 = 78;
}
