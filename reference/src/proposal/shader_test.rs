//! piglit's `.shader_test`: stages, vertex data and a script in one file. What it draws is taken as the scene, its shaders are the
//! solution; what it expects at pixels follows from the solution, and is left out.

mod drawing;
mod homework;

use super::Given;
use super::source::wrong;
use crate::assignment::AssignmentError;
use crate::interpreter::outline;
use crate::text::both;
use drawing::{TestDraw, VertexData};
use std::collections::BTreeMap;

/// A test, read.
pub(super) struct ShaderTest {
    /// The stages that it has as text.
    pub stages: Vec<Given>,
    has_passthrough: bool,
    data: VertexData,
    draws: Vec<TestDraw>,
    /// By name: the number of draws before it was set, and the values as they are written.
    uniforms: BTreeMap<String, Vec<(usize, Vec<f64>)>>,
    background: [f64; 4],
    size: [u32; 2],
}

/// What the passthrough stage and `draw rect` call a position.
const VERTEX: &str = "piglit_vertex";

struct TestReader<'a> {
    file: &'a str,
    text: &'a str,
    test: ShaderTest,
    version: String,
    /// The vertex and the fragment stage: the line in which each begins, and its text.
    vertex: Option<(u32, String)>,
    fragment: Option<(u32, String)>,
    clear: [f64; 4],
}

/// Reads a test.
///
/// # Errors
/// What it has that no homework has, with the line.
pub(super) fn read(given: &Given) -> Result<ShaderTest, AssignmentError> {
    let test = ShaderTest {
        stages: Vec::new(),
        has_passthrough: false,
        data: VertexData::default(),
        draws: Vec::new(),
        uniforms: BTreeMap::new(),
        background: [0.0, 0.0, 0.0, 0.0],
        size: [250, 250],
    };
    let mut reader = TestReader {
        file: &given.name,
        text: &given.text,
        test,
        version: "130".to_owned(),
        vertex: None,
        fragment: None,
        clear: [0.0; 4],
    };
    let mut section = String::new();
    for (number, line) in (1_u32..).zip(given.text.lines()) {
        if line.starts_with('[') && line.trim_end().ends_with(']') {
            section = line.trim().to_owned();
            reader.begin(&section, number)?;
            continue;
        }
        reader.line(&section, line, number)?;
    }
    reader.finish()
}

impl TestReader<'_> {
    fn refused<T>(&self, line: u32, what: &str) -> Result<T, AssignmentError> {
        let message = both(
            format!("`{what}` is not taken from a .shader_test: take it out, or write the homework's folder by hand"),
            format!("`{what}` は .shader_test から読み取れません。取り除くか、課題のフォルダを直接書いてください"),
        );
        Err(wrong(self.file, line, message).in_column_of(self.text))
    }

    fn begin(&mut self, section: &str, number: u32) -> Result<(), AssignmentError> {
        match section {
            "[require]" | "[test]" | "[vertex data]" | "[comment]" => Ok(()),
            "[vertex shader passthrough]" => {
                self.test.has_passthrough = true;
                Ok(())
            }
            "[vertex shader]" if self.vertex.is_none() => {
                self.vertex = Some((number, String::new()));
                Ok(())
            }
            "[fragment shader]" if self.fragment.is_none() => {
                self.fragment = Some((number, String::new()));
                Ok(())
            }
            other => self.refused(number, other),
        }
    }

    fn line(&mut self, section: &str, line: &str, number: u32) -> Result<(), AssignmentError> {
        match section {
            "[vertex shader]" => push(&mut self.vertex, line),
            "[fragment shader]" => push(&mut self.fragment, line),
            "[vertex data]" => {
                let said = line.split('#').next().unwrap_or_default();
                if let Err(what) = self.test.data.line(said) {
                    return self.refused(number, &what);
                }
            }
            "[require]" => return self.requirement(strip(line), number),
            "[test]" => return self.command(strip(line), number),
            _ => {}
        }
        Ok(())
    }

    fn requirement(&mut self, line: &str, number: u32) -> Result<(), AssignmentError> {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["GLSL", ">=", version] => self.version = version.replace('.', ""),
            ["GLSL", "ES", ..] | ["GL", "ES", ..] => return self.refused(number, line),
            ["SIZE", width, height] => {
                let (Ok(width), Ok(height)) = (width.parse(), height.parse()) else {
                    return self.refused(number, line);
                };
                self.test.size = [width, height];
            }
            // What a driver has to know is found out by compiling.
            _ => {}
        }
        Ok(())
    }

    fn command(&mut self, line: &str, number: u32) -> Result<(), AssignmentError> {
        let words: Vec<&str> = line.split_whitespace().collect();
        let floats = |words: &[&str]| words.iter().map(|word| drawing::number(word)).collect::<Option<Vec<f64>>>();
        match words[..] {
            [] => Ok(()),
            ["probe" | "relative", ..] | ["link", "success"] => Ok(()),
            ["clear", "color", ref rest @ ..] => match floats(rest).as_deref() {
                Some(&[r, g, b, a]) => {
                    self.clear = [r, g, b, a];
                    Ok(())
                }
                _ => self.refused(number, line),
            },
            ["clear"] => {
                // What was drawn before is gone; the uniforms stay.
                self.test.draws.clear();
                self.test.uniforms.values_mut().for_each(|values| {
                    values.last_mut().into_iter().for_each(|last| last.0 = 0);
                    values.drain(..values.len() - 1);
                });
                self.test.background = self.clear;
                Ok(())
            }
            ["uniform", _, name, ref rest @ ..] => match floats(rest) {
                Some(values) if !values.is_empty() => {
                    let before = self.test.draws.len();
                    let known = self.test.uniforms.entry(name.to_owned()).or_default();
                    known.retain(|(draw, _)| *draw != before);
                    known.push((before, values));
                    Ok(())
                }
                _ => self.refused(number, line),
            },
            ["draw", "rect", "ortho", ref rest @ ..] => match floats(rest).as_deref() {
                Some(&[x, y, width, height]) => {
                    // In pixels.
                    let [across, up] = self.test.size.map(|side| 2.0 / f64::from(side));
                    let rectangle = [x * across - 1.0, y * up - 1.0, width * across, height * up];
                    self.test.draws.push(TestDraw::Rectangle(rectangle));
                    Ok(())
                }
                _ => self.refused(number, line),
            },
            ["draw", "rect", ref rest @ ..] => match floats(rest).as_deref() {
                Some(&[x, y, width, height]) => {
                    self.test.draws.push(TestDraw::Rectangle([x, y, width, height]));
                    Ok(())
                }
                _ => self.refused(number, line),
            },
            ["draw", "arrays", mode, first, count] => {
                let (first, count) = (first.parse::<u32>(), count.parse::<u32>());
                match (drawing::primitive(mode), first, count) {
                    (Some(mode), Ok(first), Ok(count)) => {
                        self.test.draws.push(TestDraw::Arrays { mode, first, count });
                        Ok(())
                    }
                    _ => self.refused(number, line),
                }
            }
            _ => self.refused(number, line),
        }
    }

    fn finish(mut self) -> Result<ShaderTest, AssignmentError> {
        let version = self.version.clone();
        let lacks = |what: &str| {
            let message =
                both(format!("there is no {what}: write one"), format!("{what} がありません。書いてください"));
            AssignmentError::of_file(self.file, message)
        };
        let Some(fragment) = self.fragment.take() else { return Err(lacks("[fragment shader]")) };
        if self.vertex.is_none() && !self.test.has_passthrough {
            return Err(lacks("[vertex shader] or [vertex shader passthrough]"));
        }
        if self.test.draws.is_empty() {
            return Err(lacks("`draw rect` or `draw arrays` in [test]"));
        }
        let stem = self.file.trim_end_matches(".shader_test");
        for (extension, stage) in [("vert", self.vertex.take()), ("frag", Some(fragment))] {
            let Some((_, text)) = stage else { continue };
            let text = modern(text.trim_start_matches('\n'), &version);
            self.test.stages.push(Given { name: format!("{stem}.{extension}"), text });
        }
        Ok(self.test)
    }
}

fn push(stage: &mut Option<(u32, String)>, line: &str) {
    if let Some((_, text)) = stage {
        *text += line;
        text.push('\n');
    }
}

/// A line without its comment.
fn strip(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim()
}

/// The text with the version that the test asks for, and with an attribute in place of `gl_Vertex`.
fn modern(text: &str, version: &str) -> String {
    let has_version = text.lines().any(|line| line.trim_start().starts_with("#version"));
    let mut text = if has_version { text.to_owned() } else { format!("#version {version}\n{text}") };
    let old: Vec<_> = outline::words(&text).into_iter().filter(|word| word.text == "gl_Vertex").collect();
    for word in old.iter().rev() {
        text.replace_range(word.range.clone(), VERTEX);
    }
    if !old.is_empty() {
        let head = text.lines().take_while(|line| line.is_empty() || line.trim_start().starts_with('#'));
        let at: usize = head.map(|line| line.len() + 1).sum();
        text.insert_str(at.min(text.len()), &format!("in vec4 {VERTEX};\n"));
    }
    text
}
