//! The vertex stage of ours, in WGSL, that passes on what was captured.

use super::is_flat;
use crate::translate::{InputInterpolation, Shader, StageVariable};
use naga::ScalarKind;
use std::fmt::Write;

/// A vertex stage in WGSL that passes on a record: OpenGL's clip range of z, [−w, w], becomes wgpu's [0, w], and up
/// becomes down.
///
/// What a fixed fragment stage paints is bounded here: beyond ±2²⁰ a value is painted as if it were that, white or black
/// at every pixel that shows any of it, as it is anyway, but the driver's conversion to 8 bits goes through an `i32` and
/// would make black of what that cannot hold.
pub(super) fn pass_on(fragment: &Shader) -> String {
    let ty = |input: &StageVariable| {
        let scalar = match input.kind {
            Some(ScalarKind::Sint) => "i32",
            Some(ScalarKind::Uint) => "u32",
            _ => "f32",
        };
        if input.size == 1 { scalar.to_owned() } else { format!("vec{}<{scalar}>", input.size) }
    };
    let (mut taken, mut given, mut values) = (String::new(), String::new(), String::new());
    for (number, input) in fragment.inputs.iter().enumerate() {
        let interpolation = match input.qualifiers.interpolation {
            _ if is_flat(input) => "flat, first",
            InputInterpolation::NoPerspective if input.qualifiers.centroid => "linear, centroid",
            InputInterpolation::NoPerspective => "linear, center",
            _ if input.qualifiers.centroid => "perspective, centroid",
            _ => "perspective, center",
        };
        let (ty, at) = (ty(input), number + 1);
        let is_bounded = fragment.is_fixed && !is_flat(input);
        let one = if is_bounded { bounded(&format!("v{number}"), &ty) } else { format!("v{number}") };
        // Writing to a text cannot fail.
        let _ = write!(taken, ", @location({at}) v{number}: {ty}");
        let _ = write!(given, "\n    @location({number}) @interpolate({interpolation}) v{number}: {ty},");
        let _ = write!(values, ", {one}");
    }
    if let Some(location) = fragment.shift {
        let _ = write!(taken, ", @location({}) shift: vec2f", location + 1);
        let _ = write!(given, "\n    @location({location}) @interpolate(flat, first) shift: vec2f,");
        values.push_str(", shift");
    }
    format!(
        "struct Vertex {{\n    @builtin(position) position: vec4f,{given}\n}}\n\
         @vertex fn pass_on(@location(0) p: vec4f{taken}) -> Vertex {{\n    \
         return Vertex(vec4f(p.x, -p.y, (p.z + p.w) * 0.5, p.w){values});\n}}\n"
    )
}

/// The value within ±2²⁰; what is no number stays none.
fn bounded(value: &str, ty: &str) -> String {
    format!("select({value}, sign({value}) * 1048576.0, abs({value}) > {ty}(1048576.0))")
}
