//! What feeds a solution: each uniform and each vertex attribute gets a source, by its name and type.

mod textures;

use super::Plan;
use super::guess::{Guess, guess};
use super::names::{self, NameWords, Space};
use super::shader_test::ShaderTest;
use super::source::SolutionFile;
use crate::assignment::{AssignmentError, both};
use crate::interpreter::{Dimension, Scalar, Stage, Type, Variable};
use std::collections::{BTreeMap, HashMap};
pub(super) use textures::TextureEntry;

/// A vertex attribute of a stage.
#[derive(Clone, Debug)]
pub(super) struct AttributeEntry {
    pub name: String,
    /// `carries = "position"`, or `values = …`.
    pub said: String,
}

/// An entry `[[uniform]]`.
#[derive(Clone, Debug)]
pub(super) struct UniformEntry {
    pub name: String,
    /// `key = value`, one line each.
    pub lines: Vec<String>,
    /// What the name was taken for, where it was a guess.
    pub note: Option<(String, String)>,
    pub texture: Option<TextureEntry>,
}

/// Where the value of one scalar, vector, matrix or sampler comes from.
#[derive(Clone, Debug)]
enum Said {
    Line(String),
    Value { value: String, probe: Option<String>, what: (&'static str, &'static str) },
    Texture(TextureEntry),
}

/// The parts of a uniform.
#[derive(Clone, Debug)]
enum Tree {
    Leaf(Said),
    Members(Vec<(String, Tree)>),
    Elements(Vec<Tree>),
}

/// The space in which the solutions compute.
pub(super) fn usual_space(sources: &[SolutionFile]) -> Space {
    let uniforms = || sources.iter().flat_map(|source| source.program.uniforms());
    if uniforms().any(|uniform| NameWords::of(&uniform.name).is_eye() && matches!(uniform.kind, Type::Vector(_, 3 | 4)))
    {
        return Space::World;
    }
    let matrices = |role: &str| {
        uniforms().any(|uniform| {
            names::matrix(&NameWords::of(&uniform.name), &uniform.kind, Space::Eye)
                .is_some_and(|(_, said)| said == role)
        })
    };
    let is_negated = |source: &SolutionFile| {
        let inputs = source.program.inputs().iter().filter(|input| NameWords::of(&input.name).is_position());
        inputs.filter(|_| source.stage == Stage::Fragment).any(|input| negated(source, &input.name))
    };
    let is_of_eye = matrices("model-view") || sources.iter().any(is_negated);
    // Where model and view come apart and no eye is given, light is usually computed in the world.
    if is_of_eye || (matrices("normal-matrix") && !matrices("model")) { Space::Eye } else { Space::World }
}

/// Whether a file takes the negative of a variable or member.
fn negated(source: &SolutionFile, path: &str) -> bool {
    let last = path.rsplit('.').next().unwrap_or(path);
    let words = source.words();
    let is_value = |word: &str| word.ends_with(|c: char| c.is_ascii_alphanumeric() || matches!(c, ')' | ']' | '_'));
    (2..words.len()).any(|at| {
        // Back over `lights[i].` to what stands before the whole of it.
        let mut first = at;
        while first >= 2 && words[first - 1].text == "." {
            first -= 2;
            if words[first].text == "]" {
                first =
                    words[..first].iter().rposition(|word| word.text == "[").map_or(0, |open| open.saturating_sub(1));
            }
        }
        words[at].text == last
            && first >= 2
            && words[first - 1].text == "-"
            && (!is_value(&words[first - 2].text) || words[first - 2].text == "return")
    })
}

/// Feeds all uniforms and attributes of the solutions.
pub(super) fn feed(plan: &mut Plan, test: Option<&ShaderTest>) -> Result<(), AssignmentError> {
    let space = usual_space(&plan.sources);
    if let Some(at) = plan.sources.iter().position(|source| source.stage == Stage::Vertex) {
        plan.attributes = attributes(plan, at, test)?;
    }
    let mut seen: HashMap<&'static str, usize> = HashMap::new();
    let mut all: Vec<(String, Tree)> = Vec::new();
    let mut textures = textures::Textures::default();
    for source in &plan.sources {
        for uniform in source.program.uniforms().iter().filter(|uniform| !uniform.name.starts_with("gl_")) {
            let (root, rest) = split(&uniform.name);
            if all.iter().any(|(known, tree)| known == root && has(tree, rest)) {
                continue;
            }
            let changing = test.and_then(|test| test.expression_of(&uniform.name, &uniform.kind));
            let constant = test.and_then(|test| test.value_of(&uniform.name, &uniform.kind));
            let said = match (changing, constant) {
                (Some(text), _) => Said::Line(format!("is = {text:?}")),
                (_, Some(value)) => Said::Value { value, probe: None, what: ("value of the test", "テストの値") },
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

fn tell(plan: &mut Plan) {
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
    uniform: &Variable,
    space: Space,
    seen: &mut HashMap<&'static str, usize>,
    textures: &mut textures::Textures,
) -> Result<Said, AssignmentError> {
    let (name, kind) = (NameWords::of(&uniform.name), &uniform.kind);
    if let Type::Sampler(sampler) = kind {
        let is_known = matches!(sampler.dimension, Dimension::Two | Dimension::Cube)
            && !sampler.array
            && !sampler.shadow
            && sampler.texel == Scalar::Float;
        let path = &uniform.name;
        let refused = || {
            source.wrong(uniform.line,
                both(
                    format!(
                        "`{path}` is a {kind}: a homework's textures are read by sampler2D and samplerCube; declare one of them"
                    ),
                    format!(
                        "`{path}` は {kind} です。課題のテクスチャを読めるのは sampler2D と samplerCube です。どちらかで宣言してください"
                    ),
                ),
            )
        };
        return match is_known {
            true => Ok(Said::Texture(textures.of(&uniform.name, sampler.dimension == Dimension::Cube))),
            false => Err(refused()),
        };
    }
    if let Some(line) = by_role(&uniform.name, &name, kind, names::space_of(&name, space)) {
        return Ok(Said::Line(line));
    }
    let is_downward = negated(source, &uniform.name);
    let Guess { value, within, what } = {
        let first = guess(&name, kind, 0, is_downward);
        let nth = seen.entry(first.what.0).or_default();
        let own = guess(&name, kind, *nth, is_downward);
        *nth += 1;
        own
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
    Ok(Said::Value { value: numbers(&value, kind), probe, what })
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
    if let Some(expression) = of_the_page(path, kind) {
        return Some(format!("is = {expression:?}"));
    }
    if name.is_resolution() && is_vector(&[2, 3]) {
        let expression = if is_vector(&[2]) { "resolution" } else { "vec3(resolution, 1.0)" };
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
        None => format!("value = {}", numbers(&guess(&name, kind, 0, false).value, kind)),
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

/// The name of a whole uniform, and the path in it.
fn split(path: &str) -> (&str, &str) {
    path.split_at(path.find(['.', '[']).unwrap_or(path.len()))
}

/// The first step of a path and the rest of it: an index or a member.
fn step(path: &str) -> Option<(Result<usize, &str>, &str)> {
    if let Some(rest) = path.strip_prefix('[') {
        let (index, rest) = rest.split_once(']')?;
        return Some((Ok(index.parse().ok()?), rest));
    }
    let rest = path.strip_prefix('.')?;
    let end = rest.find(['.', '[']).unwrap_or(rest.len());
    Some((Err(&rest[..end]), &rest[end..]))
}

fn empty(path: &str) -> Tree {
    match step(path) {
        Some((Ok(_), _)) => Tree::Elements(Vec::new()),
        _ => Tree::Members(Vec::new()),
    }
}

fn insert(tree: &mut Tree, path: &str, said: Said) {
    let Some((first, rest)) = step(path) else {
        *tree = Tree::Leaf(said);
        return;
    };
    match (first, tree) {
        // Elements come in their order.
        (Ok(index), Tree::Elements(elements)) => {
            while elements.len() <= index {
                elements.push(empty(rest));
            }
            insert(&mut elements[index], rest, said);
        }
        (Err(name), Tree::Members(members)) => {
            let at = members.iter().position(|(known, _)| known == name).unwrap_or_else(|| {
                members.push((name.to_owned(), empty(rest)));
                members.len() - 1
            });
            insert(&mut members[at].1, rest, said);
        }
        _ => {}
    }
}

fn has(tree: &Tree, path: &str) -> bool {
    match (step(path), tree) {
        (None, Tree::Leaf(_)) => true,
        (Some((Ok(index), rest)), Tree::Elements(elements)) => elements.get(index).is_some_and(|one| has(one, rest)),
        (Some((Err(name), rest)), Tree::Members(members)) => {
            members.iter().any(|(known, one)| known == name && has(one, rest))
        }
        _ => false,
    }
}

/// The entries of a uniform: one where all its parts have values, or one for each part.
fn write(name: &str, tree: &Tree, entries: &mut Vec<UniformEntry>) {
    let entry = |lines: Vec<String>, note, texture| UniformEntry { name: name.to_owned(), lines, note, texture };
    let note = |what: (&str, &str)| Some((what.0.to_owned(), what.1.to_owned()));
    match tree {
        Tree::Leaf(Said::Line(line)) => entries.push(entry(line.lines().map(str::to_owned).collect(), None, None)),
        Tree::Leaf(Said::Texture(texture)) => {
            let (en, ja) = texture.what;
            entries.push(entry(vec![format!("texture = \"{}\"", texture.name)], note((en, ja)), Some(texture.clone())));
        }
        Tree::Leaf(Said::Value { value, probe, what }) => {
            let mut lines = vec![format!("value = {value}")];
            lines.extend(probe.iter().map(|probe| format!("probe = {probe}")));
            entries.push(entry(lines, note(*what), None));
        }
        parts => match (value_of(parts, 0), probe_of(parts)) {
            (Some(value), probe) => {
                let mut lines = vec![format!("value = {value}")];
                lines.extend(probe.iter().map(|probe| format!("probe = {probe}")));
                entries.push(entry(lines, note(("a whole of values by their names", "名前から決めた値の組")), None));
            }
            (None, _) => match parts {
                Tree::Members(members) => {
                    members.iter().for_each(|(member, tree)| write(&format!("{name}.{member}"), tree, entries));
                }
                Tree::Elements(elements) => {
                    (0..)
                        .zip(elements)
                        .for_each(|(at, tree): (usize, _)| write(&format!("{name}[{at}]"), tree, entries));
                }
                Tree::Leaf(_) => {}
            },
        },
    }
}

/// The values of all parts, where they have values.
fn value_of(tree: &Tree, depth: usize) -> Option<String> {
    match tree {
        Tree::Leaf(Said::Value { value, .. }) => Some(value.clone()),
        Tree::Leaf(_) => None,
        Tree::Members(members) => {
            let each = members.iter().map(|(name, tree)| Some(format!("{name} = {}", value_of(tree, depth + 1)?)));
            Some(format!("{{ {} }}", each.collect::<Option<Vec<_>>>()?.join(", ")))
        }
        Tree::Elements(elements) => {
            let each = elements.iter().map(|tree| value_of(tree, depth + 1)).collect::<Option<Vec<_>>>()?;
            Some(match depth {
                0 => format!("[\n{}]", each.iter().map(|one| format!("    {one},\n")).collect::<String>()),
                _ => format!("[{}]", each.join(", ")),
            })
        }
    }
}

/// What probes may draw for the parts; of an array it is said once.
fn probe_of(tree: &Tree) -> Option<String> {
    match tree {
        Tree::Leaf(Said::Value { probe, .. }) => probe.clone(),
        Tree::Leaf(_) => None,
        Tree::Elements(elements) => elements.first().and_then(probe_of),
        Tree::Members(members) => {
            let each: Vec<_> =
                members.iter().filter_map(|(name, tree)| Some(format!("{name} = {}", probe_of(tree)?))).collect();
            (!each.is_empty()).then(|| format!("{{ {} }}", each.join(", ")))
        }
    }
}

/// The attributes of a vertex solution.
fn attributes(plan: &mut Plan, at: usize, test: Option<&ShaderTest>) -> Result<Vec<AttributeEntry>, AssignmentError> {
    let source = &plan.sources[at];
    let own = source.program.inputs().iter().filter(|input| !input.name.starts_with("gl_"));
    let own: Vec<(String, Type)> = own.map(|input| (input.name.clone(), input.kind.clone())).collect();
    let listed = |name: &str, kind: &Type| test.and_then(|test| test.attribute(name, kind));
    let mut carried: BTreeMap<&str, &str> = BTreeMap::new();
    for (name, kind) in &own {
        if let Some(said) = names::attribute(&NameWords::of(name), kind).filter(|_| listed(name, kind).is_none()) {
            carried.entry(said).or_insert(name);
        }
    }
    let mut attributes = Vec::new();
    for (name, kind) in &own {
        if let Some(values) = listed(name, kind) {
            attributes.push(AttributeEntry { name: name.clone(), said: format!("values = {values}") });
            continue;
        }
        let known = names::attribute(&NameWords::of(name), kind);
        let said = known.map(str::to_owned).or_else(|| fallback(kind, &carried).map(str::to_owned));
        if known.is_none()
            && let Some(said) = &said
        {
            plan.guessed(
                format!("input `{name}`: its name says nothing, so it carries \"{said}\""),
                format!("input `{name}`: 名前から分からないので、\"{said}\" を渡します"),
            );
        } else if let Some(said) = &said {
            plan.read(format!("input `{name}`: carries \"{said}\""), format!("input `{name}`: \"{said}\" を渡します"));
        }
        let said = match said {
            Some(said) => {
                let name: &str = name;
                let key = ["position", "normal", "texture-coordinates", "tangent", "number"];
                key.iter().find(|key| **key == said).map(|key| carried.entry(key).or_insert(name));
                format!("carries = {said:?}")
            }
            None => {
                plan.guessed(
                    format!("input `{name}`: one of three values for each vertex in turn"),
                    format!("input `{name}`: 頂点ごとに 3 つの値を順に渡します"),
                );
                let values = (0..3).map(|nth| numbers(&guess(&NameWords::of("color"), kind, nth, false).value, kind));
                format!("values = [{}]", values.collect::<Vec<_>>().join(", "))
            }
        };
        attributes.push(AttributeEntry { name: name.clone(), said });
    }
    Ok(attributes)
}

/// What an attribute carries whose name is not known: what is still missing, by its type.
fn fallback(kind: &Type, carried: &BTreeMap<&str, &str>) -> Option<&'static str> {
    let is_free = |said: &&str| !carried.contains_key(*said);
    let Type::Vector(Scalar::Float, count) = kind else { return None };
    match count {
        2 if carried.contains_key("position") => Some("texture-coordinates").filter(is_free),
        2..=4 => Some("position").filter(is_free),
        _ => None,
    }
}
