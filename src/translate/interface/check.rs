//! What a shader declares, held against what the program feeds.

use super::{LinkedInterface, Variable, place};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;
use crate::source::Source;
use crate::translate::entry::StageVariable;
use crate::translate::spirv::DeclaredUniform;
use crate::translate::{Shader, Stage, TranslationRefusal, blocks};
use naga::ScalarKind;

impl DeclaredUniform {
    /// Whether the program sets this part by `path`; an array without an index is its first element.
    fn is_at(&self, path: &str) -> bool {
        let is_it = |own: &str| own == path || own.strip_suffix("[0]") == Some(path);
        is_it(&self.path) || self.own_name().is_some_and(is_it)
    }

    /// What a member of a block without an instance name goes by; an array of blocks has one.
    pub(in crate::translate) fn own_name(&self) -> Option<&str> {
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
pub(in crate::translate) fn check(
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
    notes.extend(blocks::renamed(&shader.known.declared, &interface.placed, source));
    for unset in &shader.known.unset {
        match interface.uniforms.iter().find(|uniform| uniform.name == unset.name) {
            Some(expected) if unset.ty != "block" => errors.push(wrong_type(source, "uniform", expected, unset.ty)),
            _ => notes.push(unset_uniform(source, &unset.name, interface)),
        }
    }
    for attribute in shader.inputs.iter().filter(|_| shader.stage == Stage::Vertex) {
        let Some(expected) = interface.inputs.iter().find(|input| input.name == attribute.name) else { continue };
        // A shader may take fewer components than there are, and whole numbers with a sign or without.
        let is_whole = matches!(attribute.kind, Some(ScalarKind::Sint | ScalarKind::Uint));
        let is_number = is_whole || attribute.kind == Some(ScalarKind::Float);
        if !is_number || is_whole != whole_numbers(&expected.ty).is_some() || attribute.width != 4 {
            errors.push(wrong_type(source, "in", expected, &attribute.ty));
        }
    }
    match shader.stage {
        Stage::Vertex => errors.extend(too_many_numbers(shader)),
        // Only the first target is the window's.
        Stage::Fragment => {
            let mut seen = shader.outputs.iter().filter(|output| output.location == 0);
            errors.extend(seen.find_map(|output| of_whole_numbers(source, output)));
        }
    }
    // Elements of an array are declared in one place, and are wrong together.
    errors.dedup_by_key(|error| error.line.zip(error.column).ok_or_else(|| error.message.clone()));
    if errors.is_empty() { Ok(notes) } else { Err(TranslationRefusal::Rejected(errors)) }
}

/// As drivers count: a vector of any length takes a place of four numbers.
fn too_many_numbers(shader: &Shader) -> Option<Diagnostic> {
    const MOST: usize = 128;
    let numbers = 4 * shader.outputs.len();
    (numbers > MOST).then(|| {
        Diagnostic::error(
            DiagnosticStage::Interface,
            Text::new(
                format!("the vertex stage hands over {numbers} numbers, and no driver need take more than {MOST}"),
                format!(
                    "頂点シェーダの出力が {numbers} 個の数値になります。ドライバが受け取れるのは {MOST} 個までです"
                ),
            ),
        )
    })
}

/// What OpenGL shows of whole numbers in a window is undefined.
fn of_whole_numbers(source: &Source, output: &StageVariable) -> Option<Diagnostic> {
    let StageVariable { name, ty, kind, size, .. } = output;
    matches!(kind, Some(ScalarKind::Sint | ScalarKind::Uint)).then(|| {
        let other = if *size == 1 { "float".to_owned() } else { format!("vec{size}") };
        let diagnostic = Diagnostic::error(
            DiagnosticStage::Interface,
            Text::new(
                format!(
                    "`{name}` is declared as `{ty}`, but a colour in the window is made of numbers from 0.0 to 1.0"
                ),
                format!("`{name}` が `{ty}` と宣言されていますが、ウィンドウの色は 0.0 から 1.0 までの実数です"),
            ),
        );
        place(diagnostic, source, name).hint(Text::new(
            format!("Declare it as `out {other} {name};`."),
            format!("`out {other} {name};` と宣言してください。"),
        ))
    })
}

/// Whether a path is that of a uniform, or of a part of it.
fn is_part_of(path: &str, whole: &str) -> bool {
    path.strip_prefix(whole).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

/// How many components a type of whole numbers or truth values has; `None` for another type.
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

pub(in crate::translate) fn unset_uniform(source: &Source, name: &str, interface: &LinkedInterface) -> Diagnostic {
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
