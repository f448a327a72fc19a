//! The stage that is not handed in: a vertex stage that feeds a fragment solution's inputs, or a fragment stage that shows what
//! a vertex solution writes.

mod declarations;
mod feeds;
mod meaning;

use super::FolderPlan;
use super::shader_test::ShaderTest;
use super::source::SolutionFile;
use super::uniforms::{ProposedAttribute, ProposedUniform, usual_space};
use crate::assignment::AssignmentError;
use crate::interpreter::{ProgramVariable, Scalar, Stage, Type};
use crate::text::both;
use declarations::{declared, fragment_of, path_of_output};
use feeds::{Feeds, attribute_name};
use meaning::{meaning, said};

/// A stage that is not handed in.
pub(super) struct FixedFile {
    pub stage: Stage,
    pub text: String,
}

impl FixedFile {
    /// Its name in the folder.
    pub fn name(&self) -> String {
        match self.stage {
            Stage::Vertex => "fixed.vert".to_owned(),
            Stage::Fragment => "fixed.frag".to_owned(),
        }
    }
}

/// Writes the stage that is missing, and says what it is fed with.
pub(super) fn fix(plan: &mut FolderPlan, test: Option<&ShaderTest>) -> Result<(), AssignmentError> {
    match &plan.sources[..] {
        [source] if source.stage == Stage::Fragment => vertex_of(plan, test),
        [source] => {
            let text = fragment_of(source);
            plan.fixed = Some(FixedFile { stage: Stage::Fragment, text });
            plan.guessed(
                "fixed.frag: written, shows the outputs of the vertex shader as a colour",
                "fixed.frag: 頂点シェーダの出力を色として表示するように書きました",
            );
            Ok(())
        }
        _ => Ok(()),
    }
}

/// Whether nothing of a fragment solution speaks of a scene: no inputs but texture coordinates, no camera, no sky.
fn is_of_window(plan: &FolderPlan, source: &SolutionFile) -> bool {
    let inputs = source.program.inputs().iter().filter(|input| !input.name.starts_with("gl_"));
    let is_flat = |input: &ProgramVariable| matches!(input.kind, Type::Vector(Scalar::Float, 2));
    let carries = plan.uniforms.iter().any(|uniform| uniform.lines.iter().any(|line| line.starts_with("carries")));
    inputs.clone().all(is_flat) && !carries
}

fn vertex_of(plan: &mut FolderPlan, test: Option<&ShaderTest>) -> Result<(), AssignmentError> {
    let source = &plan.sources[0];
    let usual = usual_space(&plan.sources);
    if let Some(test) = test.filter(|test| test.is_passthrough()) {
        let text = format!(
            "#version {}\nin vec4 piglit_vertex;\nvoid main() {{ gl_Position = piglit_vertex; }}\n",
            source.version
        );
        plan.fixed = Some(FixedFile { stage: Stage::Vertex, text });
        plan.attributes = test.passthrough();
        return Ok(());
    }
    let is_of_window = is_of_window(plan, source);
    let mut feeds = Feeds { source, known: &plan.uniforms, uniforms: Vec::new(), attributes: Vec::new() };
    let inputs: Vec<&ProgramVariable> =
        source.program.inputs().iter().filter(|input| !input.name.starts_with("gl_")).collect();
    let mut lines = Vec::new();
    let mut told = Vec::new();
    for input in &inputs {
        if input.kind.slots().is_none_or(|slots| slots > 9) || matches!(input.kind, Type::Array(..) | Type::Struct(_)) {
            let (name, kind) = (&input.name, &input.kind);
            let message = both(
                format!(
                    "nothing is known that feeds the input `{name}`, a {kind}: give the vertex shader as well, with `--from`"
                ),
                format!("入力 `{name}` ({kind}) に渡すものが分かりません。頂点シェーダも `--from` で指定してください"),
            );
            return Err(source.wrong(input.line, message));
        }
        let meaning = meaning(input, usual);
        let value = feeds.value(meaning, &input.kind);
        let written = path_of_output(&input.name);
        lines.push(format!("    {written} = {value};"));
        told.push((input.name.clone(), said(meaning)));
    }
    let position = feeds.attribute("position");
    let place = if is_of_window {
        format!("    gl_Position = vec4({position}, 1.0);")
    } else {
        let (model, view) = (feeds.matrix("model", "mat4", "model"), feeds.matrix("view", "mat4", "view"));
        let projection = feeds.matrix("projection", "mat4", "projection");
        format!("    gl_Position = {projection} * {view} * {model} * vec4({position}, 1.0);")
    };
    lines.push(place);
    let mut head = vec![format!("#version {}", source.version)];
    head.extend(feeds.attributes.iter().map(|(carries, kind)| format!("in {kind} {};", attribute_name(carries))));
    head.extend(feeds.uniforms.iter().map(|(_, kind, name)| format!("uniform {kind} {name};")));
    head.extend(declared(&inputs, "out", source.version_number()));
    let text = format!("{}\n\nvoid main()\n{{\n{}\n}}\n", head.join("\n"), lines.join("\n"));
    let attributes = feeds.attributes.iter().map(|(carries, _)| ProposedAttribute {
        name: attribute_name(carries).to_owned(),
        said: format!("carries = {carries:?}"),
    });
    let attributes: Vec<_> = attributes.collect();
    let new = feeds.uniforms.iter().filter(|(_, _, name)| !plan.uniforms.iter().any(|known| known.name == *name));
    let new: Vec<ProposedUniform> = new
        .map(|(role, _, name)| ProposedUniform {
            name: name.clone(),
            lines: vec![format!("carries = {role:?}")],
            note: None,
            texture: None,
        })
        .collect();
    plan.attributes = attributes;
    plan.uniforms.splice(0..0, new);
    plan.fixed = Some(FixedFile { stage: Stage::Vertex, text });
    for (name, (en, ja)) in told {
        plan.guessed(
            format!("fixed.vert feeds `{name}` with {en}"),
            format!("fixed.vert は `{name}` に{ja}を渡します"),
        );
    }
    Ok(())
}
