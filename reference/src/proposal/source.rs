//! A solution as a lecturer gives it.

use super::Given;
use crate::assignment::AssignmentError;
use crate::interpreter::{Program, Refusal, Stage, outline};
use crate::page::{self, Page};
use crate::text::both;

/// A solution, compiled.
pub(super) struct SolutionFile {
    /// The name of the file as it was given.
    given: String,
    /// How many lines of the text were added before those of the file as it was given.
    added: u32,
    /// The name of the file that students hand in.
    pub name: String,
    pub stage: Stage,
    pub text: String,
    pub program: Program,
    /// What stands behind `#version`, such as `330 core`; nothing where there is none.
    pub version: String,
    /// The function that students write: `main`, or `mainImage`.
    pub entry: &'static str,
    /// Whether `main` and what pages for sharing shaders declare were added.
    pub is_wrapped: bool,
}

impl SolutionFile {
    pub fn extension(&self) -> &'static str {
        match self.stage {
            Stage::Vertex => "vert",
            Stage::Fragment => "frag",
        }
    }

    /// Its name in the folder.
    pub fn solution_name(&self) -> String {
        format!("solution.{}", self.extension())
    }

    pub fn starter_name(&self) -> String {
        format!("starter.{}", self.extension())
    }

    /// The number behind `#version`; that of GLSL 1.10 where there is none.
    pub fn version_number(&self) -> u32 {
        self.version.split_whitespace().next().and_then(|number| number.parse().ok()).unwrap_or(110)
    }

    /// An error at a line of the text, as a place in the file that was given; 0: about the whole file.
    pub fn wrong(&self, line: u32, message: crate::Text) -> AssignmentError {
        self.placed(wrong(&self.given, line, message))
    }

    /// An error about the solution in the folder, as a place in the file that was given.
    pub fn placed(&self, error: AssignmentError) -> AssignmentError {
        let found = error.in_column_of(&self.text);
        let line = found.line.and_then(|line| line.checked_sub(self.added)).filter(|line| *line > 0);
        AssignmentError { file: self.given.clone(), line, ..found }
    }

    /// All words of the file.
    pub fn words(&self) -> Vec<outline::Word> {
        outline::words(&self.text)
    }
}

/// The solutions, the vertex stage first.
pub(super) fn read_all(id: &str, given: &[Given]) -> Result<Vec<SolutionFile>, AssignmentError> {
    let mut sources = given.iter().map(|given| read(id, given)).collect::<Result<Vec<_>, _>>()?;
    sources.sort_by_key(|source| source.stage == Stage::Fragment);
    match &sources[..] {
        [] => Err(AssignmentError::of_file(
            "--from",
            both(
                "no solution is given: name a vertex shader, a fragment shader, or both",
                "解答がありません。頂点シェーダ、フラグメントシェーダ、またはその両方を指定してください",
            ),
        )),
        [_] => Ok(sources),
        [vertex, fragment] if vertex.stage != fragment.stage => Ok(sources),
        [_, second, ..] => Err(AssignmentError::of_file(
            &second.name,
            both(
                "is a second solution of its stage: give at most one vertex and one fragment shader",
                "同じステージの 2 つ目の解答です。頂点シェーダとフラグメントシェーダを 1 つずつまで指定してください",
            ),
        )),
    }
}

fn read(id: &str, given: &Given) -> Result<SolutionFile, AssignmentError> {
    let Given { name, text } = given;
    let page = Page::of(text);
    let is_wrapped = page.is_some();
    let stage = stage_of(name, text, is_wrapped)?;
    let (text, added) = page.map_or_else(|| (text.clone(), 0), |page| on_page(text, &page));
    let version = version_of(&text);
    let number: u32 = version.split_whitespace().next().and_then(|number| number.parse().ok()).unwrap_or(110);
    if number < 130 || version.ends_with("es") {
        return Err(too_old(name, &text, &version));
    }
    let program = Program::compile(&text, stage).map_err(|refusal| refused(name, &given.text, &refusal, added))?;
    let stem = name.rsplit_once('.').map_or(name.as_str(), |(stem, _)| stem);
    let stem = if stem == "solution" || stem.is_empty() { id } else { stem };
    let extension = if stage == Stage::Vertex { "vert" } else { "frag" };
    let has_image = outline::functions(&text).iter().any(|function| function.name.text == "mainImage");
    let entry = if has_image { "mainImage" } else { "main" };
    let given = name.clone();
    Ok(SolutionFile {
        given,
        added,
        name: format!("{stem}.{extension}"),
        stage,
        text,
        program,
        version,
        entry,
        is_wrapped,
    })
}

/// The stage by the name of the file, or else by what is in it.
fn stage_of(name: &str, text: &str, is_image: bool) -> Result<Stage, AssignmentError> {
    let lower = name.to_lowercase();
    let ends = |known: &[&str]| known.iter().any(|end| lower.ends_with(end));
    if ends(&[".vert", ".vs", ".vsh", ".vertex", ".vert.glsl", ".vs.glsl"]) {
        return Ok(Stage::Vertex);
    }
    if ends(&[".frag", ".fs", ".fsh", ".fragment", ".frag.glsl", ".fs.glsl"]) || is_image {
        return Ok(Stage::Fragment);
    }
    let words = outline::words(text);
    if words.iter().any(|word| word.text == "gl_Position") {
        return Ok(Stage::Vertex);
    }
    if ends(&[".glsl", ".txt"]) {
        return Ok(Stage::Fragment);
    }
    Err(AssignmentError::of_file(
        name,
        both(
            "which stage is it? Call it NAME.vert or NAME.frag; piglit's tests end in .shader_test",
            "どのステージのファイルか分かりません。名前.vert または 名前.frag という名前にしてください。piglit のテストは .shader_test です",
        ),
    ))
}

/// What stands behind `#version`.
fn version_of(text: &str) -> String {
    let line = text.lines().find_map(|line| line.trim_start().strip_prefix('#')?.trim_start().strip_prefix("version"));
    let line = line.unwrap_or_default();
    line.split("//").next().unwrap_or_default().trim().to_owned()
}

fn too_old(name: &str, text: &str, version: &str) -> AssignmentError {
    let line = text.lines().position(|line| line.trim_start().starts_with("#version")).map_or(1, |at| at + 1);
    let (en, ja) = match version {
        "" => ("there is no #version".to_owned(), "#version がありません".to_owned()),
        version => (
            format!("#version {version} is not desktop GLSL from 1.30 on"),
            format!("#version {version} は、デスクトップ版 GLSL 1.30 以降ではありません"),
        ),
    };
    wrong(
        name,
        line as u32,
        both(
            format!(
                "{en}: write `#version 330 core` in the first line, `in` and `out` for `attribute` and `varying`, an output for \
                 `gl_FragColor`, and `texture(…)` for `texture2D(…)`"
            ),
            format!(
                "{ja}。1 行目を `#version 330 core` とし、`attribute` と `varying` は `in` と `out` に、`gl_FragColor` は出力変数に、\
                 `texture2D(…)` は `texture(…)` に書き換えてください"
            ),
        ),
    )
}

/// The text with what the page adds that it is shown on, and how many lines stand before it.
fn on_page(text: &str, page: &Page) -> (String, u32) {
    let body = text.strip_prefix('\u{feff}').unwrap_or(text).trim_start();
    let (version, rest) = match body.starts_with("#version") {
        true => body.split_once('\n').unwrap_or((body, "")),
        false => (page::VERSION, body),
    };
    let added = page.declarations.len() + 1 + usize::from(!body.starts_with("#version"));
    let declarations = page.declarations.join("\n");
    (format!("{version}\n{declarations}\n\n{}\n\n{}\n", rest.trim_end(), page.main), added as u32)
}

/// What the interpreter says of a solution, with the place in the file as it was given.
fn refused(name: &str, text: &str, refusal: &Refusal, added: u32) -> AssignmentError {
    let line = refusal.line.saturating_sub(added);
    let lacks = refusal.what().en.strip_prefix("there is no variable `").and_then(|rest| rest.split('`').next());
    let mut message = refusal.what().clone();
    let declared = lacks.and_then(|name| FREE_IN_THREE.iter().find(|(known, _)| *known == name));
    if let Some((known, said)) = declared {
        message.en += &format!(": three.js declares `{known}` by itself; write `{said}` behind #version");
        message.ja += &format!("。three.js は `{known}` を自動で宣言します。#version の次に `{said}` と書いてください");
    } else if !refusal.is_limit() {
        message.en += "; mend the solution first";
        message.ja += "。まず解答を直してください";
    }
    wrong(name, line, message).in_column_of(text)
}

/// What three.js declares in every shader.
const FREE_IN_THREE: [(&str, &str); 9] = [
    ("modelMatrix", "uniform mat4 modelMatrix;"),
    ("modelViewMatrix", "uniform mat4 modelViewMatrix;"),
    ("projectionMatrix", "uniform mat4 projectionMatrix;"),
    ("viewMatrix", "uniform mat4 viewMatrix;"),
    ("normalMatrix", "uniform mat3 normalMatrix;"),
    ("cameraPosition", "uniform vec3 cameraPosition;"),
    ("position", "in vec3 position;"),
    ("normal", "in vec3 normal;"),
    ("uv", "in vec2 uv;"),
];

/// An error at a line of a file that was given; 0: about the whole file.
pub(super) fn wrong(name: &str, line: u32, message: crate::Text) -> AssignmentError {
    AssignmentError { line: (line > 0).then_some(line), ..AssignmentError::of_file(name, message) }
}
