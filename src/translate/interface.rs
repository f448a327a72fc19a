//! What the assignment's program feeds to the shader and takes from it.

use super::blocks::{self, PlacedUniform};
use super::spirv::{CommonTexture, DeclaredUniform};
use super::{Shader, Stage, TranslationRefusal};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
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

/// The interface between the assignment's program and the student's vertex shader.
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

impl DeclaredUniform {
    /// Whether the program sets this part by `path`; an array without an index is its first element.
    fn is_at(&self, path: &str) -> bool {
        let is_it = |own: &str| own == path || own.strip_suffix("[0]") == Some(path);
        is_it(&self.path) || self.own_name().is_some_and(is_it)
    }

    /// What a member of a block without an instance name goes by; an array of blocks has one.
    fn own_name(&self) -> Option<&str> {
        let (block, member) = self.path.split_once('.')?;
        (self.is_in_block && !block.ends_with(']')).then_some(member)
    }

    /// Whether it holds what the program passes as a value of this type. A block is filled with bits: whole numbers are the same
    /// with a sign and without, and truth values are whole numbers there.
    fn takes(&self, ty: &str) -> bool {
        let is_filled_alike =
            self.is_in_block && whole_numbers(ty).is_some_and(|own| whole_numbers(&self.ty) == Some(own));
        self.ty == ty || is_filled_alike
    }

    /// The variable as the program sets it, and as it is declared, where one of the two has parts and the other is one
    /// value.
    fn other_shape(&self, uniform: &Variable) -> Option<(Variable, &str)> {
        let shape = |outer: &str, inner: &str| {
            let rest = inner.strip_prefix(outer)?;
            match rest.split_once(']').filter(|_| rest.starts_with('[')) {
                Some((_, element)) if element.starts_with('.') => Some("struct"),
                Some(_) => Some("array"),
                None => rest.starts_with('.').then_some("struct"),
            }
        };
        let member = self.own_name();
        if let Some("struct") = shape(&uniform.name, &self.path) {
            return Some((uniform.clone(), "struct"));
        }
        let own = [Some(self.path.as_str()), member].into_iter().flatten();
        let (name, whole) = own.filter_map(|own| Some((own, shape(own, &uniform.name)?))).next()?;
        Some((Variable { name: name.into(), ty: whole.into() }, &self.ty))
    }
}

/// Holds what the shader declares against what the program feeds.
///
/// # Errors
/// A uniform or attribute of the program's that the shader declares with a type it cannot be fed with.
pub(super) fn check(
    shader: &Shader,
    source: &Source,
    interface: &LinkedInterface,
) -> Result<Vec<Diagnostic>, TranslationRefusal> {
    let mut errors = Vec::new();
    let mut notes = Vec::new();
    let mut noted: Vec<&str> = Vec::new();
    let is_laid_out = |declared: &&DeclaredUniform| {
        let root = declared.path.split('.').next().unwrap_or_default();
        declared.is_in_block && interface.placed.iter().any(|own| own.place.block == root)
    };
    for declared in shader.known.declared.iter().filter(|declared| !is_laid_out(declared)) {
        if let Some(expected) = interface.uniforms.iter().find(|uniform| declared.is_at(&uniform.name)) {
            if !declared.takes(&expected.ty) {
                errors.push(wrong_type(source, "uniform", expected, &declared.ty));
            }
        } else if let Some((expected, ty)) = interface.uniforms.iter().find_map(|uniform| declared.other_shape(uniform))
        {
            errors.push(wrong_type(source, "uniform", &expected, ty));
        } else if let root = &declared.path[..declared.path.find('[').unwrap_or(declared.path.len())]
            && !noted.contains(&root)
            && !interface.uniforms.iter().any(|uniform| is_part_of(&uniform.name, root))
        {
            noted.push(root);
            notes.push(unset_uniform(source, root, interface));
        }
    }
    errors.dedup();
    let [wrong, others] = blocks::told(&shader.misplaced, source, interface);
    errors.extend(wrong);
    notes.extend(others);
    for unset in &shader.known.unset {
        match interface.uniforms.iter().find(|uniform| uniform.name == unset.name) {
            Some(expected) if unset.ty != "block" => errors.push(wrong_type(source, "uniform", expected, unset.ty)),
            _ => notes.push(unset_uniform(source, &unset.name, interface)),
        }
    }
    for attribute in shader.inputs.iter().filter(|_| shader.stage == super::Stage::Vertex) {
        let Some(expected) = interface.inputs.iter().find(|input| input.name == attribute.name) else { continue };
        // A shader may take fewer components than there are, and whole numbers with a sign or without.
        let is_whole = matches!(attribute.kind, Some(ScalarKind::Sint | ScalarKind::Uint));
        let is_number = is_whole || attribute.kind == Some(ScalarKind::Float);
        if !is_number || is_whole != whole_numbers(&expected.ty).is_some() || attribute.width != 4 {
            errors.push(wrong_type(source, "in", expected, &attribute.ty));
        }
    }
    // Elements of an array are declared in one place, and are wrong together.
    errors.dedup_by_key(|error| error.line.zip(error.column).ok_or_else(|| error.message.clone()));
    if errors.is_empty() { Ok(notes) } else { Err(TranslationRefusal::Rejected(errors)) }
}

/// Whether a path is that of a uniform, or of a part of it.
fn is_part_of(path: &str, whole: &str) -> bool {
    path.strip_prefix(whole).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

/// How many components a type of whole numbers or truth values has; none of another type.
fn whole_numbers(ty: &str) -> Option<u8> {
    match ty {
        "bool" | "int" | "uint" => Some(1),
        _ => ty.strip_prefix(['b', 'i', 'u'])?.strip_prefix("vec")?.parse().ok(),
    }
}

fn wrong_type(source: &Source, qualifier: &str, expected: &Variable, declared: &str) -> Diagnostic {
    let Variable { name, ty } = expected;
    let diagnostic = Diagnostic::error(
        DiagnosticStage::Interface,
        Text::new(
            format!("`{name}` is declared as `{declared}`, but the program passes a `{ty}`"),
            format!("`{name}` が `{declared}` と宣言されていますが、プログラムが渡すのは `{ty}` です"),
        ),
    );
    let diagnostic = place(diagnostic, source, name);
    if name.contains(['.', '[']) {
        return diagnostic;
    }
    diagnostic.hint(Text::new(
        format!("The handed-out file declares it as `{qualifier} {ty} {name};`."),
        format!("配布されたファイルの宣言は `{qualifier} {ty} {name};` です。"),
    ))
}

pub(super) fn unset_uniform(source: &Source, name: &str, interface: &LinkedInterface) -> Diagnostic {
    let known: Vec<_> = interface.uniforms.iter().map(|uniform| format!("`{}`", uniform.name)).collect();
    let diagnostic = Diagnostic::warning(
        DiagnosticStage::Interface,
        Text::new(
            format!("the program never sets the uniform `{name}`: it keeps its initial value, 0 where there is none"),
            format!("uniform 変数 `{name}` にはプログラムから値が渡されません。初期値 (なければ 0) のままになります"),
        ),
    )
    .hint(Text::new(
        format!("The program sets {}.", known.join(", ")),
        format!("プログラムが値を渡すのは {} です。", known.join("、")),
    ));
    place(diagnostic, source, name)
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
