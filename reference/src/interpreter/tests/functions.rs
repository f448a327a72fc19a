//! Built-in functions.

use super::{is, result};
use std::f64::consts::{E, PI};

#[test]
fn trigonometry_and_exponentials() {
    is("vec3", "vec3(radians(180.0), degrees(1.0), sin(radians(30.0)))", &[PI, 180.0 / PI, 0.5]);
    is("vec3", "vec3(atan(1.0), atan(1.0, -1.0), acos(-1.0))", &[PI / 4.0, PI * 0.75, PI]);
    is("vec4", "vec4(pow(2.0, 10.0), exp(1.0), log2(8.0), inversesqrt(4.0))", &[1024.0, E, 3.0, 0.5]);
    is("vec3", "vec3(sinh(1.0), atanh(0.5), acosh(1.0))", &[(E - 1.0 / E) / 2.0, 3_f64.ln() / 2.0, 0.0]);
}

#[test]
fn common_functions() {
    is("vec4", "vec4(floor(-1.5), trunc(-1.5), ceil(-1.5), fract(-1.25))", &[-2.0, -1.0, -1.0, 0.75]);
    is("vec3", "vec3(roundEven(2.5), roundEven(3.5), round(-1.25))", &[2.0, 4.0, -1.0]);
    // mod takes the sign of the divisor: −1 − 3 ⌊−1/3⌋ = 2.
    is("vec2", "vec2(mod(-1.0, 3.0), mod(1.0, -3.0))", &[2.0, -2.0]);
    is("vec3", "mix(vec3(1.0, 2.0, 3.0), vec3(5.0), 0.25)", &[2.0, 2.75, 3.5]);
    is("vec2", "mix(vec2(1.0, 2.0), vec2(3.0, 4.0), bvec2(true, false))", &[3.0, 2.0]);
    is("vec4", "vec4(step(1.0, vec3(0.5, 1.0, 2.0)), smoothstep(0.0, 2.0, 0.5))", &[0.0, 1.0, 1.0, 0.15625]);
    is("ivec4", "ivec4(min(3, -2), max(3, -2), clamp(9, 1, 4), sign(-7))", &[-2.0, 3.0, 4.0, -1.0]);
    is("float", "fma(2.0, 3.0, 4.0)", &[10.0]);
    assert_eq!(
        result(
            "vec4",
            "float w; float f = modf(-2.75, w); int e; float m = frexp(12.0, e); result = vec4(f, w, m, e);",
            0.0
        ),
        [-0.75, -2.0, 0.75, 4.0]
    );
    is("float", "ldexp(0.75, 4)", &[12.0]);
}

#[test]
fn bits_of_numbers() {
    is("ivec2", "floatBitsToInt(vec2(1.0, -2.0))", &[f64::from(0x3F80_0000), f64::from(0xC000_0000_u32.cast_signed())]);
    is("float", "uintBitsToFloat(0x40490FDBu)", &[f64::from(std::f32::consts::PI)]);
    // 0.1 as a float of 32 bits, not of 64.
    is("uint", "floatBitsToUint(0.1)", &[f64::from(0.1_f32.to_bits())]);
    is("double", "double(0.1)", &[f64::from(0.1_f32)]);
    // 2^24 + 1 is no float of 32 bits.
    is("ivec2", "ivec2(int(16777217.0lf), int(float(16777217)))", &[16_777_217.0, 16_777_216.0]);
    is("bvec3", "bvec3(isinf(1e38 * 10.0), isnan(1.0), isinf(-1e38))", &[1.0, 0.0, 0.0]);
}

#[test]
fn packing() {
    is("uint", "packUnorm4x8(vec4(0.0, 0.2, 0.6, 1.0))", &[f64::from(0xFF99_3300_u32)]);
    is("vec4", "unpackUnorm4x8(0xFF993300u)", &[0.0, 0.2, 0.6, 1.0]);
    is("uint", "packSnorm2x16(vec2(-1.0, 0.5))", &[f64::from(0x4000_8001_u32)]);
    is("vec2", "unpackSnorm2x16(0x7FFF8000u)", &[-1.0, 1.0]);
    is("uint", "packHalf2x16(vec2(1.0, -2.0))", &[f64::from(0xC000_3C00_u32)]);
    is("vec2", "unpackHalf2x16(0xC0003C00u)", &[1.0, -2.0]);
    is("uvec2", "unpackDouble2x32(packDouble2x32(uvec2(7u, 9u)))", &[7.0, 9.0]);
}

#[test]
fn geometry() {
    is("vec3", "cross(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0))", &[0.0, 0.0, 1.0]);
    is(
        "vec4",
        "vec4(length(vec2(3.0, 4.0)), distance(vec2(1.0), vec2(4.0, 5.0)), dot(vec3(1.0, 2.0, 3.0), vec3(4.0)), length(-2.0))",
        &[5.0, 5.0, 24.0, 2.0],
    );
    is("vec2", "normalize(vec2(3.0, -4.0))", &[0.6, -0.8]);
    is("vec2", "reflect(vec2(1.0, -1.0), vec2(0.0, 1.0))", &[1.0, 1.0]);
    is("vec2", "faceforward(vec2(0.0, 1.0), vec2(0.0, 1.0), vec2(0.0, 1.0))", &[0.0, -1.0]);
    // Straight through at any ratio; none beyond the angle of total reflection.
    is("vec2", "refract(vec2(0.0, -1.0), vec2(0.0, 1.0), 0.5)", &[0.0, -1.0]);
    is("vec2", "refract(vec2(0.8, -0.6), vec2(0.0, 1.0), 2.0)", &[0.0, 0.0]);
    // sin 30° · 1.5 = 0.75, and cos = √(1 − 0.75²).
    is("vec2", "refract(vec2(0.5, -sqrt(0.75)), vec2(0.0, 1.0), 1.5)", &[0.75, -(1.0 - 0.75_f64 * 0.75).sqrt()]);
}

#[test]
fn matrices() {
    is("mat2", "inverse(mat2(4.0, 2.0, 7.0, 6.0))", &[0.6, -0.2, -0.7, 0.4]);
    is("float", "determinant(mat3(2.0, 0.0, 1.0, 1.0, 3.0, 2.0, 1.0, 1.0, 4.0))", &[18.0]);
    is("mat3x2", "transpose(mat2x3(1.0, 2.0, 3.0, 4.0, 5.0, 6.0))", &[1.0, 4.0, 2.0, 5.0, 3.0, 6.0]);
    is("mat2x3", "outerProduct(vec3(1.0, 2.0, 3.0), vec2(4.0, 5.0))", &[4.0, 8.0, 12.0, 5.0, 10.0, 15.0]);
    is("mat2", "matrixCompMult(mat2(1.0, 2.0, 3.0, 4.0), mat2(2.0))", &[2.0, 0.0, 0.0, 8.0]);
    // A matrix times its inverse, of each size.
    for (n, matrix) in
        [(3, "mat3(2, 1, 0, 0, 3, 1, 1, 0, 4)"), (4, "mat4(2, 1, 0, 5, 0, 3, 1, 0, 1, 0, 4, 2, 1, 1, 1, 7)")]
    {
        let unit: Vec<f64> = (0..n * n).map(|index| f64::from(u8::from(index % (n + 1) == 0))).collect();
        is(&format!("mat{n}"), &format!("{matrix} * inverse({matrix})"), &unit);
    }
}

#[test]
fn vector_relations_and_integers() {
    is("bvec3", "lessThan(vec3(1.0, 2.0, 3.0), vec3(2.0))", &[1.0, 0.0, 0.0]);
    is("bvec3", "bvec3(any(bvec2(false, true)), all(bvec2(false, true)), not(bvec2(false)).x)", &[1.0, 0.0, 1.0]);
    is("ivec4", "ivec4(bitCount(255u), findLSB(8), findMSB(-1), findMSB(0x80000000u))", &[8.0, 3.0, -1.0, 31.0]);
    is(
        "ivec3",
        "ivec3(bitfieldExtract(0xF0, 4, 4), bitfieldInsert(0, 5, 4, 3), bitfieldReverse(1))",
        &[-1.0, 80.0, f64::from(i32::MIN)],
    );
    is("uint", "bitfieldExtract(0xF0u, 4, 4)", &[15.0]);
    assert_eq!(
        result(
            "uvec4",
            "uint c, b, h, l; uint s = uaddCarry(0xFFFFFFFFu, 2u, c); usubBorrow(1u, 2u, b); umulExtended(0x80000000u, 4u, h, l); result = uvec4(s, c, b, h);",
            0.0
        ),
        [1.0, 1.0, 1.0, 2.0]
    );
    assert_eq!(result("ivec2", "int h, l; imulExtended(-2, 3, h, l); result = ivec2(h, l);", 0.0), [-1.0, -6.0]);
}
