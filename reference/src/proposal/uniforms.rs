//! What feeds a solution: each uniform and each vertex attribute gets a source, by its name and type.

mod attributes;
mod space;
mod textures;
mod tree;
mod uses;

use super::FolderPlan;
use super::guess::{self, Context, Guess, guess};
use super::names::{self, NameWords, Space};
use super::shader_test::ShaderTest;
use super::source::SolutionFile;
use crate::assignment::AssignmentError;
use crate::interpreter::{ProgramVariable, Scalar, Stage, Type};
use crate::text::both;
use space::negated;
pub(super) use space::usual_space;
use std::collections::HashMap;
pub(super) use textures::ProposedTexture;
use tree::{ProposedValue, Tree, empty, has, insert, split, write};

/// A vertex attribute of a stage.
#[derive(Clone, Debug)]
pub(super) struct ProposedAttribute {
    pub name: String,
    /// `carries = "position"`, or `values = …`.
    pub said: String,
}

/// An entry `[[uniform]]`.
#[derive(Clone, Debug)]
pub(super) struct ProposedUniform {
    pub name: String,
    /// `key = value`, one line each.
    pub lines: Vec<String>,
    /// What the name was taken for, where it was a guess.
    pub note: Option<(String, String)>,
    pub texture: Option<ProposedTexture>,
}

/// Feeds all uniforms and attributes of the solutions.
pub(super) fn feed(plan: &mut FolderPlan, test: Option<&ShaderTest>) -> Result<(), AssignmentError> {
    let space = usual_space(&plan.sources);
    if let Some(at) = plan.sources.iter().position(|source| source.stage == Stage::Vertex) {
        plan.attributes = attributes::attributes(plan, at, test)?;
    }
    let mut seen: HashMap<&'static str, usize> = HashMap::new();
    let mut all: Vec<(String, Tree)> = Vec::new();
    let mut textures = textures::ProposedTextures::default();
    for source in &plan.sources {
        for uniform in source.program.uniforms().iter().filter(|uniform| !uniform.name.starts_with("gl_")) {
            let (root, rest) = split(&uniform.name);
            if all.iter().any(|(known, tree)| known == root && has(tree, rest)) {
                continue;
            }
            let changing = test.and_then(|test| test.expression_of(&uniform.name, &uniform.kind));
            let constant = test.and_then(|test| test.value_of(&uniform.name, &uniform.kind));
            let said = match (changing, constant) {
                (Some(text), _) => ProposedValue::Line(format!("is = {text:?}")),
                (_, Some(value)) => {
                    ProposedValue::Value { value, probe: None, what: ("value of the test", "テストの値") }
                }
                _ => leaf(source, uniform, space, &mut seen, &mut textures)?,
            };
            match all.iter_mut().find(|(known, _)| known == root) {
                Some((_, tree)) => insert(tree, rest, said),
                None => {
                    let mut tree = empty(rest);
                    insert(&mut tree, rest, said);
                    all.push((root.to_owned(), tree));
                }
            }
        }
    }
    let mut entries = Vec::new();
    all.iter().for_each(|(name, tree)| write(name, tree, &mut entries));
    plan.uniforms = entries;
    tell(plan);
    Ok(())
}

fn tell(plan: &mut FolderPlan) {
    let lines: Vec<_> =
        plan.uniforms.iter().map(|entry| (entry.name.clone(), entry.lines[0].clone(), entry.note.clone())).collect();
    for (name, line, note) in lines {
        let line = line.split_whitespace().collect::<Vec<_>>().join(" ");
        match note {
            None => plan.read(format!("uniform `{name}`: {line}"), format!("uniform `{name}`: {line}")),
            Some((en, ja)) => {
                let line = if line.chars().count() > 60 {
                    format!("{}…", line.chars().take(59).collect::<String>())
                } else {
                    line
                };
                plan.guessed(
                    format!("uniform `{name}`, taken for {en}: {line}"),
                    format!("uniform `{name}` ({ja} とみなす): {line}"),
                );
            }
        }
    }
}

fn leaf(
    source: &SolutionFile,
    uniform: &ProgramVariable,
    space: Space,
    seen: &mut HashMap<&'static str, usize>,
    textures: &mut textures::ProposedTextures,
) -> Result<ProposedValue, AssignmentError> {
    let (name, kind) = (NameWords::of(&uniform.name), &uniform.kind);
    if let Type::Sampler(sampler) = kind {
        let path = &uniform.name;
        let refused = || {
            let known = "sampler1D, sampler2D, sampler2DArray, sampler3D and samplerCube";
            let ja = known.replace(" and ", "、").replace(", ", "、");
            source.wrong(
                uniform.line,
                both(
                    format!("`{path}` is a {kind}: a homework's textures are read by {known}; declare one of them"),
                    format!(
                        "`{path}` は {kind} です。課題のテクスチャを読めるのは {ja} です。どれかで宣言してください"
                    ),
                ),
            )
        };
        return textures.of(path, *sampler).map(ProposedValue::Texture).ok_or_else(refused);
    }
    if let Some(line) = by_role(&uniform.name, &name, kind, names::space_of(&name, space)) {
        return Ok(ProposedValue::Line(line));
    }
    if let Some(count) = longest_array(source).filter(|_| *kind == Type::INT && name.has(&["num", "count", "number"])) {
        let probe = Some(format!("{{ within = [1, {count}] }}"));
        return Ok(ProposedValue::Value {
            value: count.to_string(), probe, what: ("number of elements", "要素の数")
        });
    }
    let falls_off = uses::falls_off(source, &uniform.name);
    let context = Context { nth: 0, is_downward: negated(source, &uniform.name), falls_off };
    let Guess { value, within, what } = {
        let first = guess(&name, kind, context);
        let nth = seen.entry(first.what.0).or_default();
        let own = guess(&name, kind, Context { nth: *nth, ..context });
        *nth += 1;
        match kind {
            Type::Vector(Scalar::Int | Scalar::Uint, 1) if !guess::is_known(&name) => {
                uses::cases(source, &uniform.name).unwrap_or(own)
            }
            &Type::FLOAT if !guess::is_known(&name) && uses::is_exponent(source, &uniform.name) => guess::exponent(),
            _ => own,
        }
    };
    let own = source.program.initial(uniform).filter(|own| own.iter().any(|number| *number != 0.0));
    let (value, within, what) = match own {
        // What the file says is right; it varies a little about that.
        Some(own) => {
            let ends = |by: f64| own.iter().map(|number| rounded(number * by)).collect::<Vec<_>>();
            let varies = kind.scalar() == Some(Scalar::Float) && own.iter().all(|number| *number > 0.0);
            (own.clone(), varies.then(|| (ends(0.7), ends(1.3))), ("its first value in the file", "ファイルの初期値"))
        }
        None => (value, within, what),
    };
    let probe = within
        .map(|(least, greatest)| format!("{{ within = [{}, {}] }}", numbers(&least, kind), numbers(&greatest, kind)));
    Ok(ProposedValue::Value { value: numbers(&value, kind), probe, what })
}

/// How many elements the longest array of uniforms has.
fn longest_array(source: &SolutionFile) -> Option<usize> {
    let index = |path: &str| path.split_once('[')?.1.split(']').next()?.parse::<usize>().ok();
    source.program.uniforms().iter().filter_map(|uniform| index(&uniform.name)).max().map(|last| last + 1)
}

/// What camera, time and window give, where the name says it.
fn by_role(path: &str, name: &NameWords, kind: &Type, space: Space) -> Option<String> {
    if let Some((key, said)) = names::matrix(name, kind, space) {
        return Some(format!("{key} = {said:?}"));
    }
    let is_vector = |counts: &[u8]| matches!(kind, Type::Vector(Scalar::Float, count) if counts.contains(count));
    if name.is_eye() && is_vector(&[3, 4]) {
        return Some("carries = \"eye\"".to_owned());
    }
    if name.is_resolution() && is_vector(&[2, 3]) {
        let (expression, within) = match is_vector(&[2]) {
            true => ("resolution", "[[200, 100], [600, 400]]"),
            false => ("vec3(resolution, 1.0)", "[[200, 100, 1], [600, 400, 1]]"),
        };
        return Some(format!("is = {expression:?}\nprobe = {{ within = {within} }}"));
    }
    if let Some(expression) = of_the_page(path, kind) {
        return Some(format!("is = {expression:?}"));
    }
    let is_time = name.is_time() && *kind == Type::FLOAT;
    is_time.then(|| "is = \"5.0 * t\"\nprobe = { within = [0, 5] }".to_owned())
}

/// The key and the value that stand in the entry of a name, without a text around it.
pub(super) fn entry_for(path: &str, kind: &Type, is_attribute: bool) -> String {
    let name = NameWords::of(path);
    if is_attribute {
        return format!("carries = {:?}", names::attribute(&name, kind).unwrap_or("position"));
    }
    match by_role(path, &name, kind, Space::World) {
        Some(line) => line,
        None => format!("value = {}", numbers(&guess(&name, kind, Context::default()).value, kind)),
    }
}

fn rounded(number: f64) -> f64 {
    (number * 1e4).round() / 1e4
}

/// What pages that show shaders give.
fn of_the_page(name: &str, kind: &Type) -> Option<&'static str> {
    Some(match (name, kind) {
        ("iTimeDelta", &Type::FLOAT) => "1.0 / 60.0",
        ("iFrameRate", &Type::FLOAT) => "60.0",
        ("iFrame", &Type::INT) => "int(300.0 * t)",
        ("iMouse", Type::Vector(Scalar::Float, 4)) => "vec4(0.6 * resolution.x, 0.4 * resolution.y, 0.0, 0.0)",
        ("iMouse" | "u_mouse" | "mouse", Type::Vector(Scalar::Float, 2)) => "0.4 * resolution",
        _ => return None,
    })
}

/// Numbers as TOML has them: one alone, more as a list.
pub(super) fn numbers(numbers: &[f64], kind: &Type) -> String {
    let number = |number: &f64| match kind.scalar() {
        Some(Scalar::Bool) if *number == 1.0 && numbers.len() == 1 => "1".to_owned(),
        Some(Scalar::Float | Scalar::Double) => format!("{number:?}"),
        _ => format!("{number}"),
    };
    match numbers {
        [one] => number(one),
        more => format!("[{}]", more.iter().map(number).collect::<Vec<_>>().join(", ")),
    }
}
