//! What the assignment's program feeds to the shader and takes from it.

mod check;

pub(super) use check::{check, unset_uniform};

use super::Stage;
use super::blocks::PlacedUniform;
use super::spirv::CommonTexture;
use crate::diagnostic::Diagnostic;
use crate::fault::Fault;
use crate::language::Text;
use crate::source::Source;
use naga::{Scalar, ScalarKind, TypeInner};
use reference::interpreter::outline;
use reference::{Assignment, assignment};
use std::ffi::CString;

/// A variable of the interface.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Its GLSL type, such as `mat4`.
    pub ty: String,
}

/// The interface between the assignment's program and a stage of it.
#[derive(Clone, Debug)]
pub struct LinkedInterface {
    /// The stage that sees it.
    pub stage: Stage,
    /// Vertex attributes.
    pub inputs: Vec<Variable>,
    /// The same as the homework has them.
    pub attributes: Vec<assignment::Input>,
    /// Uniforms of the default block.
    pub uniforms: Vec<Variable>,
    /// What the shader writes: the varyings that the fixed fragment shader reads, or a fragment shader's colours.
    pub outputs: Vec<Variable>,
    /// Names of the constants that the handed-out file defines.
    pub constants: Vec<String>,
    /// The parts of blocks that are filled byte by byte.
    pub placed: Vec<PlacedUniform>,
    /// Names of the functions that the handed-out files have beside `main`.
    pub functions: Vec<String>,
    /// The fixed fragment shader.
    pub fragment: CString,
    /// The line with `#version` of what is handed out.
    pub version: String,
    /// What all textures have in common, where they do.
    pub alike: Option<CommonTexture>,
}

impl LinkedInterface {
    /// What the program of an assignment feeds and takes. The fixed fragment stage is empty where that is handed in.
    pub fn of(assignment: &Assignment) -> Result<Self, Fault> {
        let broken = |what: &str| Fault::new(Text::verbatim(format!("assignment {}: {what}", assignment.id)));
        let variable =
            |name: &str, kind: &reference::interpreter::Type| Variable { name: name.into(), ty: kind.to_string() };
        let fixed = assignment.fixed.iter().find(|fixed| fixed.stage == Stage::Fragment);
        let fixed = fixed.map_or("", |fixed| fixed.text.as_str());
        // Of two with one name the last counts: it is the student's own.
        let all = &assignment.interface.uniforms;
        let is_last = |(place, uniform): &(usize, &assignment::Uniform)| {
            all[place + 1..].iter().all(|other| other.path != uniform.path)
        };
        let uniforms = all.iter().enumerate().filter(is_last);
        if assignment.interface.outputs.is_empty() {
            return Err(broken("there is no output"));
        }
        Ok(Self {
            stage: Stage::Vertex,
            inputs: assignment.interface.inputs.iter().map(|input| variable(&input.name, &input.kind)).collect(),
            attributes: assignment.interface.inputs.clone(),
            uniforms: uniforms.map(|(_, uniform)| variable(&uniform.path, &uniform.kind)).collect(),
            outputs: assignment.interface.outputs.iter().map(|output| variable(&output.name, &output.kind)).collect(),
            constants: assignment.constants.iter().map(|constant| constant.name.clone()).collect(),
            placed: PlacedUniform::of(assignment),
            functions: assignment.files.iter().flat_map(|file| functions(file.starter_shader())).collect(),
            version: assignment
                .files
                .iter()
                .flat_map(|file| file.starter.lines())
                .find(|line| line.trim_start().starts_with("#version"))
                .unwrap_or("#version 410 core")
                .trim()
                .to_owned(),
            alike: CommonTexture::of(&assignment.textures),
            fragment: CString::new(fixed).map_err(|_| broken("a NUL in the fixed stage"))?,
        })
    }

    /// The output that is looked at where only one is: the vertex's colour.
    pub fn colour(&self) -> &str {
        self.outputs.first().map_or("", |output| &output.name)
    }

    /// Whether it is what the shader writes.
    pub(super) fn is_output(&self, name: &str) -> bool {
        self.outputs.iter().any(|output| output.name == name)
    }

    /// The uniforms and blocks that the program sets, as a whole or in part.
    pub(super) fn set_uniforms(&self) -> Vec<&str> {
        let root = |path: &'_ str| path.find(['.', '[']).unwrap_or(path.len());
        let mut roots: Vec<&str> = self.uniforms.iter().map(|uniform| &uniform.name[..root(&uniform.name)]).collect();
        // A block may be filled whatever its members are called.
        roots.extend(self.placed.iter().map(|own| own.place.block.as_str()));
        roots.dedup();
        roots
    }
}

/// The functions of a text that stand beside `main`.
fn functions(text: &str) -> Vec<String> {
    let all = outline::functions(text).into_iter().map(|function| function.name.text);
    all.filter(|name| name != "main").collect()
}

/// Puts the diagnostic at the first place where the code has `name`, or the last name of that path, as a word: its
/// declaration.
pub(crate) fn place(diagnostic: Diagnostic, source: &Source, name: &str) -> Diagnostic {
    let name = name.rsplit('.').next().unwrap_or(name);
    let name = name.split('[').next().unwrap_or(name);
    if name.is_empty() {
        return diagnostic;
    }
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    for number in 1..=source.line_count() {
        let line = source.code_line(number);
        for (at, _) in line.match_indices(name) {
            let before = line[..at].chars().next_back().is_some_and(is_word);
            let after = line[at + name.len()..].chars().next().is_some_and(is_word);
            if !before && !after {
                let column = line[..at].chars().count() as u32 + 1;
                return diagnostic.at(number, Some(column)).spanning(name.len());
            }
        }
    }
    diagnostic
}

/// The name that GLSL gives to a type of the module.
pub(super) fn type_name(ty: &TypeInner) -> String {
    let prefix = |scalar: &Scalar| match (scalar.kind, scalar.width) {
        (ScalarKind::Float, 8) => "d",
        (ScalarKind::Sint, _) => "i",
        (ScalarKind::Uint, _) => "u",
        (ScalarKind::Bool, _) => "b",
        _ => "",
    };
    match ty {
        TypeInner::Scalar(scalar) => match (scalar.kind, scalar.width) {
            (ScalarKind::Float, 8) => "double".into(),
            (ScalarKind::Sint, _) => "int".into(),
            (ScalarKind::Uint, _) => "uint".into(),
            (ScalarKind::Bool, _) => "bool".into(),
            _ => "float".into(),
        },
        TypeInner::Vector { size, scalar } => format!("{}vec{}", prefix(scalar), *size as u8),
        TypeInner::Matrix { columns, rows, scalar } if columns == rows => {
            format!("{}mat{}", prefix(scalar), *columns as u8)
        }
        TypeInner::Matrix { columns, rows, scalar } => {
            format!("{}mat{}x{}", prefix(scalar), *columns as u8, *rows as u8)
        }
        TypeInner::Array { .. } => "array".into(),
        _ => "struct".into(),
    }
}
