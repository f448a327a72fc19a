//! Shaders as pages for sharing them have them: `mainImage` in place of `main`, and what the page declares.

use crate::interpreter::outline;

/// The version that such a page reads a shader as.
pub const VERSION: &str = "#version 330 core";

/// What the pages give a shader: the name, and how it is declared.
const GIVEN: [(&str, &str); 9] = [
    ("iResolution", "uniform vec3 iResolution;"),
    ("iTime", "uniform float iTime;"),
    ("iTimeDelta", "uniform float iTimeDelta;"),
    ("iFrame", "uniform int iFrame;"),
    ("iMouse", "uniform vec4 iMouse;"),
    ("iChannel0", "uniform sampler2D iChannel0;"),
    ("iChannel1", "uniform sampler2D iChannel1;"),
    ("iChannel2", "uniform sampler2D iChannel2;"),
    ("iChannel3", "uniform sampler2D iChannel3;"),
];

/// What a page adds to a shader.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Page {
    /// The declarations before it: what it uses and does not declare itself, and an output.
    pub declarations: Vec<String>,
    /// The `main` behind it.
    pub main: String,
}

impl Page {
    /// What a page adds to this text; `None` where it is a shader by itself.
    pub fn of(text: &str) -> Option<Self> {
        let functions = outline::functions(text);
        let has = |wanted: &str| functions.iter().any(|function| function.name.text == wanted);
        if !has("mainImage") || has("main") {
            return None;
        }
        let words = outline::words(text);
        // A macro may be all that uses a name.
        let uses = |name: &str| text.contains(name);
        let declares = |name: &str| {
            let at = words.iter().position(|word| word.text == name);
            at.and_then(|at| words.get(at.checked_sub(2)?)).is_some_and(|before| before.text == "uniform")
        };
        let given = GIVEN.iter().filter(|(name, _)| uses(name) && !declares(name));
        let mut declarations: Vec<String> = given.map(|(_, declaration)| (*declaration).to_owned()).collect();
        let output = if uses("pixel") { "pixel_" } else { "pixel" };
        declarations.push(format!("out vec4 {output};"));
        Some(Self { declarations, main: format!("void main() {{ mainImage({output}, gl_FragCoord.xy); }}") })
    }
}
