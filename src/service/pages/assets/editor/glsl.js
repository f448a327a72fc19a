// The words of GLSL 4.10 in their colours, and how lines are indented.
import { StreamLanguage } from "@codemirror/language";

const each = (prefixes, stems) => prefixes.split(" ").flatMap((prefix) => stems.split(" ").map((stem) => (prefix === "-" ? "" : prefix) + stem)).join(" ");
const SAMPLERS = "1D 2D 3D Cube 2DRect 1DArray 2DArray CubeArray Buffer 2DMS 2DMSArray";
const WORDS = {
  keyword: `attribute const uniform varying buffer shared centroid flat smooth noperspective layout patch sample break
    continue do for while switch case default if else subroutine in out inout discard return struct precision highp
    mediump lowp invariant precise`,
  type: `void bool int uint float double ${each("- d b i u", "vec2 vec3 vec4")}
    ${each("- d", "mat2 mat3 mat4 mat2x2 mat2x3 mat2x4 mat3x2 mat3x3 mat3x4 mat4x2 mat4x3 mat4x4")}
    ${each("sampler isampler usampler", SAMPLERS)}
    ${each("sampler", "1DShadow 2DShadow CubeShadow 2DRectShadow 1DArrayShadow 2DArrayShadow CubeArrayShadow")}`,
  builtin: `radians degrees sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh pow exp log exp2 log2 sqrt
    inversesqrt abs sign floor trunc round roundEven ceil fract mod modf min max clamp mix step smoothstep isnan isinf
    floatBitsToInt floatBitsToUint intBitsToFloat uintBitsToFloat fma frexp ldexp length distance dot cross normalize
    faceforward reflect refract matrixCompMult outerProduct transpose determinant inverse lessThan lessThanEqual
    greaterThan greaterThanEqual equal notEqual any all not texture textureProj textureLod textureOffset texelFetch
    texelFetchOffset textureProjOffset textureLodOffset textureProjLod textureGrad textureGather textureSize dFdx dFdy
    fwidth gl_Position gl_PointSize gl_ClipDistance gl_VertexID gl_InstanceID gl_FragCoord gl_FrontFacing gl_PointCoord
    gl_FragDepth gl_PrimitiveID`,
  atom: "true false",
};
const kinds = new Map(Object.entries(WORDS).flatMap(([kind, words]) => words.trim().split(/\s+/).map((word) => [word, kind])));

const comment = (stream, state) => {
  state.inComment = !stream.match(/^.*?\*\//);
  if (state.inComment) stream.skipToEnd();
  return "comment";
};

export const glsl = StreamLanguage.define({
  name: "glsl",
  // open: the indentation of each line that opened a bracket; isDone: whether the last statement is over.
  startState: () => ({ inComment: false, open: [], isDone: true }),
  copyState: (state) => ({ ...state, open: [...state.open] }),
  token(stream, state) {
    if (state.inComment) return comment(stream, state);
    if (stream.eatSpace()) return null;
    if (stream.match("//")) {
      stream.skipToEnd();
      return "comment";
    }
    if (stream.match("/*")) return comment(stream, state);
    if (stream.indentation() === stream.column() && stream.match(/^#(?:(?!\/[/*]).)*/)) return "meta";
    const bracket = stream.match(/^[{}()[\];]/)?.[0];
    if (bracket) {
      if ("{([".includes(bracket)) state.open.push(stream.indentation());
      else if (bracket !== ";") state.open.pop();
      state.isDone = "{};".includes(bracket);
      return null;
    }
    state.isDone = false;
    if (stream.match(/^(?:0[xX][\da-fA-F]+[uU]?|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?(?:lf|LF|[uUfF])?)/)) return "number";
    const word = stream.match(/^[A-Za-z_]\w*/)?.[0];
    if (word) return kinds.get(word) ?? "variable";
    stream.next();
    return null;
  },
  indent(state, after, context) {
    if (state.inComment) return null;
    const inner = state.open.length ? state.open.at(-1) + context.unit : 0;
    if (/^[})\]]/.test(after)) return Math.max(0, inner - context.unit);
    return state.isDone || /^[{#]/.test(after) ? inner : inner + context.unit;
  },
  languageData: { commentTokens: { line: "//", block: { open: "/*", close: "*/" } }, indentOnInput: /^\s*[{}#]$/ },
});
