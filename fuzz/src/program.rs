//! Random bytes → a shader that mostly compiles: what lies behind the compiler is not reached by random text.

// Tests include this file by its path, and find the module beside it by that alone.
#[path = "program/templates.rs"]
mod templates;

use std::fmt::Write as _;
use templates::{Type, leaf, of_fragments, templates};

/// Deepest nesting of statements and of expressions.
const DEEPEST: usize = 6;

/// Reads a vertex shader off `bytes`; where they end, everything becomes as simple as it can.
pub fn program(bytes: &[u8]) -> String {
    written(bytes, false)
}

/// The same as a fragment shader: `given_pv` and `given_cv` hold what a vertex shader takes from its attributes, a texel for
/// each pixel, and `picture` is looked up anywhere.
#[allow(dead_code, reason = "not everything that includes this module draws fragments")]
pub fn fragment(bytes: &[u8]) -> String {
    written(bytes, true)
}

fn written(bytes: &[u8], is_fragment: bool) -> String {
    let mut writer = Writer { bytes: bytes.iter(), text: String::new(), functions: 0, names: 0, is_fragment };
    writer.file();
    writer.text
}

/// The variables that every function has beside those that are made of its parameters.
const OTHERS: &str = "ivec3 j = ivec3(n * 3.0); uvec2 e = uvec2(k, 5u); bvec3 c = bvec3(b, true, false); mat2x3 w = mat2x3(n, n.zxy); double r = double(u);";

struct Writer<'a> {
    bytes: std::slice::Iter<'a, u8>,
    text: String,
    functions: usize,
    names: usize,
    is_fragment: bool,
}

impl Writer<'_> {
    fn byte(&mut self) -> usize {
        usize::from(self.bytes.next().copied().unwrap_or(0))
    }

    fn pick<'b>(&mut self, of: &[&'b str]) -> &'b str {
        of[self.byte() % of.len()]
    }

    fn file(&mut self) {
        self.text += "#version 410\n";
        self.text += if self.is_fragment {
            "uniform sampler2D given_pv;\nuniform sampler2D given_cv;\nuniform sampler2D picture;\nvec4 pv;\nvec4 cv;\n"
        } else {
            "in vec4 pv;\nin vec4 cv;\n"
        };
        self.text += "uniform mat4 mw;\nuniform mat4 mc;\nuniform mat4 mg;\nout vec4 vc;\n";
        self.text += "struct S { float f; vec3 v; int a[5]; };\nfloat g;\nvec4 field[7];\nint many[9];\nS made;\n";
        for _ in 0..self.byte() % 4 {
            let number = self.functions;
            let _ = writeln!(
                self.text,
                "float f{number}(float x, inout vec3 y, out int z) {{\n  z = int(x);\n  float u = x; int i = 1; uint k = 2u; bool b = true; vec2 d = vec2(x); vec3 n = y; vec4 q = vec4(x); mat3 m = mat3(x); {OTHERS}"
            );
            self.block(0, true);
            self.text += "  return u;\n}\n";
            self.functions += 1;
        }
        self.text += "void main() {\n";
        if self.is_fragment {
            self.text += "  ivec2 here = ivec2(gl_FragCoord.xy); pv = texelFetch(given_pv, here, 0); cv = texelFetch(given_cv, here, 0);\n";
        }
        self.text += "  float u = pv.x; int i = int(cv.y * 9.0); uint k = uint(i); bool b = u > 0.0; vec2 d = pv.xy; vec3 n = cv.xyz; vec4 q = mw * pv; mat3 m = mat3(mg); ";
        self.text += OTHERS;
        self.text += "\n";
        self.block(0, false);
        self.text += "  vc = vec4(q.x + n.y, u + d.x + float(r), float((i ^ int(k ^ e.x)) & 1023), ";
        self.text += "m[1].z + w[1].y + (b ^^ c.y ? 1.0 : float(j.y & 255)));\n";
        self.text += if self.is_fragment { "}\n" } else { "  gl_Position = mc * pv;\n}\n" };
    }

    fn block(&mut self, depth: usize, returns: bool) {
        for _ in 0..self.byte() % 5 {
            self.statement(depth, returns);
        }
    }

    fn statement(&mut self, depth: usize, returns: bool) {
        let choice = self.byte() % 16;
        match choice {
            _ if depth >= DEEPEST => self.assignment(depth),
            0..=6 => self.assignment(depth),
            7 | 8 => {
                self.text += "if (";
                self.expression(Type::Bool, depth);
                self.text += ") {\n";
                self.block(depth + 1, returns);
                self.text += "} else {\n";
                self.block(depth + 1, returns);
                self.text += "}\n";
            }
            9 | 10 => {
                let name = self.fresh();
                let most = self.byte() % 40;
                let _ = write!(self.text, "for (int {name} = 0; {name} < {most}; ++{name}) {{\ni += {name};\n");
                self.block(depth + 1, returns);
                let word = self.pick(&["", "if (u > 3.0) break;", "if (b) continue;"]);
                self.text += word;
                self.text += "}\n";
            }
            11 => {
                self.text += "while (";
                self.expression(Type::Bool, depth);
                self.text += ") {\n";
                self.block(depth + 1, returns);
                self.text += "if (++i > 30) break;\n}\n";
            }
            12 => {
                self.text += "do {\n";
                self.block(depth + 1, returns);
                self.text += "} while (++i < 20);\n";
            }
            13 => {
                self.text += "switch (i % 4) {\n";
                for case in 0..self.byte() % 4 {
                    let _ = writeln!(self.text, "case {case}:");
                    self.assignment(depth + 1);
                    let end = self.pick(&["break;\n", "", "i++;\n"]);
                    self.text += end;
                }
                self.text += "default: i--;\n}\n";
            }
            14 if self.functions > 0 => {
                let number = self.byte() % self.functions;
                let _ = write!(self.text, "u = f{number}(");
                self.expression(Type::Float, depth);
                self.text += ", n, i);\n";
            }
            15 if self.is_fragment => {
                self.text += "if (";
                self.expression(Type::Bool, depth);
                self.text += ") discard;\n";
            }
            _ if returns => {
                self.text += "if (b) return ";
                self.expression(Type::Float, depth);
                self.text += ";\n";
            }
            _ => self.assignment(depth),
        }
    }

    fn fresh(&mut self) -> String {
        self.names += 1;
        format!("t{}", self.names)
    }

    fn assignment(&mut self, depth: usize) {
        let (kind, name) = [
            (Type::Float, "u"),
            (Type::Int, "i"),
            (Type::Uint, "k"),
            (Type::Bool, "b"),
            (Type::Vec2, "d"),
            (Type::Vec3, "n"),
            (Type::Vec4, "q"),
            (Type::Mat3, "m"),
            (Type::Float, "g"),
            (Type::Float, "made.f"),
            (Type::Vec3, "made.v"),
            (Type::Float, "q[i & 3]"),
            (Type::Vec4, "field[i]"),
            (Type::Int, "many[k]"),
            (Type::Vec2, "q.wx"),
            (Type::Vec3, "m[i]"),
            (Type::Int, "made.a[i]"),
            (Type::IVec3, "j"),
            (Type::UVec2, "e"),
            (Type::BVec3, "c"),
            (Type::Mat2x3, "w"),
            (Type::Double, "r"),
            (Type::Vec3, "w[i & 1]"),
            (Type::Int, "j[k & 1u]"),
        ][self.byte() % 24];
        let arithmetic = !matches!(kind, Type::Bool | Type::Mat3 | Type::BVec3 | Type::Mat2x3);
        let operator = if arithmetic { self.pick(&["=", "+=", "*=", "-="]) } else { "=" };
        let _ = write!(self.text, "{name} {operator} ");
        self.expression(kind, depth);
        self.text += ";\n";
    }

    fn expression(&mut self, kind: Type, depth: usize) {
        if depth >= DEEPEST {
            self.text += leaf(kind);
            return;
        }
        let (common, more) = (templates(kind), if self.is_fragment { of_fragments(kind) } else { &[] });
        let choice = self.byte() % (common.len() + more.len());
        let template = common.get(choice).copied().unwrap_or_else(|| more[choice - common.len()]);
        // Mesa's OpenGL driver ends the process that divides the least integer by -1; ggrade's own way never does that.
        let template = match template {
            "I / I" if self.is_fragment => "I / max(I, 1)",
            "I % I" if self.is_fragment => "I % max(I, 1)",
            other => other,
        };
        let mut before = ' ';
        for (at, part) in template.char_indices() {
            let after = template[at + part.len_utf8()..].chars().next().unwrap_or(' ');
            let is_in_a_word = before.is_ascii_alphanumeric() || after.is_ascii_alphanumeric();
            before = part;
            match Type::of_letter(part).filter(|_| !is_in_a_word) {
                Some(kind) => self.expression(kind, depth + 1),
                None => self.text.push(part),
            }
        }
    }
}
