//! Built-in variables and constants (GLSL 4.60, chapter 7).

use crate::interpreter::Stage;
use crate::interpreter::syntax::StorageQualifier;
use crate::interpreter::types::{Scalar, Struct, Type};
use std::sync::Arc;

/// Where a built-in variable lives in this stage, and its type.
pub fn variable(name: &str, stage: Stage) -> Option<(StorageQualifier, Type)> {
    let vector = |count| Type::Vector(Scalar::Float, count);
    let (input, output) = (StorageQualifier::Input, StorageQualifier::Output);
    Some(match (name, stage) {
        ("gl_Position", Stage::Vertex) => (output, vector(4)),
        ("gl_PointSize", Stage::Vertex) => (output, vector(1)),
        ("gl_ClipDistance" | "gl_CullDistance", Stage::Vertex) => (output, vector(1).array(Some(8))),
        ("gl_ClipDistance" | "gl_CullDistance", Stage::Fragment) => (input, vector(1).array(Some(8))),
        ("gl_VertexID" | "gl_InstanceID" | "gl_BaseVertex" | "gl_BaseInstance" | "gl_DrawID", Stage::Vertex) => {
            (input, Type::INT)
        }
        ("gl_Layer" | "gl_ViewportIndex", Stage::Vertex) => (output, Type::INT),
        ("gl_FragCoord", Stage::Fragment) => (input, vector(4)),
        ("gl_FrontFacing" | "gl_HelperInvocation", Stage::Fragment) => (input, Type::BOOL),
        ("gl_PointCoord" | "gl_SamplePosition", Stage::Fragment) => (input, vector(2)),
        ("gl_PrimitiveID" | "gl_SampleID" | "gl_Layer" | "gl_ViewportIndex", Stage::Fragment) => (input, Type::INT),
        ("gl_SampleMaskIn", Stage::Fragment) => (input, Type::INT.array(Some(1))),
        ("gl_FragDepth", Stage::Fragment) => (output, vector(1)),
        ("gl_SampleMask", Stage::Fragment) => (output, Type::INT.array(Some(1))),
        ("gl_FragColor", Stage::Fragment) => (output, vector(4)),
        ("gl_FragData", Stage::Fragment) => (output, vector(4).array(Some(8))),
        ("gl_DepthRange", _) => {
            let members = ["near", "far", "diff"].map(|name| (name.to_owned(), Type::FLOAT)).to_vec();
            let structure = Struct::new("gl_DepthRangeParameters".to_owned(), 0, members);
            (StorageQualifier::Uniform, Type::Struct(Arc::new(structure)))
        }
        ("gl_NumSamples", _) => (StorageQualifier::Uniform, Type::INT),
        _ => return None,
    })
}

/// The limits that a program can read: of a desktop driver with OpenGL 4, which is what ggrade's compiler is told.
pub fn constant(name: &str, version: u32) -> Option<i32> {
    let known = match name.strip_prefix("gl_M")? {
        "axLights" | "axClipPlanes" | "axTextureUnits" | "axTextureCoords" if version > 150 => return None,
        "axLights" | "axClipPlanes" | "axTextureUnits" | "axTextureCoords" | "axClipDistances" => 8,
        "axCullDistances" | "axCombinedClipAndCullDistances" | "axDrawBuffers" | "axImageUnits" => 8,
        "axVertexAttribs" | "axGeometryTextureImageUnits" | "axViewports" => 16,
        "axTessControlTextureImageUnits" | "axTessEvaluationTextureImageUnits" => 16,
        "axVertexUniformComponents" | "axFragmentUniformComponents" => 4096,
        "axVertexUniformVectors" | "axFragmentUniformVectors" => 1024,
        "axVaryingFloats" | "axVaryingComponents" | "axVertexOutputComponents" | "axFragmentInputComponents" => 128,
        "axVaryingVectors" | "axVertexOutputVectors" | "axFragmentInputVectors" => 32,
        "axVertexTextureImageUnits" | "axTextureImageUnits" | "axPatchVertices" => 32,
        "axCombinedTextureImageUnits" => 192,
        "axGeometryInputComponents" | "axGeometryVaryingComponents" | "axTessGenLevel" => 64,
        "axGeometryOutputComponents" => 128,
        "axGeometryOutputVertices" => 256,
        "axGeometryTotalOutputComponents" | "axGeometryUniformComponents" => 1024,
        "axSamples" => 4,
        "inProgramTexelOffset" => -8,
        "axProgramTexelOffset" => 7,
        _ => return None,
    };
    Some(known)
}
