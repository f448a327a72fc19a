//! From the manifest to an assignment: every name is resolved, every expression typed, every number in range.

mod advice;
mod interface;
mod mistakes;
mod probing;
mod scene;
mod solution;
mod typeset;

use super::{Assignment, AssignmentError, HandedIn, MANIFEST, both, error};
use crate::Folder;
use crate::accepted::Answer;
use crate::interpreter::{Program, Stage};
use crate::manifest::{self, Manifest};
use crate::rasteriser::ClipVertex;
use solution::Solution;
use std::collections::HashSet;
use std::sync::Arc;

/// Rubric lines are held as the bits of a u64.
const MAX_LINES: usize = 64;

type Checked<T> = Result<T, AssignmentError>;

/// `line_at`: the line of `assignment.toml` in which a byte of it stands.
pub(super) fn assignment(mut m: Manifest, line_at: &dyn Fn(usize) -> u32, folder: &Folder) -> Checked<Assignment> {
    let read = |name: &str| folder.text(name).map(str::to_owned);
    let files = files(std::mem::take(&mut m.file), read)?;
    let mut solution = Solution::read(&files[0], &m.constant)?;
    let interface = interface::interface(&m, &files[0], &solution, line_at)?;
    let constants = solution.constants(std::mem::take(&mut m.constant))?;
    let lines = rubric(&m.rubric, &solution)?;
    for constant in &constants {
        known_line(&lines, &constant.line, &format!("constant `{}`", constant.name))?;
    }
    let typeset = m.equation.take().map(|entry| typeset::typeset(entry, &lines, line_at)).transpose()?;
    let mistakes = std::mem::take(&mut m.mistake);
    let mistakes = mistakes::all(mistakes, &m.rubric, &mut solution, &constants, line_at)?;
    let probing = probing::probing(&m.probes, &constants, &solution)?;
    let regions = probing::regions(std::mem::take(&mut m.region), &mut solution, &m.rubric, line_at)?;
    let advice = std::mem::take(&mut m.advice).into_iter();
    let advice = advice.map(|entry| advice::advice(entry, &interface, &constants, &solution));
    let advice = advice.collect::<Checked<Vec<_>>>()?;
    let equation = solution.finish(&m, &interface, &constants)?;
    let assignment = Assignment {
        scene: scene::scene(&m.scene, line_at)?,
        files,
        id: m.id,
        digest: String::new(),
        folder: Arc::default(),
        task: m.task,
        typeset,
        title: m.title,
        interface,
        constants,
        equation,
        rubric: m.rubric,
        mistakes,
        advice,
        regions,
        probing,
    };
    probing::lobe_is_known(&assignment)?;
    answers_are_defined(&assignment)?;
    Ok(assignment)
}

/// What is right must be a number in every picture: what GLSL leaves undefined is another thing on another machine.
fn answers_are_defined(assignment: &Assignment) -> Checked<()> {
    let right = assignment.equation.right();
    let file = &assignment.files[0];
    let mut known: HashSet<&str> = HashSet::new();
    known.extend(assignment.interface.uniforms.iter().map(|uniform| uniform.path.as_str()));
    known.extend(assignment.interface.inputs.iter().map(|input| input.name.as_str()));
    for answer in &file.accepted {
        let mut given = answer.program.uniforms().iter().chain(answer.program.inputs());
        if let Some(other) = given.find(|one| !known.contains(one.name.as_str())) {
            let message = format!("`{}` is not among the inputs and uniforms of {MANIFEST}: remove it", other.name);
            return Err(error(solution::place(&answer.name, other.line), message));
        }
    }
    let is_number = |corners: [ClipVertex; 3]| {
        corners.iter().all(|corner| corner.colour.is_finite() && corner.position.is_finite())
    };
    for pose in assignment.scene.all_poses() {
        let undefined = |name: &str| {
            let message = both(
                "the colour or the position is undefined, or no number: look at divisions, roots, powers and branches",
                "色または位置が未定義か、数になりません。割り算、平方根、べき乗、分岐を確かめてください",
            );
            Err(error(format!("{name}, at t = {}", pose.t), message))
        };
        if !is_number(assignment.corners(&pose, &right, assignment.equation.colour)) {
            return undefined(&file.solution.name);
        }
        if let Some(answer) = file.accepted.iter().find(|answer| !is_number(assignment.corners_of(answer, &pose))) {
            return undefined(&answer.name);
        }
    }
    Ok(())
}

fn files(files: Vec<manifest::File>, read: impl Fn(&str) -> Checked<String>) -> Checked<Vec<HandedIn>> {
    if files.is_empty() {
        return Err(error(
            "file",
            both("nothing is handed in: write [[file]]", "提出するファイルがありません。[[file]] を書いてください"),
        ));
    }
    let handed_in = |file: manifest::File| {
        if file.stage != manifest::Stage::Vertex {
            return Err(error(
                format!("file `{}`", file.name),
                both("only vertex shaders can be handed in", "提出できるのは頂点シェーダだけです"),
            ));
        }
        let fixed = file.fixed.iter().map(|f| Ok((f.stage, read(&f.file)?))).collect::<Checked<_>>()?;
        let solution = super::Solution { text: read(&file.solution)?, name: file.solution };
        let accepted = file.accepted.into_iter().map(|name| {
            let program = Program::compile(&read(&name)?, Stage::Vertex);
            let program = Arc::new(program.map_err(|refusal| solution::refused(&name, &refusal))?);
            Ok(Answer { name, program })
        });
        Ok(HandedIn {
            accepted: accepted.collect::<Checked<_>>()?,
            starter: read(&file.starter)?,
            starter_name: file.starter,
            solution,
            name: file.name,
            stage: file.stage,
            fixed,
        })
    };
    files.into_iter().map(handed_in).collect()
}

fn rubric(lines: &[manifest::RubricLine], solution: &Solution<'_>) -> Checked<HashSet<String>> {
    if lines.len() > MAX_LINES {
        return Err(error("rubric", both("has more than 64 lines", "64 行を超えています")));
    }
    let mut ids = HashSet::new();
    for line in lines {
        let place = format!("rubric line `{}`", line.id);
        solution.definition(&line.judges, &|| place.clone())?;
        if !line.points.is_finite() || line.points <= 0.0 {
            return Err(error(
                place,
                both(
                    "is worth nothing: write `points` above 0",
                    "点がありません。`points` を 0 より大きくしてください",
                ),
            ));
        }
        if !ids.insert(line.id.clone()) {
            return Err(error(
                place,
                both("stands twice: give one another name", "2 回書かれています。一方の名前を変えてください"),
            ));
        }
    }
    Ok(ids)
}

/// Names as a sentence has them.
fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

fn known_line(lines: &HashSet<String>, line: &str, place: &str) -> Checked<()> {
    if lines.contains(line) {
        Ok(())
    } else {
        Err(error(
            place,
            both(
                format!("there is no rubric line `{line}`: correct the name, or add it"),
                format!("採点の行 `{line}` はありません。名前を直すか、追加してください"),
            ),
        ))
    }
}
