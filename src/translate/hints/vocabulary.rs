//! The words of GLSL, and those of its relatives that students bring along.

use crate::translate::Stage;

/// Types of GLSL that a shader may name.
const TYPES: &str = "void bool int uint float double vec2 vec3 vec4 dvec2 dvec3 dvec4 bvec2 bvec3 bvec4 ivec2 ivec3 \
    ivec4 uvec2 uvec3 uvec4 mat2 mat3 mat4 mat2x2 mat2x3 mat2x4 mat3x2 mat3x3 mat3x4 mat4x2 mat4x3 mat4x4 dmat2 dmat3 \
    dmat4 dmat2x2 dmat2x3 dmat2x4 dmat3x2 dmat3x3 dmat3x4 dmat4x2 dmat4x3 dmat4x4 sampler1D sampler2D sampler3D \
    samplerCube sampler2DShadow sampler2DArray samplerCubeShadow isampler2D usampler2D samplerBuffer";

/// Qualifiers of declarations.
const QUALIFIERS: &str = "const in out inout uniform buffer attribute varying flat smooth noperspective centroid sample \
    patch invariant precise layout highp mediump lowp shared";

/// Further keywords of GLSL 3.30 to 4.60.
const KEYWORDS: &str = "if else for while do switch case default break continue return discard struct true false \
    precision subroutine coherent volatile restrict readonly writeonly";

/// Built-in functions of every stage.
const FUNCTIONS: &str = "radians degrees sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh pow exp log exp2 log2 \
    sqrt inversesqrt abs sign floor trunc round roundEven ceil fract mod modf min max clamp mix step smoothstep isnan \
    isinf floatBitsToInt floatBitsToUint intBitsToFloat uintBitsToFloat fma frexp ldexp length distance dot cross \
    normalize faceforward reflect refract matrixCompMult outerProduct transpose determinant inverse lessThan \
    lessThanEqual greaterThan greaterThanEqual equal notEqual any all not texture textureLod textureSize texelFetch \
    textureProj textureGrad textureOffset textureProjLod textureGather texelFetchOffset textureQueryLevels bitCount \
    bitfieldExtract bitfieldInsert bitfieldReverse findLSB findMSB packUnorm2x16 unpackUnorm2x16 packHalf2x16 unpackHalf2x16 \
    packUnorm4x8 unpackUnorm4x8";

/// Those that only fragment shaders have.
const FRAGMENT_FUNCTIONS: &str = "dFdx dFdy fwidth dFdxFine dFdyFine fwidthFine dFdxCoarse dFdyCoarse fwidthCoarse";

/// Built-in variables of a vertex shader.
const VERTEX_VARIABLES: &str = "gl_Position gl_PointSize gl_ClipDistance gl_VertexID gl_InstanceID";

/// Built-in variables of a fragment shader.
const FRAGMENT_VARIABLES: &str = "gl_FragCoord gl_FrontFacing gl_PointCoord gl_FragDepth gl_ClipDistance gl_PrimitiveID gl_SampleID gl_SamplePosition";

fn has(list: &str, word: &str) -> bool {
    list.split_ascii_whitespace().any(|known| known == word)
}

/// Whether `word` is a type of GLSL.
pub fn is_type(word: &str) -> bool {
    has(TYPES, word)
}

/// Whether `word` qualifies a declaration.
pub fn is_qualifier(word: &str) -> bool {
    has(QUALIFIERS, word)
}

/// Whether `word` is a type, a qualifier or another keyword.
pub fn is_keyword(word: &str) -> bool {
    is_type(word) || is_qualifier(word) || has(KEYWORDS, word)
}

/// Whether `word` begins a statement and cannot go on with one.
pub fn begins_statement(word: &str) -> bool {
    is_keyword(word) && !matches!(word, "true" | "false" | "else")
}

/// Whether `word` is a built-in function of a stage.
pub fn is_function(stage: Stage, word: &str) -> bool {
    functions(stage).any(|known| known == word)
}

fn functions<'a>(stage: Stage) -> impl Iterator<Item = &'a str> {
    let own: &'a str = if stage == Stage::Fragment { FRAGMENT_FUNCTIONS } else { "" };
    [FUNCTIONS, own].into_iter().flat_map(str::split_ascii_whitespace)
}

/// All keywords and types, for finding the one that was meant.
pub fn keywords<'a>() -> impl Iterator<Item = &'a str> {
    let lists: [&'a str; 3] = [TYPES, QUALIFIERS, KEYWORDS];
    lists.into_iter().flat_map(str::split_ascii_whitespace)
}

/// Built-in functions and types, which are called the same way.
pub fn callables<'a>(stage: Stage) -> impl Iterator<Item = &'a str> {
    let types: &'a str = TYPES;
    functions(stage).chain(types.split_ascii_whitespace())
}

/// Built-in variables of a stage.
pub fn variables<'a>(stage: Stage) -> impl Iterator<Item = &'a str> {
    let list: &'a str = if stage == Stage::Fragment { FRAGMENT_VARIABLES } else { VERTEX_VARIABLES };
    list.split_ascii_whitespace()
}

/// Whether a stage has a function or variable of this name.
pub fn is_built_in(stage: Stage, word: &str) -> bool {
    is_function(stage, word) || variables(stage).any(|known| known == word)
}

/// Where a word that is no GLSL of today comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// GLSL before version 1.40.
    OldGlsl,
    /// HLSL.
    Hlsl,
    /// C or C++.
    C,
    /// The fragment shader's side of GLSL.
    Fragment,
}

/// What stands in today's GLSL for a word from elsewhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instead {
    /// This word.
    Word(&'static str),
    /// An attribute, a uniform or the output that the assignment's program has.
    Interface,
    /// Nothing of that kind.
    Nothing,
}

/// Words from elsewhere, by origin: `word=replacement`, `word:` for a part of the interface, `word` for nothing.
const FOREIGN: [(Origin, &str); 4] = [
    (
        Origin::OldGlsl,
        "gl_Vertex: gl_Normal: gl_Color: gl_MultiTexCoord0: gl_ModelViewMatrix: gl_ModelViewProjectionMatrix: \
         gl_NormalMatrix: gl_ProjectionMatrix: gl_FrontColor: gl_BackColor: gl_TexCoord: gl_LightSource gl_FrontMaterial \
         gl_FrontLightProduct gl_LightModel gl_FrontLightModelProduct gl_ClipVertex=gl_ClipDistance ftransform: \
         attribute=in varying=out texture1D=texture texture2D=texture texture3D=texture textureCube=texture \
         texture2DLod=textureLod",
    ),
    (
        Origin::Hlsl,
        "float1=float float2=vec2 float3=vec3 float4=vec4 half2=vec2 half3=vec3 half4=vec4 int2=ivec2 int3=ivec3 \
         int4=ivec4 uint2=uvec2 uint3=uvec3 uint4=uvec4 bool2=bvec2 bool3=bvec3 bool4=bvec4 double2=dvec2 double3=dvec3 \
         double4=dvec4 float2x2=mat2 float3x3=mat3 float4x4=mat4 matrix=mat4 vector=vec4 mul=* saturate=clamp lerp=mix \
         frac=fract rsqrt=inversesqrt atan2=atan fmod=mod ddx ddy clip mad=fma tex2D=texture Sample=texture cbuffer=uniform \
         Texture2D=sampler2D SamplerState register SV_Position=gl_Position SV_POSITION=gl_Position SV_Target SV_VertexID=gl_VertexID",
    ),
    (
        Origin::C,
        "new delete malloc printf cout std string String char boolean=bool Boolean=bool auto nullptr NULL let var def function and=&& or=|| TRUE=true FALSE=false True=true False=false \
         powf=pow sqrtf=sqrt fabs=abs fabsf=abs fmax=max fmaxf=max fmin=min fminf=min sinf=sin cosf=cos glm=vec3 fmodf=mod \
         size_t=int power=pow maximum=max minimum=min Vector3=vec3 Vector4=vec4 Matrix4=mat4 Vec3=vec3 Vec4=vec4 Mat4=mat4",
    ),
    (Origin::Fragment, "gl_FragColor: gl_FragCoord gl_FragData: gl_FrontFacing gl_FragDepth dFdx dFdy fwidth"),
];

/// Where `word` comes from and what GLSL has instead, if it is known from elsewhere.
pub fn foreign(word: &str) -> Option<(Origin, Instead)> {
    FOREIGN.iter().find_map(|&(origin, list)| {
        list.split_ascii_whitespace().find_map(|entry| {
            let (name, instead) = match entry.split_once('=') {
                Some((name, instead)) => (name, Instead::Word(instead)),
                None if entry.ends_with(':') => (entry.trim_end_matches(':'), Instead::Interface),
                None => (entry, Instead::Nothing),
            };
            (name == word).then_some((origin, instead))
        })
    })
}

/// The one of `known` that `word` was most likely meant to be, if one is near: the same but for capitals, or a letter
/// or two away.
pub fn nearest<'a>(word: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let mut best: Option<(usize, &str)> = None;
    let length = word.chars().count();
    for candidate in known.filter(|candidate| *candidate != word) {
        let distance = if candidate.eq_ignore_ascii_case(word) {
            0
        } else {
            strsim::damerau_levenshtein(&word.to_ascii_lowercase(), &candidate.to_ascii_lowercase())
        };
        // Names of one or two letters are all near each other: only their capitals may differ.
        let allowed = match length.max(candidate.len()) {
            0..=2 => 0,
            3..=5 => 1,
            _ => 2,
        };
        if distance <= allowed && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// The only one of `known` that has a word in common with `word`, as `normalAt` with `get_normal`.
pub fn of_one_word<'a>(word: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    /// Shorter ones say little: `to`, `at`, `get`.
    const LEAST_LETTERS: usize = 4;
    let words = |name: &str| -> Vec<String> {
        let mut words = vec![String::new()];
        for letter in name.chars() {
            if letter == '_' || letter.is_uppercase() {
                words.push(String::new());
            }
            if let Some(last) = words.last_mut().filter(|_| letter != '_') {
                last.extend(letter.to_lowercase());
            }
        }
        words.retain(|word| word.len() >= LEAST_LETTERS);
        words
    };
    let own = words(word);
    let mut shared = known.filter(|known| words(known).iter().any(|word| own.contains(word)));
    let one = shared.next()?;
    shared.all(|other| other == one).then_some(one)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_what_was_meant() {
        let known = || callables(Stage::Vertex).chain(["iamb", "idiff", "l", "v", "cv", "pv"]);
        for (word, meant) in [
            ("Max", Some("max")),
            ("iamp", Some("iamb")),
            ("normalise", Some("normalize")),
            ("Normalize", Some("normalize")),
            ("dott", Some("dot")),
            ("nomralize", Some("normalize")),
            ("V", Some("v")),
            ("nv", None),
            ("k", None),
            ("teapot", None),
        ] {
            assert_eq!(nearest(word, known()), meant, "{word}");
        }
    }

    #[test]
    fn a_word_in_common_tells_what_was_meant_where_only_one_has_it() {
        let known = ["normalAt", "scene", "sphere_at", "fog"];
        assert_eq!(of_one_word("get_normal", known.into_iter()), Some("normalAt"));
        assert_eq!(of_one_word("fogAt", known.into_iter()), None);
        assert_eq!(of_one_word("sphereColor", ["sphereAt", "sphereEdge"].into_iter()), None);
    }

    #[test]
    fn a_name_is_not_its_own_correction() {
        assert_eq!(nearest("max", ["max", "min"].into_iter()), None);
    }

    #[test]
    fn knows_words_from_elsewhere() {
        assert_eq!(foreign("float3"), Some((Origin::Hlsl, Instead::Word("vec3"))));
        assert_eq!(foreign("gl_Normal"), Some((Origin::OldGlsl, Instead::Interface)));
        assert_eq!(foreign("ddx"), Some((Origin::Hlsl, Instead::Nothing)));
        assert_eq!(foreign("max"), None);
    }
}
